// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Odometry, paths and maps as messages; see messages.hpp.
#pragma once

#include <heel/apps/bag/geometry_messages.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace heel {

struct OdometryMsg {
  static constexpr const char* kType = "nav_msgs/Odometry";
  static constexpr const char* kMd5 = "cd5e73d190d741a2f92e81eda573aca7";
  HeaderMsg header;
  std::string child_frame_id;
  PoseWithCovarianceMsg pose;
  TwistWithCovarianceMsg twist;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("child_frame_id", m.child_frame_id);
    a("pose", m.pose);
    a("twist", m.twist);
  }
};

struct PathMsg {
  static constexpr const char* kType = "nav_msgs/Path";
  static constexpr const char* kMd5 = "6227e2b7e9cce15051f669a5e197bbf7";
  HeaderMsg header;
  std::vector<PoseStampedMsg> poses;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("poses", m.poses);
  }
};

struct MapMetaDataMsg {
  static constexpr const char* kType = "nav_msgs/MapMetaData";
  StampMsg map_load_time;
  float resolution = 0.0F;  ///< [m]
  std::uint32_t width = 0, height = 0;
  PoseMsg origin;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("map_load_time", m.map_load_time);
    a("resolution", m.resolution);
    a("width", m.width);
    a("height", m.height);
    a("origin", m.origin);
  }
};

struct OccupancyGridMsg {
  static constexpr const char* kType = "nav_msgs/OccupancyGrid";
  static constexpr const char* kMd5 = "3381f2d731d4076ec5c71b0759edbe4e";
  HeaderMsg header;
  MapMetaDataMsg info;
  std::vector<std::int8_t> data;  ///< 0 free, 100 occupied, -1 unknown.

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("info", m.info);
    a("data", m.data);
  }
};

}  // namespace heel
