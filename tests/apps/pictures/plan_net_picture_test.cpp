// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/pictures/plan_net_picture.hpp>
#include <heel/planning/following_plan.hpp>
#include <heel/planning/plan_file.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <filesystem>

namespace heel {
namespace {

PetriPlan paperPlan() {
  return loadPlan(std::filesystem::path(HEEL_SOURCE_DIR) / "apps/plans/paper.pnml",
                  followingVocabulary());
}

PetriPlan withoutPositions(PetriPlan plan) {
  for (auto& place : plan.net.places) place.graphics = {};
  for (auto& transition : plan.net.transitions) transition.graphics = {};
  return plan;
}

bool hasColor(const cv::Mat& picture, const cv::Scalar& color) {
  cv::Mat is_there;
  cv::inRange(picture, color, color, is_there);
  return cv::countNonZero(is_there) > 20;
}

std::vector<Eigen::Vector2d> allOf(const NetLayout& layout) {
  std::vector<Eigen::Vector2d> nodes = layout.places;
  nodes.insert(nodes.end(), layout.transitions.begin(), layout.transitions.end());
  return nodes;
}

TEST(NetLayout, TakesTheFilesPositions) {
  const PetriPlan plan = paperPlan();
  const NetLayout layout = layoutNet(plan.net);
  ASSERT_EQ(layout.places.size(), plan.net.places.size());
  for (std::size_t p = 0; p < layout.places.size(); ++p) {
    EXPECT_EQ(layout.places[p], *plan.net.places[p].graphics.position);
  }
}

TEST(NetLayout, KeepsNodesApart) {
  for (const PetriPlan& plan : {paperPlan(), withoutPositions(paperPlan())}) {
    const std::vector<Eigen::Vector2d> nodes = allOf(layoutNet(plan.net));
    ASSERT_EQ(nodes.size(), plan.net.places.size() + plan.net.transitions.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) EXPECT_GT((nodes[a] - nodes[b]).norm(), 60.0);
    }
  }
}

TEST(NetLayout, GoesTheWayOfTheTokens) {
  const PetriPlan plan = withoutPositions(paperPlan());
  const NetLayout layout = layoutNet(plan.net);
  EXPECT_EQ(layout.places[0].x(), 0.0);                   // begin
  EXPECT_GT(layout.places[1].x(), 0.0);                   // follow
  EXPECT_GT(layout.places[2].x(), layout.places[1].x());  // face
}

TEST(NetLayout, HasRoomForWhatNoTokenReaches) {
  PetriNet net;
  net.places = {{"p1", "", 1, {}}, {"p2", "", 0, {}}};
  net.transitions = {{"t1", "", {}, {{"a1", 1, 1, {}}}, {}}};
  EXPECT_EQ(layoutNet(net).places.size(), 2U);
  EXPECT_NE(layoutNet(net).places[0], layoutNet(net).places[1]);
}

TEST(PlanNetPicture, ShowsGoalAndFailInTheirColours) {
  for (const PetriPlan& plan : {paperPlan(), withoutPositions(paperPlan())}) {
    const cv::Mat picture = drawPlanNet(plan, "summary");
    EXPECT_GT(picture.cols, 800);
    EXPECT_TRUE(hasColor(picture, palette::kGood));
    EXPECT_TRUE(hasColor(picture, palette::kBad));
    EXPECT_TRUE(hasColor(picture, palette::kTrack));
    EXPECT_FALSE(hasColor(picture, palette::kTarget));
  }
}

}  // namespace
}  // namespace heel
