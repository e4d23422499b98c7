// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// True places by frame and by person.
#pragma once

#include <heel/apps/results/result_files.hpp>
#include <heel/tracking/target_metrics.hpp>

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

}  // namespace heel
