// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/follow_output.hpp>
#include <heel/apps/results/result_files.hpp>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

namespace heel {
namespace {

constexpr double kSnapshotsApart_s = 4.0;
constexpr std::size_t kMostSnapshots = 12;
constexpr double kFilmRate_hz = 10.0;
constexpr double kShownApart_s = 0.19;  // On a network.

StageTime summaryOf(const char* name, const std::vector<float>& times_ms) {
  StageTime time;
  time.name = name;
  if (times_ms.empty()) return time;
  time.mean_ms =
      std::accumulate(times_ms.begin(), times_ms.end(), 0.0) / static_cast<double>(times_ms.size());
  time.median_ms = shareOf({times_ms.begin(), times_ms.end()}, 0.5);
  time.p95_ms = shareOf({times_ms.begin(), times_ms.end()}, 0.95);
  return time;
}

Tone toneOf(const FollowStep& step) {
  if (step.is_learning || step.is_paused) return Tone::kNeutral;
  if (step.target) return Tone::kGood;
  return step.outcome == PlanOutcome::kFailed ? Tone::kBad : Tone::kWarning;
}

}  // namespace

FollowOutput::FollowOutput(const std::filesystem::path& folder, bool film,
                           const std::filesystem::path& bag,
                           const std::vector<std::filesystem::path>& inputs)
    : output_({"follow",
               OutputKind::kFolder,
               folder,
               inputs,
               {"report.html", "follow.mp4", "summary.json", "follow.csv", "timing.csv"}}),
      film_wanted_(film) {
  if (!bag.empty()) bag_.emplace(BagPlan{bag, inputs, "follow"});
}

void FollowOutput::addTime(FollowStage stage, double ms) {
  step_ms_[static_cast<std::size_t>(stage)] = ms;
}

// A robot that learns stands: what its other stages take then would flatter them.
void FollowOutput::keepTimes(bool learns) {
  const auto learning = static_cast<std::size_t>(FollowStage::kLearn);
  double all_ms = 0.0;
  for (std::size_t stage = 1; stage < times_ms_.size(); ++stage) {  // kBegin takes no time
    const double ms = std::exchange(step_ms_[stage], 0.0);
    all_ms += ms;
    if ((stage == learning) == learns) times_ms_[stage].push_back(static_cast<float>(ms));
  }
  if (!learns) steps_ms_.push_back(static_cast<float>(all_ms));
}

void FollowOutput::add(const Readings& readings, const FollowStep& step, const Follower& follower,
                       const FollowSample& sample) {
  keepTimes(step.is_learning || step.acquisition != nullptr);
  if (bag_) addToBag(readings, step, follower);
  if (readings.stereo == nullptr) return;
  const bool snapshot = isWorthAPicture(sample);
  last_state_ = sample.state;
  const bool shows = network_ != nullptr &&
                     std::abs(readings.stamp_s - shown_s_) >= kShownApart_s &&
                     network_->isImageWatched();
  if (!film_wanted_ && !snapshot && !bag_ && !shows) return;
  draw(readings, step, follower, sample);
  if (bag_) bag_->addImage(readings.stamp_s, picture_);
  if (shows) {
    network_->addImage(readings.stamp_s, picture_);
    shown_s_ = readings.stamp_s;
  }
  if (film_wanted_) {
    film_->write(picture_);
    film_stamps_s_.push_back(readings.stamp_s);
  }
  if (snapshot) keepSnapshot(sample);
}

void FollowOutput::addToBag(const Readings& readings, const FollowStep& step,
                            const Follower& follower) {
  if (!has_map_) bag_->addMap(readings.stamp_s, follower.floor());
  has_map_ = true;
  bag_->addRobot(readings.stamp_s, step.robot.pose);
  if (step.perception != nullptr) {
    bag_->addTracks(readings.stamp_s, follower.perception()->tracks(), follower.target());
  }
  if (step.path != nullptr) bag_->addPath(readings.stamp_s, *step.path);
}

bool FollowOutput::isWorthAPicture(const FollowSample& sample) const {
  return sample.state != last_state_ &&
         (snapshots_.empty() || sample.stamp_s > last_snapshot_s_ + kSnapshotsApart_s);
}

void FollowOutput::draw(const Readings& readings, const FollowStep& step, const Follower& follower,
                        const FollowSample& sample) {
  if (!video_) {
    video_.emplace(follower.floor(), follower.robot().drive);
    drawn_.emplace(follower.robot().camera);
    if (film_wanted_) film_.emplace(output_ / "follow.mp4", kFilmRate_hz, video_->size());
  }
  Frame seen;
  seen.stamp_s = readings.stamp_s;
  seen.image_bgr = readings.stereo->left_bgr;
  if (step.perception != nullptr) {
    frame_.view = drawn_->of(seen, *follower.perception(), *step.perception, step.robot.pose);
  } else {
    frame_.view.image_bgr = seen.image_bgr;
    frame_.view.mask.release();
    frame_.view.camera = follower.robot().camera.camera.left;
    frame_.view.stamp_s = readings.stamp_s;
  }
  frame_.view.T_floor_camera = basePose(step.robot.pose) * follower.robot().camera.T_base_camera;
  frame_.view.state = wordsOf(step.state());
  frame_.view.reason = step.reason;
  frame_.view.tone = toneOf(step);
  frame_.robot_true = sample.robot_true;
  frame_.robot_estimated = sample.robot_estimated;
  frame_.position_sigma_m = sample.position_sigma_m;
  frame_.person_true = sample.person_true;
  frame_.target_estimate = sample.target_estimate;
  frame_.others_true = sample.others_true;
  frame_.obstacles = follower.obstacles().obstacles();
  frame_.obstacle_cell_m = follower.obstacles().window().cell_size_m();
  frame_.path.clear();
  if (step.path != nullptr) frame_.path = *step.path;
  frame_.robot_trail.push_back(sample.robot_true.position);
  if (sample.person_true) frame_.person_trail.push_back(*sample.person_true);
  video_->draw(frame_, picture_);
}

// The states' beginnings; of too many every second one goes.
void FollowOutput::keepSnapshot(const FollowSample& sample) {
  last_snapshot_s_ = sample.stamp_s;
  PackedSnapshot& snapshot = snapshots_.emplace_back();
  snapshot.stamp_s = sample.stamp_s;
  snapshot.caption = wordsOf(sample.state);
  cv::imencode(".jpg", picture_, snapshot.jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
  if (snapshots_.size() < 2 * kMostSnapshots) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < snapshots_.size(); i += 2) {
    std::swap(snapshots_[kept++], snapshots_[i]);
  }
  snapshots_.resize(kept);
}

void FollowOutput::commit(FollowLog& log, const FollowSummary& summary) {
  for (int i = 1; i < kFollowStages; ++i) {
    const auto stage = static_cast<std::size_t>(i);
    log.stages.push_back(summaryOf(toText(static_cast<FollowStage>(i)), times_ms_[stage]));
  }
  log.step = summaryOf("step", steps_ms_);
  const std::size_t step = 1 + snapshots_.size() / (kMostSnapshots + 1);
  for (std::size_t i = 0; i < snapshots_.size(); i += step) {
    const PackedSnapshot& snapshot = snapshots_[i];
    log.snapshots.push_back(
        {snapshot.stamp_s, snapshot.caption, cv::imdecode(snapshot.jpeg, cv::IMREAD_COLOR)});
  }
  PageFilm film;
  if (film_) {
    film_->close();
    film.name = film_->path().filename().string();
    film.rate_hz = kFilmRate_hz;
    film.stamps_s = std::move(film_stamps_s_);
  }
  writeFollowFiles(output_, log, summary);
  writeFollowPage(output_ / "report.html", log, summary, film);
  const bool complete = summary.outcome != kStoppedRun;
  output_.commit(complete);
  if (bag_) bag_->commit(complete);
}

std::string FollowOutput::fileNames() const {
  std::string names = "report.html, summary.json, follow.csv, timing.csv";
  if (film_) names += ", " + film_->path().filename().string();
  if (bag_) names += "; and " + bag_->path().string();
  return names;
}

}  // namespace heel
