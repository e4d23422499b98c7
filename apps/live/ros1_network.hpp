// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The topics of ROS 1, live, by roscpp.
#pragma once

#include <heel/apps/live/live_network.hpp>

namespace heel {

/// A node of ROS 1; all networks of a program are the same node. /tf and /tf_static are never in
/// the namespace: tf2 of ROS 1 has one of each for all robots. Where the master is, ROS_MASTER_URI
/// says, and ROS_IP or ROS_HOSTNAME how others reach this machine.
///
/// Nodes that are connected could go on without the master (roscore), but nobody else could reach
/// them any more. So nothing comes while it does not answer.
class Ros1Network final : public LiveNetwork {
 public:
  /// @throws std::runtime_error, std::invalid_argument  as openNetwork().
  explicit Ros1Network(const LiveNetworkParams& params);
  ~Ros1Network() override;

  BagForm form() const override { return BagForm::kRos1; }
  std::vector<BagTopic> topics() const override;
  void subscribe(const BagTopic& topic, Delivery delivery, std::size_t depth) override;
  void unsubscribe(const std::string& topic) override;
  std::optional<LiveMessage> next(double timeout_s) override;
  std::unique_ptr<BagWriter> writer() override;
  std::string trouble() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace heel
