// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/follower/acted_scene.hpp"
#include <heel/apps/follower/acquisition.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

using test::ActedScene;

/// One second of empty scene at 5 Hz, then whatever the test acts, on a stage of its own.
class AcquisitionTest : public testing::Test {
 protected:
  AcquisitionTest() {
    AcquisitionParams params;
    params.background_s = 1.0;
    params.person_s = 2.0;
    acquisition = Acquisition(ActedScene().camera, ActedScene::T_base_camera(), params);
    for (int i = 0; i < 6; ++i) act(ActedScene());
  }

  const AcquisitionStep& act(const ActedScene& scene) {
    stamp_s += 0.2;
    return acquisition.step(stamp_s, scene.image, scene.depth);
  }

  static int count(const AcquisitionStep& step, int label) {
    return cv::countNonZero(step.labels == label);
  }

  double stamp_s = 100.0;
  Acquisition acquisition{ActedScene().camera, ActedScene::T_base_camera()};
};

TEST_F(AcquisitionTest, LearnsTheEmptySceneFirst) {
  EXPECT_EQ(acquisition.result().empty_frames, 6);
  EXPECT_TRUE(acquisition.background().empty());
  const AcquisitionStep& step = act(ActedScene());
  EXPECT_EQ(step.state, AcquisitionState::kWaiting);
  EXPECT_FALSE(acquisition.background().empty());
  EXPECT_TRUE(step.usable);
  EXPECT_EQ(count(step, AcquisitionStep::kScene), 160 * 120);
  EXPECT_EQ(acquisition.result().waiting_frames, 1);
  EXPECT_EQ(acquisition.result().confidence(), 0.0);
}

TEST_F(AcquisitionTest, BeginsWithWhoComesBeforeTheEmptyTimeIsUp) {
  AcquisitionParams params;
  params.background_s = 5.0;
  acquisition = Acquisition(ActedScene().camera, ActedScene::T_base_camera(), params);
  for (int i = 0; i < 8; ++i) act(ActedScene());
  EXPECT_FALSE(act(ActedScene().person(2.5, 0.0)).usable);  // but one frame may be noise
  EXPECT_TRUE(act(ActedScene()).usable);
  EXPECT_EQ(acquisition.result().empty_frames, 9);
  for (int i = 0; i < 3; ++i) act(ActedScene().person(2.5, 0.0));
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kEmptyScene);
  const AcquisitionStep& step = act(ActedScene().person(2.5, 0.0));
  EXPECT_EQ(step.state, AcquisitionState::kPerson);
  EXPECT_TRUE(step.usable);
  EXPECT_EQ(acquisition.result().empty_frames, 9);
  EXPECT_TRUE(acquisition.result().was_empty);
}

TEST_F(AcquisitionTest, LabelsTorsoLegsAndRoom) {
  const AcquisitionStep& step = act(ActedScene().person(2.5, 0.0));
  EXPECT_EQ(step.state, AcquisitionState::kPerson);
  EXPECT_TRUE(step.usable);
  ASSERT_EQ(step.person, 0);
  const cv::Rect board = ActedScene().board(2.5, 0.0);
  // Rows up to 59 look up from the camera's 1 m.
  const int torso = board.width * (60 - board.y);
  EXPECT_EQ(count(step, AcquisitionStep::kTorso), torso);
  EXPECT_EQ(count(step, AcquisitionStep::kLegs), board.area() - torso);
  EXPECT_EQ(count(step, AcquisitionStep::kScene), 160 * 120 - board.area());
  EXPECT_EQ(acquisition.result().points, board.area());
}

TEST_F(AcquisitionTest, TheRimThatLooksLikeTheRoomIsUnknown) {
  ActedScene scene = ActedScene().person(2.5, 0.0);
  cv::Rect rim = scene.board(2.5, 0.0);
  rim.width = 3;
  scene.image(rim).setTo(
      cv::Scalar::all(ActedScene::kWall));  // depth says person, colour says wall
  const AcquisitionStep& step = act(scene);
  EXPECT_EQ(count(step, AcquisitionStep::kUnknown), rim.area());
  EXPECT_EQ(cv::countNonZero(step.labels(rim) == AcquisitionStep::kUnknown), rim.area());
}

TEST_F(AcquisitionTest, LearnsClothesInTheWallsColor) {
  const ActedScene scene = ActedScene().person(2.5, 0.0, ActedScene::kWall);
  const AcquisitionStep& step = act(scene);
  EXPECT_EQ(count(step, AcquisitionStep::kTorso) + count(step, AcquisitionStep::kLegs),
            scene.board(2.5, 0.0).area());
}

TEST_F(AcquisitionTest, AShadowIsNeitherPersonNorRoom) {
  ActedScene scene = ActedScene().person(2.5, 0.0);
  const cv::Rect shadow(5, 90, 20, 10);
  scene.image(shadow).setTo(cv::Scalar::all(80));
  const AcquisitionStep& step = act(scene);
  EXPECT_EQ(cv::countNonZero(step.labels(shadow) == AcquisitionStep::kUnknown), shadow.area());
}

TEST_F(AcquisitionTest, EndsWhenItsTimeIsUp) {
  for (int i = 0; i <= 10; ++i) {
    EXPECT_TRUE(act(ActedScene().person(2.5, 0.1 * i)).usable);
    EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
  }
  const AcquisitionStep& step = act(ActedScene().person(2.5, 1.0));
  EXPECT_FALSE(step.usable);
  EXPECT_EQ(step.state, AcquisitionState::kEnded);
  const AcquisitionResult& result = acquisition.result();
  EXPECT_EQ(result.end, AcquisitionEnd::kTimeIsUp);
  EXPECT_EQ(result.person_frames, 11);
  EXPECT_NEAR(result.last_seen_s - result.first_seen_s, 2.0, 1e-9);
  EXPECT_EQ(result.confidence(), 1.0);
}

TEST_F(AcquisitionTest, EndsWhenASecondPersonStaysAndUsesNoFrameWithThem) {
  act(ActedScene().person(2.5, 0.5));
  const long points = acquisition.result().points;
  for (int i = 0; i < 3; ++i) {  // 0.4 s
    EXPECT_FALSE(act(ActedScene().person(3.5, -1.0).person(2.5, 0.6)).usable);
    EXPECT_EQ(acquisition.result().end, AcquisitionEnd::kNotYet);
  }
  const AcquisitionStep& step = act(ActedScene().person(3.5, -1.0).person(2.5, 0.6));
  EXPECT_FALSE(step.usable);
  EXPECT_EQ(step.person, -1);
  EXPECT_EQ(count(step, AcquisitionStep::kTorso), 0);
  EXPECT_EQ(acquisition.result().end, AcquisitionEnd::kSecondPerson);
  EXPECT_EQ(acquisition.result().points, points);
  EXPECT_STREQ(toText(acquisition.result().end), "a second person came into view");
}

TEST_F(AcquisitionTest, SomebodyElsewhereIsASecondPersonToo) {
  act(ActedScene().person(2.5, 0.9));
  act(ActedScene().person(2.5, 0.9));
  for (int i = 0; i < 4; ++i) act(ActedScene().person(3.5, -2.0));  // 3.1 m away
  EXPECT_EQ(acquisition.result().end, AcquisitionEnd::kSecondPerson);
}

TEST_F(AcquisitionTest, BearsAFrameOfNoiseThatLooksLikeASecondPerson) {
  act(ActedScene().person(2.5, 0.5));
  act(ActedScene().person(3.5, -1.0).person(2.5, 0.5));
  EXPECT_TRUE(act(ActedScene().person(2.5, 0.5)).usable);
  act(ActedScene().person(3.5, -1.0).person(2.5, 0.5));
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
}

TEST_F(AcquisitionTest, LearnsOnWhereNoiseLooksLikeASecondPersonForAMoment) {
  for (int k = 0; k < 2; ++k) {
    act(ActedScene().person(2.5, 0.5));
    for (int i = 0; i < 3; ++i) act(ActedScene().person(3.5, -1.0).person(2.5, 0.5));
  }
  act(ActedScene().person(2.5, 0.5));
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
  EXPECT_EQ(acquisition.result().person_frames, 3);
}

TEST_F(AcquisitionTest, DepthThatComesAndGoesOnThePlainWallIsNobody) {
  const auto ghost = [] { return ActedScene().person(3.5, -1.0, ActedScene::kWall); };
  act(ActedScene().person(2.5, 0.5));
  for (int i = 0; i < 4; ++i) {
    const AcquisitionStep& step = act(ghost().person(2.5, 0.5));
    EXPECT_FALSE(step.usable);
    EXPECT_EQ(step.person, -1);
  }
  act(ghost());
  EXPECT_TRUE(act(ActedScene().person(2.5, 0.5)).usable);
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
  EXPECT_EQ(acquisition.result().person_frames, 2);
  EXPECT_EQ(acquisition.result().missed_frames, 1);
}

TEST_F(AcquisitionTest, BeginsAnewWithThePersonAfterAFrameOfNoiseElsewhere) {
  act(ActedScene().person(3.5, -2.0));
  for (int i = 0; i < 3; ++i) act(ActedScene().person(2.5, 0.9));
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
  EXPECT_EQ(acquisition.result().person_frames, 3);
}

TEST_F(AcquisitionTest, AFrameOfNoiseIsNotThePerson) {
  act(ActedScene().person(2.5, 0.5));
  for (int i = 0; i < 7; ++i) act(ActedScene());
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kWaiting);
  EXPECT_EQ(acquisition.result().person_frames, 0);
}

TEST_F(AcquisitionTest, BearsShortGapsAndEndsWhenThePersonHasLeft) {
  act(ActedScene().person(2.5, 0.0));
  act(ActedScene());
  act(ActedScene().person(2.5, 0.2));
  EXPECT_EQ(acquisition.result().missed_frames, 1);
  EXPECT_NEAR(acquisition.result().confidence(), 2.0 / 3.0, 1e-9);
  for (int i = 0; i < 5; ++i) {
    act(ActedScene());
    EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
  }
  act(ActedScene());
  EXPECT_EQ(acquisition.result().end, AcquisitionEnd::kPersonLeft);
  EXPECT_EQ(acquisition.result().person_frames, 2);
  act(ActedScene().person(2.5, 0.0));  // after the end nothing counts
  EXPECT_EQ(acquisition.result().person_frames, 2);
}

TEST_F(AcquisitionTest, ABodyThatDepthBrokeInTwoAlongTheRayIsOnePerson) {
  for (int i = 0; i < 4; ++i) {
    ActedScene scene = ActedScene().person(2.2, 0.5);
    const cv::Rect body = scene.board(2.2, 0.5);
    const cv::Rect lower(body.x, body.y + body.height / 2, body.width, body.height / 2);
    scene.depth(lower).setTo(2.85);
    EXPECT_TRUE(act(scene).usable) << i;
  }
  EXPECT_EQ(acquisition.result().state, AcquisitionState::kPerson);
  EXPECT_EQ(acquisition.result().person_frames, 4);
}

TEST_F(AcquisitionTest, TwoPeopleSideBySideAreTwo) {
  for (int i = 0; i < 4; ++i) act(ActedScene().person(2.5, 0.4).person(2.5, -0.4));
  EXPECT_EQ(acquisition.result().end, AcquisitionEnd::kSecondPerson);
}

TEST_F(AcquisitionTest, OneFarBehindAnotherOnARayIsASecondPerson) {
  const auto scene = [] { return ActedScene().person(3.6, 0.45).person(2.4, 0.0); };
  for (int i = 0; i < 4; ++i) act(scene());
  EXPECT_EQ(acquisition.result().end, AcquisitionEnd::kSecondPerson);
}

TEST_F(AcquisitionTest, RefusesStampsThatRunBackwards) {
  const ActedScene scene;
  EXPECT_THROW(acquisition.step(99.0, scene.image, scene.depth), std::invalid_argument);
  EXPECT_THROW(acquisition.step(std::nan(""), scene.image, scene.depth), std::invalid_argument);
  EXPECT_EQ(acquisition.result().empty_frames, 6);
  EXPECT_EQ(act(scene).state, AcquisitionState::kWaiting);
}

TEST(Acquisition, RefusesSenselessParameters) {
  AcquisitionParams params;
  params.person_s = -1.0;
  EXPECT_THROW(Acquisition(ActedScene().camera, ActedScene::T_base_camera(), params),
               std::invalid_argument);
}

}  // namespace
}  // namespace heel
