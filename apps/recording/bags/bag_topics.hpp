// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which topics of a bag are read.
#pragma once

#include <string>

namespace heel {

/// Names of topics and frames; an empty one is found by its type and by well-known names.
struct BagTopics {
  std::string left, right;   ///< Topics of the left and the right stereo image.
  std::string color, depth;  ///< Topics of the colour and the depth image of an RGB-D camera.
  std::string cloud;         ///< Topic of clouds (PointCloud2) with colours.
  std::string floor;         ///< Topic of the depth image of a camera that looks at the floor.
  std::string scan;          ///< Topic of laser scans (LaserScan).
  std::string odometry;      ///< Topic of the wheels' odometry.
  std::string truth;         ///< Topic of odometry that tells where the robot really was.
  std::string world_frame;   ///< The frame of the robot's places in tf; else that of its odometry.
  std::string base_frame;    ///< The robot's frame in tf; else base_footprint, then base_link.
};

}  // namespace heel
