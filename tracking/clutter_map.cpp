// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/clutter_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kTorus_m = 40.0;

std::size_t wrapped(double cell, int size) {
  const double rest = std::fmod(cell, static_cast<double>(size));
  return static_cast<std::size_t>(rest < 0.0 ? rest + size : rest) % static_cast<std::size_t>(size);
}

}  // namespace

ClutterMap::ClutterMap(const ClutterMapParams& params) : params_(params) {
  if (!(params.cell_m >= 0.05 && params.range_m >= 0.0 && params.density_per_m2 > 0.0 &&
        params.prior_s > 0.0 && 2.0 * params.range_m <= kTorus_m)) {
    throw std::invalid_argument("ClutterMapParams: a parameter is out of its range");
  }
  size_ = static_cast<int>(kTorus_m / params.cell_m);
  cells_.resize(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_));
}

/// The four cells around a place, with their bilinear weights.
template <typename Visitor>
void ClutterMap::forCorners(const Eigen::Vector2d& place_m, const Visitor& visit) const {
  const Eigen::Array2d cell = place_m.array() / params_.cell_m - 0.5;
  const Eigen::Array2d first = cell.floor();
  const Eigen::Array2d share = cell - first;
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1, dy = corner >> 1;
    const double weight = (dx ? share.x() : 1.0 - share.x()) * (dy ? share.y() : 1.0 - share.y());
    visit(wrapped(first.y() + dy, size_) * static_cast<std::size_t>(size_) +
              wrapped(first.x() + dx, size_),
          weight);
  }
}

double ClutterMap::density_per_m2(const Eigen::Vector2d& place_m) const {
  const double area_m2 = params_.cell_m * params_.cell_m;
  double occupied_s = params_.prior_s * params_.density_per_m2 * area_m2;
  double seen_s = params_.prior_s;
  forCorners(place_m, [&](std::size_t i, double weight) {
    occupied_s += weight * static_cast<double>(cells_[i].occupied_s);
    seen_s += weight * static_cast<double>(cells_[i].seen_s);
  });
  return std::min(occupied_s / seen_s, 1.0) / area_m2;
}

void ClutterMap::look(const Eigen::Vector2d& from_m, const SightOf& sight_of, double time_s) {
  if (!sight_of || !(time_s > 0.0)) return;
  const Eigen::Array2d first = ((from_m.array() - params_.range_m) / params_.cell_m).floor();
  const int count = static_cast<int>(2.0 * params_.range_m / params_.cell_m) + 1;
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const Eigen::Array2d cell(first.x() + column, first.y() + row);
      const Eigen::Vector2d middle = (cell + 0.5) * params_.cell_m;
      if ((middle - from_m).squaredNorm() > params_.range_m * params_.range_m) continue;
      if (sight_of(middle) != Sight::kFree) continue;
      cells_[wrapped(cell.y(), size_) * static_cast<std::size_t>(size_) + wrapped(cell.x(), size_)]
          .seen_s += static_cast<float>(time_s);
    }
  }
}

void ClutterMap::add(const Eigen::Vector2d& place_m, double probability, double time_s) {
  forCorners(place_m, [&](std::size_t i, double weight) {
    cells_[i].occupied_s += static_cast<float>(weight * probability * time_s);
    cells_[i].seen_s += static_cast<float>(weight * time_s);
  });
}

}  // namespace heel
