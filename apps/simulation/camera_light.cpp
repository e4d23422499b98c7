// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/camera_light.hpp>
#include <heel/apps/simulation/random.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

// Ranges are those of webcams that set themselves; nothing was chosen on recordings.
constexpr double kAim = 0.18;   // Mean signal that the exposure is set for: photography's mid grey.
constexpr double kLag_s = 0.5;  // Time constant of the exposure.
constexpr double kMaxStops = 2.0;  // The exposure is at most so many stops off the scene's.
constexpr double kBalance = 0.3;   // Red's and blue's gains are within 1 / (1 + this) and 1 + this.
constexpr double kBalance_s = 90.0;  // Period in which they wander; drawn within a factor of 2.
constexpr double kGamma = 1.25;  // The exponent behind sRGB's curve is between 1 / this and this.
constexpr double kShutter_s = 0.02;  // How long it is open: what turns meanwhile is blurred.
constexpr double kFlicker = 0.02;  // Of lamps, as a share of the light, in bands of rows that roll.
constexpr double kFlickerBands = 3.0;  // In a picture: lamps of 100 Hz, read out within 30 ms.

constexpr double kTurn_rad = 2.0 * M_PI;
constexpr int kMeterStep = 4;  // Every fourth pixel of every fourth row is metered.

/// Mean signal of the pixels that the meter looks at; what is too bright counts as white.
double metered(const cv::Mat& radiance, double signal_per_radiance) {
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < radiance.rows; v += kMeterStep) {
    const auto* row = radiance.ptr<cv::Vec3f>(v);
    for (int u = 0; u < radiance.cols; u += kMeterStep, ++count) {
      const double mean = (row[u][0] + row[u][1] + row[u][2]) / 3.0;
      sum += std::min(mean * signal_per_radiance, 1.0);
    }
  }
  return sum / count;
}

}  // namespace

DrawnLight::DrawnLight(std::uint64_t seed) {
  RandomStream random(seed);
  gamma_ = std::pow(kGamma, random.uniform(-1.0, 1.0));
  for (Balance* balance : {&red_, &blue_}) {
    balance->offset = random.uniform(-0.5, 0.5);
    for (std::size_t i = 0; i < 2; ++i) {
      balance->rate_radps[i] = kTurn_rad / kBalance_s * std::exp2(random.uniform(-1.0, 1.0));
      balance->phase_rad[i] = random.uniform(0.0, kTurn_rad);
    }
  }
  roll_radps_ = random.uniform(-kTurn_rad, kTurn_rad);
}

float DrawnLight::gainAt(const Balance& balance, double stamp_s) const {
  double share = balance.offset;
  for (std::size_t i = 0; i < 2; ++i) {
    share += 0.25 * std::sin(balance.rate_radps[i] * stamp_s + balance.phase_rad[i]);
  }
  return static_cast<float>(std::pow(1.0 + kBalance, share));
}

double DrawnLight::wanted(double exposure, const cv::Mat& radiance,
                          double signal_per_radiance) const {
  const double most = std::exp2(kMaxStops);
  const double mean = metered(radiance, signal_per_radiance * exposure);
  return std::clamp(exposure * kAim / std::max(mean, 1e-6), 1.0 / most, most);
}

CameraLight DrawnLight::at(double stamp_s, const cv::Mat& radiance, double signal_per_radiance,
                           double speed_px_s) {
  if (exposure_ == 0.0) {  // The camera has been on for a while.
    exposure_ = 1.0;
    for (int i = 0; i < 20; ++i) exposure_ = wanted(exposure_, radiance, signal_per_radiance);
  } else {
    const double share = 1.0 - std::exp((last_s_ - stamp_s) / kLag_s);
    exposure_ *= std::pow(wanted(exposure_, radiance, signal_per_radiance) / exposure_, share);
  }
  last_s_ = stamp_s;
  CameraLight light;
  light.exposure = exposure_;
  light.gains = {gainAt(blue_, stamp_s), 1.0F, gainAt(red_, stamp_s)};
  light.blur_px = std::abs(speed_px_s) * kShutter_s;
  light.flicker = kFlicker;
  light.flicker_bands = kFlickerBands;
  light.flicker_phase = roll_radps_ * stamp_s;
  return light;
}

}  // namespace heel
