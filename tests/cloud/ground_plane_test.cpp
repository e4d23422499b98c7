// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/ground_plane.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

/// Rectangles in the base frame, seen by a mounted camera.
class Room {
 public:
  explicit Room(const Mounting& mounting) : T_camera_base_(baseFromCamera(mounting).inverse()) {}

  /// Points of corner + a * side1 + b * side2, a and b in [0, 1], with noise.
  Room& patch(const Eigen::Vector3d& corner, const Eigen::Vector3d& side1,
              const Eigen::Vector3d& side2, int points, double noise_m = 0.005) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, noise_m);
    for (int i = 0; i < points; ++i) {
      const Eigen::Vector3d shake(noise(random_), noise(random_), noise(random_));
      const Eigen::Vector3d in_base = corner + share(random_) * side1 + share(random_) * side2;
      pcl::PointXYZRGB p;
      p.getVector3fMap() = (T_camera_base_ * (in_base + shake)).cast<float>();
      cloud_.push_back(p);
    }
    return *this;
  }

  Room& floor(int points = 3000) {
    return patch({1.0, -2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0}, points);
  }
  Room& wall(int points) {
    return patch({5.0, -2.0, 0.0}, {0.0, 4.0, 0.0}, {0.0, 0.0, 2.5}, points);
  }
  Room& table(int points) {
    return patch({1.5, -1.0, 0.75}, {1.5, 0.0, 0.0}, {0.0, 1.5, 0.0}, points);
  }

  std::optional<GroundPlane> estimate(
      const GroundPlaneParams& params = {},
      const std::optional<Eigen::Vector4d>& expected = std::nullopt) const {
    GroundPlaneEstimator estimator(params);
    estimator.add(cloud_);
    return estimator.estimate(expected);
  }

  ColorCloud& cloud() { return cloud_; }

 private:
  Eigen::Isometry3d T_camera_base_;
  ColorCloud cloud_;
  std::mt19937 random_{4};
};

void expectNear(const Mounting& found, const Mounting& truth) {
  EXPECT_NEAR(found.height_m, truth.height_m, 0.01);
  EXPECT_NEAR(found.pitch_rad, truth.pitch_rad, 0.01);
  EXPECT_NEAR(found.roll_rad, truth.roll_rad, 0.01);
}

TEST(GroundPlane, FindsTheMountingOfATiltedCamera) {
  for (const Mounting truth : {Mounting{1.2, 0.0, 0.0}, Mounting{0.5, -0.1, 0.05},
                               Mounting{2.4, 0.47, -0.19}, Mounting{1.0, 0.3, 0.2}}) {
    const auto floor = Room(truth).floor().wall(2000).estimate();
    ASSERT_TRUE(floor);
    expectNear(floor->mounting, truth);
    EXPECT_NEAR(floor->inlier_share, 0.6, 0.05);
    EXPECT_NEAR(floor->rmsHeight(floor->plane), 0.005, 0.002);
    EXPECT_TRUE(floor->T_base_camera.isApprox(baseFromCamera(floor->mounting)));
  }
}

TEST(GroundPlane, IsFoundWhereItIsExpectedThoughLittleOfItIsSeen) {
  const Mounting truth{1.15, 0.09, 0.0};
  Room room(truth);
  room.patch({2.0, -0.5, 0.0}, {1.5, 0.0, 0.0}, {0.0, 1.0, 0.0}, 1500);
  room.patch({1.0, -2.0, 1.2}, {5.0, 0.0, 0.0}, {0.0, 4.0, 0.0}, 38000, 0.4);  // all over it
  GroundPlaneParams params;
  params.min_inlier_share = 0.03;
  const auto isTrue = [&](const std::optional<GroundPlane>& floor) {
    return floor && floor->rmsHeight(baseFromCamera(truth).matrix().row(2)) < 0.02;
  };
  EXPECT_FALSE(isTrue(room.estimate(params))) << "by lot it is not met";
  EXPECT_TRUE(isTrue(room.estimate(params, baseFromCamera({1.17, 0.1, 0.01}).matrix().row(2))));
}

TEST(GroundPlane, IsNotTheTableOrTheWallThoughTheyAreLarger) {
  const Mounting truth{1.4, 0.4, 0.0};
  const auto floor = Room(truth).floor(800).table(2000).wall(1500).estimate();
  ASSERT_TRUE(floor);
  expectNear(floor->mounting, truth);
}

TEST(GroundPlane, IsNotThereWhenOnlyAWallIs) {
  EXPECT_FALSE(Room({1.2, 0.0, 0.0}).wall(3000).estimate());
}

TEST(GroundPlane, IsNotThereForAScatterOfPoints) {
  Room room({1.2, 0.0, 0.0});
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(-2.0F, 2.0F);
  for (int i = 0; i < 3000; ++i) {
    pcl::PointXYZRGB p;
    p.getVector3fMap() << anywhere(random), anywhere(random), anywhere(random) + 3.0F;
    room.cloud().push_back(p);
  }
  EXPECT_FALSE(room.estimate());
}

TEST(GroundPlane, IsNotThereWithoutPoints) {
  EXPECT_FALSE(GroundPlaneEstimator().estimate());
  Room room({1.2, 0.0, 0.0});
  for (int i = 0; i < 5000; ++i) {
    pcl::PointXYZRGB p;
    p.x = p.y = p.z = std::numeric_limits<float>::quiet_NaN();
    room.cloud().push_back(p);
  }
  EXPECT_FALSE(room.estimate());
}

TEST(GroundPlane, BearsPointsBelowTheFloorThatAreFew) {
  const Mounting truth{1.2, 0.2, 0.0};
  const auto floor =
      Room(truth).floor().patch({2.0, -2.0, -1.0}, {3.0, 0, 0}, {0, 4.0, 0}, 200, 0.3).estimate();
  ASSERT_TRUE(floor);
  expectNear(floor->mounting, truth);
}

TEST(GroundPlane, GivesTheSameAnswerTwice) {
  Room room({1.2, 0.2, 0.1});
  room.floor().wall(2000).table(500);
  EXPECT_EQ(room.estimate()->plane, room.estimate()->plane);
}

TEST(GroundPlane, StopsCollectingWhenItHasEnough) {
  GroundPlaneParams params;
  params.max_points = 5000;
  GroundPlaneEstimator estimator(params);
  Room room({1.2, 0.2, 0.1});
  room.floor(4000);
  estimator.add(room.cloud());
  EXPECT_FALSE(estimator.isFull());
  estimator.add(room.cloud());
  EXPECT_TRUE(estimator.isFull());
  EXPECT_EQ(estimator.estimate()->points, 5000U);
}

TEST(GroundPlane, RefusesParametersOutOfRange) {
  GroundPlaneParams params;
  params.inlier_distance_m = 0.0;
  EXPECT_THROW(GroundPlaneEstimator{params}, std::invalid_argument);
  EXPECT_THROW(GroundPlaneEstimator({}, Eigen::Vector3d::Zero()), std::invalid_argument);
}

TEST(Mounting, IsRecoveredFromItsTransform) {
  for (const Mounting m : {Mounting{1.0, 0.3, -0.2}, Mounting{0.4, -0.6, 0.5}}) {
    const Mounting back = mountingOf(baseFromCamera(m));
    EXPECT_DOUBLE_EQ(back.height_m, m.height_m);
    EXPECT_NEAR(back.pitch_rad, m.pitch_rad, 1e-12);
    EXPECT_NEAR(back.roll_rad, m.roll_rad, 1e-12);
  }
}

TEST(Mounting, SignsAreThoseOfRos) {
  const Eigen::Vector3d ahead(0, 0, 1), right(1, 0, 0);
  EXPECT_LT((baseFromCamera({1.0, 0.1, 0.0}).linear() * ahead).z(), 0.0) << "pitch looks down";
  EXPECT_LT((baseFromCamera({1.0, 0.0, 0.1}).linear() * right).z(), 0.0) << "roll lowers the right";
  EXPECT_TRUE((baseFromCamera({1.0, 0.0, 0.0}) * ahead).isApprox(Eigen::Vector3d(1, 0, 1)));
}

TEST(Mounting, IsWarnedOfWhereTheFloorIsNotWhereItShouldBe) {
  const auto floor = Room({1.2, 0.1, 0.0}).floor().wall(2000).estimate();
  ASSERT_TRUE(floor);
  const auto warning = [&](const Mounting& configured) {
    return mountingWarning(*floor, baseFromCamera(configured));
  };
  EXPECT_EQ(warning({1.2, 0.1, 0.0}), "");
  EXPECT_EQ(warning({1.23, 0.1, 0.0}), "");
  EXPECT_EQ(warning({1.33, 0.14, 0.0}), "") << "the same floor at 3 m, where it is seen";
  EXPECT_THAT(warning({1.27, 0.1, 0.0}),
              testing::AllOf(testing::HasSubstr("1.20 m high"), testing::HasSubstr("1.27 m")));
  EXPECT_NE(warning({1.2, 0.05, 0.0}), "");
  EXPECT_NE(warning({1.2, 0.1, 0.05}), "");
}

TEST(GroundPlane, HeightOverAnotherPlaneIsThatOfItsPoints) {
  const Mounting truth{1.2, 0.1, 0.0};
  const auto floor = Room(truth).patch({1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 4000, 0.0).estimate();
  ASSERT_TRUE(floor);
  const Eigen::Vector4d level = baseFromCamera(truth).matrix().row(2);
  EXPECT_NEAR(floor->rmsHeight(level), 0.0, 1e-3);
  EXPECT_NEAR(floor->rmsHeight(level + Eigen::Vector4d(0, 0, 0, 0.2)), 0.2, 1e-3);
  // Pitched about the camera by a small angle a, the height at x is a * x: root of the mean of x^2.
  const Eigen::Vector4d pitched = baseFromCamera({1.2, 0.11, 0.0}).matrix().row(2);
  EXPECT_NEAR(floor->rmsHeight(pitched), 0.01 * std::sqrt(26.0 / 6.0), 1e-3);
}

}  // namespace
}  // namespace heel
