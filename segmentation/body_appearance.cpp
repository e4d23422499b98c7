// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_appearance.hpp"

#include "segmentation/body_pixels.hpp"

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

/// Counts of one band, with the prior taken in.
class Coverage {
 public:
  explicit Coverage(double prior_points) : passed_(0.5 * prior_points), seen_(prior_points) {}

  void add(bool passes) {
    seen_ += 1.0;
    passed_ += passes ? 1.0 : 0.0;
  }
  double share() const { return seen_ > 0.0 ? passed_ / seen_ : 0.5; }

 private:
  double passed_;
  double seen_;
};

/// Geometric mean of the shares of the bands that were learned.
template <typename ShareOfBand>
double meanOverBands(const std::vector<AppearanceBand>& bands, const ShareOfBand& share_of) {
  double log_sum = 0.0;
  int learned = 0;
  for (const AppearanceBand& band : bands) {
    if (band.table.empty()) continue;
    log_sum += std::log(std::max(share_of(band), 1e-6));
    ++learned;
  }
  return learned == 0 ? 0.5 : std::exp(log_sum / learned);
}

}  // namespace

bool isInCylinder(const Eigen::Vector3f& p, const Eigen::Vector2d& position_m, const BodyBand& band,
                  double radius_m) {
  const double dx = static_cast<double>(p.x()) - position_m.x();
  const double dy = static_cast<double>(p.y()) - position_m.y();
  return dx * dx + dy * dy <= radius_m * radius_m &&
         static_cast<double>(p.z()) >= band.min_height_m &&
         static_cast<double>(p.z()) <= band.max_height_m;
}

double bodyAppearance(const BodyView& view, const WorldBlob& blob,
                      const std::vector<AppearanceBand>& bands,
                      const BodyAppearanceParams& params) {
  const BodyPixels pixels(view, blob, params);
  return meanOverBands(bands, [&](const AppearanceBand& band) {
    Coverage coverage(params.prior_points);
    pixels.forEach(band.body, [&](const cv::Vec3b& bgr, float, int) {
      coverage.add(band.table.passes(bgr[0], bgr[1], bgr[2]));
    });
    return coverage.share();
  });
}

double bodyAppearance(const ColorCloud& cloud, const WorldBlob& blob,
                      const std::vector<AppearanceBand>& bands,
                      const BodyAppearanceParams& params) {
  return meanOverBands(bands, [&](const AppearanceBand& band) {
    Coverage coverage(params.prior_points);
    for (const auto& p : cloud) {
      if (isInCylinder(p.getVector3fMap(), blob.position_m, band.body, params.radius_m)) {
        coverage.add(band.table.passes(p.b, p.g, p.r));
      }
    }
    return coverage.share();
  });
}

}  // namespace heel
