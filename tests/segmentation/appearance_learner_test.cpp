// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/appearance_learner.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace heel {
namespace {

pcl::PointXYZRGB makePoint(float height_m, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  return {2.0F, 0.0F, height_m, r, g, b};
}

TEST(AppearanceLearner, CountsAPointWhereItsHeightIs) {
  AppearanceParams params;
  params.bands = wholeBody();
  AppearanceLearner learner(params);
  ColorCloud cloud;
  cloud.push_back(makePoint(1.7F, 200, 150, 120));  // head
  cloud.push_back(makePoint(1.2F, 180, 30, 40));    // torso
  cloud.push_back(makePoint(1.3F, 180, 30, 40));    // torso
  cloud.push_back(makePoint(0.5F, 20, 20, 90));     // legs
  cloud.push_back(makePoint(0.95F, 1, 1, 1));       // between two bands
  cloud.push_back(makePoint(0.1F, 1, 1, 1));        // feet
  cloud.push_back(makePoint(std::numeric_limits<float>::quiet_NaN(), 1, 1, 1));
  learner.addPerson(cloud, {0, 1, 2, 3, 4, 5, 6});
  EXPECT_EQ(learner.person()[0].total(), 2U);
  EXPECT_EQ(learner.person()[0](40, 30, 180), 2U);
  EXPECT_EQ(learner.person()[1](120, 150, 200), 1U);
  EXPECT_EQ(learner.person()[2](90, 20, 20), 1U);
}

TEST(AppearanceLearner, CountsOnlyTheIndices) {
  AppearanceLearner learner;
  ColorCloud cloud;
  cloud.push_back(makePoint(1.2F, 180, 30, 40));
  cloud.push_back(makePoint(1.2F, 1, 2, 3));
  learner.addPerson(cloud, {1});
  EXPECT_EQ(learner.person()[0].total(), 1U);
  EXPECT_EQ(learner.person()[0](3, 2, 1), 1U);
}

TEST(AppearanceLearner, TakesTheStatureOfWhoStandsThere) {
  AppearanceLearner learner;
  ColorCloud cloud;
  for (float z = 0.1F; z < 1.8F; z += 0.002F) cloud.push_back(makePoint(z, 180, 30, 40));
  for (int i = 0; i < 99; ++i) cloud.push_back({3.0F, 0.0F, 2.1F, 0, 0, 0});  // Somebody else.
  pcl::Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  for (int frame = 0; frame < 6; ++frame) learner.addBody(cloud, all, {2.05, 0.0});
  ASSERT_TRUE(learner.stature());
  EXPECT_NEAR(learner.stature()->height_m, 1.79, 0.01);
  EXPECT_EQ(learner.stature()->frames, 6);
}

TEST(AppearanceLearner, IgnoresWhatIsBelowAllBands) {
  AppearanceParams params;
  params.bands = upperBody();
  AppearanceLearner learner(params);
  ColorCloud cloud;
  cloud.push_back(makePoint(0.99F, 180, 30, 40));
  learner.addPerson(cloud, {0});
  for (const ColorHistogram& band : learner.person()) EXPECT_TRUE(band.empty());
  EXPECT_THROW(learner.learn(), std::invalid_argument);
}

TEST(AppearanceLearner, CountsTheRoomUnderTheMask) {
  AppearanceLearner learner;
  cv::Mat3b image(4, 6, cv::Vec3b(10, 20, 30));
  image(1, 2) = cv::Vec3b(200, 0, 0);
  learner.addRoom(image);
  EXPECT_EQ(learner.room().total(), 24U);
  EXPECT_EQ(learner.room()(200, 0, 0), 1U);
  cv::Mat1b mask(4, 6, std::uint8_t{0});
  mask(1, 2) = 3;
  learner.addRoom(image, mask);
  EXPECT_EQ(learner.room().total(), 25U);
  EXPECT_EQ(learner.room()(200, 0, 0), 2U);
}

TEST(AppearanceLearner, RefusesImagesThatDoNotFit) {
  AppearanceLearner learner;
  EXPECT_THROW(learner.addRoom(cv::Mat1b(4, 6)), std::invalid_argument);
  EXPECT_THROW(learner.addRoom(cv::Mat3b(4, 6), cv::Mat1b(4, 5)), std::invalid_argument);
}

TEST(AppearanceLearner, MakesAModelOfBoth) {
  AppearanceLearner learner;
  ColorCloud cloud;
  pcl::Indices all;
  for (int i = 0; i < 800; ++i) {
    cloud.push_back(makePoint(1.2F, 180, 30, 40));
    all.push_back(i);
  }
  learner.addPerson(cloud, all);
  learner.addRoom(cv::Mat3b(40, 60, cv::Vec3b(200, 210, 220)));
  const AppearanceModel model = learner.learn();
  EXPECT_TRUE(model.bands()[0].table.passes(40, 30, 180));
  EXPECT_FALSE(model.bands()[0].table.passes(200, 210, 220));
  EXPECT_EQ(model.bands()[0].errors().false_negatives, 0U);
  EXPECT_EQ(model.bands()[0].errors().false_positives, 0U);
}

}  // namespace
}  // namespace heel
