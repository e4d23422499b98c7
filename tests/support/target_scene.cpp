// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/target_scene.hpp"

#include <opencv2/core.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace heel::test {
namespace {

constexpr int kTorso = kPersonFirst + 1;  // surface of roomWithPerson()
constexpr int kLegs = kPersonFirst + 2;
constexpr int kSpecks = 3000;

/// The room with boxes and cushions in the red of the person's jumper.
std::vector<Surface> roomOfRedThings() {
  std::vector<Surface> surfaces = roomWithPerson();
  const Surface torso = surfaces[kTorso];
  const std::pair<cv::Rect2d, double> things[] = {
      {{60, 190, 70, 50}, 19.0}, {{450, 180, 60, 55}, 26.0}, {{530, 330, 50, 40}, 41.0},
      {{500, 60, 45, 45}, 10.0}, {{210, 40, 40, 60}, 10.0},  {{590, 190, 40, 50}, 12.0},
  };
  for (const auto& [area, disparity] : things) {
    Surface thing = torso;
    thing.area = area;
    thing.disparity = disparity;
    surfaces.push_back(thing);
  }
  return surfaces;
}

}  // namespace

TargetScene targetScene() {
  TargetScene scene;
  scene.pair = render(roomOfRedThings());
  scene.T_base_camera.setIdentity();
  scene.T_base_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  scene.T_base_camera.translation() << 0, 0, 1.02;
  const double focal_baseline = scene.camera.left.fx * scene.camera.baseline_m;
  scene.depth_m = focal_baseline / scene.pair.disparity;
  scene.person = (scene.pair.surface >= kPersonFirst) & (scene.pair.surface <= kLegs);

  const Surface torso = roomWithPerson()[kTorso];
  const double depth_m = focal_baseline / torso.disparity;
  const double middle = torso.area.x + 0.5 * torso.area.width;
  scene.place_m = {depth_m, (scene.camera.left.cx - middle) / scene.camera.left.fx * depth_m};

  cv::RNG random(5);
  const auto red = torso.colour_bgr;
  for (int i = 0; i < kSpecks; ++i) {
    auto& pixel = scene.pair.left.at<cv::Vec3b>(random.uniform(0, 480), random.uniform(0, 640));
    for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(red[c]);
  }
  return scene;
}

AppearanceModel modelOf(const TargetScene& scene, const AppearanceParams& params) {
  std::vector<ColorHistogram> person(params.bands.size());
  ColorHistogram room;
  const auto& camera = scene.camera.left;
  for (int v = 0; v < scene.depth_m.rows; ++v) {
    for (int u = 0; u < scene.depth_m.cols; ++u) {
      const auto& bgr = scene.pair.left.at<cv::Vec3b>(v, u);
      if (scene.pair.surface(v, u) < kPersonFirst) room.add(bgr[0], bgr[1], bgr[2]);
      if (scene.person(v, u) == 0) continue;
      const double z = static_cast<double>(scene.depth_m(v, u));
      const double height_m =
          scene.T_base_camera.translation().z() - (v - camera.cy) / camera.fy * z;
      for (std::size_t band = 0; band < person.size(); ++band) {
        if (params.bands[band].contains(height_m)) person[band].add(bgr[0], bgr[1], bgr[2]);
      }
    }
  }
  return AppearanceModel(params, std::move(person), std::move(room));
}

}  // namespace heel::test
