// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/appearance_learner.hpp>
#include <heel/segmentation/height_crop.hpp>
#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/world_blobs.hpp>
#include <heel/tracking/target.hpp>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <pcl/memory.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

//! [scene]
constexpr float kStep_m = 0.03F;        // between points
constexpr double kFocalLength_px = 80;  // of a camera that sees points as far apart at 2.4 m

/// A person's front, 0.42 m wide and 1.74 m high, as the robot sees it; returns its points.
pcl::Indices addPerson(const Eigen::Vector2d& place, const Eigen::Isometry2d& robot, bool in_red,
                       heel::ColorCloud& cloud) {
  const Eigen::Vector2f at = (robot.inverse() * place).cast<float>();
  pcl::Indices points;
  for (int column = -7; column <= 7; ++column) {
    for (int row = 0; row <= 58; ++row) {
      pcl::PointXYZRGB p;
      p.r = in_red ? 200 : 40;
      p.g = in_red ? 30 : 160;
      p.b = 30;
      p.x = at.x();
      p.y = at.y() + kStep_m * static_cast<float>(column);
      p.z = kStep_m * static_cast<float>(row);  // the height over the floor
      points.push_back(static_cast<pcl::index_t>(cloud.size()));
      cloud.push_back(p);
    }
  }
  return points;
}

Eigen::Vector2d whereRedIs(double t_s) { return {2.0 + 0.4 * t_s, 1.0 - std::cos(0.3 * t_s)}; }
Eigen::Vector2d whereGreenIs(double t_s) { return {4.0, 2.0 - 0.4 * t_s}; }  // crosses the way
//! [scene]

heel::AppearanceModel learnRed() {
  //! [learn]
  heel::AppearanceLearner learner;
  learner.addRoom(cv::Mat(48, 64, CV_8UC3, cv::Scalar(150, 90, 80)));  // the empty room, bluish
  heel::ColorCloud cloud;
  const pcl::Indices person = addPerson({2.0, 0.0}, Eigen::Isometry2d::Identity(), true, cloud);
  learner.addPerson(cloud, person);
  const heel::AppearanceModel model = learner.learn();
  //! [learn]
  return model;
}

//! [eyes]
/// Where people of the learned colours stand, seen from the robot.
class Eyes {
 public:
  explicit Eyes(const heel::AppearanceModel& person) { by_color_.setTable(person.filterTable()); }

  const std::vector<heel::WorldBlob>& look(const heel::ColorCloud::ConstPtr& cloud) {
    by_color_.setInputCloud(cloud);
    by_color_.filter(*kept_);                // the person's colours,
    by_height_.apply(cloud, kept_, *kept_);  // neither on the floor nor at the ceiling,
    view_.build(*cloud, *kept_);             // from above,
    finder_.find(view_, blobs_);             // as places on the floor
    return blobs_;
  }

 private:
  heel::AppearanceFilter<pcl::PointXYZRGB> by_color_;
  heel::HeightCrop by_height_;
  heel::PlanView view_{{}, {{0.0, 0.0, 1.0}, kFocalLength_px}};
  heel::WorldBlobFinder finder_;
  pcl::IndicesPtr kept_ = pcl::make_shared<pcl::Indices>();
  std::vector<heel::WorldBlob> blobs_;
};
//! [eyes]

//! [drive]
constexpr double kDistance_m = 1.0;  // to keep from the person

/// Drives for `dt_s`: turns to the person, and goes on until they are near; stops without them.
void drive(const heel::TargetEstimate& target, double dt_s, Eigen::Isometry2d& robot) {
  if (!target.hasPlace()) return;
  const Eigen::Vector2d seen = robot.inverse() * target.motion.position_m();
  const double forward_mps = std::clamp(seen.norm() - kDistance_m, 0.0, 0.8);
  const double turn_radps = std::clamp(2.0 * std::atan2(seen.y(), seen.x()), -1.0, 1.0);
  robot.rotate(Eigen::Rotation2Dd(turn_radps * dt_s));
  robot.translate(Eigen::Vector2d(forward_mps * dt_s, 0.0));
}
//! [drive]

}  // namespace

/// A robot learns somebody in red, and follows them past somebody in green.
int main() {
  //! [loop]
  constexpr double kPeriod_s = 0.1;
  Eyes eyes(learnRed());
  heel::TargetTracker tracker;
  tracker.startAt(whereRedIs(0.0));
  Eigen::Isometry2d robot = Eigen::Isometry2d::Identity();
  for (int i = 0; i < 100; ++i) {
    const double stamp_s = kPeriod_s * i;
    const auto cloud = pcl::make_shared<heel::ColorCloud>();
    addPerson(whereRedIs(stamp_s), robot, true, *cloud);
    addPerson(whereGreenIs(stamp_s), robot, false, *cloud);
    std::vector<heel::Observation> seen;
    for (const heel::WorldBlob& blob : eyes.look(cloud)) {
      heel::Observation observation;
      observation.position_m = robot * blob.position_m;  // tracks are where the floor is
      observation.score = blob.score;
      seen.push_back(observation);
    }
    drive(tracker.step(stamp_s, seen, {robot.translation()}), kPeriod_s, robot);
  }
  //! [loop]
  const heel::TargetEstimate& target = tracker.estimate();
  const double error_m = (target.motion.position_m() - whereRedIs(9.9)).norm();
  const double distance_m = (robot.translation() - whereRedIs(9.9)).norm();
  std::printf("the person is %s, %.2f m from where they are; the robot is %.2f m from them\n",
              heel::toText(target.status), error_m, distance_m);
  return target.hasPlace() && error_m < 0.2 && distance_m < 2.0 ? 0 : 1;
}
