// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A person learned in one light and looked for in another.
#pragma once

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/perception_truth_experiment.hpp>
#include <heel/apps/recording/frame.hpp>

#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace heel {

/// How pictures are altered, in light rather than in grey levels; what was white stays at most
/// white.
struct LightChange {
  double stops = 0.0;             ///< Of exposure.
  double red_against_blue = 0.0;  ///< 0.3: red over blue is 1.3 times what it was; green stays.
};

/// What each grey level of blue, green and red becomes: CV_8UC3, 1 x 256, for changeLight().
cv::Mat levelsAfter(const LightChange& change);

/// @throws std::invalid_argument  if the frame has no image.
void changeLight(Frame& frame, const cv::Mat& levels);

/// -1, 0 and +1 stop, each with red against blue at -30 %, 0 and +30 %.
std::vector<LightChange> changesOfLight();

/// What was found after each of changesOfLight().
using LightRun = std::vector<TargetMetrics>;

/// The recordings of runPerceptionTruthExperiment(): learned in one, looked for in the other,
/// altered.
/// @throws std::runtime_error  as runPerceptionTruthExperiment().
LightRun runLightExperiment(std::uint64_t seed, const PerceptionTruthParams& params);

/// Everybody in a recording with truth.csv, each learned from the first half of the frames in which
/// their place is exact, and found by looks in the second, altered.
/// @throws std::runtime_error  as runTargetsExperiment().
LightRun runLightExperiment(const std::filesystem::path& recording, const ExperimentParams& params);

/// Adds up what recall and wrong-person share are made of.
void add(LightRun& sum, const LightRun& run);

}  // namespace heel
