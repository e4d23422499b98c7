// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/planning/global_planner.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct PlanOptions {
  std::string map;
  std::vector<double> from, to;
  fs::path out;
  MapSourceParams source;
  GlobalPlannerParams planner;
};

constexpr double kStep_m = 0.1;  ///< Of path.csv.

cv::Mat drawPlan(const OccupancyGrid& map, const GlobalPlan& plan, const PlanOptions& options) {
  const int longest = std::max(map.width(), map.height());
  const int scale = std::clamp(1000 / longest, 1, 8);
  cv::Mat picture(map.height() * scale, map.width() * scale, CV_8UC3, palette::kPanelLit);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Occupancy cell = map.at(GridCell{x, y});
      if (cell == Occupancy::kFree) continue;
      const bool occupied = cell == Occupancy::kOccupied;
      picture(cv::Rect(x * scale, (map.height() - 1 - y) * scale, scale, scale))
          .setTo(occupied ? palette::kInkSoft : palette::kPaper);
    }
  }
  const auto pixel = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d cell = (p - map.origin_m()) / map.cell_size_m() * scale;
    return cv::Point2d(cell.x(), picture.rows - cell.y());
  };
  const double radius = options.planner.robot_radius_m / map.cell_size_m() * scale;
  for (const Eigen::Vector2d& p : resample(plan.path, kStep_m)) {
    fillCircle(picture, pixel(p), radius, palette::kTrack, 0.06);
  }
  Outline line;
  for (const Eigen::Vector2d& p : plan.path) line.push_back(pixel(p));
  if (line.size() > 1) drawOutline(picture, line, false, palette::kTrack, 2);
  for (const cv::Point2d& p : line) fillCircle(picture, p, 2.5, palette::kInk);
  drawCircle(picture, pixel({options.from[0], options.from[1]}), radius, palette::kGood, 2);
  drawCircle(picture, pixel({options.to[0], options.to[1]}), radius, palette::kTarget, 2);
  return picture;
}

void write(const Output& output, const PlanOptions& options, const OccupancyGrid& map,
           const ClearanceMap& clearance, const GlobalPlan& plan, double least_m) {
  CsvWriter csv(output / "path.csv", {"x_m", "y_m", "clearance_m"});
  for (const Eigen::Vector2d& p : resample(plan.path, kStep_m)) {
    csv.number(p.x(), 3).number(p.y(), 3).number(clearance.clearance(p), 3).endRow();
  }
  csv.close();
  nlohmann::ordered_json summary;
  summary["version"] = 1;
  summary["map"] = options.map;
  summary["status"] = nameOf(plan.status);
  summary["length_m"] = plan.length_m;
  summary["escape_m"] = plan.escape_m;
  if (plan.found()) {
    summary["end_m"] = {plan.end.x(), plan.end.y()};
    summary["min_clearance_m"] = least_m;
  }
  summary["way_points"] = plan.path.size();
  writeJson(output / "summary.json", summary);
  writePicture(output / "plan.png", drawPlan(map, plan, options));
}

/// "; the map knows nothing at --from": what the map has at the end that there is no way from or
/// to; empty if it is free floor.
std::string whyNone(const OccupancyGrid& map, PlanStatus status, const PlanOptions& options) {
  if (status == PlanStatus::kStartOutside || status == PlanStatus::kGoalOutside) {
    const Eigen::Vector2d low = map.origin_m();
    const Eigen::Vector2d high =
        low + map.cell_size_m() * Eigen::Vector2d(map.width(), map.height());
    char text[100];
    std::snprintf(text, sizeof text, "; the map goes from %.1f,%.1f to %.1f,%.1f", low.x(), low.y(),
                  high.x(), high.y());
    return text;
  }
  const bool at_start = status == PlanStatus::kStartBlocked;
  const std::vector<double>& place = at_start ? options.from : options.to;
  const Occupancy there = map.at(Eigen::Vector2d(place[0], place[1]));
  if (there == Occupancy::kFree) return {};
  return std::string(there == Occupancy::kUnknown ? "; the map knows nothing" : "; something is") +
         (at_start ? " at --from" : " at --to");
}

void run(const PlanOptions& options) {
  const fs::path source = mapSource(options.map);
  std::optional<Output> output;
  if (!options.out.empty()) {
    output.emplace(OutputPlan{"plan",
                              OutputKind::kFolder,
                              options.out,
                              {source},
                              {"plan.png", "path.csv", "summary.json"}});
  }
  const OccupancyGrid map = openFloor(source, options.source);
  if (map.empty()) throw NothingFound(source.string() + ": there is nothing to map in it");
  GlobalPlanner planner(map, options.planner);
  const GlobalPlan plan =
      planner.plan({options.from[0], options.from[1]}, {options.to[0], options.to[1]});
  double least_m = planner.clearance().reach_m();
  for (const Eigen::Vector2d& p : resample(plan.path, kStep_m)) {
    least_m = std::min(least_m, planner.clearance().clearance(p));
  }
  if (output) {
    write(*output, options, map, planner.clearance(), plan, least_m);
    output->commit();
  }
  if (plan.found()) {
    std::printf("%s: %.2f m, %zu way points, clearance %.2f m at least\n", nameOf(plan.status),
                plan.length_m, plan.path.size(), least_m);
    for (const Eigen::Vector2d& p : plan.path) std::printf("  %.2f,%.2f\n", p.x(), p.y());
  }
  if (output) std::printf("wrote %s\n", options.out.c_str());
  if (!plan.found()) {
    std::string status = nameOf(plan.status);
    std::replace(status.begin(), status.end(), '_', ' ');
    throw NothingFound("no path: " + status + whyNone(map, plan.status, options));
  }
}

}  // namespace

void addPlan(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* verb = app.add_subcommand("plan", "Plan a path on a map");
  verb->footer(
      "Examples:\n"
      "  heel plan home --from 1,1 --to 6,4\n"
      "  heel plan home --from 1,1 --to 6,4 --out out/plan\n"
      "Prints the path's way points, x,y in metres.");
  verb->add_option("MAP", options->map,
                   "a scene's name or YAML file, a map_server YAML, a picture, or a wall map (.bt)")
      ->required();
  verb->add_option("--from", options->from, "where the robot is [m]")
      ->required()
      ->delimiter(',')
      ->expected(2)
      ->option_text("X,Y REQUIRED");
  verb->add_option("--to", options->to, "where it shall go [m]")
      ->required()
      ->delimiter(',')
      ->expected(2)
      ->option_text("X,Y REQUIRED");
  verb->add_option("--out", options->out,
                   "also write plan.png, path.csv and summary.json to this folder");
  verb->add_option("--radius", options->planner.robot_radius_m, "of the robot, in metres")
      ->check(CLI::Range(0.001, 100.0))
      ->capture_default_str();
  verb->add_option(
          "--cell", options->source.cell_size_m,
          "edge of the map's cells, and of a picture's pixel, in metres (default: the map's own, "
          "else 0.05; a picture needs it)")
      ->check(CLI::Range(0.01, 0.5));
  verb->callback([options] { run(*options); });
}

}  // namespace heel
