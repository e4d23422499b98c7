// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/seen_at.hpp>

namespace heel {

bool isNear(const Eigen::Vector2d& a, const std::optional<Eigen::Vector2d>& b, double distance_m) {
  return b && (a - *b).norm() <= distance_m;
}

double targetProbabilityAt(const Eigen::Vector2d& place, const Perception& perception,
                           double distance_m) {
  double probability = 0.0;
  for (const Track& track : perception.tracks()) {
    const double away_m = (track.motion.position_m() - place).norm();
    if (track.status != TrackStatus::kConfirmed || away_m > distance_m) continue;
    distance_m = away_m;
    probability = perception.identity().targetProbability(track.id);
  }
  return probability;
}

double blobScoreAt(const Eigen::Vector2d& place, const std::vector<Observation>& observations,
                   double distance_m) {
  double score = 0.0;
  for (const Observation& seen : observations) {
    const double away_m = (seen.position_m - place).norm();
    if (away_m > distance_m) continue;
    distance_m = away_m;
    score = seen.score;
  }
  return score;
}

}  // namespace heel
