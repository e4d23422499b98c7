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
constexpr double kCell_m = 0.25;  // Half a person wide.
constexpr double kRange_m = 8.0;  // As far as depth tells bodies apart.
constexpr double kCells = kTorus_m / kCell_m;
constexpr auto kSize = static_cast<std::size_t>(kCells);
static_assert(2.0 * kRange_m <= kTorus_m);

std::size_t wrapped(double cell) {
  const double rest = std::fmod(cell, kCells);
  return static_cast<std::size_t>(rest < 0.0 ? rest + kCells : rest) % kSize;
}

std::size_t cellAt(double x, double y) { return wrapped(y) * kSize + wrapped(x); }

/// The four cells around a place, with their bilinear weights.
template <typename Visitor>
void forCorners(const Eigen::Vector2d& place_m, const Visitor& visit) {
  const Eigen::Array2d cell = place_m.array() / kCell_m - 0.5;
  const Eigen::Array2d first = cell.floor();
  const Eigen::Array2d share = cell - first;
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1, dy = corner >> 1;
    const double weight = (dx ? share.x() : 1.0 - share.x()) * (dy ? share.y() : 1.0 - share.y());
    visit(cellAt(first.x() + dx, first.y() + dy), weight);
  }
}

}  // namespace

ClutterMap::ClutterMap(const ClutterMapParams& params) : params_(params), cells_(kSize * kSize) {
  if (!(params.density_per_m2 > 0.0 && params.prior_s > 0.0)) {
    throw std::invalid_argument("ClutterMapParams: a parameter is out of its range");
  }
}

ClutterDensity ClutterMap::density(const Eigen::Vector2d& place_m, double stamp_s,
                                   const ClutterCount& but) const {
  const double area_m2 = kCell_m * kCell_m;
  double thing_s = params_.prior_s * params_.density_per_m2 * area_m2;
  double person_s = 0.0;
  double seen_s = params_.prior_s;
  forCorners(place_m, [&](std::size_t i, double weight) {
    double its = 0.0;  // Of the body's count, what is in this cell.
    forCorners(but.place_m, [&](std::size_t j, double part) { its += i == j ? part : 0.0; });
    thing_s += weight * std::max(cells_[i].thing_s - its * but.thing_s, 0.0);
    const double stood_s = static_cast<double>(cells_[i].person_s);
    const double stays =
        stood_s > 0.0 ? stood_s / (stood_s + std::max(stamp_s - cells_[i].last_s, 0.0)) : 0.0;
    person_s +=
        weight * stays * std::max(cells_[i].person_s - its * (but.time_s - but.thing_s), 0.0);
    seen_s += weight * std::max(cells_[i].seen_s - its * but.time_s, 0.0);
  });
  return {std::min(thing_s / seen_s, 1.0) / area_m2, person_s / seen_s / area_m2};
}

void ClutterMap::look(const Eigen::Vector2d& from_m, const SightOf& sight_of, double time_s) {
  if (!sight_of || !(time_s > 0.0)) return;
  const Eigen::Array2d first = ((from_m.array() - kRange_m) / kCell_m).floor();
  const int count = static_cast<int>(2.0 * kRange_m / kCell_m) + 1;
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const Eigen::Array2d cell(first.x() + column, first.y() + row);
      const Eigen::Vector2d middle = (cell + 0.5) * kCell_m;
      if ((middle - from_m).squaredNorm() > kRange_m * kRange_m) continue;
      if (sight_of(middle) != Sight::kFree) continue;
      cells_[cellAt(cell.x(), cell.y())].seen_s += static_cast<float>(time_s);
    }
  }
}

void ClutterMap::setClock(double stamp_s) {
  for (Cell& cell : cells_) cell.last_s = stamp_s;
}

void ClutterMap::add(const ClutterCount& count, double stamp_s) {
  forCorners(count.place_m, [&](std::size_t i, double weight) {
    if (!(weight > 0.0)) return;
    cells_[i].last_s = stamp_s;
    cells_[i].thing_s += static_cast<float>(weight * count.thing_s);
    cells_[i].person_s += static_cast<float>(weight * (count.time_s - count.thing_s));
    cells_[i].seen_s += static_cast<float>(weight * count.time_s);
  });
}

}  // namespace heel
