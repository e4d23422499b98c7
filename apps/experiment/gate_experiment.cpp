// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/gate_experiment.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>
#include <heel/apps/simulation/random.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

/// The scene with this person in it, and all that hangs on its walls in the colour of their top.
Scene postersOf(const ScenePerson& person, const GateExperimentParams& params) {
  Scene scene = loadScene((params.scenes / "poster.yaml").string());
  const ScenePerson part = scene.people.front();
  scene.people.front() = person;
  scene.people.front().start = part.start;
  scene.people.front().start_yaw_rad = part.start_yaw_rad;
  scene.people.front().path = part.path;
  for (Furniture& thing : scene.furniture) {
    if (thing.name != "poster" && thing.name != "coat") continue;
    for (FurniturePart& piece : thing.parts) {
      piece.surface.color = person.outfit.top.front.color;
    }
  }
  return scene;
}

GateOutcome follow(const SimulatedFrames& recording, const AppearanceModel& model, bool gated,
                   const GateExperimentParams& params) {
  PerceptionParams perception_params = params.perception;
  perception_params.gate = gated ? recording.gate : GeometricGate();
  Perception perception(recording.setup, model, perception_params);
  std::vector<TargetFrame> frames;
  GateOutcome outcome;
  double last_s = 0.0;
  for (const SimulatedFrame& now : recording.frames) {
    const PerceptionStep& step = perception.step(now.frame);
    const TargetFrame& frame = frames.emplace_back(targetFrame(now, step.target));
    const double step_s = frames.size() > 1 ? frame.stamp_s - last_s : 0.0;
    last_s = frame.stamp_s;
    const EstimateOf of = judge(frame, kPlaceError_m);
    if (of == EstimateOf::kTarget) outcome.right_target_s += step_s;
    // Out of view, a track that coasts where the target went is no mistake: only one that is seen.
    const bool is_seen = step.target.status == TargetStatus::kFollowed;
    if (of == EstimateOf::kNobody && (frame.target_m || is_seen)) outcome.wrong_target_s += step_s;
  }
  outcome.target = targetMetrics(frames, kPlaceError_m);
  return outcome;
}

}  // namespace

GateRun runGateExperiment(std::uint64_t seed, const GateExperimentParams& params) {
  const ScenePerson person = randomWardrobe(seed).people[2];
  const AppearanceModel model =
      learnInWardrobe(WardrobeRooms(params.scenes, seed), person, params.appearance,
                      params.perception.stereo, params.empty_s, params.person_s, hashOf(seed, 31));
  SimulatedFramesParams span;
  span.seed = hashOf(seed, 32);
  span.to_s = params.follow_s;
  const SimulatedFrames recording = renderFrames(postersOf(person, params), span);
  GateRun run;
  run.seed = seed;
  run.with_gate = follow(recording, model, true, params);
  run.without_gate = follow(recording, model, false, params);
  return run;
}

}  // namespace heel
