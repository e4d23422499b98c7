// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/track_run.hpp"

#include <cmath>

namespace heel::test {
namespace {

const char* stateAt(double t_s) {
  if (t_s < 2.0) return "none yet";
  if (t_s < 7.0 || t_s >= 11.0) return "followed";
  return t_s < 8.0 ? "coasting" : "lost";
}

const char* reasonAt(double t_s) {
  if (t_s < 2.0) return "nobody in view";
  if (t_s < 7.0 || t_s >= 11.0) return "";
  return t_s < 8.0 ? "nothing observed near its place" : "no pixel has the target's colours";
}

}  // namespace

TrackLog trackRun() {
  TrackLog log;
  log.recording = "kitchen";
  log.layout = "RGB-D folder, TUM layout";
  log.person = "rosa";
  log.frame = "base";
  log.seen_floor_m = {{0.5, 0.0}, {6.0, 3.0}, {6.0, -3.0}};
  for (int i = 0; i <= 200; ++i) {
    const double t_s = 0.1 * i;
    TrackSample& sample = log.samples.emplace_back();
    sample.stamp_s = 100.0 + t_s;
    sample.state = stateAt(t_s);
    sample.reason = reasonAt(t_s);
    sample.color_share = 0.05;
    if (t_s >= 2.0 && (t_s < 8.0 || t_s >= 11.0)) {
      sample.target_m = Eigen::Vector2d(2.0 + std::sin(0.3 * t_s), std::cos(0.3 * t_s));
      sample.confidence = 0.9;
    }
    if (t_s >= 5.0 && t_s <= 15.0) {
      sample.others.push_back({4, {4.0, 0.2 * t_s - 2.0}, t_s < 14.0, 0.95});
    }
    sample.others.push_back({9, {5.0, -1.5}, true, 0.05});
  }
  log.stills = {{103.0, "the target is seen", cv::Mat(60, 80, CV_8UC3, cv::Scalar(40, 90, 200))}};
  log.colors_bgr = cv::Mat(90, 300, CV_8UC3, cv::Scalar(200, 90, 40));
  return log;
}

}  // namespace heel::test
