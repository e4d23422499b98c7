// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/follower/colored_stage.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/target_scene.hpp"
#include <heel/apps/follower/perception.hpp>
#include <heel/segmentation/height_crop.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace heel {
namespace {

using test::ColoredStage;
using test::kRed;
using test::legsAt;

constexpr Bgr kGreen{40, 150, 40};
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

CameraSetup cameraSetupOf(SensorKind sensor) {
  CameraSetup setup;
  setup.sensor = sensor;
  setup.camera.left = ColoredStage().camera;
  setup.T_base_camera = ColoredStage::T_base_camera();
  return setup;
}

AppearanceModel personInRed() {
  return AppearanceModel({}, test::paintPerson(), test::paintRoom());
}

Perception perceptionOf(SensorKind sensor = SensorKind::kRgbd,
                        const PerceptionParams& params = {}) {
  return Perception(cameraSetupOf(sensor), personInRed(), params);
}

void expectFollowedAt(const PerceptionStep& step, const Eigen::Vector2d& place_m,
                      double tolerance_m = 0.06) {
  EXPECT_EQ(step.reason, "");
  ASSERT_EQ(step.target.status, TargetStatus::kFollowed);
  EXPECT_LT((step.target.motion.position_m() - place_m).norm(), tolerance_m)
      << "at " << step.target.motion.position_m().transpose();
}

TEST(Perception, FindsTheTargetAtItsPlace) {
  Perception perception = perceptionOf();
  for (int i = 0; i < 5; ++i) {
    const double x = 2.5 + 0.05 * i;
    const PerceptionStep& step = perception.step(ColoredStage().person(x, -0.4).frame(0.1 * i));
    EXPECT_GE(step.color_pixels, step.color_points);
    EXPECT_GE(step.color_points, static_cast<int>(step.standing.size()));
    ASSERT_EQ(step.observations.size(), 1U);
    EXPECT_GT(perception.identity().looks()[0].row(kTarget).sum(), 0.0);
    if (i > 1) expectFollowedAt(step, {x, -0.4});
  }
}

TEST(Perception, PlacesTheTargetInTheWorldOfARobotThatDrives) {
  Perception perception = perceptionOf();
  const Eigen::Vector2d stands(1.0, 4.0);
  for (int i = 0; i < 6; ++i) {
    const RobotPlace robot{{{0.03 * i, 1.0}, 1.2 + 0.05 * i}, Eigen::Matrix2d::Zero()};
    const Eigen::Vector2d seen = robot.pose.inverse() * stands;
    const auto& step =
        perception.step(ColoredStage().person(seen.x(), seen.y()).frame(0.1 * i), robot);
    if (i > 1) expectFollowedAt(step, stands);
    if (i < 4) continue;
    EXPECT_LT(step.target.motion.velocity_mps().norm(), 0.3);
  }
}

TEST(Perception, LeavesPeopleInOtherColoursAlone) {
  Perception perception = perceptionOf();
  for (int i = 0; i < 4; ++i) {
    const auto step =
        perception.step(ColoredStage().person(3.0, 1.0, kGreen).person(2.5, -0.4).frame(0.1 * i));
    if (i > 1) expectFollowedAt(step, {2.5, -0.4});
  }
  Perception alone = perceptionOf();
  for (int i = 0; i < 4; ++i) {
    const auto step = alone.step(ColoredStage().person(3.0, 1.0, kGreen).frame(0.1 * i));
    EXPECT_FALSE(step.target.hasPlace());
    EXPECT_NE(step.reason, "");
  }
}

TEST(Perception, TheLaserGoesOnWithWhomTheCameraKnew) {
  Perception perception = perceptionOf();
  const LaserBodies legs = legsAt({{2.6, -0.4}, {-2.0, 1.0}});
  for (int i = 0; i < 4; ++i) {
    const auto& step = perception.step(ColoredStage().person(2.5, -0.4).frame(0.1 * i), {}, &legs);
    ASSERT_EQ(step.observations.size(), 2U);
    ASSERT_EQ(step.blob_of_observation.size(), 1U);
    EXPECT_NE(step.observations[0].look, nullptr);
    EXPECT_EQ(step.observations[1].look, nullptr) << "behind the robot";
    if (i > 1) expectFollowedAt(step, {2.6, -0.4});
  }
  for (int i = 4; i < 20; ++i) {  // They walk around the robot, out of the picture.
    const double angle = 0.1 * (i - 3);
    const Eigen::Vector2d place(2.6 * std::cos(angle), -0.4 - 2.6 * std::sin(angle));
    const LaserBodies now = legsAt({place, {-2.0, 1.0}});
    const auto& step = i % 2 == 0 ? perception.step(ColoredStage().frame(0.1 * i), {}, &now)
                                  : perception.step(0.1 * i, {}, now);
    ASSERT_TRUE(step.target.hasPlace()) << i;
    EXPECT_LT((step.target.motion.position_m() - place).norm(), 0.35) << i;
  }
}

TEST(Perception, LooksAtWhomOnlyTheLaserFound) {
  Perception perception = perceptionOf();
  const LaserBodies legs = legsAt({{2.6, -0.4}});
  for (int i = 0; i < 4; ++i) {
    perception.step(ColoredStage().person(2.5, -0.4).frame(0.1 * i), {}, &legs);
  }
  for (int i = 4; i < 14; ++i) {  // Somebody in green stands where the target stood.
    const auto& step =
        perception.step(ColoredStage().person(2.5, -0.4, kGreen).frame(0.1 * i), {}, &legs);
    ASSERT_EQ(step.observations.size(), 1U);
    ASSERT_TRUE(step.blob_of_observation.empty());
    ASSERT_NE(step.observations[0].look, nullptr);
    EXPECT_TRUE(i < 13 || !step.target.hasPlace());
  }
}

TEST(Perception, WhoHasNoLegsIsHardlyAPerson) {
  const auto thing = [](const std::vector<Eigen::Vector2d>& legs_m) {
    const LaserBodies legs = legsAt(legs_m);
    Perception perception = perceptionOf();
    perception.step(ColoredStage().person(2.5, -0.4, kGreen).person(2.5, 0.4).frame(0.0), {},
                    &legs);
    EXPECT_EQ(perception.tracks().size(), 1U);
    return perception.identity().probabilities(perception.tracks()[0].id)[kThing];
  };
  EXPECT_GT(thing({}), 5.0 * thing({{2.5, 0.4}}));
}

TEST(Perception, WhatIsSeenThroughWhereATrunkWouldBeIsHardlyAPerson) {
  const auto thing = [](double high_m) {
    ColoredStage stage;
    stage.part(2.5, 0.4, 0.2, 0.0, high_m, kGreen);
    Perception perception = perceptionOf();
    const LaserBodies legs = legsAt({{2.5, 0.4}});
    perception.step(stage.frame(0.0), {}, &legs);
    return perception.identity().probabilities(perception.tracks().at(0).id)[kThing];
  };
  EXPECT_GT(thing(0.8), 1.5 * thing(1.7)) << "a chair";
}

TEST(Perception, TellsTheStagesInTheirOrder) {
  std::vector<Stage> done;
  perceptionOf().step(ColoredStage().frame(0.0), {}, nullptr,
                      [&](Stage stage) { done.push_back(stage); });
  EXPECT_EQ(done, (std::vector<Stage>{Stage::kColorFilter, Stage::kDepth, Stage::kHeight,
                                      Stage::kPlanView, Stage::kTracking}));
}

std::string reasonFor(const ColoredStage& stage) {
  return perceptionOf().step(stage.frame(0.0)).reason;
}

TEST(Perception, SaysWhichStageLeftNothing) {
  EXPECT_EQ(reasonFor(ColoredStage()), "no pixel has the target's colours");

  ColoredStage no_depth;
  no_depth.person(2.5, 0.0).depth.setTo(kNaN);
  EXPECT_EQ(reasonFor(no_depth), "no pixel of the target's colours has a depth");

  EXPECT_EQ(reasonFor(ColoredStage().part(2.5, 0.0, 0.3, 0.0, 0.8, kRed)),
            "the target's colours are not at a person's height");
  EXPECT_EQ(reasonFor(ColoredStage().part(2.5, 0.0, 0.03, 1.2, 1.24, kRed)),
            "too few points of the target's colours in one place");
  EXPECT_EQ(reasonFor(ColoredStage().part(2.5, 0.0, 0.2, 1.0, 1.2, kRed)),
            "no blob is as large and high as a person");
}

TEST(Perception, StartsNoTrackOnLittleButGoesOnWithIt) {
  const ColoredStage little = ColoredStage().part(2.5, 0.0, 0.09, 1.1, 1.3, kRed);
  PerceptionParams params;
  params.candidates.min_score = 5.0;
  params.candidates.min_cells = 4;
  Perception perception = perceptionOf(SensorKind::kRgbd, params);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(perception.step(little.frame(0.1 * i)).observations.size(), 1U);
    EXPECT_TRUE(perception.tracks().empty());
  }
  perception.step(ColoredStage().person(2.5, 0.0).frame(0.3));
  ASSERT_EQ(perception.tracks().size(), 1U);
  perception.step(little.frame(0.4));
  ASSERT_EQ(perception.tracks().size(), 1U);
  EXPECT_EQ(perception.tracks()[0].hits, 2);
}

TEST(Perception, TakesWhoLooksLikeTheTargetAllOverAtTheFirstLook) {
  EXPECT_EQ(reasonFor(ColoredStage().person(2.5, 0.0)), "");
}

TEST(Perception, SaysThatTheTargetCantBeWhereItIsSeen) {
  const auto stepInto = [](const PerceptionParams& params, double from_x, double to_x) {
    Perception perception = perceptionOf(SensorKind::kRgbd, params);
    for (int i = 0; i < 3; ++i) perception.step(ColoredStage().person(from_x, 0.0).frame(0.1 * i));
    return PerceptionStep(perception.step(ColoredStage().person(to_x, 0.0).frame(0.3)));
  };
  PerceptionParams near;
  near.candidates.min_distance_m = 2.0;
  const PerceptionStep too_close = stepInto(near, 2.1, 1.9);
  EXPECT_EQ(too_close.reason, "too close");
  EXPECT_EQ(too_close.target.verdict, GateVerdict::kTooClose);

  PerceptionParams small_room;
  small_room.gate = insideBounds({0.0, -2.0}, {3.0, 2.0});
  const PerceptionStep outside = stepInto(small_room, 2.9, 3.1);
  EXPECT_EQ(outside.reason, "out of bounds");
  EXPECT_EQ(outside.target.verdict, GateVerdict::kOutOfBounds);
}

TEST(Perception, FindsTheTargetInOrganizedClouds) {
  Perception perception = perceptionOf(SensorKind::kCloud);
  for (int i = 0; i < 4; ++i) {
    const ColoredStage stage = ColoredStage().person(2.5, -0.4);
    Frame frame;
    frame.stamp_s = 0.1 * i;
    frame.cloud = stage.cloud();
    frame.image_bgr = stage.image;
    const PerceptionStep& step = perception.step(frame);
    if (i > 1) expectFollowedAt(step, {2.5, -0.4});
  }
}

TEST(Perception, FindsTheTargetInCloudsWithoutOrder) {
  Perception perception = perceptionOf(SensorKind::kCloud);
  for (int i = 0; i < 4; ++i) {
    ColoredStage stage = ColoredStage().person(2.5, -0.4);
    stage.depth.row(60).setTo(kNaN);
    const ColorCloud::Ptr cloud = stage.cloud();
    cloud->points.resize(cloud->size() -
                         static_cast<std::size_t>(100 * i));  // each of its own size
    cloud->width = static_cast<std::uint32_t>(cloud->size());
    cloud->height = 1;
    Frame frame;
    frame.stamp_s = 0.1 * i;
    frame.cloud = cloud;
    const PerceptionStep& step = perception.step(frame);
    EXPECT_TRUE(step.mask.empty());
    if (i > 1) expectFollowedAt(step, {2.5, -0.4});
  }
}

TEST(Perception, SaysThatACloudHoldsNothing) {
  Perception perception = perceptionOf(SensorKind::kCloud);
  Frame frame;
  frame.cloud.reset(new ColorCloud);
  EXPECT_EQ(perception.step(frame).reason, "no pixel has the target's colours");
  frame.stamp_s = 0.1;
  frame.cloud = ColoredStage().person(2.5, 0.0).cloud();
  EXPECT_EQ(perception.step(frame).observations.size(), 1U);
}

TEST(Perception, RejectsFramesThatDoNotFit) {
  const Frame good = ColoredStage().person(2.5, 0.0).frame(0.0);
  const auto rejects = [&](SensorKind sensor, const Frame& frame) {
    EXPECT_THROW(perceptionOf(sensor).step(frame), std::invalid_argument);
  };
  rejects(SensorKind::kRgbd, Frame());
  rejects(SensorKind::kStereo, Frame());
  rejects(SensorKind::kCloud, Frame());
  rejects(SensorKind::kCloud, good);   // an image, but no cloud
  rejects(SensorKind::kStereo, good);  // no right image

  Frame no_depth = good;
  no_depth.depth_m.release();
  rejects(SensorKind::kRgbd, no_depth);
  Frame other_size = good;
  other_size.depth_m = good.depth_m.rowRange(0, 50);
  rejects(SensorKind::kRgbd, other_size);
  Frame grey = good;
  grey.image_bgr = cv::Mat(120, 160, CV_8UC1, cv::Scalar(9));
  rejects(SensorKind::kRgbd, grey);

  Perception perception = perceptionOf();
  EXPECT_THROW(perception.step(grey), std::invalid_argument);
  EXPECT_EQ(perception.step(good).observations.size(), 1U);  // the next frame is as good as ever
}

TEST(Perception, RejectsParametersOutOfRange) {
  PerceptionParams params;
  params.candidates.min_distance_m = -1.0;
  EXPECT_THROW(perceptionOf(SensorKind::kRgbd, params), std::invalid_argument);
}

// A rendered stereo pair.

const test::TargetScene& scene() {
  static const test::TargetScene rendered = test::targetScene();
  return rendered;
}

CameraSetup sceneSetup(SensorKind sensor) {
  CameraSetup setup;
  setup.sensor = sensor;
  setup.camera = scene().camera;
  setup.T_base_camera = scene().T_base_camera;
  return setup;
}

Frame sceneFrame(double stamp_s) {
  Frame frame;
  frame.stamp_s = stamp_s;
  frame.image_bgr = scene().pair.left;
  frame.right_bgr = scene().pair.right;
  return frame;
}

TEST(PerceptionOfStereo, MatchedWhereTheColoursAreOrEverywhereGivesOnePlace) {
  Perception masked(sceneSetup(SensorKind::kStereo), test::modelOf(scene()));
  Perception dense(sceneSetup(SensorKind::kRgbd), test::modelOf(scene()));
  DepthImages depths(SensorKind::kStereo, scene().camera);
  for (int i = 0; i < 3; ++i) {
    Frame frame = sceneFrame(0.1 * i);
    const PerceptionStep& a = masked.step(frame);
    frame.depth_m = depths.of(frame);
    const PerceptionStep& b = dense.step(frame);
    if (i < 2) continue;
    expectFollowedAt(a, scene().place_m, 0.05);
    expectFollowedAt(b, scene().place_m, 0.05);
    EXPECT_LT((a.target.motion.position_m() - b.target.motion.position_m()).norm(), 0.03);
  }
}

// A warm step allocates nothing by itself; what remains is made inside PCL's PassThrough and
// OpenCV's dilate, setTo and histograms of gradients. Frames differ, so that a buffer that follows
// the mask would show.

template <typename Work>
long allocationsOf(Work&& work) {
  const long before = test::allocations();
  work();
  return test::allocations() - before;
}

Frame changedFrame(double stamp_s) {
  Frame frame = sceneFrame(stamp_s);
  frame.image_bgr = frame.image_bgr.clone();
  frame.image_bgr.rowRange(0, 90).setTo(cv::Scalar::all(0));
  frame.image_bgr.colRange(500, 640).setTo(cv::Scalar::all(0));
  return frame;
}

long allocationsOfCrop() {
  HeightCrop crop;
  ColorCloud::Ptr cloud(new ColorCloud(10, 10));
  pcl::IndicesPtr all(new pcl::Indices{1, 2, 3});
  pcl::Indices kept;
  crop.apply(cloud, all, kept);
  return allocationsOf([&] { crop.apply(cloud, all, kept); });
}

long allocationsOfOutline() {
  PersonOutline outline;
  const CameraSetup setup = sceneSetup(SensorKind::kRgbd);
  const BodyView view{sceneFrame(0.0).image_bgr, {}, setup.camera.left, setup.T_base_camera};
  outline.classify(view, scene().place_m);
  return allocationsOf([&] { outline.classify(view, scene().place_m); });
}

/// What a step over changing frames allocates once warm, but for the height crops of two bands and
/// the outline of each body.
long allocationsOfStep(SensorKind sensor) {
  Perception perception(sceneSetup(sensor), test::modelOf(scene()));
  std::vector<Frame> frames = {sceneFrame(0.0), changedFrame(0.0)};
  for (Frame& frame : frames) frame.depth_m = scene().depth_m;
  long most = 0;
  for (int i = 0; i < 12; ++i) {
    Frame& frame = frames[static_cast<std::size_t>(i % 2)];
    frame.stamp_s = 0.1 * i;
    std::size_t bodies = 0;
    const long made = allocationsOf([&] { bodies = perception.step(frame).observations.size(); });
    if (i >= 6) most = std::max(most, made - static_cast<long>(bodies) * allocationsOfOutline());
  }
  EXPECT_EQ(perception.step(frames[0]).target.status, TargetStatus::kFollowed);
  return most - 2 * allocationsOfCrop();
}

TEST(PerceptionAllocations, AreNoneOfOurOwnOnceWarm) {
  EXPECT_EQ(allocationsOfStep(SensorKind::kRgbd), 0);
}

TEST(PerceptionAllocations, AreOnlyOpenCvsOnAStereoPair) {
  // Its dilate(), setTo() and resize() allocate inside, how often depends on the number of threads.
  constexpr long kInsideOpenCv = 56;
  EXPECT_LE(allocationsOfStep(SensorKind::kStereo), kInsideOpenCv);
}

}  // namespace
}  // namespace heel
