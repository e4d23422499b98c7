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

/// What is drawn for a camera in a run. Ranges are those of webcams that set themselves; nothing
/// was chosen on recordings.
struct CameraLightParams {
  double aim = 0.18;       ///< Mean signal that the exposure is set for: photography's mid grey.
  double lag_s = 0.5;      ///< Time constant of the exposure.
  double max_stops = 2.0;  ///< The exposure differs from the scene's by at most so many stops.
  double balance = 0.3;    ///< The gains of red and blue are between 1 / (1 + this) and 1 + this.
  /// Period in which the gains of red and blue wander; drawn within a factor of 2.
  double balance_s = 90.0;
  double gamma = 1.25;      ///< The exponent behind sRGB's curve is between 1 / this and this.
  double shutter_s = 0.02;  ///< How long the shutter is open: what turns meanwhile is blurred.
  /// Flicker of lamps, as a share of the light, in bands of rows that roll.
  double flicker = 0.02;
  /// Bands of flicker in a picture: lamps of 100 Hz, read out within 30 ms.
  double flicker_bands = 3.0;
};

/// The light of one picture. The default changes nothing.
struct CameraLight {
  double exposure = 1.0;                            ///< Times CameraParams::exposure.
  std::array<float, 3> gains = {1.0F, 1.0F, 1.0F};  ///< Of blue, green and red.
  double blur_px = 0.0;        ///< How far the picture moved sideways while the shutter was open.
  double flicker = 0.0;        ///< See CameraLightParams.
  double flicker_bands = 0.0;  ///< The same.
  double flicker_phase = 0.0;  ///< Of the upper row [rad].
};

/// A camera's light from picture to picture, drawn from a seed.
class DrawnLight {
 public:
  DrawnLight(const CameraLightParams& params, std::uint64_t seed);

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

  CameraLightParams params_;
  double gamma_ = 1.0;
  Balance red_, blue_;
  double roll_radps_ = 0.0;
  double exposure_ = 0.0;  // 0 before the first picture.
  double last_s_ = 0.0;
};

}  // namespace heel
