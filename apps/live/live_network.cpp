// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/live_network.hpp>
#include <heel/apps/live/ros1_network.hpp>
#include <heel/apps/live/ros2_network.hpp>

#include <chrono>
#include <cstdlib>
#include <stdexcept>

namespace heel {
namespace {

/// Empty if it is not set.
std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// "robot1" and "/robot1/" are "/robot1".
std::string namespaceOf(std::string name) {
  while (!name.empty() && name.back() == '/') name.pop_back();
  return name.empty() || name.front() == '/' ? name : "/" + name;
}

}  // namespace

double steadyClock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

LiveNetworkParams rosEnvironment() {
  LiveNetworkParams params;
  if (environment("ROS_VERSION") == "1") params.ros = BagForm::kRos1;
  if (const std::string domain = environment("ROS_DOMAIN_ID"); !domain.empty()) {
    char* end = nullptr;
    const long number = std::strtol(domain.c_str(), &end, 10);
    if (*end != '\0' || number < 0 || number > 232) {
      throw std::invalid_argument("ROS_DOMAIN_ID must be a number from 0 to 232");
    }
    params.domain = static_cast<int>(number);
  }
  params.localhost_only = environment("ROS_LOCALHOST_ONLY") == "1";
  return params;
}

std::unique_ptr<LiveNetwork> openNetwork(LiveNetworkParams params) {
  params.ros_namespace = namespaceOf(params.ros_namespace);
  if (params.ros == BagForm::kRos1) {
#ifdef HEEL_HAS_ROS1
    return std::make_unique<Ros1Network>(params);
#else
    throw std::runtime_error(
        "ROS 1: this build of Heel is without it; it needs libroscpp-dev and cmake "
        "-DHEEL_WITH_ROS1=ON");
#endif
  }
#ifdef HEEL_HAS_ROS2
  return std::make_unique<Ros2Network>(params);
#else
  throw std::runtime_error(
      "ROS 2: this build of Heel is without it; it needs Fast DDS 2 (libfastrtps-dev of Debian 12 "
      "and of Ubuntu; Debian 13 has Fast DDS 3) and cmake -DHEEL_WITH_ROS2=ON");
#endif
}

}  // namespace heel
