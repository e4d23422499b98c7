// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/track.hpp>

#include <stdexcept>
#include <string>

namespace heel {
namespace {

void require(bool holds, const char* what) {
  if (!holds) {
    throw std::invalid_argument(std::string("TrackerParams: ") + what);
  }
}

}  // namespace

void checkParams(const TrackerParams& p) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const auto probability = [](double value) { return value > 0.0 && value < 1.0; };
  require(positive(p.motion.acceleration_density), "acceleration_density must be positive");
  require(p.motion.velocity_memory_s > 0.0, "velocity_memory_s must be positive");
  require(positive(p.position_sigma_m), "position_sigma_m must be positive");
  require(positive(p.start_speed_sigma_mps), "start_speed_sigma_mps must be positive");
  require(probability(p.gate_prob), "gate_prob must be between 0 and 1");
  require(p.max_speed_mps >= 0.0, "max_speed_mps must not be negative");
  require(p.slack_m > 0.0, "slack_m must be positive");
  require(probability(p.detection_prob), "detection_prob must be between 0 and 1");
  require(positive(p.new_density_per_m2), "new_density_per_m2 must be positive");
  require(std::isfinite(p.score_weight) && p.score_weight >= 0.0,
          "score_weight must not be negative");
  require(std::isfinite(p.birth_clearance_m) && p.birth_clearance_m >= 0.0,
          "birth_clearance_m must not be negative");
  require(p.confirm_hits >= 1 && p.confirm_hits <= p.confirm_frames,
          "confirm_hits must be between 1 and confirm_frames");
  require(p.confirm_frames <= 32, "confirm_frames must be at most 32");
  require(positive(p.max_coast_s), "max_coast_s must be positive");
  require(positive(p.max_gap_s), "max_gap_s must be positive");
}

const char* toText(TrackStatus status) {
  switch (status) {
    case TrackStatus::kTentative:
      return "tentative";
    case TrackStatus::kConfirmed:
      return "confirmed";
    case TrackStatus::kCoasting:
      return "coasting";
  }
  return "unknown";
}

}  // namespace heel
