// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/log_localization.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/localize/localize_output.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/map_files.hpp>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct LocalizeOptions {
  fs::path log;
  fs::path out;
  std::string map;
  MapScans map_scans = MapScans::kEven;
  double cell_size_m = 0.05;
  std::vector<double> start;
  std::vector<double> scanner;
  LogLocalizationParams params;
};

/// Beside a wall map of 'heel map' is the floor plan, which is what a laser sees.
fs::path floorPlan(const LocalizeOptions& options) {
  const fs::path file = mapSource(options.map);
  if (file.extension() != ".bt") return file;
  const fs::path plan = file.parent_path() / "map.yaml";
  if (fs::exists(plan)) return plan;
  throw std::runtime_error(file.string() + ": is a wall map; name a map_server YAML or a scene");
}

OccupancyGrid readMap(LocalizeOptions& options) {
  LogLocalizationParams& params = options.params;
  const auto log = openLaserLog(options.log, params.topics);
  if (!log->lost().empty()) warn(log->lost());
  for (const std::string& warning : log->warnings()) warn(warning);
  const std::optional<FloorPose> scanner_on_robot = log->T_base_scanner();
  if (scanner_on_robot) params.T_base_scanner = *scanner_on_robot;
  if (!options.scanner.empty()) {
    params.T_base_scanner = {{options.scanner[0], options.scanner[1]}, options.scanner[2]};
  }
  const auto warnOfPlace = [&] {
    if (options.scanner.empty() && !log->unplaced().empty()) warn(log->unplaced());
  };
  if (options.map.empty()) {
    warnOfPlace();
    params.left_out = options.map_scans;
    return mapFromLog(options.log, options.map_scans, options.cell_size_m, params.T_base_scanner,
                      params.topics);
  }
  const fs::path file = floorPlan(options);
  if (isMapServerFile(file)) {
    warnOfPlace();
    return loadMapServer(file);
  }
  const Scene scene = loadScene(file.string());
  if (options.scanner.empty() && !scanner_on_robot) {
    params.T_base_scanner = {scene.robot.laser.at.head<2>(), 0.0};
  }
  return laserGrid(scene, options.cell_size_m);
}

void run(LocalizeOptions& options) {
  using Clock = std::chrono::steady_clock;
  const OccupancyGrid map = readMap(options);
  std::vector<fs::path> inputs = {options.log};
  if (!options.map.empty()) inputs.push_back(floorPlan(options));
  LogLocalizationParams& params = options.params;
  if (!options.start.empty()) {
    params.start = FloorPose{{options.start[0], options.start[1]}, options.start[2]};
  }
  LocalizeOutput output(options.out, map, inputs);
  double weighing_s = 0.0;
  const auto work = [&](const std::function<void()>& update) {
    const auto begin = Clock::now();
    update();
    weighing_s += std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const LogLocalizationResult result = localizeLog(
      options.log, map, params, [&](const LogLocalizationStep& step) { output.add(step); }, work);
  if (!result.complete && result.scans == 0) throw Stopped("stopped before the first scan");
  if (result.scans == 0) throw std::runtime_error(options.log.string() + ": has no scans to use");
  const double per_s = result.weighed > 0 ? result.weighed / weighing_s : 0.0;
  output.commit(result, per_s);
  std::printf("%d scans over %.1f m, %d weighed, %.0f a second, lost in %.1f %%\n", result.scans,
              result.way_m, result.weighed, per_s, 100.0 * result.lost_share);
  if (result.compared > 0) {
    std::printf(
        "against the reference, in the %d scans not lost: RMS %.3f m and %.2f degrees, "
        "median %.3f m, worst %.2f m\n",
        result.compared, result.rms_m, result.rms_rad * kDegrees, result.median_m, result.worst_m);
  }
  std::printf("wrote %s\n", output.folder().c_str());
  if (!result.complete) throw Stopped("stopped: the results are those of the log so far");
  if (result.lost_share > 0.5) {
    warn(
        "the robot is lost in most of the log: is this the map of its place? --global looks for it "
        "everywhere, --start tells where it begins, --scanner where its laser is");
  }
  if (result.lost_share >= 1.0) throw NothingFound("the robot is nowhere found on the map");
}

}  // namespace

void addLocalize(CLI::App& app) {
  auto options = std::make_shared<LocalizeOptions>();
  CLI::App* verb = app.add_subcommand("localize", "Find a robot on its map in a laser log");
  verb->footer(
      "Example:\n"
      "  heel simulate home --out recordings/home\n"
      "  heel localize recordings/home --map home --out out/localize\n"
      "Without --map, the log's own reference poses make the map from a part of the scans, and "
      "the\n"
      "others are localized on it.");
  verb->add_option("LOG", options->log,
                   "a folder made by 'heel simulate', a CARMEN log (.gz), or a bag")
      ->required();
  verb->add_option("--map", options->map,
                   "a scene's name, or the YAML file of a scene or of a ROS map");
  verb->add_option("--out", options->out, "folder for tables and the report")->required();
  const std::map<std::string, MapScans> scans{
      {"even", MapScans::kEven}, {"first-half", MapScans::kFirstHalf}, {"all", MapScans::kAll}};
  verb->add_option("--map-scans", options->map_scans,
                   "scans that make the map if none is given: even (the default), first-half, all")
      ->transform(CLI::CheckedTransformer(scans))
      ->option_text("WHICH");
  verb->add_option("--cell", options->cell_size_m, "edge of a cell of the map [m]")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  CLI::Option* global =
      verb->add_flag("--global", options->params.global, "the robot may be anywhere at first");
  verb->add_option("--start", options->start, "where it is at first [m, m, rad]")
      ->delimiter(',')
      ->expected(3)
      ->option_text("X,Y,YAW")
      ->excludes(global);
  verb->add_option("--scanner", options->scanner,
                   "its place on the robot [m, m, rad]; else the bag's (tf), the scene's, or 0,0,0")
      ->delimiter(',')
      ->expected(3)
      ->option_text("X,Y,YAW");
  verb->add_option("--seed", options->params.localization.seed, "of the particles")
      ->capture_default_str();
  addLaserTopics(*verb, options->params.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
