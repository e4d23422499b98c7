// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud/stereo_calibration.hpp"

#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

/// The first of `names` that is there: a file of camera_calibration says `camera_matrix`, an echoed
/// message `K` (ROS 1) or `k` (ROS 2).
YAML::Node find(const YAML::Node& root, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (root[name]) return root[name];
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

cv::Mat readMatrix(const fs::path& file, const YAML::Node& root,
                   std::initializer_list<const char*> names, int rows, int cols) {
  const char* name = *names.begin();
  YAML::Node node = find(root, names);
  if (!node) fail(file, std::string(name) + " is missing");
  if (node.IsMap()) node.reset(node["data"]);
  std::vector<double> values;
  try {
    values = node.as<std::vector<double>>();
  } catch (const YAML::Exception&) {
    fail(file, std::string(name) + " is not a list of numbers");
  }
  if (rows > 0 && values.size() != static_cast<std::size_t>(rows * cols)) {
    fail(file, std::string(name) + " has not " + std::to_string(rows * cols) + " elements");
  }
  if (values.empty()) return {};
  return cv::Mat(values, true).reshape(1, rows > 0 ? rows : 1);
}

struct CameraInfo {
  RawCamera camera;
  cv::Size size;
};

CameraInfo readOne(const fs::path& file) {
  if (!fs::is_regular_file(file)) fail(file, "there is no such file");
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::Exception& error) {
    fail(file, "it is not YAML (line " + std::to_string(error.mark.line + 1) + ")");
  }
  if (!root.IsMap()) fail(file, "it holds no named values");
  CameraInfo info;
  const YAML::Node width = find(root, {"image_width", "width"});
  const YAML::Node height = find(root, {"image_height", "height"});
  if (!width || !height) fail(file, "image_width or image_height is missing");
  try {
    info.size = {width.as<int>(), height.as<int>()};
  } catch (const YAML::Exception&) {
    fail(file, "image_width or image_height is not a number");
  }
  const YAML::Node model = find(root, {"distortion_model"});
  const std::string name = model && model.IsScalar() ? model.Scalar() : "plumb_bob";
  if (name != "plumb_bob" && name != "rational_polynomial" && !name.empty()) {
    fail(file, "the distortion model " + name + " is not known (plumb_bob, rational_polynomial)");
  }
  info.camera.K = readMatrix(file, root, {"camera_matrix", "K", "k"}, 3, 3);
  info.camera.distortion = readMatrix(file, root, {"distortion_coefficients", "D", "d"}, 0, 0);
  info.camera.R = readMatrix(file, root, {"rectification_matrix", "R", "r"}, 3, 3);
  info.camera.P = readMatrix(file, root, {"projection_matrix", "P", "p"}, 3, 4);
  return info;
}

}  // namespace

StereoRig readCameraInfo(const fs::path& left, const fs::path& right) {
  const CameraInfo l = readOne(left), r = readOne(right);
  if (l.size != r.size) fail(right, "its image size is not that of " + left.string());
  return StereoRig(l.camera, r.camera, l.size, right.string());
}

}  // namespace heel
