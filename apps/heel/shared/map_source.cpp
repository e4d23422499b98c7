// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/heel/shared/recorded_map.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/map_server_file.hpp>
#include <heel/mapping/wall_map_builder.hpp>
#include <heel/mapping/wall_map_file.hpp>

#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualCell_m = 0.05;

/// What can't be built is told with the file's name.
template <class Build>
WallMap builtFrom(const fs::path& file, const Build& build) {
  try {
    return build();
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

WallMap extruded(const fs::path& file, const OccupancyGrid& plan, const MapSourceParams& params) {
  return builtFrom(file, [&] {
    WallMapBuilder builder(params.cell_size_m.value_or(plan.cell_size_m()));
    builder.add(plan, params.wall_height_m);
    return builder.build();
  });
}

}  // namespace

SourcedMap openMap(const fs::path& path, const MapSourceParams& params) {
  const double cell_m = params.cell_size_m.value_or(kUsualCell_m);
  if (!fs::exists(path)) {
    throw std::runtime_error(path.string() + ": there is no such file or folder");
  }
  if (fs::is_directory(path) || isBag(path)) {
    RecordedMapParams recorded;
    recorded.cell_size_m = cell_m;
    recorded.topics = params.topics;
    recorded.progress = params.progress;
    return {mapOfRecording(path, recorded), "recording"};
  }
  if (path.extension() == ".bt") return {loadWallMap(path), "wall map"};
  if (isImageName(path)) {
    if (!params.cell_size_m) {
      throw std::runtime_error(
          path.string() +
          ": a picture does not tell how large a pixel is; say it (--resolution, or --cell)");
    }
    return {extruded(path, gridFromImage(path, cell_m), params), "picture"};
  }
  if (isMapServerFile(path)) return {extruded(path, loadMapServer(path), params), "map_server map"};
  const Scene scene = loadScene(path.string());
  return {builtFrom(path, [&] { return wallMapOf(scene, cell_m); }), "scene"};
}

}  // namespace heel
