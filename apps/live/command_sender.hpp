// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Velocities to the wheels, in time.
#pragma once

#include <heel/apps/bag/bag.hpp>
#include <heel/planning/trajectory.hpp>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace heel {

struct CommandSenderParams {
  std::string topic = "/cmd_vel";
  bool stamped = false;   ///< geometry_msgs/TwistStamped, in the frame base_link, and not Twist.
  double rate_hz = 20.0;  ///< At least.
  /// A command that is older is not sent any more: then the robot is told to stand. As long as the
  /// follower's own sensors may be late.
  double timeout_s = 0.4;
  /// Whether the robot must stand now, whatever the command; asked in the thread that sends.
  std::function<bool()> must_stand = [] { return false; };
};

/// Sends a command at once, and again and again, in a thread of its own, for as long as it is
/// fresh; else a zero. However the program leaves, by a return or an exception, it sends zeros at
/// the end. (One that is killed sends nothing: the base itself must stop when nothing comes.)
class CommandSender {
 public:
  /// @throws std::runtime_error  if nothing can be sent.
  explicit CommandSender(std::unique_ptr<BagWriter> writer, CommandSenderParams params = {});
  ~CommandSender();
  CommandSender(const CommandSender&) = delete;
  CommandSender& operator=(const CommandSender&) = delete;

  /// @param stamp_s  Now, on the clock that stamps are of. Until the first one it is the system's.
  void set(const VelocityCommand& command, double stamp_s);

  /// Whether somebody hears them, as this type of message.
  bool isHeard() const { return writer_->isHeard(params_.topic); }

  /// How often a command was too old to be sent.
  std::size_t stopped() const;

 private:
  void run();
  void send(const VelocityCommand& command, double stamp_s);
  double stampNow_s() const;

  CommandSenderParams params_;
  std::unique_ptr<BagWriter> writer_;
  mutable std::mutex mutex_;
  std::condition_variable wakes_;
  VelocityCommand command_;
  double stamp_s_ = 0.0;  // when it was set,
  double set_s_ = 0.0;    // and that on the steady clock; 0: never
  std::size_t stopped_ = 0;
  bool is_fresh_ = false, is_new_ = false;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace heel
