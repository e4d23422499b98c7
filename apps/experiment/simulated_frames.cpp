// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/simulated_frames.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/follower/wall_gate.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/apps/simulation/simulator.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace heel {

namespace {

/// Who is in view, and where in the robot's frame.
std::vector<std::optional<Eigen::Vector2d>> placesInView(const Readings& readings) {
  constexpr int kMinPixels = 500;  // Somebody of whom less is seen is not in view.
  std::array<int, 256> pixels{};
  const cv::Mat& people = readings.stereo->people;
  for (int v = 0; v < people.rows; ++v) {
    const auto* row = people.ptr<std::uint8_t>(v);
    for (int u = 0; u < people.cols; ++u) ++pixels[row[u]];
  }
  const FloorPose& robot = readings.truth.robot;
  std::vector<std::optional<Eigen::Vector2d>> places(readings.truth.people.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (pixels[i + 1] < kMinPixels) continue;
    places[i] =
        Eigen::Rotation2Dd(-robot.yaw_rad) * (readings.truth.people[i].position - robot.position);
  }
  return places;
}

/// Refuses what the map of the scene does, for a robot that stands at its start.
GeometricGate gateOf(const Scene& scene, const CameraSetup& setup) {
  WallGateParams params;
  params.observations_in_map = {scene.robot.start, scene.robot.start_yaw_rad};
  params.eye_height_m = setup.T_base_camera.translation().z();
  return wallGate(std::make_shared<const WallMap>(wallMapOf(scene)), params);
}

}  // namespace

TargetFrame targetFrame(const SimulatedFrame& now, const TargetEstimate& estimate) {
  TargetFrame frame;
  frame.stamp_s = now.frame.stamp_s;
  frame.target_m = now.people_m[0];
  for (std::size_t i = 1; i < now.people_m.size(); ++i) {
    if (now.people_m[i]) frame.others_m.push_back(*now.people_m[i]);
  }
  if (estimate.hasPlace()) frame.estimate_m = estimate.motion.position_m();
  return frame;
}

SimulatedFrames renderFrames(const Scene& scene, const SimulatedFramesParams& params) {
  SimulatorOptions options;
  options.seed = params.seed;
  Simulator simulator(scene, options);
  SimulatedFrames result;
  result.setup.sensor = SensorKind::kStereo;
  result.setup.camera = simulator.camera();
  result.setup.T_base_camera = simulator.T_base_camera();
  result.setup.is_configured = true;
  result.gate = gateOf(scene, result.setup);
  const double step_s = 1.0 / scene.robot.camera.rate_hz;
  const auto count = std::lround(std::ceil((params.to_s - params.from_s) / step_s - 1e-6));
  for (long i = 0; i < count; ++i) {
    const Readings* readings = &simulator.step(i == 0 ? params.from_s : step_s);
    SimulatedFrame& now = result.frames.emplace_back();
    now.frame.number = result.frames.size();
    now.frame.stamp_s = readings->stamp_s;
    now.frame.name = scene.name;
    now.frame.image_bgr = readings->stereo->left_bgr.clone();
    now.frame.right_bgr = readings->stereo->right_bgr.clone();
    now.true_depth_m = readings->stereo->depth_m.clone();
    now.people = readings->stereo->people.clone();
    now.people_m = placesInView(*readings);
  }
  return result;
}

void matchStereo(SimulatedFrames& recording, const StereoMatcherParams& params) {
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, recording.frames.size()), [&](const Range& range) {
    DepthImages depths(SensorKind::kStereo, recording.setup.camera, params);
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Frame& frame = recording.frames[i].frame;
      frame.depth_m = depths.of(frame).clone();
    }
  });
  recording.setup.sensor = SensorKind::kRgbd;
}

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
