// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/experiments.hpp"
#include "apps/experiment/truth_frames.hpp"
#include "apps/experiment/truth_lessons.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace heel {
namespace {

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
    const std::vector<Evidence>& looks = started.identity().looks();
    const auto best = std::max_element(
        looks.begin(), looks.end(),
        [](const Evidence& a, const Evidence& b) { return a[kTarget] < b[kTarget]; });
    if (best != looks.end()) {
      const auto i = static_cast<std::size_t>(best - looks.begin());
      best_frames.back().estimate_m = seen.observations[i].position_m;
    }
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
  const auto lessons = learnEveryone(path, setup, truth, {{"", params.appearance}}, params);
  std::vector<TargetResult> results;
  for (std::size_t i = 0; i < lessons.size(); ++i) {
    const auto model = lessons[i].learn(0);
    if (!model) throw std::runtime_error(truth.people()[i] + ": nothing of them could be learned");
    results.push_back(lookFor(truth.people()[i], *model, path, setup, truth, params));
  }
  return results;
}

}  // namespace heel
