// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The paper's Table 1, and many homes more.
#pragma once

#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/results/follow_episodes.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace heel {

struct FollowExperimentParams {
  std::filesystem::path scenes;       ///< Folder of the scenes that come with Heel.
  std::filesystem::path plans;        ///< Folder of the plans.
  bool table1 = true;                 ///< Whether to make the paper's three experiments.
  int episodes = 100;                 ///< Random ones; with our plan.
  std::uint64_t first_seed = 1;       ///< Of the random episodes.
  double limit_s = 600.0;             ///< Of each run.
  std::string rough;                  ///< Of the random ones' world; see roughWorldOf().
  std::optional<RobotConfig> config;  ///< Instead of each scene's robot, and the defaults.
  int threads = 0;                    ///< Runs at a time; 0: as many as the machine has threads.
};

/// The plans that are compared, ours last.
const std::vector<std::string>& experimentPlans();

/// The three experiments in the scene `office`, each with the paper's plan and with ours, then the
/// random episodes. In the first experiment the person is alone; in the others another walks about.
/// A signal that asks for the end leaves out the runs that have not ended.
/// @param done  Told of each run when it has ended, one at a time.
/// @throws std::runtime_error  as loadScene() and loadPlan().
FollowExperiment runFollowExperiment(const FollowExperimentParams& params,
                                     const std::function<void(const FollowEpisode&)>& done = {});

/// Why a run failed, in a few words; empty if it did not.
std::string causeOfFailure(const FollowLog& log, const FollowSummary& summary);

}  // namespace heel
