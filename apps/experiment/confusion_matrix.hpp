// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Every model against every person: who is detected with whose model (section 4.1), counted
/// and drawn.
#pragma once

#include <heel/apps/experiment/proportion.hpp>

#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// One run: one person's recording, searched with one model.
struct DetectionRun {
  int frames_in_view = 0;       ///< Frames with the person in view; the next two are of these.
  int followed = 0;             ///< The target is said to be at the person's place.
  int blob = 0;                 ///< A blob large and high enough for a person is at their place.
  int elsewhere = 0;            ///< Frames in which the target is said to be at some other place.
  double appearance_sum = 0.0;  ///< That the track at the person's place is the target.

  /// Mean appearance in view; 0 if never in view.
  double appearance() const { return frames_in_view == 0 ? 0.0 : appearance_sum / frames_in_view; }
};

/// When a run counts as a detection.
enum class DetectionRule {
  kFollowed,  ///< Heel's: the target was followed at the person's place.
  kBlob,      ///< The paper's: its colours make a blob there, however little of the body has them.
};

/// What is counted of a matrix, as the paper counts it.
struct ConfusionCount {
  Proportion false_negatives;  ///< Own model, not detected.
  Proportion false_positives;  ///< Another's model, detected.

  void add(const ConfusionCount& other) {
    false_negatives.add(other.false_negatives);
    false_positives.add(other.false_positives);
  }
};

/// The runs of all models over all recordings.
class ConfusionMatrix {
 public:
  explicit ConfusionMatrix(std::vector<std::string> people)
      : people_(std::move(people)), runs_(people_.size() * people_.size()) {}

  const std::vector<std::string>& people() const { return people_; }
  std::size_t size() const { return people_.size(); }

  DetectionRun& at(std::size_t model_of, std::size_t person) {
    return runs_[model_of * size() + person];
  }
  const DetectionRun& at(std::size_t model_of, std::size_t person) const {
    return runs_[model_of * size() + person];
  }

  /// The share of the frames with the person in view in which the rule holds; 0 without any.
  double share(std::size_t model_of, std::size_t person, DetectionRule rule) const;

  /// A run is a detection when the rule holds in at least `min_share` of the frames that have the
  /// person in view.
  bool detected(std::size_t model_of, std::size_t person, DetectionRule rule,
                double min_share) const;

  /// @param without  A person to leave out, as the paper does with one of its similar pair.
  ConfusionCount count(DetectionRule rule, double min_share,
                       std::optional<std::size_t> without = {}) const;

  /// The recordings that look more like their own person's model than like anybody else's: what
  /// appearance alone can tell, whatever the threshold.
  Proportion identified() const;

 private:
  std::vector<std::string> people_;
  std::vector<DetectionRun> runs_;
};

/// One matrix of the picture.
struct ConfusionPanel {
  std::string title;
  std::string note;                 ///< Under the title.
  std::vector<std::string> people;  ///< Of the rows (whose model) and of the columns (who is seen).
  std::vector<double> shares;       ///< Row by row, in [0, 1]; NaN leaves a cell empty.
};

/// Matrices side by side, four in a row. On the diagonal, where much is right, cells turn green;
/// off it, where anything is wrong, they turn red. Each cell shows its share in percent.
/// @throws std::invalid_argument  if a panel has not people * people shares.
cv::Mat drawConfusion(const std::string& title, const std::vector<ConfusionPanel>& panels);

}  // namespace heel
