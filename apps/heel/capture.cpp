// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
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
#include <cctype>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr double kMost_s = 1e9;  // What a broken video may claim.

struct CaptureOptions {
  std::string device;
  fs::path out;
  fs::path calibration;  // empty: none
  int width = 0, height = 0;
  double rate_hz = 0.0;
  std::optional<double> duration_s;
};

/// A stereo camera that gives both images side by side, or a video of one.
class SideBySide {
 public:
  explicit SideBySide(const CaptureOptions& options) : name_(options.device) {
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

  /// @return false at the end of a video, and where a camera gives no more.
  bool next() {
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

  const std::string& name() const { return name_; }
  bool hasFailed() const { return has_failed_; }  ///< A camera has no end.
  double stamp_s() const { return stamp_s_; }
  cv::Mat left() const { return both_.colRange(0, both_.cols / 2).clone(); }
  cv::Mat right() const { return both_.colRange(both_.cols / 2, both_.cols).clone(); }
  /// 0 if nobody knows.
  double length_s() const {
    const double rate_hz = camera_.get(cv::CAP_PROP_FPS);
    const double frames = camera_.get(cv::CAP_PROP_FRAME_COUNT);
    return !is_live_ && rate_hz > 0.0 ? std::clamp(frames / rate_hz, 0.0, kMost_s) : 0.0;
  }

 private:
  std::string name_;
  bool is_live_ = false, has_failed_ = false;
  cv::VideoCapture camera_;
  cv::Mat both_;
  std::optional<std::chrono::steady_clock::time_point> began_;
  double stamp_s_ = 0.0;
};

/// Puts the files of a calibration where readers of a recording look for them.
void addCalibration(const fs::path& from, cv::Size image_size, const Output& output) {
  const StereoCamera camera = readStereoRig(from, image_size).camera();
  if (camera.left.width != image_size.width || camera.left.height != image_size.height) {
    throw std::runtime_error(
        from.string() + ": is of images of " + std::to_string(camera.left.width) + "x" +
        std::to_string(camera.left.height) + ", and these are of " +
        std::to_string(image_size.width) + "x" + std::to_string(image_size.height));
  }
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

/// Writes pairs as numbered pictures, one while the next is awaited.
class PairWriter {
 public:
  explicit PairWriter(const Output& output) : output_(output), times_(output / "times.txt") {}
  ~PairWriter() {
    try {
      encoding_.wait();
    } catch (const std::exception&) {
      // Whoever gave up before finish() has been told why.
    }
  }

  void add(const cv::Mat& left, const cv::Mat& right, double stamp_s) {
    encoding_.wait();
    ++count_;
    write("left", left);
    write("right", right);
    char line[40];
    std::snprintf(line, sizeof line, "%.6f\n", stamp_s);
    times_.write(line);
  }
  void finish() {
    encoding_.wait();
    times_.close();
  }
  std::size_t count() const { return count_; }

 private:
  void write(const char* side, const cv::Mat& picture) {
    char name[40];
    std::snprintf(name, sizeof name, "%s/%06zu.png", side, count_);
    encoding_.run([file = output_ / name, picture] { writePicture(file, picture); });
  }

  const Output& output_;
  OutputFile times_;
  tbb::task_group encoding_;
  std::size_t count_ = 0;
};

void run(const CaptureOptions& options) {
  Output output({"capture", OutputKind::kFolder, options.out, {options.calibration}, {}, true});
  std::error_code ignored;
  if (fs::exists(options.out) && !fs::is_empty(options.out, ignored)) {
    throw std::invalid_argument(options.out.string() + ": holds something already");
  }
  SideBySide camera(options);
  keepResultsOnSignals();
  ProgressBar progress("capturing",
                       static_cast<std::size_t>(options.duration_s.value_or(camera.length_s())));
  PairWriter pairs(output);
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
      const cv::Mat left = camera.left();
      if (pairs.count() == 0) {
        size = left.size();
        if (!options.calibration.empty()) addCalibration(options.calibration, size, output);
      }
      pairs.add(left, camera.right(), last_s);
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
  if (options.calibration.empty()) {
    warn(options.out.string() + ": before others can read it, put a stereo calibration there");
  }
  std::printf("%zu pairs of %dx%d over %.1f s; wrote %s\n", pairs.count(), size.width, size.height,
              last_s, output.path().c_str());
  if (camera.hasFailed()) throw std::runtime_error(camera.name() + ": gives no more pictures");
  if (!is_whole) throw Stopped("stopped: " + output.path().string() + " holds what came till then");
}

}  // namespace

void addCapture(CLI::App& app) {
  auto options = std::make_shared<CaptureOptions>();
  CLI::App* verb =
      app.add_subcommand("capture", "Record from a stereo camera that gives both images at once");
  verb->footer(
      "Examples:\n"
      "  heel capture 0 --calibration calibration --out recordings/mine\n"
      "  heel capture video.mkv --calibration stereo.yaml --out recordings/mine\n"
      "For cameras that give the left and the right image side by side in one picture, and videos\n"
      "of them. Ctrl-C ends it. Stay out of the picture for the first seconds, then walk in "
      "alone:\n"
      "'heel learn' learns you from that.");
  verb->add_option("DEVICE", options->device,
                   "the camera's number (0 is /dev/video0), its file, or a video")
      ->required();
  verb->add_option("--out", options->out, "folder for the recording; must be empty")->required();
  verb->add_option("--calibration", options->calibration,
                   "file or folder that 'heel' reads as a stereo calibration; it is put into the "
                   "recording");
  verb->add_option("--width", options->width,
                   "of both images together, where the camera can choose [px]")
      ->check(CLI::Range(2, 65536));
  verb->add_option("--height", options->height, "the same [px]")->check(CLI::Range(1, 65536));
  verb->add_option("--rate", options->rate_hz, "pictures a second, where the camera can choose")
      ->check(CLI::Range(0.1, 1000.0));
  verb->add_option("--duration", options->duration_s,
                   "end after so long [s] (default: at the video's end, or by Ctrl-C)")
      ->check(CLI::Range(0.01, 1e6));
  verb->callback([options] { run(*options); });
}

}  // namespace heel
