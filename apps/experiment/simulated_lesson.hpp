// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 1 on rendered frames.
#pragma once

#include <heel/apps/experiment/model_lessons.hpp>
#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>
#include <heel/apps/follower/acquisition.hpp>

#include <cstdint>
#include <vector>

namespace heel {

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
