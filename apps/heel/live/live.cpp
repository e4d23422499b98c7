// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/follow_output.hpp>
#include <heel/apps/heel/shared/lap_clock.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/apps/live/command_sender.hpp>
#include <heel/apps/live/find_robot.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/planning/plan_file.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
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
  LogMapOptions map;
  std::filesystem::path model;
  std::string plan = "search";
  std::string config;  // empty: a robot of the default size and speed
  BagTopics topics;
  LiveNetworkParams network;
  std::string command_topic = "/cmd_vel";
  bool dry = false;
  double wait_s = std::numeric_limits<double>::infinity();
  double limit_s = std::numeric_limits<double>::infinity();
  std::filesystem::path out;
};

FoundRobot waitForRobot(LiveNetwork& network, const LiveOptions& options,
                        const RobotConfig& config) {
  const double began_s = steadyClock_s();
  std::string told;
  return findRobot(network, options.topics, config.camera_setup, [&](const std::string& missing) {
    if (isStopRequested()) throw Stopped("stopped before there was a robot");
    if (missing != told) warn("waiting: " + missing);
    told = missing;
    return steadyClock_s() - began_s < options.wait_s;
  });
}

Follower makeFollower(const LiveOptions& options, const FoundRobot& found,
                      const RobotConfig& config) {
  LogMap map = openLogMap(options.map);
  const LaserLog& laser = found.readings->laser();
  RobotDescription robot = describeRobot(config.robot);
  if (!options.config.empty()) map.setScanner(robot.T_base_scanner, robot.scanner_height_m);
  robot.camera = found.camera;
  robot.T_base_scanner =
      map.scanner ? *map.scanner : laser.T_base_scanner().value_or(map.default_scanner);
  robot.scanner_height_m = laser.scannerHeight_m().value_or(map.scanner_height_m);
  const PetriPlan plan = loadPlan(planFile(options.plan), followingVocabulary());
  return Follower(robot, map.walls, plan, map.start, config.follow);
}

/// What a run tells on the terminal: each state when it begins, and why.
class StateTeller {
 public:
  void tell(const FollowStep& step, double since_s) {
    const std::string state = step.state();
    if (state == last_) return;
    last_ = state;
    std::fprintf(stderr, "heel: %7.1f s: %s%s%s\n", since_s, state.c_str(),
                 step.reason.empty() ? "" : ", ", step.reason.c_str());
  }

 private:
  std::string last_;
};

/// Tells when a sensor, or all of the network, has been silent for too long, and when it is heard
/// again.
class SilenceTeller {
 public:
  /// @param trouble  The network's.
  void tell(const RobotReadings& now, const std::string& trouble, double clock_s) {
    if (trouble != trouble_) {
      if (trouble.empty()) std::fprintf(stderr, "heel: the network answers again\n");
      if (!trouble.empty()) warn(trouble + ": the robot is told to stand");
      trouble_ = trouble;
    }
    camera_.tell("picture", now.frame != nullptr, clock_s);
    laser_.tell("laser scan", now.scan != nullptr, clock_s);
    wheels_.tell("odometry", now.odometry.has_value(), clock_s);
  }

 private:
  struct Sensor {
    void tell(const char* what, bool has_come, double clock_s) {
      constexpr double kSilent_s = 1.0;
      if (has_come || heard_s == 0.0) {
        if (is_silent) std::fprintf(stderr, "heel: a %s has come again\n", what);
        is_silent = false;
        heard_s = clock_s;
      } else if (!is_silent && clock_s - heard_s > kSilent_s) {
        is_silent = true;
        warn(std::string("no ") + what + " has come for a second: the robot is told to stand");
      }
    }
    double heard_s = 0.0;
    bool is_silent = false;
  };
  Sensor camera_, laser_, wheels_;
  std::string trouble_;
};

double share95(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 95 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Takes in what comes until it is time for the next command: after a period, or, not much before
/// that, as soon as there is a new frame.
void listen(LiveNetwork& network, LiveReadings& readings, double period_s) {
  constexpr double kLeastShare = 0.7;
  const double began_s = steadyClock_s();
  bool has_frame = false;
  for (double past_s = 0.0; past_s < period_s; past_s = steadyClock_s() - began_s) {
    if (has_frame && past_s > kLeastShare * period_s) return;
    const double until_s = (has_frame ? kLeastShare : 1.0) * period_s;
    if (const auto message = network.next(std::max(until_s - past_s, 0.0))) {
      has_frame = readings.take(message->topic, message->stamp_ns, message->bytes, steadyClock_s());
    }
  }
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
  FollowOutput output(options.out, false, {}, inputs);
  const std::unique_ptr<LiveNetwork> network = openNetwork(options.network);
  const FoundRobot found = waitForRobot(*network, options, config);
  for (const std::string& warning : found.camera.warnings) warn(warning);
  LiveReadings& readings = *found.readings;
  std::fprintf(stderr, "heel: the robot's camera: %s\n", readings.info().layout.c_str());
  Follower follower = makeFollower(options, found, config);
  if (model) follower.skipLearning(*model);

  FollowLog log;
  log.scene = "live";
  log.plan = options.plan;
  log.map = follower.floor();
  log.robot_radius_m = follower.robot().drive.radius_m;
  log.max_speed_mps = follower.robot().drive.max_speed_mps;
  log.is_live = true;
  log.outcome = "ended";
  LapClock clock;
  const Follower::StageDone stage_done = [&](FollowStage stage) {
    const double ms = clock.lap_ms();
    if (stage != FollowStage::kBegin) output.addTime(stage, ms);
  };
  std::unique_ptr<CommandSender> sender;
  if (!options.dry) {
    CommandSenderParams params;
    params.topic = options.command_topic;
    sender = std::make_unique<CommandSender>(network->writer(), params);
  }
  const double period_s = follower.robot().drive.period_s;
  const double began_s = steadyClock_s();
  StateTeller teller;
  SilenceTeller silence;
  StereoReading picture;
  std::vector<double> latencies_s;
  while (true) {
    listen(*network, readings, period_s);
    if (isStopRequested()) {
      log.outcome = kStoppedRun;
      break;
    }
    const RobotReadings& now = readings.read(steadyClock_s());
    silence.tell(now, network->trouble(), steadyClock_s());
    const FollowStep* step = nullptr;
    try {
      step = &follower.step(now, stage_done);
    } catch (const NobodyLearned&) {
      log.outcome = "nobody learned";
      break;
    }
    if (sender) sender->set(step->velocity);
    if (now.frame != nullptr) latencies_s.push_back(readings.frameAge_s(steadyClock_s()));
    teller.tell(*step, steadyClock_s() - began_s);
    const FollowSample& sample = log.samples.emplace_back(sampleOf(*step, follower));
    output.add(shownOf(now, picture), *step, follower, sample);
    if (step->outcome != PlanOutcome::kRunning) {
      log.outcome = outcomeOf(step->outcome);
      break;
    }
    if (steadyClock_s() - began_s >= options.limit_s) break;
  }
  const std::size_t stopped = sender ? sender->stopped() : 0;
  sender.reset();  // the robot stands before anything is written
  if (log.samples.empty()) throw NothingFound("nothing came from the robot");
  const FollowSummary summary = summarize(log);
  output.commit(log, summary);
  std::printf(
      "%s after %.1f s: %.2f m; from picture to velocity %.0f ms in 95 of 100, "
      "%zu pictures left out, %zu times no command in time\n",
      summary.outcome.c_str(), summary.elapsed_s, summary.distance_m, 1e3 * share95(latencies_s),
      readings.framesLeftOut(), stopped);
  std::printf("results in %s: %s\n", output.folder().c_str(), output.fileNames().c_str());
  if (log.outcome == kStoppedRun) throw Stopped("stopped: the robot was told to stand");
  if (log.outcome == "nobody learned") throw NothingFound("nobody was learned");
}

}  // namespace

void addLive(CLI::App& app) {
  auto options = std::make_shared<LiveOptions>();
  CLI::App* verb = app.add_subcommand("live", "Follow a person with a robot that runs ROS");
  verb->footer(
      "Example (in two terminals; no robot and no ROS are needed):\n"
      "  heel simulate home --live\n"
      "  heel live --map home --robot-start 0.8,2.2,0 --out out/live\n"
      "Hears a camera (stereo, or colour and depth), a laser, odometry and tf; sends velocities\n"
      "to /cmd_vel, 20 a second, and zeros when anything is late, and when it ends. A program "
      "that\n"
      "is killed sends nothing: the robot's base must stop by itself then.\n"
      "First let it run with --dry, and with the wheels off the floor.");
  verb->add_option("--map", options->map.map,
                   "a .bt, a map_server YAML, or a scene's name (default: none: the robot goes by "
                   "its odometry and what it sees, and does not search)");
  verb->add_option("--model", options->model,
                   "the person, as 'heel learn' wrote it (default: the robot learns them first)");
  verb->add_option("--plan", options->plan,
                   "what to do when the person is lost: 'paper', 'search', or a PNML file")
      ->capture_default_str();
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->add_flag("--dry", options->dry, "send no velocities");
  verb->add_option("--wait", options->wait_s, "for the robot, so long [s] (default: for ever)")
      ->check(isPositive);
  verb->add_option("--limit", options->limit_s, "end after so long [s] (default: never)")
      ->check(isPositive);
  verb->add_option("--command-topic", options->command_topic, "where velocities go")
      ->capture_default_str();
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
  verb->callback([options] { run(*options); });
}

}  // namespace heel
