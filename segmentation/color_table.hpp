// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A function of colour alone, tabulated: what the paper's filter (section 3.1) is at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace heel {

namespace detail {

inline constexpr std::size_t kColorLevels = 96;

/// The level of a channel's value: one value wide below 32, two below 64, four from there on.
constexpr std::uint32_t colorLevel(std::uint32_t v) {
  return v < 32 ? v : v < 64 ? 16 + v / 2 : 32 + v / 4;
}

/// What a channel's value adds to the number of the cell, for b, g and r.
constexpr std::array<std::array<std::uint32_t, 256>, 3> makeCellParts() {
  std::array<std::array<std::uint32_t, 256>, 3> parts{};
  std::uint32_t stride = 1;
  for (auto& part : parts) {
    for (std::uint32_t v = 0; v < 256; ++v) part[v] = stride * colorLevel(v);
    stride *= static_cast<std::uint32_t>(kColorLevels);
  }
  return parts;
}

inline constexpr auto kCellParts = makeCellParts();

}  // namespace detail

/// Scores in [0, 255] for every 8-bit colour, and the threshold above which a colour passes.
///
/// Every appearance model ends as one of these, so that a pixel costs one look-up whatever the
/// model costs. What a score means is the model's affair: more is more like the target, 0 is not at
/// all.
///
/// **Quantisation.** Each channel is cut into 96 levels: values below 32 each have their own,
/// values below 64 share one between two, all others one between four. So it is never coarser than
/// 6 bits a channel, and exact in the dark, where one step of a channel turns the hue of a black
/// jumper by tens of degrees. All colours of a cell have the score of the cell's middle colour:
/// `table(b, g, r) == score(middle(b), middle(g), middle(r))` for all 2^24 colours.
///
/// A value type: immutable, a copy shares the scores (864 KiB), safe to read from many threads.
class ColorTable {
 public:
  using Score = std::function<std::uint8_t(std::uint8_t b, std::uint8_t g, std::uint8_t r)>;

  static constexpr std::size_t kLevels = detail::kColorLevels;        ///< Levels a channel.
  static constexpr std::size_t kCells = kLevels * kLevels * kLevels;  ///< Scores in a table.
  static constexpr std::uint8_t kDefaultThreshold = 127;

  /// An empty table: every colour scores 0 and none passes.
  ColorTable() = default;

  /// Tabulates `score`, which is called once for the middle colour of each cell (884736 times).
  explicit ColorTable(const Score& score, std::uint8_t threshold = kDefaultThreshold);

  /// The same scores (shared, not copied) with another threshold.
  ColorTable withThreshold(std::uint8_t threshold) const;

  std::uint8_t threshold() const { return threshold_; }

  /// True if no score function was ever tabulated.
  bool empty() const { return scores_ == nullptr; }

  /// The score of a colour.
  std::uint8_t operator()(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return empty() ? std::uint8_t{0} : (*scores_)[cell(b, g, r)];
  }

  /// Whether the score is *above* the threshold (the paper's inequality is strict).
  bool passes(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    return (*this)(b, g, r) > threshold_;
  }

  /// For tight loops: the `kCells` scores, indexed by `cell`; null if the table is empty.
  const std::uint8_t* data() const { return empty() ? nullptr : scores_->data(); }

  static constexpr std::size_t cell(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return detail::kCellParts[0][b] + detail::kCellParts[1][g] + detail::kCellParts[2][r];
  }

  /// The channel value that stands for all values of `value`'s level; differs by at most 2.
  static constexpr std::uint8_t middle(std::uint8_t value) {
    const int v = value;
    return static_cast<std::uint8_t>(v < 32 ? v : v < 64 ? (v & ~1) + 1 : (v & ~3) + 2);
  }

 private:
  std::shared_ptr<const std::vector<std::uint8_t>> scores_;
  std::uint8_t threshold_ = kDefaultThreshold;
};

}  // namespace heel
