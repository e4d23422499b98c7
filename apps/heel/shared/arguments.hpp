// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What several verbs are called with: scenes, maps and plans, and the topics of a bag.
#pragma once

#include <heel/apps/camera/pair_camera.hpp>
#include <heel/apps/live/live_network.hpp>
#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/apps/recording/time_span.hpp>
#include <heel/apps/simulation/scene.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace heel {

/// The folder of the scenes that come with Heel.
std::filesystem::path sceneFolder();

/// A scene's file: the path itself, or the name of a scene that comes with Heel.
/// @throws std::runtime_error  if there is neither.
std::filesystem::path sceneFile(const std::string& scene);

/// The folder of the robots that come with Heel.
std::filesystem::path robotFolder();

/// A robot's file: the path itself, or the name of a robot that comes with Heel.
/// @throws std::runtime_error  if there is neither.
std::filesystem::path robotFile(const std::string& robot);

/// Adds --config: a robot's name or file.
void addRobotConfig(CLI::App& verb, std::string& robot);

/// Adds --light: 'fixed' or 'drawn'; empty is as the scene says.
void addLight(CLI::App& verb, std::string& light);

/// Gives the scene's camera that light.
void setLight(Scene& scene, const std::string& light);

/// Adds --rough: what is rough in the world; see roughWorldOf().
void addRough(CLI::App& verb, std::string& rough);

/// What a map is made of: a path, or the name of a scene that comes with Heel; see openMap().
/// @throws std::runtime_error  if it is a name, and there is no such scene.
std::filesystem::path mapSource(const std::string& map);

/// The folder of the plans that come with Heel.
std::filesystem::path planFolder();

/// A plan's PNML file: the path itself, or the name of a plan that comes with Heel.
/// @throws std::runtime_error  if there is neither.
std::filesystem::path planFile(const std::string& plan);

/// Names of what lies in one of these folders, sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

/// For CLI::Option::check(): what is wrong with it, or nothing.
std::string isPositive(const std::string& number);
std::string isNotNegative(const std::string& number);

/// Topics of images and clouds, and the base frame.
void addCameraTopics(CLI::App& verb, BagTopics& topics);

/// The part of a recording that is read.
void addTimeSpan(CLI::App& verb, TimeSpan& span);

/// The topic of laser scans.
void addScanTopic(CLI::App& verb, BagTopics& topics);

/// The topic of odometry.
void addOdometryTopic(CLI::App& verb, BagTopics& topics);

/// Topics of odometry and truth.
void addPoseTopics(CLI::App& verb, BagTopics& topics);

/// Topics of scans, odometry and truth, and the base frame.
void addLaserTopics(CLI::App& verb, BagTopics& topics);

/// The bag to write the results to.
void addResultBag(CLI::App& verb, std::filesystem::path& bag);

/// Adds `device`, the option or the argument that says which camera, and what is asked of it.
CLI::Option* addCamera(CLI::App& verb, const std::string& device, PairCameraParams& camera);

/// Adds --domain and --namespace.
inline void addNetwork(CLI::App& verb, LiveNetworkParams& params) {
  params = rosEnvironment();
  verb.add_option("--domain", params.domain, "of ROS 2 (default: ROS_DOMAIN_ID, else 0)")
      ->check(CLI::Range(0, 232));
  verb.add_option("--namespace", params.ros_namespace, "before all topics, as /robot1");
}

}  // namespace heel
