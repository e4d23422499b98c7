// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/joint_marginals.hpp>

#include <algorithm>
#include <cstddef>

namespace heel {
namespace {

/// A person, in a set of people.
std::size_t bitOf(int h) { return std::size_t{1} << (h - kTarget); }

/// Keeps what underflows away; only the ratios in a row count.
void rescale(double* row, std::size_t sets) {
  const double most = std::max(*std::max_element(row, row + sets), 1e-300);
  for (std::size_t s = 0; s < sets; ++s) row[s] /= most;
}

}  // namespace

const std::vector<Evidence>& JointMarginals::of(const std::vector<BodyWeights>& bodies) {
  int end = kTarget;  // From here on nobody is any of the bodies.
  for (const BodyWeights& body : bodies) {
    for (int h = end; h < kHypotheses; ++h) end = body.weight[h] > 0.0 ? h + 1 : end;
  }
  const std::size_t sets = bitOf(end);
  const std::size_t count = bodies.size();
  forward_.assign((count + 1) * sets, 0.0);
  backward_.assign((count + 1) * sets, 1.0);
  marginals_.assign(count, Evidence::Zero());
  forward_[0] = 1.0;  // nobody is taken yet
  for (std::size_t j = 0; j < count; ++j) {
    const auto& [weight, nobody] = bodies[j];
    const double* before = &forward_[j * sets];
    double* after = &forward_[(j + 1) * sets];
    for (std::size_t s = 0; s < sets; ++s) {
      after[s] += before[s] * (nobody + weight[kThing] + weight[kStranger]);
      for (int h = kTarget; h < end; ++h) {
        if ((s & bitOf(h)) == 0) after[s | bitOf(h)] += before[s] * weight[h];
      }
    }
    rescale(after, sets);
  }
  for (std::size_t j = count; j-- > 0;) {
    const auto& [weight, nobody] = bodies[j];
    const double* before = &forward_[j * sets];
    const double* after = &backward_[(j + 1) * sets];
    double* now = &backward_[j * sets];
    Evidence& marginal = marginals_[j];
    double empty = 0.0;
    for (std::size_t s = 0; s < sets; ++s) {
      now[s] = after[s] * (nobody + weight[kThing] + weight[kStranger]);
      empty += before[s] * after[s] * nobody;
      marginal[kThing] += before[s] * after[s] * weight[kThing];
      marginal[kStranger] += before[s] * after[s] * weight[kStranger];
      for (int h = kTarget; h < end; ++h) {
        if ((s & bitOf(h)) != 0) continue;
        const double rest = weight[h] * after[s | bitOf(h)];
        now[s] += rest;
        marginal[h] += before[s] * rest;
      }
    }
    rescale(now, sets);
    marginal /= empty + marginal.sum();
  }
  return marginals_;
}

}  // namespace heel
