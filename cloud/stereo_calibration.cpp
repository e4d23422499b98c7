// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/stereo_calibration.hpp>

#include <stdexcept>
#include <string>

namespace heel {

namespace fs = std::filesystem;

StereoRig readStereoRig(const fs::path& path, cv::Size image_size) {
  if (!fs::exists(path))
    throw std::runtime_error(path.string() + ": there is no such file or folder");
  if (!fs::is_directory(path)) {
    if (path.extension() == ".txt") return readMiddleburyCalibration(path);
    return readOpenCvCalibration({path}, image_size);
  }
  for (const char* ending : {".yaml", ".yml"}) {
    const auto left = path / (std::string("left") + ending);
    const auto right = path / (std::string("right") + ending);
    if (fs::exists(left) || fs::exists(right)) return readCameraInfo(left, right);
  }
  for (const char* ending : {".yml", ".yaml", ".xml"}) {
    const auto intrinsics = path / (std::string("intrinsics") + ending);
    const auto extrinsics = path / (std::string("extrinsics") + ending);
    if (fs::exists(extrinsics)) return readOpenCvCalibration({intrinsics, extrinsics}, image_size);
  }
  for (const char* name : {"calib", "stereo", "calibration"}) {
    for (const char* ending : {".yaml", ".yml", ".xml", ".json"}) {
      const auto file = path / (std::string(name) + ending);
      if (fs::exists(file)) return readOpenCvCalibration({file}, image_size);
    }
  }
  if (fs::exists(path / "calib.txt")) return readMiddleburyCalibration(path / "calib.txt");
  throw std::runtime_error(
      path.string() +
      ": it holds no calibration (left.yaml and right.yaml, calib.yaml, stereo.yaml, calib.txt)");
}

}  // namespace heel
