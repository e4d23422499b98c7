// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Our bags against Debian's own ROS libraries, where these are installed.

#include "tests/support/filled_message.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <gmock/gmock.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <regex>
#include <set>

namespace heel {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Ours, class Theirs>
struct Pair {
  using Our = Ours;
  using Their = Theirs;
};
template <class Pair>
class AgainstRos : public testing::Test {};
using Pairs = testing::Types<
    Pair<ImageMsg, sensor_msgs::Image>, Pair<CompressedImageMsg, sensor_msgs::CompressedImage>,
    Pair<CameraInfoMsg, sensor_msgs::CameraInfo>, Pair<PointCloud2Msg, sensor_msgs::PointCloud2>,
    Pair<LaserScanMsg, sensor_msgs::LaserScan>, Pair<OdometryMsg, nav_msgs::Odometry>,
    Pair<PathMsg, nav_msgs::Path>, Pair<OccupancyGridMsg, nav_msgs::OccupancyGrid>,
    Pair<TFMessageMsg, tf2_msgs::TFMessage>, Pair<PoseArrayMsg, geometry_msgs::PoseArray>,
    Pair<PoseStampedMsg, geometry_msgs::PoseStamped>,
    Pair<TwistStampedMsg, geometry_msgs::TwistStamped>, Pair<StringMsg, std_msgs::String>,
    Pair<DiagnosticArrayMsg, diagnostic_msgs::DiagnosticArray>,
    Pair<MarkerArrayMsg, visualization_msgs::MarkerArray>>;
TYPED_TEST_SUITE(AgainstRos, Pairs);

/// A definition's parts by their names, without comments, blanks and packages.
std::set<std::string> partsOf(std::string text) {
  text = std::regex_replace(text, std::regex("[ \t]*#[^\n]*"), "");
  text = std::regex_replace(
      text, std::regex("(std|geometry|sensor|nav|visualization|diagnostic)_msgs/"), "");
  text = std::regex_replace(text, std::regex("[ \t]+"), " ");
  text = std::regex_replace(text, std::regex(" ?= ?"), "=");
  text = std::regex_replace(text, std::regex(" ?\n[ \n]*"), "\n");
  std::set<std::string> parts;
  const std::regex line("=+\n");
  for (std::sregex_token_iterator it(text.begin(), text.end(), line, -1), end; it != end; ++it) {
    std::string part = *it;
    part.erase(0, part.find_first_not_of('\n'));
    while (!part.empty() && part.back() == '\n') part.pop_back();
    parts.insert(part);
  }
  return parts;
}

TYPED_TEST(AgainstRos, TheTypeItsSumAndItsDefinitionAreRos) {
  using Our = typename TypeParam::Our;
  using Their = typename TypeParam::Their;
  EXPECT_STREQ(Our::kType, ros::message_traits::datatype<Their>());
  EXPECT_STREQ(Our::kMd5, ros::message_traits::md5sum<Their>());
  EXPECT_EQ(partsOf(definitionOf<Our>(BagForm::kRos1)),
            partsOf(ros::message_traits::definition<Their>()));
}

TYPED_TEST(AgainstRos, RosReadsOurBytesAndWritesTheSame) {
  Bytes bytes;
  writeMessage(BagForm::kRos1, test::filled<typename TypeParam::Our>(), bytes);
  typename TypeParam::Their theirs;
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, theirs);
  EXPECT_EQ(in.getLength(), 0U);
  Bytes again(ros::serialization::serializationLength(theirs));
  ros::serialization::OStream out(again.data(), static_cast<std::uint32_t>(again.size()));
  ros::serialization::serialize(out, theirs);
  EXPECT_EQ(again, bytes);
}

TEST(Rosbag, AppendsToWhatWeWrite) {
  const test::TempFolder folder;
  const auto path = folder / "a.bag";
  const auto writer = createBag(path);
  for (int i = 1; i <= 50; ++i) {
    writer->write("/odom", i * 1000000000LL, test::filled<OdometryMsg>());
  }
  writer->commit();
  {
    rosbag::Bag bag(path.string(), rosbag::bagmode::Append);
    bag.write("/odom", ros::Time(60.0), nav_msgs::Odometry());
  }
  rosbag::Bag bag(path.string());
  int count = 0;
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& m : view) {
    EXPECT_NE(m.instantiate<nav_msgs::Odometry>(), nullptr);
    ++count;
  }
  EXPECT_EQ(count, 51);
}

TEST(Rosbag, ReadsWhatWeWrite) {
  const test::TempFolder folder;
  const auto path = folder / "a.bag";
  const auto writer = createBag(path);
  for (int i = 1; i <= 50; ++i) {
    auto image = test::filled<ImageMsg>();
    image.height = static_cast<std::uint32_t>(i);
    image.data.resize(100000);
    writer->write("/image", i * 1000000000LL, image);
    writer->write("/odom", i * 1000000000LL + 5, test::filled<OdometryMsg>());
  }
  writer->commit();
  rosbag::Bag bag(path.string());
  rosbag::View view(bag);
  EXPECT_EQ(view.size(), 100U);
  EXPECT_EQ(view.getConnections().size(), 2U);
  std::uint32_t height = 0;
  for (const rosbag::MessageInstance& m : view) {
    if (m.getTopic() != "/image") continue;
    const auto image = m.instantiate<sensor_msgs::Image>();
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(image->height, ++height);
    EXPECT_EQ(m.getTime().toNSec(), height * 1000000000ULL);
  }
  EXPECT_EQ(height, 50U);
}

class RosbagPacked : public testing::TestWithParam<rosbag::CompressionType> {};
INSTANTIATE_TEST_SUITE_P(By, RosbagPacked,
                         testing::Values(rosbag::compression::Uncompressed,
                                         rosbag::compression::BZ2, rosbag::compression::LZ4));

/// 200 scans, in many chunks, written by rosbag.
std::filesystem::path writeWithRosbag(const test::TempFolder& folder,
                                      rosbag::CompressionType compression) {
  const auto path = folder / "theirs.bag";
  rosbag::Bag bag(path.string(), rosbag::bagmode::Write);
  bag.setCompression(compression);
  bag.setChunkThreshold(50000);
  for (std::uint32_t i = 1; i <= 200; ++i) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = ros::Time(i, 7);
    scan.ranges.resize(1000);
    for (std::uint32_t k = 0; k < 1000; ++k) scan.ranges[k] = static_cast<float>(i * k % 977);
    bag.write("/scan", scan.header.stamp, scan);
  }
  bag.close();
  return path;
}

std::size_t countWhole(BagReader& bag) {
  BagMessage raw;
  LaserScanMsg scan;
  std::size_t count = 0;
  while (bag.next(raw)) {
    bag.read(raw, scan);
    ++count;
    EXPECT_EQ(scan.header.stamp.ns, static_cast<std::int64_t>(count) * 1000000000 + 7);
    EXPECT_EQ(scan.ranges.at(999), static_cast<float>(count * 999 % 977));
  }
  return count;
}

TEST_P(RosbagPacked, IsReadByUs) {
  const test::TempFolder folder;
  const auto bag = openBag(writeWithRosbag(folder, GetParam()));
  EXPECT_EQ(countWhole(*bag), 200U);
  EXPECT_EQ(bag->lost(), "");
}

TEST_P(RosbagPacked, ThatIsCutOffGivesItsBeginning) {
  const test::TempFolder folder;
  const auto path = writeWithRosbag(folder, GetParam());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const auto bag = openBag(path);
  const std::size_t count = countWhole(*bag);
  EXPECT_GT(count, 60U);
  EXPECT_LT(count, 140U);
  EXPECT_THAT(bag->lost(), testing::HasSubstr("cut off"));
}

}  // namespace
}  // namespace heel
