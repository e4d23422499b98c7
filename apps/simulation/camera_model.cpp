// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/camera_model.hpp>
#include <heel/cloud/ground_plane.hpp>

#include <opencv2/imgproc.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

constexpr int kSteps = 4096;

int stepOf(float signal) {
  return static_cast<int>(std::clamp(signal, 0.0F, 1.0F) * static_cast<float>(kSteps - 1) + 0.5F);
}

PinholeCamera centred(int width, int height, double view_rad) {
  const double f = width / 2.0 / std::tan(view_rad / 2.0);
  return {width, height, f, f, (width - 1) / 2.0, (height - 1) / 2.0};
}

/// Three taps of a Gaussian.
cv::Mat_<float> lensBlur(double sigma_px) {
  const double side = sigma_px > 0.0 ? std::exp(-0.5 / (sigma_px * sigma_px)) : 0.0;
  return (cv::Mat_<float>(1, 3) << static_cast<float>(side / (1 + 2 * side)),
          static_cast<float>(1 / (1 + 2 * side)), static_cast<float>(side / (1 + 2 * side)));
}

/// A kernel and what moves by `way_px` past it; a pixel averages over one anyway.
cv::Mat_<float> widened(const cv::Mat_<float>& kernel, double way_px) {
  if (way_px <= 1.0) return kernel;
  const int reach = static_cast<int>(std::ceil(way_px / 2.0 - 0.5));
  cv::Mat_<float> result(1, kernel.cols + 2 * reach, 0.0F);
  for (int k = -reach; k <= reach; ++k) {
    const double covered = std::min(k + 0.5, way_px / 2.0) - std::max(k - 0.5, -way_px / 2.0);
    for (int i = 0; i < kernel.cols; ++i) {
      result(0, k + reach + i) += kernel(0, i) * static_cast<float>(covered / way_px);
    }
  }
  return result;
}

/// The share of its light that a row gets, `down` from 0 at the top to 1.
float rowGain(const CameraLight& light, double down) {
  const double phase = 2.0 * M_PI * light.flicker_bands * down + light.flicker_phase;
  return static_cast<float>(light.exposure * (1.0 + light.flicker * std::sin(phase)));
}

}  // namespace

PinholeCamera pinholeOf(const CameraParams& params) {
  return centred(params.width, params.height, params.horizontal_view_rad);
}

PinholeCamera pinholeOf(const FloorCameraParams& params) {
  return centred(params.width, params.height, params.horizontal_view_rad);
}

Eigen::Isometry3d mountedCamera(const Eigen::Vector3d& at, double pitch_rad) {
  Eigen::Isometry3d T = baseFromCamera({at.z(), pitch_rad, 0.0});
  T.translation() = at;
  return T;
}

CameraModel::CameraModel(const CameraParams& params, std::uint64_t seed, double gamma)
    : params_(params), noise_(seed) {
  const PinholeCamera camera = pinholeOf(params);
  const double corner = std::hypot(camera.cx, camera.cy);
  for (int v = 0; v < params.height; ++v) {
    for (int u = 0; u < params.width; ++u) {
      const double r = std::hypot(u - camera.cx, v - camera.cy) / corner;
      vignette_.push_back(static_cast<float>(params.exposure * (1.0 - params.vignetting * r * r)));
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    const float signal = static_cast<float>(i) / static_cast<float>(kSteps - 1);
    display_.push_back(static_cast<std::uint8_t>(
        std::lround(255.0F * std::pow(toDisplay(signal), static_cast<float>(gamma)))));
    const double shot = params.shot_noise * std::sqrt(signal / 0.5);
    deviation_.push_back(static_cast<float>(std::hypot(params.read_noise, shot) / 255.0));
  }
}

void CameraModel::develop(cv::Mat& radiance, std::uint64_t picture, float gain,
                          const CameraLight& light, cv::Mat& bgr) const {
  if (params_.blur_px > 0.0 || light.blur_px > 1.0) {
    const cv::Mat_<float> lens = lensBlur(params_.blur_px);
    cv::sepFilter2D(radiance, radiance, -1, widened(lens, light.blur_px), lens, {-1, -1}, 0.0,
                    cv::BORDER_REPLICATE);
  }
  bgr.create(radiance.size(), CV_8UC3);
  tbb::parallel_for(0, bgr.rows, [&](int v) {
    const auto* in = radiance.ptr<float>(v);
    const float* noise = noise_.row(hashOf(picture, static_cast<std::uint64_t>(v)));
    const float* factor = vignette_.data() + static_cast<std::ptrdiff_t>(v) * bgr.cols;
    const float row_gain = gain * rowGain(light, static_cast<double>(v) / bgr.rows);
    auto* out = bgr.ptr<std::uint8_t>(v);
    for (int u = 0, i = 0; u < bgr.cols; ++u) {
      for (const float balance : light.gains) {
        const float signal = in[i] * factor[u] * row_gain;
        const float deviation = deviation_[static_cast<std::size_t>(stepOf(signal))];
        const float read = balance * (signal + deviation * noise[i]);
        out[i++] = display_[static_cast<std::size_t>(stepOf(read))];
      }
    }
  });
}

}  // namespace heel
