// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/appearance_experiment.hpp"

#include "apps/experiment/model_lessons.hpp"
#include "apps/experiment/simulated_frames.hpp"
#include "apps/follower/acquisition.hpp"
#include "apps/follower/depth_images.hpp"
#include "apps/simulation/random.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace heel {
namespace {

constexpr double kEnters_s = 1.2;  // So long people take into view.

using Models = std::vector<std::optional<AppearanceModel>>;

/// The points whose pixels are surely the person's.
pcl::Indices personPoints(const AcquisitionStep& step) {
  pcl::Indices indices;
  const auto* labels = step.labels.ptr<std::uint8_t>();
  for (const auto i : *step.view->candidates) {
    if (labels[i] == AcquisitionStep::kTorso || labels[i] == AcquisitionStep::kLegs) {
      indices.push_back(i);
    }
  }
  return indices;
}

/// Phase 1 for all models at once.
class Lesson {
 public:
  Lesson(const CameraSetup& setup, const AppearanceExperimentParams& params)
      : depths_(setup.sensor, setup.camera, params.perception.stereo),
        acquisition_(setup.camera.left, setup.T_base_camera, acquisitionParams(params)),
        lessons_(params.models) {}

  void add(const Frame& frame) {
    const AcquisitionStep& step =
        acquisition_.step(frame.stamp_s, frame.image_bgr, depths_.of(frame));
    if (!step.usable) return;
    lessons_.addRoom(frame.image_bgr, step.labels == AcquisitionStep::kScene);
    if (step.person >= 0) lessons_.addPerson(*step.view->cloud, personPoints(step));
  }

  const AcquisitionResult& result() const { return acquisition_.result(); }
  Models learn() const { return lessons_.learn(); }

 private:
  static AcquisitionParams acquisitionParams(const AppearanceExperimentParams& params) {
    AcquisitionParams acquisition;
    acquisition.background_s = params.empty_s;
    acquisition.person_s = params.person_s;
    return acquisition;
  }

  DepthImages depths_;
  Acquisition acquisition_;
  ModelLessons lessons_;
};

bool isNear(const Eigen::Vector2d& a, const std::optional<Eigen::Vector2d>& b, double distance_m) {
  return b && (a - *b).norm() <= distance_m;
}

/// With what the map of the recording's room rules out.
PerceptionParams perceptionParams(const SimulatedFrames& recording,
                                  const AppearanceExperimentParams& params) {
  PerceptionParams result = params.perception;
  result.gate = recording.gate;
  return result;
}

DetectionRun look(const SimulatedFrames& recording, const AppearanceModel& model,
                  const AppearanceExperimentParams& params) {
  Perception perception(recording.setup, model, perceptionParams(recording, params));
  DetectionRun run;
  for (const SimulatedFrame& now : recording.frames) {
    const PerceptionStep& step = perception.step(now.frame);
    const auto& person = now.people_m.front();
    const bool followed = step.target.status == TargetStatus::kFollowed;
    const bool there =
        followed && isNear(step.target.motion.position_m(), person, params.place_error_m);
    run.elsewhere += followed && !there ? 1 : 0;
    if (!person) continue;
    ++run.frames_in_view;
    run.followed += there ? 1 : 0;
    run.blob += std::any_of(step.observations.begin(), step.observations.end(),
                            [&](const Observation& seen) {
                              return isNear(seen.position_m, person, params.place_error_m);
                            })
                    ? 1
                    : 0;
  }
  return run;
}

/// The appearance of the confirmed track nearest to a place; 0 without one.
double appearanceAt(const Eigen::Vector2d& place, const std::vector<Track>& tracks,
                    double distance_m) {
  double appearance = 0.0;
  for (const Track& track : tracks) {
    const double away_m = (track.motion.position_m() - place).norm();
    if (track.status != TrackStatus::kConfirmed || away_m > distance_m) continue;
    distance_m = away_m;
    appearance = track.appearance();
  }
  return appearance;
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

/// Which two of the recording's people `target` and `other` are.
PairTest comparePair(const SimulatedFrames& recording, std::size_t target, std::size_t other,
                     const AppearanceModel& model, const AppearanceExperimentParams& params) {
  Perception perception(recording.setup, model, perceptionParams(recording, params));
  PairTest test;
  const double reach_m = params.place_error_m;
  for (const SimulatedFrame& now : recording.frames) {
    const PerceptionStep& step = perception.step(now.frame);
    const auto &target_m = now.people_m[target], other_m = now.people_m[other];
    if (!target_m || !other_m) continue;
    ++test.frames;
    test.target_appearance += appearanceAt(*target_m, perception.tracks(), reach_m);
    test.other_appearance += appearanceAt(*other_m, perception.tracks(), reach_m);
    test.target_blob_score += blobScoreAt(*target_m, step.observations, reach_m);
    test.other_blob_score += blobScoreAt(*other_m, step.observations, reach_m);
    if (step.target.status != TargetStatus::kFollowed) continue;
    const Eigen::Vector2d place = step.target.motion.position_m();
    const bool on_target = isNear(place, target_m, reach_m);
    test.followed_target += on_target ? 1 : 0;
    test.followed_other += !on_target && isNear(place, other_m, reach_m) ? 1 : 0;
  }
  const double n = std::max(test.frames, 1);
  for (double* mean : {&test.target_appearance, &test.other_appearance, &test.target_blob_score,
                       &test.other_blob_score}) {
    *mean /= n;
  }
  return test;
}

/// Runs one wardrobe; keeps what the models share.
class Experiment {
 public:
  Experiment(const Wardrobe& wardrobe, const AppearanceExperimentParams& params,
             const std::function<void(double)>& progress)
      : wardrobe_(wardrobe),
        params_(params),
        progress_(progress),
        rooms_(params.scenes, wardrobe.seed),
        size_(wardrobe.people.size()) {}

  WardrobeRuns run() {
    result_.seed = wardrobe_.seed;
    result_.similar = wardrobe_.similar;
    std::vector<std::string> names;
    for (const ScenePerson& person : wardrobe_.people) names.push_back(person.name);
    for (const OfferedModel& model : params_.models) {
      result_.models.push_back({model.name, ConfusionMatrix(names), {}});
    }
    learnEveryone();
    recordTrials();
    lookForEveryone();
    comparePairs();
    return std::move(result_);
  }

 private:
  void done(double share) const {
    if (progress_) progress_(share);
  }
  std::uint64_t seedFor(std::uint64_t what, std::uint64_t who) const {
    return hashOf(wardrobe_.seed, 15, what, who);
  }

  /// The empty room is the same for everyone, so it is rendered once.
  void learnEveryone() {
    SimulatedFramesParams span;
    span.seed = seedFor(0, 0);
    span.to_s = params_.empty_s;
    Scene room = rooms_.acquisition(wardrobe_.people.front(), params_.empty_s, span.seed);
    room.people.clear();
    const SimulatedFrames empty = renderFrames(room, span);
    for (std::size_t i = 0; i < size_; ++i) {
      span.seed = seedFor(1, i);
      span.from_s = params_.empty_s + kEnters_s;
      span.to_s = span.from_s + params_.person_s;
      const SimulatedFrames person =
          renderFrames(rooms_.acquisition(wardrobe_.people[i], params_.empty_s, span.seed), span);
      Lesson lesson(empty.setup, params_);
      for (const SimulatedFrame& now : empty.frames) lesson.add(now.frame);
      for (const SimulatedFrame& now : person.frames) lesson.add(now.frame);
      result_.acquired.push_back(
          {wardrobe_.people[i].name, lesson.result().person_frames, lesson.result().end});
      models_.push_back(lesson.learn());
      done(0.1 + 0.5 * static_cast<double>(i + 1) / static_cast<double>(size_));
    }
  }

  void recordTrials() {
    SimulatedFramesParams span;
    span.from_s = kEnters_s;
    span.to_s = kEnters_s + params_.trial_s;
    for (std::size_t i = 0; i < size_; ++i) {
      span.seed = seedFor(2, i);
      trials_.push_back(renderFrames(rooms_.trial({wardrobe_.people[i]}, span.seed), span));
      done(0.6 + 0.2 * static_cast<double>(i + 1) / static_cast<double>(size_));
    }
  }

  void lookForEveryone() {
    tbb::parallel_for(std::size_t{0}, params_.models.size() * size_ * size_, [&](std::size_t cell) {
      const std::size_t kind = cell / (size_ * size_);
      const std::size_t model_of = cell / size_ % size_, person = cell % size_;
      const auto& model = models_[model_of][kind];
      if (!model) return;
      result_.models[kind].matrix.at(model_of, person) = look(trials_[person], *model, params_);
    });
    done(0.9);
  }

  /// Both persons of every confusion in one recording.
  void comparePairs() {
    std::map<std::pair<std::size_t, std::size_t>, SimulatedFrames> recordings;
    for (std::size_t kind = 0; kind < params_.models.size(); ++kind) {
      ModelRuns& runs = result_.models[kind];
      for (std::size_t i = 0; i < size_; ++i) {
        for (std::size_t j = 0; j < size_; ++j) {
          if (i == j || !models_[i][kind]) continue;
          if (!runs.matrix.detected(i, j, DetectionRule::kFollowed, params_.min_share)) continue;
          const auto [found, isNew] = recordings.try_emplace(std::minmax(i, j));
          if (isNew) found->second = recordPair(found->first.first, found->first.second);
          PairTest test =
              comparePair(found->second, i < j ? 0 : 1, i < j ? 1 : 0, *models_[i][kind], params_);
          test.target = i;
          test.other = j;
          runs.pairs.push_back(test);
        }
      }
    }
    done(1.0);
  }

  SimulatedFrames recordPair(std::size_t a, std::size_t b) const {
    SimulatedFramesParams span;
    span.from_s = kEnters_s;
    span.to_s = kEnters_s + params_.trial_s;
    span.seed = seedFor(3, a * size_ + b);
    return renderFrames(rooms_.trial({wardrobe_.people[a], wardrobe_.people[b]}, span.seed), span);
  }

  const Wardrobe& wardrobe_;
  const AppearanceExperimentParams& params_;
  const std::function<void(double)>& progress_;
  WardrobeRooms rooms_;
  std::size_t size_;
  std::vector<Models> models_;           // By person, by kind of model.
  std::vector<SimulatedFrames> trials_;  // By person.
  WardrobeRuns result_;
};

}  // namespace

WardrobeRuns runAppearanceExperiment(const Wardrobe& wardrobe,
                                     const AppearanceExperimentParams& params,
                                     const std::function<void(double)>& progress) {
  return Experiment(wardrobe, params, progress).run();
}

}  // namespace heel
