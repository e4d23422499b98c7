// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>
#include <heel/apps/recording/bags/bag_motion.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <gmock/gmock.h>

namespace heel {
namespace {

using test::messageOf;
using test::TempFolder;
using testing::HasSubstr;

constexpr double kSpeed_mps = 0.3;

Eigen::Isometry3d at(double x, double y, double z, double yaw_rad = 0.0) {
  return Eigen::Translation3d(x, y, z) *
         Eigen::Isometry3d(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

class BagMotions : public testing::TestWithParam<const char*> {
 protected:
  BagMotions() : bag_(createBag(folder_ / GetParam())) {}

  static HeaderMsg header(double stamp_s, const std::string& frame) {
    HeaderMsg result;
    result.stamp.ns = nanosecondsOf(stamp_s);
    result.frame_id = frame;
    return result;
  }

  void addTf(double stamp_s, const std::string& parent, const std::string& child,
             const Eigen::Isometry3d& T, const char* topic = "/tf") {
    TFMessageMsg message;
    message.transforms.push_back(toTransform(toPoseMsg(T), header(stamp_s, parent), child));
    bag_->write(topic, recorded_ns_++, message);
  }
  void addStatic(const std::string& parent, const std::string& child, const Eigen::Isometry3d& T) {
    addTf(0.0, parent, child, T, "/tf_static");
  }
  void addOdometry(double stamp_s, const std::string& child, const Eigen::Isometry3d& T,
                   const char* topic = "/odom") {
    OdometryMsg message;
    message.header = header(stamp_s, "odom");
    message.child_frame_id = child;
    message.pose.pose = toPoseMsg(T);
    bag_->write(topic, recorded_ns_++, message);
  }
  void addCameraOnRobot() {
    addStatic("base_footprint", "base_link", at(0, 0, 0.2));
    addStatic("base_link", "optical", at(0.1, 0, 1));
  }

  std::optional<RobotMotion> read(const BagTopics& topics = {}) {
    bag_->commit();
    return BagMotion(surveyBag(folder_ / GetParam()), topics, "optical").read();
  }

  TempFolder folder_;
  std::unique_ptr<BagWriter> bag_;
  std::int64_t recorded_ns_ = 1;
};
INSTANTIATE_TEST_SUITE_P(Forms, BagMotions, testing::Values("r.bag", "r.db3", "r.mcap"));

TEST_P(BagMotions, AHeadThatTremblesHoldsItsCameraFirmly) {
  const auto pitched = [](double rad, double up_m) {
    return at(0, 0, 1 + up_m) * Eigen::Isometry3d(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitY()));
  };
  addStatic("trembling", "optical", at(0.1, 0, 0));
  addStatic("turning", "other", at(0.1, 0, 0));
  addStatic("rising", "third", at(0.1, 0, 0));
  for (int i = 0; i <= 10; ++i) {
    const double trembles = i % 2;
    addTf(0.1 * i, "base_link", "trembling", pitched(0.003 * trembles, 0.0015 * trembles));
    addTf(0.1 * i, "base_link", "turning", pitched(0.0004 * i, 0.0));
    addTf(0.1 * i, "base_link", "rising", pitched(0.0, 0.00025 * i));
    addTf(0.1 * i, "odom", "base_link", at(0.0001 * trembles, 0, 0));
  }
  bag_->commit();
  const BagSurvey survey = surveyBag(folder_ / GetParam());
  const auto T = survey.transform("base_link", "optical");
  ASSERT_TRUE(T);
  EXPECT_TRUE(T->isApprox(at(0.1, 0, 1)));
  EXPECT_FALSE(survey.transform("base_link", "other")) << "0.0040 rad from where it was at first";
  EXPECT_FALSE(survey.transform("base_link", "third")) << "2.5 mm from where it was at first";
  EXPECT_TRUE(survey.frames.at("base_link").moves) << "it tells that the robot stands";
}

TEST_P(BagMotions, ByTfAreThoseOfTheBaseFrame) {
  addCameraOnRobot();
  addStatic("map", "odom", at(5, 5, 0));
  for (int i = 0; i <= 10; ++i) {
    addTf(0.1 * i, "/odom", "/base_footprint", at(1.0 + kSpeed_mps * 0.1 * i, 2, 0, 0.1));
  }
  const auto motion = read();
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->frame_id, "odom");
  EXPECT_FALSE(motion->of_camera);
  EXPECT_EQ(motion->warning, "");
  EXPECT_TRUE(motion->poses.at(0.55)->isApprox(at(1.0 + kSpeed_mps * 0.55, 2, 0, 0.1), 1e-9));
}

TEST_P(BagMotions, OfARobotThatStandsAreNone) {
  addCameraOnRobot();
  for (int i = 0; i <= 10; ++i) addTf(0.1 * i, "odom", "base_footprint", at(1, 2, 0));
  EXPECT_FALSE(read());
}

TEST_P(BagMotions, ByOdometryAreBroughtToTheBaseFrame) {
  addCameraOnRobot();
  for (int i = 0; i <= 10; ++i) addOdometry(0.1 * i, "base_link", at(0.03 * i, 0, 0.2, 0.1 * i));
  const auto motion = read();
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->frame_id, "odom");
  EXPECT_TRUE(motion->poses.at(0.5)->isApprox(at(0.15, 0, 0, 0.5), 1e-9)) << "of base_footprint";
}

TEST_P(BagMotions, AreThoseOfTheOdometryThatIsNamed) {
  addCameraOnRobot();
  for (int i = 0; i <= 10; ++i) {
    addTf(0.1 * i, "odom", "base_footprint", at(0.03 * i, 0, 0));
    addOdometry(0.1 * i, "base_footprint", at(0.02 * i, 0, 0), "/wheels");
  }
  BagTopics topics;
  topics.odometry = "/wheels";
  EXPECT_NEAR(read(topics)->poses.at(1.0)->translation().x(), 0.2, 1e-9);
  topics.odometry = "/legs";
  EXPECT_THAT(messageOf([&] { BagMotion(surveyBag(folder_ / GetParam()), topics, "optical"); }),
              HasSubstr("'/legs'"));
}

TEST_P(BagMotions, GoThroughAllLinksThatMove) {
  addStatic("head", "optical", at(0.1, 0, 0));
  for (int i = 0; i <= 20; ++i) {
    addTf(0.05 * i, "base_link", "head", at(0, 0, 1.2, 0.05 * i));
    if (i % 4 == 0) addTf(0.05 * i, "odom", "base_link", at(0.05 * i, 0, 0));
  }
  const auto motion = read();
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->frame_id, "odom");
  EXPECT_TRUE(motion->of_camera) << "it stands firmly on nothing";
  EXPECT_TRUE(motion->poses.at(0.3)->isApprox(at(0.3, 0, 1.2, 0.3) * at(0.1, 0, 0), 1e-9));
}

TEST_P(BagMotions, AreTakenByTheirStampsInWhateverOrderTheyCome) {
  addCameraOnRobot();
  for (int i = 10; i >= 0; --i) addTf(0.1 * i, "odom", "base_footprint", at(0.03 * i, 0, 0));
  EXPECT_NEAR(read()->poses.at(0.75)->translation().x(), 0.225, 1e-9);
}

TEST_P(BagMotions, HaveTheGapsOfTf) {
  addCameraOnRobot();
  for (const double s : {0.0, 0.5, 1.0, 3.0, 3.5}) {
    addTf(s, "odom", "base_footprint", at(kSpeed_mps * s, 0, 0));
  }
  const auto motion = read();
  EXPECT_TRUE(motion->poses.at(1.0));
  EXPECT_FALSE(motion->poses.at(2.0));
  EXPECT_TRUE(motion->poses.at(3.2));
}

TEST_P(BagMotions, SayThatTheCameraIsNotJoinedToThem) {
  for (int i = 0; i <= 10; ++i) addOdometry(0.1 * i, "base_link", at(0.03 * i, 0, 0));
  const auto motion = read();
  ASSERT_TRUE(motion);
  EXPECT_FALSE(motion->of_camera);
  EXPECT_NEAR(motion->poses.at(1.0)->translation().x(), 0.3, 1e-9);
  EXPECT_THAT(motion->warning, HasSubstr("where the camera is on 'base_link'"));
}

TEST_P(BagMotions, DoNotRunRoundInTfsCircles) {
  addTf(0.0, "a", "optical", at(0, 0, 0));
  addTf(0.0, "optical", "a", at(0, 0, 0));
  addTf(0.1, "a", "optical", at(1, 0, 0));
  addOdometry(0.0, "a", at(0, 0, 0));
  EXPECT_NO_THROW(read());
}

}  // namespace
}  // namespace heel
