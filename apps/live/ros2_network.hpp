// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The topics of ROS 2, live, over DDS. No ROS is needed.
#pragma once

#include <heel/apps/live/live_network.hpp>

namespace heel {

/// Names and types of topics are ROS 2's ("rt/scan", "sensor_msgs::msg::dds_::LaserScan_").
class Ros2Network final : public LiveNetwork {
 public:
  /// @throws std::runtime_error  as openNetwork().
  explicit Ros2Network(const LiveNetworkParams& params);
  ~Ros2Network() override;

  BagForm form() const override { return BagForm::kRos2; }
  std::vector<BagTopic> topics() const override;
  void subscribe(const BagTopic& topic, Delivery delivery, std::size_t depth) override;
  void unsubscribe(const std::string& topic) override;
  std::optional<LiveMessage> next(double timeout_s) override;
  std::unique_ptr<BagWriter> writer() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace heel
