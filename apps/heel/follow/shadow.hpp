// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The whole follower on a log: what it would have done, beside what the robot did.
#pragma once

#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/segmentation/appearance_model.hpp>

#include <filesystem>
#include <limits>
#include <optional>

namespace heel {

struct ShadowParams {
  std::filesystem::path recording;  ///< With camera, laser scans and odometry.
  RecordingParams opening;
  LogMap map;                            ///< Without one, places are in the odometry's frame.
  RobotConfig config;                    ///< Camera and scanner are where the log says.
  std::optional<AppearanceModel> model;  ///< Else the log begins with phase 1.
  double limit_s = std::numeric_limits<double>::infinity();  ///< It ends here, whatever comes.
};

/// Gives the follower a log's readings, at each moment in which camera or laser measured. Its
/// commands move nothing, so what it would have done is to be judged from moment to moment: had it
/// driven, it would have been elsewhere later.
///
/// Of the samples, `robot_true` is the log's reference on the map where it has one, else the
/// estimate; `speed_true` is what the robot did, by odometry; `person_distance_m` is that of the
/// estimate; the truth of people and of contacts is not known. The outcome is "end of log", or as
/// in runClosedLoop().
/// @throws std::runtime_error  one sentence, if the log lacks camera, scans or odometry.
FollowLog runShadow(const ShadowParams& params, const PetriPlan& plan, const LoopObserver& observer,
                    const Follower::StageDone& stage_done);

}  // namespace heel
