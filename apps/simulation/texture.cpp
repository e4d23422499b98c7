// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/random.hpp>
#include <heel/apps/simulation/texture.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace heel {
namespace {

/// As std::floor, which is slow where the processor's own rounding may not be used (SSE2).
int floorOf(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero - (static_cast<float>(towards_zero) > x ? 1 : 0);
}

}  // namespace

Texture::Texture(int size, const std::function<Rgb(float, float)>& paint) : size_(size) {
  levels_.emplace_back(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  const float step = 1.0F / static_cast<float>(size);
  auto texel = levels_[0].begin();
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Rgb color =
          paint((static_cast<float>(x) + 0.5F) * step, (static_cast<float>(y) + 0.5F) * step);
      *texel++ = Texel(color[0], color[1], color[2], 0.0F);
    }
  }
  for (int half = size / 2; half > 0; half /= 2) {
    const std::vector<Texel>& fine = levels_.back();
    const auto n = static_cast<std::size_t>(half);
    std::vector<Texel> coarse(n * n);
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t x = 0; x < n; ++x) {
        const std::size_t i = 4 * n * y + 2 * x;
        coarse[n * y + x] = 0.25F * (fine[i] + fine[i + 1] + fine[i + 2 * n] + fine[i + 2 * n + 1]);
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

Texture::Texel Texture::bilinear(std::size_t level, float u, float v) const {
  const int n = size_ >> level;
  const float x = u * static_cast<float>(n) - 0.5F, y = v * static_cast<float>(n) - 0.5F;
  const int ix = floorOf(x), iy = floorOf(y);
  const float wx = x - static_cast<float>(ix), wy = y - static_cast<float>(iy);
  const unsigned mask = static_cast<unsigned>(n) - 1U;
  const unsigned x0 = static_cast<unsigned>(ix) & mask, x1 = (x0 + 1U) & mask;
  const unsigned y0 = static_cast<unsigned>(iy) & mask, y1 = (y0 + 1U) & mask;
  const Texel* texels = levels_[level].data();
  const unsigned width = mask + 1U;
  const Texel upper = texels[y0 * width + x0] * (1.0F - wx) + texels[y0 * width + x1] * wx;
  const Texel lower = texels[y1 * width + x0] * (1.0F - wx) + texels[y1 * width + x1] * wx;
  return upper * (1.0F - wy) + lower * wy;
}

Rgb Texture::sample(float u, float v, float footprint) const {
  const float texels = footprint * static_cast<float>(size_);
  if (!(texels > 1.0F)) return bilinear(0, u, v).head<3>();
  // The float's exponent is the level; its fraction is nearly how far it is to the next one.
  std::uint32_t bits = 0;
  std::memcpy(&bits, &texels, sizeof bits);
  const std::size_t last = levels_.size() - 1;
  const std::size_t fine = std::min(static_cast<std::size_t>((bits >> 23U) - 127U), last);
  const std::size_t coarse = std::min(fine + 1, last);
  const float way = static_cast<float>(bits & 0x7FFFFFU) * 0x1p-23F;
  // Levels are mixed only about half-way between them, which halves the look-ups and hardly shows.
  const float weight = std::clamp(2.0F * way - 0.5F, 0.0F, 1.0F);
  if (weight == 0.0F) return bilinear(fine, u, v).head<3>();
  if (weight == 1.0F) return bilinear(coarse, u, v).head<3>();
  return (bilinear(fine, u, v) * (1.0F - weight) + bilinear(coarse, u, v) * weight).head<3>();
}

float tileNoise(float u, float v, int period, std::uint64_t seed) {
  const float x = u * static_cast<float>(period), y = v * static_cast<float>(period);
  const float fx = std::floor(x), fy = std::floor(y);
  const auto at = [&](int dx, int dy) {
    const int ix = (static_cast<int>(fx) + dx) % period, iy = (static_cast<int>(fy) + dy) % period;
    const auto wrap = [period](int i) { return static_cast<std::uint64_t>((i + period) % period); };
    return static_cast<float>(uniformFrom(hashOf(seed, wrap(ix), wrap(iy))));
  };
  const auto ease = [](float t) { return t * t * (3.0F - 2.0F * t); };
  const float wx = ease(x - fx), wy = ease(y - fy);
  const float upper = at(0, 0) + (at(1, 0) - at(0, 0)) * wx;
  const float lower = at(0, 1) + (at(1, 1) - at(0, 1)) * wx;
  return upper + (lower - upper) * wy;
}

float tileFractal(float u, float v, int period, int octaves, std::uint64_t seed) {
  float sum = 0.0F, weight = 0.5F, total = 0.0F;
  for (int i = 0; i < octaves; ++i, period *= 2, weight *= 0.5F) {
    sum += weight * tileNoise(u, v, period, seed + static_cast<std::uint64_t>(i));
    total += weight;
  }
  return sum / total;
}

}  // namespace heel
