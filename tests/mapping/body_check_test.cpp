// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/mapping/drawn_bodies.hpp"
#include <heel/mapping/body_check.hpp>
#include <heel/mapping/obstacle_layer.hpp>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

using test::DrawnBox;
using test::drawnClearance;
using test::drawWall;
using test::occupiedBoxes;

constexpr double kTolerance_m = 1e-4;  // of FCL's iterations
constexpr double kInfinite = std::numeric_limits<double>::infinity();

RobotBody boxBody() {
  RobotBody body;
  body.footprint = BoxFootprint{0.5, 0.3, 0.1};
  return body;
}

/// A layer around the origin that has seen these points, three times each.
ObstacleLayer layerOf(std::vector<Eigen::Vector3f> points) {
  ObstacleLayer layer;
  layer.begin(0.0, {});
  for (int i = 0; i < 3; ++i) layer.addPoints(points);
  layer.finish();
  return layer;
}

/// The layer's columns, as boxes as high as the body.
std::vector<DrawnBox> columns(const ObstacleLayer& layer, const RobotBody& body) {
  const double half = layer.params().cell_size_m / 2.0;
  std::vector<DrawnBox> boxes;
  for (const auto& p : layer.obstacles()) {
    boxes.push_back(
        {{p.x() - half, p.y() - half, body.bottom_m}, {p.x() + half, p.y() + half, body.top_m}});
  }
  return boxes;
}

TEST(BodyCheck, MeasuresACylindersClearanceToAWall) {
  octomap::OcTree tree(0.1);
  drawWall(tree, {{1.0, -2.0, 0.0}, {1.2, 2.0, 2.0}});
  RobotBody body;
  body.footprint = RoundFootprint{0.3};
  const BodyCheck check(body, tree);
  for (const double gap : {0.5, 0.2, 0.01, 0.001}) {
    const FloorPose pose{{0.7 - gap, 0.13}, 0.4};
    EXPECT_NEAR(check.clearance(pose), gap, kTolerance_m);
    EXPECT_FALSE(check.collides(pose));
    EXPECT_FALSE(check.collides(pose, gap - 5e-4));
    EXPECT_TRUE(check.collides(pose, gap + 5e-4));
  }
  EXPECT_TRUE(check.collides({{0.71, 0.13}, 0.4}));
  EXPECT_DOUBLE_EQ(check.clearance({{0.71, 0.13}, 0.4}), 0.0);
}

TEST(BodyCheck, PassesUnderALintelAndOverASill) {
  octomap::OcTree tree(0.05);
  drawWall(tree, {{-1.0, -1.0, 1.5}, {1.0, 1.0, 1.6}});
  drawWall(tree, {{-1.0, -1.0, 0.0}, {1.0, 1.0, 0.05}});
  RobotBody body;
  body.bottom_m = 0.1;
  const BodyCheck check(body, tree);
  EXPECT_FALSE(check.collides({}));
  EXPECT_NEAR(check.clearance({}), 0.05, kTolerance_m);
  body.top_m = 1.55;
  EXPECT_TRUE(BodyCheck(body, tree).collides({}));
}

// The truth goes through every occupied leaf in closed form.
class BodyCheckOracle : public ::testing::TestWithParam<int> {};

TEST_P(BodyCheckOracle, AgreesOnRandomPoses) {
  const bool grid_aligned = GetParam() % 2 == 1;
  const octomap::OcTree tree = test::drawRoom(static_cast<unsigned>(GetParam()), 0.1);
  const auto boxes = occupiedBoxes(tree);
  ASSERT_GT(boxes.size(), 300U);
  std::mt19937 random(static_cast<unsigned>(GetParam()) + 100);
  std::uniform_real_distribution<double> place(-2.9, 2.9);
  std::uniform_int_distribution<int> quarter(-2, 2);
  int touching = 0;
  for (const RobotBody& body : {RobotBody(), boxBody()}) {
    const BodyCheck check(body, tree);
    for (int i = 0; i < 400; ++i) {
      FloorPose pose{{place(random), place(random)}, place(random)};
      if (grid_aligned) {
        pose = {{std::round(pose.position.x() * 20.0) / 20.0,
                 std::round(pose.position.y() * 20.0) / 20.0},
                quarter(random) * 1.5707963267948966};
      }
      const double truth = drawnClearance(body, pose, boxes);
      ASSERT_NEAR(check.clearance(pose), truth, kTolerance_m)
          << pose.position.transpose() << " " << pose.yaw_rad;
      ASSERT_NEAR(check.clearance(pose, 0.1), std::min(truth, 0.1), kTolerance_m);
      if (truth > 0.0 && truth < kTolerance_m) continue;
      touching += truth == 0.0 ? 1 : 0;
      // Bodies that only touch may be called either.
      RobotBody smaller = body;
      if (grid_aligned && truth == 0.0) {
        if (auto* round = std::get_if<RoundFootprint>(&smaller.footprint)) {
          round->radius_m -= kTolerance_m;
        } else {
          auto& box = std::get<BoxFootprint>(smaller.footprint);
          box.length_m -= kTolerance_m;
          box.width_m -= kTolerance_m;
        }
        if (drawnClearance(smaller, pose, boxes) > 0.0) continue;
      }
      ASSERT_EQ(check.collides(pose), truth == 0.0)
          << pose.position.transpose() << " " << pose.yaw_rad << " " << truth;
    }
  }
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 750);
}

INSTANTIATE_TEST_SUITE_P(Rooms, BodyCheckOracle, ::testing::Range(0, 4));

TEST(BodyCheck, AgreesWithEveryColumnOfALayer) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-3.0F, 3.0F);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(place(random), place(random), 0.7F);
  const ObstacleLayer layer = layerOf(points);
  const octomap::OcTree nothing(0.1);
  int touching = 0;
  for (const RobotBody& body : {RobotBody(), boxBody()}) {
    const BodyCheck check(body, nothing);
    const auto boxes = columns(layer, body);
    for (int i = 0; i < 500; ++i) {
      // Also beyond the window's border.
      const FloorPose pose{{1.5 * place(random), 1.5 * place(random)}, place(random)};
      const double truth = drawnClearance(body, pose, boxes);
      ASSERT_NEAR(check.clearance(pose, layer), truth, kTolerance_m);
      ASSERT_NEAR(check.clearance(pose, layer, 0.2), std::min(truth, 0.2), kTolerance_m);
      if (truth > 0.0 && truth < kTolerance_m) continue;
      touching += truth == 0.0 ? 1 : 0;
      ASSERT_EQ(check.collides(pose, layer), truth == 0.0);
    }
  }
  EXPECT_GT(touching, 50);
}

TEST(BodyCheck, TakesTheNearerOfWallsAndObstacles) {
  octomap::OcTree tree(0.1);
  drawWall(tree, {{1.0, -2.0, 0.0}, {1.2, 2.0, 2.0}});
  const BodyCheck check({}, tree);
  const ObstacleLayer layer = layerOf({{-0.725F, 0.025F, 0.7F}});
  EXPECT_NEAR(check.clearance({}, layer), 0.70 - 0.26, kTolerance_m);
  EXPECT_NEAR(check.clearance({{0.3, 0.0}, 0.0}, layer), 0.70 - 0.26, kTolerance_m);
  EXPECT_TRUE(check.collides({{-0.5, 0.0}, 0.0}, layer));
  EXPECT_FALSE(check.collides({{-0.5, 0.0}, 0.0}));
  EXPECT_TRUE(check.collides({{0.8, 0.0}, 0.0}, layer));
}

TEST(BodyCheck, FindsWhereAPathCollides) {
  octomap::OcTree tree(0.05);
  drawWall(tree, {{1.0, -2.0, 0.0}, {1.05, 2.0, 2.0}});
  const BodyCheck check({}, tree);
  const std::vector<FloorPose> along = {{{0.0, -1.0}, 0.0}, {{0.0, 0.0}, 0.0}, {{0.0, 1.0}, 0.0}};
  EXPECT_EQ(check.firstCollision(along), std::nullopt);
  EXPECT_EQ(check.firstCollision({}), std::nullopt);
  // Clear poses on both sides of a thin wall.
  const std::vector<FloorPose> through = {{{0.0, 0.0}, 0.0}, {{0.5, 0.0}, 0.0}, {{1.6, 0.0}, 0.0}};
  EXPECT_FALSE(check.collides(through[1]));
  EXPECT_FALSE(check.collides(through[2]));
  EXPECT_EQ(check.firstCollision(through), 2U);
  EXPECT_EQ(check.firstCollision({through[0], {{0.9, 0.0}, 0.0}}), 1U);
  EXPECT_EQ(check.firstCollision({{{1.0, 0.0}, 0.0}}), 0U);
  // Only with the layer.
  const ObstacleLayer layer = layerOf({{0.02F, 0.52F, 0.7F}});
  EXPECT_EQ(check.firstCollision(along, &layer), 2U);
  // Only with a margin.
  EXPECT_EQ(check.firstCollision(along, nullptr, 0.7), std::nullopt);
  EXPECT_EQ(check.firstCollision(along, nullptr, 0.75), 0U);
}

TEST(BodyCheck, SeesABoxesCornersSwingByWhileItTurns) {
  octomap::OcTree tree(0.05);
  drawWall(tree, {{0.3, 0.05, 0.0}, {0.35, 0.1, 2.0}});
  RobotBody body;
  body.footprint = BoxFootprint{0.9, 0.05, 0.0};
  const BodyCheck check(body, tree);
  EXPECT_FALSE(check.collides({{0, 0}, 0.0}));
  EXPECT_FALSE(check.collides({{0, 0}, 1.5}));
  EXPECT_EQ(check.firstCollision({{{0, 0}, 0.0}, {{0, 0}, 1.5}}), 1U);
  EXPECT_EQ(check.firstCollision({{{0, 0}, 0.0}, {{0, 0}, -1.5}}), std::nullopt);
}

TEST(BodyCheck, RefusesWhatIsNoBodyAndNoPose) {
  const octomap::OcTree tree(0.1);
  RobotBody flat;
  flat.top_m = flat.bottom_m;
  EXPECT_THROW(BodyCheck(flat, tree), std::invalid_argument);
  RobotBody thin;
  thin.footprint = RoundFootprint{0.0};
  EXPECT_THROW(BodyCheck(thin, tree), std::invalid_argument);
  thin.footprint = BoxFootprint{0.5, kInfinite, 0.0};
  EXPECT_THROW(BodyCheck(thin, tree), std::invalid_argument);
  const BodyCheck check({}, tree);
  EXPECT_THROW(check.collides({{std::nan(""), 0.0}, 0.0}), std::invalid_argument);
  EXPECT_THROW(check.collides({}, -0.1), std::invalid_argument);
  EXPECT_THROW(check.clearance({{0.0, 0.0}, kInfinite}), std::invalid_argument);
  EXPECT_THROW(check.clearance({}, std::nan("")), std::invalid_argument);
  EXPECT_THROW(check.firstCollision({{}}, nullptr, 0.0, 0.0), std::invalid_argument);
}

// ---- Faults and surprises of FCL 0.7 and OctoMap 1.9, none of which may come through ----

TEST(BodyCheckTraps, AnEmptyTreeIsFreeInsteadOfANullPointer) {
  octomap::OcTree tree(0.1);
  const BodyCheck empty({}, tree);
  EXPECT_FALSE(empty.collides({}));
  EXPECT_EQ(empty.clearance({}), kInfinite);
  EXPECT_EQ(empty.clearance({}, 2.0), 2.0);
  tree.updateNode(0.05, 0.05, 0.5, true);
  tree.clear();
  EXPECT_EQ(BodyCheck({}, tree).clearance({}), kInfinite);
  EXPECT_EQ(BodyCheck({}, tree).clearance({}, ObstacleLayer()), kInfinite);
}

TEST(BodyCheckTraps, ATreeOfFreeSpaceIsInfinitelyClear) {
  octomap::OcTree tree(0.1);
  tree.setNodeValue(0.05, 0.05, 0.5, tree.getClampingThresMinLog());
  EXPECT_FALSE(BodyCheck({}, tree).collides({}));
  EXPECT_EQ(BodyCheck({}, tree).clearance({}), kInfinite);
}

TEST(BodyCheckTraps, UnknownSpaceDoesNotCollide) {
  octomap::OcTree tree(0.1);
  drawWall(tree, {{5.0, 5.0, 0.0}, {5.1, 5.1, 2.0}});
  EXPECT_EQ(tree.search(0.05, 0.05, 0.5), nullptr);
  EXPECT_FALSE(BodyCheck({}, tree).collides({}));
}

TEST(BodyCheckTraps, ACollisionHasNoClearanceRatherThanMinusOne) {
  octomap::OcTree tree(0.1);
  drawWall(tree, {{-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}});
  EXPECT_EQ(BodyCheck({}, tree).clearance({}), 0.0);
  EXPECT_EQ(BodyCheck(boxBody(), tree).clearance({}), 0.0);
  const ObstacleLayer layer = layerOf({{0.2F, 0.0F, 0.7F}});
  EXPECT_EQ(BodyCheck({}, octomap::OcTree(0.1)).clearance({}, layer), 0.0);
}

TEST(BodyCheckTraps, TheTreeIsTakenAsItIsWithItsThreshold) {
  octomap::OcTree tree(0.1);
  tree.setOccupancyThres(0.8);
  tree.setNodeValue(0.05, 0.05, 0.55, octomap::logodds(0.7));
  const BodyCheck strict({}, tree);
  EXPECT_FALSE(strict.collides({}));
  tree.setOccupancyThres(0.6);
  EXPECT_FALSE(strict.collides({}));
  EXPECT_TRUE(BodyCheck({}, tree).collides({}));
  drawWall(tree, {{-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}});
  EXPECT_FALSE(strict.collides({}));
}

TEST(BodyCheckTraps, SeesWallsThatWereInsertedLazily) {
  octomap::OcTree tree(0.1);
  // Free first, so that the inner nodes exist and are free; the wall then only changes a leaf.
  for (int i = 0; i < 4; ++i) tree.updateNode(0.05, 0.05, 0.55, false);
  for (int i = 0; i < 20; ++i) tree.updateNode(0.05, 0.05, 0.55, true, true);
  ASSERT_FALSE(tree.isNodeOccupied(tree.getRoot()));
  EXPECT_TRUE(BodyCheck({}, tree).collides({}));
  EXPECT_EQ(BodyCheck({}, tree).clearance({}), 0.0);
}

TEST(BodyCheckTraps, FclsDefaultSolverSaysTooMuchForABoxByAnOctreeAndOursDoesNot) {
  double worst_theirs = 0.0;
  double worst_ours = 0.0;
  for (unsigned seed = 0; seed < 2; ++seed) {
    const octomap::OcTree tree = test::drawRoom(seed, 0.1);
    const auto boxes = occupiedBoxes(tree);
    const fcl::OcTreed theirs(std::make_shared<const octomap::OcTree>(tree));
    RobotBody body;
    body.footprint = BoxFootprint{0.5, 0.4, 0.0};
    body.bottom_m = 0.0;
    const BodyCheck check(body, tree);
    const fcl::Boxd shape(0.5, 0.4, body.top_m - body.bottom_m);
    for (double x = -2.5; x < 2.5; x += 0.25) {
      for (double y = -2.5; y < 2.5; y += 0.25) {
        const FloorPose pose{{x, y}, 1.5707963267948966};
        const double truth = drawnClearance(body, pose, boxes);
        worst_ours = std::max(worst_ours, std::abs(check.clearance(pose) - truth));
        fcl::Transform3d placed = basePose(pose);
        placed.translation().z() = (body.bottom_m + body.top_m) / 2.0;
        fcl::DistanceResultd result;
        fcl::distance(&shape, placed, &theirs, fcl::Transform3d::Identity(),
                      fcl::DistanceRequestd(), result);
        if (truth > 0.0) worst_theirs = std::max(worst_theirs, result.min_distance - truth);
      }
    }
  }
  EXPECT_LT(worst_ours, kTolerance_m);
  // The control: should this fail, FCL has been mended, and the default solver may serve.
  EXPECT_GT(worst_theirs, 0.01);
}

}  // namespace
}  // namespace heel
