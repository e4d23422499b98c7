// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/truth_frames.hpp>
#include <heel/apps/follower/depth_images.hpp>

#include <algorithm>
#include <set>
#include <string>

namespace heel {

TruthFrames::TruthFrames(const std::filesystem::path& recording) {
  for (TruthRow& row : readTruth(recording / "truth.csv")) {
    if (std::find(people_.begin(), people_.end(), row.person) == people_.end()) {
      people_.push_back(row.person);
    }
    rows_[row.frame].push_back(std::move(row));
  }
}

const std::vector<TruthRow>& TruthFrames::at(std::size_t frame) const {
  static const std::vector<TruthRow> kNobody;
  const auto found = rows_.find(frame);
  return found == rows_.end() ? kNobody : found->second;
}

std::optional<Eigen::Vector2d> TruthFrames::placeOf(const std::string& person,
                                                    std::size_t frame) const {
  for (const TruthRow& row : at(frame)) {
    if (row.person == person) return row.position_m;
  }
  return std::nullopt;
}

std::size_t TruthFrames::firstFrameOfOthers(const std::string& person) const {
  for (const auto& [frame, rows] : rows_) {
    for (const TruthRow& row : rows) {
      if (row.person != person) return frame;
    }
  }
  return 0;
}

std::vector<std::size_t> TruthFrames::exactFrames(const std::string& person) const {
  std::vector<std::size_t> frames;
  for (const auto& [frame, rows] : rows_) {
    for (const TruthRow& row : rows) {
      if (row.person == person && row.exact) frames.push_back(frame);
    }
  }
  return frames;
}

TargetFrame TruthFrames::targetFrame(const std::string& person, std::size_t frame,
                                     double stamp_s) const {
  TargetFrame result;
  result.stamp_s = stamp_s;
  for (const TruthRow& row : at(frame)) {
    if (row.person == person) {
      result.target_m = row.position_m;
    } else {
      result.others_m.push_back(row.position_m);
    }
  }
  return result;
}

bool isNear(const Eigen::Vector2d& a, const std::optional<Eigen::Vector2d>& b, double distance_m) {
  return b && (a - *b).norm() <= distance_m;
}

double targetProbabilityAt(const Eigen::Vector2d& place, const Perception& perception,
                           double distance_m) {
  double probability = 0.0;
  for (const Track& track : perception.tracks()) {
    const double away_m = (track.motion.position_m() - place).norm();
    if (track.status != TrackStatus::kConfirmed || away_m > distance_m) continue;
    distance_m = away_m;
    probability = perception.identity().targetProbability(track.id);
  }
  return probability;
}

double blobScoreAt(const Eigen::Vector2d& place, const std::vector<Observation>& observations,
                   double distance_m) {
  double score = 0.0;
  for (const Observation& seen : observations) {
    const double away_m = (seen.position_m - place).norm();
    if (away_m > distance_m) continue;
    distance_m = away_m;
    score = seen.score;
  }
  return score;
}

std::vector<ModelLessons> learnEveryone(const std::filesystem::path& path, const CameraSetup& setup,
                                        const TruthFrames& truth,
                                        const std::vector<OfferedModel>& models,
                                        const ExperimentParams& params) {
  std::vector<ModelLessons> lessons(truth.people().size(), ModelLessons(models));
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
  constexpr double kRadius_m = 0.35;  // Points this near to a person's true place are theirs.
  while (recording->next(frame)) {
    if (frame.stamp_s <= params.background_s) {
      for (ModelLessons& lesson : lessons) lesson.addRoom(frame.image_bgr);
      continue;
    }
    makeColorCloud(depths.of(frame), frame.image_bgr, setup.camera.left, setup.T_base_camera,
                   cloud);
    for (std::size_t i = 0; i < lessons.size(); ++i) {
      if (frames_of[i].count(frame.number) == 0) continue;
      const Eigen::Vector2f place = truth.placeOf(truth.people()[i], frame.number)->cast<float>();
      near.clear();
      for (std::size_t p = 0; p < cloud.size(); ++p) {
        const auto offset = cloud[p].getVector3fMap().head<2>() - place;
        if (offset.squaredNorm() < static_cast<float>(kRadius_m * kRadius_m)) {
          near.push_back(static_cast<pcl::index_t>(p));
        }
      }
      lessons[i].addPerson(cloud, near);
      lessons[i].addBody(cloud, near, place.cast<double>());
    }
  }
  return lessons;
}

}  // namespace heel
