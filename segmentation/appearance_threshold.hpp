// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The paper's delta, chosen from the errors that the acquisition frames let us count
/// (section 3.1).
#pragma once

#include <heel/segmentation/color_histogram.hpp>
#include <heel/segmentation/color_table.hpp>

#include <array>
#include <cstdint>

namespace heel {

/// What a filter gets wrong on the pixels of the acquisition, whose truth is known.
struct ColorErrors {
  std::uint64_t false_positives = 0;  ///< The room's pixels that pass.
  std::uint64_t false_negatives = 0;  ///< The person's that do not.
  double false_positive_share = 0.0;  ///< Of the room's pixels.
  double false_negative_share = 0.0;  ///< Of the person's.
};

/// The errors at each threshold of a table, 0 to 255. As the threshold rises, false positives never
/// rise and false negatives never fall.
using ErrorCurve = std::array<ColorErrors, 256>;

/// Counts the errors of `table` at every threshold; exact, see ColorHistogram.
ErrorCurve countColorErrors(const ColorTable& table, const ColorHistogram& person,
                            const ColorHistogram& room);

/// The two readings of the paper's rule that can be meant; taken literally ("increment it until the
/// number of false positives increases") it can't, for that number never rises.
enum class ThresholdRule {
  kFewestErrors,   ///< Least sum of both shares, the false positives' weighed.
  kMostSelective,  ///< The highest that still loses no more than a given share of the person.
};

/// How the score is chosen from which on a colour is the person's.
struct ThresholdParams {
  /// How the threshold is chosen. Fewest errors: on real recordings the other rule lost people
  /// whose clothes looked darker on their way back.
  ThresholdRule rule = ThresholdRule::kFewestErrors;
  /// For kFewestErrors: a greater weight lets less of the room pass, and less of the person.
  double false_positive_weight = 1.0;
  /// For kMostSelective: the greatest share of the person that may be lost.
  double max_false_negative_share = 0.3;
};

/// The threshold that a rule chooses; of equally good ones the lowest for kFewestErrors. At most
/// 254: at 255 nothing can pass.
/// @throws std::invalid_argument  if the weight is negative or the share is not in [0, 1].
std::uint8_t chooseThreshold(const ErrorCurve& errors, const ThresholdParams& params = {});

}  // namespace heel
