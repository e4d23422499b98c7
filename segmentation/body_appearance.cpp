// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_appearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace heel {
namespace {

// The coarse grid that spares most points the comparison with each blob. It is a torus: what lies
// further than its edge apart may share a cell, which costs time but is not wrong.
constexpr int kGridSide = 64;
constexpr float kCellsPerM = 4.0F;
constexpr float kFarM = 1e6F;  // beyond it nothing is looked up, nor is what is not a number

int cellAlong(float x_m) {
  return static_cast<int>(std::floor(x_m * kCellsPerM)) & (kGridSide - 1);
}

std::size_t cellOf(float x_m, float y_m) {
  return static_cast<std::size_t>(cellAlong(x_m) * kGridSide + cellAlong(y_m));
}

}  // namespace

BodyAppearance::BodyAppearance(const AppearanceModel& model, const BodyAppearanceParams& params)
    : params_(params), near_(static_cast<std::size_t>(kGridSide) * kGridSide) {
  if (!(params.radius_m > 0.0 && params.radius_m < 2.0 && params.prior_points > 0.0)) {
    throw std::invalid_argument("a body's radius must be in (0, 2) m, and the prior positive");
  }
  for (const AppearanceBand& band : model.bands()) {
    if (!band.table.empty()) bands_.push_back({band.body, band.table});
  }
}

void BodyAppearance::score(const ColorCloud& cloud, std::vector<WorldBlob>& blobs) {
  markCells(blobs);
  shares_.assign(blobs.size() * bands_.size(), Share{});
  const auto radius2 = static_cast<float>(params_.radius_m * params_.radius_m);
  for (const pcl::PointXYZRGB& p : cloud) {
    if (!(std::fabs(p.x) < kFarM && std::fabs(p.y) < kFarM)) continue;
    if (near_[cellOf(p.x, p.y)] == 0) continue;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
      const float dx = p.x - static_cast<float>(blobs[i].position_m.x());
      const float dy = p.y - static_cast<float>(blobs[i].position_m.y());
      if (dx * dx + dy * dy >= radius2) continue;
      for (std::size_t k = 0; k < bands_.size(); ++k) {
        if (!bands_[k].body.contains(p.z)) continue;
        Share& share = shares_[i * bands_.size() + k];
        ++share.points;
        if (bands_[k].table.passes(p.b, p.g, p.r)) ++share.passing;
      }
    }
  }
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    double log_sum = 0.0;
    for (std::size_t k = 0; k < bands_.size(); ++k) {
      const Share& share = shares_[i * bands_.size() + k];
      log_sum += std::log((share.passing + params_.prior_points) /
                          (share.points + 2.0 * params_.prior_points));
    }
    blobs[i].appearance = std::exp(log_sum / static_cast<double>(bands_.size()));
  }
}

void BodyAppearance::markCells(const std::vector<WorldBlob>& blobs) {
  std::fill(near_.begin(), near_.end(), std::uint8_t{0});
  const auto reach = static_cast<float>(params_.radius_m);
  for (const WorldBlob& blob : blobs) {
    const auto x = static_cast<float>(blob.position_m.x());
    const auto y = static_cast<float>(blob.position_m.y());
    const int rows = static_cast<int>(std::floor((x + reach) * kCellsPerM)) -
                     static_cast<int>(std::floor((x - reach) * kCellsPerM));
    const int columns = static_cast<int>(std::floor((y + reach) * kCellsPerM)) -
                        static_cast<int>(std::floor((y - reach) * kCellsPerM));
    for (int i = 0; i <= rows; ++i) {
      for (int j = 0; j <= columns; ++j) {
        const int row = (cellAlong(x - reach) + i) & (kGridSide - 1);
        const int column = (cellAlong(y - reach) + j) & (kGridSide - 1);
        near_[static_cast<std::size_t>(row * kGridSide + column)] = 1;
      }
    }
  }
}

}  // namespace heel
