// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/laser_gate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

LaserGate::LaserGate(Clearance clearance, const LaserGateParams& params)
    : clearance_(std::move(clearance)), params_(params), age_s_(kInfinite) {
  if (!clearance_) throw std::invalid_argument("LaserGate: there is no map");
  for (const double value :
       {params.half_width_m, params.reach_m, params.off_map_m, params.depth_error_pm, params.sigmas,
        params.max_age_s, params.max_gap_m, params.max_width_m}) {
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
  measureThings();
}

// Runs of neighbouring ends that the map does not show.
void LaserGate::measureThings() {
  const std::size_t count = scan_.ranges_m.size();
  directions_.resize(count);
  ends_m_.resize(count);
  widths_m_.assign(count, kInfinite);
  std::size_t first = 0;  // of the run at hand
  const auto endRun = [&](std::size_t end) {
    if (first < end) {
      const double width_m = (ends_m_[end - 1] - ends_m_[first]).norm();
      std::fill(&widths_m_[first], &widths_m_[first] + (end - first), width_m);
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    const auto range_m = static_cast<double>(scan_.ranges_m[i]);
    const double angle = scan_.angle(i);
    directions_[i] = {std::cos(angle), std::sin(angle)};
    ends_m_[i] = range_m * directions_[i];
    // Also where it is not a number, nowhere, or not known.
    const bool is_unmapped = range_m > 0.0 && std::isfinite(range_m) &&
                             !(clearance_(T_world_scanner_ * ends_m_[i]) <= params_.off_map_m);
    const bool goes_on =
        is_unmapped && first < i && (ends_m_[i] - ends_m_[i - 1]).norm() <= params_.max_gap_m;
    if (!goes_on) {
      endRun(i);
      first = i;
    }
    if (!is_unmapped) first = i + 1;
  }
  endRun(count);
}

GateVerdict LaserGate::judge(const Observation& seen) const {
  if (age_s_ > params_.max_age_s) return GateVerdict::kAccepted;
  const Eigen::Vector2d place = T_world_scanner_.inverse() * seen.position_m;
  const double away_m = place.norm();
  const double reach_m =
      params_.reach_m + params_.sigmas * params_.depth_error_pm * away_m * away_m;
  int beams = 0;
  for (std::size_t i = 0; i < scan_.ranges_m.size(); ++i) {
    const Eigen::Vector2d& along = directions_[i];
    const double ahead_m = along.dot(place);
    const double aside_m = std::abs(along.x() * place.y() - along.y() * place.x());
    if (ahead_m <= 0.0 || aside_m > params_.half_width_m) continue;
    const auto range_m = static_cast<double>(scan_.ranges_m[i]);
    if (!(range_m > 0.0)) continue;  // NaN too
    const bool is_hidden = range_m < ahead_m - reach_m;
    const bool is_person = range_m < ahead_m + reach_m && widths_m_[i] <= params_.max_width_m;
    if (is_hidden || is_person) return GateVerdict::kAccepted;
    ++beams;
  }
  return beams < params_.least_beams ? GateVerdict::kAccepted : GateVerdict::kNoLegs;
}

}  // namespace heel
