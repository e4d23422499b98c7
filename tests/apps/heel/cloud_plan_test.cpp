// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/heel/planview/cloud_plan.hpp>

#include <gmock/gmock.h>

namespace heel::test {
namespace {

using testing::HasSubstr;

/// A standing box of 0.4 x 0.4 x 1.7 m around (3, 1) of the base frame, seen from `height_m` over
/// the floor, in a frame whose axes are given.
CloudFile standingBox(const Eigen::Matrix3d& R_optical_cloud, double height_m) {
  const Eigen::Isometry3d T_base_optical = baseFromCamera({height_m, 0.0, 0.0});
  CloudFile file;
  for (double z = 0.0; z <= 1.7; z += 0.02) {
    for (double side = -0.2; side <= 0.2; side += 0.02) {
      for (double x = 2.8; x <= 3.2; x += 0.04) {
        const Eigen::Vector2d at(x, 1.0 + side);
        const Eigen::Vector3d optical =
            T_base_optical.inverse() * Eigen::Vector3d(at.x(), at.y(), z);
        pcl::PointXYZRGB point;
        point.getVector3fMap() = (R_optical_cloud.transpose() * optical).cast<float>();
        file.cloud.push_back(point);
      }
    }
  }
  file.facts.width = file.facts.finite_points = file.cloud.size();
  file.facts.height = 1;
  return file;
}

TEST(OpticalFromUp, IsARotationThatTakesUpToUp) {
  for (const std::string up : {"x", "y", "z", "-x", "-y", "-z"}) {
    const Eigen::Matrix3d R = opticalFromUp(up);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12) << up;
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    axis[up.back() - 'x'] = up.size() == 2 ? -1.0 : 1.0;
    EXPECT_TRUE((R * axis).isApprox(-Eigen::Vector3d::UnitY())) << up;
  }
  EXPECT_TRUE(opticalFromUp("-y").isIdentity());
  EXPECT_TRUE((opticalFromUp("z") * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitZ()));
  for (const std::string bad : {"", "w", "zz", "-", "+z"}) {
    EXPECT_THROW(opticalFromUp(bad), std::invalid_argument) << bad;
  }
}

TEST(PlanCloud, FindsTheSameBlobInEveryFrame) {
  for (const std::string up : {"-y", "y", "z"}) {
    CloudPlanParams params;
    params.R_optical_cloud = opticalFromUp(up);
    params.mounting = Mounting{1.2, 0.0, 0.0};
    const CloudPlan plan =
        planCloud("box.pcd", standingBox(params.R_optical_cloud, 1.2), nullptr, params);
    ASSERT_EQ(plan.people(), 1U) << up;
    EXPECT_NEAR(plan.blobs[0].position_m.x(), 3.0, 0.05) << up;
    EXPECT_NEAR(plan.blobs[0].position_m.y(), 1.0, 0.03) << up;
    EXPECT_NEAR(plan.blobs[0].max_height_m, 1.7, 0.03) << up;
  }
}

TEST(PlanCloud, TakesZeroHeightForACloudOfTheWorld) {
  CloudPlanParams params;
  params.R_optical_cloud = opticalFromUp("z");
  params.mounting = Mounting{};
  const CloudPlan plan =
      planCloud("box.pcd", standingBox(params.R_optical_cloud, 0.0), nullptr, params);
  EXPECT_TRUE(plan.T_base_cloud.isApprox(Eigen::Isometry3d::Identity(), 1e-9));
  EXPECT_EQ(plan.people(), 1U);
}

TEST(PlanCloud, WithoutAFloorSaysHowToGiveOne) {
  EXPECT_THAT(messageOf([] {
                planCloud("box.pcd", standingBox(Eigen::Matrix3d::Identity(), 1.2), nullptr, {});
              }),
              testing::AllOf(HasSubstr("box.pcd"), HasSubstr("no floor"), HasSubstr("--height")));
}

TEST(PlanCloud, FindsTheFivePeople) {
  HEEL_NEED_DATA("clouds/five_people.pcd");
  const auto file = dataFolder() / "clouds/five_people.pcd";
  const CloudPlan plan = planCloud(file, readCloud(file), nullptr, {});
  EXPECT_EQ(plan.people(), 5U);
  EXPECT_EQ(plan.floor, FloorSource::kCloud);
  EXPECT_NEAR(plan.mounting.height_m, 1.27, 0.05);
  EXPECT_TRUE(plan.has_camera);
}

}  // namespace
}  // namespace heel::test
