// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the tables of docs/results.md about real people are made with.
#pragma once

#include <heel/apps/follower/learn_person.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/tracking/clear_mot.hpp>
#include <heel/tracking/target_metrics.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace heel {

inline constexpr double kDetectorDistance_m = 0.75;  ///< A detection may be so far from a person.
inline constexpr double kTrackerDistance_m = 0.5;    ///< So far may the target's estimate be.

/// A still camera's recording with truth.csv, whose first seconds are empty.
struct ExperimentParams {
  double background_s = 5.0;                    ///< How long it is empty.
  AppearanceParams appearance = ofWholeBody();  ///< The model that is learned.
};

/// Told before each piece of work that is timed, and after it.
struct WorkTimer {
  std::function<void()> start = [] {};
  std::function<void()> stop = [] {};
};

/// Phase 1 as a detector of everyone in view: the background from the empty frames, people in all
/// the others.
/// @throws std::runtime_error  as openRecording() and readTruth(); so do the others.
ClearMot runDetectorExperiment(const std::filesystem::path& recording,
                               const ExperimentParams& params, const WorkTimer& timer = {});

/// The paper's protocol: the first person to enter is learned while alone, and then followed by
/// appearance.
struct ProtocolResult {
  LearnedPerson learned;
  std::string person;       ///< Whose model it is, by the truth.
  TargetMetrics following;  ///< From when others come into view to the person's last true place.
};
ProtocolResult runProtocolExperiment(const std::filesystem::path& recording,
                                     const ExperimentParams& params);

/// A model followed by appearance alone through all of another recording.
TargetMetrics runFollowingExperiment(const std::filesystem::path& recording,
                                     const AppearanceModel& model, const std::string& person);

/// One person as the target: learned from the first half of the frames where their place is exact,
/// and looked for in all frames from somewhere on; by looks also in those that they are not in.
struct TargetResult {
  std::string person;
  std::filesystem::path learned_in, sought_in;
  TargetMetrics best_blob;  ///< The likeliest blob of each frame by its looks alone; no track.
  TargetMetrics started;    ///< Tracked, started at the person's true place.
  TargetMetrics cold;       ///< Tracked, found by looks.

  void add(const TargetResult& other) {
    best_blob.add(other.best_blob);
    started.add(other.started);
    cold.add(other.cold);
  }
};
/// Everybody in each recording is looked for in the other recordings that they are in; who is in
/// none of these, in the second half of their frames in the same.
std::vector<TargetResult> runTargetsExperiment(const std::vector<std::filesystem::path>& recordings,
                                               const ExperimentParams& params);

}  // namespace heel
