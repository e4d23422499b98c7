// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Who is who of several bodies, where each person can be one of them only.
#pragma once

#include <heel/tracking/gallery.hpp>

#include <vector>

namespace heel {

/// How likely each hypothesis of a body is by itself, up to a factor.
struct BodyWeights {
  Evidence weight = Evidence::Zero();
  double nobody = 0.0;  ///< That no body is there any more.
};

/// Exact marginals, by forward-backward sums over all ways to give people to bodies: 2^n sets of n
/// people who are taken, for each body. Things and strangers may be any number.
class JointMarginals {
 public:
  /// Probabilities of each body's hypotheses; what is left to 1 is nobody. Valid until the next
  /// call.
  const std::vector<Evidence>& of(const std::vector<BodyWeights>& bodies);

 private:
  std::vector<double> forward_, backward_;  // (bodies + 1) x sets
  std::vector<Evidence> marginals_;
};

}  // namespace heel
