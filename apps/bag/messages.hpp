// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The standard messages of robots that we read and write, each described once.
///
/// `fields(message, archive)` names a message's fields in their order. From it alone come reading
/// and writing in both forms (message_archives.hpp) and the definitions that ROS 1 bags carry
/// (message_definition.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace heel {

/// How messages are laid out in a bag.
enum class BagForm {
  kRos1,  ///< ROS 1: packed.
  kRos2,  ///< ROS 2: CDR, aligned.
};

/// A moment, in nanoseconds.
struct StampMsg {
  std::int64_t ns = 0;
};

/// A span of time, in nanoseconds.
struct DurationMsg {
  std::int64_t ns = 0;
};

struct HeaderMsg {
  static constexpr const char* kType = "std_msgs/Header";
  std::uint32_t seq = 0;  ///< ROS 1 only.
  StampMsg stamp;
  std::string frame_id;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    if constexpr (Archive::kForm == BagForm::kRos1) a("seq", m.seq);
    a("stamp", m.stamp);
    a("frame_id", m.frame_id);
  }
};

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
    a("D", m.D);
    a("K", m.K);
    a("R", m.R);
    a("P", m.P);
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

struct PointMsg {
  static constexpr const char* kType = "geometry_msgs/Point";
  double x = 0.0, y = 0.0, z = 0.0;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("x", m.x);
    a("y", m.y);
    a("z", m.z);
  }
};

struct Vector3Msg : PointMsg {
  static constexpr const char* kType = "geometry_msgs/Vector3";
};

struct QuaternionMsg {
  static constexpr const char* kType = "geometry_msgs/Quaternion";
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("x", m.x);
    a("y", m.y);
    a("z", m.z);
    a("w", m.w);
  }
};

struct PoseMsg {
  static constexpr const char* kType = "geometry_msgs/Pose";
  PointMsg position;
  QuaternionMsg orientation;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("position", m.position);
    a("orientation", m.orientation);
  }
};

struct PoseStampedMsg {
  static constexpr const char* kType = "geometry_msgs/PoseStamped";
  static constexpr const char* kMd5 = "d3812c3cbc69362b77dc0b19b345f8f5";
  HeaderMsg header;
  PoseMsg pose;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("pose", m.pose);
  }
};

struct PoseWithCovarianceMsg {
  static constexpr const char* kType = "geometry_msgs/PoseWithCovariance";
  PoseMsg pose;
  std::array<double, 36> covariance{};

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("pose", m.pose);
    a("covariance", m.covariance);
  }
};

struct TwistMsg {
  static constexpr const char* kType = "geometry_msgs/Twist";
  Vector3Msg linear, angular;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("linear", m.linear);
    a("angular", m.angular);
  }
};

struct TwistWithCovarianceMsg {
  static constexpr const char* kType = "geometry_msgs/TwistWithCovariance";
  TwistMsg twist;
  std::array<double, 36> covariance{};

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("twist", m.twist);
    a("covariance", m.covariance);
  }
};

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

struct TransformMsg {
  static constexpr const char* kType = "geometry_msgs/Transform";
  Vector3Msg translation;
  QuaternionMsg rotation;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("translation", m.translation);
    a("rotation", m.rotation);
  }
};

/// Maps points of the child's frame to the header's.
struct TransformStampedMsg {
  static constexpr const char* kType = "geometry_msgs/TransformStamped";
  HeaderMsg header;
  std::string child_frame_id;
  TransformMsg transform;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("child_frame_id", m.child_frame_id);
    a("transform", m.transform);
  }
};

struct TFMessageMsg {
  static constexpr const char* kType = "tf2_msgs/TFMessage";
  static constexpr const char* kMd5 = "94810edda583a504dfda3829e70d7eec";
  std::vector<TransformStampedMsg> transforms;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("transforms", m.transforms);
  }
};

struct PoseArrayMsg {
  static constexpr const char* kType = "geometry_msgs/PoseArray";
  static constexpr const char* kMd5 = "916c28c5764443f268b296bb671b9d97";
  HeaderMsg header;
  std::vector<PoseMsg> poses;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("poses", m.poses);
  }
};

struct ColorRGBAMsg {
  static constexpr const char* kType = "std_msgs/ColorRGBA";
  float r = 0.0F, g = 0.0F, b = 0.0F, a = 1.0F;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& archive) {
    archive("r", m.r);
    archive("g", m.g);
    archive("b", m.b);
    archive("a", m.a);
  }
};

/// Where a texture's corner is; ROS 2 only.
struct UVCoordinateMsg {
  static constexpr const char* kType = "visualization_msgs/UVCoordinate";
  float u = 0.0F, v = 0.0F;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("u", m.u);
    a("v", m.v);
  }
};

/// ROS 2 only.
struct MeshFileMsg {
  static constexpr const char* kType = "visualization_msgs/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("filename", m.filename);
    a("data", m.data);
  }
};

/// Something to draw. In ROS 2 this is the layout since Galactic, which has textures and meshes.
struct MarkerMsg {
  static constexpr const char* kType = "visualization_msgs/Marker";
  static constexpr const char* kConstants =
      "uint8 ARROW=0\nuint8 CUBE=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\nuint8 LINE_STRIP=4\n"
      "uint8 LINE_LIST=5\nuint8 CUBE_LIST=6\nuint8 SPHERE_LIST=7\nuint8 POINTS=8\n"
      "uint8 TEXT_VIEW_FACING=9\nuint8 MESH_RESOURCE=10\nuint8 TRIANGLE_LIST=11\n"
      "uint8 ADD=0\nuint8 MODIFY=0\nuint8 DELETE=2\nuint8 DELETEALL=3\n";
  enum Type : std::int32_t { kArrow = 0, kCylinder = 3, kText = 9 };
  enum Action : std::int32_t { kAdd = 0, kDeleteAll = 3 };
  HeaderMsg header;
  std::string ns;
  std::int32_t id = 0, type = kArrow, action = kAdd;
  PoseMsg pose;
  Vector3Msg scale;
  ColorRGBAMsg color;
  DurationMsg lifetime;
  bool frame_locked = false;
  std::vector<PointMsg> points;
  std::vector<ColorRGBAMsg> colors;
  std::string texture_resource;
  CompressedImageMsg texture;
  std::vector<UVCoordinateMsg> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFileMsg mesh_file;
  bool mesh_use_embedded_materials = false;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    constexpr bool kHasTextures = Archive::kForm == BagForm::kRos2;
    a("header", m.header);
    a("ns", m.ns);
    a("id", m.id);
    a("type", m.type);
    a("action", m.action);
    a("pose", m.pose);
    a("scale", m.scale);
    a("color", m.color);
    a("lifetime", m.lifetime);
    a("frame_locked", m.frame_locked);
    a("points", m.points);
    a("colors", m.colors);
    if constexpr (kHasTextures) {
      a("texture_resource", m.texture_resource);
      a("texture", m.texture);
      a("uv_coordinates", m.uv_coordinates);
    }
    a("text", m.text);
    a("mesh_resource", m.mesh_resource);
    if constexpr (kHasTextures) a("mesh_file", m.mesh_file);
    a("mesh_use_embedded_materials", m.mesh_use_embedded_materials);
  }
};

struct MarkerArrayMsg {
  static constexpr const char* kType = "visualization_msgs/MarkerArray";
  static constexpr const char* kMd5 = "d155b9ce5188fbaf89745847fd5882d7";
  std::vector<MarkerMsg> markers;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("markers", m.markers);
  }
};

}  // namespace heel
