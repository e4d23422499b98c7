// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How the colours of a part of a body are distributed, and how alike two distributions are.
#pragma once

#include "segmentation/color_histogram.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heel {

/// The joint histogram of log(r / g), log(b / g) and the log of the brightness, coarse and smoothed
/// so that folds and noise change it little. (Logarithms are of the channel + 12, for below that
/// the camera's noise is all there is.)
///
/// A table of colours says whether a pixel's colour is one of the target's. A profile says whether
/// all of them together are the target's in their proportions: a black jumper passes the table of
/// checks in black and red, but it has not their profile.
class ColorProfile {
 public:
  static constexpr int kChromaBins = 24;
  static constexpr int kBrightnessBins = 10;

  /// Empty: nothing is like it.
  ColorProfile() = default;
  explicit ColorProfile(const ColorHistogram& colors);

  bool empty() const { return roots_.empty(); }

  /// The square root of each bin's share.
  const std::vector<float>& roots() const { return roots_; }

  /// Mean natural logarithm of the brightness.
  double light() const { return light_; }

  /// The natural logarithm of a colour's brightness.
  static float lightOf(std::uint8_t b, std::uint8_t g, std::uint8_t r);

  /// The bin of a colour in a light that is brighter by `lighter`, a natural logarithm.
  static std::size_t binOf(std::uint8_t b, std::uint8_t g, std::uint8_t r, float lighter = 0.0F);

 private:
  std::vector<float> roots_;
  double light_ = 0.0;
};

/// The colours of one part of a body in one frame. Clear it and use it again: it allocates nothing
/// once warm, and costs as much as it has pixels.
class ColorSample {
 public:
  ColorSample();

  void clear();
  /// A pixel, as it would be in a light that is brighter by `lighter`, a natural logarithm.
  void add(std::uint8_t b, std::uint8_t g, std::uint8_t r, float lighter = 0.0F) {
    add(ColorProfile::binOf(b, g, r, lighter), 1.0F);
  }
  /// Pixels added.
  double total() const { return total_; }

  /// Bhattacharyya's coefficient of both smoothed histograms, sum over bins of sqrt(p q): 1 if they
  /// are the same, 0 if they share no bin, or one is empty.
  double affinity(const ColorProfile& profile);

 private:
  friend class ColorProfile;

  void add(std::size_t bin, float count) {
    if (counts_[bin] == 0.0F) touched_.push_back(bin);
    counts_[bin] += count;
    total_ += static_cast<double>(count);
  }
  void smooth();

  std::vector<float> counts_;
  std::vector<std::size_t> touched_;  // Bins of counts_ that are not 0.
  std::vector<float> smoothed_;
  std::vector<std::size_t> reached_;  // Bins of smoothed_ that are not 0.
  double total_ = 0.0;
};

}  // namespace heel
