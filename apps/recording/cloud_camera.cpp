// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/cloud_camera.hpp"

#include <pcl/common/point_tests.h>

#include <cmath>

namespace heel {

namespace {

/// A straight line through (x, y), by least squares.
class LineFit {
 public:
  void add(double x, double y) {
    n_ += 1.0;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
    yy_ += y * y;
  }
  double count() const { return n_; }
  double slope() const { return covariance() / variance(); }
  double offset() const { return (y_ - slope() * x_) / n_; }
  double variance() const { return xx_ / n_ - x_ / n_ * x_ / n_; }
  /// Mean square of what the line leaves of y.
  double residual() const {
    return yy_ / n_ - y_ / n_ * y_ / n_ - covariance() * covariance() / variance();
  }

 private:
  double covariance() const { return xy_ / n_ - x_ / n_ * y_ / n_; }

  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

}  // namespace

std::optional<PinholeCamera> cameraOfCloud(const ColorCloud& cloud) {
  if (!cloud.isOrganized()) return std::nullopt;
  LineFit columns, rows;
  for (std::uint32_t v = 0; v < cloud.height; ++v) {
    for (std::uint32_t u = 0; u < cloud.width; ++u) {
      const auto& p = cloud[std::size_t{v} * cloud.width + u];
      if (!pcl::isFinite(p) || !(p.z > 0.0F)) continue;
      columns.add(double{p.x} / p.z, u);
      rows.add(double{p.y} / p.z, v);
    }
  }
  constexpr double kFewestPoints = 100.0, kWorst_px2 = 1.0;
  if (columns.count() < kFewestPoints) return std::nullopt;
  for (const LineFit* fit : {&columns, &rows}) {
    const bool fits = fit->variance() > 1e-9 && fit->slope() > 0.0 && fit->residual() < kWorst_px2;
    if (!fits) return std::nullopt;
  }
  return PinholeCamera{static_cast<int>(cloud.width),
                       static_cast<int>(cloud.height),
                       columns.slope(),
                       rows.slope(),
                       columns.offset(),
                       rows.offset()};
}

}  // namespace heel
