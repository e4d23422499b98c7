// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/rough_world.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/cloud/typos.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

fs::path find(const std::string& name, const fs::path& folder, const std::string& extension,
              const std::string& what) {
  if (fs::is_regular_file(name)) return name;  // a folder of this name is none
  const fs::path shipped = folder / (name + extension);
  if (fs::exists(shipped)) return shipped;
  const std::string meant = didYouMean(name, namesIn(folder));
  throw std::runtime_error(
      name + ": there is no such " + what + ", neither as a file nor in " + folder.string() +
      (meant.empty() ? "; there are " + CLI::detail::join(namesIn(folder), ", ") : meant));
}

/// What comes with Heel lies at the same place seen from the command, wherever that is.
fs::path shippedFolder(const std::string& name) {
  const fs::path command = fs::read_symlink("/proc/self/exe");
  return fs::weakly_canonical(command.parent_path() / HEEL_DATA_FOLDER / name);
}

}  // namespace

fs::path sceneFolder() { return shippedFolder("scenes"); }

fs::path sceneFile(const std::string& scene) {
  return find(scene, sceneFolder(), ".yaml", "scene");
}

fs::path robotFolder() { return shippedFolder("robots"); }

fs::path robotFile(const std::string& robot) {
  return find(robot, robotFolder(), ".yaml", "robot");
}

void addRobotConfig(CLI::App& verb, std::string& robot) {
  verb.add_option(
      "--config", robot,
      "the robot and how it follows: a name (turtlebot4, tiago, ...) or a YAML file, "
      "as 'heel config' prints one (default: the scene's robot; of a log or on the network, what "
      "'heel config' prints)");
}

void addLight(CLI::App& verb, std::string& light) {
  verb.add_option("--light", light,
                  "exposure, white balance, gamma, motion blur and flicker: 'fixed', or 'drawn' "
                  "from the seed (default: as the scene says)")
      ->check(CLI::IsMember({"fixed", "drawn"}));
}

void addRough(CLI::App& verb, std::string& rough) {
  verb.add_option("--rough", rough,
                  "what is rough in the world, with commas: " + roughSwitches() +
                      ", or all; drawn from the seed (default: nothing)");
}

void setLight(Scene& scene, const std::string& light) {
  if (!light.empty()) scene.robot.camera.drawn_light = light == "drawn";
}

fs::path mapSource(const std::string& map) {
  const fs::path walls = fs::path(map) / "walls.bt";  // in the folder that 'heel map' wrote
  if (fs::exists(walls)) return walls;
  const bool is_path = fs::path(map).has_extension() || fs::path(map).has_parent_path();
  const bool is_scene = fs::exists(sceneFolder() / (map + ".yaml"));
  return is_path || fs::is_regular_file(map) || (fs::is_directory(map) && !is_scene)
             ? fs::path(map)
             : sceneFile(map);
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string isPositive(const std::string& number) {
  double value = 0.0;
  const bool is_good = CLI::detail::lexical_cast(number, value) && value > 0.0;
  return is_good ? "" : "'" + number + "' is not a number above 0";
}

std::string isNotNegative(const std::string& number) {
  double value = 0.0;
  const bool is_good = CLI::detail::lexical_cast(number, value) && value >= 0.0;
  return is_good ? "" : "'" + number + "' is not a number of 0 or more";
}

fs::path planFolder() { return shippedFolder("plans"); }

fs::path planFile(const std::string& plan) { return find(plan, planFolder(), ".pnml", "plan"); }

namespace {

constexpr const char* kGroup = "Topics (found by type and name if not given)";

void add(CLI::App& verb, const char* option, std::string& topic, const char* what) {
  verb.add_option(option, topic, what)->group(kGroup)->type_name("TOPIC");
}

void addBaseFrame(CLI::App& verb, BagTopics& topics) {
  verb.add_option("--base-frame", topics.base_frame,
                  "the robot's frame in tf; else base_footprint or base_link")
      ->group(kGroup)
      ->type_name("FRAME");
}

}  // namespace

void addCameraTopics(CLI::App& verb, BagTopics& topics) {
  add(verb, "--left-topic", topics.left, "stereo: the left images");
  add(verb, "--right-topic", topics.right, "stereo: the right images");
  add(verb, "--color-topic", topics.color, "RGB-D: the colour images");
  add(verb, "--depth-topic", topics.depth, "RGB-D: the depth images");
  add(verb, "--cloud-topic", topics.cloud, "coloured clouds");
  addBaseFrame(verb, topics);
}

void addTimeSpan(CLI::App& verb, TimeSpan& span) {
  verb.add_option("--from", span.from_s, "read from here on, after the recording's beginning [s]")
      ->check(isNotNegative)
      ->type_name("S");
  verb.add_option("--to", span.to_s, "read up to here [s]")->check(isPositive)->type_name("S");
}

void addOdometryTopic(CLI::App& verb, BagTopics& topics) {
  add(verb, "--odometry-topic", topics.odometry, "odometry");
}

void addScanTopic(CLI::App& verb, BagTopics& topics) {
  add(verb, "--scan-topic", topics.scan, "laser scans");
}

void addPoseTopics(CLI::App& verb, BagTopics& topics) {
  addOdometryTopic(verb, topics);
  add(verb, "--truth-topic", topics.truth, "odometry that tells the truth");
}

void addLaserTopics(CLI::App& verb, BagTopics& topics) {
  addScanTopic(verb, topics);
  addPoseTopics(verb, topics);
  addBaseFrame(verb, topics);
}

void addResultBag(CLI::App& verb, std::filesystem::path& bag) {
  verb.add_option("--bag", bag,
                  "also write a bag of the results, for RViz and the like: NAME.bag for ROS 1; "
                  "NAME.mcap, NAME.db3, or a folder, for ROS 2");
}

CLI::Option* addCamera(CLI::App& verb, const std::string& device, PairCameraParams& camera) {
  CLI::Option* option = verb.add_option(
      device, camera.device,
      "a stereo camera's number (0 is /dev/video0), its file, or a video; 'openni' or "
      "'openni:URI', a depth camera, or its recording, an .oni file");
  verb.add_option(
      "--calibration", camera.calibration,
      "file or folder that 'heel' reads as a stereo calibration, or a depth camera's camera.yaml "
      "(default: by its field of view)");
  verb.add_option("--width", camera.width,
                  "of a stereo camera's images together, where the camera can choose [px]")
      ->check(CLI::Range(2, 65536));
  verb.add_option("--height", camera.height, "of them, where the camera can choose [px]")
      ->check(CLI::Range(1, 65536));
  verb.add_option("--rate", camera.rate_hz, "pictures a second, where the camera can choose")
      ->check(CLI::Range(0.1, 1000.0));
  return option;
}

}  // namespace heel
