// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/camera/pair_camera.hpp>
#include <heel/cloud/files.hpp>
#include <heel/cloud/stereo_calibration.hpp>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

/// A stereo camera that gives both images side by side, or a video of one.
class SideBySide final : public PairCamera {
 public:
  explicit SideBySide(const PairCameraParams& params)
      : PairCamera(params.device, SensorKind::kStereo), calibration_(params.calibration) {
    if (std::all_of(name_.begin(), name_.end(), [](unsigned char c) { return std::isdigit(c); })) {
      name_ = "/dev/video" + name_;
    }
    if (!fs::exists(name_)) throw std::runtime_error(name_ + ": there is no such camera or video");
    is_live_ = fs::is_character_file(name_);
    if (!camera_.open(name_, is_live_ ? cv::CAP_V4L2 : cv::CAP_ANY)) {
      throw std::runtime_error(name_ + ": is no camera or video that OpenCV can read");
    }
    const auto ask = [this](int what, double value) {
      if (value > 0.0) camera_.set(what, value);
    };
    ask(cv::CAP_PROP_FRAME_WIDTH, params.width);
    ask(cv::CAP_PROP_FRAME_HEIGHT, params.height);
    ask(cv::CAP_PROP_FPS, params.rate_hz);
  }

  bool read() override {
    if (!camera_.read(both_) || both_.empty()) {
      has_failed_ = is_live_;
      return false;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!began_) began_ = now;
    stamp_s_ = is_live_ ? std::chrono::duration<double>(now - *began_).count()
                        : 1e-3 * camera_.get(cv::CAP_PROP_POS_MSEC);
    if (both_.cols % 2 != 0) {
      throw std::runtime_error(name_ + ": a picture " + std::to_string(both_.cols) +
                               " pixels wide is not two images side by side");
    }
    return true;
  }

  std::array<cv::Mat, 2> pictures() const override {
    const int half = both_.cols / 2;
    return {both_.colRange(0, half), both_.colRange(half, both_.cols)};
  }

  double length_s() const override {
    const double rate_hz = camera_.get(cv::CAP_PROP_FPS);
    const double frames = camera_.get(cv::CAP_PROP_FRAME_COUNT);
    return !is_live_ && rate_hz > 0.0 ? std::clamp(frames / rate_hz, 0.0, kLongestVideo_s) : 0.0;
  }

  PairCalibration calibration() const override {
    PairCalibration out;
    if (calibration_.empty()) return out;
    const cv::Size size(both_.cols / 2, both_.rows);
    try {
      out.rig = readStereoRig(calibration_, size);
      const PinholeCamera& left = out.rig->camera().left;
      checkCalibratedSize(calibration_, left.width, left.height, size);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(std::string(error.what()) + " (pictures of " +
                               std::to_string(both_.cols) + "x" + std::to_string(both_.rows) +
                               " are taken for two images side by side)");
    }
    const bool is_folder = fs::is_directory(calibration_);
    for (const fs::path& file : stereoRigFiles(calibration_)) {
      const std::string ending = file.extension().string();
      const std::string name = is_folder          ? file.filename().string()
                               : ending == ".txt" ? "calib.txt"
                                                  : "stereo" + ending;
      out.files[name] = readWholeFile(file);
    }
    const fs::path mounting = calibration_ / "camera.yaml";
    if (is_folder && fs::exists(mounting)) {
      out.file = readCameraFile(mounting);
      out.files["camera.yaml"] = readWholeFile(mounting);
    }
    return out;
  }

 private:
  fs::path calibration_;
  cv::VideoCapture camera_;
  cv::Mat both_;
  std::optional<std::chrono::steady_clock::time_point> began_;
};

}  // namespace

std::unique_ptr<PairCamera> openSideBySide(const PairCameraParams& params) {
  return std::make_unique<SideBySide>(params);
}

}  // namespace heel
