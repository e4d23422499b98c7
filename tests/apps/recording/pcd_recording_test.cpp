// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/pcl_clouds.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/clouds/pcd_file.hpp>
#include <heel/apps/recording/folders/pcd_recording.hpp>

#include <gmock/gmock.h>
#include <pcl/common/point_tests.h>

#include <algorithm>
#include <limits>

namespace {

using heel::CloudEncoding;
using heel::openRecording;
using heel::test::messageOf;
using heel::test::save;
using heel::test::someCloud;
using heel::test::TempFolder;
using heel::test::writeText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string readMessage(const std::filesystem::path& file) {
  heel::ColorCloud cloud;
  return messageOf([&] { heel::readPcd(file); });
}

class PcdForms : public testing::TestWithParam<CloudEncoding> {
 protected:
  TempFolder folder;
};

TEST_P(PcdForms, GiveTheSamePointsAndColours) {
  const auto expectSame = [&](const auto& written) {
    save(folder / "a.pcd", written, GetParam());
    heel::ColorCloud read;
    read = heel::readPcd(folder / "a.pcd").cloud;
    ASSERT_EQ(read.width, written.width);
    ASSERT_EQ(read.height, written.height);
    EXPECT_FALSE(pcl::isFinite(read[0]));
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_EQ(read[i].r, written[i].r);
      EXPECT_EQ(read[i].g, written[i].g);
      EXPECT_EQ(read[i].b, written[i].b);
      if (i > 0) {
        EXPECT_TRUE(read[i].getVector3fMap().isApprox(written[i].getVector3fMap()));
      }
    }
  };
  expectSame(someCloud<pcl::PointXYZRGB>());
  expectSame(someCloud<pcl::PointXYZRGBA>());
  expectSame(someCloud<pcl::PointXYZRGB>(48, 1));
  expectSame(someCloud<pcl::PointXYZRGBNormal>());
}

TEST_P(PcdForms, TruncatedIsAnErrorAtEveryLength) {
  const auto file = folder / "a.pcd";
  save(file, someCloud<pcl::PointXYZRGB>(16, 12), GetParam());
  const std::string whole = heel::test::readText(file);
  ASSERT_EQ(readMessage(file), "");
  // Without its last line's end an ASCII file is still whole.
  for (std::size_t length = 0; length + 40 < whole.size(); length += 1 + length / 9) {
    writeText(file, whole.substr(0, length));
    EXPECT_THAT(readMessage(file), HasSubstr(file.string() + ": ")) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, PcdForms,
                         testing::Values(CloudEncoding::kAscii, CloudEncoding::kBinary,
                                         CloudEncoding::kCompressed));

TEST(PcdFile, SaysWhyItIsOfNoUse) {
  const TempFolder folder;
  const auto file = folder / "a.pcd";
  const std::string name = file.string();
  EXPECT_EQ(readMessage(file), name + ": the cloud is missing");
  writeText(file, "hello\n");
  EXPECT_EQ(readMessage(file), name + ": this is not a PCD file");

  const pcl::PointCloud<pcl::PointXYZ> grey(4, 3);
  save(file, grey, CloudEncoding::kBinary);
  EXPECT_EQ(readMessage(file), name + ": the cloud has no colour (no field rgb or rgba)");
  EXPECT_EQ(messageOf([&] { openRecording(file); }), readMessage(file));

  writeText(file,
            "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F I F F\nCOUNT 1 1 1 1\nWIDTH 1\n"
            "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3 4\n");
  EXPECT_EQ(readMessage(file), name + ": the field y does not hold floats (of 32 or 64 bits)");

  auto cloud = someCloud<pcl::PointXYZRGB>(4, 3);
  for (auto& p : cloud) p.z = std::numeric_limits<float>::quiet_NaN();
  save(file, cloud, CloudEncoding::kCompressed);
  EXPECT_EQ(readMessage(file), name + ": all 12 points of the cloud are NaN");

  save(file, someCloud<pcl::PointXYZRGB>(4, 3), CloudEncoding::kBinary);
  heel::test::truncateBy(file, 100);
  EXPECT_THAT(readMessage(file), HasSubstr("the cloud is truncated ("));

  writeText(file,
            "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 0\n"
            "HEIGHT 1\nPOINTS 0\nDATA ascii\n");
  EXPECT_EQ(readMessage(file), name + ": the cloud is empty (0 points)");
  writeText(file, "FIELDS a b\nSIZE 4 4\nTYPE F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2\n");
  EXPECT_EQ(readMessage(file), name + ": the cloud has no fields x, y and z");
}

TEST(PcdFolder, IsReadInTheOrderOfItsNamesAndLeavesOutTheUseless) {
  const TempFolder folder;
  save(folder / "c.pcd", someCloud<pcl::PointXYZRGB>(8, 6), CloudEncoding::kBinary);
  save(folder / "a.pcd", someCloud<pcl::PointXYZRGBA>(20, 1), CloudEncoding::kAscii);
  save(folder / "b.pcd", pcl::PointCloud<pcl::PointXYZ>(4, 3), CloudEncoding::kBinary);
  writeText(folder / "readme.txt", "not a cloud");
  const auto recording = openRecording(folder.path());
  EXPECT_EQ(recording->info().sensor, heel::SensorKind::kCloud);
  EXPECT_EQ(recording->info().frame_count, 3U);
  EXPECT_TRUE(recording->info().nominal_stamps);
  heel::Frame frame;
  ASSERT_TRUE(recording->next(frame));
  EXPECT_EQ(frame.number, 1U);
  EXPECT_EQ(frame.stamp_s, 0.0);
  EXPECT_THAT(*frame.cloud, SizeIs(20));
  EXPECT_TRUE(frame.image_bgr.empty());
  ASSERT_TRUE(recording->next(frame));
  EXPECT_EQ(frame.number, 3U);
  EXPECT_DOUBLE_EQ(frame.stamp_s, 0.2);
  ASSERT_EQ(frame.image_bgr.size(), cv::Size(8, 6));
  EXPECT_EQ(frame.image_bgr.at<cv::Vec3b>(1, 2), cv::Vec3b(210, 110, 10));
  EXPECT_FALSE(recording->next(frame));
  ASSERT_THAT(recording->skipped(), SizeIs(1));
  EXPECT_THAT(recording->skipped()[0].reason, HasSubstr("b.pcd: the cloud has no colour"));
}

TEST(PcdFolder, TakesTimesFromItsList) {
  const TempFolder folder;
  for (const char* name : {"1.pcd", "2.pcd", "3.pcd"}) {
    save(folder / name, someCloud<pcl::PointXYZRGB>(), CloudEncoding::kBinary);
  }
  writeText(folder / "times.txt", "5.0\n4.0\n6.5\n");
  const auto recording = openRecording(folder.path());
  EXPECT_FALSE(recording->info().nominal_stamps);
  heel::Frame frame;
  std::vector<double> stamps_s;
  while (recording->next(frame)) stamps_s.push_back(frame.stamp_s);
  EXPECT_THAT(stamps_s, ElementsAre(5.0, 6.5));
  EXPECT_THAT(recording->skipped(), SizeIs(1));
}

TEST(PcdFolder, ACloudThatTheCallerKeepsIsNotOverwritten) {
  const TempFolder folder;
  save(folder / "1.pcd", someCloud<pcl::PointXYZRGB>(8, 6), CloudEncoding::kBinary);
  save(folder / "2.pcd", someCloud<pcl::PointXYZRGB>(4, 3), CloudEncoding::kBinary);
  const auto recording = openRecording(folder.path());
  heel::Frame frame;
  ASSERT_TRUE(recording->next(frame));
  const auto kept = frame.cloud;
  ASSERT_TRUE(recording->next(frame));
  EXPECT_THAT(*kept, SizeIs(48));
  EXPECT_THAT(*frame.cloud, SizeIs(12));
}

TEST(RealClouds, AreToldApartByTheirColour) {
  HEEL_NEED_DATA("clouds");
  const auto recording = openRecording(heel::test::dataFolder() / "clouds");
  EXPECT_EQ(recording->info().frame_count, 8U);
  heel::Frame frame;
  std::vector<std::size_t> numbers;
  while (recording->next(frame)) {
    numbers.push_back(frame.number);
    EXPECT_EQ(frame.image_bgr.size(), cv::Size(640, 480)) << frame.name;
    EXPECT_GT(std::count_if(frame.cloud->begin(), frame.cloud->end(),
                            [](const auto& p) { return pcl::isFinite(p); }),
              100000)
        << frame.name;
  }
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 5, 8));
  EXPECT_EQ(recording->skipped().size(), 3U);
  for (const auto& skipped : recording->skipped()) {
    EXPECT_THAT(skipped.reason, HasSubstr("the cloud has no colour"));
  }
}

}  // namespace
