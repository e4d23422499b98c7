// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/cloud_files.hpp"
#include "tests/support/pcl_clouds.hpp"
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/cloud/files.hpp>

#include <gmock/gmock.h>
#include <pcl/common/io.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <cstring>
#include <limits>

namespace heel::test {
namespace {

using testing::HasSubstr;

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

TEST(CloudFile, WithColoursThatItCallsSignedHasTheirBytes) {
  const TempFolder folder;
  writeAsciiPcd(folder / "a.pcd", {pcdPoint(1, 2, 3, 10, 20, 30)});
  std::string text = readWholeFile(folder / "a.pcd");
  text.replace(text.find("F F F U"), 7, "F F F I");
  writeText(folder / "a.pcd", text);
  const CloudFile cloud = readCloud(folder / "a.pcd");
  EXPECT_EQ(cloud.facts.color_field, "rgb");
  EXPECT_EQ(cloud.cloud[0].r, 10);
  EXPECT_EQ(cloud.blob.fields[3].datatype, pcl::PCLPointField::UINT32);
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

/// A PCD file with fields x, y, z and one more.
std::string pcdText(const std::string& size, const std::string& count, const std::string& width,
                    const std::string& height, const std::string& points, const std::string& data) {
  return "VERSION .7\nFIELDS x y z a\nSIZE 4 4 4 " + size + "\nTYPE F F F F\nCOUNT 1 1 1 " + count +
         "\nWIDTH " + width + "\nHEIGHT " + height + "\nPOINTS " + points + "\nDATA " + data + "\n";
}

TEST(CloudFile, WhosePcdHeaderPromisesWhatCannotBeIsRefusedBeforePclSeesIt) {
  const TempFolder folder;
  const std::string half = "2147483648";
  const std::vector<std::pair<std::string, std::string>> texts = {
      {pcdText("4", "1", half, half, "1", "binary") + "0123456789abcdef", "POINTS"},
      {pcdText("4", "1", half, half, "0", "binary_compressed") + "0123456789abcdef", "POINTS"},
      {pcdText("4", "-1", "1", "1", "1", "ascii") + "1 2 3 4\n", "COUNT"},
      {pcdText("4", "0", "1", "1", "1", "ascii") + "1 2 3 4\n", "no values"},
      {pcdText("4", "1073741824", "1", "1", "1", "ascii") + "1 2 3 4\n", "4 GiB"},
      {pcdText("4", "1000000000", "1", "1", "1", "ascii") + "1 2 3 4\n", "truncated"},
      {pcdText("4", "1000000000", "1", "1", "1", "binary") + "0123456789abcdef", "truncated"},
      {pcdText(half, "1", "1", "1", "1", "ascii") + "1 2 3 4\n", "no type"},
      {pcdText("3", "1", "1", "1", "1", "ascii") + "1 2 3 4\n", "no type"},
      {pcdText("4", "1", "1", "1", "99999999999", "ascii") + "1 2 3 4\n", "POINTS"},
      {pcdText("4", "1", "1", "1", "1", "packed") + "1 2 3 4\n", "DATA"},
      {pcdText("4", "1", "1", "1", "1", "binary_compressed") +
           std::string("\0\0\0\0\xFF\xFF\xFF\xFF", 8),
       "damaged"}};
  for (const auto& [text, why] : texts) {
    writeText(folder / "a.pcd", text);
    EXPECT_THAT(messageFor(folder / "a.pcd"), HasSubstr(why)) << text;
  }
}

TEST(CloudFile, WithPaddingIsReadHoweverItIsStored) {
  const TempFolder folder;
  writeText(folder / "a.pcd",
            "VERSION .7\nFIELDS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 3 1 1\nWIDTH 2\n"
            "HEIGHT 1\nPOINTS 2\nDATA ascii\n1 0 0 0 2 3\n4 0 0 0 5 6\n");
  EXPECT_EQ(readCloud(folder / "a.pcd").cloud[1].z, 6.0F);
  // Stored by fields, and with a byte before each run of up to 32 that is not compressed.
  const float values[] = {1.0F, 4.0F, 2.0F, 5.0F, 3.0F, 6.0F};
  std::string packed("\x19\0\0\0\x18\0\0\0\x17", 9);
  packed.append(reinterpret_cast<const char*>(values), sizeof values);
  writeText(folder / "c.pcd",
            "VERSION .7\nFIELDS x _ y z\nSIZE 4 1 4 4\nTYPE F U F F\nCOUNT 1 3 1 1\nWIDTH 2\n"
            "HEIGHT 1\nPOINTS 2\nDATA binary_compressed\n" +
                packed);
  const CloudFile cloud = readCloud(folder / "c.pcd");
  EXPECT_EQ(cloud.cloud[0].y, 2.0F);
  EXPECT_EQ(cloud.cloud[1].x, 4.0F);
  EXPECT_EQ(cloud.cloud[1].z, 6.0F);
}

std::string plyText(const std::string& header, const std::string& data) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + data;
}
const std::string kPlace = "property float x\nproperty float y\nproperty float z\n";

TEST(CloudFile, OfPlyIsReadWhateverItsPropertiesAndTheirOrder) {
  const TempFolder folder;
  const auto read = [&](const std::string& header, const std::string& data) {
    writeText(folder / "a.ply", plyText(header, data));
    return readCloud(folder / "a.ply");
  };
  const auto backward = read("element vertex 2\n" + kPlace +
                                 "property uchar blue\nproperty uchar green\nproperty uchar red\n",
                             "1 2 3 30 20 10\n4 5 6 31 21 11\n");
  EXPECT_EQ(backward.cloud[1].r, 11);
  EXPECT_EQ(backward.cloud[1].b, 31);
  const auto some = read("element vertex 1\nproperty uchar diffuse_blue\n" + kPlace +
                             "property char l\nproperty uchar diffuse_red\nproperty double a\n",
                         "30 1 2 3 -4 10 nan\n");
  EXPECT_EQ(some.cloud[0].r, 10);
  EXPECT_EQ(some.cloud[0].g, 0);
  EXPECT_EQ(some.cloud[0].z, 3.0F);
  EXPECT_EQ(some.facts.fields, "rgb x y z l a");
  const auto lists = read("element vertex 2\n" + kPlace + "property list uchar int a\n",
                          "1 2 3 1 5\n4 5 6 2 5 6\n");
  EXPECT_EQ(lists.cloud[1].x, 4.0F);
  EXPECT_EQ(lists.facts.fields, "x y z");
  const auto second =
      read("element face 1\nproperty list uchar int vertex_index\nelement vertex 1\n" + kPlace +
               "property float nx\nproperty uchar alpha\n",
           "3 0 0 0\n1 2 3 4 5\n");
  EXPECT_EQ(second.cloud[0].y, 2.0F);
  EXPECT_EQ(second.facts.fields, "x y z normal_x alpha");
}

/// Two points with places and normals of 64 bits, a colour, and a time that needs them.
pcl::PCLPointCloud2 wideCloud() {
  pcl::PCLPointCloud2 blob;
  const auto add = [&](const std::string& name, std::uint8_t type) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = blob.point_step;
    field.datatype = type;
    field.count = 1;
    blob.fields.push_back(field);
    blob.point_step += static_cast<std::uint32_t>(pcl::getFieldSize(type));
  };
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z", "stamp"}) {
    add(name, pcl::PCLPointField::FLOAT64);
  }
  add("rgba", pcl::PCLPointField::UINT32);
  blob.width = 2;
  blob.height = 1;
  blob.row_step = 2 * blob.point_step;
  for (const double shift : {0.0, 1.0}) {
    const double values[] = {shift + 0.1, shift - 2.25, shift + 3.0,      0.0,
                             -0.5,        1.0,          1700000000.123456};
    const std::uint32_t color = 0xFF0A141E;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
    blob.data.insert(blob.data.end(), bytes, bytes + sizeof values);
    bytes = reinterpret_cast<const std::uint8_t*>(&color);
    blob.data.insert(blob.data.end(), bytes, bytes + sizeof color);
  }
  return blob;
}

TEST(CloudFile, WhosePlacesHave64BitsGetsThemIn32HoweverItIsStored) {
  const TempFolder folder;
  pcl::PCDWriter writer;
  writer.writeASCII((folder / "a.pcd").string(), wideCloud(), Eigen::Vector4f::Zero(),
                    Eigen::Quaternionf::Identity(), 17);
  writer.writeBinary((folder / "b.pcd").string(), wideCloud());
  writer.writeBinaryCompressed((folder / "c.pcd").string(), wideCloud());
  CloudFile wide;
  wide.blob = wideCloud();
  writeCloud(folder / "d.ply", wide);
  for (const char* name : {"a.pcd", "b.pcd", "c.pcd", "d.ply"}) {
    // What is written of it again is the same.
    CloudFile cloud = readCloud(folder / name);
    for (const char* again : {"", "again.pcd", "again.ply"}) {
      if (*again != '\0') {
        writeCloud(folder / again, cloud);
        cloud = readCloud(folder / again);
      }
      EXPECT_EQ(cloud.facts.fields, "x y z normal_x normal_y normal_z stamp rgba") << name;
      EXPECT_EQ(cloud.cloud[0].getVector3fMap(), Eigen::Vector3f(0.1F, -2.25F, 3.0F)) << name;
      EXPECT_EQ(cloud.cloud[1].getVector3fMap(), Eigen::Vector3f(1.1F, -1.25F, 4.0F)) << name;
      EXPECT_EQ(cloud.cloud[1].g, 20) << name;
      pcl::PointCloud<pcl::PointNormal> normals;
      pcl::fromPCLPointCloud2(cloud.blob, normals);
      EXPECT_EQ(normals[1].normal_y, -0.5F) << name;
      const auto stamp = static_cast<std::size_t>(pcl::getFieldIndex(cloud.blob, "stamp"));
      double stamp_s = 0.0;
      std::memcpy(&stamp_s, &cloud.blob.data[cloud.blob.fields[stamp].offset], sizeof stamp_s);
      EXPECT_EQ(stamp_s, 1700000000.123456) << name;
    }
  }
}

TEST(CloudFile, OfPlyWith64BitsHasNoPlaceWhereItsGridHasNone) {
  const TempFolder folder;
  writeText(folder / "grid.ply",
            plyText("element vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
                    "element range_grid 2\nproperty list uchar int vertex_indices\n",
                    "1 2 3\n0\n1 0\n"));
  const CloudFile grid = readCloud(folder / "grid.ply");
  EXPECT_EQ(grid.facts.finite_points, 1U);
  EXPECT_EQ(grid.cloud[1].z, 3.0F);
}

TEST(CloudFile, OfPlyKeepsThePictureThatItsGridOrItsCameraTells) {
  const TempFolder folder;
  writeText(folder / "grid.ply",
            plyText("obj_info num_cols 2\nobj_info num_rows 2\nelement vertex 3\n" + kPlace +
                        "element range_grid 4\nproperty list uchar int vertex_indices\n",
                    "1 1 1\n2 2 2\n3 3 3\n1 0\n0\n1 2\n1 1\n"));
  const CloudFile grid = readCloud(folder / "grid.ply");
  EXPECT_EQ(grid.facts.width, 2U);
  EXPECT_EQ(grid.facts.height, 2U);
  EXPECT_EQ(grid.facts.finite_points, 3U);
  EXPECT_EQ(grid.cloud.at(0, 1).x, 3.0F);
  save(folder / "camera.ply", someCloud<pcl::PointXYZ>(8, 6), CloudEncoding::kAscii);
  EXPECT_EQ(readCloud(folder / "camera.ply").facts.height, 6U);
  writeText(folder / "bad.ply",
            plyText("element vertex 1\n" + kPlace +
                        "element range_grid 1\nproperty list uchar int vertex_indices\n",
                    "1 1 1\n1 7\n"));
  EXPECT_THAT(messageFor(folder / "bad.ply"), HasSubstr("range_grid 1 of the cloud has no such"));
}

TEST(CloudFile, WhosePlyHeaderPromisesWhatCannotBeIsRefusedBeforeItIsAllocated) {
  const TempFolder folder;
  const std::vector<std::pair<std::string, std::string>> texts = {
      {plyText("element camera 0\nproperty float view_px\nelement vertex 1000000000\n" + kPlace,
               "1 2 3\n"),
       "truncated"},
      {plyText("element vertex -1\n" + kPlace, "1 2 3\n"), "header is damaged"},
      {plyText("element vertex 1\n" + kPlace +
                   "element range_grid 1600000000\n"
                   "property list uchar int vertex_indices\n",
               "1 2 3\n"),
       "truncated"},
      {plyText("element vertex 18446744073709551615\n", "1 2 3\n"), "4 GiB"},
      {plyText("element vertex 1\n" + kPlace, "1 2 x\n"), "vertex 1 of the cloud"},
      {plyText("element vertex 1\n" + kPlace + "property uchar a\n", "1 2 3 256\n"), "too large"}};
  for (const auto& [text, why] : texts) {
    writeText(folder / "a.ply", text);
    EXPECT_THAT(messageFor(folder / "a.ply"), HasSubstr(why)) << text;
  }
  writeText(folder / "a.ply", plyText("obj_info num_cols 40000\nobj_info num_rows 40000\n"
                                      "element vertex 1\n" +
                                          kPlace,
                                      "1 2 3\n"));
  EXPECT_EQ(readCloud(folder / "a.ply").facts.points(), 1U) << "there is one, whatever is told";
}

}  // namespace
}  // namespace heel::test
