// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/trails.hpp>

#include <algorithm>

namespace heel {

void Trails::add(int track_id, double stamp_s, const Eigen::Vector2d& position_m) {
  places_[track_id].push_back({stamp_s, position_m});
}

void Trails::forget(double now_s) {
  for (auto track = places_.begin(); track != places_.end();) {
    auto& places = track->second;
    const auto young = std::find_if(places.begin(), places.end(), [&](const Place& place) {
      return place.stamp_s >= now_s - duration_s_;
    });
    places.erase(places.begin(), young);
    track = places.empty() ? places_.erase(track) : std::next(track);
  }
}

std::vector<Eigen::Vector2d> Trails::of(int track_id) const {
  std::vector<Eigen::Vector2d> trail_m;
  const auto track = places_.find(track_id);
  if (track == places_.end()) return trail_m;
  for (const auto& place : track->second) trail_m.push_back(place.position_m);
  return trail_m;
}

}  // namespace heel
