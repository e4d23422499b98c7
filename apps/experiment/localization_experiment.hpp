// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Localization against exact truth: a simulated robot roams a flat in which people walk.
#pragma once

#include <heel/apps/simulation/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace heel {

/// One robot's time in the flat.
struct LocalizationRun {
  std::uint64_t seed = 0;
  double duration_s = 0.0;
  double way_m = 0.0;
  double rms_m = 0.0;  ///< Of the estimates that were not said to be lost; so the others.
  double rms_rad = 0.0;
  double worst_m = 0.0;
  double lost_share = 0.0;   ///< Of all estimates.
  double wrong_share = 0.0;  ///< Of all estimates: not right, and not said to be lost.
  double consistency = 0.0;  ///< Mean of squared error by covariance; 3 if that is honest.
  double mean_particles = 0.0;
  std::optional<double> noticed_s;  ///< Kidnapped: after this time it was said to be lost.
  std::optional<double> right_s;    ///< Right from here to the end, and not said to be lost.
};

/// The robot starts at a pose that is known up to 0.2 m and 0.1 rad.
LocalizationRun runTracking(const Scene& scene, std::uint64_t seed);

/// The robot starts anywhere and is not told where.
LocalizationRun runGlobalStart(const Scene& scene, std::uint64_t seed);

/// The robot is tracked and then carried elsewhere (2 m away or more) without its wheels noticing.
/// Times and errors count from then.
LocalizationRun runKidnapped(const Scene& scene, std::uint64_t seed);

}  // namespace heel
