// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/camera/pair_camera.hpp>
#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/output.hpp>
#include <heel/cloud/files.hpp>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct CaptureOptions {
  PairCameraParams camera;
  fs::path out;
  std::optional<double> duration_s;
};

/// Writes pairs as numbered pictures, one while the next is awaited.
class PairWriter {
 public:
  PairWriter(const Output& output, SensorKind kind) : output_(output) {
    if (kind == SensorKind::kRgbd) sides_ = {"rgb", "depth"};
    if (kind == SensorKind::kStereo) {
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
      encoding_.run([file = output_ / name, picture = pictures.at(i).clone()] {
        writePicture(file, picture);
      });
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
  const bool is_file = fs::is_regular_file(options.camera.device, ignored);
  const fs::path video = is_file ? options.camera.device : "";
  const fs::path& calibration = options.camera.calibration;
  Output output({"capture", OutputKind::kFolder, options.out, {calibration, video}, {}, true});
  if (fs::exists(options.out) && !fs::is_empty(options.out, ignored)) {
    throw std::invalid_argument(options.out.string() + ": holds something already");
  }
  const std::unique_ptr<PairCamera> opened = openPairCamera(options.camera);
  PairCamera& camera = *opened;
  if (!camera.warning().empty()) warn(camera.warning());
  keepResultsOnSignals();
  ProgressBar progress("capturing",
                       static_cast<std::size_t>(options.duration_s.value_or(camera.length_s())));
  PairWriter pairs(output, camera.kind());
  cv::Size size;
  double last_s = 0.0;
  bool has_ended = false;  // by itself: its time is up, or there is no more
  while (!isStopRequested() && !has_ended) {
    if (!camera.next() || camera.stamp_s() > options.duration_s.value_or(camera.stamp_s())) {
      has_ended = true;
    } else {
      last_s = camera.stamp_s();
      const std::array<cv::Mat, 2> pictures = camera.pictures();
      if (pairs.count() == 0) {
        size = pictures[0].size();
        for (const auto& [name, bytes] : camera.calibration().files)
          writeFile(output / name, bytes);
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
  if (camera.leftOut() > 0) {
    warn(std::to_string(camera.leftOut()) + " pictures were left out: their times do not increase");
  }
  if (calibration.empty() && camera.kind() == SensorKind::kStereo) {
    warn(options.out.string() +
         ": before 'heel learn' can read it, put a stereo calibration there");
  }
  std::printf("%zu pairs of %dx%d over %.1f s; wrote %s\n", pairs.count(), size.width, size.height,
              last_s, output.path().c_str());
  if (camera.hasFailed()) throw std::runtime_error(camera.name() + ": gives no more pictures");
  if (!is_whole) throw Stopped("stopped: " + output.path().string() + " holds what came till then");
}

}  // namespace

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
      "depth cameras that OpenNI2 has a driver for. Ctrl-C ends it. Stay out of the picture for\n"
      "the first seconds, then walk in alone: 'heel learn' learns you from that.");
  addCamera(*verb, "DEVICE", options->camera)->required();
  verb->add_option("--out", options->out, "folder for the recording; must be empty")->required();
  verb->add_option("--duration", options->duration_s,
                   "end after so long [s] (default: at the video's end, or by Ctrl-C)")
      ->check(CLI::Range(0.01, 1e6));
  verb->callback([options] { run(*options); });
}

}  // namespace heel
