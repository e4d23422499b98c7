// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What surfaces are made of. All materials are drawn by formulas; there are no picture files.
#pragma once

#include <heel/apps/simulation/texture.hpp>

#include <map>
#include <string>
#include <vector>

namespace heel {

/// What a laser's beam does at a surface: it comes back, it ends there, or it goes on.
enum class LaserEcho { kReturned, kSwallowed, kPassed };

/// A texture with its size in the world, and how the surface throws light back.
struct Material {
  Texture texture;
  float tile_m = 1.0F;        ///< Edge of one tile of the texture.
  float gloss = 0.0F;         ///< Strength of mirror-like highlights; 0 = matt.
  float gloss_power = 40.0F;  ///< The higher, the smaller the highlights.
  float glow = 0.0F;          ///< Radiance of its own per unit of colour (lamps, windows).
  bool fit_width = false;     ///< One tile covers the whole width of a face,
  bool fit_height = false;    ///< ... or its whole height (pictures, book shelves).
  LaserEcho echo = LaserEcho::kReturned;  ///< What a laser sees of it.
};

bool isMaterial(const std::string& name);
/// With commas between them.
std::string materialNames();
/// The tint that a material has unless a scene gives another.
Rgb usualColor(const std::string& material);

/// Draws materials when they are first asked for.
class MaterialLibrary {
 public:
  /// A number that stays valid.
  /// @throws std::invalid_argument  if there is no such material.
  int indexOf(const std::string& name);
  const Material& operator[](int index) const {
    return materials_[static_cast<std::size_t>(index)];
  }

 private:
  std::vector<Material> materials_;
  std::map<std::string, int> indices_;
};

}  // namespace heel
