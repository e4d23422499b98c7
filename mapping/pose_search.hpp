// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where on the whole map a scan could have been taken.
#pragma once

#include <heel/mapping/likelihood_field.hpp>
#include <heel/mapping/particle_set.hpp>

#include <vector>

namespace heel {

/// How densely the map is searched.
struct PoseSearchParams {
  /// Standard deviation of a beam's end from the map, wide enough for so few poses.
  double hit_m = 0.3;
  /// Factor on the log-likelihoods of beams, as LocalizationParams::evidence.
  double evidence = 0.15;
  double clearance_m = 0.2;  ///< Poses are at least this far from what the map shows.
};

/// Finds poses by scoring many, drawn evenly over the free cells of a map.
class PoseSearch {
 public:
  /// @throws std::invalid_argument  if no cell is free.
  PoseSearch(const OccupancyGrid& map, const LikelihoodFieldParams& field,
             const PoseSearchParams& params);

  /// All the poses that a whole search tries, of which there are 5 million at the most.
  std::size_t poses() const { return poses_; }

  /// Appends `count` poses to `to`, drawn by how well the scan fits there.
  /// @param poses  So many are tried, at least one.
  void find(const BeamEnds& ends, std::size_t poses, std::size_t count, RandomNumbers& random,
            ParticleSet& to);

 private:
  PoseSearchParams params_;
  LikelihoodField field_;
  std::vector<Eigen::Vector2f> free_m_;  // Middles of cells.
  float cell_size_m_;
  std::size_t poses_;
  ParticleSet tried_, kept_;  // In kept_, weights are log-likelihoods until the end.
  std::vector<float> cosine_, sine_, log_likelihood_;
};

}  // namespace heel
