// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A picture that repeats in both directions and is filtered to the size of a pixel.
#pragma once

#include <heel/apps/simulation/color.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace heel {

/// A square, tileable texture with its halved, quartered, ... copies (a mip pyramid), so that what
/// is far away neither flickers nor gives a stereo matcher detail that a lens would have lost.
class Texture {
 public:
  /// Draws `paint(u, v)`, with u and v in [0, 1), at the centre of every texel.
  /// @param size  Texels along an edge, a power of two.
  Texture(int size, const std::function<Rgb(float, float)>& paint);

  /// The colour at (u, v) in tiles (any real number), averaged over about `footprint` tiles.
  Rgb sample(float u, float v, float footprint) const;

  /// The average of the whole texture.
  Rgb mean() const { return levels_.back()[0].head<3>(); }

 private:
  using Texel = Eigen::Array4f;

  Texel bilinear(std::size_t level, float u, float v) const;

  int size_;
  std::vector<std::vector<Texel>> levels_;
};

/// Noise in [0, 1] that repeats: `period` cells to a tile, smooth between them.
float tileNoise(float u, float v, int period, std::uint64_t seed);

/// Several octaves of `tileNoise`, each twice as fine and half as strong; about in [0, 1].
float tileFractal(float u, float v, int period, int octaves, std::uint64_t seed);

}  // namespace heel
