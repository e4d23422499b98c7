// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/follow_run.hpp"

#include <heel/apps/pages/page_parts.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace heel::test {
namespace {

using Eigen::Vector2d;

constexpr double kStep_s = 0.1;
constexpr double kLearn_s = 15.0;
constexpr double kStandOff_m = 0.95;

/// Goes along corners, and knows where it is after some way.
class Way {
 public:
  explicit Way(std::vector<Vector2d> corners) : corners_(std::move(corners)) {}
  Vector2d after(double way_m) const {
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const Vector2d leg = corners_[i] - corners_[i - 1];
      if (way_m <= leg.norm()) return corners_[i - 1] + leg.normalized() * way_m;
      way_m -= leg.norm();
    }
    return corners_.back();
  }
  double length() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < corners_.size(); ++i) sum += (corners_[i] - corners_[i - 1]).norm();
    return sum;
  }

 private:
  std::vector<Vector2d> corners_;
};

void fill(OccupancyGrid& grid, double x0, double y0, double x1, double y1) {
  const GridCell low = grid.cellAt({x0 + 1e-6, y0 + 1e-6});
  const GridCell high = grid.cellAt({x1 - 1e-6, y1 - 1e-6});
  for (GridCell cell = low; cell.y <= high.y; ++cell.y) {
    for (cell.x = low.x; cell.x <= high.x; ++cell.x) {
      if (grid.contains(cell)) grid.at(cell) = Occupancy::kOccupied;
    }
  }
}

/// A room in perspective with somebody in orange: what a snapshot may look like.
cv::Mat snapshotPicture(double person_at) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(196, 204, 208));
  cv::rectangle(picture, {0, 300}, {640, 480}, {104, 134, 160}, cv::FILLED);
  cv::rectangle(picture, {380, 90}, {520, 310}, {150, 160, 166}, cv::FILLED);
  const cv::Point feet(static_cast<int>(640 * person_at), 400);
  cv::rectangle(picture, feet + cv::Point(-22, -110), feet + cv::Point(22, 0), {96, 52, 40},
                cv::FILLED);
  cv::ellipse(picture, feet + cv::Point(0, -160), {38, 66}, 0, 0, 360, {40, 120, 235}, cv::FILLED,
              cv::LINE_AA);
  cv::circle(picture, feet + cv::Point(0, -250), 24, {130, 160, 210}, cv::FILLED, cv::LINE_AA);
  return picture;
}

/// When the person can't be seen, in seconds after the learning.
bool isHidden(double t) { return (t > 28.0 && t < 36.0) || (t > 64.0 && t < 77.0); }

std::string stateAt(double t, bool is_near) {
  if (t < 0.0) return "learn";
  if (t > 64.0 && t < 77.0) return t < 68.0 ? "goToLastSeen" : t < 72.0 ? "seek" : "search";
  if (t > 28.0 && t < 36.0) return t < 33.0 ? "goToLastSeen" : "seek";
  return is_near ? "face" : "follow";
}

std::string reasonOf(const std::string& state) {
  if (state == "learn") return "the camera watches the room, then the person who enters";
  if (state == "follow") return "the person is in view";
  if (state == "face") return "the person is within 1 m";
  if (state == "goToLastSeen") return "nothing was observed near the target's place";
  return state == "seek" ? "turns to the side where the person was last seen"
                         : "looks through the doorway where the person can have gone";
}

}  // namespace

OccupancyGrid flatMap() {
  OccupancyGrid grid({-0.2, -0.2}, 0.05, 208, 168, Occupancy::kUnknown);
  for (GridCell cell{4, 4}; cell.y < 164; ++cell.y) {
    for (cell.x = 4; cell.x < 204; ++cell.x) grid.at(cell) = Occupancy::kFree;
  }
  const double walls[][4] = {
      {-.05, -.05, 10.05, .05}, {-.05, 7.95, 10.05, 8.05}, {-.05, 0, .05, 8},
      {9.95, 0, 10.05, 8},      {5.15, 0, 5.25, 3.5},      {5.15, 4.5, 5.25, 4.6},
      {0, 4.55, 1.95, 4.65},    {2.85, 4.55, 5.75, 4.65},  {6.65, 4.55, 8.05, 4.65},
      {8.95, 4.55, 10, 4.65},   {5.2, 3.35, 6.3, 3.45},    {7.3, 3.35, 10, 3.45},
      {3.95, 4.6, 4.05, 8},     {6.95, 4.6, 7.05, 8}};
  const double furniture[][4] = {{1.7, .1, 3.7, 1.0},  {8.2, 1.8, 9.4, 2.6}, {.1, 6.1, 2.1, 7.9},
                                 {5.0, 7.2, 6.2, 7.9}, {9.1, 6.0, 9.9, 7.9}, {4.7, 1.7, 5.1, 2.7}};
  for (const auto& box : walls) fill(grid, box[0], box[1], box[2], box[3]);
  for (const auto& box : furniture) fill(grid, box[0], box[1], box[2], box[3]);
  return grid;
}

FollowLog flatRun() {
  FollowLog log;
  log.scene = "home";
  log.seed = 7;
  log.plan = "look-around";
  log.command = "heel follow home --seed 7 --out run";
  log.outcome = "reached";
  log.person = "lena";
  log.map = flatMap();
  log.camera_rate_hz = 30.0;
  log.stages = {{"colour filter", 1.1, 1.0, 1.6},  {"stereo", 9.4, 9.0, 12.8},
                {"blobs and tracks", .8, .7, 1.3}, {"localization", 1.9, 1.8, 2.6},
                {"planning", 2.7, 1.9, 8.1},       {"behaviour", .02, .01, .04}};
  log.step = {"step", 15.9, 14.4, 22.4};

  const Way person_way({{6.2, 4.0},
                        {4.4, 3.7},
                        {2.4, 2.2},
                        {3.6, 2.5},
                        {4.7, 3.7},
                        {6.8, 4.0},
                        {6.8, 3.2},
                        {7.0, 1.6},
                        {6.8, 3.3},
                        {6.2, 4.0},
                        {6.2, 4.7},
                        {5.6, 6.2},
                        {6.2, 4.6},
                        {5.4, 4.0},
                        {2.5, 3.8},
                        {2.4, 4.7},
                        {2.6, 5.9}});
  const Way other_way({{8.5, 5.6},
                       {8.5, 4.2},
                       {4.5, 3.9},
                       {2.7, 2.3},
                       {2.4, 1.5},
                       {3.8, 1.5},
                       {5.2, 4.0},
                       {8.5, 4.1},
                       {8.5, 5.8}});
  FloorPose robot{{0.8, 2.2}, 0.0};
  double person_m = 0.0, speed = 0.0;
  std::vector<Vector2d> trail;  // the robot goes where the person went
  Vector2d person = person_way.after(0.0);
  std::size_t reached = 0;
  std::optional<Vector2d> estimate;
  for (int i = 0; i <= 1560; ++i) {
    const double t = i * kStep_s - kLearn_s;
    const double gap = (person - robot.position).norm();
    const bool waits = t > 0.0 && gap > 2.0;
    if (t > -10.0 && !waits) person_m += kStep_s * (t < 0.0 ? 0.46 : 0.38);
    person = person_way.after(person_m);
    trail.push_back(person);

    FollowSample s;
    s.stamp_s = i * kStep_s;
    s.state = stateAt(t, gap < kStandOff_m + 0.1);
    s.reason = reasonOf(s.state);
    const bool drives = s.state == "follow" || s.state == "goToLastSeen" || s.state == "search";
    const double wanted = drives && gap > kStandOff_m ? 0.3 : 0.0;
    speed += std::clamp(wanted - speed, -0.05, 0.05);
    while (reached + 1 < trail.size() && (trail[reached] - robot.position).norm() < 0.35) ++reached;
    const Vector2d ahead = trail[reached] - robot.position;
    const double turn = std::clamp(wrapped(std::atan2(ahead.y(), ahead.x()) - robot.yaw_rad),
                                   -1.0 * kStep_s, 1.0 * kStep_s);
    if (t > 0.0)
      robot = alongArc(robot, speed * kStep_s * std::max(0.0, 1.0 - 6.0 * std::abs(turn)), turn);

    if (t > -9.0 && !isHidden(t)) {
      estimate = person + 0.06 * Vector2d(std::sin(7.0 * t), std::cos(5.0 * t));
    } else {
      estimate.reset();
    }
    s.robot_true = robot;
    s.robot_estimated = robot;
    s.robot_estimated.position += 0.03 * Vector2d(std::sin(0.9 * t), std::cos(0.7 * t));
    s.robot_estimated.yaw_rad += 0.01 * std::sin(1.3 * t);
    s.position_sigma_m = 0.04;
    s.is_localized = true;
    s.command = {wanted, turn / kStep_s};
    s.speed_true = {speed, turn / kStep_s};
    if (t > -10.0) s.person_true = person;
    s.target_estimate = estimate;
    s.target_status = estimate ? "followed" : "lost";
    s.confidence = estimate ? 0.97 : 0.12;
    s.others_true = {other_way.after(std::fmod(std::max(0.0, t) * 0.6, other_way.length()))};
    if (s.person_true) s.person_distance_m = (person - robot.position).norm();
    s.clearance_m = 0.55 + 0.3 * std::sin(0.21 * t) + 0.1 * std::sin(1.7 * t);
    log.samples.push_back(s);
  }
  log.snapshots = {{12.0, "Lena comes in and is learned.", snapshotPicture(0.4)},
                   {43.2, "She is out of view behind the wall.", snapshotPicture(0.85)},
                   {95.0, "Found again in the hall.", snapshotPicture(0.55)}};
  return log;
}

FollowExperiment followExperiment() {
  FollowExperiment experiment;
  experiment.plans = {"paper", "look-around"};
  experiment.command = "heel experiment follow --out experiment";
  const auto episode = [](const std::string& name, unsigned long seed, const std::string& plan) {
    const double wave = std::sin(1.7 * static_cast<double>(seed)),
                 own = plan == "paper" ? 1.0 : 0.0;
    FollowEpisode e{name, seed, plan,
                    {},   {},   "heel follow " + name + " --seed " + std::to_string(seed)};
    e.summary.outcome = "reached";
    e.summary.distance_m = 24.0 + 4.0 * wave;
    e.summary.elapsed_s = 105.0 + 14.0 * wave + 60.0 * own;
    e.summary.seek_s = 9.0 + 5.0 * wave + 50.0 * own;
    e.summary.moving_speed_mps = e.summary.distance_m / (e.summary.elapsed_s - e.summary.seek_s);
    e.summary.min_clearance_m = 0.12 + 0.05 * wave;
    e.summary.position_rms_m = 0.04 + 0.01 * std::cos(2.3 * static_cast<double>(seed));
    return e;
  };
  for (const PaperRow& row : kPaperTable1) {
    for (const std::string& plan : experiment.plans) {
      experiment.table1.push_back(episode(row.name, 1 + experiment.table1.size(), plan));
    }
  }
  for (unsigned long seed = 1; seed <= 100; ++seed) {
    for (const std::string& plan : experiment.plans) {
      experiment.episodes.push_back(episode("home-" + std::to_string(seed), seed, plan));
    }
  }
  FollowEpisode& lost = experiment.episodes[36];
  lost.summary.outcome = "failed";
  lost.cause = "the person left through a door while the light was off";
  FollowEpisode& late = experiment.episodes[85];
  late.summary.outcome = "timeout";
  late.cause = "a doorway was blocked by another person";
  return experiment;
}

FollowVideoFrame videoFrame(const FollowLog& log, std::size_t sample) {
  const FollowSample& s = log.samples[sample];
  FollowVideoFrame frame;
  frame.view.image_bgr = snapshotPicture(0.5);
  cv::inRange(frame.view.image_bgr, cv::Scalar(20, 100, 200), cv::Scalar(80, 140, 255),
              frame.view.mask);
  frame.view.camera = {640, 480, 530.0, 530.0, 319.5, 239.5};
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_base_camera.translation().z() = 1.15;
  frame.view.T_floor_camera = basePose(s.robot_true) * T_base_camera;
  frame.view.stamp_s = s.stamp_s;
  frame.view.state = wordsOf(s.state);
  frame.view.reason = s.reason;
  frame.view.tone = s.target_estimate ? Tone::kGood : Tone::kWarning;
  if (s.target_estimate) {
    DrawnTrack track;
    track.id = 1;
    track.position_m = *s.target_estimate;
    track.is_target = true;
    track.confidence = 0.93;
    frame.view.tracks = {track};
    frame.view.blobs = {{*s.target_estimate, 2200, true}};
    frame.path = {s.robot_true.position, *s.target_estimate};
  }
  frame.robot_true = s.robot_true;
  frame.robot_estimated = s.robot_estimated;
  frame.position_sigma_m = s.position_sigma_m;
  frame.person_true = s.person_true;
  frame.target_estimate = s.target_estimate;
  frame.others_true = s.others_true;
  for (int i = 0; i < 8; ++i) frame.obstacles.emplace_back(3.4 + 0.05 * i, 3.45);
  for (std::size_t i = sample > 80 ? sample - 80 : 0; i <= sample; ++i) {
    frame.robot_trail.push_back(log.samples[i].robot_true.position);
    if (log.samples[i].person_true) frame.person_trail.push_back(*log.samples[i].person_true);
  }
  return frame;
}

}  // namespace heel::test
