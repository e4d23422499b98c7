// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/truth_frames.hpp>

#include <stdexcept>

namespace heel {
namespace {

/// Follows a model through a recording from its first frame on, but judges only frames from `from`
/// to the person's last true place.
TargetMetrics follow(const std::filesystem::path& path, const AppearanceModel& model,
                     const std::string& person, std::size_t from) {
  const TruthFrames truth(path);
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  const auto recording = openRecording(path);
  Perception perception(setup, model);
  std::vector<TargetFrame> frames;
  std::size_t last = 0;
  Frame frame;
  while (recording->next(frame)) {
    const PerceptionStep& step = perception.step(frame);
    if (frame.number < from) continue;
    frames.push_back(truth.targetFrame(person, frame.number, frame.stamp_s));
    if (step.target.hasPlace()) frames.back().estimate_m = step.target.motion.position_m();
    if (frames.back().target_m) last = frames.size();
  }
  frames.resize(last);
  return targetMetrics(frames, kTrackerDistance_m);
}

}  // namespace

ProtocolResult runProtocolExperiment(const std::filesystem::path& path,
                                     const ExperimentParams& params) {
  const TruthFrames truth(path);
  if (truth.people().empty()) throw std::runtime_error(path.string() + ": nobody is in the truth");
  const CameraSetup setup = findCameraSetup(*openRecording(path));
  LearnPersonParams learning;
  learning.acquisition.background_s = params.background_s;
  learning.appearance = params.appearance;
  LearnedPerson learned = learnPerson(*openRecording(path), setup, learning);
  const std::string person = truth.people().front();
  const TargetMetrics following =
      follow(path, learned.model, person, truth.firstFrameOfOthers(person));
  return {std::move(learned), person, following};
}

TargetMetrics runFollowingExperiment(const std::filesystem::path& path,
                                     const AppearanceModel& model, const std::string& person) {
  return follow(path, model, person, 1);
}

}  // namespace heel
