// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How likely a laser beam is to end at a place of the map.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <cstddef>
#include <vector>

namespace heel {

/// Where beams ended, in the robot's base frame [m]; x and y apart, for loops over many.
struct BeamEnds {
  std::vector<float> x;
  std::vector<float> y;

  std::size_t size() const { return x.size(); }
  void clear() {
    x.clear();
    y.clear();
  }
  void reserve(std::size_t count) {
    x.reserve(count);
    y.reserve(count);
  }
  void add(const Eigen::Vector2d& end) {
    x.push_back(static_cast<float>(end.x()));
    y.push_back(static_cast<float>(end.y()));
  }
};

/// The mixture that a beam's end is drawn from. Beams without an end (no return) say nothing.
struct LikelihoodFieldParams {
  /// Standard deviation of a beam's end from the surface on the map that it hits.
  double hit_m = 0.1;
  /// Share of the beams that end at what the map shows; the others end anywhere.
  double hit_share = 0.7;
  /// Ends that the map does not explain are spread evenly over this range.
  double random_over_m = 20.0;
  double far_m = 2.0;  ///< Greater distances between an end and the map count as this one.
};

/// Distance to the nearest mapped surface, and the log-likelihood of a beam's end, cell by cell:
///
///   log(hit_share N(d; 0, hit_m^2) + (1 - hit_share) / random_over_m)
///
/// with d the distance from the cell's middle to the rim of the nearest surface cell. Surface cells
/// are occupied ones beside a cell that is not: deep inside a cupboard nothing ends. Outside the
/// map nothing is near. (Thrun, Burgard, Fox: Probabilistic Robotics, 6.4.) Not changed once built.
class LikelihoodField {
 public:
  /// @throws std::invalid_argument  if the map is empty or a parameter is out of range.
  explicit LikelihoodField(const OccupancyGrid& map, const LikelihoodFieldParams& params = {});

  /// From the middle of the cell that holds a point to the nearest surface [m], at most far_m.
  double distance_m(const Eigen::Vector2d& point) const;
  /// Of a beam that ends at a point.
  double logLikelihood(const Eigen::Vector2d& end) const;
  /// Of a beam that ends `distance_m` from the nearest surface.
  double logLikelihoodAt(double distance_m) const;

  /// Adds up the log-likelihoods of all ends for every one of `count` robot poses.
  /// @param cosine,sine  Of the heading of each.
  void score(const BeamEnds& ends, std::size_t count, const float* x_m, const float* y_m,
             const float* cosine, const float* sine, float* sums) const;

  /// How far it is to the first surface from `origin` towards `angle_rad` [m]; 0 in an occupied
  /// cell, `max_m` where there is none before.
  double castRay(const Eigen::Vector2d& origin, double angle_rad, double max_m) const;

  const LikelihoodFieldParams& params() const { return params_; }

 private:
  /// Index of the padded cell that holds a point; one of the padding's if it is outside.
  std::size_t cellOf(double x_m, double y_m) const;

  LikelihoodFieldParams params_;
  Eigen::Vector2d corner_m_;  // Of the padded grid: a ring of cells stands for all outside.
  double cell_size_m_;
  int width_;                      // With padding.
  int height_;                     // With padding.
  std::vector<float> distance_m_;  // Negative in occupied cells.
  std::vector<float> log_likelihood_;
};

}  // namespace heel
