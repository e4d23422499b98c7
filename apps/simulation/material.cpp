// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/material.hpp>
#include <heel/apps/simulation/random.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kTwoPi = 6.2831853F;

float step(float edge, float x) { return x < edge ? 0.0F : 1.0F; }
float fraction(float x) { return x - std::floor(x); }
Rgb mix(const Rgb& a, const Rgb& b, float t) { return a + (b - a) * t; }
Rgb grey(float value) { return Rgb::Constant(value); }
float noiseOf(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return static_cast<float>(uniformFrom(hashOf(a, b, c)));
}
std::uint64_t cellOf(float x) { return static_cast<std::uint64_t>(std::floor(x)); }

/// A saturated or muted colour, one for each number.
Rgb paletteColor(std::uint64_t number) {
  static const char* const kNames[] = {"burgundy", "navy", "forest", "cream", "mustard",   "slate",
                                       "rust",     "teal", "white",  "black", "walnut",    "olive",
                                       "crimson",  "plum", "sand",   "sky",   "terracotta"};
  return *parseColor(kNames[mixBits(number) % std::size(kNames)]);
}

// Each of these paints one tile; (u, v) run over [0, 1).

Rgb plaster(float u, float v) { return grey(0.985F + 0.03F * (tileFractal(u, v, 3, 3, 1) - 0.5F)); }

Rgb roughcast(float u, float v) { return grey(0.8F + 0.5F * (tileFractal(u, v, 48, 4, 2) - 0.5F)); }

Rgb wallpaper(float u, float v) {
  // Sprigs in a brick-wise repeat, of two sizes, with paper grain.
  const float rows = 6.0F, columns = 6.0F;
  const float row = std::floor(v * rows);
  const float x = fraction(u * columns + 0.5F * std::fmod(row, 2.0F)) - 0.5F;
  const float y = fraction(v * rows) - 0.5F;
  const float angle = std::atan2(y, x), radius = std::hypot(x, y);
  const float petals = 0.24F + 0.1F * std::cos(5.0F * angle + row);
  const float leaf = std::abs(x - 0.16F * std::sin(6.0F * y)) < 0.035F ? 1.0F : 0.0F;
  const float motif = std::max(radius < petals ? 1.0F - radius : 0.0F, 0.6F * leaf);
  return mix(grey(0.95F), Rgb(0.42F, 0.5F, 0.48F), 0.75F * motif) *
         (0.92F + 0.16F * tileFractal(u, v, 40, 3, 3));
}

Rgb brick(float u, float v) {
  const float row = std::floor(v * 12.0F);
  const float x = u * 4.0F + 0.5F * std::fmod(row, 2.0F), y = v * 12.0F;
  const float in_x = fraction(x), in_y = fraction(y);
  const float grain = tileFractal(u, v, 32, 4, 4);
  if (in_x < 0.04F || in_y < 0.12F) return grey(0.75F + 0.25F * grain);
  const float tone = noiseOf(5, cellOf(fraction(x / 4.0F) * 4.0F), cellOf(y));
  return Rgb(1.0F, 0.9F, 0.85F) * (0.5F + 0.45F * tone) * (0.7F + 0.6F * grain);
}

/// Lengthwise fibres; `seed` makes boards differ.
float woodGrain(float u, float v, std::uint64_t seed) {
  const float warp = tileFractal(u, v, 4, 3, seed);
  const float rings = 0.5F + 0.5F * std::sin(kTwoPi * (9.0F * v + 2.6F * warp));
  const float fibres = tileNoise(u, fraction(v * 8.0F), 24, seed + 7);
  const float pores = tileNoise(fraction(u * 3.0F), fraction(v * 24.0F), 32, seed + 8);
  return 0.62F + 0.2F * rings + 0.22F * fibres + 0.14F * pores;
}

Rgb wood(float u, float v) { return grey(woodGrain(u, v, 11)); }

Rgb parquet(float u, float v) {
  const float boards = 12.0F;
  const float row = std::floor(v * boards);
  const float x = u * 2.0F + noiseOf(20, static_cast<std::uint64_t>(row), 0);
  const float in_x = fraction(x), in_y = fraction(v * boards);
  const std::uint64_t board = hashOf(21, static_cast<std::uint64_t>(row), cellOf(x) % 2);
  const auto tone = static_cast<float>(uniformFrom(board));
  const float grain = woodGrain(fraction(u + tone), fraction(v + 3.7F * tone), 22);
  const float seam = (in_y < 0.05F || in_x < 0.006F) ? 0.45F : 1.0F;
  return Rgb(1.0F, 0.97F + 0.03F * tone, 0.92F + 0.08F * tone) * (0.6F + 0.5F * tone) * grain *
         seam;
}

Rgb tiles(float u, float v) {
  const float x = u * 4.0F, y = v * 4.0F;
  const float in_x = fraction(x), in_y = fraction(y);
  if (in_x < 0.025F || in_y < 0.025F) return grey(0.45F);
  const float tone = noiseOf(30, cellOf(x), cellOf(y));
  const float clouds = tileFractal(u, v, 12, 5, 31);
  return grey((0.82F + 0.12F * tone) * (0.75F + 0.45F * clouds));
}

Rgb carpet(float u, float v) {
  const float tufts = tileNoise(u, v, 128, 40), fleck = tileNoise(u, v, 64, 41);
  return grey(0.5F + 0.4F * tufts + 0.35F * step(0.72F, fleck) +
              0.2F * tileFractal(u, v, 6, 3, 42));
}

Rgb rug(float u, float v) {
  const float x = std::abs(fraction(u * 2.0F) - 0.5F), y = std::abs(fraction(v * 2.0F) - 0.5F);
  const float diamond = x + y;
  const float pile = 0.75F + 0.5F * tileNoise(u, v, 128, 50);
  const int ring = static_cast<int>(diamond * 14.0F) % 4;
  static const Rgb kRings[] = {
      {1.0F, 0.9F, 0.8F}, {1.2F, 1.1F, 0.7F}, {0.35F, 0.4F, 0.6F}, {0.9F, 0.35F, 0.3F}};
  return kRings[ring] * pile;
}

Rgb fabric(float u, float v) {
  const float weave = 0.5F + 0.5F * std::sin(kTwoPi * 32.0F * u) * std::sin(kTwoPi * 32.0F * v);
  const float yarn = tileNoise(u, v, 64, 60), wear = tileFractal(u, v, 4, 4, 61);
  return grey(0.62F + 0.14F * weave + 0.26F * yarn + 0.3F * wear);
}

Rgb leather(float u, float v) {
  return grey(0.75F + 0.25F * tileFractal(u, v, 5, 3, 70) + 0.16F * tileNoise(u, v, 90, 71));
}

Rgb metal(float u, float v) { return grey(0.9F + 0.1F * tileNoise(u, fraction(4.0F * v), 8, 80)); }

Rgb books(float u, float v) {
  // One shelf of spines a tile, of uneven width and height.
  const float x = u * 26.0F + 0.35F * std::sin(kTwoPi * 5.0F * u);
  const std::uint64_t book = cellOf(x) % 26;
  const float in_x = fraction(x), top = 0.7F + 0.25F * noiseOf(90, book, 0);
  if (v > top || in_x < 0.05F) return grey(0.04F);
  const Rgb cover = paletteColor(hashOf(91, book));
  const float band = 0.55F + 0.25F * noiseOf(92, book, 0);
  if (std::abs(v - band) < 0.035F) return paletteColor(hashOf(93, book));
  const float letters = (v > 0.15F && v < 0.45F && in_x > 0.35F && in_x < 0.65F)
                            ? step(0.5F, noiseOf(94, book, cellOf(v * 60.0F)))
                            : 0.0F;
  const float round = 0.75F + 0.35F * std::sin(3.1416F * in_x);
  return mix(cover, grey(0.8F), 0.6F * letters) * round;
}

Rgb picture(float u, float v) {
  // A framed landscape: sky, hills, a sun, and brush strokes.
  if (std::min({u, v, 1.0F - u, 1.0F - v}) < 0.05F) return Rgb(0.12F, 0.07F, 0.04F);
  const float stroke = 0.75F + 0.5F * tileFractal(u, v, 24, 3, 100);
  const float far_hill = 0.52F + 0.14F * std::sin(7.0F * u) + 0.05F * std::sin(19.0F * u);
  const float near_hill = 0.3F + 0.12F * std::sin(4.0F * u + 2.0F);
  if (v < near_hill) return Rgb(0.18F, 0.22F, 0.05F) * stroke;
  if (v < far_hill) return Rgb(0.16F, 0.3F, 0.28F) * stroke;
  if (std::hypot(u - 0.7F, v - 0.78F) < 0.08F) return Rgb(0.95F, 0.6F, 0.2F);
  return mix(Rgb(0.8F, 0.5F, 0.4F), Rgb(0.25F, 0.4F, 0.65F), (v - 0.4F) / 0.6F) * stroke;
}

Rgb foliage(float u, float v) {
  const float leaves = tileFractal(u, v, 10, 3, 110), shade = tileNoise(u, v, 22, 111);
  return leaves < 0.45F ? grey(0.12F) : Rgb(0.8F + 0.5F * shade, 1.0F, 0.7F) * (0.3F + shade);
}

Rgb smooth(float, float) { return grey(1.0F); }

Rgb outdoors(float u, float v) {
  const float tree = 0.35F + 0.12F * tileFractal(u, 0.5F, 8, 4, 120);
  if (u < 0.03F || u > 0.97F || v < 0.03F || v > 0.97F || std::abs(u - 0.5F) < 0.015F) {
    return grey(0.25F);
  }
  if (v < tree) return Rgb(0.12F, 0.2F, 0.08F) * (0.5F + tileFractal(u, v, 32, 3, 121));
  return mix(Rgb(0.9F, 0.95F, 1.0F), Rgb(0.6F, 0.8F, 1.0F), v);
}

struct Recipe {
  Rgb (*paint)(float, float);
  int size;
  float tile_m, gloss, gloss_power, glow;
  Rgb usual;
  bool fit_width = false, fit_height = false;
  LaserEcho echo = LaserEcho::kReturned;
};

const std::map<std::string, Recipe>& recipes() {
  const Rgb light(0.72F, 0.71F, 0.68F), white = Rgb::Ones(), brown(0.34F, 0.19F, 0.09F);
  static const std::map<std::string, Recipe> kRecipes = {
      {"plaster", {plaster, 128, 2.0F, 0.0F, 1.0F, 0.0F, light}},
      {"roughcast", {roughcast, 512, 1.6F, 0.0F, 1.0F, 0.0F, light}},
      {"wallpaper", {wallpaper, 512, 1.2F, 0.0F, 1.0F, 0.0F, light}},
      {"brick", {brick, 512, 1.0F, 0.0F, 1.0F, 0.0F, {0.42F, 0.16F, 0.09F}}},
      {"wood", {wood, 256, 0.8F, 0.04F, 30.0F, 0.0F, brown}},
      {"parquet", {parquet, 512, 1.6F, 0.12F, 60.0F, 0.0F, {0.42F, 0.24F, 0.12F}}},
      {"tiles", {tiles, 512, 1.4F, 0.25F, 120.0F, 0.0F, light}},
      {"carpet", {carpet, 512, 1.2F, 0.0F, 1.0F, 0.0F, {0.28F, 0.26F, 0.24F}}},
      {"rug", {rug, 512, 1.3F, 0.0F, 1.0F, 0.0F, {0.42F, 0.2F, 0.15F}}},
      {"fabric", {fabric, 256, 0.4F, 0.0F, 1.0F, 0.0F, {0.25F, 0.3F, 0.32F}}},
      {"leather", {leather, 256, 0.5F, 0.1F, 20.0F, 0.0F, {0.14F, 0.07F, 0.04F}}},
      {"metal", {metal, 256, 0.5F, 0.5F, 50.0F, 0.0F, {0.5F, 0.5F, 0.52F}}},
      {"gloss", {smooth, 16, 1.0F, 0.35F, 90.0F, 0.0F, {0.75F, 0.75F, 0.75F}}},
      {"screen", {smooth, 16, 1.0F, 0.6F, 300.0F, 0.0F, {0.012F, 0.012F, 0.014F}}},
      {"books", {books, 512, 0.85F, 0.0F, 1.0F, 0.0F, white, false, true}},
      {"picture", {picture, 256, 1.0F, 0.03F, 60.0F, 0.0F, white, true, true}},
      {"foliage", {foliage, 256, 0.5F, 0.03F, 20.0F, 0.0F, {0.1F, 0.2F, 0.05F}}},
      {"velvet",
       {fabric,
        256,
        0.4F,
        0.0F,
        1.0F,
        0.0F,
        {0.02F, 0.02F, 0.02F},
        false,
        false,
        LaserEcho::kSwallowed}},
      {"frosted glass",
       {smooth,
        16,
        1.0F,
        0.6F,
        200.0F,
        0.0F,
        {0.6F, 0.68F, 0.66F},
        false,
        false,
        LaserEcho::kPassed}},
      {"outdoors", {outdoors, 256, 1.0F, 0.0F, 1.0F, 0.9F, white, true, true}},
      {"lamp", {smooth, 16, 1.0F, 0.0F, 1.0F, 1.6F, white}}};
  return kRecipes;
}

}  // namespace

bool isMaterial(const std::string& name) { return recipes().count(name) != 0; }

std::string materialNames() {
  std::string names;
  for (const auto& [name, recipe] : recipes()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

Rgb usualColor(const std::string& material) { return recipes().at(material).usual; }

int MaterialLibrary::indexOf(const std::string& name) {
  const auto known = indices_.find(name);
  if (known != indices_.end()) return known->second;
  const auto found = recipes().find(name);
  if (found == recipes().end()) throw std::invalid_argument("no material '" + name + "'");
  const Recipe& recipe = found->second;
  materials_.push_back({Texture(recipe.size, recipe.paint), recipe.tile_m, recipe.gloss,
                        recipe.gloss_power, recipe.glow, recipe.fit_width, recipe.fit_height,
                        recipe.echo});
  return indices_[name] = static_cast<int>(materials_.size()) - 1;
}

}  // namespace heel
