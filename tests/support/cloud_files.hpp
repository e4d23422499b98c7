// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PCD and PLY files in ascii, written by hand.
#pragma once

#include "tests/support/temp_folder.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heel::test {

/// A point as a line of an ascii PCD file: "x y z rgb".
inline std::string pcdPoint(double x, double y, double z, int r, int g, int b) {
  const auto rgb = static_cast<std::uint32_t>((r << 16) | (g << 8) | b);
  return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " " +
         std::to_string(rgb);
}

/// Fields are x, y, z, and rgb if there are colours.
inline void writeAsciiPcd(const std::filesystem::path& file, const std::vector<std::string>& points,
                          bool has_color = true, std::size_t height = 1) {
  const std::string width = std::to_string(points.size() / height);
  std::string text =
      std::string("VERSION .7\nFIELDS x y z") + (has_color ? " rgb" : "") + "\nSIZE 4 4 4" +
      (has_color ? " 4" : "") + "\nTYPE F F F" + (has_color ? " U" : "") + "\nCOUNT 1 1 1" +
      (has_color ? " 1" : "") + "\nWIDTH " + width + "\nHEIGHT " + std::to_string(height) +
      "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(points.size()) + "\nDATA ascii\n";
  for (const std::string& point : points) text += point + "\n";
  writeText(file, text);
}

/// Points are lines "x y z", or "x y z red green blue" if there are colours.
inline void writeAsciiPly(const std::filesystem::path& file, const std::vector<std::string>& points,
                          bool has_color = true) {
  std::string text = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex " +
                     std::to_string(points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  if (has_color) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "end_header\n";
  for (const std::string& point : points) text += point + "\n";
  writeText(file, text);
}

}  // namespace heel::test
