// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where on the whole map a scan could have been taken.
#pragma once

#include "mapping/likelihood_field.hpp"
#include "mapping/particle_set.hpp"

#include <vector>

namespace heel {

/// How densely the map is searched.
struct PoseSearchParams {
  double poses_per_m2 = 500.0;     ///< Of free floor, all headings together.
  std::size_t min_poses = 2000;    ///< On a small map.
  std::size_t max_poses = 200000;  ///< On a large one.
  double hit_m = 0.3;        ///< The likelihood field's deviation, wide enough for so few poses.
  double evidence = 0.15;    ///< As LocalizationParams::evidence.
  double clearance_m = 0.2;  ///< Poses are at least this far from what the map shows.
  double shake_m = 0.1;      ///< Found poses are shaken by this, for they are coarse ...
  double shake_rad = 0.07;   ///< ... and by this.
};

/// Finds poses by scoring many, drawn evenly over the free cells of a map.
class PoseSearch {
 public:
  /// @throws std::invalid_argument  if no cell is free.
  PoseSearch(const OccupancyGrid& map, const LikelihoodFieldParams& field,
             const PoseSearchParams& params);

  /// Appends `count` poses to `to`, drawn by how well the scan fits there.
  /// @param effort  Share of all the poses that are tried.
  void find(const BeamEnds& ends, double effort, std::size_t count, RandomNumbers& random,
            ParticleSet& to);

 private:
  PoseSearchParams params_;
  LikelihoodField field_;
  std::vector<Eigen::Vector2f> free_m_;  // Middles of cells.
  float cell_size_m_;
  std::size_t poses_;
  ParticleSet tried_;
  std::vector<float> cosine_, sine_, log_likelihood_;
};

}  // namespace heel
