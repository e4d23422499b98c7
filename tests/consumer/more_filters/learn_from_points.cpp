// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_learner.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <opencv2/core.hpp>
#include <pcl/io/pcd_io.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace {

constexpr int kWidth = 64, kHeight = 48;

/// A blue wall at 3 m, Z up, with a person in red before it; a strip at the left has no depth.
/// `person` lists the person's points.
heel::ColorCloud makeScene(pcl::Indices& person) {
  heel::ColorCloud cloud(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const bool is_person = u >= 20 && u < 40 && v >= 6;
      auto& p = cloud.at(u, v);
      p.x = is_person ? 2.0F : 3.0F;
      p.y = 0.03F * static_cast<float>(kWidth / 2 - u);
      p.z = u < 4 ? std::numeric_limits<float>::quiet_NaN()
                  : 0.045F * static_cast<float>(kHeight - 1 - v);
      p.r = is_person ? 200 : 40;
      p.g = 30;
      p.b = static_cast<std::uint8_t>(is_person ? 30 : 150 + v);
      if (is_person) person.push_back(v * kWidth + u);
    }
  }
  return cloud;
}

}  // namespace

/// learn_from_points MODEL SCENE.pcd: writes a model that was learned from points, and its scene.
int main(int argc, char** argv) {
  if (argc != 3) return 2;
  pcl::Indices person;
  const heel::ColorCloud cloud = makeScene(person);
  cv::Mat room_bgr(kHeight, kWidth, CV_8UC3);
  for (int v = 0; v < kHeight; ++v) room_bgr.row(v).setTo(cv::Scalar(150 + v, 30, 40));

  //! [learn]
  heel::AppearanceLearner learner;   // bands, and the model: AppearanceParams
  learner.addRoom(room_bgr);         // a picture of the empty room, or several
  learner.addPerson(cloud, person);  // points with z = height over the floor, and which they are
  const heel::AppearanceModel model = learner.learn();
  heel::saveAppearance(model, argv[1]);
  //! [learn]
  return pcl::io::savePCDFileBinaryCompressed(argv[2], cloud) == 0 ? 0 : 1;
}
