// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Times, headers, points, poses and transforms of messages; see messages.hpp.
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
  static constexpr const char* kMd5 = "9f195f881246fdfa2798d1d3eebca84a";
  Vector3Msg linear, angular;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("linear", m.linear);
    a("angular", m.angular);
  }
};

struct TwistStampedMsg {
  static constexpr const char* kType = "geometry_msgs/TwistStamped";
  static constexpr const char* kMd5 = "98d34b0043a2093cf9d9345ab6eef12e";
  HeaderMsg header;
  TwistMsg twist;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("twist", m.twist);
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

}  // namespace heel
