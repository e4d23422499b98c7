// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/random.hpp>

#include <cmath>

namespace heel {

double RandomStream::gaussian() {
  constexpr double kTwoPi = 2.0 * M_PI;
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(kTwoPi * uniform());
}

GaussianTable::GaussianTable(std::uint64_t seed) : values_(2 * kSize) {
  RandomStream random(seed);
  for (std::size_t i = 0; i < kSize; ++i) {
    values_[i] = values_[i + kSize] = static_cast<float>(random.gaussian());
  }
}

}  // namespace heel
