// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/camera_file.hpp>
#include <heel/apps/recording/clouds/pcd_file.hpp>
#include <heel/apps/recording/folders/indexed_recording.hpp>
#include <heel/apps/recording/folders/pcd_recording.hpp>
#include <heel/apps/recording/stamps.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

namespace {

bool isPcdName(const fs::path& file) { return file.extension() == ".pcd"; }

}  // namespace

bool PcdRecording::fits(const fs::path& path) {
  return fs::is_directory(path) ? !filesIn(path, isPcdName).empty() : isPcdName(path);
}

std::unique_ptr<IndexedRecording> PcdRecording::open(const fs::path& path,
                                                     const RecordingParams& params) {
  RecordingInfo info;
  info.layout = kLayout;
  info.sensor = SensorKind::kCloud;
  if (!fs::is_directory(path)) {
    checkPcd(path);  // one file that is of no use is an error at once
    info.nominal_stamps = true;
    return std::unique_ptr<IndexedRecording>(
        new PcdRecording(path, std::move(info), {0.0}, {path}));
  }

  double rate_hz = params.nominal_rate_hz;
  if (fs::exists(path / "camera.yaml")) {
    const CameraFile camera = readCameraFile(path / "camera.yaml");
    if (camera.camera) info.camera.left = *camera.camera;
    if (camera.rate_hz) rate_hz = *camera.rate_hz;
    info.T_base_camera = camera.T_ground_camera;
  }
  auto files = filesIn(path, isPcdName);
  auto stamps_s = stampsOfFiles(path / "times.txt", files, rate_hz, info.nominal_stamps);
  return std::unique_ptr<IndexedRecording>(
      new PcdRecording(path, std::move(info), std::move(stamps_s), std::move(files)));
}

PcdRecording::PcdRecording(const std::filesystem::path& path, RecordingInfo info,
                           std::vector<double> stamps_s, std::vector<fs::path> files)
    : IndexedRecording(path, std::move(info), std::move(stamps_s)), files_(std::move(files)) {}

std::string PcdRecording::frameName(std::size_t index) const { return files_[index].string(); }

void PcdRecording::read(std::size_t index, Frame& frame) {
  frame.right_bgr.release();
  frame.depth_m.release();
  frame.cloud.reset();
  const auto cloud = pcl::make_shared<ColorCloud>(readPcd(files_[index]).cloud);
  if (cloud->isOrganized()) {
    colorsOf(*cloud, frame.image_bgr);
  } else {
    frame.image_bgr.release();
  }
  frame.cloud = cloud;
}

}  // namespace heel
