// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/experiments.hpp"
#include "apps/experiment/truth_frames.hpp"
#include "apps/follower/depth_images.hpp"

#include <algorithm>
#include <set>

namespace heel {
namespace {

/// What the first half of a person's exact frames, and the empty scene, teach of each of them.
std::vector<AppearanceModel> learnEveryone(const std::filesystem::path& path,
                                           const CameraSetup& setup, const TruthFrames& truth,
                                           const ExperimentParams& params) {
  std::vector<AppearanceLearner> learners(truth.people().size(),
                                          AppearanceLearner(params.appearance));
  std::vector<std::set<std::size_t>> frames_of;
  for (const std::string& person : truth.people()) {
    const auto frames = truth.exactFrames(person);
    frames_of.emplace_back(frames.begin(),
                           frames.begin() + static_cast<std::ptrdiff_t>(frames.size() / 2));
  }
  const auto recording = openRecording(path);
  DepthImages depths(setup.sensor, setup.camera);
  ColorCloud cloud;
  pcl::Indices near;
  Frame frame;
  const double radius_m2 = params.learn_radius_m * params.learn_radius_m;
  while (recording->next(frame)) {
    if (frame.stamp_s <= params.background_s) {
      for (AppearanceLearner& learner : learners) learner.addRoom(frame.image_bgr);
      continue;
    }
    makeColorCloud(depths.of(frame), frame.image_bgr, setup.camera.left, setup.T_base_camera,
                   cloud);
    for (std::size_t i = 0; i < learners.size(); ++i) {
      if (frames_of[i].count(frame.number) == 0) continue;
      const Eigen::Vector2f place = truth.placeOf(truth.people()[i], frame.number)->cast<float>();
      near.clear();
      for (std::size_t p = 0; p < cloud.size(); ++p) {
        const auto offset = cloud[p].getVector3fMap().head<2>() - place;
        if (offset.squaredNorm() < static_cast<float>(radius_m2)) {
          near.push_back(static_cast<pcl::index_t>(p));
        }
      }
      learners[i].addPerson(cloud, near);
    }
  }
  std::vector<AppearanceModel> models;
  for (const AppearanceLearner& learner : learners) models.push_back(learner.learn());
  return models;
}

/// Looks for one person in the second half of their exact frames, in all three ways.
TargetResult lookFor(const std::string& person, const AppearanceModel& model,
                     const std::filesystem::path& path, const CameraSetup& setup,
                     const TruthFrames& truth, const ExperimentParams& params) {
  const auto exact = truth.exactFrames(person);
  const std::set<std::size_t> judged(exact.begin() + static_cast<std::ptrdiff_t>(exact.size() / 2),
                                     exact.end());
  Perception started(setup, model), cold(setup, model);
  started.startAt(*truth.placeOf(person, *judged.begin()));
  std::vector<TargetFrame> best_frames, started_frames, cold_frames;
  const auto recording = openRecording(path);
  Frame frame;
  while (recording->next(frame) && frame.number <= *judged.rbegin()) {
    if (frame.number < *judged.begin()) continue;
    const PerceptionStep& seen = started.step(frame);
    const PerceptionStep& found = cold.step(frame);
    if (judged.count(frame.number) == 0) continue;
    const TargetFrame target = truth.targetFrame(person, frame.number, frame.stamp_s);
    best_frames.push_back(target);
    started_frames.push_back(target);
    cold_frames.push_back(target);
    const auto best = std::max_element(
        seen.observations.begin(), seen.observations.end(),
        [](const Observation& a, const Observation& b) { return a.appearance < b.appearance; });
    if (best != seen.observations.end()) best_frames.back().estimate_m = best->position_m;
    if (seen.target.hasPlace()) {
      started_frames.back().estimate_m = seen.target.motion.position_m();
    }
    if (found.target.hasPlace()) cold_frames.back().estimate_m = found.target.motion.position_m();
  }
  TargetResult result;
  result.person = person;
  result.best_blob = targetMetrics(best_frames, params.tracker_distance_m);
  result.started = targetMetrics(started_frames, params.tracker_distance_m);
  result.cold = targetMetrics(cold_frames, params.tracker_distance_m);
  return result;
}

}  // namespace

std::vector<TargetResult> runTargetsExperiment(const std::filesystem::path& path,
                                               const ExperimentParams& params) {
  const TruthFrames truth(path);
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  const auto models = learnEveryone(path, setup, truth, params);
  std::vector<TargetResult> results;
  for (std::size_t i = 0; i < models.size(); ++i) {
    results.push_back(lookFor(truth.people()[i], models[i], path, setup, truth, params));
  }
  return results;
}

}  // namespace heel
