// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/follower/acted_scene.hpp"
#include <heel/apps/follower/people_detector.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

using test::ActedScene;

BackgroundModel emptyStage() {
  BackgroundLearner learner;
  learner.add(ActedScene().image, ActedScene().depth);
  return learner.model();
}

TEST(PeopleDetector, FindsEveryoneAtTheirPlace) {
  PeopleDetector detector(ActedScene().camera, ActedScene::T_base_camera());
  const ActedScene scene = ActedScene().person(3.5, 1.0).person(2.5, -0.5);
  const PeopleView& view = detector.detect(emptyStage(), scene.image, scene.depth);
  ASSERT_EQ(view.people.size(), 2U);
  ASSERT_EQ(view.blobs.size(), 2U);
  for (const WorldBlob& blob : view.blobs) {
    const bool near = blob.position_m.x() < 3.0;
    EXPECT_NEAR(blob.position_m.x(), near ? 2.5 : 3.5, 0.03);
    EXPECT_NEAR(blob.position_m.y(), near ? -0.5 : 1.0, 0.03);
    EXPECT_NEAR(blob.max_height_m, 1.75, 0.03);
    EXPECT_NEAR(blob.area_m2, 0.4 * 1.45, 0.1);  // over 0.3 m
  }
}

TEST(PeopleDetector, FindsNobodyOnTheEmptyStage) {
  PeopleDetector detector(ActedScene().camera, ActedScene::T_base_camera());
  const ActedScene busy = ActedScene().person(2.5, 0.0);
  EXPECT_EQ(detector.detect(emptyStage(), busy.image, busy.depth).people.size(), 1U);
  const PeopleView& view = detector.detect(emptyStage(), ActedScene().image, ActedScene().depth);
  EXPECT_TRUE(view.people.empty());
  EXPECT_TRUE(view.blobs.empty());
  EXPECT_TRUE(view.candidates->empty());
}

TEST(PeopleDetector, PointsKnowTheirBlob) {
  PeopleDetector detector(ActedScene().camera, ActedScene::T_base_camera());
  const ActedScene scene = ActedScene().person(2.5, 0.0);
  const PeopleView& view = detector.detect(emptyStage(), scene.image, scene.depth);
  ASSERT_FALSE(view.candidates->empty());
  for (const pcl::index_t i : *view.candidates) {
    EXPECT_EQ(detector.blobOf((*view.cloud)[static_cast<std::size_t>(i)]), 0);
  }
  EXPECT_EQ(detector.blobOf((*view.cloud)[0]), -1);  // a point without position
}

TEST(PeopleDetector, RefusesImagesThatDoNotFit) {
  PeopleDetector detector(ActedScene().camera, ActedScene::T_base_camera());
  const ActedScene scene;
  EXPECT_THROW(detector.detect(BackgroundModel(), scene.image, scene.depth), std::invalid_argument);
  EXPECT_THROW(detector.detect(emptyStage(), scene.image, scene.depth.colRange(0, 80)),
               std::invalid_argument);
}

}  // namespace
}  // namespace heel
