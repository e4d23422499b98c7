// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>

namespace heel {

void addConfig(CLI::App& app) {
  auto robot = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("config", "Print a robot's file, with all that it can say");
  verb->footer(
      "Example:\n"
      "  heel config > robot.yaml\n"
      "  heel follow home --config robot.yaml\n"
      "It says where the sensors are, how fast the robot is, and what one sets of how it follows.");
  verb->add_option("ROBOT", *robot,
                   "a robot's name (turtlebot4, tiago, ...) or its file, whose gaps are filled "
                   "(default: the defaults)");
  verb->callback([robot] {
    const RobotConfig config =
        robot->empty() ? RobotConfig{} : loadRobotConfig(robotFile(*robot).string());
    std::fputs(toYaml(config).c_str(), stdout);
  });
}

}  // namespace heel
