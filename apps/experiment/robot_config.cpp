// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/closed_loop.hpp>
#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/simulation/camera_model.hpp>
#include <heel/apps/simulation/scene_parts.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <variant>
#include <vector>

namespace heel {
namespace {

struct Setting {
  bool is_of_camera;  // of camera_setup, else of follow
  const char* name;
  std::variant<double*, int*, std::size_t*, bool*> value;
  NumberRange range;
  const char* when;  // one changes it
};

// Of a member of the struct: when one changes it, and its range.
#define FOLLOW(path, when, ...) \
  { false, #path, &c.follow.path, __VA_ARGS__, when }
#define CAMERA(path, when, ...) \
  { true, #path, &c.camera_setup.path, __VA_ARGS__, when }

// What one changes in practice, and when. docs/parameters.py reads this list.
std::vector<Setting> settingsOf(RobotConfig& c) {
  // clang-format off
  return {
      // Your wheels
      FOLLOW(localization.motion.distance_noise,
             "The wheels slip, and the robot loses its place: raise it. More noise needs more "
             "particles.",
             kNotNegative),
      FOLLOW(localization.motion.turn_noise,
             "The wheels slip in turns: raise it.",
             kNotNegative),
      // Your camera
      FOLLOW(perception.stereo.disparities,
             "Near things have no depth, as with a long baseline or many pixels. The nearest "
             "depth is focal length times baseline over this; more takes more time. In code, "
             "set it in `learn.stereo` and in `CameraSetupParams::stereo` as well.",
             {16, 256}),
      CAMERA(ground.max_tilt_rad,
             "The camera looks down steeply, and the floor is not found: raise it.",
             {0.0, 1.5, true}),
      FOLLOW(perception.tracker.confirm_frames,
             "Frames come at less than 4 Hz: lower it, to 2 at the least.",
             {1, 100}),
      FOLLOW(perception.tracker.max_coast_s,
             "Tracks end too soon while somebody is hidden, or too late.",
             kPositive),
      FOLLOW(perception.tracker.max_gap_s,
             "Frames come with longer gaps than this: raise it.",
             kPositive),
      // Your building
      FOLLOW(perception.plan_view.max_range_m,
             "You follow in a large hall, with a camera that measures so far.",
             kPositive),
      CAMERA(ground.max_range_m,
             "The floor near the camera is hidden, and the camera measures further.",
             kPositive),
      FOLLOW(learn.acquisition.detector.height.max_m,
             "Your ceiling is lower than this.",
             kPositive),
      FOLLOW(paths.unknown_is_free,
             "Your map has gaps through which the robot must go.",
             {}),
      FOLLOW(obstacles.max_memory_s,
             "Many people walk about, and the robot avoids places that they have left: lower "
             "it.",
             kPositive),
      FOLLOW(localization.max_particles,
             "The robot is not found in a large building: raise it.",
             {10, 1e6}),
      FOLLOW(localization.lost_fit,
             "The robot says that it is lost where furniture hides the walls: lower it.",
             kShare),
      // Your people, and your taste
      FOLLOW(learn.acquisition.background_s,
             "The room can't be empty for so long (`heel learn --background`).",
             kPositive),
      FOLLOW(learn.acquisition.person_s,
             "The person can't stay for so long (`heel learn --person`).",
             kPositive),
      FOLLOW(learn.acquisition.detector.person.min_height_m,
             "You learn children, or people who sit: lower it. Furniture then begins to count, "
             "too.",
             kPositive),
      FOLLOW(perception.candidates.min_height_m,
             "You follow children, or people who sit: lower it.",
             kPositive),
      FOLLOW(perception.target.take_above,
             "Wrong people are followed: raise it. The right one is then found later.",
             kShare),
      FOLLOW(goal.standoff_m,
             "The robot comes too close, or stays too far away. `near_m` and `far_m` go with "
             "it.",
             kPositive),
      FOLLOW(near_m,
             "The robot should stop nearer to the person, or further away.",
             kPositive),
      FOLLOW(far_m,
             "The robot should drive on sooner, or later. It is more than `near_m`.",
             kPositive),
      FOLLOW(search.budget_s,
             "The robot should search longer for a lost person, or give up sooner.",
             kPositive),
  };
  // clang-format on
}

#undef FOLLOW
#undef CAMERA

void readValue(YamlMap& map, const Setting& setting, double& value) {
  value = map.number(setting.name, setting.range);
}

void readValue(YamlMap& map, const Setting& setting, bool& value) {
  value = map.flag(setting.name, value);
}

template <typename Whole>
void readValue(YamlMap& map, const Setting& setting, Whole& value) {
  value = static_cast<Whole>(map.integer(setting.name, static_cast<int>(value),
                                         static_cast<int>(setting.range.low),
                                         static_cast<int>(setting.range.high)));
}

std::string textOf(double value) { return shortestText(value); }
std::string textOf(bool value) { return value ? "true" : "false"; }
template <typename Whole>
std::string textOf(Whole value) {
  return std::to_string(value);
}

void readPart(YamlMap& top, const char* part, bool is_of_camera,
              const std::vector<Setting>& settings) {
  auto map = top.map(part, part);
  if (!map) return;
  for (const Setting& setting : settings) {
    if (setting.is_of_camera != is_of_camera || !map->has(setting.name)) continue;
    std::visit([&](auto* value) { readValue(*map, setting, *value); }, setting.value);
  }
  map->done();
}

void writePart(std::ostringstream& out, const char* part, bool is_of_camera,
               const std::vector<Setting>& settings) {
  out << part << ":\n";
  for (const Setting& setting : settings) {
    if (setting.is_of_camera != is_of_camera) continue;
    const std::string text = std::visit([](auto* value) { return textOf(*value); }, setting.value);
    out << "  # " << setting.when << "\n  " << setting.name << ": " << text << '\n';
  }
}

}  // namespace

RobotConfig loadRobotConfig(const std::string& file) {
  RobotConfig config;
  YamlMap top = YamlMap::fromFile(file, "robot's file");
  if (auto robot = top.map("robot", "robot")) {
    const bool tells_camera = robot->has("camera");
    config.tells_laser = robot->has("laser");
    config.robot = readRobotItself(*robot);
    const CameraParams& camera = config.robot.camera;
    // Else its place is a default, of which the floor that is seen knows more.
    if (tells_camera) {
      config.camera_setup.T_base_camera = mountedCamera(camera.at, camera.pitch_rad);
    }
  }
  const std::vector<Setting> settings = settingsOf(config);
  readPart(top, "camera_setup", true, settings);
  readPart(top, "follow", false, settings);
  top.done();
  const int disparities = config.follow.perception.stereo.disparities;
  config.follow.learn.stereo.disparities = disparities;
  config.camera_setup.stereo.disparities = disparities;
  try {
    fittedTo(describeRobot(config.robot), config.follow);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  return config;
}

std::string toYaml(const RobotConfig& config) {
  RobotConfig copy = config;
  const std::vector<Setting> settings = settingsOf(copy);
  std::ostringstream out;
  out << "# A robot, and how it follows: heel follow SCENE --config FILE, heel live --config "
         "FILE.\n"
         "# What is left out has its default. Base frame: X ahead, Y left, Z up, on the floor.\n"
         "# With 'floor_camera: {}' it has a depth camera that looks at the floor, and sees "
         "steps.\n"
         "robot:\n"
      << toYaml(config.robot, "  ") << "# Each with when one changes it.\n";
  writePart(out, "follow", false, settings);
  writePart(out, "camera_setup", true, settings);
  return out.str();
}

void putRobot(Scene& scene, const RobotParams& robot) {
  const RobotParams before = scene.robot;
  scene.robot = robot;
  scene.robot.start = before.start;
  scene.robot.start_yaw_rad = before.start_yaw_rad;
  scene.robot.camera.drawn_light = robot.camera.drawn_light || before.camera.drawn_light;
}

}  // namespace heel
