// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_recording.hpp>
#include <heel/apps/recording/folders/pcd_recording.hpp>
#include <heel/apps/recording/folders/rgbd_recording.hpp>
#include <heel/apps/recording/folders/stereo_recording.hpp>
#include <heel/apps/recording/recording.hpp>

#include <stdexcept>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

namespace {

std::unique_ptr<IndexedRecording> openFiles(const fs::path& path, const RecordingParams& params) {
  if (!fs::is_directory(path)) {
    if (PcdRecording::fits(path)) return PcdRecording::open(path, params);
    throw std::runtime_error(
        path.string() +
        " is neither a folder, nor a PCD file (.pcd), nor a bag (.bag, .db3, .mcap)");
  }
  if (RgbdRecording::fits(path)) return RgbdRecording::open(path, params);
  if (StereoRecording::fits(path)) return StereoRecording::open(path, params);
  if (PcdRecording::fits(path)) return PcdRecording::open(path, params);
  throw std::runtime_error(
      path.string() +
      " holds no recording of a known layout, which are: an RGB-D folder in the TUM layout "
      "(rgb.txt, depth.txt, camera.yaml), stereo images (left/ and right/, image_0/ and image_1/, "
      "cam0/ and cam1/, left*.png and right*.png, or im0.png and im1.png; with calib.yaml, "
      "left.yaml and right.yaml, or calib.txt), PCD files (*.pcd), ROS 2 bags (*.db3, *.mcap), and "
      "the pieces of a ROS 1 bag (*.bag, and nothing else)");
}

}  // namespace

std::unique_ptr<Recording> openRecording(const fs::path& path, const RecordingParams& params) {
  if (!(params.max_stamp_difference_s > 0.0) || !(params.nominal_rate_hz > 0.0)) {
    throw std::invalid_argument("openRecording: the stamps' difference and rate must be above 0");
  }
  if (!(params.span.from_s >= 0.0) || !(params.span.to_s > params.span.from_s)) {
    throw std::invalid_argument("the part of " + path.string() +
                                " that is read must begin at 0 s or later, and end after that");
  }
  if (!fs::exists(path)) throw std::runtime_error(path.string() + " does not exist");
  if (isBag(path)) return BagRecording::open(path, params);
  auto recording = openFiles(path, params);
  recording->limitTo(params.span);
  return recording;
}

std::string nothingReadMessage(const Recording& recording) {
  return nothingReadMessage(recording, recording.skipped());
}

std::string nothingReadMessage(const Recording& recording,
                               const std::vector<SkippedFrame>& skipped) {
  const std::size_t frames = recording.info().frame_count;
  std::string message =
      frames == 1 ? "the only frame" : "none of the " + std::to_string(frames) + " frames";
  message += " of " + recording.info().name + " could " + (frames == 1 ? "not " : "") + "be read";
  if (!skipped.empty()) message += "; the first: " + skipped.front().reason;
  return message;
}

std::string leftOutNote(const std::vector<SkippedFrame>& skipped, const char* before) {
  if (skipped.empty()) return {};
  return before + std::to_string(skipped.size()) +
         (skipped.size() == 1 ? " frame was left out: " : " frames were left out, the first: ") +
         skipped.front().reason;
}

}  // namespace heel
