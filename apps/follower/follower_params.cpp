// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/param_checks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

void check(const FollowerParams& p) {
  requireNotNegative("FollowerParams",
                     {p.near_m, p.far_m, p.whole_m, p.beside_m, p.makes_room_s, p.waits_aside_s,
                      p.no_frame_s, p.lost_after_s, p.walks_on_s, p.seek_radps, p.ahead_rad,
                      p.lost_turn_radps, p.give_up_s, p.avoid_above, p.beside_people_m,
                      p.target_radius_m, p.mapped_within_m, p.obstacles_every_s});
  if (p.near_m > p.far_m) {
    throw std::invalid_argument("FollowerParams: near_m must not be greater than far_m");
  }
  const WaysideParams& w = p.wayside;
  requireNotNegative("WaysideParams",
                     {w.radius_m, w.margin_m, w.person_m, w.reach_m, w.doorway_depth_m, w.apart_m});
}

// Things at the rim are half seen.
CameraView viewOf(const CameraSetup& setup, const ObstaclePointsParams& points) {
  CameraView view;
  view.T_base_camera = setup.T_base_camera;
  const PinholeCamera& camera = setup.camera.left;
  if (camera.fx > 0.0 && camera.fy > 0.0) {
    view.half_view = 0.45 * Eigen::Array2d(camera.width / camera.fx, camera.height / camera.fy);
  }
  view.nearest_m = points.nearest_m;
  view.range_m = points.max_range_m;
  return view;
}

}  // namespace

FollowerParams::FollowerParams() {
  paths.bend_room_m = 0.12;  // round a corner with some room one sees further behind it
  paths.safety_m = 0.08;  // more than the local planner's margin, or it stops where the path goes
  goal.lead_s = 0.2;      // they turn often
  goal.furthest_share = 1.25;   // who is followed wants company, even behind a doorway
  goal.doorway_depth_m = 0.95;  // somebody who comes out of it must get past the robot
  drive.margin_m = 0.06;        // the map's walls are as far off as localization is
  drive.terms.weights[static_cast<std::size_t>(DriveTerm::kView)] = 4.0;  // or the target is lost
  obstacles.min_points = 6;  // coarse stereo errs in specks
  floor_points.nearest_m = 0.2;
  floor_points.needs_floor = true;
}

double RobotDescription::halfView_rad() const {
  const PinholeCamera& left = camera.camera.left;
  return std::atan2(0.5 * left.width, left.fx);
}

double RobotDescription::wholeView_m() const {
  constexpr double kKnee_m = 0.4, kHead_m = 1.75;
  const PinholeCamera& left = camera.camera.left;
  const auto slopeOf = [&](double row) {
    const Eigen::Vector3d ray =
        camera.T_base_camera.linear() * Eigen::Vector3d(0.0, (row - left.cy) / left.fy, 1.0);
    return ray.z() / ray.head<2>().norm();
  };
  const double eye_m = camera.T_base_camera.translation().z();
  const auto reaches_m = [](double up_m, double slope) {
    if (!(up_m > 0.0)) return 0.0;
    return slope > 0.0 ? up_m / slope : std::numeric_limits<double>::infinity();
  };
  return std::max(reaches_m(kHead_m - eye_m, slopeOf(0.0)),
                  reaches_m(eye_m - kKnee_m, -slopeOf(left.height)));
}

FollowerParams fittedTo(const RobotDescription& robot, FollowerParams params) {
  check(params);
  requireNotNegative("RobotDescription", {robot.scan_latency_s, robot.wheels_latency_s});
  params.obstacles.max_height_m = params.obstacle_points.max_height_m =
      params.floor_points.max_height_m = robot.height_m;
  params.obstacles.min_height_m = 0.0;  // All that obstacle_points gives is something.
  params.obstacles.laser_height_m = robot.scanner_height_m;
  params.gate.eye_height_m = robot.camera.T_base_camera.translation().z();
  params.paths.robot_radius_m = robot.drive.radius_m;
  params.goal.radius_m = params.wayside.radius_m = turningRadius(robot.drive);
  params.wayside.person_m = MovingPerson().radius_m + params.beside_people_m;
  params.drive.limits = robot.drive;
  params.search.map.limits = robot.drive;
  params.search.map.limits.radius_m = turningRadius(robot.drive);  // It looks around there.
  params.drive.reacts_s =
      robot.scan_latency_s + robot.wheels_latency_s + 2.0 * robot.drive.period_s;
  LastGateParams& gate = params.last_gate;
  gate.limits = robot.drive;
  gate.sight.T_base_scanner = robot.T_base_scanner;
  gate.wheels_latency_s = robot.wheels_latency_s;
  gate.sight.min_points = params.obstacles.min_points;
  gate.sight.cameras = {viewOf(robot.camera, params.obstacle_points)};
  if (robot.floor_camera) {
    gate.sight.cameras.push_back(viewOf(*robot.floor_camera, params.floor_points));
  }
  if (const double half_rad = robot.halfView_rad(); half_rad > 0.0) {
    // A narrow camera sees no more than it does; a wide one sees badly at its rims.
    double& field_rad = params.search.map.field_of_view_rad;
    field_rad = std::min(field_rad, 2.0 * half_rad);
    double& keeps_in_rad = params.drive.terms.half_view_rad;
    keeps_in_rad = std::min(keeps_in_rad, 0.8 * half_rad);
    params.whole_m = std::max(params.goal.standoff_m,
                              std::min(robot.wholeView_m(), params.search.map.max_range_m));
  }
  params.goal.half_view_rad = params.drive.terms.half_view_rad;
  return params;
}

}  // namespace heel
