// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/people_detector.hpp>

#include <cstddef>

namespace heel {

PeopleDetector::PeopleDetector(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                               const PeopleDetectorParams& params)
    : camera_(camera),
      T_base_camera_(T_base_camera),
      height_crop_(params.height),
      plan_view_(params.plan_view, {T_base_camera.translation(), camera.fx}),
      finder_(params.blobs),
      person_(params.person) {
  view_.cloud = pcl::make_shared<ColorCloud>();
  view_.candidates.reset(new pcl::Indices);
}

const PeopleView& PeopleDetector::detect(const BackgroundModel& background,
                                         const cv::Mat& image_bgr, const cv::Mat& depth_m) {
  background.extract(image_bgr, depth_m, view_.foreground);
  makeColorCloud(depth_m, image_bgr, view_.foreground.mask, camera_, T_base_camera_, *view_.cloud,
                 *view_.candidates);
  height_crop_.apply(view_.cloud, view_.candidates, view_.standing);
  plan_view_.build(*view_.cloud, view_.standing);
  finder_.find(plan_view_, view_.blobs);
  view_.people.clear();
  for (std::size_t i = 0; i < view_.blobs.size(); ++i) {
    if (hasPersonShape(view_.blobs[i], person_)) view_.people.push_back(static_cast<int>(i));
  }
  return view_;
}

}  // namespace heel
