// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/truth_frames.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

/// Looks for one person from a frame on, in all three ways.
/// @param judged  The frames that count where somebody need not be silent.
TargetResult lookFor(const std::string& person, const AppearanceModel& model,
                     const std::filesystem::path& path, const TruthFrames& truth,
                     const std::set<std::size_t>& judged) {
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
      const std::vector<LookOdds>& looks = started.identity().looks();
      const auto best =
          std::max_element(looks.begin(), looks.end(), [](const LookOdds& a, const LookOdds& b) {
            return a.row(kTarget).sum() < b.row(kTarget).sum();
          });
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
      target.probability = cold.probabilityAt(*target.likeliest_m);
    }
    cold_frames.push_back(target);
  }
  TargetResult result;
  result.person = person;
  result.sought_in = path;
  result.best_blob = targetMetrics(best_frames, kTrackerDistance_m);
  result.started = targetMetrics(started_frames, kTrackerDistance_m);
  result.cold = targetMetrics(cold_frames, kTrackerDistance_m);
  return result;
}

}  // namespace

std::vector<TargetResult> runTargetsExperiment(const std::vector<std::filesystem::path>& recordings,
                                               const ExperimentParams& params) {
  const std::vector<TruthFrames> truths(recordings.begin(), recordings.end());
  std::vector<TargetResult> results;
  for (std::size_t home = 0; home < recordings.size(); ++home) {
    const std::vector<std::string>& people = truths[home].people();
    const CameraSetup setup = findCameraSetup(*openRecording(recordings[home]));
    const auto lessons =
        learnEveryone(recordings[home], setup, truths[home], {{"", params.appearance}}, params);
    std::vector<AppearanceModel> models;
    for (std::size_t i = 0; i < lessons.size(); ++i) {
      auto model = lessons[i].learn(0);
      if (!model) throw std::runtime_error(people[i] + ": nothing of them could be learned");
      models.push_back(std::move(*model));
    }
    std::vector<bool> is_elsewhere(people.size(), false);
    for (std::size_t step = 1; step <= recordings.size(); ++step) {
      const std::size_t where = (home + step) % recordings.size();  // Home is last.
      for (std::size_t i = 0; i < people.size(); ++i) {
        auto frames = truths[where].exactFrames(people[i]);
        if (where == home) {
          const auto half = static_cast<std::ptrdiff_t>(frames.size() / 2);
          frames.erase(frames.begin(), frames.begin() + half);
          if (is_elsewhere[i]) continue;
        }
        if (frames.empty()) continue;
        is_elsewhere[i] = true;
        results.push_back(lookFor(people[i], models[i], recordings[where], truths[where],
                                  {frames.begin(), frames.end()}));
        results.back().learned_in = recordings[home];
      }
    }
  }
  return results;
}

}  // namespace heel
