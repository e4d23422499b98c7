// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/joint_marginals.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace heel {
namespace {

/// A person whom some body may be.
struct Somebody {
  int hypothesis;
  std::size_t bit;  // in a set of people
};

/// Keeps what underflows away; only the ratios in a row count.
void rescale(double* row, std::size_t sets) {
  const double most = std::max(*std::max_element(row, row + sets), 1e-300);
  for (std::size_t s = 0; s < sets; ++s) row[s] /= most;
}

}  // namespace

const std::vector<Evidence>& JointMarginals::of(const std::vector<BodyWeights>& bodies) {
  std::array<Somebody, kHypotheses - kTarget> everybody;
  std::size_t people = 0;
  for (int h = kTarget; h < kHypotheses; ++h) {
    const bool may_be = std::any_of(bodies.begin(), bodies.end(),
                                    [h](const BodyWeights& body) { return body.weight[h] > 0.0; });
    if (!may_be) continue;
    everybody[people] = {h, std::size_t{1} << people};
    ++people;
  }
  const auto end = everybody.begin() + people;
  const std::size_t sets = std::size_t{1} << people;
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
      for (auto person = everybody.begin(); person != end; ++person) {
        if ((s & person->bit) == 0)
          after[s | person->bit] += before[s] * weight[person->hypothesis];
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
      for (auto person = everybody.begin(); person != end; ++person) {
        if ((s & person->bit) != 0) continue;
        const double rest = weight[person->hypothesis] * after[s | person->bit];
        now[s] += rest;
        marginal[person->hypothesis] += before[s] * rest;
      }
    }
    rescale(now, sets);
    marginal /= empty + marginal.sum();
  }
  return marginals_;
}

}  // namespace heel
