// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/geodesic.hpp>
#include <heel/planning/grid_wave.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {

GeodesicField::GeodesicField(const OccupancyGrid& map, double radius_m, bool unknown_is_free)
    : map_(map, radius_m + 2.0 * map.cell_size_m(), unknown_is_free),
      wave_(map_, {1, radius_m, 1.0, 0.0}),
      distances_m_(map.cells().size(), GridWave::kFar) {}

void GeodesicField::setObstacles(const std::vector<FloorDisc>& discs, const OccupancyGrid* cells) {
  wave_.mend(map_.setLayer(discs, cells));
}

bool GeodesicField::measureFrom(const Eigen::Vector2d& point, double within_m) {
  if (!point.allFinite()) throw std::invalid_argument("a place to measure from must be finite");
  std::fill(distances_m_.begin(), distances_m_.end(), GridWave::kFar);
  freeCellsNear(map_, wave_, point, within_m, near_);
  seeds_.clear();
  const auto cell_size = static_cast<float>(map_.cell_size_m());
  if (!near_.empty()) {
    const double offset_m = (wave_.placeOf(near_.front()) - point).norm();
    seeds_.push_back({near_.front(), static_cast<float>(offset_m) / cell_size});
  }
  wave_.begin(seeds_);
  wave_.reachAll();
  for (const int cell : wave_.touched()) {
    distances_m_[static_cast<std::size_t>(cell)] = wave_.cost(cell) * cell_size;
  }
  return !seeds_.empty();
}

float GeodesicField::distance(const Eigen::Vector2d& place) const {
  if (!place.allFinite() || !map_.isInside(place)) return GridWave::kFar;
  return distances_m_[static_cast<std::size_t>(map_.cellOf(place))];
}

}  // namespace heel
