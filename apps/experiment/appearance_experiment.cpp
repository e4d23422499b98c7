// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/experiment/offered_models.hpp>
#include <heel/apps/experiment/simulated_frames.hpp>
#include <heel/apps/experiment/truth_frames.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/simulation/random.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

namespace heel {

namespace {

using Models = std::vector<std::optional<AppearanceModel>>;

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
    const bool there = followed && isNear(step.target.motion.position_m(), person, kPlaceError_m);
    run.elsewhere += followed && !there ? 1 : 0;
    if (!person) continue;
    ++run.frames_in_view;
    run.appearance_sum += targetProbabilityAt(*person, perception, kPlaceError_m);
    run.followed += there ? 1 : 0;
    run.blob += std::any_of(step.observations.begin(), step.observations.end(),
                            [&](const Observation& seen) {
                              return isNear(seen.position_m, person, kPlaceError_m);
                            })
                    ? 1
                    : 0;
  }
  return run;
}

/// @param recording  Of these two, the one of the lower number first.
PairTest comparePair(const SimulatedFrames& recording, std::size_t target, std::size_t other,
                     const AppearanceModel& model, const AppearanceExperimentParams& params) {
  Perception perception(recording.setup, model, perceptionParams(recording, params));
  PairTest test;
  test.target = target;
  test.other = other;
  const std::size_t target_at = target < other ? 0 : 1;
  const double reach_m = kPlaceError_m;
  for (const SimulatedFrame& now : recording.frames) {
    const PerceptionStep& step = perception.step(now.frame);
    const auto& target_m = now.people_m[target_at];
    const auto& other_m = now.people_m[1 - target_at];
    if (!target_m || !other_m) continue;
    ++test.frames;
    test.target_appearance += targetProbabilityAt(*target_m, perception, reach_m);
    test.other_appearance += targetProbabilityAt(*other_m, perception, reach_m);
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

/// "#rrggbb".
std::string hexOf(const Rgb& color) {
  std::array<int, 3> level{};
  for (int c = 0; c < 3; ++c) {
    level[static_cast<std::size_t>(c)] =
        static_cast<int>(std::lround(255.0F * toDisplay(color[c])));
  }
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", level[0] & 0xFF, level[1] & 0xFF,
                level[2] & 0xFF);
  return text.data();
}

std::array<std::string, 4> colorsOf(const Outfit& outfit) {
  return {hexOf(outfit.top.front.color), hexOf(outfit.trousers.front.color), hexOf(outfit.hair),
          hexOf(outfit.skin)};
}

/// Runs one wardrobe; keeps what the models share.
class Experiment {
 public:
  Experiment(const Wardrobe& wardrobe, const AppearanceExperimentParams& params,
             const std::function<void(double)>& progress)
      : wardrobe_(wardrobe),
        params_(params),
        progress_(progress),
        rooms_(params.scenes, wardrobe.seed, params.drawn_light),
        size_(wardrobe.people.size()) {}

  WardrobeRuns run() {
    result_.seed = wardrobe_.seed;
    std::vector<std::string> names;
    for (const ScenePerson& person : wardrobe_.people) names.push_back(person.name);
    for (const OfferedModel& model : params_.models) {
      result_.models.push_back({model.name, ConfusionMatrix(names), {}});
    }
    learnEveryone();
    recordTrials();
    for (std::size_t kind = 0; kind < params_.models.size(); ++kind) {
      tryModel(kind);
      done(0.6 + 0.4 * static_cast<double>(kind + 1) / static_cast<double>(params_.models.size()));
    }
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
    const SimulatedFrames empty = record(room, span);
    for (std::size_t i = 0; i < size_; ++i) {
      span.seed = seedFor(1, i);
      span.from_s = params_.empty_s + kEnters_s;
      span.to_s = span.from_s + params_.person_s;
      const SimulatedFrames person =
          record(rooms_.acquisition(wardrobe_.people[i], params_.empty_s, span.seed), span);
      SimulatedLesson lesson =
          takeLesson({&empty, &person}, params_.models, params_.empty_s, params_.person_s);
      result_.acquired.push_back({wardrobe_.people[i].name, colorsOf(wardrobe_.people[i].outfit),
                                  lesson.result.person_frames, toText(lesson.result.end)});
      lessons_.push_back(std::move(lesson.lessons));
      done(0.4 * static_cast<double>(i + 1) / static_cast<double>(size_));
    }
  }

  void recordTrials() {
    SimulatedFramesParams span;
    span.from_s = kEnters_s;
    span.to_s = kEnters_s + params_.trial_s;
    for (std::size_t i = 0; i < size_; ++i) {
      span.seed = seedFor(2, i);
      trials_.push_back(record(rooms_.trial({wardrobe_.people[i]}, span.seed), span));
      done(0.4 + 0.2 * static_cast<double>(i + 1) / static_cast<double>(size_));
    }
  }

  /// Models are large, so only those of one kind are held at a time.
  void tryModel(std::size_t kind) {
    Models models(size_);
    tbb::parallel_for(std::size_t{0}, size_,
                      [&](std::size_t i) { models[i] = lessons_[i].learn(kind); });
    ModelRuns& runs = result_.models[kind];
    tbb::parallel_for(std::size_t{0}, size_ * size_, [&](std::size_t cell) {
      const std::size_t model_of = cell / size_, person = cell % size_;
      if (!models[model_of]) return;
      runs.matrix.at(model_of, person) = look(trials_[person], *models[model_of], params_);
    });
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = 0; j < size_; ++j) {
        if (i == j || !models[i]) continue;
        if (!runs.matrix.detected(i, j, DetectionRule::kFollowed, kDetectedShare)) continue;
        runs.pairs.push_back(comparePair(pairRecording(i, j), i, j, *models[i], params_));
      }
    }
  }

  /// Both persons of a confusion in one recording; the one of the lower number is the first.
  const SimulatedFrames& pairRecording(std::size_t i, std::size_t j) {
    const auto [found, is_new] = pair_recordings_.try_emplace(std::minmax(i, j));
    if (is_new) found->second = recordPair(found->first.first, found->first.second);
    return found->second;
  }

  SimulatedFrames record(const Scene& scene, const SimulatedFramesParams& span) const {
    SimulatedFrames recording = renderFrames(scene, span);
    matchStereo(recording, params_.perception.stereo);
    return recording;
  }

  SimulatedFrames recordPair(std::size_t a, std::size_t b) const {
    SimulatedFramesParams span;
    span.from_s = kEnters_s;
    span.to_s = kEnters_s + params_.trial_s;
    span.seed = seedFor(3, a * size_ + b);
    return record(rooms_.trial({wardrobe_.people[a], wardrobe_.people[b]}, span.seed), span);
  }

  const Wardrobe& wardrobe_;
  const AppearanceExperimentParams& params_;
  const std::function<void(double)>& progress_;
  WardrobeRooms rooms_;
  std::size_t size_;
  std::vector<ModelLessons> lessons_;    // By person.
  std::vector<SimulatedFrames> trials_;  // By person.
  std::map<std::pair<std::size_t, std::size_t>, SimulatedFrames> pair_recordings_;
  WardrobeRuns result_;
};

}  // namespace

WardrobeRuns runAppearanceExperiment(const Wardrobe& wardrobe,
                                     const AppearanceExperimentParams& params,
                                     const std::function<void(double)>& progress) {
  return Experiment(wardrobe, params, progress).run();
}

}  // namespace heel
