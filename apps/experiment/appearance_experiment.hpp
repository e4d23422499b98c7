// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Section 4.1 again: who is detected with whose model, and who looks more like it when two stand
/// side by side.
#pragma once

#include <heel/apps/experiment/confusion_matrix.hpp>
#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/offered_models.hpp>
#include <heel/apps/experiment/random_wardrobe.hpp>
#include <heel/apps/follower/perception.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace heel {

/// A person counts as detected when the target was followed (TargetStatus::kFollowed, which takes
/// a track confirmed over several frames) at their place in this share of the frames that have
/// them in view.
constexpr double kDetectedShare = 0.25;

/// What the runs are like. A person's model comes from a recording with the room empty for
/// `empty_s` and then the person alone; it is tried on another recording, in another room, of each
/// of them.
struct AppearanceExperimentParams {
  double empty_s = 5.0;
  double person_s = 6.0;     ///< How long the person is learned.
  double trial_s = 4.0;      ///< Length of the other recordings.
  bool drawn_light = false;  ///< Whether every recording's light is drawn; see CameraParams.
  std::vector<OfferedModel> models = offeredModels();
  PerceptionParams perception;
  std::filesystem::path scenes;  ///< Folder of the scenes that come with Heel.
};

/// The two-people test: the target and the one who was taken for them, in view together. Means
/// over the frames that have both in view; 0 counts where somebody has no track or no blob.
struct PairTest {
  std::size_t target = 0;
  std::size_t other = 0;
  int frames = 0;
  double target_appearance = 0.0;  ///< Probability of their track: what Heel chooses by.
  double other_appearance = 0.0;
  double target_blob_score = 0.0;  ///< Sum of heights, the paper's score.
  double other_blob_score = 0.0;
  int followed_target = 0;  ///< Frames in which the target was followed at the target's place,
  int followed_other = 0;   ///< and at the other's (and not at the target's).

  bool targetScoresHigher() const { return target_appearance > other_appearance; }
};

/// All runs of one model.
struct ModelRuns {
  std::string model;
  ConfusionMatrix matrix;
  std::vector<PairTest> pairs;  ///< One for each confusion by Heel's rule.
};

/// Somebody, and on what their models rest.
struct Acquired {
  std::string person;
  std::array<std::string, 4> colors;  ///< Of top, trousers, hair and skin: "#rrggbb".
  int frames = 0;                     ///< That show the person.
  std::string end;                    ///< How learning ended, in words.
};

/// All runs over one wardrobe.
struct WardrobeRuns {
  std::uint64_t seed = 0;
  std::vector<Acquired> acquired;
  std::vector<ModelRuns> models;
};

/// Learns, tries and compares five people with all models. The same parameters and wardrobe give
/// the same result.
/// @param progress  Told the share that is done; may be empty.
/// @throws std::runtime_error  as loadScene().
WardrobeRuns runAppearanceExperiment(const Wardrobe& wardrobe,
                                     const AppearanceExperimentParams& params,
                                     const std::function<void(double)>& progress = {});

}  // namespace heel
