// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel filter, on clouds that are written by hand.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/clouds/pcd_file.hpp>

#include <gmock/gmock.h>
#include <pcl/common/io.h>

#include <cmath>
#include <cstring>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::uint32_t rgb(const cv::Vec3b& color) {
  return (std::uint32_t{color[2]} << 16U) | (std::uint32_t{color[1]} << 8U) | color[0];
}

/// Four by two points, numbered by their label; those with label 2, 3 and 7 have the jumper's
/// colour.
class Filter : public testing::Test {
 protected:
  Filter() {
    writeSmallModel(model_);
    std::string text =
        "VERSION .7\nFIELDS x y z rgb label\nSIZE 4 4 4 4 4\nTYPE F F F U U\nCOUNT 1 1 1 1 1\n"
        "WIDTH 4\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 8\nDATA ascii\n";
    for (int i = 1; i <= 8; ++i) {
      const bool is_jumper = i == 2 || i == 3 || i == 7;
      text += "0.5 " + std::to_string(i) + " 2 " +
              std::to_string(rgb(is_jumper ? SmallRecording::kJumper : SmallRecording::kWall)) +
              " " + std::to_string(i) + "\n";
    }
    writeText(in_, text);
  }

  HeelRun filter(const std::vector<std::string>& options = {}) {
    return heel({"filter", "--model", model_, in_, out_}, options);
  }

  std::vector<std::uint32_t> labels(const PcdFile& pcd) const {
    const auto& field =
        pcd.blob.fields.at(static_cast<std::size_t>(pcl::getFieldIndex(pcd.blob, "label")));
    std::vector<std::uint32_t> labels(pcd.cloud.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      std::memcpy(&labels[i], &pcd.blob.data[i * pcd.blob.point_step + field.offset], 4);
    }
    return labels;
  }

  TempFolder folder_;
  std::filesystem::path model_ = folder_ / "person.yaml";
  std::filesystem::path in_ = folder_ / "in.pcd";
  std::filesystem::path out_ = folder_ / "out.pcd";
};

TEST_F(Filter, KeepsThePointsThatPassWithAllTheirFields) {
  const HeelRun run = filter();
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("kept 3 of 8 points"));
  const PcdFile kept = readPcd(out_);
  EXPECT_THAT(labels(kept), ElementsAre(2, 3, 7));
  EXPECT_EQ(kept.cloud[2].y, 7.0F);
  EXPECT_EQ(kept.cloud[2].r, SmallRecording::kJumper[2]);
  EXPECT_EQ(kept.origin, Eigen::Vector4f(1, 2, 3, 0)) << "the sensor's place";
}

TEST_F(Filter, NegativeKeepsTheOthers) {
  ASSERT_TRUE(succeeds(filter({"--negative"})));
  EXPECT_THAT(labels(readPcd(out_)), ElementsAre(1, 4, 5, 6, 8));
}

TEST_F(Filter, KeepOrganizedBlanksThePointsThatDoNotPass) {
  ASSERT_TRUE(succeeds(filter({"--keep-organized"})));
  const PcdFile kept = readPcd(out_);
  EXPECT_EQ(kept.cloud.width, 4U);
  EXPECT_EQ(kept.cloud.height, 2U);
  EXPECT_THAT(labels(kept), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  std::vector<int> finite;
  for (std::size_t i = 0; i < kept.cloud.size(); ++i) {
    if (std::isfinite(kept.cloud[i].x)) finite.push_back(static_cast<int>(i) + 1);
  }
  EXPECT_THAT(finite, ElementsAre(2, 3, 7));
}

TEST_F(Filter, GivesTheSameBytesOnEveryRun) {
  ASSERT_TRUE(succeeds(filter()));
  const std::string first = readText(out_);
  ASSERT_TRUE(succeeds(filter()));
  EXPECT_EQ(readText(out_), first);
}

TEST_F(Filter, RefusesToOverwriteItsInput) {
  const std::string before = readText(in_);
  out_ = folder_.path() / "." / "in.pcd";
  EXPECT_TRUE(failsWith(filter(), {"in.pcd", "which is read"}));
  EXPECT_EQ(readText(in_), before);
}

TEST_F(Filter, ThatKeepsNothingSaysSoAndWritesNoCloud) {
  std::string text = readText(in_);
  const std::string jumper = std::to_string(rgb(SmallRecording::kJumper));
  const std::string wall = std::to_string(rgb(SmallRecording::kWall));
  for (auto at = text.find(jumper); at != std::string::npos; at = text.find(jumper)) {
    text.replace(at, jumper.size(), wall);
  }
  writeText(in_, text);
  const HeelRun run = filter();
  EXPECT_TRUE(failsWith(run, {"in.pcd", "none of its points passes"}));
  EXPECT_TRUE(findsNothing(run));
  EXPECT_THAT(filesBelow(folder_.path()), ElementsAre("in.pcd", "person.yaml"));
}

TEST_F(Filter, IntoAFolderThatIsNotThereMakesIt) {
  out_ = folder_ / "nowhere/out.pcd";
  EXPECT_TRUE(succeeds(filter()));
  EXPECT_THAT(filesBelow(folder_ / "nowhere"), ElementsAre("out.pcd"));
}

}  // namespace
}  // namespace heel::test
