// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/pinhole_fit.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr double kMaxResidual_px = 0.5;

/// Fits y = slope * x + offset.
class LineFit {
 public:
  void add(double x, double y) {
    ++n_;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
    yy_ += y * y;
    least_y_ = std::min(least_y_, y);
    most_y_ = std::max(most_y_, y);
  }
  /// Two points are on a line whatever they are of, and so are any of one row or column.
  bool isDetermined() const { return n_ > 2 && least_y_ < most_y_; }
  double slope() const { return (n_ * xy_ - x_ * y_) / (n_ * xx_ - x_ * x_); }
  double offset() const { return (y_ - slope() * x_) / n_; }
  /// Root mean square of what the line leaves unexplained; NaN if there is no line.
  double residual() const {
    const double covariance = xy_ / n_ - x_ / n_ * (y_ / n_);
    const double spread = yy_ / n_ - y_ / n_ * (y_ / n_);
    return std::sqrt(std::max(0.0, spread - slope() * covariance));
  }

 private:
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
  double least_y_ = std::numeric_limits<double>::infinity(), most_y_ = -least_y_;
};

}  // namespace

std::optional<PinholeCamera> fitPinhole(const ColorCloud& cloud) {
  if (cloud.height < 2) {
    return std::nullopt;
  }
  LineFit across, down;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto& p = cloud[i];
    if (!(p.z > 0.0F) || !std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    across.add(static_cast<double>(p.x) / static_cast<double>(p.z),
               static_cast<double>(i % cloud.width));
    down.add(static_cast<double>(p.y) / static_cast<double>(p.z),
             static_cast<double>(i / cloud.width));
  }
  if (!across.isDetermined() || !down.isDetermined()) return std::nullopt;
  PinholeCamera camera;
  camera.width = static_cast<int>(cloud.width);
  camera.height = static_cast<int>(cloud.height);
  camera.fx = across.slope();
  camera.fy = down.slope();
  camera.cx = across.offset();
  camera.cy = down.offset();
  const bool fits = across.residual() < kMaxResidual_px && down.residual() < kMaxResidual_px &&
                    camera.fx > 0.0 && camera.fy > 0.0;
  return fits ? std::optional(camera) : std::nullopt;
}

}  // namespace heel
