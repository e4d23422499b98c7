// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A small scene to simulate.
#pragma once

#include <string>

namespace heel::test {

/// A hall of 5 by 4 m with `people` (the items of a YAML list, the first without its dash), and a
/// robot whose camera is `camera`.
inline std::string hallScene(const std::string& duration_s, const std::string& people,
                             const std::string& camera) {
  return "name: hall\nduration_s: " + duration_s + R"(
floor: {material: parquet, color: oak}
wall_surface: {material: roughcast, color: beige}
walls:
  - {from: [0, -2], to: [0, 2]}
  - {from: [0, 2], to: [5, 2]}
  - {from: [5, 2], to: [5, -2]}
  - {from: [5, -2], to: [0, -2]}
lights:
  - {lamp: [2.5, 0, 2.4], power: 30, radius_m: 0.2}
people:
  - )" + people +
         "\nrobot:\n  start: [0.5, 0]\n  camera: " + camera + "\n";
}

}  // namespace heel::test
