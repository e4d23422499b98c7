// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How sure a counted share is.
#pragma once

#include <string>
#include <vector>

namespace heel {

/// `count` of `total`, with the share that it stands for.
struct Proportion {
  int count = 0;
  int total = 0;

  void add(bool is) {
    count += is ? 1 : 0;
    ++total;
  }
  void add(const Proportion& other) {
    count += other.count;
    total += other.total;
  }
  double share() const;  ///< NaN of nothing.
};

/// Ends of an interval within [0, 1].
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval: holds the true share in 95 % of all experiments. Unlike the textbook's
/// normal interval it is right for few trials and for shares of 0 and 1.
/// @throws std::invalid_argument  if count is not in [0, total].
ShareInterval wilsonInterval(const Proportion& proportion);

/// A part of a whole, as seconds of a run.
struct PartOf {
  double part = 0.0;
  double whole = 0.0;
};

/// The same for the share that all parts together are of their wholes, by the bootstrap: what it is
/// in 95 % of sets of as many, drawn from these with replacement. Deterministic.
ShareInterval bootstrapInterval(const std::vector<PartOf>& parts);

/// "99 of 100 (95-100 %)".
std::string withInterval(const Proportion& proportion);

}  // namespace heel
