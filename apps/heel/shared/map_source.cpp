// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/heel/shared/map_source.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/recording/bags/bag_odometry.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/map_files.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

std::vector<StampedPose> posesOfTable(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) {
    throw std::runtime_error(file.string() +
                             " is missing: a map needs to know where the robot was");
  }
  CsvReader csv(file, {"stamp_s", "x_m", "y_m", "yaw_rad"});
  std::vector<StampedPose> poses;
  while (csv.next()) {
    poses.push_back({csv.number(0), {{csv.number(1), csv.number(2)}, csv.number(3)}});
  }
  return poses;
}

/// In the order of time.
std::vector<StampedPose> readPoses(const std::filesystem::path& path, const BagTopics& topics) {
  auto poses = isBag(path) ? readBagPoses(path, topics) : posesOfTable(path / "robot.csv");
  std::sort(poses.begin(), poses.end(),
            [](const StampedPose& a, const StampedPose& b) { return a.stamp_s < b.stamp_s; });
  return poses;
}

/// The pose nearest in time; null if that is too far away.
const FloorPose* poseAt(const std::vector<StampedPose>& poses, double stamp_s) {
  constexpr double kWithin_s = 0.1;
  const StampedPose* nearest = nullptr;
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), stamp_s,
                       [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
  if (after != poses.end()) nearest = &*after;
  if (after != poses.begin() &&
      (nearest == nullptr || stamp_s - (after - 1)->stamp_s < nearest->stamp_s - stamp_s)) {
    nearest = &*(after - 1);
  }
  if (nearest == nullptr || std::abs(nearest->stamp_s - stamp_s) > kWithin_s) return nullptr;
  return &nearest->pose;
}

/// Points of the camera's frame.
void pointsOf(const cv::Mat& depth_m, const PinholeCamera& camera,
              std::vector<Eigen::Vector3f>& points) {
  constexpr int kStep = 3;  // Every so many pixels each way.
  points.clear();
  for (int v = 0; v < depth_m.rows; v += kStep) {
    const auto* row = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; u += kStep) {
      if (!(row[u] > 0.0F)) continue;
      points.push_back(rayOf(camera, u, v).cast<float>() * row[u]);
    }
  }
}

/// Adds the clouds of all frames from where the robot was: robot.csv of the recording
/// (`stamp_s,x_m,y_m,yaw_rad`, as 'heel simulate' writes it) tells the base's pose in the world; of
/// a bag, see readBagPoses().
WallMap mapOfRecording(const std::filesystem::path& path, double cell_m,
                       const MapSourceParams& params) {
  const std::vector<StampedPose> poses = readPoses(path, params.topics);
  RecordingParams opening;
  opening.topics = params.topics;
  const CameraSetup setup = findCameraSetup(*openRecording(path, opening));
  const auto recording = openRecording(path, opening);
  DepthImages depths(setup.sensor, setup.camera);
  constexpr double kMaxRange_m = 4.0;  // Stereo depth is too coarse for a map further away.
  WallMapBuilder builder(cell_m);
  std::vector<Eigen::Vector3f> points;
  Frame frame;
  std::size_t used = 0;
  while (recording->next(frame)) {
    const FloorPose* robot = poseAt(poses, frame.stamp_s);
    if (robot == nullptr) continue;
    ++used;
    pointsOf(depths.of(frame), setup.camera.left, points);
    builder.add(points, basePose(*robot) * setup.T_base_camera, kMaxRange_m);
    if (params.progress) {
      params.progress(static_cast<double>(frame.number) /
                      static_cast<double>(std::max<std::size_t>(recording->info().frame_count, 1)));
    }
  }
  if (used == 0) {
    throw std::runtime_error((isBag(path) ? path : path / "robot.csv").string() +
                             ": it has no pose at the time of any frame");
  }
  return builder.build();
}

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

/// What a picture or a map_server pair shows; absent for anything else.
std::optional<OccupancyGrid> floorPlanIn(const fs::path& path, const MapSourceParams& params) {
  if (!fs::is_regular_file(path) || isBag(path)) return std::nullopt;
  if (isImageName(path)) {
    if (!params.cell_size_m) {
      throw std::runtime_error(
          path.string() +
          ": a picture does not tell how large a pixel is; say it (--resolution, or --cell)");
    }
    return gridFromImage(path, *params.cell_size_m);
  }
  if (path.extension() != ".bt" && isMapServerFile(path)) return loadMapServer(path);
  return std::nullopt;
}

}  // namespace

WallMap extruded(const OccupancyGrid& plan, const MapSourceParams& params) {
  WallMapBuilder builder(params.cell_size_m.value_or(plan.cell_size_m()));
  builder.add(plan, params.wall_height_m);
  return builder.build();
}

OccupancyGrid openFloor(const fs::path& path, const MapSourceParams& params) {
  if (auto plan = floorPlanIn(path, params)) {
    if (params.cell_size_m.value_or(plan->cell_size_m()) == plan->cell_size_m()) return *plan;
  }
  return openMap(path, params).map.floorGrid();
}

SourcedMap openMap(const fs::path& path, const MapSourceParams& params) {
  const double cell_m = params.cell_size_m.value_or(kUsualCell_m);
  if (!fs::exists(path)) {
    throw std::runtime_error(path.string() + ": there is no such file or folder");
  }
  if (fs::is_directory(path) || isBag(path)) {
    return {mapOfRecording(path, cell_m, params), "recording"};
  }
  if (path.extension() == ".bt") return {loadWallMap(path), "wall map"};
  if (const auto plan = floorPlanIn(path, params)) {
    return {builtFrom(path, [&] { return extruded(*plan, params); }),
            isImageName(path) ? "picture" : "map_server map"};
  }
  const Scene scene = loadScene(path.string());
  return {builtFrom(path, [&] { return wallMapOf(scene, cell_m); }), "scene"};
}

}  // namespace heel
