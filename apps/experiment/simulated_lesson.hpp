// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 1 on rendered frames.
#pragma once

#include "apps/experiment/model_lessons.hpp"
#include "apps/experiment/simulated_frames.hpp"
#include "apps/follower/acquisition.hpp"

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

}  // namespace heel
