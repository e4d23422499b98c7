// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_threshold.hpp>

#include <cstddef>
#include <stdexcept>

namespace heel {
namespace {

using Counts = std::array<std::uint64_t, 256>;

/// How many of `pixels` have each score.
Counts countScores(const ColorTable& table, const ColorHistogram& pixels) {
  Counts counts{};
  pixels.forEach([&](Bgr c, std::uint64_t count) { counts[table(c.b, c.g, c.r)] += count; });
  return counts;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

ErrorCurve countColorErrors(const ColorTable& table, const ColorHistogram& person,
                            const ColorHistogram& room) {
  const Counts of_person = countScores(table, person);
  const Counts of_room = countScores(table, room);
  ErrorCurve curve;
  std::uint64_t lost = 0;
  std::uint64_t passing = room.total();
  for (std::size_t threshold = 0; threshold < curve.size(); ++threshold) {
    lost += of_person[threshold];  // only scores above the threshold pass
    passing -= of_room[threshold];
    curve[threshold] = {passing, lost, share(passing, room.total()), share(lost, person.total())};
  }
  return curve;
}

std::uint8_t chooseThreshold(const ErrorCurve& errors, const ThresholdParams& params) {
  if (!(params.false_positive_weight >= 0.0)) {
    throw std::invalid_argument("the weight of false positives must not be negative");
  }
  if (!(params.max_false_negative_share >= 0.0 && params.max_false_negative_share <= 1.0)) {
    throw std::invalid_argument("the greatest share of false negatives must be in [0, 1]");
  }
  const auto cost = [&](std::size_t i) {
    return errors[i].false_negative_share +
           params.false_positive_weight * errors[i].false_positive_share;
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < errors.size() - 1; ++i) {
    const bool better = params.rule == ThresholdRule::kFewestErrors
                            ? cost(i) < cost(best)
                            : errors[i].false_negative_share <= params.max_false_negative_share;
    if (better) best = i;
  }
  return static_cast<std::uint8_t>(best);
}

}  // namespace heel
