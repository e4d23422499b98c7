// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The perception against exact truth, pixel by pixel and place by place.
#pragma once

#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>
#include <heel/apps/follower/learn_person.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/tracking/clear_mot.hpp>
#include <heel/tracking/target_metrics.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace heel {

/// A person is learned in one room and followed by looks in another, while a second one walks about
/// there too: in every fifth recording the one in nearly the same top, else one in another.
struct PerceptionTruthParams {
  double empty_s = 5.0;
  double person_s = 6.0;
  double follow_s = 10.0;
  AppearanceParams appearance = ofWholeBody();
  PerceptionParams perception;
  std::filesystem::path scenes;  ///< Folder of the scenes that come with Heel.
};

/// A person who was learned, and a recording of them and another to look for them in.
struct PerceptionTrial {
  bool similar = false;  ///< Whether the other wears nearly the same top.
  AppearanceModel model;
  SimulatedFrames recording;
};

/// Deterministic by seed.
/// @throws std::runtime_error  as loadScene(), or if nothing of the person could be learned.
PerceptionTrial makePerceptionTrial(std::uint64_t seed, const PerceptionTruthParams& params);

/// Pixels that a stage lets pass, against the instance mask, over all frames.
struct PixelCount {
  std::int64_t passed = 0;     ///< Anywhere,
  std::int64_t on_target = 0;  ///< of these on the target, whatever their height.
  std::int64_t wanted = 0;     ///< The target's, at the heights that the model knows,
  std::int64_t found = 0;      ///< of these passed.

  double precision() const;
  double recall() const;
  void add(const PixelCount& other);
};

/// What one recording gave.
struct PerceptionTruthRun {
  std::uint64_t seed = 0;
  bool similar = false;  ///< Whether the other wears nearly the same top.
  PixelCount filter;     ///< The colour filter's mask.
  PixelCount standing;   ///< With depth and height too.
  TargetMetrics target;
  ClearMot mot;  ///< Of the target's estimate, its track's number as its identity.
};

/// Deterministic by seed. The pairs are matched by the perception itself, where its mask says.
/// @throws std::runtime_error  as makePerceptionTrial().
PerceptionTruthRun runPerceptionTruthExperiment(std::uint64_t seed,
                                                const PerceptionTruthParams& params);

/// All runs as one; the target's delays and duration add up too.
PerceptionTruthRun sumOf(const std::vector<PerceptionTruthRun>& runs);

}  // namespace heel
