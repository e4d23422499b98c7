// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/color_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace heel {
namespace {

constexpr float kDarkOffset = 12.0F;
constexpr float kChromaLimit = 1.5F;
constexpr int kChroma = ColorProfile::kChromaBins;
constexpr int kBrightness = ColorProfile::kBrightnessBins;
constexpr std::size_t kBins = std::size_t{kChroma} * kChroma * kBrightness;

/// Logarithms of all channel values in bins of chroma, and of each sum of three channels.
struct Tables {
  std::array<float, 256> chroma{};
  std::array<float, 766> light{};
  const float darkest = std::log(kDarkOffset);
  const float bins_per_log = kBrightness / (std::log(255.0F + kDarkOffset) - darkest);

  Tables() {
    for (std::size_t v = 0; v < chroma.size(); ++v) {
      chroma[v] = std::log(static_cast<float>(v) + kDarkOffset) * (kChroma / (2.0F * kChromaLimit));
    }
    for (std::size_t sum = 0; sum < light.size(); ++sum) {
      light[sum] = std::log(static_cast<float>(sum) / 3.0F + kDarkOffset);
    }
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

int chromaBin(float chroma) {
  return std::clamp(static_cast<int>(chroma + 0.5F * kChroma), 0, kChroma - 1);
}

}  // namespace

float ColorProfile::lightOf(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  return tables().light[std::size_t{b} + g + r];
}

std::size_t ColorProfile::binOf(std::uint8_t b, std::uint8_t g, std::uint8_t r, float lighter) {
  const Tables& t = tables();
  const int i = chromaBin(t.chroma[r] - t.chroma[g]);
  const int j = chromaBin(t.chroma[b] - t.chroma[g]);
  const float light = (t.light[std::size_t{b} + g + r] + lighter - t.darkest) * t.bins_per_log;
  const int k = std::clamp(static_cast<int>(light), 0, kBrightness - 1);
  return static_cast<std::size_t>((i * kChroma + j) * kBrightness + k);
}

ColorProfile::ColorProfile(const ColorHistogram& colors) {
  if (colors.empty()) return;
  ColorSample sample;
  colors.forEach([&](Bgr c, std::uint64_t count) {
    sample.add(binOf(c.b, c.g, c.r), static_cast<float>(count));
    light_ += static_cast<double>(lightOf(c.b, c.g, c.r)) * static_cast<double>(count);
  });
  light_ /= static_cast<double>(colors.total());
  sample.smooth();
  roots_.resize(kBins);
  const auto total = static_cast<float>(sample.total_);
  std::transform(sample.smoothed_.begin(), sample.smoothed_.end(), roots_.begin(),
                 [total](float count) { return std::sqrt(count / total); });
}

ColorSample::ColorSample() : counts_(kBins, 0.0F), smoothed_(kBins, 0.0F) {}

void ColorSample::clear() {
  for (const std::size_t bin : touched_) counts_[bin] = 0.0F;
  touched_.clear();
  total_ = 0.0;
}

double ColorSample::affinity(const ColorProfile& profile) {
  if (profile.empty() || total_ <= 0.0) return 0.0;
  smooth();
  double sum = 0.0;
  for (const std::size_t bin : reached_) {
    sum += static_cast<double>(std::sqrt(smoothed_[bin]) * profile.roots()[bin]);
  }
  return std::min(sum / std::sqrt(total_), 1.0);
}

/// Spreads each bin over its 27 neighbours with the weights 1, 2, 1 along each axis; what would
/// leave the grid stays in its last bin.
void ColorSample::smooth() {
  static constexpr std::array<float, 3> kWeights = {0.25F, 0.5F, 0.25F};
  for (const std::size_t bin : reached_) smoothed_[bin] = 0.0F;
  reached_.clear();
  for (const std::size_t bin : touched_) {
    const int n = static_cast<int>(bin);
    const int i = n / (kChroma * kBrightness), j = n / kBrightness % kChroma, k = n % kBrightness;
    for (int a = 0; a < 27; ++a) {
      const int x = std::clamp(i + a / 9 - 1, 0, kChroma - 1);
      const int y = std::clamp(j + a / 3 % 3 - 1, 0, kChroma - 1);
      const int z = std::clamp(k + a % 3 - 1, 0, kBrightness - 1);
      const auto to = static_cast<std::size_t>((x * kChroma + y) * kBrightness + z);
      if (smoothed_[to] == 0.0F) reached_.push_back(to);
      smoothed_[to] += counts_[bin] * kWeights[static_cast<std::size_t>(a / 9)] *
                       kWeights[static_cast<std::size_t>(a / 3 % 3)] *
                       kWeights[static_cast<std::size_t>(a % 3)];
    }
  }
}

}  // namespace heel
