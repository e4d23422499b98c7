// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/stature.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace heel {
namespace {

constexpr double kShareAbove = 0.02;
constexpr std::size_t kMinFrames = 5;
// Of a body hidden from one side to beyond its head, over a third of the width about what is seen
// of it is hidden.
constexpr double kSeenAbove = 2.0 / 3.0;

double quantile(std::vector<double>& values, double share) {
  const auto n = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

}  // namespace

void StatureSample::clear() {
  heights_m_.clear();
  behind_m_.clear();
  cut_off_ = false;
}

void StatureSample::add(double height_m, bool at_edge) {
  if (height_m < kLeastHeight_m) return;
  heights_m_.push_back(height_m);
  cut_off_ = cut_off_ || at_edge;
}

void StatureSample::addBehind(double height_m) {
  if (height_m > kLeastHeight_m) behind_m_.push_back(height_m);
}

std::optional<double> StatureSample::height_m(double full) {
  if (cut_off_ || heights_m_.size() < kMinPoints) return std::nullopt;
  const double top_m = quantile(heights_m_, 1.0 - kShareAbove);
  const auto behind = std::count_if(behind_m_.begin(), behind_m_.end(), [top_m](double height_m) {
    return height_m > top_m && height_m < top_m + kAbove_m;
  });
  if (static_cast<double>(behind) < kSeenAbove * full) return std::nullopt;
  return top_m;
}

std::optional<Stature> statureFrom(std::vector<double> heights_m) {
  if (heights_m.size() < kMinFrames) return std::nullopt;
  Stature stature;
  stature.frames = static_cast<int>(heights_m.size());
  stature.height_m = quantile(heights_m, 0.5);
  // Of a Gaussian, half lies within 0.6745 standard deviations.
  stature.spread_m = (quantile(heights_m, 0.75) - quantile(heights_m, 0.25)) / (2.0 * 0.6745);
  return stature;
}

}  // namespace heel
