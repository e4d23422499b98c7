// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Weighted robot poses, how many are enough, and drawing new ones from old ones.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/random_numbers.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heel {

/// Weighted poses on the floor, as arrays side by side. Weights add up to 1 once normalised.
struct ParticleSet {
  std::vector<float> x_m;
  std::vector<float> y_m;
  std::vector<float> yaw_rad;
  std::vector<float> weight;

  std::size_t size() const { return x_m.size(); }
  FloorPose pose(std::size_t i) const;

  void reserve(std::size_t count);
  void resize(std::size_t count);
  void clear() { resize(0); }
  void add(const FloorPose& pose);
  void setEqualWeights();

  /// Multiplies each weight with exp(share * (log_likelihood[i])) and makes them add up to 1. Only
  /// differences between log-likelihoods count, so no sum is too small to be told from 0.
  void weigh(const float* log_likelihood, double share);

  /// 1 / sum of squared weights: how many particles of equal weight would be worth as much.
  double effectiveSize() const;
};

/// Appends `count` particles of `from`, each as often as its share of the weight says, give or take
/// one (systematic resampling, linear in both sizes; Probabilistic Robotics, table 4.4). Weights
/// are left to the caller.
void drawSystematic(const ParticleSet& from, std::size_t count, RandomNumbers& random,
                    ParticleSet& to);

/// How many particles keep the Kullback-Leibler distance from the true distribution under `error`
/// when that fills `bins` bins, with the confidence of the standard normal's quantile (Fox 2003:
/// Adapting the sample size in particle filters through KLD-sampling, formula 7).
std::size_t kldParticles(std::size_t bins, double error, double quantile);

/// Counts bins of place and heading that hold something. Its memory is reused.
class PoseBins {
 public:
  /// @param capacity  Most poses that are added between two clears.
  PoseBins(double place_m, double heading_rad, std::size_t capacity);

  void clear();
  /// Adds weight to a pose's bin, whose number from 0 is returned.
  std::size_t add(float x_m, float y_m, float yaw_rad, float weight);

  std::size_t count() const { return bins_.size(); }
  /// The number of the bin with the most weight; there must be one.
  std::size_t heaviest() const;

 private:
  struct Bin {
    std::uint64_t key;
    float weight;
  };
  double per_m_;
  double per_rad_;
  std::vector<std::uint32_t> slots_;  // 1 + the number of a bin; 0 = free.
  std::vector<std::uint32_t> used_;   // The slots that are not.
  std::vector<Bin> bins_;
};

}  // namespace heel
