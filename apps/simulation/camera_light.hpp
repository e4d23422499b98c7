// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a camera makes of the light of the moment: exposure, white balance, gamma, motion blur and
/// the flicker of lamps.
#pragma once

#include <opencv2/core/mat.hpp>

#include <array>
#include <cstdint>

namespace heel {

/// The light of one picture. The default changes nothing.
struct CameraLight {
  double exposure = 1.0;                            ///< Times CameraParams::exposure.
  std::array<float, 3> gains = {1.0F, 1.0F, 1.0F};  ///< Of blue, green and red.
  double blur_px = 0.0;        ///< How far the picture moved sideways while the shutter was open.
  double flicker = 0.0;        ///< Share of the light, in bands of rows that roll.
  double flicker_bands = 0.0;  ///< In a picture.
  double flicker_phase = 0.0;  ///< Of the upper row [rad].
};

/// A camera's light from picture to picture, drawn from a seed.
class DrawnLight {
 public:
  explicit DrawnLight(std::uint64_t seed);

  double gamma() const { return gamma_; }

  /// Has the exposure follow what is in view; white balance and flicker depend on the time alone.
  /// @param signal_per_radiance  At the scene's exposure.
  /// @param radiance    CV_32FC3: what the camera sees now.
  /// @param speed_px_s  Of the picture, sideways.
  CameraLight at(double stamp_s, const cv::Mat& radiance, double signal_per_radiance,
                 double speed_px_s);

 private:
  /// A gain that wanders about one of its own: log gains, as shares of the widest.
  struct Balance {
    double offset = 0.0;
    std::array<double, 2> rate_radps = {};
    std::array<double, 2> phase_rad = {};
  };

  float gainAt(const Balance& balance, double stamp_s) const;
  /// The exposure that the camera would like, if it has `exposure` now.
  double wanted(double exposure, const cv::Mat& radiance, double signal_per_radiance) const;

  double gamma_ = 1.0;
  Balance red_, blue_;
  double roll_radps_ = 0.0;
  double exposure_ = 0.0;  // 0 before the first picture.
  double last_s_ = 0.0;
};

}  // namespace heel
