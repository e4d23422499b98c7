// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/simulated_lesson.hpp>

#include <stdexcept>
#include <utility>

namespace heel {
namespace {

/// The points whose pixels are surely the person's.
pcl::Indices personPoints(const AcquisitionStep& step) {
  pcl::Indices indices;
  const auto* labels = step.labels.ptr<std::uint8_t>();
  for (const auto i : *step.view->candidates) {
    if (labels[i] == AcquisitionStep::kTorso || labels[i] == AcquisitionStep::kLegs) {
      indices.push_back(i);
    }
  }
  return indices;
}

}  // namespace

SimulatedLesson takeLesson(const std::vector<const SimulatedFrames*>& recordings,
                           const std::vector<OfferedModel>& models, double empty_s,
                           double person_s) {
  if (recordings.empty()) throw std::invalid_argument("takeLesson: there is no recording");
  AcquisitionParams params;
  params.background_s = empty_s;
  params.person_s = person_s;
  const CameraSetup& setup = recordings.front()->setup;
  Acquisition acquisition(setup.camera.left, setup.T_base_camera, params);
  SimulatedLesson lesson{ModelLessons(models), {}};
  for (const SimulatedFrames* recording : recordings) {
    for (const SimulatedFrame& now : recording->frames) {
      const Frame& frame = now.frame;
      const AcquisitionStep& step = acquisition.step(frame.stamp_s, frame.image_bgr, frame.depth_m);
      if (!step.usable) continue;
      lesson.lessons.addRoom(frame.image_bgr, step.labels == AcquisitionStep::kScene);
      if (step.person < 0) continue;
      const pcl::Indices person = personPoints(step);
      lesson.lessons.addPerson(*step.view->cloud, person);
      lesson.lessons.addBody(*step.view->cloud, person,
                             step.view->blobs[static_cast<std::size_t>(step.person)].position_m);
    }
  }
  lesson.result = acquisition.result();
  return lesson;
}

AppearanceModel learnInWardrobe(const WardrobeRooms& rooms, const ScenePerson& person,
                                const AppearanceParams& appearance,
                                const StereoMatcherParams& stereo, double empty_s, double person_s,
                                std::uint64_t seed) {
  SimulatedFramesParams span;
  span.seed = seed;
  span.to_s = empty_s + kEnters_s + person_s;
  SimulatedFrames recording = renderFrames(rooms.acquisition(person, empty_s, seed), span);
  matchStereo(recording, stereo);
  const SimulatedLesson lesson = takeLesson({&recording}, {{"", appearance}}, empty_s, person_s);
  auto model = lesson.lessons.learn(0);
  if (!model) throw std::runtime_error(person.name + ": nothing of the person could be learned");
  return std::move(*model);
}

}  // namespace heel
