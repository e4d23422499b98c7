// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/roaming_driver.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/live/live_simulation.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/recording/stamps.hpp>
#include <heel/apps/simulation/path_driver.hpp>
#include <heel/apps/simulation/simulate.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

struct LiveArguments {
  std::string ros;  // "ros1" or "ros2"; empty: it is not live
  LiveNetworkParams network;
  LiveSimulationParams run;
};

void runLive(const Scene& scene, const LiveArguments& options) {
  keepResultsOnSignals();
  const std::unique_ptr<LiveNetwork> network = openNetwork(options.network);
  LiveSimulationParams params = options.run;
  ProgressBar progress("simulating", static_cast<std::size_t>(params.duration_s));
  params.progress = [&](const WorldTruth&, double stamp_s) {
    progress.show(static_cast<std::size_t>(stamp_s));
  };
  const LiveSimulationResult result = runLiveSimulation(scene, params, *network);
  std::printf(
      "%.1f s: the robot drove %.2f m by %zu commands and is %.2f m from the person, who "
      "%s\n  contacts by the robot %d, by people %d; %.1f s a simulated second at the "
      "slowest\n",
      result.duration_s, result.way_m, result.commands, result.person_distance_m,
      result.everyone_is_done ? "has gone all of their way" : "is still on their way",
      result.contacts_by_robot, result.contacts - result.contacts_by_robot, result.slowest);
}

struct SimulateArguments {
  std::string scene;
  std::string light;  // empty: the scene's
  std::string drive;  // empty: the robot stands still
  SimulateOptions simulate;
  LiveArguments live;
};

std::function<VelocityCommand(const WorldTruth&)> driverOf(const Scene& scene,
                                                           const SimulateArguments& options) {
  if (options.drive.empty()) return {};
  if (options.drive == "roam") {
    auto driver = std::make_shared<RoamingDriver>(scene, options.simulate.seed);
    return [driver](const WorldTruth& truth) { return driver->drive(truth); };
  }
  FloorPath path;
  for (const auto& row : readRows(options.drive, 2, "x_m,y_m")) path.emplace_back(row[0], row[1]);
  auto driver = std::make_shared<PathDriver>(std::move(path));
  return [driver](const WorldTruth& truth) { return driver->drive(truth); };
}

void run(SimulateArguments& options) {
  Scene scene = loadScene(sceneFile(options.scene).string());
  setLight(scene, options.light);
  if (!options.live.ros.empty()) {
    options.live.network.ros = options.live.ros == "ros1" ? BagForm::kRos1 : BagForm::kRos2;
    options.live.run.seed = options.simulate.seed;
    if (options.simulate.duration_s) options.live.run.duration_s = *options.simulate.duration_s;
    return runLive(scene, options.live);
  }
  if (options.simulate.out.empty()) throw std::invalid_argument("--out is required");
  options.simulate.drive = driverOf(scene, options);
  ProgressBar progress("simulating", 100);
  options.simulate.progress = [&](double share) {
    progress.show(static_cast<std::size_t>(100.0 * share));
  };
  const SimulateResult result = simulate(scene, options.simulate);
  if (result.frames == 0 && !result.complete) throw Stopped("stopped before the first frame");
  std::string written = options.simulate.out.string();
  if (!options.simulate.bag.empty()) written += ", " + options.simulate.bag.string();
  std::printf("%zu frames over %.1f s; wrote %s\n", result.frames, result.duration_s,
              written.c_str());
  if (!result.complete) {
    throw Stopped("stopped: " + options.simulate.out.string() + " holds what was done until then");
  }
}

}  // namespace

void addSimulate(CLI::App& app) {
  auto options = std::make_shared<SimulateArguments>();
  CLI::App* verb = app.add_subcommand("simulate", "Make a recording of a scene, with its truth");
  verb->footer(
      "Example:\n"
      "  heel simulate wardrobe --out recordings/wardrobe\n"
      "  heel learn recordings/wardrobe --out person.yaml\n"
      "  heel simulate home --out recordings/home --bag home.bag --drive roam\n"
      "Writes what 'heel learn' and 'heel track' read, and truth.csv: where everyone really was.\n"
      "A robot that drives has odometry (odometry.csv; /odom and /tf of the bag), truth.csv is in\n"
      "the frame of its start, truth_map.csv in that of the scene's map ('heel map'), and "
      "robot.csv\n"
      "tells where it really was.");
  verb->add_option(
          "SCENE", options->scene,
          "a scene's name (wardrobe, pair, home, office, corridor, crowd, poster) or its YAML file")
      ->required();
  CLI::Option* out = verb->add_option("--out", options->simulate.out, "folder for the recording");
  addNetwork(*verb, options->live.network);
  CLI::Option* live = verb->add_option(
      "--live", options->live.ros,
      "write nothing: be a robot on the network of ROS, in real time, that /cmd_vel drives");
  live->expected(0, 1)
      ->default_str(options->live.network.ros == BagForm::kRos1 ? "ros1" : "ros2")
      ->check(CLI::IsMember({"ros1", "ros2"}))
      ->excludes(out);
  verb->add_option("--speed", options->live.run.speed, "simulated seconds a second")
      ->needs(live)
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  verb->add_option(
      "--bag", options->simulate.bag,
      "also write a bag: NAME.bag for ROS 1; NAME.mcap, NAME.db3, or a folder, for ROS 2");
  verb->add_option("--duration", options->simulate.duration_s,
                   "instead of the scene's own, or of 600 with --live [s]")
      ->check(CLI::Range(0.01, 1e6));
  verb->add_option("--seed", options->simulate.seed, "of noise and of people's ways")
      ->capture_default_str();
  verb->add_option("--drive", options->drive,
                   "let the robot drive, where it would stand: 'roam', or a file with the places "
                   "to pass, 'x_m,y_m' a line, in the scene's frame")
      ->option_text("roam|PATH");
  addLight(*verb, options->light);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
