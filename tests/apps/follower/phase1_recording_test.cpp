// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 1 on real recordings, with the parameters that users get.

#include "tests/support/data.hpp"
#include <heel/apps/follower/acquisition.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/cloud/ground_plane.hpp>
#include <heel/tracking/clear_mot.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <vector>

namespace heel {
namespace {

/// Everyone's place in each frame of a recording's truth.
std::map<std::size_t, std::vector<LabelledPlace>> truthOf(const std::filesystem::path& file) {
  std::map<std::size_t, std::vector<LabelledPlace>> truth;
  for (const TruthRow& row : readTruth(file)) {
    auto& places = truth[row.frame];  // A detector has no identities.
    places.push_back({static_cast<int>(places.size()), row.position_m});
  }
  return truth;
}

TEST(Phase1OnSixPeople, DetectsThemAll) {
  HEEL_NEED_DATA("six_people");
  const auto folder = test::dataFolder() / "six_people";
  const auto truth = truthOf(folder / "truth.csv");
  const auto recording = openRecording(folder);
  PeopleDetector detector(recording->info().camera.left, *recording->info().T_base_camera);
  BackgroundLearner learner;
  BackgroundModel background;
  std::vector<TrackingFrame> frames;
  Frame frame;
  while (recording->next(frame)) {
    if (frame.number <= 26) {
      learner.add(frame.image_bgr, frame.depth_m);
      continue;
    }
    if (background.empty()) background = learner.model();
    const PeopleView& view = detector.detect(background, frame.image_bgr, frame.depth_m);
    if (frame.number > 102) {
      EXPECT_TRUE(view.people.empty()) << "frame " << frame.number << " is empty";
      continue;
    }
    TrackingFrame& next = frames.emplace_back();
    const auto at = truth.find(frame.number);
    if (at != truth.end()) next.truth = at->second;
    for (const int i : view.people) {
      next.estimates.push_back({i, view.blobs[static_cast<std::size_t>(i)].position_m});
    }
  }
  ClearMotParams params;
  params.match_distance_m = 0.75;
  params.has_identity = false;
  const ClearMot result = clearMot(frames, params);
  ASSERT_EQ(result.truths, 226);
  RecordProperty("moda", std::to_string(result.moda()));
  std::cout << "MODA " << result.moda() << ", missed " << result.misses << ", of nobody "
            << result.false_positives << ", mean distance " << result.motp_m() << " m\n";
  EXPECT_GE(result.moda(), 0.85);
}

TEST(Phase1OnSixPeople, AcquiresTheFirstPersonUntilTheSecondComes) {
  HEEL_NEED_DATA("six_people");
  const auto recording = openRecording(test::dataFolder() / "six_people");
  Acquisition acquisition(recording->info().camera.left, *recording->info().T_base_camera);
  Frame frame;
  std::size_t first = 0;
  while (acquisition.result().state != AcquisitionState::kEnded && recording->next(frame)) {
    acquisition.step(frame.stamp_s, frame.image_bgr, frame.depth_m);
    if (first == 0 && acquisition.result().person_frames > 0) first = frame.number;
  }
  const AcquisitionResult& result = acquisition.result();
  EXPECT_EQ(result.end, AcquisitionEnd::kSecondPerson);
  EXPECT_EQ(result.empty_frames, 26);
  EXPECT_EQ(first, 27U);
  // The second comes into view in frame 33, at its edge; they are a person in 34, and stay for
  // half a second: three more frames.
  EXPECT_EQ(result.person_frames, 7);
  EXPECT_GE(frame.number, 36U);
  EXPECT_LE(frame.number, 38U);
  EXPECT_EQ(result.confidence(), 1.0);
  EXPECT_GT(result.points, 50000);
}

// Where one sees the five: medians of the points on the middle of each torso, marked by hand in the
// image (columns, rows). x forward and y left over the floor.
const std::array<cv::Rect, 5> kTorsos = {cv::Rect(50, 190, 70, 90), cv::Rect(170, 190, 50, 60),
                                         cv::Rect(305, 190, 45, 70), cv::Rect(385, 190, 65, 90),
                                         cv::Rect(500, 170, 80, 130)};

double median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// A floor in the camera's optical frame: normal . p + offset_m = 0, the normal pointing down.
struct Floor {
  Eigen::Vector3d normal;
  double offset_m;
};

// The one that comes with the cloud.
const Floor kKnownFloor{{-0.0103586, 0.997011, 0.0765573}, -1.26614};

// x ahead, y left, z up from the floor.
Eigen::Isometry3d mountingOver(const Floor& floor) {
  const Eigen::Vector3d up = -floor.normal.normalized();
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitZ() - up.z() * up).normalized();
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() << ahead.transpose(), up.cross(ahead).transpose(), up.transpose();
  T_base_camera.translation().z() = -floor.offset_m / floor.normal.norm();
  return T_base_camera;
}

// Height crop, plan view, blobs and shape, without a background; then the comparison by eye.
void expectTheFive(const ColorCloud& in_camera, const Floor& floor) {
  const Eigen::Isometry3d T_base_camera = mountingOver(floor);
  const ColorCloud::Ptr cloud(new ColorCloud(in_camera));
  for (auto& p : *cloud) p.getVector3fMap() = T_base_camera.cast<float>() * p.getVector3fMap();
  HeightCrop crop;
  pcl::Indices standing;
  crop.apply(cloud, nullptr, standing);
  PlanView view({}, {T_base_camera.translation(), 525.0});
  view.build(*cloud, standing);
  WorldBlobFinder finder;
  std::vector<WorldBlob> blobs;
  finder.find(view, blobs);
  std::vector<WorldBlob> people;
  for (const WorldBlob& blob : blobs) {
    if (hasPersonShape(blob, PersonShape::inUnknownScene())) people.push_back(blob);
  }
  ASSERT_EQ(people.size(), 5U);
  for (const cv::Rect& torso : kTorsos) {
    std::vector<float> x;
    std::vector<float> y;
    for (int v = torso.y; v < torso.y + torso.height; ++v) {
      for (int u = torso.x; u < torso.x + torso.width; ++u) {
        const auto& p = cloud->at(u, v);
        if (!std::isfinite(p.z)) continue;
        x.push_back(p.x);
        y.push_back(p.y);
      }
    }
    const Eigen::Vector2d seen(median(x), median(y));
    double nearest = 10.0;
    for (const WorldBlob& blob : people) {
      nearest = std::min(nearest, (blob.position_m - seen).norm());
    }
    // Legs and arms draw the whole body's centre away from the torso's by as much.
    EXPECT_LT(nearest, 0.08) << "the person at " << seen.transpose();
  }
}

TEST(Phase1OnFivePeople, FindsFiveBlobsOfAPersonsHeightWhereTheyStand) {
  HEEL_NEED_DATA("clouds/five_people.pcd");
  const auto recording = openRecording(test::dataFolder() / "clouds" / "five_people.pcd");
  Frame frame;
  ASSERT_TRUE(recording->next(frame));
  expectTheFive(*frame.cloud, kKnownFloor);
}

TEST(Phase1OnFivePeople, FindsTheSameFiveOverTheEstimatedFloor) {
  HEEL_NEED_DATA("clouds/five_people.pcd");
  const auto recording = openRecording(test::dataFolder() / "clouds" / "five_people.pcd");
  Frame frame;
  ASSERT_TRUE(recording->next(frame));
  GroundPlaneEstimator estimator;
  estimator.add(*frame.cloud);
  const auto found = estimator.estimate();
  ASSERT_TRUE(found);
  expectTheFive(*frame.cloud, {-found->plane.head<3>(), -found->plane.w()});
}

TEST(Phase1OnFivePeople, BearsAFloorThatIsNotQuiteRight) {
  HEEL_NEED_DATA("clouds/five_people.pcd");
  const auto recording = openRecording(test::dataFolder() / "clouds" / "five_people.pcd");
  Frame frame;
  ASSERT_TRUE(recording->next(frame));
  constexpr double kOneDegree_rad = 0.01745;
  for (const double pitch : {-kOneDegree_rad, kOneDegree_rad}) {
    for (const double higher_m : {-0.03, 0.03}) {
      Floor floor = kKnownFloor;
      floor.normal = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) * floor.normal;
      floor.offset_m -= higher_m;
      expectTheFive(*frame.cloud, floor);
    }
  }
}

}  // namespace
}  // namespace heel
