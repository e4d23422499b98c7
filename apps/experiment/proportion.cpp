// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/proportion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {

double Proportion::share() const {
  if (total == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(count) / total;
}

ShareInterval wilsonInterval(const Proportion& proportion) {
  if (proportion.count < 0 || proportion.count > proportion.total) {
    throw std::invalid_argument("wilsonInterval: the count must be in [0, total]");
  }
  if (proportion.total == 0) return {};
  constexpr double kZ = 1.959963984540054;  // Of the normal distribution, 95 % in the middle.
  const double n = proportion.total;
  const double p = proportion.share();
  const double middle = (p + kZ * kZ / (2.0 * n)) / (1.0 + kZ * kZ / n);
  const double half =
      kZ / (1.0 + kZ * kZ / n) * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  // The ends of no and of all are exact; rounding must not move them.
  return {proportion.count == 0 ? 0.0 : std::max(0.0, middle - half),
          proportion.count == proportion.total ? 1.0 : std::min(1.0, middle + half)};
}

ShareInterval bootstrapInterval(const std::vector<PartOf>& parts) {
  if (parts.empty()) return {};
  constexpr std::size_t kSets = 4000;
  std::mt19937_64 random(1);
  std::vector<double> shares(kSets);
  for (double& share : shares) {
    PartOf all;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const PartOf& drawn = parts[random() % parts.size()];
      all.part += drawn.part;
      all.whole += drawn.whole;
    }
    share = all.whole > 0.0 ? all.part / all.whole : 0.0;
  }
  std::sort(shares.begin(), shares.end());
  return {shares[kSets / 40], shares[kSets - 1 - kSets / 40]};
}

std::string withInterval(const Proportion& proportion) {
  const ShareInterval interval = wilsonInterval(proportion);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%d of %d (%.0f-%.0f %%)", proportion.count,
                proportion.total, 100.0 * interval.low, 100.0 * interval.high);
  return text.data();
}

}  // namespace heel
