// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/camera_file.hpp>
#include <heel/cloud/file_limits.hpp>
#include <heel/cloud/image_extent.hpp>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {

namespace {

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file.string()) {
    checkIsFile(file);
    try {
      root_ = YAML::LoadFile(file_);
    } catch (const YAML::BadFile&) {
      throw std::runtime_error(file_ + " cannot be read");
    } catch (const YAML::Exception& error) {
      throw std::runtime_error(file_ + " is not YAML: line " + std::to_string(error.mark.line + 1) +
                               ", " + error.msg);
    }
    if (!root_.IsMap()) fail("holds no settings of the form 'name: value'");
    for (const auto& entry : root_) {
      const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "a list";
      if (std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end()) continue;
      fail("has the key '" + key + "', which is unknown; there are " + allKeys());
    }
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(file_ + " " + why);
  }

  bool has(const std::string& key) const { return root_[key].IsDefined(); }

  double number(const std::string& key) const {
    if (!has(key)) fail("has no '" + key + "'");
    double value = 0.0;
    if (!YAML::convert<double>::decode(root_[key], value) || !std::isfinite(value)) {
      fail("has a '" + key + "' that is not a number");
    }
    return value;
  }

  double positive(const std::string& key) const {
    const double value = number(key);
    if (value <= 0.0) fail("has a '" + key + "' that is not above 0");
    return value;
  }

  int positiveInt(const std::string& key) const {
    const double value = positive(key);
    if (value != std::floor(value) || value > 1e5) fail("has a '" + key + "' that is no size");
    return static_cast<int>(value);
  }

  Eigen::Isometry3d transform(const std::string& key) const {
    const YAML::Node node = root_[key];
    std::vector<double> values;
    for (std::size_t i = 0; node.IsSequence() && i < node.size(); ++i) {
      values.emplace_back();
      if (!YAML::convert<double>::decode(node[i], values.back())) values.clear();
    }
    if (values.size() != 16) fail("has a '" + key + "' that is not a list of 16 numbers");
    Eigen::Isometry3d T;
    T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    constexpr double kRounding = 1e-3;  // a file gives a few decimals
    const Eigen::Matrix3d R = T.linear();
    const bool rigid = T.matrix().allFinite() && (R * R.transpose()).isIdentity(kRounding) &&
                       R.determinant() > 0.0 &&
                       T.matrix().row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), kRounding);
    if (!rigid) fail("has a '" + key + "' that is not a rotation and a translation");
    return T;
  }

 private:
  static constexpr std::array kKeys = {
      "width",   "height",          "fx",        "fy", "cx", "cy", "depth_scale",
      "rate_hz", "T_ground_camera", "baseline_m"};  // that 'heel simulate' writes, for whoever
                                                    // reads it

  static std::string allKeys() {
    std::string all;
    for (const char* key : kKeys) all += (all.empty() ? "" : ", ") + std::string(key);
    return all;
  }

  std::string file_;
  YAML::Node root_;
};

}  // namespace

CameraFile readCameraFile(const std::filesystem::path& file) {
  const Reader reader(file);
  CameraFile out;
  const std::array intrinsics = {"width", "height", "fx", "fy", "cx", "cy"};
  if (std::any_of(intrinsics.begin(), intrinsics.end(),
                  [&](const char* key) { return reader.has(key); })) {
    out.camera = PinholeCamera{reader.positiveInt("width"), reader.positiveInt("height"),
                               reader.positive("fx"),       reader.positive("fy"),
                               reader.number("cx"),         reader.number("cy")};
  }
  if (out.camera) checkCameraMemory(file.string(), out.camera->width, out.camera->height);
  if (reader.has("depth_scale")) out.depth_scale = reader.positive("depth_scale");
  if (reader.has("rate_hz")) out.rate_hz = reader.positive("rate_hz");
  if (reader.has("T_ground_camera")) out.T_ground_camera = reader.transform("T_ground_camera");
  return out;
}

}  // namespace heel
