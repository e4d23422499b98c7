// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/simulation/camera_model.hpp"

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

}  // namespace

PinholeCamera pinholeOf(const CameraParams& params) {
  const double f = params.width / 2.0 / std::tan(params.horizontal_view_rad / 2.0);
  return {params.width, params.height, f, f, (params.width - 1) / 2.0, (params.height - 1) / 2.0};
}

CameraModel::CameraModel(const CameraParams& params, std::uint64_t seed)
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
    display_.push_back(static_cast<std::uint8_t>(std::lround(255.0F * toDisplay(signal))));
    const double shot = params.shot_noise * std::sqrt(signal / 0.5);
    deviation_.push_back(static_cast<float>(std::hypot(params.read_noise, shot) / 255.0));
  }
}

void CameraModel::develop(cv::Mat& radiance, std::uint64_t picture, float gain,
                          cv::Mat& bgr) const {
  if (params_.blur_px > 0.0) {
    const double side = std::exp(-0.5 / (params_.blur_px * params_.blur_px));
    const cv::Matx13f kernel(static_cast<float>(side / (1 + 2 * side)),
                             static_cast<float>(1 / (1 + 2 * side)),
                             static_cast<float>(side / (1 + 2 * side)));
    cv::sepFilter2D(radiance, radiance, -1, kernel, kernel, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  }
  bgr.create(radiance.size(), CV_8UC3);
  tbb::parallel_for(0, bgr.rows, [&](int v) {
    const auto* light = radiance.ptr<float>(v);
    const float* noise = noise_.row(hashOf(picture, static_cast<std::uint64_t>(v)));
    const float* factor = vignette_.data() + static_cast<std::ptrdiff_t>(v) * bgr.cols;
    auto* out = bgr.ptr<std::uint8_t>(v);
    for (int i = 0; i < 3 * bgr.cols; ++i) {
      const float signal = light[i] * factor[i / 3] * gain;
      const float deviation = deviation_[static_cast<std::size_t>(stepOf(signal))];
      out[i] = display_[static_cast<std::size_t>(stepOf(signal + deviation * noise[i]))];
    }
  });
}

}  // namespace heel
