// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/laser_gate.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

LaserGate::LaserGate(Clearance clearance, const LaserGateParams& params)
    : clearance_(std::move(clearance)),
      params_(params),
      age_s_(std::numeric_limits<double>::infinity()) {
  if (!clearance_) throw std::invalid_argument("LaserGate: there is no map");
  for (const double value : {params.half_width_m, params.reach_m, params.off_map_m,
                             params.depth_error_pm, params.sigmas, params.max_age_s}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw std::invalid_argument("LaserGate: a parameter must be finite and not negative");
    }
  }
}

void LaserGate::step(const LaserScan* scan, const FloorPose& T_world_scanner, double elapsed_s) {
  age_s_ += elapsed_s;
  if (scan == nullptr) return;
  scan_ = *scan;
  T_world_scanner_ = T_world_scanner;
  age_s_ = 0.0;
}

GateVerdict LaserGate::judge(const Observation& seen) const {
  if (age_s_ > params_.max_age_s) return GateVerdict::kAccepted;
  const Eigen::Vector2d place = T_world_scanner_.inverse() * seen.position_m;
  const double away_m = place.norm();
  const double reach_m =
      params_.reach_m + params_.sigmas * params_.depth_error_pm * away_m * away_m;
  int beams = 0;
  for (std::size_t i = 0; i < scan_.ranges_m.size(); ++i) {
    const Eigen::Vector2d along(std::cos(scan_.angle(i)), std::sin(scan_.angle(i)));
    const double ahead_m = along.dot(place);
    const double aside_m = std::abs(along.x() * place.y() - along.y() * place.x());
    if (ahead_m <= 0.0 || aside_m > params_.half_width_m) continue;
    const auto range_m = static_cast<double>(scan_.ranges_m[i]);
    if (!(range_m > 0.0)) continue;  // NaN too
    if (range_m < ahead_m - reach_m) return GateVerdict::kAccepted;
    const bool ends_there = range_m < ahead_m + reach_m;
    if (ends_there && !(clearance_(T_world_scanner_ * (range_m * along)) <= params_.off_map_m)) {
      return GateVerdict::kAccepted;
    }
    ++beams;
  }
  return beams < params_.least_beams ? GateVerdict::kAccepted : GateVerdict::kNoLegs;
}

}  // namespace heel
