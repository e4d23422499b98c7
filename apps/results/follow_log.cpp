// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/results/follow_log.hpp>

#include <algorithm>

namespace heel {

bool isWrongPerson(const Eigen::Vector2d& estimate, const std::optional<Eigen::Vector2d>& person,
                   const std::vector<Eigen::Vector2d>& others, double apart_m) {
  const double to_person =
      person ? (estimate - *person).norm() : std::numeric_limits<double>::infinity();
  return to_person > apart_m && std::any_of(others.begin(), others.end(), [&](const auto& other) {
           return (estimate - other).norm() < to_person;
         });
}

std::vector<TargetEvent> targetEvents(const std::vector<FollowSample>& samples,
                                      double tolerance_s) {
  std::vector<TargetEvent> events;
  const FollowSample* last_seen = nullptr;
  bool is_lost = false;
  for (const FollowSample& sample : samples) {
    if (last_seen != nullptr && !is_lost && sample.stamp_s - last_seen->stamp_s > tolerance_s) {
      is_lost = true;
      events.push_back({last_seen->stamp_s, false, *last_seen->target_estimate});
    }
    if (!sample.target_estimate) continue;
    if (is_lost) events.push_back({sample.stamp_s, true, *sample.target_estimate});
    is_lost = false;
    last_seen = &sample;
  }
  return events;
}

}  // namespace heel
