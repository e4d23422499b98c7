// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/track/track_output.hpp>
#include <heel/apps/pages/pages.hpp>
#include <heel/apps/pictures/picture_parts.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/segmentation/appearance_picture.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace heel {
namespace {

std::vector<std::string> stageNames() {
  std::vector<std::string> names;
  for (int i = 0; i < kStages; ++i) names.emplace_back(toText(static_cast<Stage>(i)));
  return names;
}

std::string stillName(std::size_t frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%06zu.png", frame);
  return name;
}

/// Frames per second at which a film of the recording shows real time.
double rateOf(const RecordingInfo& info) {
  const bool has_rate = info.frame_count > 1 && info.duration_s > 0.0;
  return has_rate ? static_cast<double>(info.frame_count - 1) / info.duration_s : 10.0;
}

/// Probability that a track is a person and not a thing.
double personProbability(const Perception& perception, const Track& track) {
  const Evidence who = perception.identity().probabilities(track.id);
  return 1.0 - who[kThing] / std::max(who.sum(), 1e-12);
}

}  // namespace

PicturedPerson picturedPerson(const std::filesystem::path& file, const AppearanceModel& model) {
  PicturedPerson person{file.stem().string(), drawAppearance(model), {}};
  const auto view = file.parent_path() / (person.name + "_view.png");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(view, ignored)) return person;
  try {
    ImageReader().readColor(view, person.learned_bgr);
  } catch (const std::runtime_error&) {
    person.learned_bgr.release();  // the report does without
  }
  return person;
}

TrackOutput::TrackOutput(const std::filesystem::path& folder, const RecordingInfo& info,
                         const CameraSetup& setup, const TrackOutputParams& params)
    : output_({"track",
               OutputKind::kFolder,
               folder,
               params.inputs,
               {"report.html", "tracks.csv", "frames.csv", "timing.csv", "summary.json",
                "tracks.mp4"}}),
      info_(info),
      setup_(setup),
      params_(params),
      files_(output_, stageNames()),
      drawn_(setup) {
  if (params.film) film_.emplace(output_ / "tracks.mp4", rateOf(info), pictureSize());
  log_.recording = info.name;
  log_.layout = info.layout;
  log_.person = params.person.name;
  log_.colors_bgr = params.person.colors_bgr;
  log_.learned_bgr = params.person.learned_bgr;
  log_.frame = moves() ? params.frame : "base";
  log_.moves = moves();
  log_.bounds_m = params.bounds_m;
  log_.seen_floor_m = visibleFloor(setup.camera.left, setup.T_base_camera, kPlanAhead_m);
  if (params.bag.empty()) return;
  bag_.emplace(BagPlan{params.bag, params.inputs, "track"}, moves() ? params.frame : "map");
}

std::string TrackOutput::commonestReason() const {
  const auto most =
      std::max_element(reasons_.begin(), reasons_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == reasons_.end() ? std::string() : most->first;
}

void TrackOutput::add(const Frame& frame, const FloorPose& robot, const Perception& perception,
                      const PerceptionStep& step, const StageTimes& times_ms) {
  ++frames_;
  ++states_[toText(step.target.status)];
  if (step.target.hasPlace()) ++frames_with_target_;
  if (!step.reason.empty()) ++reasons_[step.reason];
  addRows(frame, robot, perception, step);
  files_.addTiming(frame.number, {times_ms.begin(), times_ms.end()});
  if (film_ || bag_) {
    DrawnFrame& drawing = drawn_.of(frame, perception, step, robot);
    drawing.bounds_m = params_.bounds_m;
    drawing.camera_turns = moves();
    annotate(drawing, {}, picture_);
  }
  if (bag_) {
    bag_->addRobot(frame.stamp_s, robot);
    bag_->addTracks(frame.stamp_s, perception.tracks(), step.target);
    bag_->addImage(frame.stamp_s, picture_);
  }
  if (film_) {
    film_->write(picture_);
    film_stamps_s_.push_back(frame.stamp_s);
    if (step.target.status == TargetStatus::kFollowed) keepStill();
  }
}

void TrackOutput::addRows(const Frame& frame, const FloorPose& robot, const Perception& perception,
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
  row.robot = robot;
  std::vector<TrackRow> tracks;
  for (const Track& track : perception.tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    TrackRow& track_row = tracks.emplace_back();
    track_row.stamp_s = frame.stamp_s;
    track_row.track_id = track.id;
    track_row.is_target = track.id == step.target.track_id;
    track_row.position_m = track.motion.position_m();
    track_row.velocity_mps = track.motion.velocity_mps();
    track_row.score = track.score;
    track_row.status = toText(track.status);
    track_row.person_probability = personProbability(perception, track);
    files_.add(track_row);
  }
  row.tracks = static_cast<int>(tracks.size());
  files_.add(row);
  log_.samples.push_back(sampleOf(row, tracks, static_cast<double>(step.mask.total())));
}

void TrackOutput::keepStill() {
  if (states_[toText(TargetStatus::kFollowed)] % still_step_ != 0) return;
  stills_.push_back({frames_, log_.samples.back().stamp_s, picture_.clone()});
  if (stills_.size() < 2 * params_.stills) return;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < stills_.size(); i += 2) stills_[kept++] = stills_[i];
  stills_.resize(kept);
  still_step_ *= 2;
}

void TrackOutput::commit(const TrackEnd& end) {
  nlohmann::ordered_json summary;
  summary["complete"] = end.complete;
  summary["recording"] = info_.name;
  summary["layout"] = info_.layout;
  summary["person"] = log_.person;
  summary["duration_s"] = info_.duration_s;
  summary["frames"] = frames_;
  summary["frames_skipped"] = nlohmann::ordered_json::array();
  for (const SkippedFrame& frame : end.skipped) {
    summary["frames_skipped"].push_back({{"frame", frame.number}, {"reason", frame.reason}});
  }
  summary["frames_with_target"] = frames_with_target_;
  summary["frames_by_state"] = states_;
  summary["frames_by_reason"] = reasons_;
  const Mounting mounting = mountingOf(setup_.T_base_camera);
  summary["frame"] = moves() ? params_.frame : "base";
  summary["camera"] = {{"height_m", mounting.height_m},
                       {"pitch_rad", mounting.pitch_rad},
                       {"roll_rad", mounting.roll_rad},
                       {"from", setup_.is_configured ? "configuration" : "floor"},
                       {"depth_share", setup_.report.found_share},
                       {"width", setup_.camera.left.width},
                       {"height", setup_.camera.left.height}};
  summary["warnings"] = end.warnings;

  for (const Still& still : stills_) {
    writePicture(output_ / stillName(still.frame), still.picture);
    log_.stills.push_back({still.stamp_s, "the target is seen", still.picture});
  }
  writeJson(output_ / "summary.json", summary);
  files_.close();
  PageFilm film;
  if (film_) {
    film_->close();
    film.name = film_->path().filename().string();
    film.rate_hz = rateOf(info_);
    film.stamps_s = std::move(film_stamps_s_);
  }
  log_.complete = end.complete;
  log_.warnings = end.warnings;
  log_.skipped = end.skipped.size();
  writeFile(output_ / "report.html", trackPage(log_, film));
  output_.commit(end.complete);
  if (bag_) bag_->commit(end.complete);
}

std::string TrackOutput::fileNames() const {
  std::string names = "report.html tracks.csv frames.csv timing.csv summary.json";
  if (film_) names += " " + film_->path().filename().string();
  if (!stills_.empty()) names += " frame_*.png";
  if (bag_) names += "; and " + bag_->path().string();
  return names;
}

}  // namespace heel
