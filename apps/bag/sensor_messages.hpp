// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What sensors measure, as messages; see messages.hpp.
#pragma once

#include <heel/apps/bag/geometry_messages.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace heel {

struct ImageMsg {
  static constexpr const char* kType = "sensor_msgs/Image";
  static constexpr const char* kMd5 = "060021388200f6f0f447d0fcd9c64743";
  HeaderMsg header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding;  ///< "bgr8", "mono8", "16UC1", ...
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;  ///< Bytes of a row.
  std::vector<std::uint8_t> data;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("height", m.height);
    a("width", m.width);
    a("encoding", m.encoding);
    a("is_bigendian", m.is_bigendian);
    a("step", m.step);
    a("data", m.data);
  }
};

struct CompressedImageMsg {
  static constexpr const char* kType = "sensor_msgs/CompressedImage";
  static constexpr const char* kMd5 = "8f7a12909da2c9d3332d540a0977563f";
  HeaderMsg header;
  std::string format;  ///< "jpeg", "png", "16UC1; compressedDepth png", ...
  std::vector<std::uint8_t> data;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("format", m.format);
    a("data", m.data);
  }
};

struct RegionOfInterestMsg {
  static constexpr const char* kType = "sensor_msgs/RegionOfInterest";
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("x_offset", m.x_offset);
    a("y_offset", m.y_offset);
    a("height", m.height);
    a("width", m.width);
    a("do_rectify", m.do_rectify);
  }
};

struct CameraInfoMsg {
  static constexpr const char* kType = "sensor_msgs/CameraInfo";
  static constexpr const char* kMd5 = "c9a58c1b0b154e0e6da7578cb991d214";
  HeaderMsg header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;
  std::vector<double> D;
  std::array<double, 9> K{};   ///< Of the raw image, row by row.
  std::array<double, 9> R{};   ///< Turns the camera's frame into the rectified one.
  std::array<double, 12> P{};  ///< Projects the rectified frame; P[3] = -fx * baseline.
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterestMsg roi;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("height", m.height);
    a("width", m.width);
    a("distortion_model", m.distortion_model);
    constexpr bool kIsRos1 = Archive::kForm == BagForm::kRos1;
    a(kIsRos1 ? "D" : "d", m.D);
    a(kIsRos1 ? "K" : "k", m.K);
    a(kIsRos1 ? "R" : "r", m.R);
    a(kIsRos1 ? "P" : "p", m.P);
    a("binning_x", m.binning_x);
    a("binning_y", m.binning_y);
    a("roi", m.roi);
  }
};

struct PointFieldMsg {
  static constexpr const char* kType = "sensor_msgs/PointField";
  static constexpr const char* kConstants =
      "uint8 INT8    = 1\nuint8 UINT8   = 2\nuint8 INT16   = 3\nuint8 UINT16  = 4\n"
      "uint8 INT32   = 5\nuint8 UINT32  = 6\nuint8 FLOAT32 = 7\nuint8 FLOAT64 = 8\n";
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;  ///< As pcl::PCLPointField::PointFieldTypes.
  std::uint32_t count = 0;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("name", m.name);
    a("offset", m.offset);
    a("datatype", m.datatype);
    a("count", m.count);
  }
};

struct PointCloud2Msg {
  static constexpr const char* kType = "sensor_msgs/PointCloud2";
  static constexpr const char* kMd5 = "1158d486dd51d683ce2f1be655c3c181";
  HeaderMsg header;
  std::uint32_t height = 0, width = 0;
  std::vector<PointFieldMsg> points_fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("height", m.height);
    a("width", m.width);
    a("fields", m.points_fields);
    a("is_bigendian", m.is_bigendian);
    a("point_step", m.point_step);
    a("row_step", m.row_step);
    a("data", m.data);
    a("is_dense", m.is_dense);
  }
};

struct LaserScanMsg {
  static constexpr const char* kType = "sensor_msgs/LaserScan";
  static constexpr const char* kMd5 = "90c7ef2dc6895d81024acba2ac42f369";
  HeaderMsg header;
  float angle_min = 0.0F, angle_max = 0.0F, angle_increment = 0.0F;  ///< [rad]
  float time_increment = 0.0F, scan_time = 0.0F;                     ///< [s]
  float range_min = 0.0F, range_max = 0.0F;                          ///< [m]
  std::vector<float> ranges, intensities;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("angle_min", m.angle_min);
    a("angle_max", m.angle_max);
    a("angle_increment", m.angle_increment);
    a("time_increment", m.time_increment);
    a("scan_time", m.scan_time);
    a("range_min", m.range_min);
    a("range_max", m.range_max);
    a("ranges", m.ranges);
    a("intensities", m.intensities);
  }
};

}  // namespace heel
