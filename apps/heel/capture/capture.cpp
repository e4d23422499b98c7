// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/capture/pair_camera.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/output.hpp>
#include <heel/cloud/files.hpp>
#include <heel/cloud/stereo_calibration.hpp>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr double kMost_s = 1e9;  // What a broken video may claim.

/// A stereo camera that gives both images side by side, or a video of one.
class SideBySide final : public PairCamera {
 public:
  explicit SideBySide(const CaptureOptions& options)
      : PairCamera(options.device), calibration_(options.calibration) {
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
    ask(cv::CAP_PROP_FRAME_WIDTH, options.width);
    ask(cv::CAP_PROP_FRAME_HEIGHT, options.height);
    ask(cv::CAP_PROP_FPS, options.rate_hz);
  }

  PairKind kind() const override { return PairKind::kStereo; }

  bool next() override {
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
    return {both_.colRange(0, half).clone(), both_.colRange(half, both_.cols).clone()};
  }

  double length_s() const override {
    const double rate_hz = camera_.get(cv::CAP_PROP_FPS);
    const double frames = camera_.get(cv::CAP_PROP_FRAME_COUNT);
    return !is_live_ && rate_hz > 0.0 ? std::clamp(frames / rate_hz, 0.0, kMost_s) : 0.0;
  }

  void addCalibration(const Output& output) const override {
    const fs::path& from = calibration_;
    if (from.empty()) return;
    const cv::Size size(both_.cols / 2, both_.rows);
    const StereoCamera camera = readStereoRig(from, size).camera();
    checkCalibratedSize(from, camera.left.width, camera.left.height, size);
    const auto copy = [&output](const fs::path& file, const std::string& name) {
      writeFile(output / name, readWholeFile(file));
    };
    if (!fs::is_directory(from)) {
      const bool is_middlebury = from.extension() == ".txt";
      return copy(from, is_middlebury ? "calib.txt" : "stereo" + from.extension().string());
    }
    static const std::set<std::string> kinds = {".yaml", ".yml", ".xml", ".json"};
    for (const fs::directory_entry& file : fs::directory_iterator(from)) {
      const std::string name = file.path().filename().string();
      if (!file.is_regular_file() || name.front() == '.') continue;
      if (kinds.count(file.path().extension().string()) != 0 || name == "calib.txt") {
        copy(file.path(), name);
      }
    }
  }

 private:
  fs::path calibration_;
  bool is_live_ = false;
  cv::VideoCapture camera_;
  cv::Mat both_;
  std::optional<std::chrono::steady_clock::time_point> began_;
};

std::unique_ptr<PairCamera> openCamera(const CaptureOptions& options) {
  if (!isDepthCamera(options.device)) return std::make_unique<SideBySide>(options);
#ifdef HEEL_HAS_OPENNI
  return openDepthCamera(options);
#else
  throw std::runtime_error(
      options.device +
      ": this build of Heel is without OpenNI2; it needs libopenni2-dev and cmake "
      "-DHEEL_WITH_OPENNI=ON");
#endif
}

/// Writes pairs as numbered pictures, one while the next is awaited.
class PairWriter {
 public:
  PairWriter(const Output& output, PairKind kind) : output_(output) {
    if (kind == PairKind::kRgbd) sides_ = {"rgb", "depth"};
    if (kind == PairKind::kStereo) {
      lists_.emplace_back(output / "times.txt");
    } else {
      for (const std::string& side : sides_) lists_.emplace_back(output / (side + ".txt"));
    }
  }
  ~PairWriter() {
    try {
      encoding_.wait();
    } catch (const std::exception&) {
      // Whoever gave up before finish() has been told why.
    }
  }

  void add(const std::array<cv::Mat, 2>& pictures, double stamp_s) {
    encoding_.wait();
    ++count_;
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.6f", stamp_s);
    const std::string stamp = text.data();
    std::snprintf(text.data(), text.size(), "/%06zu.png", count_);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const std::string name = sides_.at(i) + text.data();
      encoding_.run(
          [file = output_ / name, picture = pictures.at(i)] { writePicture(file, picture); });
      if (lists_.size() == sides_.size()) lists_.at(i).write(stamp + ' ' + name + '\n');
    }
    if (lists_.size() == 1) lists_.front().write(stamp + '\n');
  }
  void finish() {
    encoding_.wait();
    for (OutputFile& list : lists_) list.close();
  }
  std::size_t count() const { return count_; }

 private:
  const Output& output_;
  std::array<std::string, 2> sides_ = {"left", "right"};
  std::deque<OutputFile> lists_;  ///< One of times, or one of times and names for each side.
  tbb::task_group encoding_;
  std::size_t count_ = 0;
};

void run(const CaptureOptions& options) {
  std::error_code ignored;
  const bool is_file = fs::is_regular_file(options.device, ignored);
  const fs::path video = is_file ? options.device : "";
  Output output(
      {"capture", OutputKind::kFolder, options.out, {options.calibration, video}, {}, true});
  if (fs::exists(options.out) && !fs::is_empty(options.out, ignored)) {
    throw std::invalid_argument(options.out.string() + ": holds something already");
  }
  const std::unique_ptr<PairCamera> opened = openCamera(options);
  PairCamera& camera = *opened;
  keepResultsOnSignals();
  ProgressBar progress("capturing",
                       static_cast<std::size_t>(options.duration_s.value_or(camera.length_s())));
  PairWriter pairs(output, camera.kind());
  cv::Size size;
  double last_s = -1.0;
  std::size_t left_out = 0;
  bool has_ended = false;  // by itself: its time is up, or there is no more
  while (!isStopRequested() && !has_ended) {
    if (!camera.next() || camera.stamp_s() > options.duration_s.value_or(camera.stamp_s())) {
      has_ended = true;
    } else if (!(camera.stamp_s() > last_s && camera.stamp_s() < kMost_s)) {
      ++left_out;
    } else {
      last_s = camera.stamp_s();
      const std::array<cv::Mat, 2> pictures = camera.pictures();
      if (pairs.count() == 0) {
        size = pictures[0].size();
        camera.addCalibration(output);
      }
      pairs.add(pictures, last_s);
      progress.show(static_cast<std::size_t>(last_s));
    }
  }
  pairs.finish();
  if (pairs.count() == 0) {
    if (!has_ended) throw Stopped("stopped before the first pair");
    throw std::runtime_error(camera.name() + ": gives no pictures");
  }
  const bool is_whole = has_ended ? !camera.hasFailed() : !options.duration_s;
  output.commit(is_whole);
  if (left_out > 0) {
    warn(std::to_string(left_out) + " pictures were left out: their times do not increase");
  }
  if (options.calibration.empty() && camera.kind() == PairKind::kStereo) {
    warn(options.out.string() + ": before others can read it, put a stereo calibration there");
  }
  std::printf("%zu pairs of %dx%d over %.1f s; wrote %s\n", pairs.count(), size.width, size.height,
              last_s, output.path().c_str());
  if (camera.hasFailed()) throw std::runtime_error(camera.name() + ": gives no more pictures");
  if (!is_whole) throw Stopped("stopped: " + output.path().string() + " holds what came till then");
}

}  // namespace

void checkCalibratedSize(const fs::path& from, int width, int height, cv::Size images) {
  if (cv::Size(width, height) == images) return;
  throw std::runtime_error(from.string() + ": is of images of " + std::to_string(width) + "x" +
                           std::to_string(height) + ", and these are of " +
                           std::to_string(images.width) + "x" + std::to_string(images.height));
}

bool isDepthCamera(const std::string& device) {
  return device == "openni" || device.rfind("openni:", 0) == 0 ||
         fs::path(device).extension() == ".oni";
}

void addCapture(CLI::App& app) {
  auto options = std::make_shared<CaptureOptions>();
  CLI::App* verb = app.add_subcommand(
      "capture", "Record from a stereo camera that gives both images at once, or a depth camera");
  verb->footer(
      "Examples:\n"
      "  heel capture 0 --calibration calibration --out recordings/mine\n"
      "  heel capture video.mkv --calibration stereo.yaml --out recordings/mine\n"
      "  heel capture openni --out recordings/mine\n"
      "For stereo cameras that give the left and the right image side by side in one picture, and\n"
      "depth cameras that OpenNI2 has a driver for. Ctrl-C ends it. Stay out of the picture for "
      "the first seconds, then walk in "
      "alone:\n"
      "'heel learn' learns you from that.");
  verb->add_option("DEVICE", options->device,
                   "a stereo camera's number (0 is /dev/video0), its file, or a video; 'openni' or "
                   "'openni:URI', a depth camera, or its recording, an .oni file")
      ->required();
  verb->add_option("--out", options->out, "folder for the recording; must be empty")->required();
  verb->add_option("--calibration", options->calibration,
                   "file or folder that 'heel' reads as a stereo calibration, or a depth camera's "
                   "camera.yaml (default: by its field of view); it is put into the recording");
  verb->add_option("--width", options->width,
                   "of a stereo camera's images together, where the camera can choose [px]")
      ->check(CLI::Range(2, 65536));
  verb->add_option("--height", options->height, "of them, where the camera can choose [px]")
      ->check(CLI::Range(1, 65536));
  verb->add_option("--rate", options->rate_hz, "pictures a second, where the camera can choose")
      ->check(CLI::Range(0.1, 1000.0));
  verb->add_option("--duration", options->duration_s,
                   "end after so long [s] (default: at the video's end, or by Ctrl-C)")
      ->check(CLI::Range(0.01, 1e6));
  verb->callback([options] { run(*options); });
}

}  // namespace heel
