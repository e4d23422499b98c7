// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/live/live_tellers.hpp>

#include <cstdio>

namespace heel {

void StateTeller::tell(const std::string& state, const std::string& reason, double since_s) {
  if (state == last_) return;
  last_ = state;
  std::fprintf(stderr, "heel: %7.1f s: %s%s%s\n", since_s, state.c_str(),
               reason.empty() ? "" : ", ", reason.c_str());
}

void SilenceTeller::tell(const RobotReadings& now, const std::string& trouble, double clock_s) {
  if (trouble != trouble_) {
    if (trouble.empty()) std::fprintf(stderr, "heel: the network answers again\n");
    if (!trouble.empty()) warn(trouble + ": the robot is told to stand");
    trouble_ = trouble;
  }
  camera_.tell("picture", now.frame != nullptr, clock_s);
  laser_.tell("laser scan", now.scan != nullptr, clock_s);
  wheels_.tell("odometry", now.odometry.has_value(), clock_s);
}

void SilenceTeller::Sensor::tell(const char* what, bool has_come, double clock_s) {
  constexpr double kSilent_s = 1.0;
  if (has_come || heard_s == 0.0) {
    if (is_silent) std::fprintf(stderr, "heel: a %s has come again\n", what);
    is_silent = false;
    heard_s = clock_s;
  } else if (!is_silent && clock_s - heard_s > kSilent_s) {
    is_silent = true;
    warn(std::string("no ") + what + " has come for a second: the robot is told to stand");
  }
}

void UnheardTeller::tell(const CommandSender& sender, const CommandSenderParams& params,
                         double since_s) {
  constexpr double kFound_s = 2.0;
  if (is_done_ || since_s < kFound_s) return;
  is_done_ = true;
  if (sender.isHeard()) return;
  warn("nobody hears " + params.topic + " as " +
       (params.stamped ? "TwistStamped: without --stamped it is Twist"
                       : "Twist: with --stamped it is TwistStamped") +
       ", and --command-topic names another topic");
}

void tellCommand(const std::string& words, bool is_unknown) {
  if (is_unknown) {
    warn("/heel/command: '" + words + "' is not known; it takes pause, go, forget, stop");
  } else {
    std::fprintf(stderr, "heel: /heel/command: %s\n", words.c_str());
  }
}

}  // namespace heel
