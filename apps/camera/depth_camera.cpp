// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/camera/pair_camera.hpp>
#include <heel/cloud/files.hpp>

#include <OpenNI.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr int kDepthScale = 1000;  // Of PIXEL_FORMAT_DEPTH_1_MM.
constexpr int kMostWait_ms = 2000;
constexpr int kMostWaits = 100;  // For two pictures of the same moment: some seconds.

/// There is no OpenNI::shutdown(): it unloads drivers while their threads are still ending, and
/// crashes.
void startOpenNi() {
  if (openni::OpenNI::initialize() == openni::STATUS_OK) return;
  throw std::runtime_error("OpenNI2 does not start: " +
                           std::string(openni::OpenNI::getExtendedError()));
}

/// One of its two eyes.
struct Eye {
  openni::SensorType sensor;
  openni::PixelFormat format;
  int type;  ///< Of OpenCV.
  const char* name;
  openni::VideoStream stream = {};
  openni::VideoFrameRef frame = {};
  bool is_new = false;
  int left = 0;  ///< Pictures of a recording that are still to come.
};

/// A camera that OpenNI2 has a driver for, or its recording.
class DepthCamera final : public PairCamera {
 public:
  explicit DepthCamera(const PairCameraParams& params)
      : PairCamera(params.device, SensorKind::kRgbd), calibration_(params.calibration) {
    is_live_ = fs::path(name_).extension() != ".oni";
    startOpenNi();
    openDevice();
    for (Eye& eye : eyes_) open(eye, params);
    if (is_live_) {  // A recording would say yes, and stay as it is.
      device_.setDepthColorSyncEnabled(true);
      device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
    }
    if (device_.getImageRegistrationMode() != openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR) {
      warning_ =
          name_ + ": does not say that its depth is in the pixels of its colours; see that it is";
    }
    if (openni::PlaybackControl* playback = device_.getPlaybackControl()) {
      playback->setSpeed(-1.0F);  // A picture whenever one is read: none is left out.
      playback->setRepeatEnabled(false);
      for (Eye& eye : eyes_) eye.left = playback->getNumberOfFrames(eye.stream);
    }
    for (Eye& eye : eyes_) {
      if (eye.stream.start() != openni::STATUS_OK) fail(std::string("gives no ") + eye.name);
    }
  }

  bool read() override {
    for (Eye& eye : eyes_) eye.is_new = false;
    for (int waits = 0; !arePair(); ++waits) {
      if (isAtEnd()) return false;
      if (waits == kMostWaits && !began_us_) fail("colour and depth do not come at the same time");
      std::array<openni::VideoStream*, 2> streams = {&eyes_[0].stream, &eyes_[1].stream};
      int ready = -1;
      if (waits == kMostWaits ||
          openni::OpenNI::waitForAnyStream(streams.data(), 2, &ready, kMostWait_ms) !=
              openni::STATUS_OK) {
        has_failed_ = true;
        return false;
      }
      Eye& eye = eyes_.at(static_cast<std::size_t>(ready));
      if (eye.stream.readFrame(&eye.frame) != openni::STATUS_OK) fail("a picture can't be read");
      check(eye);
      eye.is_new = true;
      --eye.left;
    }
    const std::uint64_t stamp_us = eyes_[0].frame.getTimestamp();
    if (!began_us_) began_us_ = stamp_us;
    stamp_s_ = 1e-6 * (static_cast<double>(stamp_us) - static_cast<double>(*began_us_));
    if (sizeOf(eyes_[0]) != sizeOf(eyes_[1])) {
      fail("colour and depth have different sizes; ask for one that both have");
    }
    return true;
  }

  std::array<cv::Mat, 2> pictures() const override {
    std::array<cv::Mat, 2> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Eye& eye = eyes_.at(i);
      // OpenCV has no view of what is const; this one is only read.
      const cv::Mat view(sizeOf(eye), eye.type, const_cast<void*>(eye.frame.getData()),
                         static_cast<std::size_t>(eye.frame.getStrideInBytes()));
      if (i == 0) {
        cv::cvtColor(view, out.at(i), cv::COLOR_RGB2BGR);
      } else {
        out.at(i) = view;
      }
      if (eye.stream.getMirroringEnabled()) cv::flip(out.at(i), out.at(i), 1);
    }
    return out;
  }

  double length_s() const override {
    const int rate_hz = eyes_[0].stream.getVideoMode().getFps();
    return !is_live_ && rate_hz > 0 ? static_cast<double>(eyes_[0].left) / rate_hz : 0.0;
  }

  PairCalibration calibration() const override {
    PairCalibration out;
    const cv::Size size = sizeOf(eyes_[0]);
    if (calibration_.empty()) {
      out.file.camera = toldCamera(size);
      out.file.depth_scale = kDepthScale;
      out.files["camera.yaml"] = textOf(*out.file.camera);
      return out;
    }
    const fs::path file =
        fs::is_directory(calibration_) ? calibration_ / "camera.yaml" : calibration_;
    out.file = readCameraFile(file);
    if (!out.file.camera) throw std::runtime_error(file.string() + ": has no 'width'");
    checkCalibratedSize(file, out.file.camera->width, out.file.camera->height, size);
    if (out.file.depth_scale != kDepthScale) {
      throw std::runtime_error(file.string() + ": 'depth_scale' must be 1000 for this camera");
    }
    out.files["camera.yaml"] = readWholeFile(file);
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(name_ + ": " + why);
  }

  void openDevice() {
    const std::size_t colon = name_.find(':');
    const std::string uri = !is_live_                    ? name_
                            : colon == std::string::npos ? ""
                                                         : name_.substr(colon + 1);
    if (!is_live_ && !fs::exists(name_)) fail("there is no such recording");
    if (device_.open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()) != openni::STATUS_OK) {
      std::istringstream told(openni::OpenNI::getExtendedError());
      std::string why;
      std::getline(told >> std::ws, why);
      fail((is_live_ ? "OpenNI2 opens no such camera" : "is no recording that OpenNI2 can read") +
           (why.empty() ? why : " (" + why + ")"));
    }
  }

  void open(Eye& eye, const PairCameraParams& params) {
    if (!device_.hasSensor(eye.sensor) ||
        eye.stream.create(device_, eye.sensor) != openni::STATUS_OK) {
      fail(std::string("has no ") + eye.name);
    }
    if (!is_live_) return;
    eye.stream.setMirroringEnabled(false);
    const auto orElse = [](double asked, double otherwise) {
      return asked > 0 ? asked : otherwise;
    };
    const auto distance = [&](const openni::VideoMode& mode) {
      return std::abs(mode.getResolutionX() - orElse(params.width, 640)) +
             std::abs(mode.getResolutionY() - orElse(params.height, 480)) +
             std::abs(mode.getFps() - orElse(params.rate_hz, 30));
    };
    const openni::VideoMode* best = nullptr;
    const auto& modes = eye.stream.getSensorInfo().getSupportedVideoModes();
    for (int i = 0; i < modes.getSize(); ++i) {
      if (modes[i].getPixelFormat() != eye.format) continue;
      if (best == nullptr || distance(modes[i]) < distance(*best)) best = &modes[i];
    }
    if (best != nullptr) eye.stream.setVideoMode(*best);  // If not, check() tells.
  }

  static cv::Size sizeOf(const Eye& eye) { return {eye.frame.getWidth(), eye.frame.getHeight()}; }

  void check(const Eye& eye) const {
    const int stride = eye.frame.getStrideInBytes();
    const bool is_whole = sizeOf(eye).area() > 0 &&
                          stride >= eye.frame.getWidth() * CV_ELEM_SIZE(eye.type) &&
                          eye.frame.getDataSize() / stride >= eye.frame.getHeight();
    if (!is_whole) fail(std::string("a picture of ") + eye.name + " is cut off");
    if (eye.frame.getVideoMode().getPixelFormat() != eye.format) {
      fail(std::string("its ") + eye.name + " is not in a format that Heel reads");
    }
  }

  /// Whether the last pictures of both are no further apart than half the time between two.
  bool arePair() const {
    if (!eyes_[0].is_new || !eyes_[1].is_new) return false;
    const double apart_s = 1e-6 * std::abs(static_cast<double>(eyes_[0].frame.getTimestamp()) -
                                           static_cast<double>(eyes_[1].frame.getTimestamp()));
    return 2.0 * apart_s * std::max(eyes_[0].stream.getVideoMode().getFps(), 1) <= 1.0;
  }

  bool isAtEnd() const {
    const auto lacks = [](const Eye& eye) { return !eye.is_new && eye.left <= 0; };
    return !is_live_ &&
           (lacks(eyes_[0]) || lacks(eyes_[1]) || (eyes_[0].left <= 0 && eyes_[1].left <= 0));
  }

  /// By the field of view that it tells.
  PinholeCamera toldCamera(cv::Size size) const {
    const double view_rad = eyes_[0].stream.getHorizontalFieldOfView();
    if (!(view_rad > 0.1 && view_rad < 3.0)) {
      fail("does not tell its field of view; give it a camera.yaml by --calibration");
    }
    const double focal_px = 0.5 * size.width / std::tan(0.5 * view_rad);
    return {size.width,
            size.height,
            focal_px,
            focal_px,
            0.5 * (size.width - 1),
            0.5 * (size.height - 1)};
  }

  static std::string textOf(const PinholeCamera& camera) {
    std::array<char, 300> text{};
    std::snprintf(text.data(), text.size(),
                  "# By the field of view that the camera tells.\n"
                  "width: %d\nheight: %d\nfx: %.6f\nfy: %.6f\ncx: %.1f\ncy: %.1f\n"
                  "depth_scale: %d\n",
                  camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
                  kDepthScale);
    return text.data();
  }

  fs::path calibration_;
  openni::Device device_;
  std::array<Eye, 2> eyes_ = {
      Eye{openni::SENSOR_COLOR, openni::PIXEL_FORMAT_RGB888, CV_8UC3, "colour"},
      Eye{openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_DEPTH_1_MM, CV_16UC1, "depth"}};
  std::optional<std::uint64_t> began_us_;
};

}  // namespace

std::unique_ptr<PairCamera> openDepthCamera(const PairCameraParams& params) {
  return std::make_unique<DepthCamera>(params);
}

}  // namespace heel
