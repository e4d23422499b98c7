// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The topics of ROS 2, live, over DDS. No ROS is needed.
#pragma once

#include <heel/apps/bag/bag.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

struct Ros2NetworkParams {
  int domain = 0;  ///< As ROS_DOMAIN_ID.
  /// Put before each topic's name, as "/robot1"; empty: nothing.
  std::string ros_namespace;
  /// Only programs of this machine are heard, as with ROS_LOCALHOST_ONLY.
  bool localhost_only = false;
};

/// The environment's: ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY.
/// @throws std::invalid_argument  if ROS_DOMAIN_ID is no number from 0 to 232.
Ros2NetworkParams ros2Environment();

/// A message that came over the network.
struct LiveMessage {
  BagTopic topic;                   ///< Its name is without the namespace.
  std::int64_t stamp_ns = 0;        ///< When it came, since 1970.
  std::vector<std::uint8_t> bytes;  ///< CDR, as in a bag.
};

/// What others send, and a way to send. Names and types of topics are ROS 2's ("rt/scan",
/// "sensor_msgs::msg::dds_::LaserScan_"), bytes are those of bags. Messages wait until they are
/// taken; of each topic the last few only.
class Ros2Network {
 public:
  /// @throws std::runtime_error  if there is no way into the network.
  explicit Ros2Network(const Ros2NetworkParams& params = ros2Environment());
  ~Ros2Network();
  Ros2Network(const Ros2Network&) = delete;
  Ros2Network& operator=(const Ros2Network&) = delete;

  /// The topics that others write, as far as they have been heard of: `type` in ROS 1's way.
  std::vector<BagTopic> topics() const;

  /// Whether somebody writes, or listens to, a topic now.
  bool hasWriter(const std::string& topic) const;
  bool hasListener(const std::string& topic) const;

  /// Takes in what comes on a topic, whose type must be known.
  /// @param latched  Also what was sent last, before this.
  /// @param depth    So many wait at the most; older ones are left out.
  void subscribe(const BagTopic& topic, bool latched = false, std::size_t depth = 8);

  /// Listens no more to a topic; what waits of it is gone.
  void unsubscribe(const std::string& topic);

  /// Waits for a message.
  /// @return  Absent if none has come in time.
  std::optional<LiveMessage> next(double timeout_s);

  /// Sends what is written, as long as the network lives. Its commit() does nothing.
  std::unique_ptr<BagWriter> writer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace heel
