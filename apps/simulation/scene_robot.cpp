// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/scene_parts.hpp>

namespace heel {
namespace {

CameraParams readCamera(YamlMap& map) {
  CameraParams camera;
  camera.at = map.point3("at", camera.at);
  camera.pitch_rad = map.number("pitch_deg", camera.pitch_rad / kRadians, {-60, 60}) * kRadians;
  camera.width = map.integer("width", camera.width, 16, 4096);
  camera.height = map.integer("height", camera.height, 16, 4096);
  camera.horizontal_view_rad =
      map.number("view_deg", camera.horizontal_view_rad / kRadians, {5, 150}) * kRadians;
  camera.baseline_m = map.number("baseline_m", camera.baseline_m, kPositive);
  camera.rate_hz = map.number("rate_hz", camera.rate_hz, kPositive);
  camera.exposure = map.number("exposure", camera.exposure, kPositive);
  camera.read_noise = map.number("read_noise", camera.read_noise, kNotNegative);
  camera.shot_noise = map.number("shot_noise", camera.shot_noise, kNotNegative);
  camera.vignetting = map.number("vignetting", camera.vignetting, kShare);
  camera.blur_px = map.number("blur_px", camera.blur_px, {0.0, 3.0});
  camera.drawn_light = map.flag("drawn_light", camera.drawn_light);
  map.done();
  return camera;
}

LaserParams readLaser(YamlMap& map) {
  LaserParams laser;
  laser.at = map.point3("at", laser.at);
  laser.view_rad = map.number("view_deg", laser.view_rad / kRadians, {1, 360}) * kRadians;
  laser.beams = map.integer("beams", laser.beams, 2, 100000);
  laser.rate_hz = map.number("rate_hz", laser.rate_hz, kPositive);
  laser.max_range_m = map.number("max_range_m", laser.max_range_m, kPositive);
  laser.noise_m = map.number("noise_m", laser.noise_m, kNotNegative);
  map.done();
  return laser;
}

OdometryParams readOdometry(YamlMap& map) {
  OdometryParams odometry;
  odometry.rate_hz = map.number("rate_hz", odometry.rate_hz, kPositive);
  odometry.distance_noise = map.number("distance_noise", odometry.distance_noise, kNotNegative);
  odometry.turn_noise = map.number("turn_noise", odometry.turn_noise, kNotNegative);
  odometry.drift_noise = map.number("drift_noise", odometry.drift_noise, kNotNegative);
  odometry.distance_bias = map.number("distance_bias", odometry.distance_bias, {-1, 1});
  odometry.turn_bias = map.number("turn_bias", odometry.turn_bias, {-1, 1});
  odometry.drift_bias = map.number("drift_bias", odometry.drift_bias, {-1, 1});
  map.done();
  return odometry;
}

}  // namespace

RobotParams readRobot(YamlMap& map) {
  RobotParams robot;
  robot.start = map.point2("start");
  robot.start_yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
  robot.radius_m = map.number("radius_m", robot.radius_m, kPositive);
  robot.height_m = map.number("height_m", robot.height_m, kPositive);
  robot.max_speed_mps = map.number("max_speed_mps", robot.max_speed_mps, kPositive);
  robot.max_turn_radps = map.number("max_turn_radps", robot.max_turn_radps, kPositive);
  robot.max_acceleration_mps2 =
      map.number("max_acceleration_mps2", robot.max_acceleration_mps2, kPositive);
  robot.max_turn_acceleration_radps2 =
      map.number("max_turn_acceleration_radps2", robot.max_turn_acceleration_radps2, kPositive);
  if (auto camera = map.map("camera", "camera")) robot.camera = readCamera(*camera);
  if (auto laser = map.map("laser", "laser")) robot.laser = readLaser(*laser);
  if (auto odometry = map.map("odometry", "odometry")) robot.odometry = readOdometry(*odometry);
  map.done();
  return robot;
}

}  // namespace heel
