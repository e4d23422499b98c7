// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The network that a live robot is on.
#pragma once

#include <heel/apps/live/ros2_network.hpp>

#include <CLI/CLI.hpp>

namespace heel {

/// Adds --domain and --namespace.
inline void addNetwork(CLI::App& verb, Ros2NetworkParams& params) {
  params = ros2Environment();
  verb.add_option("--domain", params.domain, "of ROS 2 (default: ROS_DOMAIN_ID, else 0)")
      ->check(CLI::Range(0, 232));
  verb.add_option("--namespace", params.ros_namespace, "before all topics, as /robot1");
}

}  // namespace heel
