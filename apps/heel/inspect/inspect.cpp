// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/inspect/inspect.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/map_picture.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/folders/indexed_recording.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/mapping/map_files.hpp>
#include <heel/segmentation/appearance_model_io.hpp>
#include <heel/segmentation/appearance_picture.hpp>

#include <CLI/CLI.hpp>
#include <opencv2/imgproc.hpp>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct InspectOptions {
  fs::path what;
  fs::path out;
  RecordingParams opening;
};

const char* nameOf(ColorModel model) {
  switch (model) {
    case ColorModel::kPrincipalColors:
      return "principal colours, the paper's";
    case ColorModel::kColorRatio:
      return "colours against the room's";
    case ColorModel::kHueSaturation:
      return "hue and saturation";
  }
  return "unknown";
}

cv::Mat inspectModel(const fs::path& file) {
  const AppearanceModel model = loadAppearance(file);
  std::printf("appearance model (%s%s), %zu band%s\n", nameOf(model.params().model),
              model.params().suppress_background ? ", the room's discounted" : "",
              model.bands().size(), model.bands().size() == 1 ? "" : "s");
  for (const AppearanceBand& band : model.bands()) {
    std::printf(
        "  %-10s %.2f to %.2f m: %llu points, delta %.4f, expected false positives %.1f %% "
        "of the room, false negatives %.1f %% of the person\n",
        band.body.name.c_str(), band.body.min_height_m, band.body.max_height_m,
        static_cast<unsigned long long>(band.person.total()), band.delta(),
        100.0 * band.errors().false_positive_share, 100.0 * band.errors().false_negative_share);
  }
  if (model.stature()) {
    std::printf("  stature %.2f m, seen in %d frames, spread %.3f m\n", model.stature()->height_m,
                model.stature()->frames, model.stature()->spread_m);
  }
  const Separability separability = model.separability();
  if (!separability.advice.empty()) std::printf("  warning: %s\n", separability.advice.c_str());
  return drawAppearance(model);
}

void printSetup(const CameraSetup& setup) {
  const Mounting mounting = mountingOf(setup.T_base_camera);
  std::printf("  camera %.2f m over the floor, pitch %.1f deg, roll %.1f deg (%s)\n",
              mounting.height_m, mounting.pitch_rad * kDegrees, mounting.roll_rad * kDegrees,
              setup.is_configured ? "as configured" : "from the floor");
  if (setup.ground) {
    const Mounting& floor = setup.ground->mounting;
    std::printf(
        "  floor seen: camera %.2f m over it, pitch %.1f deg, roll %.1f deg; %.0f %% of the "
        "points lie on it within %.0f mm (root mean square)\n",
        floor.height_m, floor.pitch_rad * kDegrees, floor.roll_rad * kDegrees,
        100.0 * setup.ground->inlier_share, 1000.0 * setup.ground->rmsHeight(setup.ground->plane));
  }
  const SetupReport& report = setup.report;
  std::printf("  depth at %.0f %% of the pixels; %.1f %% quite black, %.1f %% quite white\n",
              100.0 * report.found_share, 100.0 * report.black_share, 100.0 * report.white_share);
}

bool isCloudFolder(const fs::path& path) {
  return fs::is_directory(path) && !filesIn(path, isCloudName).empty();
}

cv::Mat inspectRecording(const fs::path& path, const RecordingParams& opening) {
  const auto recording = openRecording(path, opening);
  Frame frame;
  if (!recording->next(frame)) throw std::runtime_error(nothingReadMessage(*recording));
  const CameraSetup setup = findCameraSetup(*openRecording(path, opening));
  const RecordingInfo& info = recording->info();
  std::printf("%s: %s, %zu frame%s", info.name.c_str(), info.layout.c_str(), info.frame_count,
              info.frame_count == 1 ? "" : "s");
  if (info.duration_s > 0.0) std::printf(" over %.1f s", info.duration_s);
  std::printf("%s\n", info.nominal_stamps ? " (nominal: no times are stored)" : "");
  const PinholeCamera& camera = info.camera.left;
  if (camera.width > 0) {
    std::printf("  %dx%d, fx %.1f fy %.1f cx %.1f cy %.1f", camera.width, camera.height, camera.fx,
                camera.fy, camera.cx, camera.cy);
    if (info.camera.baseline_m > 0.0) std::printf(", baseline %.3f m", info.camera.baseline_m);
    std::printf("\n");
  }
  printSetup(setup);
  for (const std::string& warning : setup.warnings) std::printf("  warning: %s\n", warning.c_str());
  if (frame.image_bgr.empty()) {
    std::printf("  %zu points, not organized\n", frame.cloud->size());
    return {};
  }
  DepthImages depths(setup.sensor, setup.camera);
  cv::Mat picture;
  cv::hconcat(frame.image_bgr, paintDepth(depths.of(frame)), picture);
  return picture;
}

/// Clouds in a folder need not be a recording, and that is no error.
cv::Mat inspectMaybeRecording(const fs::path& path, const RecordingParams& opening) {
  try {
    return inspectRecording(path, opening);
  } catch (const std::runtime_error& error) {
    std::printf("no recording to track in: %s\n", error.what());
    return {};
  }
}

cv::Mat inspectWallMap(const fs::path& file) {
  const OccupancyGrid floor = loadWallMap(file).floorGrid();
  std::printf("wall map; from %.2f to %.2f m over the floor: %s\n", kBodyBand.low_m,
              kBodyBand.high_m, toText(floor).c_str());
  if (floor.empty()) return {};
  return drawMap(floor, file.filename().string());
}

cv::Mat inspectFloorPlan(const fs::path& file) {
  const OccupancyGrid floor = loadMapServer(file);
  std::printf("map_server map, corner at (%.2f, %.2f): %s\n", floor.origin_m().x(),
              floor.origin_m().y(), toText(floor).c_str());
  return drawMap(floor, file.filename().string());
}

/// CARMEN's: .log, .clf, and those with .gz.
bool isLaserLogName(const fs::path& file) {
  const auto ending = (file.extension() == ".gz" ? file.stem() : file).extension();
  return ending == ".log" || ending == ".clf";
}

void inspectLaserLog(const fs::path& file) {
  const auto log = openLaserLog(file);
  LaserReading reading, first;
  std::size_t scans = 0, referenced = 0;
  double way_m = 0.0;
  FloorPose before;
  while (log->next(reading)) {
    if (scans++ == 0) first = reading;
    if (scans > 1) way_m += (reading.odometry.position - before.position).norm();
    before = reading.odometry;
    referenced += reading.reference.has_value() ? 1 : 0;
  }
  if (scans == 0) {
    throw std::runtime_error(file.string() + ": holds no scans (lines of FLASER or ROBOTLASER1)");
  }
  std::printf("laser log: %zu scan%s over %.1f s, %.1f m by its odometry\n", scans,
              scans == 1 ? "" : "s", reading.stamp_s - first.stamp_s, way_m);
  std::printf("  %zu beams, %.2f degrees apart, from %.1f degrees on\n", first.scan.ranges_m.size(),
              first.scan.step_rad * kDegrees, first.scan.first_rad * kDegrees);
  if (const auto at = log->T_base_scanner()) {
    std::printf("  scanner at (%.3f, %.3f) m on the robot, turned by %.1f degrees\n",
                at->position.x(), at->position.y(), at->yaw_rad * kDegrees);
  }
  std::printf("  %zu of them with a pose to compare with\n", referenced);
  if (!log->lost().empty()) warn(log->lost());
}

cv::Mat inspect(const InspectOptions& options) {
  const fs::path& what = options.what;
  if (isPattern(what)) {
    inspectClouds(what);
    return {};
  }
  if (isBag(what) && !inspectBag(what, options.opening)) return {};
  if (isCloudName(what) && !fs::is_directory(what)) return inspectCloud(what);
  if (isCloudFolder(what)) {
    inspectClouds(what);
    return inspectMaybeRecording(what, options.opening);
  }
  if (isLaserLogName(what) && !fs::is_directory(what)) {
    inspectLaserLog(what);
    return {};
  }
  const fs::path extension = what.extension();
  if (extension == ".bt") return inspectWallMap(what);
  if (extension == ".pnml") return inspectPlan(what);
  if (extension != ".yaml" && extension != ".yml") return inspectRecording(what, options.opening);
  return isMapServerFile(what) ? inspectFloorPlan(what) : inspectModel(what);
}

void run(const InspectOptions& options) {
  if (!fs::exists(options.what) && !isPattern(options.what)) {
    throw std::runtime_error(options.what.string() + ": there is no such file or folder");
  }
  const cv::Mat picture = inspect(options);
  if (options.out.empty()) return;
  if (picture.empty()) {
    throw NothingFound(options.what.string() + ": there is nothing to draw of it");
  }
  Output output({"inspect", OutputKind::kFile, options.out, {options.what}});
  writePicture(output.file(), picture);
  output.commit();
  std::printf("wrote %s\n", options.out.string().c_str());
}

}  // namespace

void addInspect(CLI::App& app) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App* verb =
      app.add_subcommand("inspect", "Tell what is in a model, a map, a plan or a recording");
  verb->footer(
      "Examples:\n"
      "  heel inspect person.yaml\n"
      "  heel inspect maps/home/walls.bt\n"
      "  heel inspect plan.pnml --out plan.png\n"
      "  heel inspect recordings/kitchen\n"
      "  heel inspect robot.bag\n"
      "  heel inspect robot.mcap --from 600 --to 660\n"
      "  heel inspect robot.log.gz\n"
      "  heel inspect scene.pcd --out scene.png\n"
      "  heel inspect 'clouds/*.ply'");
  verb->add_option(
          "WHAT", options->what,
          "model or map_server map (.yaml), wall map (.bt), plan (.pnml), recording "
          "(folder), bag, CARMEN's laser log (.log, .clf, .gz), or PCD and PLY files (one, or a "
          "pattern in quotes)")
      ->required();
  verb->add_option("--out", options->out, "also draw it to this picture (.png)");
  addTimeSpan(*verb, options->opening.span);
  addCameraTopics(*verb, options->opening.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
