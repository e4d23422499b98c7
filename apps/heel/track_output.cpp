// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/track_output.hpp"

#include "apps/report/atomic_file.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <deque>

namespace heel {
namespace {

std::vector<std::string> stageNames() {
  std::vector<std::string> names;
  for (int i = 0; i < kStages; ++i) names.emplace_back(toText(static_cast<Stage>(i)));
  return names;
}

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

std::string stillName(std::size_t frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%06zu.png", frame);
  return name;
}

/// Removes the film and the stills of a former run into the same folder, which would not go with
/// the new tables.
void removeFormerPictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> former = {folder / "tracks.mp4", folder / "tracks.avi"};
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("frame_", 0) == 0 && entry.path().extension() == ".png") {
      former.push_back(entry.path());
    }
  }
  for (const auto& file : former) std::filesystem::remove(file);
}

/// Frames per second at which a film of the recording shows real time.
double rateOf(const RecordingInfo& info) {
  const bool has_rate = info.frame_count > 1 && info.duration_s > 0.0;
  return has_rate ? static_cast<double>(info.frame_count - 1) / info.duration_s : 10.0;
}

}  // namespace

TrackOutput::TrackOutput(const std::filesystem::path& folder, const RecordingInfo& info,
                         const CameraSetup& setup, const TrackOutputParams& params)
    : folder_(folder),
      info_(info),
      setup_(setup),
      params_(params),
      files_((makeResultFolder(folder), folder), stageNames()) {
  scene_.camera = setup.camera.left;
  scene_.T_floor_camera = setup.T_base_camera;
  scene_.bounds_m = params.bounds_m;
  if (params.film) film_.emplace(folder / "tracks.mp4", rateOf(info), pictureSize());
}

void TrackOutput::add(const Frame& frame, const Perception& perception, const PerceptionStep& step,
                      const StageTimes& times_ms) {
  ++frames_;
  ++states_[toText(step.target.status)];
  if (step.target.hasPlace()) ++frames_with_target_;
  if (!step.reason.empty()) ++reasons_[step.reason];
  addRows(frame, perception, step);
  files_.addTiming(frame.number, {times_ms.begin(), times_ms.end()});
  if (film_) {
    draw(frame, perception, step);
    film_->write(picture_);
    if (step.target.status == TargetStatus::kFollowed) keepStill();
  }
}

void TrackOutput::addRows(const Frame& frame, const Perception& perception,
                          const PerceptionStep& step) {
  FrameRow row;
  row.frame = frame.number;
  row.stamp_s = frame.stamp_s;
  row.color_pixels = step.color_pixels;
  row.color_points = step.color_points;
  row.standing_points = static_cast<int>(step.standing.size());
  row.blobs = static_cast<int>(step.blobs.size());
  row.observations = perception.report().verdictCount(GateVerdict::kAccepted);
  row.target_id = step.target.track_id;
  row.confidence = step.target.confidence;
  row.state = toText(step.target.status);
  row.reason = step.reason;
  for (const Track& track : perception.tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    ++row.tracks;
    TrackRow track_row;
    track_row.stamp_s = frame.stamp_s;
    track_row.track_id = track.id;
    track_row.is_target = track.id == step.target.track_id;
    track_row.position_m = track.motion.position_m();
    track_row.velocity_mps = track.motion.velocity_mps();
    track_row.score = track.score;
    track_row.status = toText(track.status);
    files_.add(track_row);
  }
  files_.add(row);
}

void TrackOutput::draw(const Frame& frame, const Perception& perception,
                       const PerceptionStep& step) {
  scene_.image_bgr = frame.image_bgr;
  scene_.mask = step.mask;
  scene_.frame = frame.number;
  scene_.stamp_s = frame.stamp_s;
  scene_.state = toText(step.target.status);
  scene_.reason = step.reason;
  scene_.tone = toneOf(step.target.status);

  scene_.blobs.clear();
  for (const WorldBlob& blob : step.blobs) {
    scene_.blobs.push_back({blob.position_m, blob.points, false});
  }
  const auto& uses = perception.report().uses;
  for (std::size_t i = 0; i < step.blob_of_observation.size(); ++i) {
    const auto blob = static_cast<std::size_t>(step.blob_of_observation[i]);
    scene_.blobs[blob].is_used = uses[i].fate != ObservationFate::kRejected;
  }

  trails_.forget(frame.stamp_s);
  scene_.tracks.clear();
  std::map<int, double> heights_m;
  for (const Track& track : perception.tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    double& height_m = heights_m[track.id] =
        heights_m_.count(track.id) ? heights_m_[track.id] : 1.75;
    const bool is_new = perception.report().status != StepStatus::kSkipped;
    if (is_new && track.observation != Track::kUnseen) {
      const int blob = step.blob_of_observation[static_cast<std::size_t>(track.observation)];
      height_m = std::max(height_m, step.blobs[static_cast<std::size_t>(blob)].max_height_m);
    }
    trails_.add(track.id, frame.stamp_s, track.motion.position_m());
    DrawnTrack drawn;
    drawn.id = track.id;
    drawn.position_m = track.motion.position_m();
    drawn.velocity_mps = track.motion.velocity_mps();
    drawn.height_m = height_m;
    drawn.is_target = track.id == step.target.track_id;
    drawn.is_seen = track.status == TrackStatus::kConfirmed;
    drawn.confidence = drawn.is_target ? step.target.confidence : 0.0;
    drawn.trail_m = trails_.of(track.id);
    scene_.tracks.push_back(std::move(drawn));
  }
  heights_m_ = std::move(heights_m);
  annotate(scene_, {}, picture_);
}

// Keeps every still_step_-th frame that shows the target; when twice as many are kept as are
// wanted, every other one is dropped: an even spread at bounded memory.
void TrackOutput::keepStill() {
  if (states_[toText(TargetStatus::kFollowed)] % still_step_ != 0) return;
  stills_.push_back({frames_, picture_.clone()});
  if (stills_.size() < 2 * params_.stills) return;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < stills_.size(); i += 2) stills_[kept++] = stills_[i];
  stills_.resize(kept);
  still_step_ *= 2;
}

void TrackOutput::commit(const std::vector<SkippedFrame>& skipped,
                         const std::vector<std::string>& warnings) {
  nlohmann::ordered_json summary;
  summary["recording"] = info_.name;
  summary["layout"] = info_.layout;
  summary["duration_s"] = info_.duration_s;
  summary["frames"] = frames_;
  summary["frames_skipped"] = nlohmann::ordered_json::array();
  for (const SkippedFrame& frame : skipped) {
    summary["frames_skipped"].push_back({{"frame", frame.number}, {"reason", frame.reason}});
  }
  summary["frames_with_target"] = frames_with_target_;
  summary["frames_by_state"] = states_;
  summary["frames_by_reason"] = reasons_;
  const Mounting mounting = mountingOf(setup_.T_base_camera);
  summary["camera"] = {{"height_m", mounting.height_m},
                       {"pitch_rad", mounting.pitch_rad},
                       {"roll_rad", mounting.roll_rad},
                       {"from", setup_.is_configured ? "configuration" : "floor"},
                       {"depth_share", setup_.report.found_share}};
  summary["warnings"] = warnings;

  // All is written before anything gets its name; the summary, which speaks of the rest, comes
  // last.
  std::deque<AtomicFile> stills;
  for (const Still& still : stills_) {
    writePicture(stills.emplace_back(folder_ / stillName(still.frame)), still.picture);
  }
  AtomicFile summary_file(folder_ / "summary.json");
  writeJson(summary_file, summary);
  files_.close();
  if (film_) film_->close();
  removeFormerPictures(folder_);
  files_.commit();
  if (film_) film_->commit();
  for (AtomicFile& still : stills) still.commit();
  summary_file.commit();
}

std::string TrackOutput::fileNames() const {
  std::string names = "tracks.csv frames.csv timing.csv summary.json";
  if (film_) names += " " + film_->path().filename().string();
  if (!stills_.empty()) names += " frame_*.png";
  return names;
}

}  // namespace heel
