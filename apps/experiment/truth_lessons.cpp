// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/truth_lessons.hpp>
#include <heel/apps/follower/depth_images.hpp>

#include <set>
#include <string>

namespace heel {

std::vector<ModelLessons> learnEveryone(const std::filesystem::path& path, const CameraSetup& setup,
                                        const TruthFrames& truth,
                                        const std::vector<OfferedModel>& models,
                                        const ExperimentParams& params) {
  std::vector<ModelLessons> lessons(truth.people().size(), ModelLessons(models));
  std::vector<std::set<std::size_t>> frames_of;
  for (const std::string& person : truth.people()) {
    const auto frames = truth.exactFrames(person);
    frames_of.emplace_back(frames.begin(),
                           frames.begin() + static_cast<std::ptrdiff_t>(frames.size() / 2));
  }
  const auto recording = openRecording(path);
  DepthImages depths(setup.sensor, setup.camera);
  ColorCloud cloud;
  pcl::Indices near;
  Frame frame;
  const double radius_m2 = params.learn_radius_m * params.learn_radius_m;
  while (recording->next(frame)) {
    if (frame.stamp_s <= params.background_s) {
      for (ModelLessons& lesson : lessons) lesson.addRoom(frame.image_bgr);
      continue;
    }
    makeColorCloud(depths.of(frame), frame.image_bgr, setup.camera.left, setup.T_base_camera,
                   cloud);
    for (std::size_t i = 0; i < lessons.size(); ++i) {
      if (frames_of[i].count(frame.number) == 0) continue;
      const Eigen::Vector2f place = truth.placeOf(truth.people()[i], frame.number)->cast<float>();
      near.clear();
      for (std::size_t p = 0; p < cloud.size(); ++p) {
        const auto offset = cloud[p].getVector3fMap().head<2>() - place;
        if (offset.squaredNorm() < static_cast<float>(radius_m2)) {
          near.push_back(static_cast<pcl::index_t>(p));
        }
      }
      lessons[i].addPerson(cloud, near);
      lessons[i].addBody(cloud, near, place.cast<double>());
    }
  }
  return lessons;
}

}  // namespace heel
