// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/drawn_floor.hpp"
#include <heel/segmentation/world_blobs.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <map>
#include <random>
#include <set>
#include <stdexcept>

namespace heel {
namespace {

using test::allOf;
using test::drawnCloud;
using test::pointAt;

// Every component counts, none is split.
WorldBlobParams plainComponents() {
  WorldBlobParams params;
  params.min_points = 1;
  params.min_area_m2 = 0.0;
  params.max_gap_m = 0.0;
  params.split = false;
  return params;
}

std::vector<WorldBlob> blobsOf(const ColorCloud& cloud, const WorldBlobParams& params) {
  PlanView view;
  view.build(cloud, allOf(cloud));
  WorldBlobFinder finder(params);
  std::vector<WorldBlob> blobs;
  finder.find(view, blobs);
  return blobs;
}

// The front of a standing body: a cylinder of radius 0.2 m and height 1.75 m, seen from the origin
// at 1 m height with focal length 525, one point a pixel.
void addBody(ColorCloud& cloud, double x, double y) {
  const double range = std::hypot(x, y);
  const double step = range / 525.0;
  for (double z = 0.3; z < 1.75; z += step) {
    for (double side = -0.2; side < 0.2; side += step) {
      const double depth = -std::sqrt(0.2 * 0.2 - side * side);
      cloud.push_back(
          pointAt(x + (x * depth - y * side) / range, y + (y * depth + x * side) / range, z));
    }
  }
}

// clang-format off
TEST(WorldBlobs, JoinsCellsAtEdgesAndCorners) {
  const auto blobs = blobsOf(drawnCloud({"55....",
                                         "..5...",
                                         "......",
                                         ".88..7"}), plainComponents());
  ASSERT_EQ(blobs.size(), 3U);
  EXPECT_EQ(blobs[0].cells, 2);  // 1.6 + 1.6: the highest score comes first
  EXPECT_EQ(blobs[1].cells, 3);  // 1 + 1 + 1
  EXPECT_EQ(blobs[2].cells, 1);
}

TEST(WorldBlobs, BridgesGapsUpToTheLimit) {
  const ColorCloud cloud = drawnCloud({"5..5.....5"});  // gaps of 0.1 and 0.25 m
  WorldBlobParams params = plainComponents();
  for (const auto& [gap_m, count] : {std::pair{0.05, 3U}, {0.1, 2U}, {0.2, 2U}, {0.25, 1U}}) {
    params.max_gap_m = gap_m;
    EXPECT_EQ(blobsOf(cloud, params).size(), count) << gap_m;
  }
}

TEST(WorldBlobs, BridgesNothingAcrossTheEdgeOfTheGrid) {
  ColorCloud cloud;  // at the right edge of one row, and at the left edge of the next
  cloud.push_back(pointAt(1.02, -7.99, 1.0));
  cloud.push_back(pointAt(0.97, 7.99, 1.0));
  cloud.push_back(pointAt(-7.99, -7.99, 1.0));
  cloud.push_back(pointAt(7.99, 7.99, 1.0));
  WorldBlobParams params = plainComponents();
  params.max_gap_m = 0.5;
  EXPECT_EQ(blobsOf(cloud, params).size(), 4U);
}

TEST(WorldBlobs, ScoreIsTheSumOfTheCellsGreatestHeights) {
  ColorCloud cloud = drawnCloud({"59",
                                 "8."});
  cloud.push_back(pointAt(1.02, 0.02, 0.4));  // lower than what is in its cell
  const auto blobs = blobsOf(cloud, plainComponents());
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_NEAR(blobs[0].score, (5 + 9 + 8) / 5.0, 1e-6);
  EXPECT_NEAR(blobs[0].max_height_m, 1.8, 1e-6);
  EXPECT_EQ(blobs[0].points, 4);
}

TEST(WorldBlobs, PositionIsTheCentreOfTheSurface) {
  const auto blobs = blobsOf(drawnCloud({"777",
                                         "777",
                                         "777"}), plainComponents());
  ASSERT_EQ(blobs.size(), 1U);
  // The far cells' pixels cover more: 2 x var(x) / d^2 = 2.7 mm.
  EXPECT_NEAR(blobs[0].position_m.x(), 1.0777, 0.0005);
  EXPECT_NEAR(blobs[0].position_m.y(), 0.075, 0.0005);
  // Three cells in line, 0.05 m apart, have a deviation of 0.05 sqrt(2 / 3).
  EXPECT_NEAR(blobs[0].extent_m, 4.0 * 0.05 * std::sqrt(2.0 / 3.0), 0.004);
}

TEST(WorldBlobs, LeavesOutNoise) {
  WorldBlobParams params = plainComponents();
  params.min_points = 3;
  const auto blobs = blobsOf(drawnCloud({"55...5",
                                         "55...5"}), params);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].points, 4);
  params.min_points = 1;
  params.min_area_m2 = 1.0;
  EXPECT_TRUE(blobsOf(drawnCloud({"55", "55"}), params).empty());
}
// clang-format on

TEST(WorldBlobs, AgreesWithConnectedComponentsOfOpenCv) {
  std::mt19937 random(3);
  for (const double density : {0.05, 0.3, 0.45, 0.7}) {
    const PlanView grid({0.1, 3.0});
    cv::Mat drawing = cv::Mat::zeros(grid.width(), grid.width(), CV_8UC1);
    ColorCloud cloud;
    std::bernoulli_distribution there(density);
    for (int r = 1; r + 1 < grid.width(); ++r) {
      for (int c = 1; c + 1 < grid.width(); ++c) {
        if (!there(random)) continue;
        drawing.at<std::uint8_t>(r, c) = 255;
        const Eigen::Vector2d place = grid.center(r * grid.width() + c);
        cloud.push_back(pointAt(place.x(), place.y(), 1.0));
      }
    }
    PlanView view({0.1, 3.0});
    view.build(cloud, allOf(cloud));
    WorldBlobFinder finder(plainComponents());
    std::vector<WorldBlob> blobs;
    finder.find(view, blobs);
    cv::Mat labels;
    const int components = cv::connectedComponents(drawing, labels, 8);
    ASSERT_EQ(static_cast<int>(blobs.size()), components - 1);
    std::set<std::pair<int, int>> pairs;
    for (int r = 0; r < grid.width(); ++r) {
      for (int c = 0; c < grid.width(); ++c) {
        pairs.insert({labels.at<int>(r, c), finder.blobOf(r * grid.width() + c)});
      }
    }
    // One of ours for one of theirs, the empty cells (0 and -1) included.
    EXPECT_EQ(static_cast<int>(pairs.size()), components);
    EXPECT_EQ(pairs.count({0, -1}), 1U);
  }
}

TEST(WorldBlobs, SplitsTwoPeopleWhoTouch) {
  for (const double range : {1.5, 2.5, 4.0}) {
    ColorCloud cloud;
    addBody(cloud, range, 0.21);
    addBody(cloud, range, -0.21);
    WorldBlobParams together;
    together.split = false;
    ASSERT_EQ(blobsOf(cloud, together).size(), 1U) << "they touch at " << range << " m";
    const auto blobs = blobsOf(cloud, {});
    ASSERT_EQ(blobs.size(), 2U) << range;
    for (const WorldBlob& blob : blobs) {
      EXPECT_NEAR(std::abs(blob.position_m.y()), 0.21, 0.05);
      EXPECT_NEAR(blob.position_m.x(), range - 0.16, 0.05);  // its front, not its axis
      EXPECT_TRUE(hasPersonShape(blob, PersonShape::inUnknownScene()));
    }
  }
}

TEST(WorldBlobs, KeepsOnePersonWhole) {
  for (const double range : {1.0, 2.5, 4.0, 6.0}) {
    for (const double y : {-0.7, 0.0, 0.33}) {
      ColorCloud cloud;
      addBody(cloud, range, y);
      EXPECT_EQ(blobsOf(cloud, {}).size(), 1U) << range << ' ' << y;
    }
  }
}

// The cylinder's front is 0.4 x 1.45 m; pixels look square on at it, so they count it within a few
// per cent at any range.
TEST(WorldBlobs, AreaDoesNotDependOnRange) {
  for (const double range : {2.0, 4.0, 6.0}) {
    ColorCloud cloud;
    addBody(cloud, range, 0.0);
    const auto blobs = blobsOf(cloud, {});
    ASSERT_EQ(blobs.size(), 1U);
    EXPECT_NEAR(blobs[0].area_m2, 0.4 * 1.45, 0.15) << range;
  }
}

TEST(WorldBlobs, PartsHoldAllOfTheComponent) {
  ColorCloud cloud;
  addBody(cloud, 2.0, 0.21);
  addBody(cloud, 2.0, -0.21);
  addBody(cloud, 3.5, 1.5);
  PlanView view;
  view.build(cloud, allOf(cloud));
  WorldBlobFinder finder;
  std::vector<WorldBlob> blobs;
  for (int run = 0; run < 2; ++run) {  // the second with used memory
    finder.find(view, blobs);
    int points = 0;
    for (const WorldBlob& blob : blobs) points += blob.points;
    EXPECT_EQ(points, view.points());
    std::map<int, int> cells;
    for (const int cell : view.occupied()) ++cells[finder.blobOf(cell)];
    for (std::size_t i = 0; i < blobs.size(); ++i) {
      EXPECT_EQ(cells[static_cast<int>(i)], blobs[i].cells);
      if (i > 0) {
        EXPECT_GE(blobs[i - 1].score, blobs[i].score);
      }
    }
  }
}

TEST(WorldBlobs, ForgetsTheLastFrame) {
  ColorCloud cloud;
  addBody(cloud, 2.0, 0.0);
  PlanView view;
  view.build(cloud, allOf(cloud));
  WorldBlobFinder finder;
  std::vector<WorldBlob> blobs;
  finder.find(view, blobs);
  const int cell = view.occupied().front();
  EXPECT_EQ(finder.blobOf(cell), 0);
  view.build(ColorCloud(), {});
  finder.find(view, blobs);
  EXPECT_TRUE(blobs.empty());
  EXPECT_EQ(finder.blobOf(cell), -1);
  EXPECT_EQ(finder.blobOf(-1), -1);
}

TEST(WorldBlobs, KnowsAPersonsShape) {
  WorldBlob blob;
  blob.max_height_m = 1.75;
  blob.area_m2 = 0.5;
  blob.extent_m = 0.5;
  EXPECT_TRUE(hasPersonShape(blob, {}));
  EXPECT_TRUE(hasPersonShape(blob, PersonShape::inUnknownScene()));
  WorldBlob wall = blob;
  wall.max_height_m = 2.3;
  EXPECT_FALSE(hasPersonShape(wall, {}));
  WorldBlob chair = blob;
  chair.max_height_m = 0.9;
  EXPECT_FALSE(hasPersonShape(chair, {}));
  WorldBlob cupboard = blob;
  cupboard.extent_m = 1.5;
  EXPECT_FALSE(hasPersonShape(cupboard, {}));
  WorldBlob half_hidden = blob;
  half_hidden.area_m2 = 0.1;
  EXPECT_TRUE(hasPersonShape(half_hidden, {}));
  EXPECT_FALSE(hasPersonShape(half_hidden, PersonShape::inUnknownScene()));
}

TEST(WorldBlobs, PointsInTheCameraItselfHaveAPlace) {
  ColorCloud cloud(20, 1, pointAt(0.0, 0.0, 1.0));
  const auto blobs = blobsOf(cloud, plainComponents());
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_TRUE(blobs[0].position_m.allFinite());
  EXPECT_EQ(blobs[0].extent_m, 0.0);
}

TEST(WorldBlobs, RefusesSenselessParameters) {
  const auto refuses = [](auto change) {
    WorldBlobParams params;
    change(params);
    EXPECT_THROW(WorldBlobFinder{params}, std::invalid_argument);
  };
  refuses([](WorldBlobParams& p) { p.min_points = 0; });
  refuses([](WorldBlobParams& p) { p.min_area_m2 = -1.0; });
  refuses([](WorldBlobParams& p) { p.max_gap_m = -0.1; });
  refuses([](WorldBlobParams& p) { p.max_gap_m = 100.0; });
  refuses([](WorldBlobParams& p) { p.smoothing_m = -0.1; });
  refuses([](WorldBlobParams& p) { p.smoothing_m = std::nan(""); });
  refuses([](WorldBlobParams& p) { p.min_separation_m = -0.1; });
  refuses([](WorldBlobParams& p) { p.max_valley = 1.1; });
}

}  // namespace
}  // namespace heel
