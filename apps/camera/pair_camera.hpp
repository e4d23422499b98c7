// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Cameras that are on: stereo cameras and depth cameras.
#pragma once

#include <heel/apps/recording/camera_file.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/cloud/stereo_rig.hpp>

#include <opencv2/core/mat.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace heel {

constexpr double kLongestVideo_s = 1e9;  ///< A broken one may claim more.

/// Which camera, and what is asked of it; 0: as the camera likes it.
struct PairCameraParams {
  std::string device;                 ///< See openPairCamera().
  std::filesystem::path calibration;  ///< A file or a folder; empty: none.
  int width = 0, height = 0;          ///< Of a stereo camera's images together [px].
  double rate_hz = 0.0;
};

/// How a camera sees.
struct PairCalibration {
  std::optional<StereoRig> rig;              ///< Of a stereo camera.
  CameraFile file;                           ///< Of a depth camera; of all: the mounting.
  std::map<std::string, std::string> files;  ///< What a recording holds of it: name to contents.
};

/// A camera, or a video of one, that gives two pictures of the same moment. What goes wrong is a
/// std::runtime_error with a sentence that names it.
class PairCamera {
 public:
  virtual ~PairCamera() = default;

  const std::string& name() const { return name_; }
  SensorKind kind() const { return kind_; }                ///< kStereo or kRgbd.
  bool isLive() const { return is_live_; }                 ///< A video is not.
  const std::string& warning() const { return warning_; }  ///< For users, a sentence; or empty.

  /// Goes on to the next pair; those whose times do not increase are left out.
  /// @return false at the end of a video, and where a camera gives no more.
  bool next();

  bool hasFailed() const { return has_failed_; }  ///< It ended, and should not have.
  double stamp_s() const { return last_s_; }      ///< From the first pair on.
  std::size_t leftOut() const { return left_out_; }

  /// Left and right, or colour (BGR) and depth in its pixels (CV_16UC1, millimetres); valid until
  /// next().
  virtual std::array<cv::Mat, 2> pictures() const = 0;

  /// 0 if nobody knows.
  virtual double length_s() const = 0;

  /// Call it after next(). Of a stereo camera without a calibration it is empty.
  virtual PairCalibration calibration() const = 0;

 protected:
  PairCamera(std::string name, SensorKind kind) : name_(std::move(name)), kind_(kind) {}

  /// Takes the next pair, and its stamp_s_; false as next().
  virtual bool read() = 0;

  std::string name_;
  SensorKind kind_;
  std::string warning_;
  bool is_live_ = false;
  bool has_failed_ = false;
  double stamp_s_ = 0.0;

 private:
  double last_s_ = -1.0;
  std::size_t left_out_ = 0;
};

/// Opens "0" or "/dev/video0", a stereo camera that gives both images side by side in one picture;
/// a video of one; "openni" or "openni:URI", a depth camera of OpenNI2; or its recording, an .oni.
std::unique_ptr<PairCamera> openPairCamera(const PairCameraParams& params);

/// As openPairCamera(), of one kind each.
std::unique_ptr<PairCamera> openSideBySide(const PairCameraParams& params);
std::unique_ptr<PairCamera> openDepthCamera(const PairCameraParams& params);

/// @throws std::runtime_error  if the calibration `from` is not for images of that size.
void checkCalibratedSize(const std::filesystem::path& from, int width, int height, cv::Size images);

}  // namespace heel
