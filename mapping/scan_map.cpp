// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/mapping/scan_map.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

// A cell is occupied if at least this share of the beams that met it ended in it, ...
constexpr double kOccupiedShare = 0.35;
constexpr std::uint32_t kLeastHits = 2;  // ... and so many.

/// Further away, cells can't be counted in whole numbers.
constexpr double kFurthest_cells = 1e9;

}  // namespace

ScanMap::ScanMap(const ScanMapParams& params) : params_(params) {
  if (!(params.cell_size_m > 0.0) || !(params.max_range_m > 0.0)) {
    throw std::invalid_argument("ScanMap: lengths must be positive");
  }
}

void ScanMap::makeRoom(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  constexpr int kSpare = 40;  // Cells, so that it seldom grows.
  if (!((low.cwiseAbs().cwiseMax(high.cwiseAbs()).array() < kFurthest_cells * params_.cell_size_m))
           .all()) {
    throw std::runtime_error("a scan was taken further away than a map can reach");
  }
  const Eigen::Vector2i first = (low / params_.cell_size_m).array().floor().cast<int>().matrix();
  const Eigen::Vector2i last = (high / params_.cell_size_m).array().floor().cast<int>().matrix();
  const bool empty = counts_.empty();
  if (!empty && (first.array() >= corner_.array()).all() &&
      (last.array() < (corner_ + size_).array()).all()) {
    return;
  }
  Eigen::Vector2i corner = first.array() - kSpare, end = last.array() + (kSpare + 1);
  if (!empty) {
    corner = corner.cwiseMin(corner_);
    end = end.cwiseMax(corner_ + size_);
  }
  const Eigen::Vector2i size = end - corner;
  const std::size_t cells =
      timesAtMost(static_cast<std::size_t>(size.x()), static_cast<std::size_t>(size.y()));
  checkMemory("the map of " + std::to_string(size.x()) + "x" + std::to_string(size.y()) +
                  " cells that the scans span",
              timesAtMost(cells, sizeof(Count)));
  std::vector<Count> counts(cells);
  for (int y = 0; y < size_.y(); ++y) {
    const auto from = counts_.begin() + static_cast<std::ptrdiff_t>(y) * size_.x();
    const auto to = static_cast<std::ptrdiff_t>(y + corner_.y() - corner.y()) * size.x() +
                    (corner_.x() - corner.x());
    std::copy(from, from + size_.x(), counts.begin() + to);
  }
  counts_ = std::move(counts);
  corner_ = corner;
  size_ = size;
}

void ScanMap::countBeam(const Eigen::Vector2d& from, const Eigen::Vector2d& to, bool ended) {
  const auto count = [this](const Eigen::Vector2d& at) -> Count& {
    const Eigen::Vector2i cell =
        (at / params_.cell_size_m).array().floor().cast<int>().matrix() - corner_;
    return counts_[static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(size_.x()) +
                   static_cast<std::size_t>(cell.x())];
  };
  const Eigen::Vector2d way = to - from;
  // Cell by cell along the longer axis (a digital differential analyser).
  const int steps = static_cast<int>(way.cwiseAbs().maxCoeff() / params_.cell_size_m);
  Count* last = ended ? &count(to) : nullptr;
  for (int i = 0; i <= steps; ++i) {
    Count& passed = count(from + way * (static_cast<double>(i) / (steps + 1)));
    if (&passed != last) ++passed.misses;
  }
  if (last != nullptr) ++last->hits;
}

void ScanMap::add(const FloorPose& T_map_scanner, const LaserScan& scan) {
  if (!T_map_scanner.position.allFinite() || !std::isfinite(T_map_scanner.yaw_rad)) return;
  const Eigen::Vector2d& from = T_map_scanner.position;
  double reach_m = 0.0;
  for (const float range : scan.ranges_m) {
    if (range > 0.0F) reach_m = std::max(reach_m, static_cast<double>(range));
  }
  reach_m = std::min(reach_m, params_.max_range_m);
  makeRoom(from.array() - reach_m, from.array() + reach_m);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!std::isfinite(range_m) || range_m <= 0.0) continue;
    const double angle = T_map_scanner.yaw_rad + scan.angle(i);
    if (!std::isfinite(angle)) continue;
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    const bool ended = range_m <= params_.max_range_m;
    countBeam(from, from + std::min(range_m, params_.max_range_m) * along, ended);
  }
}

OccupancyGrid ScanMap::grid() const {
  if (counts_.empty()) throw std::invalid_argument("ScanMap: no scan was added");
  OccupancyGrid grid(corner_.cast<double>() * params_.cell_size_m, params_.cell_size_m, size_.x(),
                     size_.y(), Occupancy::kUnknown);
  for (GridCell c; c.y < grid.height(); ++c.y) {
    for (c.x = 0; c.x < grid.width(); ++c.x) {
      const Count& count = counts_[grid.index(c)];
      const double met = static_cast<double>(count.hits) + static_cast<double>(count.misses);
      if (met == 0.0) continue;
      const bool solid =
          count.hits >= kLeastHits && static_cast<double>(count.hits) >= kOccupiedShare * met;
      grid.at(c) = solid ? Occupancy::kOccupied : Occupancy::kFree;
    }
  }
  return grid;
}

}  // namespace heel
