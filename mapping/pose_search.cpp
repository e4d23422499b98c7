// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/motion_model.hpp>
#include <heel/mapping/pose_search.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

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
  if (!(params.poses_per_m2 > 0.0) || params.min_poses == 0 ||
      params.max_poses < params.min_poses) {
    throw std::invalid_argument("PoseSearch: numbers of poses must be positive and in order");
  }
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
  poses_ = std::clamp(static_cast<std::size_t>(params.poses_per_m2 * area_m2), params.min_poses,
                      params.max_poses);
  tried_.reserve(poses_);
  for (auto* values : {&cosine_, &sine_, &log_likelihood_}) values->reserve(poses_);
}

void PoseSearch::find(const BeamEnds& ends, double effort, std::size_t count, RandomNumbers& random,
                      ParticleSet& to) {
  constexpr double kTwoPi = 6.283185307179586;
  const auto poses = static_cast<std::size_t>(std::ceil(effort * static_cast<double>(poses_)));
  tried_.resize(poses);
  for (auto* values : {&cosine_, &sine_, &log_likelihood_}) values->resize(poses);
  for (std::size_t i = 0; i < poses; ++i) {
    const Eigen::Vector2f& middle = free_m_[random.below(free_m_.size())];
    tried_.x_m[i] = middle.x() + cell_size_m_ * static_cast<float>(random.uniform() - 0.5);
    tried_.y_m[i] = middle.y() + cell_size_m_ * static_cast<float>(random.uniform() - 0.5);
    tried_.yaw_rad[i] = static_cast<float>(kTwoPi * (random.uniform() - 0.5));
    cosine_[i] = std::cos(tried_.yaw_rad[i]);
    sine_[i] = std::sin(tried_.yaw_rad[i]);
  }
  field_.score(ends, poses, tried_.x_m.data(), tried_.y_m.data(), cosine_.data(), sine_.data(),
               log_likelihood_.data());
  tried_.setEqualWeights();
  tried_.weigh(log_likelihood_.data(), params_.evidence);
  const std::size_t first = to.size();
  drawSystematic(tried_, count, random, to);
  shakeParticles(params_.shake_m, params_.shake_rad, first, random, to);
}

}  // namespace heel
