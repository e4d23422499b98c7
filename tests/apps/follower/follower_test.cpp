// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/follower/colored_stage.hpp"
#include <heel/apps/follower/follower.hpp>
#include <heel/planning/plan_file.hpp>

#include <gtest/gtest.h>

#include <utility>

namespace heel {
namespace {

/// Looks to the left, and counts.
struct LookLeft : Behaviour {
  struct Calls {
    int begins = 0, steps = 0, notes = 0;
  };
  explicit LookLeft(Calls& its_calls) : calls(its_calls) {}
  void begin(const Situation&) override { ++calls.begins; }
  std::optional<Intent> step(const Situation& now, const Ways&) override {
    ++calls.steps;
    Intent intent;
    intent.look_at = now.robot * Eigen::Vector2d(0.0, 1.0);
    intent.reason = "looks to the left";
    return intent;
  }
  void note(const IntentOutcome&) override { ++calls.notes; }
  Calls& calls;
};

/// A robot in an empty hall that has lost whom it follows, and has no map.
class FollowerTest : public testing::Test {
 protected:
  FollowerTest() {
    RobotDescription robot;
    robot.camera.sensor = SensorKind::kRgbd;
    robot.camera.camera.left = test::ActedScene().camera;
    robot.camera.T_base_camera = test::ActedScene::T_base_camera();
    robot.camera.is_configured = true;
    follower_.emplace(robot, nullptr,
                      loadPlan(HEEL_SOURCE_DIR "/apps/plans/search.pnml", followingVocabulary()),
                      FloorPose{});
    follower_->skipLearning(AppearanceModel({}, test::paintPerson(), test::paintRoom()));
    scan_.first_rad = -M_PI;
    scan_.step_rad = M_PI / 180.0;
    scan_.ranges_m.assign(361, 5.0F);
    for (int i = 0; i < 15; ++i) step(Shows::kSomebody);
    EXPECT_EQ(follower_->target().status, TargetStatus::kFollowed);
    for (int i = 0; i < 50 && follower_->target().hasPlace(); ++i) step();
  }

  enum class Shows { kSomebody, kNobody, kNothing };  // the last: no picture at all

  const FollowStep& step(Shows shows = Shows::kNobody) {
    stamp_s_ += 0.1;
    const test::ColoredStage empty;
    const Frame frame =
        (shows == Shows::kSomebody ? test::ColoredStage().person(2.5, 0.0, test::kRed) : empty)
            .frame(stamp_s_ - image_age_s_);
    RobotReadings readings;
    readings.stamp_s = stamp_s_;
    if (has_scan_) readings.scan = &scan_;
    readings.odometry = FloorPose{};
    if (shows != Shows::kNothing) readings.frame = &frame;
    return follower_->step(readings);
  }

  std::optional<Follower> follower_;
  double image_age_s_ = 0.0;
  bool has_scan_ = true;

 private:
  LaserScan scan_;
  double stamp_s_ = 0.0;
};

TEST_F(FollowerTest, AnActionCanBeDoneInAnotherWay) {
  LookLeft::Calls calls;
  follower_->exchange(FollowingAction::kSearch, std::make_unique<LookLeft>(calls));
  for (int i = 0; i < 200 && calls.steps == 0; ++i) step();
  const FollowStep& now = step();
  EXPECT_EQ(now.action, FollowingAction::kSearch);
  EXPECT_GT(now.velocity.turn_radps, 0.0);
  EXPECT_NE(now.reason.find("looks to the left; turns to look"), std::string::npos)
      << now.reason << "; " << follower_->blindness();
  EXPECT_EQ(calls.begins, 1);
  EXPECT_EQ(calls.notes, calls.steps);
}

TEST_F(FollowerTest, WithoutABehaviourForItTheRobotStands) {
  follower_->exchange(FollowingAction::kSearch, nullptr);
  for (int i = 0; i < 200; ++i) {
    const FollowStep& now = step();
    if (now.action != FollowingAction::kSearch) continue;
    EXPECT_EQ(now.velocity.forward_mps, 0.0);
    EXPECT_EQ(now.velocity.turn_radps, 0.0);
  }
  EXPECT_EQ(step().action, FollowingAction::kSearch);
}

// Bug: each time an image was missing what the robot did began anew.
TEST_F(FollowerTest, ADropoutHoldsWhatItDoes) {
  LookLeft::Calls calls;
  follower_->exchange(FollowingAction::kSearch, std::make_unique<LookLeft>(calls));
  for (int i = 0; i < 200 && calls.steps == 0; ++i) step();
  const int before = calls.steps;
  int stops = 0;
  for (int i = 0; i < 20; ++i)
    stops += step(Shows::kNothing).action == FollowingAction::kStop ? 1 : 0;
  EXPECT_GT(stops, 5) << follower_->blindness();
  for (int i = 0; i < 5; ++i) step();
  EXPECT_EQ(step().action, FollowingAction::kSearch);
  EXPECT_GT(calls.steps, before);
  EXPECT_EQ(calls.begins, 1);
}

// Bug: a target that was followed when all sensors fell silent was followed until they spoke again,
// and had then been seen a moment ago, wherever it was by then.
TEST_F(FollowerTest, NobodyIsFollowedWhileAllSensorsAreSilent) {
  for (int i = 0; i < 15; ++i) step(Shows::kSomebody);
  ASSERT_TRUE(follower_->target().hasPlace());
  has_scan_ = false;
  EXPECT_TRUE(step(Shows::kNothing).target) << "for a moment";
  for (int i = 0; i < 15; ++i) step(Shows::kNothing);
  EXPECT_FALSE(step(Shows::kNothing).target);
  EXPECT_EQ(follower_->target().status, TargetStatus::kLost);
}

// Bug: between two images steps by the laser alone took the tracks' time up to its newest scan; the
// next image was older, and was not looked at.
TEST_F(FollowerTest, ImagesOfASlowCameraCountBesideTheLaser) {
  image_age_s_ = 0.2;
  int images = 0, skipped = 0;
  for (int i = 0; i < 40; ++i) {
    const FollowStep& now = step(i % 4 == 0 ? Shows::kSomebody : Shows::kNothing);
    if (now.perception == nullptr || i < 8) continue;
    ++images;
    skipped += now.perception->reason.find("skipped") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(images, 8);
  EXPECT_EQ(skipped, 0);
}

}  // namespace
}  // namespace heel
