// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/truth_frames.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace heel {
namespace {

/// Looks for one person from a frame on, in all three ways.
/// @param judged  The frames that count where somebody need not be silent.
TargetResult lookFor(const std::string& person, const AppearanceModel& model,
                     const std::filesystem::path& path, const TruthFrames& truth,
                     const std::set<std::size_t>& judged, const ExperimentParams& params) {
  const auto recording = openRecording(path);
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  Perception started(setup, model), cold(setup, model);
  std::vector<TargetFrame> best_frames, started_frames, cold_frames;
  Frame frame;
  while (recording->next(frame)) {
    if (judged.empty() || frame.number < *judged.begin()) continue;
    if (frame.number == *judged.begin()) {
      started.startAt(*truth.placeOf(person, frame.number));
    }
    const PerceptionStep& seen = started.step(frame);
    const PerceptionStep& found = cold.step(frame);
    TargetFrame target = truth.targetFrame(person, frame.number, frame.stamp_s);
    if (judged.count(frame.number) != 0) {
      best_frames.push_back(target);
      started_frames.push_back(target);
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
    }
    if (found.target.hasPlace()) target.estimate_m = found.target.motion.position_m();
    if (const Track* likeliest = cold.likeliest()) {
      target.likeliest_m = likeliest->motion.position_m();
      target.probability = cold.identity().targetProbability(likeliest->id);
    }
    cold_frames.push_back(target);
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
                                               const ExperimentParams& params,
                                               const std::filesystem::path& other) {
  const TruthFrames truth(path);
  const TruthFrames other_truth(other.empty() ? path : other);
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  const auto lessons = learnEveryone(path, setup, truth, {{"", params.appearance}}, params);
  std::vector<TargetResult> results;
  for (std::size_t i = 0; i < lessons.size(); ++i) {
    const std::string& person = truth.people()[i];
    const auto model = lessons[i].learn(0);
    if (!model) throw std::runtime_error(person + ": nothing of them could be learned");
    const auto exact = other_truth.exactFrames(person);
    if (exact.empty()) continue;
    const auto first = other.empty() ? exact.size() / 2 : 0;
    results.push_back(lookFor(person, *model, other.empty() ? path : other, other_truth,
                              {exact.begin() + static_cast<std::ptrdiff_t>(first), exact.end()},
                              params));
  }
  if (results.empty()) {
    throw std::runtime_error(other.string() + ": nobody of " + path.string() + " is in its truth");
  }
  return results;
}

}  // namespace heel
