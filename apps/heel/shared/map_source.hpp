// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Whatever a map can be made of, as a wall map.
#pragma once

#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/mapping/wall_map.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace heel {

struct MapSourceParams {
  /// Edge of a cell, and of a pixel of a plain picture, which must have it. Else the map's own, or
  /// 0.05 m.
  std::optional<double> cell_size_m;
  double wall_height_m = 2.0;            ///< To which a floor plan is extruded.
  BagTopics topics;                      ///< Of a bag.
  std::function<void(double)> progress;  ///< Called with the share that is done; may be empty.
};

/// Walls of this height stand on what a floor plan has occupied.
/// @throws std::exception  if that can't be built.
WallMap extruded(const OccupancyGrid& plan, const MapSourceParams& params = {});

/// A map, and in words what it was made of.
struct SourcedMap {
  WallMap map;
  std::string source;
};

/// Reads a wall map (.bt), a map_server pair (its YAML), a plain picture of a floor plan, a scene
/// (YAML), or a recording (a folder or a bag).
/// @throws std::runtime_error  one sentence that names the file and the reason.
SourcedMap openMap(const std::filesystem::path& path, const MapSourceParams& params = {});

/// The same map seen from above. A floor plan is taken as it is, which is faster than by OctoMap.
/// @throws std::runtime_error  as openMap().
OccupancyGrid openFloor(const std::filesystem::path& path, const MapSourceParams& params = {});

}  // namespace heel
