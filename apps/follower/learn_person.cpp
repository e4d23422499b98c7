// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/learn_person.hpp"

#include "apps/follower/depth_images.hpp"

#include <stdexcept>

namespace heel {
namespace {

/// The points whose pixel is surely the person's.
void pointsOfPerson(const AcquisitionStep& step, pcl::Indices& indices) {
  indices.clear();
  const auto* labels = step.labels.ptr<std::uint8_t>();
  for (const auto i : *step.view->candidates) {
    const std::uint8_t label = labels[i];
    if (label == AcquisitionStep::kTorso || label == AcquisitionStep::kLegs) indices.push_back(i);
  }
}

}  // namespace

LearnedPerson learnPerson(Recording& recording, const CameraSetup& setup,
                          const LearnPersonParams& params, const AcquisitionObserver& observer) {
  DepthImages depths(setup.sensor, setup.camera, params.stereo);
  Acquisition acquisition(setup.camera.left, setup.T_base_camera, params.acquisition);
  AppearanceLearner learner(params.appearance);
  std::vector<SkippedFrame> skipped;
  Frame frame;
  cv::Mat room;
  pcl::Indices person;
  while (acquisition.result().state != AcquisitionState::kEnded && recording.next(frame)) {
    try {
      const AcquisitionStep& step =
          acquisition.step(frame.stamp_s, frame.image_bgr, depths.of(frame));
      if (step.usable) {
        room = step.labels == AcquisitionStep::kScene;
        learner.addRoom(frame.image_bgr, room);
        if (step.person >= 0) {
          pointsOfPerson(step, person);
          learner.addPerson(*step.view->cloud, person);
          learner.addBody(*step.view->cloud,
                          step.view->blobs[static_cast<std::size_t>(step.person)].position_m);
        }
      }
      if (observer) observer(frame, step);
    } catch (const std::invalid_argument& error) {
      skipped.push_back({frame.number, frame.name + ": " + error.what()});
    }
  }
  skipped.insert(skipped.end(), recording.skipped().begin(), recording.skipped().end());
  const AcquisitionResult& result = acquisition.result();
  if (result.empty_frames == 0) throw std::runtime_error(nothingReadMessage(recording, skipped));
  if (result.person_frames < params.acquisition.confirm_frames) {
    const bool several = result.end == AcquisitionEnd::kSecondPerson;
    throw std::runtime_error(
        recording.info().name +
        (several ? ": several people entered together" : ": nobody entered after the empty scene") +
        "; a person model needs about 5 s of the empty room, then one person "
        "for about 10 s");
  }
  return {learner.learn(), result, std::move(skipped)};
}

}  // namespace heel
