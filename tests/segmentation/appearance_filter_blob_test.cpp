// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The filter on PCLPointCloud2. The typed filter, which its own tests hold to account, is the
/// oracle.
#include "tests/support/pcl_filter_contract.hpp"
#include <heel/segmentation/appearance_filter.hpp>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace heel {
namespace {

using Blob = pcl::PCLPointCloud2;
using Field = pcl::PCLPointField;
using BlobFilter = AppearanceFilter<Blob>;
using TypedFilter = AppearanceFilter<pcl::PointXYZRGB>;
using Cloud = pcl::PointCloud<pcl::PointXYZRGB>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

ColorTable redTable() {
  static const ColorTable table([](std::uint8_t, std::uint8_t, std::uint8_t r) { return r; });
  return table;
}

template <typename PointT>
Blob::Ptr toBlob(const pcl::PointCloud<PointT>& cloud) {
  auto blob = pcl::make_shared<Blob>();
  pcl::toPCLPointCloud2(cloud, *blob);
  return blob;
}

/// The points packed otherwise: a field before, the colour first and of that name and type, z
/// before y, fields between and after, no alignment.
Blob::Ptr repacked(const Cloud& cloud, const std::string& color_name, std::uint8_t color_type) {
  auto blob = pcl::make_shared<Blob>();
  blob->header = cloud.header;
  blob->width = cloud.width;
  blob->height = cloud.height;
  const auto add = [&](const std::string& name, std::uint8_t type, unsigned bytes) {
    Field field;
    field.name = name;
    field.datatype = type;
    field.offset = blob->point_step;
    field.count = 1;
    blob->fields.push_back(field);
    blob->point_step += bytes;
  };
  add("ring", Field::UINT16, 2);
  add(color_name, color_type, 4);
  add("z", Field::FLOAT32, 4);
  add("intensity", Field::FLOAT32, 4);
  add("x", Field::FLOAT32, 4);
  add("y", Field::FLOAT32, 4);
  add("t", Field::FLOAT64, 8);
  add("label", Field::UINT8, 1);
  blob->row_step = blob->width * blob->point_step;
  std::uint8_t filler = 0;
  for (const auto& p : cloud) {
    std::vector<std::uint8_t> point(blob->point_step);
    for (auto& byte : point) byte = filler++;
    std::memcpy(&point[2], &p.rgba, 4);
    std::memcpy(&point[6], &p.z, 4);
    std::memcpy(&point[14], &p.x, 4);
    std::memcpy(&point[18], &p.y, 4);
    blob->data.insert(blob->data.end(), point.begin(), point.end());
  }
  return blob;
}

/// The same scene in every layout that the filter must read.
std::vector<Blob::Ptr> layoutsOf(const Cloud& cloud) {
  pcl::PointCloud<pcl::PointXYZRGBA> rgba;
  pcl::PointCloud<pcl::PointXYZRGBNormal> normal;
  pcl::copyPointCloud(cloud, rgba);
  pcl::copyPointCloud(cloud, normal);
  return {toBlob(cloud),
          toBlob(rgba),
          toBlob(normal),
          repacked(cloud, "rgb", Field::FLOAT32),
          repacked(cloud, "rgb", Field::UINT32),
          repacked(cloud, "rgba", Field::UINT32),
          repacked(cloud, "rgba", Field::FLOAT32)};
}

std::vector<std::uint8_t> bytesOf(const Blob& cloud, std::size_t point) {
  const auto begin = cloud.data.begin() + static_cast<std::ptrdiff_t>(point * cloud.point_step);
  return {begin, begin + static_cast<std::ptrdiff_t>(cloud.point_step)};
}

/// A point whose x, y and z are `value`.
std::vector<std::uint8_t> blanked(const Blob& cloud, std::size_t point, float value) {
  auto bytes = bytesOf(cloud, point);
  for (const Field& field : cloud.fields) {
    if (field.name == "x" || field.name == "y" || field.name == "z") {
      std::memcpy(&bytes[field.offset], &value, sizeof value);
    }
  }
  return bytes;
}

/// How the two filters are set up alike.
struct Settings {
  bool negative;
  bool subset;

  template <typename Filter, typename CloudPtr>
  pcl::Indices run(Filter& filter, const CloudPtr& cloud) const {
    filter.setTable(redTable());
    filter.setInputCloud(cloud);
    filter.setNegative(negative);
    if (subset) {  // from the last to the first, one twice
      filter.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{95, 60, 33, 31, 30, 7, 7, 0}));
    }
    pcl::Indices kept;
    filter.filter(kept);
    return kept;
  }
};

constexpr Settings kSettings[] = {{false, false}, {false, true}, {true, false}, {true, true}};

TEST(AppearanceFilterOnABlob, ListsWhatTheTypedFilterLists) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto cloud = test::makeScene<pcl::PointXYZRGB>(seed);
    for (const Settings& settings : kSettings) {
      TypedFilter typed(true);
      const pcl::Indices kept = settings.run(typed, cloud);
      ASSERT_FALSE(kept.empty());
      ASSERT_FALSE(typed.getRemovedIndices()->empty());
      for (const auto& blob : layoutsOf(*cloud)) {
        BlobFilter filter(true);
        EXPECT_EQ(settings.run(filter, blob), kept);
        EXPECT_EQ(*filter.getRemovedIndices(), *typed.getRemovedIndices());
      }
    }
  }
}

TEST(AppearanceFilterOnABlob, KeepsEveryByteOfTheKeptPoints) {
  const auto cloud = test::makeScene<pcl::PointXYZRGB>(4);
  for (const Settings& settings : kSettings) {
    for (const auto& blob : layoutsOf(*cloud)) {
      BlobFilter filter;
      const pcl::Indices kept = settings.run(filter, blob);
      Blob out;
      filter.filter(out);
      EXPECT_EQ(out.header.frame_id, "base");
      EXPECT_EQ(out.header.stamp, 42U);
      EXPECT_EQ(out.height, 1U);
      ASSERT_EQ(out.width, kept.size());
      ASSERT_EQ(out.point_step, blob->point_step);
      ASSERT_EQ(out.fields.size(), blob->fields.size());
      ASSERT_EQ(out.data.size(), kept.size() * blob->point_step);
      for (std::size_t n = 0; n < kept.size(); ++n) {
        EXPECT_EQ(bytesOf(out, n), bytesOf(*blob, static_cast<std::size_t>(kept[n])));
      }
    }
  }
}

TEST(AppearanceFilterOnABlob, KeepOrganizedBlanksOnlyXyzOfTheRemoved) {
  const auto cloud = test::makeScene<pcl::PointXYZRGB>(5);
  for (const Settings& settings : kSettings) {
    for (const auto& blob : layoutsOf(*cloud)) {
      for (const float value : {kNan, 7.0F}) {
        blob->is_dense = 1;  // a lie that only a blank which is not finite must mend
        BlobFilter filter(true);
        settings.run(filter, blob);
        const pcl::Indices removed = *filter.getRemovedIndices();
        filter.setKeepOrganized(true);
        filter.setUserFilterValue(value);
        Blob out;
        filter.filter(out);
        EXPECT_EQ(*filter.getRemovedIndices(), removed);
        ASSERT_EQ(out.width, blob->width);
        ASSERT_EQ(out.height, blob->height);
        ASSERT_EQ(out.data.size(), blob->data.size());
        EXPECT_EQ(out.is_dense, value == 7.0F);
        for (std::size_t i = 0; i < cloud->size(); ++i) {
          const bool gone = std::count(removed.begin(), removed.end(), static_cast<int>(i)) != 0;
          EXPECT_EQ(bytesOf(out, i), gone ? blanked(*blob, i, value) : bytesOf(*blob, i)) << i;
        }
      }
    }
  }
}

TEST(AppearanceFilterOnABlob, KeepOrganizedNeedsNoListOfTheRemoved) {
  const auto blob = toBlob(*test::makeScene<pcl::PointXYZRGB>(5));
  BlobFilter with_list(true);
  BlobFilter without_list;
  Blob expected;
  Blob out;
  for (BlobFilter* filter : {&with_list, &without_list}) {
    filter->setTable(redTable());
    filter->setInputCloud(blob);
    filter->setKeepOrganized(true);
    filter->filter(filter == &with_list ? expected : out);
  }
  EXPECT_EQ(out.data, expected.data);
  EXPECT_TRUE(without_list.getRemovedIndices()->empty());
}

TEST(AppearanceFilterOnABlob, WorksInPlace) {
  for (const bool organized : {false, true}) {
    const auto blob = repacked(*test::makeScene<pcl::PointXYZRGB>(6), "rgb", Field::FLOAT32);
    BlobFilter filter;
    filter.setTable(redTable());
    filter.setKeepOrganized(organized);
    filter.setInputCloud(blob);
    Blob expected;
    filter.filter(expected);
    filter.filter(*blob);
    EXPECT_EQ(blob->data, expected.data);
    EXPECT_EQ(blob->width, expected.width);
    EXPECT_EQ(blob->height, expected.height);
    EXPECT_EQ(blob->row_step, expected.row_step);
  }
}

TEST(AppearanceFilterOnABlob, OutputMayAliasTheIndices) {
  const auto blob = toBlob(*test::makeScene<pcl::PointXYZRGB>(7));
  BlobFilter filter;
  const pcl::Indices kept = Settings{false, false}.run(filter, blob);
  const auto shared = pcl::make_shared<pcl::Indices>(test::allIndices(96));
  filter.setIndices(shared);
  filter.filter(*shared);
  EXPECT_EQ(*shared, kept);
}

TEST(AppearanceFilterOnABlob, ACopyWorksBesideTheOriginal) {
  struct Side {
    Blob::Ptr cloud;
    pcl::Indices kept;
    BlobFilter filter{true};
    int mistakes = 0;
  };
  BlobFilter original(true);
  Settings{false, false}.run(original, toBlob(*test::makeScene<pcl::PointXYZRGB>(1)));
  Side sides[2];
  for (const unsigned i : {0U, 1U}) {
    Cloud many;
    while (many.size() < 20000) many += *test::makeScene<pcl::PointXYZRGB>(10 + i);
    sides[i].cloud = toBlob(many);
    BlobFilter alone(true);
    sides[i].kept = Settings{false, false}.run(alone, sides[i].cloud);
    sides[i].filter = BlobFilter(original);
    EXPECT_EQ(sides[i].filter.getTable().data(), original.getTable().data());
  }
  ASSERT_NE(sides[0].kept, sides[1].kept);
  const auto work = [](Side& side) {
    for (int i = 0; i < 200; ++i) {
      side.mistakes += Settings{false, false}.run(side.filter, side.cloud) != side.kept ? 1 : 0;
    }
  };
  std::thread beside(work, std::ref(sides[0]));
  work(sides[1]);
  beside.join();
  EXPECT_EQ(sides[0].mistakes, 0);
  EXPECT_EQ(sides[1].mistakes, 0);
}

TEST(AppearanceFilterOnABlob, ASmallerCloudAfterALargerOneHasNothingOfIt) {
  const auto cloud = test::makeScene<pcl::PointXYZRGB>(8);
  BlobFilter filter(true);
  const pcl::Indices kept = Settings{false, false}.run(filter, toBlob(*cloud));
  Cloud one;
  one.push_back((*cloud)[static_cast<std::size_t>(kept.front())]);
  EXPECT_EQ((Settings{false, false}.run(filter, toBlob(one))), pcl::Indices{0});
  EXPECT_TRUE(filter.getRemovedIndices()->empty());
}

TEST(AppearanceFilterOnABlob, NothingComesOfNothing) {
  const auto scene = toBlob(*test::makeScene<pcl::PointXYZRGB>(9));
  BlobFilter filter(true);
  EXPECT_TRUE((Settings{false, false}.run(filter, toBlob(Cloud())).empty()));
  EXPECT_TRUE(filter.getRemovedIndices()->empty());
  filter.setInputCloud(scene);
  filter.setIndices(pcl::make_shared<pcl::Indices>());
  Blob out;
  filter.filter(out);
  EXPECT_EQ(out.width * out.height, 0U);
  EXPECT_TRUE(out.data.empty());
}

TEST(AppearanceFilterOnABlob, WithoutInputTheOutputStaysAsItWas) {
  const test::QuietPcl quiet;
  BlobFilter filter;
  filter.setTable(redTable());
  pcl::Indices indices = {3, 1};
  filter.filter(indices);
  EXPECT_EQ(indices, (pcl::Indices{3, 1}));
}

/// What PCL prints to stderr while a filter keeps nothing of a cloud, after a run that kept some.
std::string complaintAbout(const Blob::Ptr& cloud, const ColorTable& table, bool organized) {
  BlobFilter filter(true);
  Settings{false, false}.run(filter, toBlob(*test::makeScene<pcl::PointXYZRGB>(1)));
  filter.setTable(table);
  filter.setKeepOrganized(organized);
  filter.setInputCloud(cloud);
  pcl::Indices indices = {3, 1};
  Blob out;
  testing::internal::CaptureStderr();
  filter.filter(indices);
  const std::string complaint = testing::internal::GetCapturedStderr();
  const test::QuietPcl quiet;
  filter.filter(out);
  EXPECT_TRUE(indices.empty());
  EXPECT_TRUE(filter.getRemovedIndices()->empty());
  EXPECT_EQ(out.width * out.height, 0U);
  EXPECT_TRUE(out.data.empty());
  return complaint;
}

TEST(AppearanceFilterOnABlob, SaysWhatIsWrongWithACloudAndKeepsNothing) {
  const auto scene = test::makeScene<pcl::PointXYZRGB>(1);
  struct Case {
    const char* says;
    void (*spoil)(Blob& cloud);
  };
  const Case cases[] = {
      {"no field rgb or rgba", [](Blob& c) { c.fields[3].name = "intensity"; }},
      {"no field rgb or rgba", [](Blob& c) { c.fields[3].datatype = Field::FLOAT64; }},
      {"no field rgb or rgba", [](Blob& c) { c.fields[3].count = 3; }},
      {"no field rgb or rgba", [](Blob& c) { c.fields[3].offset = c.point_step - 3; }},
      {"no field rgb or rgba", [](Blob& c) { c.fields[3].offset = 0xFFFFFFFF; }},
      {"no fields x, y, z", [](Blob& c) { c.fields[2].name = "depth"; }},
      {"no fields x, y, z", [](Blob& c) { c.fields[0].datatype = Field::INT32; }},
      {"no fields x, y, z", [](Blob& c) { c.fields.clear(); }},
      {"byte order", [](Blob& c) { c.is_bigendian = c.is_bigendian == 0; }},
      {"padded", [](Blob& c) { c.row_step += 4; }},
      {"shorter", [](Blob& c) { c.data.pop_back(); }},
      {"shorter", [](Blob& c) { ++c.height; }},
  };
  for (const Case& each : cases) {
    for (const bool organized : {false, true}) {
      const auto blob = toBlob(*scene);
      each.spoil(*blob);
      const std::string complaint = complaintAbout(blob, redTable(), organized);
      EXPECT_NE(complaint.find("[heel::AppearanceFilter::applyFilter]"), std::string::npos);
      EXPECT_NE(complaint.find(each.says), std::string::npos) << complaint;
    }
  }
}

TEST(AppearanceFilterOnABlob, WithoutATableReportsAnErrorAndKeepsNothing) {
  const auto blob = toBlob(*test::makeScene<pcl::PointXYZRGB>(1));
  for (const bool organized : {false, true}) {
    EXPECT_NE(complaintAbout(blob, ColorTable(), organized).find("No colour table given"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace heel
