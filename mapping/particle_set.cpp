// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/particle_set.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

FloorPose ParticleSet::pose(std::size_t i) const {
  return {{static_cast<double>(x_m[i]), static_cast<double>(y_m[i])},
          static_cast<double>(yaw_rad[i])};
}

void ParticleSet::reserve(std::size_t count) {
  for (auto* values : {&x_m, &y_m, &yaw_rad, &weight}) values->reserve(count);
}

void ParticleSet::resize(std::size_t count) {
  for (auto* values : {&x_m, &y_m, &yaw_rad, &weight}) values->resize(count);
}

void ParticleSet::add(const FloorPose& pose) {
  x_m.push_back(static_cast<float>(pose.position.x()));
  y_m.push_back(static_cast<float>(pose.position.y()));
  yaw_rad.push_back(static_cast<float>(wrapped(pose.yaw_rad)));
  weight.push_back(0.0F);
}

void ParticleSet::setEqualWeights() {
  std::fill(weight.begin(), weight.end(),
            1.0F / static_cast<float>(std::max<std::size_t>(size(), 1)));
}

void ParticleSet::weigh(const float* log_likelihood, double share) {
  if (size() == 0) return;
  const float best = *std::max_element(log_likelihood, log_likelihood + size());
  const auto factor = static_cast<float>(share);
  double sum = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    weight[i] *= std::exp(factor * (log_likelihood[i] - best));
    sum += static_cast<double>(weight[i]);
  }
  // The best particles may have had no weight: then what is seen now decides alone.
  if (!(sum > 1e-30)) {
    sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      weight[i] = std::exp(factor * (log_likelihood[i] - best));
      sum += static_cast<double>(weight[i]);
    }
  }
  const auto scale = static_cast<float>(1.0 / sum);
  for (float& w : weight) w *= scale;
}

double ParticleSet::effectiveSize() const {
  double squares = 0.0;
  for (const float w : weight) squares += static_cast<double>(w) * static_cast<double>(w);
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

void drawSystematic(const ParticleSet& from, std::size_t count, RandomNumbers& random,
                    ParticleSet& to) {
  if (count == 0 || from.size() == 0) return;
  double total = 0.0;
  for (const float w : from.weight) total += static_cast<double>(w);
  const double stride = total / static_cast<double>(count);
  double next = random.uniform() * stride, reached = static_cast<double>(from.weight[0]);
  std::size_t i = 0;
  for (std::size_t drawn = 0; drawn < count; ++drawn, next += stride) {
    while (reached < next && i + 1 < from.size()) {
      reached += static_cast<double>(from.weight[++i]);
    }
    to.x_m.push_back(from.x_m[i]);
    to.y_m.push_back(from.y_m[i]);
    to.yaw_rad.push_back(from.yaw_rad[i]);
    to.weight.push_back(0.0F);
  }
}

std::size_t kldParticles(std::size_t bins, double error, double quantile) {
  if (bins < 2) return 1;
  const auto freedom = static_cast<double>(bins - 1);
  const double part = 2.0 / (9.0 * freedom);
  const double root = 1.0 - part + std::sqrt(part) * quantile;
  return static_cast<std::size_t>(std::ceil(freedom / (2.0 * error) * root * root * root));
}

PoseBins::PoseBins(double place_m, double heading_rad, std::size_t capacity)
    : per_m_(1.0 / place_m), per_rad_(1.0 / heading_rad) {
  std::size_t slots = 16;
  while (slots < 2 * capacity) slots *= 2;
  slots_.assign(slots, 0);
  used_.reserve(capacity);
  bins_.reserve(capacity);
}

void PoseBins::clear() {
  for (const std::uint32_t slot : used_) slots_[slot] = 0;
  used_.clear();
  bins_.clear();
}

std::size_t PoseBins::add(float x_m, float y_m, float yaw_rad, float weight) {
  const auto part = [](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value))) & 0x1FFFFFU;
  };
  const std::uint64_t key = (part(static_cast<double>(x_m) * per_m_) << 42U) |
                            (part(static_cast<double>(y_m) * per_m_) << 21U) |
                            part(static_cast<double>(yaw_rad) * per_rad_);
  const std::size_t last = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32U) & last;
  while (slots_[slot] != 0 && bins_[slots_[slot] - 1].key != key) slot = (slot + 1) & last;
  if (slots_[slot] == 0) {
    bins_.push_back({key, 0.0F});
    slots_[slot] = static_cast<std::uint32_t>(bins_.size());
    used_.push_back(static_cast<std::uint32_t>(slot));
  }
  const std::size_t bin = slots_[slot] - 1;
  bins_[bin].weight += weight;
  return bin;
}

std::size_t PoseBins::heaviest() const {
  const auto best = std::max_element(
      bins_.begin(), bins_.end(), [](const Bin& a, const Bin& b) { return a.weight < b.weight; });
  return static_cast<std::size_t>(best - bins_.begin());
}

}  // namespace heel
