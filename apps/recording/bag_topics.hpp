// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which topics of a bag are read.
#pragma once

#include <string>

namespace heel {

/// Names of topics and frames; an empty one is found by its type and by well-known names.
struct BagTopics {
  std::string left, right;   ///< Stereo images.
  std::string color, depth;  ///< RGB-D images.
  std::string cloud;         ///< PointCloud2 with colours.
  std::string scan;          ///< LaserScan.
  std::string odometry;      ///< Odometry of the wheels.
  std::string truth;         ///< Odometry that tells where the robot really was.
  std::string base_frame;  ///< The robot's frame of which tf knows; else base_footprint, base_link.
};

}  // namespace heel
