// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_histogram.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {

void ColorHistogram::merge(const ColorHistogram& other) {
  for (std::size_t cell = 0; cell < counts_.size(); ++cell) counts_[cell] += other.counts_[cell];
  total_ += other.total_;
}

Bgr ColorHistogram::middleOf(std::size_t cell) {
  static const auto middles = [] {
    std::array<std::uint8_t, ColorTable::kLevels> values{};
    for (int v = 0; v < 256; ++v) {
      const auto value = static_cast<std::uint8_t>(v);
      values[ColorTable::cell(value, 0, 0)] = ColorTable::middle(value);
    }
    return values;
  }();
  constexpr std::size_t kLevels = ColorTable::kLevels;
  return {middles[cell % kLevels], middles[cell / kLevels % kLevels],
          middles[cell / (kLevels * kLevels)]};
}

namespace {

constexpr double kLogOffset = 12.0;  // below it, logarithms would blow up the camera's noise
constexpr int kMaxRounds = 50;

struct Sample {
  Eigen::Vector3d place;  // log of the channels
  double weight;
  Bgr color;
  std::uint64_t count;
  std::size_t cluster = 0;
};

std::vector<Sample> makeSamples(const ColorHistogram& colors) {
  std::vector<Sample> samples;
  colors.forEach([&](Bgr c, std::uint64_t count) {
    samples.push_back(
        {{std::log(c.b + kLogOffset), std::log(c.g + kLogOffset), std::log(c.r + kLogOffset)},
         static_cast<double>(count),
         c,
         count});
  });
  return samples;
}

Eigen::Vector3d meanOf(const std::vector<Sample>& samples) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const Sample& s : samples) {
    sum += s.weight * s.place;
    weight += s.weight;
  }
  return sum / weight;
}

/// The first middle is the mean; each next one the sample with most weight times squared distance
/// to the nearest middle so far.
std::vector<Eigen::Vector3d> startMiddles(const std::vector<Sample>& samples, int count) {
  std::vector<Eigen::Vector3d> middles = {meanOf(samples)};
  std::vector<double> nearest(samples.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(middles.size()) < count) {
    std::size_t farthest = 0;
    double greatest = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      nearest[i] = std::min(nearest[i], (samples[i].place - middles.back()).squaredNorm());
      if (samples[i].weight * nearest[i] > greatest) {
        greatest = samples[i].weight * nearest[i];
        farthest = i;
      }
    }
    if (greatest <= 0.0) break;  // fewer colours than groups
    middles.push_back(samples[farthest].place);
  }
  return middles;
}

/// Gives each sample to its nearest middle. @return Whether one changed hands.
bool assign(const std::vector<Eigen::Vector3d>& middles, std::vector<Sample>& samples) {
  bool changed = false;
  for (Sample& s : samples) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < middles.size(); ++k) {
      if ((s.place - middles[k]).squaredNorm() < (s.place - middles[best]).squaredNorm()) best = k;
    }
    changed = changed || best != s.cluster;
    s.cluster = best;
  }
  return changed;
}

void moveMiddles(const std::vector<Sample>& samples, std::vector<Eigen::Vector3d>& middles) {
  std::vector<Eigen::Vector3d> sums(middles.size(), Eigen::Vector3d::Zero());
  std::vector<double> weights(middles.size(), 0.0);
  for (const Sample& s : samples) {
    sums[s.cluster] += s.weight * s.place;
    weights[s.cluster] += s.weight;
  }
  for (std::size_t k = 0; k < middles.size(); ++k) {
    if (weights[k] > 0.0) middles[k] = sums[k] / weights[k];
  }
}

}  // namespace

ColorClusters clusterColors(const ColorHistogram& colors, int count) {
  if (count < 1) throw std::invalid_argument("the number of principal colours must be positive");
  if (colors.empty()) throw std::invalid_argument("there are no colours to part into groups");
  auto samples = makeSamples(colors);
  auto middles = startMiddles(samples, count);
  assign(middles, samples);
  for (int round = 0; round < kMaxRounds; ++round) {
    moveMiddles(samples, middles);
    if (!assign(middles, samples)) break;
  }

  ColorClusters result;
  result.clusters.resize(middles.size());
  for (const Sample& s : samples) {
    result.clusters[s.cluster].add(s.color, s.count);
    result.spread += s.weight * (s.place - middles[s.cluster]).squaredNorm();
  }
  result.spread /= static_cast<double>(colors.total());
  auto& clusters = result.clusters;
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(),
                                [](const ColorHistogram& c) { return c.empty(); }),
                 clusters.end());
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const auto& a, const auto& b) { return a.total() > b.total(); });
  return result;
}

ColorClusters clusterColorsFromData(const ColorHistogram& colors, int max_count,
                                    double min_spread_drop) {
  ColorClusters chosen = clusterColors(colors, 1);
  for (int count = 2; count <= max_count; ++count) {
    ColorClusters finer = clusterColors(colors, count);
    if (finer.spread > (1.0 - min_spread_drop) * chosen.spread) break;
    if (finer.clusters.size() == chosen.clusters.size()) break;  // there are no more colours
    chosen = std::move(finer);
  }
  return chosen;
}

}  // namespace heel
