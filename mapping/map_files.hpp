// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Maps as files: OctoMap's binary trees (.bt), ROS's map_server pairs (YAML and PGM or PNG), and
/// plain pictures.
#pragma once

#include <heel/mapping/occupancy_grid.hpp>
#include <heel/mapping/wall_map.hpp>

#include <filesystem>

namespace heel {

/// How a picture's greys become occupancy: map_server's modes.
enum class MapImageMode {
  kTrinary,  ///< By both thresholds.
  kScale,    ///< The same, but pixels that are not opaque are unknown.
  kRaw,      ///< A grey from 0 to 100 is the occupancy in percent, the others are unknown.
};

/// How a picture's brightness becomes occupancy, as in map_server: with p = 1 for black and 0 for
/// white, p > occupied_thresh is a wall, p < free_thresh is free, the rest is unknown. Colours
/// count by their brightness; an alpha channel is looked at in the mode kScale only. In a picture
/// that has no greys but 0, 205, 254 and 255, as map_saver writes it in the mode kTrinary, 205 is
/// unknown whatever free_thresh is, unless `negate`: under Nav2's own 0.25 it would be free.
struct MapImageParams {
  /// Place of the picture's lower left corner.
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();
  bool negate = false;  ///< Whether white is occupied (p = 1) and black free; not of kRaw.
  double occupied_thresh = 0.65;               ///< A pixel whose p is greater than this is a wall.
  double free_thresh = 0.196;                  ///< A pixel whose p is less than this is free.
  MapImageMode mode = MapImageMode::kTrinary;  ///< What greys mean.
};

/// Reads a picture (PGM, PNG, ...) as a floor plan; its upper row has the largest y.
/// @param cell_size_m  Edge of a pixel.
/// @throws std::runtime_error     one sentence that names the file and the reason: it is not there,
///         is truncated, is no picture.
/// @throws std::invalid_argument  unless 0 <= free_thresh <= occupied_thresh <= 1 and the edge is
///         positive.
OccupancyGrid gridFromImage(const std::filesystem::path& file, double cell_size_m,
                            const MapImageParams& params = {});

/// Reads a map_server pair; the image's path is relative to the YAML file, and where it is not
/// there, the file of its name beside the YAML file is read. Only maps whose origin is not turned
/// (yaw 0) are read.
/// @throws std::runtime_error  one sentence that names the file and the reason.
OccupancyGrid loadMapServer(const std::filesystem::path& yaml);

/// Whether a file looks like the YAML half of a map_server pair: a map with the key 'image'.
bool isMapServerFile(const std::filesystem::path& file);

/// Writes a map_server pair: `yaml` and beside it a PGM of the same name. What is read back equals
/// what was written.
/// @throws std::runtime_error     if a file cannot be written.
/// @throws std::invalid_argument  if the grid is empty.
void saveMapServer(const OccupancyGrid& grid, const std::filesystem::path& yaml);

/// Writes the map as OctoMap's tools read it, whole or not at all. The map is not changed:
/// OctoMap's own writeBinary would prune and threshold it.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
void saveWallMap(const WallMap& map, const std::filesystem::path& file);

/// Reads a .bt file. It is checked before OctoMap sees it, whose reader goes on with what is left
/// in memory where a file is truncated.
/// @throws std::runtime_error  with one sentence that names the file and the reason: it is not
///         there, is not such a file, is truncated, or goes on after its end.
WallMap loadWallMap(const std::filesystem::path& file);

}  // namespace heel
