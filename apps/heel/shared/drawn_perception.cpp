// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/drawn_perception.hpp>

#include <algorithm>
#include <utility>

namespace heel {
namespace {

constexpr double kUsualHeight_m = 1.75;

Tone toneOf(TargetStatus status) {
  switch (status) {
    case TargetStatus::kFollowed:
      return Tone::kGood;
    case TargetStatus::kCoasting:
    case TargetStatus::kAmbiguous:
      return Tone::kWarning;
    case TargetStatus::kLost:
      return Tone::kBad;
    case TargetStatus::kNone:
      break;
  }
  return Tone::kNeutral;
}

}  // namespace

DrawnFrame& DrawnPerception::of(const Frame& frame, const Perception& perception,
                                const PerceptionStep& step, const FloorPose& robot) {
  drawing_.image_bgr = frame.image_bgr;
  drawing_.mask = step.mask;
  drawing_.camera = setup_.camera.left;
  drawing_.T_floor_camera = basePose(robot) * setup_.T_base_camera;
  drawing_.frame = frame.number;
  drawing_.stamp_s = frame.stamp_s;
  drawing_.state = toText(step.target.status);
  drawing_.reason = step.reason;
  drawing_.tone = toneOf(step.target.status);
  addBlobs(perception, step, robot);
  trails_.forget(frame.stamp_s);
  addTracks(perception, step);
  return drawing_;
}

void DrawnPerception::addBlobs(const Perception& perception, const PerceptionStep& step,
                               const FloorPose& robot) {
  drawing_.blobs.clear();
  for (const WorldBlob& blob : step.blobs) {
    drawing_.blobs.push_back({robot * blob.position_m, blob.points, false});
  }
  const auto& uses = perception.report().uses;
  for (std::size_t i = 0; i < step.blob_of_observation.size(); ++i) {
    const auto blob = static_cast<std::size_t>(step.blob_of_observation[i]);
    drawing_.blobs[blob].is_used = uses[i].fate != ObservationFate::kRejected;
  }
}

void DrawnPerception::addTracks(const Perception& perception, const PerceptionStep& step) {
  drawing_.tracks.clear();
  std::map<int, double> heights_m;
  for (const Track& track : perception.tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    const auto known = heights_m_.find(track.id);
    double height_m = known == heights_m_.end() ? kUsualHeight_m : known->second;
    const bool is_new = perception.report().status != StepStatus::kSkipped;
    if (is_new && track.observation != Track::kUnseen &&
        track.observation < static_cast<int>(step.blob_of_observation.size())) {
      const int blob = step.blob_of_observation[static_cast<std::size_t>(track.observation)];
      height_m = std::max(height_m, step.blobs[static_cast<std::size_t>(blob)].max_height_m);
    }
    heights_m[track.id] = height_m;
    trails_.add(track.id, step.stamp_s, track.motion.position_m());
    DrawnTrack drawn;
    drawn.id = track.id;
    drawn.position_m = track.motion.position_m();
    drawn.velocity_mps = track.motion.velocity_mps();
    drawn.height_m = height_m;
    drawn.is_target = track.id == step.target.track_id;
    drawn.is_seen = track.status == TrackStatus::kConfirmed;
    drawn.confidence = drawn.is_target ? step.target.confidence : 0.0;
    drawn.trail_m = trails_.of(track.id);
    drawing_.tracks.push_back(std::move(drawn));
  }
  heights_m_ = std::move(heights_m);
}

}  // namespace heel
