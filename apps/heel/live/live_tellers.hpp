// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a run of `heel live` tells on the terminal.
#pragma once

#include <heel/apps/follower/follower.hpp>
#include <heel/apps/live/command_sender.hpp>

#include <string>

namespace heel {

/// Each state when it begins, and why.
class StateTeller {
 public:
  void tell(const std::string& state, const std::string& reason, double since_s);

 private:
  std::string last_;
};

/// When a sensor, or all of the network, has been silent for too long, and when it is heard again.
class SilenceTeller {
 public:
  /// @param trouble  The network's.
  void tell(const RobotReadings& now, const std::string& trouble, double clock_s);

 private:
  struct Sensor {
    void tell(const char* what, bool has_come, double clock_s);
    double heard_s = 0.0;
    bool is_silent = false;
  };
  Sensor camera_, laser_, wheels_;
  std::string trouble_;
};

/// Once, when nobody hears the velocities though there was time to find each other.
class UnheardTeller {
 public:
  /// @param since_s  So long velocities have been sent.
  void tell(const CommandSender& sender, const CommandSenderParams& params, double since_s);

 private:
  bool is_done_ = false;
};

/// What others told the follower, as LiveCommands heard it.
void tellCommand(const std::string& words, bool is_unknown);

}  // namespace heel
