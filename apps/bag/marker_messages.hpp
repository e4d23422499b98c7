// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Things to draw, as messages; see messages.hpp.
#pragma once

#include <heel/apps/bag/geometry_messages.hpp>
#include <heel/apps/bag/sensor_messages.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace heel {

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
