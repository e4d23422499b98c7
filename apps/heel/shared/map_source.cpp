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
const FloorPose* poseAt(const std::vector<StampedPose>& poses, double stamp_s, double within_s) {
  const StampedPose* nearest = nullptr;
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), stamp_s,
                       [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
  if (after != poses.end()) nearest = &*after;
  if (after != poses.begin() &&
      (nearest == nullptr || stamp_s - (after - 1)->stamp_s < nearest->stamp_s - stamp_s)) {
    nearest = &*(after - 1);
  }
  if (nearest == nullptr || std::abs(nearest->stamp_s - stamp_s) > within_s) return nullptr;
  return &nearest->pose;
}

/// Points of the camera's frame.
void pointsOf(const cv::Mat& depth_m, const PinholeCamera& camera, int step,
              std::vector<Eigen::Vector3f>& points) {
  points.clear();
  for (int v = 0; v < depth_m.rows; v += step) {
    const auto* row = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; u += step) {
      if (!(row[u] > 0.0F)) continue;
      points.push_back(rayOf(camera, u, v).cast<float>() * row[u]);
    }
  }
}

}  // namespace

WallMap mapOfRecording(const std::filesystem::path& path, const RecordedMapParams& params) {
  const std::vector<StampedPose> poses = readPoses(path, params.topics);
  RecordingParams opening;
  opening.topics = params.topics;
  const CameraSetup setup = findCameraSetup(*openRecording(path, opening));
  const auto recording = openRecording(path, opening);
  DepthImages depths(setup.sensor, setup.camera);
  WallMapBuilder builder(params.cell_size_m);
  std::vector<Eigen::Vector3f> points;
  Frame frame;
  std::size_t used = 0;
  while (recording->next(frame)) {
    const FloorPose* robot = poseAt(poses, frame.stamp_s, params.max_pose_distance_s);
    if (robot == nullptr) continue;
    ++used;
    pointsOf(depths.of(frame), setup.camera.left, std::max(params.pixel_step, 1), points);
    builder.add(points, basePose(*robot) * setup.T_base_camera, params.max_range_m);
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
    RecordedMapParams recorded;
    recorded.cell_size_m = cell_m;
    recorded.topics = params.topics;
    recorded.progress = params.progress;
    return {mapOfRecording(path, recorded), "recording"};
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
