// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Recordings that are rendered straight into memory, with their truth, and what one teaches.
#pragma once

#include <heel/apps/experiment/offered_models.hpp>
#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/follower/acquisition.hpp>
#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/recording/frame.hpp>
#include <heel/apps/simulation/scene.hpp>
#include <heel/cloud/stereo_params.hpp>
#include <heel/tracking/geometric_gate.hpp>
#include <heel/tracking/target.hpp>
#include <heel/tracking/target_metrics.hpp>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace heel {

/// A frame, and what is true of it.
struct SimulatedFrame {
  Frame frame;
  cv::Mat true_depth_m;  ///< CV_32FC1 of the left image.
  cv::Mat people;        ///< CV_8UC1: 0, or 1 + the number of the person in the scene.
  /// Where everyone of the scene is, in the robot's base frame; none: not in view.
  std::vector<std::optional<Eigen::Vector2d>> people_m;
};

/// What is true of the scene's first person as the target, and where they are said to be.
TargetFrame targetFrame(const SimulatedFrame& now, const TargetEstimate& estimate);

/// An estimate further from the true place of a person is not of them.
inline constexpr double kPlaceError_m = 0.5;

/// What is rendered.
struct SimulatedFramesParams {
  double from_s = 0.0;  ///< The world lives before, but is not rendered.
  double to_s = 6.0;    ///< The last frame comes before.
  std::uint64_t seed = 1;
};

/// A robot that stands still and looks.
struct SimulatedFrames {
  CameraSetup setup;
  GeometricGate gate;  ///< What the map says, see wallGate().
  std::vector<SimulatedFrame> frames;
};

/// Renders at the camera's rate. Deterministic.
SimulatedFrames renderFrames(const Scene& scene, const SimulatedFramesParams& params);

/// Matches every pair once, all over, so that the frames count as an RGB-D camera's: cheaper where
/// many models look at the same recording. Matching only where a mask says gives the same.
void matchStereo(SimulatedFrames& recording, const StereoMatcherParams& params);

struct SimulatedLesson {
  ModelLessons lessons;
  AcquisitionResult result;
};

/// Lets an acquisition see recordings, one after the other, whose pairs have been matched.
SimulatedLesson takeLesson(const std::vector<const SimulatedFrames*>& recordings,
                           const std::vector<OfferedModel>& models, double empty_s,
                           double person_s);

/// So long people take into view.
inline constexpr double kEnters_s = 1.2;

/// Phase 1 in the wardrobe's learning room: the model of a person who comes in.
/// @param seed  Of the recording's ways and noise.
/// @throws std::runtime_error  if nothing of the person could be learned.
AppearanceModel learnInWardrobe(const WardrobeRooms& rooms, const ScenePerson& person,
                                const AppearanceParams& appearance,
                                const StereoMatcherParams& stereo, double empty_s, double person_s,
                                std::uint64_t seed);

}  // namespace heel
