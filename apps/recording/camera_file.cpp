// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/camera_file.hpp>
#include <heel/cloud/image_extent.hpp>
#include <heel/cloud/yaml_map.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace heel {
namespace {

Eigen::Isometry3d readTransform(YamlMap& map, const std::string& key) {
  const std::vector<double> values = map.numbers(key, 16);
  Eigen::Isometry3d T;
  T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  constexpr double kRounding = 1e-3;  // a file gives a few decimals
  const Eigen::Matrix3d R = T.linear();
  const bool rigid = (R * R.transpose()).isIdentity(kRounding) && R.determinant() > 0.0 &&
                     T.matrix().row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kRounding);
  if (!rigid) map.fail(key, "is not a rotation and a translation");
  return T;
}

}  // namespace

CameraFile readCameraFile(const std::filesystem::path& file) {
  YamlMap map = YamlMap::fromFile(file, "camera");
  CameraFile out;
  const std::array intrinsics = {"width", "height", "fx", "fy", "cx", "cy"};
  if (std::any_of(intrinsics.begin(), intrinsics.end(),
                  [&](const char* key) { return map.has(key); })) {
    constexpr int kMostPixels = 100000;  // along an edge
    out.camera = PinholeCamera{map.integer("width", 1, kMostPixels),
                               map.integer("height", 1, kMostPixels),
                               map.number("fx", kPositive),
                               map.number("fy", kPositive),
                               map.number("cx"),
                               map.number("cy")};
  }
  if (map.has("depth_scale")) out.depth_scale = map.number("depth_scale", kPositive);
  if (map.has("rate_hz")) out.rate_hz = map.number("rate_hz", kPositive);
  if (map.has("T_ground_camera")) out.T_ground_camera = readTransform(map, "T_ground_camera");
  map.has("baseline_m");  // that 'heel simulate' writes, for whoever reads it
  map.done();
  if (out.camera) checkCameraMemory(file.string(), out.camera->width, out.camera->height);
  return out;
}

}  // namespace heel
