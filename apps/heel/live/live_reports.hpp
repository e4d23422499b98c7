// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a run of `heel live` tells the robot's other programs.
#pragma once

#include <heel/apps/follower/follower.hpp>
#include <heel/apps/heel/shared/result_bag.hpp>
#include <heel/apps/live/live_network.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace heel {

/// Of the run so far.
struct LiveFigures {
  const std::vector<double>& latencies_s;  ///< From each picture to its velocity.
  std::size_t pictures_left_out = 0;
  std::size_t commands_late = 0;
};

/// Sends tracks, markers, target and path as ResultBag, without its tf, which is the robot's own;
/// and, about once a second and when the state changes, `/diagnostics`: OK while it learns or
/// follows; WARN while it stands, is paused, or looks for the person; ERROR while a sensor or the
/// network is silent. Nothing waits for who listens.
class LiveReports {
 public:
  /// @param frame  Of all places.
  /// @throws std::runtime_error  if nothing can be sent.
  LiveReports(LiveNetwork& network, const std::string& frame);

  ResultBag& results() { return results_; }

  /// @param clock_s  Now, on a clock that does not jump.
  void add(const FollowStep& step, const Follower& follower, const LiveFigures& figures,
           double clock_s);

 private:
  void addDiagnostics(const FollowStep& step, const Follower& follower, const LiveFigures& figures,
                      double clock_s);

  LiveNetwork& network_;
  ResultBag results_;
  std::unique_ptr<BagWriter> diagnostics_;
  bool has_path_ = false, has_tracks_ = false;  // others show them still
  std::string told_;                            // the last state, with its level,
  double told_s_ = 0.0;                         // and when
};

}  // namespace heel
