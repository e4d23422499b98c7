// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What others tell the follower to do.
#pragma once

#include <heel/apps/live/live_network.hpp>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace heel {

/// Hears words (std_msgs/String) on `/heel/command`: "pause", "go", "forget" and "stop". They are
/// heard in a thread of their own and on a network of their own, so none of them waits for a step
/// of the follower, or behind pictures.
class LiveCommands {
 public:
  /// What is told, and whether it is unknown; called in that thread.
  using Told = std::function<void(const std::string& words, bool is_unknown)>;

  /// @throws std::runtime_error  if the topic can't be listened to.
  LiveCommands(std::unique_ptr<LiveNetwork> network, Told told);
  ~LiveCommands();
  LiveCommands(const LiveCommands&) = delete;
  LiveCommands& operator=(const LiveCommands&) = delete;

  /// From "pause" to "go"; and when there is no way any more in which "pause" could come.
  bool isPaused() const { return is_paused_; }
  bool isStopped() const { return is_stopped_; }
  /// From "forget" to hasForgotten(): whom the robot follows is to be forgotten.
  bool mustForget() const { return forgets_; }
  void hasForgotten() { forgets_ = false; }
  /// Whether the robot must stand, as it is paused or stopped or has not forgotten yet.
  bool mustStand() const { return is_paused_ || is_stopped_ || forgets_; }

 private:
  void listen();
  void obey(const LiveMessage& message);

  std::unique_ptr<LiveNetwork> network_;
  Told told_;
  std::string unknown_;  // the last word that was
  std::atomic<bool> is_paused_{false}, is_stopped_{false}, forgets_{false}, ends_{false};
  std::thread thread_;
};

}  // namespace heel
