// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// True places by frame and by person, what is learned there, and who was seen there.
#pragma once

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/offered_models.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/tracking/target_metrics.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// truth.csv of a recording, to be asked by frame number.
class TruthFrames {
 public:
  /// @throws std::runtime_error  as readTruth().
  explicit TruthFrames(const std::filesystem::path& recording);

  /// Everyone in a frame.
  const std::vector<TruthRow>& at(std::size_t frame) const;

  /// Everyone's name, in order of their first frame.
  const std::vector<std::string>& people() const { return people_; }

  /// Where someone is in a frame, if in view.
  std::optional<Eigen::Vector2d> placeOf(const std::string& person, std::size_t frame) const;

  /// The first frame in which somebody besides `person` is in view; 0 if there is none.
  std::size_t firstFrameOfOthers(const std::string& person) const;

  /// The frames in which someone's place is exact, in order.
  std::vector<std::size_t> exactFrames(const std::string& person) const;

  /// A frame for the target's metrics, with its truth.
  TargetFrame targetFrame(const std::string& person, std::size_t frame, double stamp_s) const;

 private:
  std::map<std::size_t, std::vector<TruthRow>> rows_;
  std::vector<std::string> people_;
};

/// Whether a place is known and no further than that.
bool isNear(const Eigen::Vector2d& a, const std::optional<Eigen::Vector2d>& b, double distance_m);

/// The probability that the confirmed track nearest to a place is the target; 0 without one within
/// the distance.
double targetProbabilityAt(const Eigen::Vector2d& place, const Perception& perception,
                           double distance_m);

/// The score of the blob nearest to a place; 0 without one within the distance.
double blobScoreAt(const Eigen::Vector2d& place, const std::vector<Observation>& observations,
                   double distance_m);

/// What the points near each person's true place, in the first half of the frames where it is
/// exact, and the empty scene teach of them. In the order of truth.people().
std::vector<ModelLessons> learnEveryone(const std::filesystem::path& recording,
                                        const CameraSetup& setup, const TruthFrames& truth,
                                        const std::vector<OfferedModel>& models,
                                        const ExperimentParams& params);

}  // namespace heel
