// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/live/live_camera.hpp>
#include <heel/apps/heel/live/live_reports.hpp>
#include <heel/apps/heel/live/live_tellers.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/follow_output.hpp>
#include <heel/apps/heel/shared/lap_clock.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/apps/live/command_sender.hpp>
#include <heel/apps/live/find_robot.hpp>
#include <heel/apps/live/live_commands.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/recording/bags/bag_map.hpp>
#include <heel/planning/plan_file.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

struct LiveOptions {
  PairCameraParams camera;  // alone, without a robot, if it has a device
  int port = LiveCameraOptions().port;
  LogMapOptions map;
  std::string map_topic;
  std::filesystem::path model;
  std::string plan = "search";
  std::string config;  // empty: a robot of the default size and speed
  BagTopics topics;
  LiveNetworkParams network;
  CommandSenderParams sender;
  bool dry = false;
  double wait_s = std::numeric_limits<double>::infinity();
  double limit_s = std::numeric_limits<double>::infinity();
  std::filesystem::path out;
};

bool isToldToStop(const LiveCommands& commands) {
  return isStopRequested() || commands.isStopped();
}

FoundRobot waitForRobot(LiveNetwork& network, const LiveCommands& commands,
                        const LiveOptions& options, const RobotConfig& config, bool knows_scanner) {
  const double began_s = steadyClock_s();
  std::string told;
  const auto goes_on = [&](const std::string& missing) {
    if (isToldToStop(commands)) throw Stopped("stopped before there was a robot");
    const std::string& below = options.network.ros_namespace;
    if (missing != told) {
      warn("waiting" + (below.empty() ? "" : " for names in '" + below + "'") + ": " + missing);
    }
    told = missing;
    return steadyClock_s() - began_s < options.wait_s;
  };
  return findRobot(network, options.topics, config.camera_setup, knows_scanner, goes_on);
}

/// The map that somebody sends.
OccupancyGrid waitForMap(LiveNetwork& network, const LiveCommands& commands,
                         const LiveOptions& options) {
  const std::string& topic = options.map_topic;
  const double began_s = steadyClock_s();
  network.subscribe({topic, OccupancyGridMsg::kType, {}}, Delivery::kLatched, 1);
  for (bool is_told = false;;) {
    if (const auto message = network.next(0.5); message && message->topic.name == topic) {
      try {
        if (!message->topic.holds<OccupancyGridMsg>()) throw std::runtime_error("is no map");
        OccupancyGridMsg map;
        readMessage(network.form(), message->bytes.data(), message->bytes.size(), map);
        network.unsubscribe(topic);
        return toGrid(map);
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(topic + ": " + error.what());
      }
    }
    if (isToldToStop(commands)) throw Stopped("stopped before there was a map");
    if (steadyClock_s() - began_s > options.wait_s) {
      throw std::runtime_error("nobody sends a map on " + topic);
    }
    if (!is_told) warn("waiting for a map on " + topic);
    is_told = true;
  }
}

RobotDescription describeFound(RobotDescription robot, const FoundRobot& found, const LogMap& map) {
  const ScannerPlace scanner = placeScanner(found.readings->laser(), map, found.camera);
  for (const std::string& warning : scanner.warnings) warn(warning);
  robot.camera = found.camera;
  robot.T_base_scanner = scanner.T_base_scanner;
  robot.scanner_height_m = scanner.height_m;
  return robot;
}

constexpr double kCameraPeriod_s = 0.03;  // Cameras give no more than 30 pictures a second.

/// Takes in what comes until it is time for the next step: a period after the last one, or, at a
/// camera's rate, as soon as there is a new frame.
void listen(LiveNetwork& network, LiveReadings& readings, double period_s, double last_step_s) {
  const double began_s = steadyClock_s();
  bool has_frame = false;
  for (double now_s = began_s; now_s < began_s + period_s; now_s = steadyClock_s()) {
    const double due_s = last_step_s + (has_frame ? std::min(kCameraPeriod_s, period_s) : period_s);
    const auto message = network.next(std::max(due_s - now_s, 0.0));
    if (message) {
      has_frame = readings.take(message->topic, message->stamp_ns, message->bytes, steadyClock_s());
    } else if (steadyClock_s() >= due_s) {
      return;
    }
  }
}

/// Where the odometry says that the robot is: without a map, places are in its frame.
FloorPose firstOdometry(LiveNetwork& network, const LiveCommands& commands,
                        LiveReadings& readings) {
  while (!isToldToStop(commands)) {
    listen(network, readings, 0.1, steadyClock_s());
    const std::optional<FloorPose> place = readings.read(steadyClock_s()).odometry;
    if (place && place->position.allFinite() && std::isfinite(place->yaw_rad)) return *place;
  }
  throw Stopped("stopped before there was odometry");
}

void run(const LiveOptions& options) {
  std::optional<AppearanceModel> model;
  if (!options.model.empty()) model = loadAppearance(options.model);
  RobotConfig config;
  std::vector<std::filesystem::path> inputs = {options.model};
  if (!options.map.map.empty()) inputs.push_back(mapSource(options.map.map));
  if (!options.config.empty()) {
    inputs.push_back(robotFile(options.config));
    config = loadRobotConfig(inputs.back().string());
  }
  if (config.robot.floor_camera && options.topics.floor.empty()) {
    warn("nothing is heard of the robot's floor_camera without --floor-topic: it sees no steps");
    config.robot.floor_camera.reset();
  } else if (!config.robot.floor_camera && !options.topics.floor.empty()) {
    throw std::runtime_error("--floor-topic needs a robot with a floor_camera (--config)");
  }
  FollowOutput output(options.out, false, {}, inputs);
  LiveCommands commands(openNetwork(options.network), tellCommand);
  const std::unique_ptr<LiveNetwork> network = openNetwork(options.network);
  LogMap map = openLogMap(options.map);
  if (!options.map_topic.empty()) {
    const OccupancyGrid grid = waitForMap(*network, commands, options);
    map.walls = std::make_shared<const WallMap>(extruded(grid));
  }
  const RobotDescription described = describeRobot(config.robot);
  if (config.tells_laser) {
    map.setScanner(described.T_base_scanner, described.scanner_height_m);
  }
  const FoundRobot found = waitForRobot(*network, commands, options, config,
                                        map.scanner.has_value() || map.default_scanner.has_value());
  for (const std::string& warning : found.camera.warnings) warn(warning);
  LiveReadings& readings = *found.readings;
  std::fprintf(stderr, "heel: the robot's camera: %s\n", readings.info().layout.c_str());
  const RobotDescription robot = describeFound(described, found, map);
  const PetriPlan plan = loadPlan(planFile(options.plan), followingVocabulary());
  const auto makeFollower = [&](const std::optional<FloorPose>& start) {
    auto made = std::make_unique<Follower>(robot, map.walls, plan, start, config.follow);
    if (model) made->skipLearning(*model);
    return made;
  };
  std::optional<FloorPose> place = map.start;
  if (!map.walls) place = firstOdometry(*network, commands, readings);
  std::unique_ptr<Follower> follower = makeFollower(place);

  FollowLog log;
  log.scene = "live";
  log.plan = options.plan;
  log.map = follower->floor();
  log.drive = robot.drive;
  log.is_live = true;
  log.outcome = "ended";
  LapClock clock;
  const Follower::StageDone stage_done = [&](FollowStage stage) {
    const double ms = clock.lap_ms();
    if (stage != FollowStage::kBegin) output.addTime(stage, ms);
  };
  LiveReports reports(*network, map.walls ? kMapFrame : readings.odometryFrame());
  output.showOn(reports.results());
  std::unique_ptr<CommandSender> sender;
  if (!options.dry) {
    CommandSenderParams params = options.sender;
    params.must_stand = [&commands] { return commands.mustStand(); };
    sender = std::make_unique<CommandSender>(network->writer(), params);
  }
  const auto late = [&sender] { return sender ? sender->stopped() : 0; };
  const double began_s = steadyClock_s();
  StateTeller teller;
  SilenceTeller silence;
  UnheardTeller unheard;
  StereoReading picture;
  double last_step_s = began_s;
  bool has_skipped = false;
  while (true) {
    listen(*network, readings, robot.drive.period_s, last_step_s);
    last_step_s = steadyClock_s();
    if (isToldToStop(commands)) {
      log.outcome = kStoppedRun;
      break;
    }
    const RobotReadings& now = readings.read(steadyClock_s());
    if (readings.hasBegunAnew()) {
      warn("the sensors' time has gone back: all begins anew");
      place = map.walls ? map.start : now.odometry ? now.odometry : place;
    }
    const bool forgets = commands.mustForget();
    if (forgets || readings.hasBegunAnew()) follower = makeFollower(place);
    silence.tell(now, network->trouble(), steadyClock_s());
    if (!has_skipped) {
      const std::vector<SkippedFrame> skipped = readings.skipped();
      has_skipped = !skipped.empty();
      if (has_skipped) warn(leftOutNote(skipped, ""));
    }
    const FollowStep* step = nullptr;
    follower->pause(commands.isPaused());
    try {
      step = &follower->step(now, stage_done);
    } catch (const NobodyLearned&) {
      log.outcome = kNobodyLearned;
      break;
    }
    place = step->robot.lost ? std::nullopt : std::optional(step->robot.pose);
    if (sender) {
      sender->set(step->velocity, now.stamp_s);
      unheard.tell(*sender, options.sender, steadyClock_s() - began_s);
    }
    if (forgets) commands.hasForgotten();
    const double now_s = steadyClock_s();
    if (now.frame != nullptr) log.latencies_s.push_back(readings.frameAge_s(now_s));
    teller.tell(step->state(), step->reason, now_s - began_s);
    reports.add(*step, *follower, {log.latencies_s, readings.framesLeftOut(), late()}, now_s);
    const FollowSample& sample = log.samples.emplace_back(sampleOf(*step, *follower));
    output.add(shownOf(now, picture), *step, *follower, sample);
    if (step->outcome != PlanOutcome::kRunning) {
      log.outcome = outcomeOf(step->outcome);
      break;
    }
    if (steadyClock_s() - began_s >= options.limit_s) break;
  }
  const std::size_t stopped = late();
  sender.reset();  // the robot stands before anything is written
  if (log.samples.empty()) throw NothingFound("nothing came from the robot");
  const FollowSummary summary = summarize(log);
  output.commit(log, summary);
  std::printf(
      "%s after %.1f s (and %.1f s of learning before): %.2f m; from picture to velocity %.0f ms "
      "in 95 of 100 of %zu, "
      "%zu pictures left out, %zu times no command in time%s\n",
      summary.outcome.c_str(), summary.elapsed_s, summary.learn_s, summary.distance_m,
      log.latencies_s.empty() ? 0.0 : 1e3 * summary.latency_p95_s, log.latencies_s.size(),
      readings.framesLeftOut(), stopped, leftOutNote(readings.skipped()).c_str());
  std::printf("results in %s: %s\n", output.folder().c_str(), output.fileNames().c_str());
  if (log.outcome == kStoppedRun) throw Stopped("stopped: the robot was told to stand");
  if (log.outcome == kNobodyLearned) throw NothingFound(kNobodyWasLearned);
}

/// Adds --camera and what goes with it.
void addCameraAlone(CLI::App& verb, LiveOptions& options) {
  const std::size_t before = verb.get_options().size();
  CLI::Option* camera = addCamera(verb, "--camera", options.camera);
  verb.add_option("--port", options.port, "of this machine, for the browser; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  const std::vector<CLI::Option*> all = verb.get_options();
  for (std::size_t i = before; i < all.size(); ++i) {
    all[i]->group("A camera alone");
    all[i]->needs(all[i] == camera ? verb.get_option("--model") : camera);
  }
}

}  // namespace

void addLive(CLI::App& app) {
  auto options = std::make_shared<LiveOptions>();
  CLI::App* verb = app.add_subcommand(
      "live", "Follow a person with a robot that runs ROS, or watch them with a camera");
  verb->footer(
      "Example (in two terminals; no robot and no ROS are needed):\n"
      "  heel simulate home --live\n"
      "  heel live --map home --robot-start 0.8,2.2,0 --out out/live\n"
      "Hears a camera (stereo, or colour and depth), a laser, odometry and tf; sends velocities\n"
      "to /cmd_vel, at least 20 a second, and zeros when anything is late, and when it ends. A\n"
      "program that is killed sends nothing: the robot's base must stop by itself then.\n"
      "Words on /heel/command (std_msgs/String) tell it to 'pause', to 'go' on, to 'forget' the\n"
      "person, or to 'stop'; /heel/target, /heel/markers, /heel/path and /diagnostics tell "
      "others.\n"
      "First let it run with --dry, and with the wheels off the floor.\n"
      "With a camera alone, a browser on this machine shows who is where:\n"
      "  heel live --camera 0 --calibration calibration --model person.yaml");
  verb->add_option("--map", options->map.map,
                   "a .bt, a map_server YAML, or a scene's name (default: none: the robot goes by "
                   "its odometry and what it sees, and does not search)");
  verb->add_option("--map-topic", options->map_topic,
                   "the map is what map_server sends there (/map)")
      ->excludes("--map");
  verb->add_option("--model", options->model,
                   "the person, as 'heel learn' wrote it (default: the robot learns them first)");
  verb->add_option("--plan", options->plan,
                   "what to do when the person is lost: 'paper', 'search', or a PNML file")
      ->capture_default_str();
  verb->add_option("--out", options->out,
                   "folder for the results of a robot's run; needed without --camera");
  verb->add_flag("--dry", options->dry, "send no velocities");
  verb->add_option("--wait", options->wait_s, "for the robot, so long [s] (default: for ever)")
      ->check(isPositive);
  verb->add_option("--limit", options->limit_s, "end after so long [s] (default: never)")
      ->check(isPositive);
  verb->add_option("--command-topic", options->sender.topic, "where velocities go")
      ->capture_default_str();
  verb->add_flag("--stamped", options->sender.stamped,
                 "send TwistStamped (frame base_link), as newer robots of Nav2 want it");
  addRobotConfig(*verb, options->config);
  addNetwork(*verb, options->network);
  verb->add_option_function<int>(
          "--ros",
          [options](int version) {
            options->network.ros = version == 1 ? BagForm::kRos1 : BagForm::kRos2;
          },
          "which ROS the robot runs (default: ROS_VERSION, else 2)")
      ->check(CLI::IsMember({1, 2}));
  addLogMap(*verb, options->map, options->topics);
  addCameraTopics(*verb, options->topics);
  addOdometryTopic(*verb, options->topics);
  verb->add_option("--floor-topic", options->topics.floor,
                   "depth images of the robot's floor_camera")
      ->type_name("TOPIC");
  const std::vector<CLI::Option*> of_robots = verb->get_options([](const CLI::Option* option) {
    const std::string name = option->get_name();
    return name != "--help" && name != "--model" && name != "--limit";
  });
  addCameraAlone(*verb, *options);
  verb->callback([options, of_robots] {
    if (options->camera.device.empty()) {
      if (options->out.empty()) throw CLI::RequiredError("--out");
      if (!options->map.start.empty() && options->map.map.empty() && options->map_topic.empty()) {
        throw CLI::RequiresError("--robot-start", "--map or --map-topic");
      }
      return run(*options);
    }
    for (const CLI::Option* option : of_robots) {
      if (option->count() > 0) throw CLI::ExcludesError("--camera", option->get_name());
    }
    watchCamera({options->camera, options->model, options->port, options->limit_s});
  });
}

}  // namespace heel
