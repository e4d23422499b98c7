// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/learn_person.hpp>

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

PersonLearner::PersonLearner(const CameraSetup& setup, const LearnPersonParams& params)
    : params_(params),
      depths_(setup.sensor, setup.camera, params.stereo),
      acquisition_(setup.camera.left, setup.T_base_camera, params.acquisition),
      learner_(params.appearance) {}

const AcquisitionStep& PersonLearner::step(const Frame& frame) {
  const AcquisitionStep& step =
      acquisition_.step(frame.stamp_s, frame.image_bgr, depths_.of(frame));
  if (!step.usable) return step;
  room_ = step.labels == AcquisitionStep::kScene;
  learner_.addRoom(frame.image_bgr, room_);
  if (step.person >= 0) {
    pointsOfPerson(step, person_);
    learner_.addPerson(*step.view->cloud, person_);
    learner_.addBody(*step.view->cloud, person_,
                     step.view->blobs[static_cast<std::size_t>(step.person)].position_m);
  }
  return step;
}

bool PersonLearner::hasPerson() const {
  return result().person_frames >= params_.acquisition.confirm_frames;
}

AppearanceModel PersonLearner::learn() const {
  if (!hasPerson()) throw std::logic_error("PersonLearner: nobody was seen");
  return learner_.learn();
}

LearnedPerson learnPerson(Recording& recording, const CameraSetup& setup,
                          const LearnPersonParams& params, const AcquisitionObserver& observer) {
  PersonLearner learner(setup, params);
  std::vector<SkippedFrame> skipped;
  Frame frame;
  while (!learner.isDone() && recording.next(frame)) {
    try {
      const AcquisitionStep& step = learner.step(frame);
      if (observer) observer(frame, step);
    } catch (const std::invalid_argument& error) {
      skipped.push_back({frame.number, frame.name + ": " + error.what()});
    }
  }
  skipped.insert(skipped.end(), recording.skipped().begin(), recording.skipped().end());
  const AcquisitionResult& result = learner.result();
  if (result.empty_frames == 0) throw std::runtime_error(nothingReadMessage(recording, skipped));
  if (!learner.hasPerson()) {
    const bool several = result.end == AcquisitionEnd::kSecondPerson;
    throw std::runtime_error(
        recording.info().name +
        (several ? ": several people entered together" : ": nobody entered after the empty scene") +
        "; a person model needs about 5 s of the empty room, then one person "
        "for about 10 s" +
        (result.was_empty ? "" : std::string("; ") + kWasNotEmpty) + leftOutNote(skipped));
  }
  return {learner.learn(), result, std::move(skipped)};
}

}  // namespace heel
