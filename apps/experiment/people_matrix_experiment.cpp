// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/people_matrix_experiment.hpp>
#include <heel/apps/experiment/seen_at.hpp>
#include <heel/apps/experiment/truth_lessons.hpp>
#include <heel/apps/follower/perception.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <set>

namespace heel {
namespace {

/// Frames of the second half of everyone's exact ones.
std::vector<std::set<std::size_t>> judgedFrames(const TruthFrames& truth) {
  std::vector<std::set<std::size_t>> judged;
  for (const std::string& person : truth.people()) {
    const auto exact = truth.exactFrames(person);
    judged.emplace_back(exact.begin() + static_cast<std::ptrdiff_t>(exact.size() / 2), exact.end());
  }
  return judged;
}

/// One model over the whole recording: a row of the matrix.
std::vector<DetectionRun> lookForAll(const std::filesystem::path& path, const CameraSetup& setup,
                                     const TruthFrames& truth, const AppearanceModel& model,
                                     const ExperimentParams& params) {
  const auto judged = judgedFrames(truth);
  const double reach_m = params.tracker_distance_m;
  const PerceptionParams perception_params;
  Perception perception(setup, model, perception_params);
  std::vector<DetectionRun> row(truth.people().size());
  const auto recording = openRecording(path);
  Frame frame;
  while (recording->next(frame)) {
    if (frame.stamp_s <= params.background_s) continue;
    const PerceptionStep& step = perception.step(frame);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (judged[i].count(frame.number) == 0) continue;
      const Eigen::Vector2d place = *truth.placeOf(truth.people()[i], frame.number);
      const double appearance = targetProbabilityAt(place, perception, reach_m);
      ++row[i].frames_in_view;
      row[i].appearance_sum += appearance;
      row[i].followed += appearance > perception_params.target.take_above ? 1 : 0;
      row[i].blob += blobScoreAt(place, step.observations, reach_m) > 0.0 ? 1 : 0;
    }
  }
  return row;
}

}  // namespace

std::vector<ModelRuns> runPeopleMatrixExperiment(const std::filesystem::path& recording,
                                                 const std::vector<OfferedModel>& models,
                                                 const ExperimentParams& params,
                                                 const std::function<void(double)>& progress) {
  const TruthFrames truth(recording);
  const CameraSetup setup = findCameraSetup(*openRecording(recording));
  const auto lessons = learnEveryone(recording, setup, truth, models, params);
  std::vector<ModelRuns> results;
  for (std::size_t kind = 0; kind < models.size(); ++kind) {
    ModelRuns& runs =
        results.emplace_back(ModelRuns{models[kind].name, ConfusionMatrix(truth.people()), {}});
    tbb::parallel_for(std::size_t{0}, lessons.size(), [&](std::size_t i) {
      const std::optional<AppearanceModel> model = lessons[i].learn(kind);
      if (!model) return;
      const auto row = lookForAll(recording, setup, truth, *model, params);
      for (std::size_t j = 0; j < row.size(); ++j) runs.matrix.at(i, j) = row[j];
    });
    if (progress) {
      progress(static_cast<double>(kind + 1) / static_cast<double>(models.size()));
    }
  }
  return results;
}

}  // namespace heel
