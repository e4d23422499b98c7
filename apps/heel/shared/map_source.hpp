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

struct RecordedMapParams {
  double cell_size_m = 0.05;
  double max_range_m = 4.0;              ///< Stereo depth is too coarse for a map further away.
  double max_pose_distance_s = 0.1;      ///< A frame without a pose so near in time is left out.
  int pixel_step = 3;                    ///< Every so many pixels each way.
  BagTopics topics;                      ///< Of a recording that is a bag.
  std::function<void(double)> progress;  ///< Called with the share that is done; may be empty.
};

/// Adds the clouds of all frames from where the robot was: robot.csv of the recording
/// (`stamp_s,x_m,y_m,yaw_rad`, as 'heel simulate' writes it) tells the base's pose in the world; of
/// a bag, see readBagPoses().
/// @throws std::runtime_error  if there is no robot.csv, nothing can be read, or no frame has a
///         pose; and as openRecording(), findCameraSetup() and CsvReader.
WallMap mapOfRecording(const std::filesystem::path& recording,
                       const RecordedMapParams& params = {});

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
