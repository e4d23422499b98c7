// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/motion_model.hpp>
#include <heel/mapping/pose_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kPosesPer_m2 = 500.0;   // That are tried, all headings together,
constexpr std::size_t kMinPoses = 2000;  // and at least so many, on a small map.
// Standard deviations by which found poses are shaken, for the search is coarse.
constexpr double kShake_m = 0.1;
constexpr double kShake_rad = 0.07;

constexpr std::size_t kPart = 16384;         // Poses that are scored at once.
constexpr std::size_t kMostPoses = 5000000;  // For a second or two.
constexpr float kNegligible = 16.0F;  // A pose this much less likely than the best is never drawn.

LikelihoodFieldParams widened(LikelihoodFieldParams field, double hit_m) {
  field.hit_m = hit_m;
  return field;
}

}  // namespace

PoseSearch::PoseSearch(const OccupancyGrid& map, const LikelihoodFieldParams& field,
                       const PoseSearchParams& params)
    : params_(params),
      field_(map, widened(field, params.hit_m)),
      cell_size_m_(static_cast<float>(map.cell_size_m())) {
  for (const double clearance_m : {params.clearance_m, -1.0}) {  // A narrow map has to do.
    for (GridCell c; c.y < map.height(); ++c.y) {
      for (c.x = 0; c.x < map.width(); ++c.x) {
        if (map.at(c) != Occupancy::kFree) continue;
        const Eigen::Vector2d middle = map.center(c);
        if (field_.distance_m(middle) >= clearance_m) free_m_.emplace_back(middle.cast<float>());
      }
    }
    if (!free_m_.empty()) break;
  }
  if (free_m_.empty()) throw std::invalid_argument("PoseSearch: the map has no free cell");
  const double area_m2 =
      static_cast<double>(free_m_.size()) * map.cell_size_m() * map.cell_size_m();
  poses_ =
      std::min(std::max(static_cast<std::size_t>(kPosesPer_m2 * area_m2), kMinPoses), kMostPoses);
  tried_.resize(kPart);
  kept_.reserve(std::min(poses_, 4 * kPart));
  for (auto* values : {&cosine_, &sine_, &log_likelihood_}) values->resize(kPart);
}

// In parts, of which only what is not much worse than the best is kept: a large building takes
// millions of poses.
void PoseSearch::find(const BeamEnds& ends, std::size_t poses, std::size_t count,
                      RandomNumbers& random, ParticleSet& to) {
  constexpr double kTwoPi = 2.0 * M_PI;
  const auto evidence = static_cast<float>(params_.evidence);
  kept_.clear();
  float best = -std::numeric_limits<float>::infinity();
  for (std::size_t done = 0; done < poses;) {
    const std::size_t part = std::min(kPart, poses - done);
    done += part;
    for (std::size_t i = 0; i < part; ++i) {
      const Eigen::Vector2f& middle = free_m_[random.below(free_m_.size())];
      tried_.x_m[i] = middle.x() + cell_size_m_ * static_cast<float>(random.uniform() - 0.5);
      tried_.y_m[i] = middle.y() + cell_size_m_ * static_cast<float>(random.uniform() - 0.5);
      tried_.yaw_rad[i] = static_cast<float>(kTwoPi * (random.uniform() - 0.5));
      cosine_[i] = std::cos(tried_.yaw_rad[i]);
      sine_[i] = std::sin(tried_.yaw_rad[i]);
    }
    field_.score(ends, part, tried_.x_m.data(), tried_.y_m.data(), cosine_.data(), sine_.data(),
                 log_likelihood_.data());
    float part_best = best;
    for (std::size_t i = 0; i < part; ++i) {
      log_likelihood_[i] *= evidence;
      part_best = std::max(part_best, log_likelihood_[i]);
    }
    best = part_best;
    for (std::size_t i = 0; i < part; ++i) {
      if (log_likelihood_[i] < best - kNegligible) continue;
      kept_.add(tried_.pose(i));
      kept_.weight.back() = log_likelihood_[i];
    }
  }
  for (float& w : kept_.weight) w = std::exp(w - best);
  const std::size_t first = to.size();
  drawSystematic(kept_, count, random, to);
  shakeParticles(kShake_m, kShake_rad, first, random, to);
}

}  // namespace heel
