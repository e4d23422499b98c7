// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Velocities to the wheels, in time.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/planning/trajectory.hpp>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace heel {

struct CommandSenderParams {
  std::string topic = "/cmd_vel";  ///< geometry_msgs/Twist
  double rate_hz = 20.0;
  /// A command that is older is not sent any more: then the robot is told to stand. As long as the
  /// follower's own sensors may be late.
  double timeout_s = 0.4;
};

/// Sends the last command again and again, in a thread of its own, for as long as it is fresh; else
/// a zero. However the program leaves, by a return or an exception, it sends zeros at the end. (One
/// that is killed sends nothing: the base itself must stop when nothing comes.)
class CommandSender {
 public:
  /// @throws std::runtime_error  if nothing can be sent.
  explicit CommandSender(std::unique_ptr<BagWriter> writer, CommandSenderParams params = {});
  ~CommandSender();
  CommandSender(const CommandSender&) = delete;
  CommandSender& operator=(const CommandSender&) = delete;

  void set(const VelocityCommand& command);

  /// How often a command was too old to be sent.
  std::size_t stopped() const;

 private:
  void run();
  void send(const VelocityCommand& command);

  CommandSenderParams params_;
  std::unique_ptr<BagWriter> writer_;
  mutable std::mutex mutex_;
  std::condition_variable wakes_;
  VelocityCommand command_;
  double set_s_ = 0.0;  // on the steady clock; 0: never
  std::size_t stopped_ = 0;
  bool is_fresh_ = false;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace heel
