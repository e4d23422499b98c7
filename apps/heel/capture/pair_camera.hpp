// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What `heel capture` records from.
#pragma once

#include <heel/apps/output/output.hpp>

#include <opencv2/core/mat.hpp>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace heel {

struct CaptureOptions {
  std::string device;
  std::filesystem::path out;
  std::filesystem::path calibration;  ///< Empty: none.
  int width = 0, height = 0;          ///< 0: as the camera likes it; so is the rate.
  double rate_hz = 0.0;
  std::optional<double> duration_s;
};

enum class PairKind {
  kStereo,  ///< Left and right.
  kRgbd,    ///< Colour, and depth in its pixels.
};

/// A camera, or a video of one, that gives two pictures of the same moment. What goes wrong is a
/// std::runtime_error with a sentence that names it.
class PairCamera {
 public:
  virtual ~PairCamera() = default;

  virtual PairKind kind() const = 0;

  /// @return false at the end of a video, and where a camera gives no more.
  virtual bool next() = 0;

  /// Copies.
  virtual std::array<cv::Mat, 2> pictures() const = 0;

  /// 0 if nobody knows.
  virtual double length_s() const = 0;

  /// Puts the calibration, if there is one, where readers of a recording look for it; call it after
  /// next().
  virtual void addCalibration(const Output& output) const = 0;

  const std::string& name() const { return name_; }
  bool hasFailed() const { return has_failed_; }  ///< It ended, and should not have.
  double stamp_s() const { return stamp_s_; }     ///< From the first pair on.

 protected:
  explicit PairCamera(std::string name) : name_(std::move(name)) {}

  std::string name_;
  bool has_failed_ = false;
  double stamp_s_ = 0.0;
};

/// @throws std::runtime_error  if the calibration `from` is not for images of that size.
void checkCalibratedSize(const std::filesystem::path& from, int width, int height, cv::Size images);

/// Whether it is called as a camera or a recording of OpenNI2 is.
bool isDepthCamera(const std::string& device);

/// Only where Heel is built with OpenNI2.
std::unique_ptr<PairCamera> openDepthCamera(const CaptureOptions& options);

}  // namespace heel
