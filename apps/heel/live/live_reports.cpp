// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/live/live_reports.hpp>
#include <heel/apps/pages/page_parts.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <cmath>
#include <cstdio>

namespace heel {
namespace {

constexpr const char* kDiagnostics = "/diagnostics";
constexpr double kEvery_s = 1.0;

DiagnosticStatusMsg::Level levelOf(const FollowStep& step) {
  const bool is_well = !step.is_paused && !step.robot.lost &&
                       (step.is_learning || step.action == FollowingAction::kFollow ||
                        step.action == FollowingAction::kFace);
  return is_well ? DiagnosticStatusMsg::kOk : DiagnosticStatusMsg::kWarn;
}

std::string shown(const char* format, double value) {
  if (!std::isfinite(value)) return "not known";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

LiveReports::LiveReports(LiveNetwork& network, const std::string& frame)
    : network_(network), results_(network.writer(), frame), diagnostics_(network.writer()) {
  diagnostics_->announce<DiagnosticArrayMsg>(kDiagnostics);
}

void LiveReports::add(const FollowStep& step, const Follower& follower, const LiveFigures& figures,
                      double clock_s) {
  if (step.perception != nullptr) {
    results_.addTracks(step.stamp_s, follower.perception()->tracks(), follower.target());
  } else if (step.is_learning && has_tracks_) {
    results_.addTracks(step.stamp_s, {}, {});  // they are forgotten
  }
  has_tracks_ = step.perception != nullptr || (has_tracks_ && !step.is_learning);
  if (step.path != nullptr || has_path_) {
    results_.addPath(step.stamp_s, step.path != nullptr ? *step.path : FloorPath{});
  }
  has_path_ = step.path != nullptr;
  addDiagnostics(step, follower, figures, clock_s);
}

void LiveReports::addDiagnostics(const FollowStep& step, const Follower& follower,
                                 const LiveFigures& figures, double clock_s) {
  DiagnosticStatusMsg status;
  std::string reason = network_.trouble();
  if (reason.empty()) reason = follower.blindness();
  status.level = reason.empty() ? levelOf(step) : DiagnosticStatusMsg::kError;
  if (reason.empty()) reason = step.reason;
  const std::string state = step.state();
  const std::string told = state + std::to_string(status.level);
  if (told == told_ && clock_s - told_s_ < kEvery_s) return;
  told_ = told;
  told_s_ = clock_s;

  status.name = "heel: follower";
  status.message = wordsOf(state) + (reason.empty() ? "" : ": " + reason);
  const TargetEstimate& target = follower.target();
  status.values = {
      {"state", state},
      {"reason", reason},
      {"confidence", shown("%.2f", target.confidence)},
      {"target track", target.hasPlace() ? std::to_string(target.track_id) : "none"},
      {"from picture to velocity, 95 of 100 [ms]",
       shown("%.0f", 1e3 * shareOf(figures.latencies_s, 0.95))},
      {"pictures left out", std::to_string(figures.pictures_left_out)},
      {"commands not in time", std::to_string(figures.commands_late)},
  };
  DiagnosticArrayMsg message;
  message.header.stamp.ns = nanosecondsOf(step.stamp_s);
  message.status.push_back(std::move(status));
  diagnostics_->write(kDiagnostics, message.header.stamp.ns, message);
}

}  // namespace heel
