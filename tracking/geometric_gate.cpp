// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/geometric_gate.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {

const char* toText(GateVerdict verdict) {
  switch (verdict) {
    case GateVerdict::kAccepted:
      return "accepted";
    case GateVerdict::kNotFinite:
      return "not a number";
    case GateVerdict::kTooClose:
      return "too close";
    case GateVerdict::kOutOfBounds:
      return "out of bounds";
    case GateVerdict::kBehindWall:
      return "behind a wall";
    case GateVerdict::kInsideWall:
      return "inside a wall";
  }
  return "unknown";
}

GeometricGate tooClose(double distance_m) {
  if (!std::isfinite(distance_m) || distance_m < 0.0) {
    throw std::invalid_argument("tooClose: the distance must be finite and not negative");
  }
  return [distance_m](const Observation& observation, const Viewpoint& viewpoint) {
    return (observation.position_m - viewpoint.position_m).norm() < distance_m
               ? GateVerdict::kTooClose
               : GateVerdict::kAccepted;
  };
}

GeometricGate insideBounds(const Eigen::Vector2d& lowest_m, const Eigen::Vector2d& highest_m) {
  if (!(lowest_m.array() < highest_m.array()).all()) {
    throw std::invalid_argument("insideBounds: the lowest corner must be under the highest");
  }
  return [lowest_m, highest_m](const Observation& observation, const Viewpoint&) {
    const auto place = observation.position_m.array();
    return (place >= lowest_m.array()).all() && (place <= highest_m.array()).all()
               ? GateVerdict::kAccepted
               : GateVerdict::kOutOfBounds;
  };
}

GeometricGate allOf(std::vector<GeometricGate> gates) {
  return [gates = std::move(gates)](const Observation& observation, const Viewpoint& viewpoint) {
    for (const GeometricGate& gate : gates) {
      if (!gate) {
        continue;
      }
      const GateVerdict verdict = gate(observation, viewpoint);
      if (verdict != GateVerdict::kAccepted) {
        return verdict;
      }
    }
    return GateVerdict::kAccepted;
  };
}

}  // namespace heel
