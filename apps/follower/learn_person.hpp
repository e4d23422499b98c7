// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 1 from a recording to a model: who to follow (section 2).
#pragma once

#include <heel/apps/follower/acquisition.hpp>
#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/segmentation/appearance_learner.hpp>
#include <heel/segmentation/appearance_model.hpp>

#include <functional>
#include <vector>

namespace heel {

inline AppearanceParams ofWholeBody() {
  AppearanceParams params;
  params.bands = wholeBody();
  return params;
}

/// How phase 1 looks, and what it learns.
struct LearnPersonParams {
  AcquisitionParams acquisition;
  AppearanceParams appearance = ofWholeBody();
  StereoMatcherParams stereo;
};

/// Phase 1 as a stream: give frames until it is done, then ask for the model.
class PersonLearner {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit PersonLearner(const CameraSetup& setup, const LearnPersonParams& params = {});

  /// Takes the next frame of a robot that stands still; after the end, frames are ignored.
  /// @throws std::invalid_argument  if the frame's images do not fit, or its stamp runs backwards;
  ///                                the frame is then as if it had not been given.
  const AcquisitionStep& step(const Frame& frame);

  bool isDone() const { return acquisition_.result().state == AcquisitionState::kEnded; }
  const AcquisitionResult& result() const { return acquisition_.result(); }

  /// Whether somebody was seen for long enough to have a model.
  bool hasPerson() const;

  /// @throws std::logic_error  without a person.
  AppearanceModel learn() const;

 private:
  LearnPersonParams params_;
  DepthImages depths_;
  Acquisition acquisition_;
  AppearanceLearner learner_;
  cv::Mat room_;
  pcl::Indices person_;
};

/// Whom phase 1 found.
struct LearnedPerson {
  AppearanceModel model;
  AcquisitionResult acquisition;      ///< On what the model rests, and why it ended.
  std::vector<SkippedFrame> skipped;  ///< Frames that could not be used.
};

/// What a lesson in a room that was not empty is worth; see AcquisitionResult::was_empty.
inline constexpr const char* kWasNotEmpty =
    "something moved in the first seconds, in which the room must be empty: who was there then is "
    "taken for the room";

/// Told of every frame that was used, to draw it or to show the progress.
using AcquisitionObserver = std::function<void(const Frame&, const AcquisitionStep&)>;

/// Learns the first person who enters, from a recording of a robot that stands still and that has
/// just been opened: the empty scene first, then the person alone.
/// @throws std::runtime_error  with one sentence if no frame could be read, or nobody entered.
LearnedPerson learnPerson(Recording& recording, const CameraSetup& setup,
                          const LearnPersonParams& params = {},
                          const AcquisitionObserver& observer = {});

}  // namespace heel
