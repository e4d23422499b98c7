// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Random numbers that depend on what they are for, and not on the order in which they are drawn:
/// so results do not change with the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heel {

/// Mixes 64 bits well (the finalizer of SplitMix64).
constexpr std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// One number from several: what a random value is for.
constexpr std::uint64_t hashOf(std::uint64_t a, std::uint64_t b, std::uint64_t c = 0,
                               std::uint64_t d = 0) {
  return mixBits(mixBits(mixBits(mixBits(a) ^ b) ^ c) ^ d);
}

/// In [0, 1).
constexpr double uniformFrom(std::uint64_t hash) {
  return static_cast<double>(hash >> 11U) * 0x1.0p-53;
}

/// A short sequence of random numbers.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(mixBits(seed)) {}

  double uniform() { return uniformFrom(state_ = mixBits(state_)); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Mean 0, standard deviation 1.
  double gaussian();

 private:
  std::uint64_t state_;
};

/// Many normally distributed numbers, drawn once: image noise is read from here, row by row, each
/// row from a place of its own.
class GaussianTable {
 public:
  static constexpr std::size_t kSize = std::size_t{1} << 16U;

  explicit GaussianTable(std::uint64_t seed);

  /// At least `count` <= kSize numbers, picked by `hash`.
  const float* row(std::uint64_t hash) const { return values_.data() + (hash & (kSize - 1)); }

 private:
  std::vector<float> values_;  // kSize numbers, twice, so that a row never runs over the end.
};

}  // namespace heel
