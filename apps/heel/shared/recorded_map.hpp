// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A wall map from what a camera saw on its way.
#pragma once

#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/mapping/wall_map.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>

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

}  // namespace heel
