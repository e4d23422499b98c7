// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/cloud_file.hpp"

#include "tests/support/cloud_files.hpp"

#include <gmock/gmock.h>
#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <limits>

namespace heel::test {
namespace {

using testing::HasSubstr;

/// Eight by six points that all differ; the first is NaN. (Colours, where there are any, too.)
template <typename PointT>
pcl::PointCloud<PointT> someCloud(std::uint32_t width = 8, std::uint32_t height = 6) {
  pcl::PointCloud<PointT> cloud(width, height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto k = static_cast<float>(i);
    cloud[i].getVector3fMap() = Eigen::Vector3f(0.1F * k, -0.2F * k, 1.0F + k);
    if constexpr (pcl::traits::has_color<PointT>::value) {
      cloud[i].r = static_cast<std::uint8_t>(i);
      cloud[i].g = static_cast<std::uint8_t>(100 + i);
      cloud[i].b = static_cast<std::uint8_t>(200 + i);
    }
  }
  cloud[0].getVector3fMap().setConstant(std::numeric_limits<float>::quiet_NaN());
  cloud.is_dense = false;
  return cloud;
}

template <typename PointT>
void save(const std::filesystem::path& file, const pcl::PointCloud<PointT>& cloud,
          CloudEncoding encoding) {
  if (file.extension() == ".ply") {
    pcl::PLYWriter().write(file.string(), cloud, encoding == CloudEncoding::kBinary);
  } else if (encoding == CloudEncoding::kAscii) {
    pcl::PCDWriter().writeASCII(file.string(), cloud, 9);
  } else if (encoding == CloudEncoding::kBinary) {
    pcl::PCDWriter().writeBinary(file.string(), cloud);
  } else {
    pcl::PCDWriter().writeBinaryCompressed(file.string(), cloud);
  }
}

class CloudFormat
    : public testing::TestWithParam<std::tuple<std::string, CloudEncoding, bool, bool>> {};

TEST_P(CloudFormat, IsToldApartFromAllOthers) {
  const auto& [ending, encoding, has_color, is_organized] = GetParam();
  const TempFolder folder;
  const auto file = folder / ("cloud" + ending);
  const std::uint32_t width = is_organized ? 8 : 48, height = is_organized ? 6 : 1;
  if (has_color) {
    save(file, someCloud<pcl::PointXYZRGB>(width, height), encoding);
  } else {
    save(file, someCloud<pcl::PointXYZ>(width, height), encoding);
  }
  const CloudFile cloud = readCloud(file);
  EXPECT_EQ(cloud.facts.format, ending == ".ply" ? "PLY" : "PCD");
  EXPECT_EQ(cloud.facts.encoding, encoding);
  EXPECT_EQ(cloud.facts.color_field.empty(), !has_color);
  EXPECT_EQ(cloud.facts.points(), 48U);
  EXPECT_EQ(cloud.facts.finite_points, 47U);
  EXPECT_EQ(cloud.facts.isOrganized(), is_organized);
  EXPECT_FLOAT_EQ(cloud.cloud[47].z, 48.0F);
  EXPECT_EQ(cloud.cloud[7].g, has_color ? 107 : 0);
}

INSTANTIATE_TEST_SUITE_P(Pcd, CloudFormat,
                         testing::Combine(testing::Values(".pcd"),
                                          testing::Values(CloudEncoding::kAscii,
                                                          CloudEncoding::kBinary,
                                                          CloudEncoding::kCompressed),
                                          testing::Bool(), testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Ply, CloudFormat,
                         testing::Combine(testing::Values(".ply"),
                                          testing::Values(CloudEncoding::kAscii,
                                                          CloudEncoding::kBinary),
                                          testing::Bool(), testing::Values(false)));

TEST(CloudFile, WrittenAsPlyIsReadBackWithItsFields) {
  const TempFolder folder;
  pcl::PointCloud<pcl::PointXYZRGBL> points = someCloud<pcl::PointXYZRGBL>(48, 1);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].label = static_cast<std::uint32_t>(i);
  save(folder / "in.pcd", points, CloudEncoding::kBinary);
  writeCloud(folder / "out.ply", readCloud(folder / "in.pcd"));
  const CloudFile back = readCloud(folder / "out.ply");
  EXPECT_EQ(back.facts.encoding, CloudEncoding::kBinary);
  EXPECT_GE(pcl::getFieldIndex(back.blob, "label"), 0);
  EXPECT_EQ(back.cloud[5].b, 205);
  EXPECT_FLOAT_EQ(back.cloud[5].y, -1.0F);
}

TEST(CloudFile, WrittenAsPlyKeepsItsShapeAndItsColoursWhateverTheirType) {
  const TempFolder folder;
  writeAsciiPcd(folder / "in.pcd",
                {pcdPoint(1, 2, 3, 10, 20, 30), "nan nan nan 0", pcdPoint(4, 5, 6, 40, 50, 60),
                 pcdPoint(7, 8, 9, 70, 80, 90)},
                true, 2);  // rgb is an unsigned number here
  writeCloud(folder / "out.ply", readCloud(folder / "in.pcd"));
  const CloudFile back = readCloud(folder / "out.ply");
  EXPECT_EQ(back.facts.width, 2U);
  EXPECT_EQ(back.facts.height, 2U);
  EXPECT_EQ(back.facts.finite_points, 3U);
  EXPECT_EQ(back.cloud[2].r, 40);
  EXPECT_EQ(back.cloud[3].b, 90);
  EXPECT_EQ(back.cloud[3].z, 9.0F);
}

TEST(CloudFile, WithTooFewValuesInALineNamesThePoint) {
  const TempFolder folder;
  writeAsciiPcd(folder / "a.pcd", {"1.00 2.00 3.00", "4.00 5.00", "6.00 7.00 8.00"}, false);
  EXPECT_THAT(messageOf([&] { readCloud(folder / "a.pcd"); }),
              HasSubstr("point 2 of the cloud has 2 values for 3 fields"));
}

std::string messageFor(const std::filesystem::path& file) {
  return messageOf([&] { readCloud(file); });
}

TEST(CloudFile, OfNoUseSaysWhyInOneSentence) {
  const TempFolder folder;
  EXPECT_THAT(messageFor(folder / "none.pcd"), HasSubstr("missing"));
  EXPECT_THAT(messageFor(folder / "none.ply"), HasSubstr("missing"));
  writeText(folder / "text.pcd", "no cloud");
  EXPECT_THAT(messageFor(folder / "text.pcd"), HasSubstr("not a PCD file"));
  writeText(folder / "text.ply", "no cloud");
  EXPECT_THAT(messageFor(folder / "text.ply"), HasSubstr("not a PLY file"));
  writeText(folder / "zero.ply", "");
  EXPECT_THAT(messageFor(folder / "zero.ply"), HasSubstr("not a PLY file"));
  writeAsciiPcd(folder / "empty.pcd", {});
  EXPECT_THAT(messageFor(folder / "empty.pcd"), HasSubstr("empty"));
  writeAsciiPly(folder / "empty.ply", {});
  EXPECT_THAT(messageFor(folder / "empty.ply"), HasSubstr("empty"));
  writeAsciiPcd(folder / "nan.pcd", {"nan nan nan", "nan 1 nan"}, false);
  EXPECT_THAT(messageFor(folder / "nan.pcd"), HasSubstr("all 2 points of the cloud are NaN"));
}

TEST(CloudFile, ThatEndsTooSoonIsTruncatedWhateverItsEncoding) {
  const TempFolder folder;
  for (const auto& [name, encoding, bytes] :
       std::vector<std::tuple<std::string, CloudEncoding, std::size_t>>{
           {"a.pcd", CloudEncoding::kAscii, 100},
           {"b.pcd", CloudEncoding::kBinary, 1},
           {"c.pcd", CloudEncoding::kCompressed, 1},
           {"b.ply", CloudEncoding::kBinary, 400},
           {"a.ply", CloudEncoding::kAscii, 300}}) {
    save(folder / name, someCloud<pcl::PointXYZRGB>(48, 1), encoding);
    truncateBy(folder / name, bytes);
    EXPECT_THAT(messageFor(folder / name), HasSubstr("truncated")) << name;
    EXPECT_THAT(messageFor(folder / name), HasSubstr(name));
  }
}

TEST(CloudFile, ThatPromisesMorePointsThanItsBytesHoldIsRefusedBeforeTheyAreAllocated) {
  const TempFolder folder;
  writeAsciiPcd(folder / "a.pcd", {"1 2 3"}, false);
  std::string pcd = readText(folder / "a.pcd");
  for (const std::string key : {"WIDTH ", "POINTS "}) {
    pcd.replace(pcd.find(key) + key.size(), 1, "2000000000");
  }
  writeText(folder / "a.pcd", pcd);
  EXPECT_THAT(messageFor(folder / "a.pcd"), HasSubstr("truncated"));
  writeAsciiPly(folder / "a.ply", {"1 2 3"}, false);
  std::string ply = readText(folder / "a.ply");
  ply.replace(ply.find("vertex 1") + 7, 1, "3000000000");
  writeText(folder / "a.ply", ply);
  EXPECT_THAT(messageFor(folder / "a.ply"), HasSubstr("truncated"));
}

}  // namespace
}  // namespace heel::test
