// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/scene_parts.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>
#include <sstream>
#include <type_traits>

namespace heel {

std::string shortestText(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

namespace {

/// Takes the values of a map's keys; what is absent stays as it is.
struct RobotReader {
  YamlMap& map;

  void number(const char* key, double& value, NumberRange range, const char*) {
    value = map.number(key, value, range);
  }
  void angle(const char* key, double& value_rad, NumberRange range_deg, const char*) {
    if (map.has(key)) value_rad = map.number(key, range_deg) * kRadians;
  }
  void integer(const char* key, int& value, int low, int high, const char*) {
    value = map.integer(key, value, low, high);
  }
  void flag(const char* key, bool& value, const char*) { value = map.flag(key, value); }
  void place(const char* key, Eigen::Vector3d& value, const char*) {
    value = map.point3(key, value);
  }
  template <typename Part>
  void part(const char* key, Part& value) {
    if (auto inner = map.map(key, key)) {
      RobotReader reader{*inner};
      visit(reader, value);
      inner->done();
    }
  }
  template <typename Part>
  void part(const char* key, std::optional<Part>& value) {
    if (map.has(key)) part(key, value.emplace());
  }
};

/// Writes them, each with what it is.
struct RobotWriter {
  std::ostringstream& out;
  std::string indent;

  void line(const char* key, const std::string& value, const char* what) {
    out << indent << key << ": " << value << "  # " << what << '\n';
  }
  void number(const char* key, double value, NumberRange, const char* what) {
    line(key, shortestText(value), what);
  }
  void angle(const char* key, double value_rad, NumberRange, const char* what) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value_rad / kRadians);
    line(key, text, what);
  }
  void integer(const char* key, int value, int, int, const char* what) {
    line(key, std::to_string(value), what);
  }
  void flag(const char* key, bool value, const char* what) {
    line(key, value ? "true" : "false", what);
  }
  void place(const char* key, const Eigen::Vector3d& p, const char* what) {
    line(key,
         "[" + shortestText(p.x()) + ", " + shortestText(p.y()) + ", " + shortestText(p.z()) + "]",
         what);
  }
  template <typename Part>
  void part(const char* key, const Part& value) {
    out << indent << key << ":\n";
    RobotWriter writer{out, indent + "  "};
    visit(writer, value);
  }
  template <typename Part>
  void part(const char* key, const std::optional<Part>& value) {
    if (value) part(key, *value);
  }
};

// One list of the keys, for reading (the parts change) and for writing (they are const).
template <typename Part, typename As>
constexpr bool kIs = std::is_same_v<std::remove_const_t<Part>, As>;

template <typename Keys, typename Camera>
void visitPictures(Keys& keys, Camera& p, NumberRange pitch_deg, const char* place) {
  keys.place("at", p.at, place);
  keys.angle("pitch_deg", p.pitch_rad, pitch_deg, "[deg] how far it looks down");
  keys.integer("width", p.width, 16, 4096, "[px]");
  keys.integer("height", p.height, 16, 4096, "[px]");
  keys.angle("view_deg", p.horizontal_view_rad, {5, 150}, "[deg] horizontal field of view");
}

template <typename Keys, typename Part>
void visit(Keys& keys, Part& p) {
  if constexpr (kIs<Part, CameraParams>) {
    visitPictures(keys, p, {-60, 60},
                  "[m] place of the left camera in the base frame: ahead, left, up");
    keys.number("baseline_m", p.baseline_m, kPositive, "[m] from the left camera to the right");
    keys.number("rate_hz", p.rate_hz, kPositive, "[1/s] pictures; of a simulated robot");
    keys.number("exposure", p.exposure, kPositive, "simulated: signal for a radiance of 1");
    keys.number("read_noise", p.read_noise, kNotNegative, "simulated, of 255 levels");
    keys.number("shot_noise", p.shot_noise, kNotNegative, "simulated, of 255 levels");
    keys.number("vignetting", p.vignetting, kShare, "simulated: share lost in the corners");
    keys.number("blur_px", p.blur_px, {0.0, 3.0}, "[px] simulated");
    keys.flag("drawn_light", p.drawn_light, "simulated: exposure and colours drawn from the seed");
  } else if constexpr (kIs<Part, FloorCameraParams>) {
    visitPictures(keys, p, {0, 90}, "[m] its place in the base frame: ahead, left, up");
    keys.number("rate_hz", p.rate_hz, kPositive, "[1/s] pictures; of a simulated robot");
    keys.number("max_range_m", p.max_range_m, kPositive, "[m] simulated");
    keys.number("noise_m", p.noise_m, kNotNegative, "[m] simulated: standard deviation");
  } else if constexpr (kIs<Part, LaserParams>) {
    keys.place("at", p.at, "[m] its place in the base frame: ahead, left, up");
    keys.angle("view_deg", p.view_rad, {1, 360}, "[deg] from the first beam to the last");
    keys.integer("beams", p.beams, 2, 100000, "of a scan");
    keys.number("rate_hz", p.rate_hz, kPositive, "[1/s] scans; of a simulated robot");
    keys.number("max_range_m", p.max_range_m, kPositive, "[m] simulated");
    keys.number("noise_m", p.noise_m, kNotNegative, "[m] simulated: standard deviation");
    keys.number("latency_s", p.latency_s, {0.0, 1.0}, "[s] a scan comes at most so late");
  } else if constexpr (kIs<Part, OdometryParams>) {
    keys.number("rate_hz", p.rate_hz, kPositive, "[1/s] simulated, as all of odometry");
    keys.number("distance_noise", p.distance_noise, kNotNegative, "[m] per root of a metre");
    keys.number("turn_noise", p.turn_noise, kNotNegative, "[rad] per root of a radian");
    keys.number("drift_noise", p.drift_noise, kNotNegative, "[rad] per root of a metre");
    keys.number("distance_bias", p.distance_bias, {-1, 1}, "share of the way");
    keys.number("turn_bias", p.turn_bias, {-1, 1}, "share of the turn");
    keys.number("drift_bias", p.drift_bias, {-1, 1}, "[rad/m]");
  } else {
    auto& drive = p.drive;
    keys.number("radius_m", drive.radius_m, kPositive,
                "[m] of a round robot; or, for these three, footprint: its corners, as Nav2's");
    keys.number("front_m", drive.front_m, {-5.0, 5.0},
                "[m] a long body's disc is drawn ahead to here,");
    keys.number("back_m", drive.back_m, {-5.0, 5.0}, "[m] and back to here");
    keys.number("height_m", p.height_m, kPositive, "[m] what hangs lower is in its way");
    keys.number("max_speed_mps", drive.max_speed_mps, kPositive, "[m/s] forwards");
    keys.number("max_reverse_mps", drive.max_reverse_mps, kPositive, "[m/s] backwards");
    keys.number("max_turn_radps", drive.max_turn_radps, kPositive, "[rad/s]");
    keys.number("max_acceleration_mps2", drive.max_acceleration_mps2, kPositive, "[m/s2]");
    keys.number("max_braking_mps2", drive.max_braking_mps2, kPositive, "[m/s2] when it slows down");
    keys.number("max_turn_acceleration_radps2", drive.max_turn_acceleration_radps2, kPositive,
                "[rad/s2]");
    keys.number("wheels_latency_s", p.wheels_latency_s, {0.0, 1.0},
                "[s] a command acts, and odometry comes, at most so late");
    keys.part("camera", p.camera);
    keys.part("floor_camera", p.floor_camera);
    keys.part("laser", p.laser);
    keys.part("odometry", p.odometry);
  }
}

/// The body around these corners.
DriveLimits bodyAround(YamlMap& map, const DriveLimits& limits) {
  constexpr const char* kKey = "footprint";
  const std::vector<Eigen::Vector2d> corners = map.points2(kKey);
  for (const char* other : {"radius_m", "front_m", "back_m"}) {
    if (map.has(other)) {
      map.fail(kKey, "and '" + std::string(other) + "' tell the same; give one of them");
    }
  }
  if (corners.size() < 3) map.fail(kKey, "needs three corners or more");
  const DriveLimits body = withBodyAround(corners, limits);
  if (!(body.radius_m > 0.0)) map.fail(kKey, "must have a width");
  return body;
}

}  // namespace

RobotParams readRobotItself(YamlMap& map) {
  RobotParams robot;
  if (map.has("footprint")) robot.drive = bodyAround(map, robot.drive);
  RobotReader reader{map};
  visit(reader, robot);
  if (robot.drive.back_m > robot.drive.front_m) map.fail("back_m", "is ahead of front_m");
  map.done();
  return robot;
}

RobotParams readRobot(YamlMap& map) {
  const Eigen::Vector2d start = map.point2("start");
  const double yaw_rad = map.number("yaw_deg", 0.0) * kRadians;
  RobotParams robot = readRobotItself(map);
  robot.start = start;
  robot.start_yaw_rad = yaw_rad;
  return robot;
}

std::string toYaml(const RobotParams& robot, const std::string& indent) {
  std::ostringstream out;
  RobotWriter writer{out, indent};
  visit(writer, robot);
  return out.str();
}

}  // namespace heel
