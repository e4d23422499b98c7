// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/distance_transform.hpp>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

TEST(DistanceTransform, AgreesWithEveryPairOfCells) {
  std::mt19937 random(3);
  for (const double share : {0.002, 0.05, 0.5, 1.0}) {
    const int width = 37;
    const int height = 23;
    std::bernoulli_distribution wall(share);
    std::vector<std::uint8_t> occupied(static_cast<std::size_t>(width * height));
    for (auto& cell : occupied) cell = wall(random) ? 1 : 0;
    occupied[100] = 1;
    std::vector<float> distance_m;
    DistanceTransform transform;
    transform.compute(occupied, width, height, 0.05, distance_m);
    for (int i = 0; i < width * height; ++i) {
      double nearest = 1e9;
      for (int j = 0; j < width * height; ++j) {
        if (occupied[static_cast<std::size_t>(j)] == 0) continue;
        nearest = std::min(nearest, std::hypot(i % width - j % width, i / width - j / width));
      }
      ASSERT_FLOAT_EQ(distance_m[static_cast<std::size_t>(i)], static_cast<float>(0.05 * nearest));
    }
  }
}

TEST(DistanceTransform, AgreesWithOpenCv) {
  std::mt19937 random(4);
  std::bernoulli_distribution wall(0.01);
  const int n = 160;
  std::vector<std::uint8_t> occupied(static_cast<std::size_t>(n * n));
  cv::Mat free(n, n, CV_8UC1, cv::Scalar::all(1));
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = wall(random) ? 1 : 0;
    if (occupied[i] != 0) free.data[i] = 0;
  }
  std::vector<float> distance_m;
  DistanceTransform().compute(occupied, n, n, 1.0, distance_m);
  cv::Mat theirs;
  cv::distanceTransform(free, theirs, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    ASSERT_NEAR(distance_m[i], reinterpret_cast<const float*>(theirs.data)[i], 1e-3);
  }
}

TEST(DistanceTransform, IsInfiniteWhereNothingIsOccupied) {
  std::vector<float> distance_m;
  DistanceTransform().compute({0, 0, 0, 0, 0, 0}, 3, 2, 1.0, distance_m);
  for (const float d : distance_m) EXPECT_TRUE(std::isinf(d));
}

TEST(DistanceTransform, RefusesSizesThatDoNotFit) {
  std::vector<float> out;
  DistanceTransform transform;
  EXPECT_THROW(transform.compute({0, 0, 0}, 2, 2, 1.0, out), std::invalid_argument);
  EXPECT_THROW(transform.compute({}, 0, 0, 1.0, out), std::invalid_argument);
  EXPECT_THROW(transform.compute({0}, 1, 1, 0.0, out), std::invalid_argument);
}

}  // namespace
}  // namespace heel
