// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 1 from a recording to a model: who to follow (section 2).
#pragma once

#include "apps/follower/acquisition.hpp"
#include "apps/follower/camera_setup.hpp"
#include "apps/recording/recording.hpp"
#include "segmentation/appearance_learner.hpp"
#include "segmentation/appearance_model.hpp"

#include <functional>
#include <vector>

namespace heel {

struct LearnPersonParams {
  AcquisitionParams acquisition;
  AppearanceParams appearance;
  StereoMatcherParams stereo;
};

struct LearnedPerson {
  AppearanceModel model;
  AcquisitionResult acquisition;      ///< On what the model rests, and why it ended.
  std::vector<SkippedFrame> skipped;  ///< Frames that could not be used.
};

/// Told of every frame that was used, to draw it or to show the progress.
using AcquisitionObserver = std::function<void(const Frame&, const AcquisitionStep&)>;

/// Learns the first person who enters, from a recording of a robot that stands still and that has
/// just been opened: the empty scene first, then the person alone.
/// @throws std::runtime_error  with one sentence if no frame could be read, or nobody entered.
LearnedPerson learnPerson(Recording& recording, const CameraSetup& setup,
                          const LearnPersonParams& params = {},
                          const AcquisitionObserver& observer = {});

}  // namespace heel
