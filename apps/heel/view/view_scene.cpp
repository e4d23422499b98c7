// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/view/view_scene.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <dlfcn.h>
#include <opencv2/core.hpp>

namespace heel {
namespace {

void paint(const cv::Scalar& bgr, pcl::PointXYZRGB& point) {
  point.b = cv::saturate_cast<std::uint8_t>(bgr[0]);
  point.g = cv::saturate_cast<std::uint8_t>(bgr[1]);
  point.r = cv::saturate_cast<std::uint8_t>(bgr[2]);
}

}  // namespace

ViewPoint behindCamera(const Eigen::Isometry3d& T_floor_camera) {
  const Eigen::Vector3d at = T_floor_camera.translation();
  Eigen::Vector3d ahead = T_floor_camera.linear().col(2);
  ahead.z() = 0.0;
  if (ahead.norm() < 1e-6) ahead = Eigen::Vector3d::UnitX();
  ahead.normalize();
  const Eigen::Vector3d left(-ahead.y(), ahead.x(), 0.0);
  return {at - 2.2 * ahead + 1.2 * left + 1.6 * Eigen::Vector3d::UnitZ(),
          Eigen::Vector3d(at.x(), at.y(), 0.7) + 2.8 * ahead};
}

ColorCloud::Ptr tintedCloud(const ViewScene& scene) {
  const auto tinted = pcl::make_shared<ColorCloud>(*scene.cloud);
  for (const pcl::index_t i : scene.marked) {
    auto& point = (*tinted)[static_cast<std::size_t>(i)];
    paint(mixed({double(point.b), double(point.g), double(point.r)}, palette::kBlob, 0.6), point);
  }
  return tinted;
}

ColorCloud::Ptr wallPoints(const OccupancyGrid& walls) {
  constexpr int kLayers = 4;  // low, so that they hide little
  constexpr float kApart_m = 0.1F;
  const auto points = pcl::make_shared<ColorCloud>();
  for (int y = 0; y < walls.height(); ++y) {
    for (int x = 0; x < walls.width(); ++x) {
      if (walls.at(GridCell{x, y}) != Occupancy::kOccupied) continue;
      const Eigen::Vector2f at = walls.center(GridCell{x, y}).cast<float>();
      for (int layer = 0; layer < kLayers; ++layer) {
        pcl::PointXYZRGB point;
        point.getVector3fMap() << at, kApart_m * static_cast<float>(layer);
        paint(palette::kInkSoft, point);
        points->push_back(point);
      }
    }
  }
  return points;
}

std::unique_ptr<SceneWindow> openSceneWindow(std::string& why) {
  // Never closed: VTK does not take it well.
  void* library = dlopen("libheel_window.so", RTLD_NOW | RTLD_LOCAL);
  using Open = SceneWindow* (*)();
  void* symbol = library == nullptr ? nullptr : dlsym(library, "heelOpenSceneWindow");
  if (symbol == nullptr) {
    why = "Heel's window is not installed";
    return nullptr;
  }
  std::unique_ptr<SceneWindow> window(reinterpret_cast<Open>(symbol)());
  if (window == nullptr) why = "there is no display";
  return window;
}

}  // namespace heel
