// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/camera_file.hpp>
#include <heel/apps/recording/folders/rgbd_recording.hpp>

#include <stdexcept>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

bool RgbdRecording::fits(const fs::path& folder) {
  return fs::exists(folder / "rgb.txt") || fs::exists(folder / "depth.txt");
}

std::unique_ptr<IndexedRecording> RgbdRecording::open(const fs::path& folder,
                                                      const RecordingParams& params) {
  const auto colors = readStampedFiles(folder / "rgb.txt");
  const auto depths = readStampedFiles(folder / "depth.txt");

  const fs::path camera_path = folder / "camera.yaml";
  if (!fs::exists(camera_path)) {
    throw std::runtime_error(
        camera_path.string() +
        " is missing: write one with width, height, fx, fy, cx, cy and depth_scale (for the TUM "
        "benchmark 640, 480, 525.0, 525.0, 319.5, 239.5 and 5000)");
  }
  const CameraFile camera = readCameraFile(camera_path);
  if (!camera.camera) throw std::runtime_error(camera_path.string() + " has no 'width'");
  if (!camera.depth_scale) throw std::runtime_error(camera_path.string() + " has no 'depth_scale'");

  RecordingInfo info;
  info.layout = kLayout;
  info.sensor = SensorKind::kRgbd;
  info.camera.left = *camera.camera;
  info.T_base_camera = camera.T_ground_camera;

  const auto nearest = nearestInTime(colors, depths, params.max_stamp_difference_s);
  std::vector<double> stamps_s(colors.size());
  std::vector<Pair> pairs(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    stamps_s[i] = colors[i].stamp_s;
    pairs[i].color = colors[i].path;
    if (nearest[i]) pairs[i].depth = depths[*nearest[i]].path;
  }
  return std::unique_ptr<IndexedRecording>(
      new RgbdRecording(folder, std::move(info), std::move(stamps_s), std::move(pairs),
                        *camera.depth_scale, params.max_stamp_difference_s));
}

RgbdRecording::RgbdRecording(const std::filesystem::path& path, RecordingInfo info,
                             std::vector<double> stamps_s, std::vector<Pair> pairs,
                             double depth_scale, double max_stamp_difference_s)
    : IndexedRecording(path, std::move(info), std::move(stamps_s)),
      pairs_(std::move(pairs)),
      depth_scale_(depth_scale),
      max_stamp_difference_s_(max_stamp_difference_s) {}

std::string RgbdRecording::frameName(std::size_t index) const {
  return pairs_[index].color.string();
}

void RgbdRecording::read(std::size_t index, Frame& frame) {
  const Pair& pair = pairs_[index];
  if (!pair.depth) {
    throw std::runtime_error(pair.color.string() + ": there is no depth image within " +
                             std::to_string(max_stamp_difference_s_) + " s of it");
  }
  frame.right_bgr.release();
  frame.cloud.reset();
  const PinholeCamera& camera = info_.camera.left;
  reader_.readColor(pair.color, frame.image_bgr);
  checkImageSize(pair.color, frame.image_bgr, camera.width, camera.height, "camera.yaml");
  reader_.readDepth(*pair.depth, depth_scale_, frame.depth_m);
  checkImageSize(*pair.depth, frame.depth_m, camera.width, camera.height, "camera.yaml");
}

}  // namespace heel
