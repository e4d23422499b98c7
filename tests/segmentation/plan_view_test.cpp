// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/drawn_floor.hpp"
#include <heel/segmentation/plan_view.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using test::allOf;
using test::pointAt;

constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(PlanView, CountsEachPointOnceAndKeepsTheGreatestHeight) {
  ColorCloud cloud;
  cloud.push_back(pointAt(1.01, 0.01, 0.5));
  cloud.push_back(pointAt(1.03, 0.04, 1.7));  // the same cell of 0.05 m
  cloud.push_back(pointAt(1.02, 0.02, 0.9));
  cloud.push_back(pointAt(1.02, 0.06, 1.1));  // the next cell to the left
  PlanView view;
  view.build(cloud, allOf(cloud));
  EXPECT_EQ(view.points(), 4);
  ASSERT_EQ(view.occupied().size(), 2U);
  EXPECT_EQ(view[view.occupied()[0]].points, 3);
  EXPECT_FLOAT_EQ(view[view.occupied()[0]].max_height_m, 1.7F);
  EXPECT_EQ(view[view.occupied()[1]].points, 1);
  EXPECT_EQ(view.occupied()[1], view.occupied()[0] + 1);
}

TEST(PlanView, CentersLieHalfACellFromTheirPoints) {
  const PlanView view;
  for (const double x : {-7.9, -0.024, 0.0, 3.333, 7.9}) {
    for (const double y : {-7.9, 0.012, 5.05}) {
      const int cell = view.cellAt(static_cast<float>(x), static_cast<float>(y));
      ASSERT_GE(cell, 0);
      EXPECT_LE(std::abs(view.center(cell).x() - x), 0.0251);
      EXPECT_LE(std::abs(view.center(cell).y() - y), 0.0251);
    }
  }
}

// A pixel of focal length 500 at 2 m covers (2 / 500)^2 m2; the camera is 1.5 m up, as the point.
TEST(PlanView, GivesAPointTheSurfaceOfItsPixel) {
  ColorCloud cloud;
  cloud.push_back(pointAt(2.0, 0.0, 1.5));
  PlanView view({}, {{0.0, 0.0, 1.5}, 500.0});
  view.build(cloud, allOf(cloud));
  EXPECT_NEAR(view[view.occupied().front()].area_m2, 4.0 / 250000.0, 1e-10);
}

TEST(PlanView, LeavesOutWhatHasNoPlaceOnTheGrid) {
  ColorCloud cloud;
  for (const float bad : {kNowhere, kInf, -kInf}) {
    cloud.push_back(pointAt(bad, 0.0, 1.0));
    cloud.push_back(pointAt(1.0, bad, 1.0));
    cloud.push_back(pointAt(1.0, 0.0, bad));
  }
  cloud.push_back(pointAt(8.2, 0.0, 1.0));
  cloud.push_back(pointAt(0.0, -8.2, 1.0));
  cloud.push_back(pointAt(1e30, 1e30, 1.0));
  cloud.push_back(pointAt(1.0, 0.0, -0.1));
  PlanView view;
  view.build(cloud, allOf(cloud));
  EXPECT_EQ(view.points(), 0);
  EXPECT_TRUE(view.occupied().empty());
  view.build(ColorCloud(), {});
  EXPECT_TRUE(view.occupied().empty());
}

TEST(PlanView, UsesOnlyTheIndicesAndForgetsTheLastFrame) {
  ColorCloud cloud;
  cloud.push_back(pointAt(1.0, 0.0, 1.0));
  cloud.push_back(pointAt(2.0, 0.0, 1.5));
  PlanView view;
  view.build(cloud, {0, 0, 1});
  EXPECT_EQ(view.points(), 3);
  view.build(cloud, {1});
  EXPECT_EQ(view.points(), 1);
  ASSERT_EQ(view.occupied().size(), 1U);
  EXPECT_EQ(view[view.occupied().front()].points, 1);
  EXPECT_EQ(view[view.cellAt(1.0F, 0.0F)].points, 0);
}

TEST(PlanView, SumsTheColorScores) {
  const ColorTable red(
      [](std::uint8_t, std::uint8_t, std::uint8_t r) { return r > 127 ? 255 : 0; });
  ColorCloud cloud(3, 1, pointAt(1.0, 0.0, 1.0));
  cloud[0].r = 200;
  cloud[1].r = 10;
  cloud[2].r = 250;
  PlanView view;
  view.build(cloud, allOf(cloud), &red);
  EXPECT_FLOAT_EQ(view[view.occupied().front()].appearance, 2.0F);
}

TEST(PlanView, AgreesWithAMapOfCells) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-9.0, 9.0);
  std::uniform_real_distribution<double> height(0.0, 2.2);
  ColorCloud cloud;
  for (int i = 0; i < 20000; ++i) {
    cloud.push_back(pointAt(place(random), place(random), height(random)));
  }
  PlanView view({0.1, 8.0});
  view.build(cloud, allOf(cloud));
  std::map<int, std::pair<int, float>> oracle;
  int points = 0;
  for (const auto& p : cloud) {
    if (std::abs(p.x) >= 8.0F || std::abs(p.y) >= 8.0F) continue;
    auto& cell = oracle[view.cellAt(p.x, p.y)];
    ++cell.first;
    cell.second = std::max(cell.second, p.z);
    ++points;
  }
  EXPECT_EQ(view.points(), points);
  ASSERT_EQ(view.occupied().size(), oracle.size());
  for (const auto& [cell, expected] : oracle) {
    EXPECT_EQ(view[cell].points, expected.first);
    EXPECT_EQ(view[cell].max_height_m, expected.second);
  }
}

TEST(PlanView, RefusesSenselessParameters) {
  EXPECT_THROW(PlanView({0.0, 8.0}), std::invalid_argument);
  EXPECT_THROW(PlanView({-0.05, -8.0}), std::invalid_argument);
  EXPECT_THROW(PlanView({0.05, -1.0}), std::invalid_argument);
  EXPECT_THROW(PlanView({1e-5, 8.0}), std::invalid_argument);
  EXPECT_THROW(PlanView({0.05, std::nan("")}), std::invalid_argument);
  EXPECT_THROW(PlanView({}, {{0.0, 0.0, 1.0}, 0.0}), std::invalid_argument);
  EXPECT_THROW(PlanView({}, {{std::nan(""), 0.0, 1.0}, 500.0}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
