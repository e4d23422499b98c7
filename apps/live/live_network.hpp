// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The topics of ROS, live: one seam for ROS 1 and ROS 2.
#pragma once

#include <heel/apps/bag/bag.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// A clock that does not jump [s].
double steadyClock_s();

struct LiveNetworkParams {
  BagForm ros = BagForm::kRos2;  ///< Which ROS.
  /// Put before each topic's name, as "/robot1"; empty: nothing, in ROS 1 what ROS_NAMESPACE says.
  std::string ros_namespace;
  int domain = 0;  ///< Of ROS 2, as ROS_DOMAIN_ID.
  /// Of ROS 2: only programs of this machine are heard, as with ROS_LOCALHOST_ONLY.
  bool localhost_only = false;
};

/// The environment's: ROS_VERSION (else 2), ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY.
/// @throws std::invalid_argument  if ROS_DOMAIN_ID is no number from 0 to 232.
LiveNetworkParams rosEnvironment();

/// A message that came over the network.
struct LiveMessage {
  BagTopic topic;                   ///< Its name is without the namespace.
  std::int64_t stamp_ns = 0;        ///< When it came, since 1970.
  std::vector<std::uint8_t> bytes;  ///< As in a bag of the network's form.
};

/// What is asked of who sends on a topic. In ROS 1 this is theirs to say.
enum class Delivery {
  kAsSent,    ///< As those promise who send now.
  kReliable,  ///< All of it; in ROS 2 who does not promise that is not heard.
  kLatched,   ///< The same, and what was sent last, before this.
};

/// What others send, and a way to send. Messages wait until they are taken; of each topic the last
/// few only.
class LiveNetwork {
 public:
  virtual ~LiveNetwork() = default;

  /// That of all messages.
  virtual BagForm form() const = 0;

  /// The topics that somebody sends on, as far as they have been heard of.
  virtual std::vector<BagTopic> topics() const = 0;

  /// Takes in what comes on a topic, whose type must be known.
  /// @param depth  So many wait at the most; older ones are left out.
  /// @throws std::runtime_error  if it can't be listened to.
  virtual void subscribe(const BagTopic& topic, Delivery delivery = Delivery::kAsSent,
                         std::size_t depth = 8) = 0;

  /// Listens no more to a topic; what waits of it is gone.
  virtual void unsubscribe(const std::string& topic) = 0;

  /// Waits for a message.
  /// @return  Absent if none has come in time.
  /// @throws std::runtime_error  if the network has shut this program out ('rosnode kill').
  virtual std::optional<LiveMessage> next(double timeout_s) = 0;

  /// Sends what is written, as long as the network lives. Its commit() does nothing.
  virtual std::unique_ptr<BagWriter> writer() = 0;

  /// Why nothing comes at all, in half a sentence; empty: no such reason is known.
  virtual std::string trouble() const { return {}; }
};

/// @throws std::runtime_error     if this build is without that ROS, or there is no way into the
///         network.
/// @throws std::invalid_argument  if the parameters, or ROS_MASTER_URI, can't be.
std::unique_ptr<LiveNetwork> openNetwork(LiveNetworkParams params = rosEnvironment());

}  // namespace heel
