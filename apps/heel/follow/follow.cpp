// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/random_home.hpp>
#include <heel/apps/experiment/robot_config.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/follow/shadow.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/follow_output.hpp>
#include <heel/apps/heel/shared/lap_clock.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/planning/plan_file.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

struct FollowOptions {
  std::string scene = "home";
  std::string plan = "search";
  std::filesystem::path out;
  std::filesystem::path bag;
  ClosedLoopParams loop;
  std::string image_size;  // empty: the scene's
  std::string light;       // the same
  std::string rough;       // empty: nothing
  std::string config;      // empty: the scene's robot, and the defaults
  double rate_hz = 0.0;    // 0: the scene's camera's, and ten commands a second
  bool random = false;
  RandomEpisodeParams episode;
  bool alone = false;
  bool no_film = false;
  bool is_log = false;
  bool has_limit = false;       // given; else a log ends with its last frame
  std::filesystem::path model;  // of the person in a log
  LogMapOptions map;
  RecordingParams opening;
};

Scene sceneOf(const FollowOptions& options, const std::optional<RobotConfig>& config) {
  Scene scene = options.random ? randomEpisode(options.loop.seed, sceneFolder(), options.episode)
                               : loadScene(sceneFile(options.scene).string());
  if (options.alone && !scene.people.empty()) scene.people.resize(1);
  if (config) putRobot(scene, config->robot);
  setLight(scene, options.light);
  CameraParams& camera = scene.robot.camera;
  char end = '\0';
  if (!options.image_size.empty() && (std::sscanf(options.image_size.c_str(), "%dx%d%c",
                                                  &camera.width, &camera.height, &end) != 2 ||
                                      std::min(camera.width, camera.height) < 64 ||
                                      std::max(camera.width, camera.height) > 4096)) {
    throw std::invalid_argument("--image-size must be WIDTHxHEIGHT, from 64 to 4096 pixels each");
  }
  if (options.rate_hz > 0.0) camera.rate_hz = 1.0 / options.loop.period_s;
  return scene;
}

std::string commandOf(const FollowOptions& options) {
  const FollowOptions shortest;
  std::ostringstream command;
  if (options.is_log) {
    command << "heel follow " << options.scene;
    if (!options.map.map.empty()) command << " --map " << options.map.map;
    if (!options.model.empty()) command << " --model " << options.model.string();
    if (!options.config.empty()) command << " --config " << options.config;
    command << " --plan " << options.plan << " --out again";
    return command.str();
  }
  command << "heel follow " << (options.random ? "--random" : options.scene);
  if (options.episode.visits != shortest.episode.visits) {
    command << " --visits " << options.episode.visits;
  }
  if (options.alone) command << " --alone";
  if (!options.image_size.empty()) command << " --image-size " << options.image_size;
  if (!options.light.empty()) command << " --light " << options.light;
  if (!options.rough.empty()) command << " --rough " << options.rough;
  if (!options.loop.has_map) command << " --no-map";
  if (!options.config.empty()) command << " --config " << options.config;
  if (options.rate_hz > 0.0) command << " --rate " << options.rate_hz;
  command << " --plan " << options.plan << " --seed " << options.loop.seed;
  if (options.loop.limit_s != shortest.loop.limit_s) {
    command << " --limit " << options.loop.limit_s;
  }
  command << " --out again";
  return command.str();
}

void print(const FollowSummary& summary, bool is_log, const FollowOutput& output) {
  std::printf("%s after %.1f s", summary.outcome.c_str(), summary.elapsed_s);
  if (summary.learn_s > 0.0) std::printf(" (and %.1f s of learning before)", summary.learn_s);
  std::printf(": %.2f m", summary.distance_m);
  if (std::isfinite(summary.driving_speed_mps)) {
    std::printf(", %.2f m/s while driving; looked for the person for %.1f s",
                summary.driving_speed_mps, summary.seek_s);
  }
  std::printf("\n");
  if (is_log) {
    if (std::isfinite(summary.command_off_mps)) {
      std::printf("  would have driven otherwise by %.2f m/s and %.2f rad/s (RMS)\n",
                  summary.command_off_mps, summary.command_off_radps);
    }
    std::printf("results in %s: %s\n", output.folder().c_str(), output.fileNames().c_str());
    return;
  }
  std::printf("  contacts by the robot %d, by people %d, wrong person %.1f s",
              summary.contacts_by_robot, summary.contactsByPeople(), summary.wrong_person_s);
  if (std::isfinite(summary.min_clearance_m)) {
    std::printf(", least clearance %.2f m", summary.min_clearance_m);
  }
  std::printf("\n");
  std::printf("results in %s: %s\n", output.folder().c_str(), output.fileNames().c_str());
}

ShadowParams shadowOf(const FollowOptions& options, const std::optional<RobotConfig>& config) {
  ShadowParams params;
  params.recording = options.scene;
  params.opening = options.opening;
  params.map = openLogMap(options.map);
  if (config) {
    params.config = *config;
    if (config->tells_laser) {
      const RobotDescription robot = describeRobot(config->robot);
      params.map.setScanner(robot.T_base_scanner, robot.scanner_height_m);
    }
  }
  if (!options.model.empty()) params.model = loadAppearance(options.model);
  if (options.has_limit) params.limit_s = options.loop.limit_s;
  return params;
}

void run(FollowOptions& options) {
  if (!(options.loop.limit_s > 0.0 && std::isfinite(options.loop.limit_s))) {
    throw std::invalid_argument("--limit must be positive");
  }
  const bool is_scene = std::filesystem::exists(sceneFolder() / (options.scene + ".yaml"));
  const bool is_log = options.is_log =
      !options.map.map.empty() ||
      (!is_scene && (isBag(options.scene) || std::filesystem::is_directory(options.scene)));
  if (!is_log && !options.model.empty()) {
    throw std::invalid_argument("--model is for logs: a simulated person is learned first");
  }
  if (is_log && (options.random || !options.rough.empty())) {
    throw std::invalid_argument(options.scene + ": a log is as it is (--random, --rough)");
  }
  if (options.rate_hz > 0.0) {  // The simulator's clock ticks in hundredths of a second.
    options.loop.period_s = std::max(1.0, std::round(100.0 / options.rate_hz)) / 100.0;
  }
  options.loop.rough = roughWorldOf(options.rough);
  std::optional<RobotConfig> config;
  if (!options.config.empty()) config = loadRobotConfig(robotFile(options.config).string());
  if (config) options.loop.follower = config->follow;
  const Scene scene = is_log ? Scene() : sceneOf(options, config);
  const std::filesystem::path plan_file = planFile(options.plan);
  const PetriPlan plan = loadPlan(plan_file, followingVocabulary());
  std::vector<std::filesystem::path> inputs = {plan_file};
  if (is_log) {
    inputs.insert(inputs.end(), {options.scene, options.model});
    if (!options.map.map.empty()) inputs.push_back(mapSource(options.map.map));
  } else if (!options.random) {
    inputs.push_back(sceneFile(options.scene));
  }
  if (config) inputs.push_back(robotFile(options.config));
  FollowOutput output(options.out, !options.no_film, options.bag, inputs);
  // Of a log, runShadow() tells.
  ProgressBar progress("following", is_log ? 0 : static_cast<std::size_t>(options.loop.limit_s));
  LapClock clock;
  const LoopObserver observer = [&](const Readings& readings, const FollowStep& step,
                                    const Follower& follower, const FollowSample& sample) {
    output.add(readings, step, follower, sample);
    if (is_log) return;  // its clock may count from anywhere
    progress.show(static_cast<std::size_t>(readings.stamp_s));
  };
  const Follower::StageDone stage_done = [&](FollowStage stage) {
    // The time since the last stage; before the first stage the world moved, not the robot.
    const double ms = clock.lap_ms();
    if (stage != FollowStage::kBegin) output.addTime(stage, ms);
  };
  FollowLog log = is_log ? runShadow(shadowOf(options, config), plan, observer, stage_done)
                         : runClosedLoop(scene, plan, options.loop, observer, stage_done);
  log.command = commandOf(options);
  const FollowSummary summary = summarize(log);
  output.commit(log, summary);
  print(summary, is_log, output);
  if (log.outcome == kStoppedRun) throw Stopped("stopped: the results are those of the run so far");
  if (log.outcome == kNobodyLearned) {
    throw NothingFound(is_log ? kNobodyWasLearned : "nobody was learned");
  }
}

}  // namespace

void addFollow(CLI::App& app) {
  auto options = std::make_shared<FollowOptions>();
  CLI::App* verb =
      app.add_subcommand("follow", "Let a simulated robot learn a person and follow them");
  verb->footer(
      "Example:\n"
      "  heel follow home --out out/home\n"
      "  heel follow robot.bag --map map.yaml --model person.yaml --out out/shadow\n"
      "On a log it moves nothing: it writes what it would have done beside what the robot did.\n"
      "Writes report.html (open it in a browser), the film follow.mp4, summary.json, follow.csv\n"
      "(one row a step, with the truth) and timing.csv.\n"
      "--rough people: they do not see the robot, bump into it, and do not wait for it.\n"
      "--rough hurry: others walk up to 1.6 times as fast, and anybody stops now and then.\n"
      "--rough company: half of the others walk with somebody beside them, some with a child.\n"
      "--rough skirts: half of all wear a long skirt, in which no laser sees legs.\n"
      "--rough drawers: cupboards and desks have open drawers, which only the camera sees.\n"
      "--rough doors: some stand open into a room, some are shut; no map shows them.\n"
      "--rough steps: up to three steps down where nobody walks; no map shows them.\n"
      "--rough black, --rough glass: a fifth of the furniture, in which no laser sees anything.\n"
      "--rough dropouts: pictures and scans are missing for up to 2 s, about every 15 s.\n"
      "--rough latency: pictures, scans, odometry and wheels are late, by up to 0.25 s.\n"
      "--rough map: furniture is up to 0.1 m off in the robot's map, and a piece is missing.\n"
      "--rough laser: it sees 220 degrees ahead. --rough light: the camera's light is drawn.\n"
      "--rough odometry: the wheels' errors of up to 3 % stay.");
  verb->add_option("SCENE", options->scene,
                   "a scene's name (home, office, ...) or its YAML file; or a log: a bag or the "
                   "folder of a recording with camera, laser and odometry")
      ->capture_default_str();
  CLI::Option* random =
      verb->add_flag("--random", options->random,
                     "a home, people, ways and the camera's light drawn from the seed");
  verb->add_option("--visits", options->episode.visits, "rooms that the person goes to")
      ->check(CLI::Range(1, 1000))
      ->needs(random)
      ->capture_default_str();
  verb->add_flag("--alone", options->alone, "nobody is there but the person to follow");
  verb->add_option("--plan", options->plan,
                   "what to do when the person is lost: 'paper', 'search', or a PNML file")
      ->capture_default_str();
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->add_option("--seed", options->loop.seed, "of all noise; with --random, of the home too")
      ->capture_default_str();
  CLI::Option* limit = verb->add_option("--limit", options->loop.limit_s,
                                        "the run ends after so long [s] (a log: at its end)")
                           ->capture_default_str();
  verb->add_option("--image-size", options->image_size,
                   "of the camera [px], for instance 640x480 (default: the scene's)");
  verb->add_option("--rate", options->rate_hz,
                   "pictures and commands [Hz]; the period is rounded to 0.01 s (default: the "
                   "scene's pictures, 10 commands)")
      ->check(CLI::Range(1.0, 100.0));
  addRobotConfig(*verb, options->config);
  addLight(*verb, options->light);
  addRough(*verb, options->rough);
  verb->add_flag_callback(
      "--no-map", [options] { options->loop.has_map = false; },
      "the robot has no map: it goes by its odometry, and by what it sees");
  verb->add_flag("--no-film", options->no_film, "write no film");
  verb->add_option("--map", options->map.map,
                   "of a log: a .bt or a map_server YAML (default: none, as with --no-map)")
      ->excludes(random)
      ->excludes(verb->get_option("--rough"))
      ->excludes(verb->get_option("--no-map"));
  verb->add_option("--model", options->model,
                   "of a log: the person, as 'heel learn' wrote it (default: the log begins with "
                   "phase 1)");
  addLogMap(*verb, options->map, options->opening.topics);
  verb->get_option("--robot-start")->needs("--map");
  addTimeSpan(*verb, options->opening.span);
  addCameraTopics(*verb, options->opening.topics);
  addOdometryTopic(*verb, options->opening.topics);
  addResultBag(*verb, options->bag);
  verb->callback([options, limit] {
    options->has_limit = limit->count() > 0;
    run(*options);
  });
}

}  // namespace heel
