// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/laser_bodies.hpp>
#include <heel/apps/follower/param_checks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {
namespace {

constexpr double kSurfaceGap_m = 0.1;  // Between the legs of who stands there is more, as a rule.
constexpr int kLeastBeams = 3;         // that go through a place, for it to be free

}  // namespace

LaserBodies::LaserBodies(const LaserBodiesParams& params)
    : params_(params),
      T_scanner_world_(Eigen::Isometry2d::Identity()),
      age_s_(std::numeric_limits<double>::infinity()) {
  requireNotNegative("LaserBodiesParams",
                     {params.off_map_m, params.max_range_m, params.max_gap_m, params.max_width_m,
                      params.max_surface_m, params.pair_m, params.sigma_m, params.half_width_m,
                      params.reach_m, params.max_age_s});
}

// Runs of neighbouring ends that the map does not show.
void LaserBodies::step(const LaserScan* scan, const FloorPose& T_world_scanner,
                       const Clearance& clearance, double elapsed_s) {
  age_s_ += elapsed_s;
  if (scan == nullptr) return;
  scan_ = *scan;
  const Eigen::Isometry2d T =
      Eigen::Translation2d(T_world_scanner.position) * Eigen::Rotation2Dd(T_world_scanner.yaw_rad);
  T_scanner_world_ = T.inverse();
  age_s_ = 0.0;
  const std::size_t count = scan_.ranges_m.size();
  ends_m_.resize(count);
  may_be_person_.assign(count, false);
  bodies_.clear();
  std::size_t first = 0;  // of the run at hand
  for (std::size_t i = 0; i < count; ++i) {
    const auto range_m = static_cast<double>(scan_.ranges_m[i]);
    const double angle = scan_.angle(i);
    ends_m_[i] = T * Eigen::Vector2d(range_m * std::cos(angle), range_m * std::sin(angle));
    // False, too, where it is not a number, nowhere, or not known.
    const bool is_unmapped =
        range_m > 0.0 && range_m < params_.max_range_m && clearance(ends_m_[i]) > params_.off_map_m;
    const bool goes_on =
        is_unmapped && first < i && (ends_m_[i] - ends_m_[i - 1]).norm() <= params_.max_gap_m;
    if (!goes_on) {
      endRun(first, i);
      first = is_unmapped ? i : i + 1;
    }
  }
  endRun(first, count);
}

void LaserBodies::endRun(std::size_t first, std::size_t end) {
  if (end < first + 2 || (ends_m_[end - 1] - ends_m_[first]).norm() > params_.max_width_m) return;
  if (widestSurface(first, end) > params_.max_surface_m) return;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t i = first; i < end; ++i) {
    middle += ends_m_[i];
    may_be_person_[i] = true;
  }
  const auto score = static_cast<double>(end - first);
  middle /= score;
  for (Observation& other : bodies_) {
    if ((other.position_m - middle).norm() > params_.pair_m) continue;
    other.position_m = (other.score * other.position_m + score * middle) / (other.score + score);
    other.score += score;
    return;
  }
  Observation& body = bodies_.emplace_back();
  body.position_m = middle;
  body.score = score;
  body.covariance_m2 = Eigen::Matrix2d::Identity() * (params_.sigma_m * params_.sigma_m);
}

double LaserBodies::widestSurface(std::size_t first, std::size_t end) const {
  double widest_m = 0.0;
  std::size_t begin = first;
  for (std::size_t i = first + 1; i < end; ++i) {
    if ((ends_m_[i] - ends_m_[i - 1]).norm() > kSurfaceGap_m) begin = i;
    widest_m = std::max(widest_m, (ends_m_[i] - ends_m_[begin]).norm());
  }
  return widest_m;
}

Sight LaserBodies::sightOf(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d place = T_scanner_world_ * place_m;
  const double away_m = place.norm();
  if (away_m < params_.half_width_m || away_m > params_.max_range_m || scan_.step_rad == 0.0) {
    return Sight::kUnknown;
  }
  const double half_rad = std::asin(params_.half_width_m / away_m);
  const double beams_each_side = half_rad / std::abs(scan_.step_rad);
  const double middle = scan_.beamAt(std::atan2(place.y(), place.x()));
  int through = 0;
  bool is_hidden = false, is_thing = false;
  for (double b = std::ceil(middle - beams_each_side); b <= middle + beams_each_side; ++b) {
    const std::size_t i = scan_.index(b);
    if (i >= scan_.ranges_m.size()) continue;
    const auto range_m = static_cast<double>(scan_.ranges_m[i]);
    if (!(range_m > 0.0)) continue;  // NaN too
    const double behind_m = range_m - away_m * std::cos((b - middle) * scan_.step_rad);
    if (std::abs(behind_m) < params_.reach_m && may_be_person_[i]) {
      return Sight::kUnknown;
    }
    is_hidden = is_hidden || behind_m < -params_.reach_m;
    is_thing = is_thing || behind_m < 0.0;
    ++through;
  }
  if (is_hidden) return Sight::kHidden;
  if (is_thing) return Sight::kThing;
  return through >= kLeastBeams ? Sight::kFree : Sight::kUnknown;
}

}  // namespace heel
