// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/people_around.hpp"

#include "apps/follower/param_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace heel {

TrackerParams PeopleAroundParams::defaultTracker() {
  TrackerParams params;
  params.position_sigma_m = 0.08;
  params.max_coast_s = 0.6;
  params.birth_clearance_m = 0.3;
  return params;
}

PeopleAround::PeopleAround(const PeopleAroundParams& params)
    : params_(params), tracker_(params.tracker) {
  requireNotNegative(
      "PeopleAroundParams",
      {params.off_map_m, params.max_range_m, params.max_gap_m, params.max_size_m, params.pair_m,
       params.stride_m, params.rests_after_s, params.stays_s, params.thing_after_s,
       params.thing_within_m, params.person_radius_m, params.max_speed_mps});
}

void PeopleAround::step(double stamp_s, const LaserScan& scan, const FloorPose& T_world_scanner,
                        const Clearance& clearance) {
  findThings(scan, T_world_scanner, clearance);
  tracker_.step(stamp_s, things_);
  people_.clear();
  walkers_.clear();
  for (const Track& track : tracker_.tracks()) {
    const double rests_s = restsFor_s(track, stamp_s);
    if (track.status == TrackStatus::kTentative || rests_s > params_.stays_s) continue;
    if (isThing(track.motion.position_m())) continue;
    MovingPerson person{track.motion.position_m(), track.motion.velocity_mps(),
                        params_.person_radius_m};
    const bool walks =
        rests_s < params_.rests_after_s && person.velocity.norm() <= params_.max_speed_mps;
    if (!walks) person.velocity.setZero();
    people_.push_back(person);
    if (hasWalked(track)) walkers_.push_back(track.id);
  }
}

bool PeopleAround::hasWalked(const Track& track) const {
  return std::any_of(strides_.begin(), strides_.end(),
                     [&](const Stride& s) { return s.track_id == track.id && s.walked; });
}

void PeopleAround::confirm(const Eigen::Vector2d& place_m, double within_m) {
  const int id = nearest(place_m, within_m);
  const auto stride = std::find_if(strides_.begin(), strides_.end(),
                                   [&](const Stride& s) { return s.track_id == id; });
  if (stride == strides_.end()) return;
  // As if they had just come to rest.
  stride->stamp_s = std::max(stride->stamp_s, stride->since_s - params_.rests_after_s);
  const Eigen::Vector2d legs_m = find(id)->motion.position_m();
  const auto is_theirs = [&](const Eigen::Vector2d& thing) {
    return (thing - legs_m).norm() < params_.thing_within_m;
  };
  standing_m_.erase(std::remove_if(standing_m_.begin(), standing_m_.end(), is_theirs),
                    standing_m_.end());
}

int PeopleAround::nearest(const Eigen::Vector2d& place_m, double within_m) const {
  int id = 0;
  for (const Track& track : tracker_.tracks()) {
    const double away_m = (track.motion.position_m() - place_m).norm();
    if (track.status == TrackStatus::kTentative || away_m > within_m) continue;
    within_m = away_m;
    id = track.id;
  }
  return id;
}

bool PeopleAround::hasOtherNear(int id, double within_m) const {
  const Track* track = find(id);
  if (track == nullptr) return false;
  const std::vector<Track>& all = tracker_.tracks();
  return std::any_of(all.begin(), all.end(), [&](const Track& other) {
    return other.id != id && other.status != TrackStatus::kTentative &&
           (other.motion.position_m() - track->motion.position_m()).norm() < within_m;
  });
}

double PeopleAround::restsFor_s(const Track& track, double stamp_s) {
  const Eigen::Vector2d place_m = track.motion.position_m();
  const auto stride = std::find_if(strides_.begin(), strides_.end(),
                                   [&](const Stride& s) { return s.track_id == track.id; });
  if (stride == strides_.end()) {
    const auto ended = [this](const Stride& s) {
      return tracker_.findTrack(s.track_id) == nullptr;
    };
    strides_.erase(std::remove_if(strides_.begin(), strides_.end(), ended), strides_.end());
    strides_.push_back(
        {track.id, stamp_s, place_m, stamp_s, -std::numeric_limits<double>::infinity()});
    return std::numeric_limits<double>::infinity();
  }
  const bool is_stride = (place_m - stride->place_m).norm() > params_.stride_m;
  if (is_stride) {
    stride->stamp_s = stamp_s;
    stride->walked = true;
  }
  if (is_stride || stamp_s - stride->since_s > params_.rests_after_s) {
    stride->place_m = place_m;
    stride->since_s = stamp_s;
  }
  const double rests_s = stamp_s - stride->stamp_s;
  const bool stood = std::isinf(rests_s) && stamp_s - stride->born_s > params_.thing_after_s;
  if (stood && !isThing(place_m)) standing_m_.push_back(place_m);
  return rests_s;
}

bool PeopleAround::isThing(const Eigen::Vector2d& place_m) const {
  return std::any_of(standing_m_.begin(), standing_m_.end(), [&](const Eigen::Vector2d& thing) {
    return (thing - place_m).norm() < params_.thing_within_m;
  });
}

// Runs of neighbouring ends that the map does not show.
void PeopleAround::findThings(const LaserScan& scan, const FloorPose& T_world_scanner,
                              const Clearance& clearance) {
  things_.clear();
  ends_.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = static_cast<double>(scan.ranges_m[i]);
    if (!(range > 0.0 && range < params_.max_range_m)) continue;  // NaN too
    const double angle = scan.angle(i);
    const Eigen::Vector2d end =
        T_world_scanner * Eigen::Vector2d(range * std::cos(angle), range * std::sin(angle));
    const double off_map_m = clearance(end);
    if (!(off_map_m > params_.off_map_m)) continue;
    if (!ends_.empty() && (end - ends_.back()).norm() > params_.max_gap_m) {
      addThing(ends_);
      ends_.clear();
    }
    ends_.push_back(end);
  }
  addThing(ends_);
}

void PeopleAround::addThing(const std::vector<Eigen::Vector2d>& ends) {
  if (ends.size() < 2 || (ends.front() - ends.back()).norm() > params_.max_size_m) return;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& end : ends) middle += end;
  middle /= static_cast<double>(ends.size());
  const auto score = static_cast<double>(ends.size());
  for (Observation& other : things_) {
    if ((other.position_m - middle).norm() > params_.pair_m) continue;
    other.position_m = (other.score * other.position_m + score * middle) / (other.score + score);
    other.score += score;
    return;
  }
  Observation thing;
  thing.position_m = middle;
  thing.score = score;
  things_.push_back(thing);
}

}  // namespace heel
