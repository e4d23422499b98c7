// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/pictures/map_picture.hpp>
#include <heel/mapping/map_files.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct MapOptions {
  std::string source;
  fs::path out;
  HeightBand band = kBodyBand;
  MapSourceParams params;
};

void run(MapOptions& options) {
  if (!(options.band.low_m < options.band.high_m)) {
    throw std::invalid_argument("--low must be under --high");
  }
  const fs::path source = mapSource(options.source);
  Output output({"map",
                 OutputKind::kFolder,
                 options.out,
                 {source},
                 {"walls.bt", "map.yaml", "map.pgm", "map.png"}});
  std::optional<ProgressBar> progress;  // Only a recording takes long.
  options.params.progress = [&](double share) {
    if (isStopRequested()) throw Stopped("stopped: nothing is mapped, and nothing is written");
    if (!progress) progress.emplace("mapping", 100);
    progress->show(static_cast<std::size_t>(100.0 * share));
  };
  const SourcedMap made = openMap(source, options.params);
  const OccupancyGrid floor = made.map.floorGrid(options.band);
  if (floor.empty()) throw NothingFound(source.string() + ": there is nothing to map in it");
  writeWith(output / "walls.bt", [&](const fs::path& file) { saveWallMap(made.map, file); });
  writeWith(output / "map.yaml", [&](const fs::path& file) { saveMapServer(floor, file); });
  writePicture(output / "map.png", drawMap(floor, source.stem().string()));
  output.commit();
  std::printf("%s: %s, %s\n", source.filename().c_str(), made.source.c_str(),
              toText(floor).c_str());
  std::printf("wrote %s\n", options.out.string().c_str());
}

}  // namespace

void addMap(CLI::App& app) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* verb =
      app.add_subcommand("map", "Make a wall map of a scene, a floor plan or a recording");
  verb->footer(
      "Examples:\n"
      "  heel map home --out maps/home\n"
      "  heel map office.yaml --out maps/office\n"
      "  heel map plan.png --resolution 0.05 --out maps/plan\n"
      "  heel map recordings/kitchen --out maps/kitchen\n"
      "Writes walls.bt (OctoMap), map.yaml with map.pgm (ROS map_server), and map.png.");
  verb->add_option(
          "SOURCE", options->source,
          "a scene's name or YAML file, a map_server YAML, a picture, a wall map (.bt), or "
          "a recording with robot.csv, or a bag with odometry")
      ->required();
  verb->add_option("--out", options->out, "folder for the map")->required();
  verb->add_option(
          "--resolution", options->params.cell_size_m,
          "edge of a cell, and of a picture's pixel [m] (default: the map's own, else 0.05; a "
          "picture needs it)")
      ->check(CLI::Range(0.001, 10.0));
  verb->add_option("--height", options->params.wall_height_m, "to which a plan's walls go up [m]")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  verb->add_option("--low", options->band.low_m, "map.yaml shows what stands from here [m]")
      ->capture_default_str();
  verb->add_option("--high", options->band.high_m, "up to here [m]")->capture_default_str();
  addCameraTopics(*verb, options->params.topics);
  addPoseTopics(*verb, options->params.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
