// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/stamps.hpp>

#include <gmock/gmock.h>

namespace {

using heel::test::messageOf;
using heel::test::TempFolder;
using heel::test::writeText;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(StampedFiles, ReadsStampsAndNamesFromTheListsFolder) {
  const TempFolder folder;
  writeText(folder / "rgb.txt", "# stamp file\r\n\n0.5 rgb/a b.png\r\n  1e0\trgb/c.png\n");
  const auto files = heel::readStampedFiles(folder / "rgb.txt");
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].stamp_s, 0.5);
  EXPECT_EQ(files[0].path, folder / "rgb/a b.png");
  EXPECT_EQ(files[1].stamp_s, 1.0);
  EXPECT_EQ(files[1].path, folder / "rgb/c.png");
}

TEST(StampedFiles, KnowsAMarkOfAnEditorAndStampsInNanoseconds) {
  const TempFolder folder;
  writeText(folder / "data.csv",
            "\xEF\xBB\xBF"
            "1403636579763555584,a.png\n1403636579813,b.png\n");
  const auto files = heel::readStampedFiles(folder / "data.csv");
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].stamp_s, 1403636579.763555584);
  EXPECT_EQ(files[1].stamp_s, 1403636579.813);
}

TEST(StampedFiles, NamesTheLineThatIsWrong) {
  const TempFolder folder;
  for (const std::string line : {"0.1", "now rgb/a.png", "nan rgb/a.png", "0.1s rgb/a.png"}) {
    writeText(folder / "rgb.txt", "0.0 rgb/0.png\n" + line + "\n");
    EXPECT_EQ(messageOf([&] { heel::readStampedFiles(folder / "rgb.txt"); }),
              (folder / "rgb.txt").string() + ", line 2: '" + line +
                  "' is not of the form 'stamp filename'");
  }
}

TEST(StampedFiles, SaysWhenThereIsNoListOrNothingInIt) {
  const TempFolder folder;
  EXPECT_THAT(messageOf([&] { heel::readStampedFiles(folder / "rgb.txt"); }),
              HasSubstr("rgb.txt cannot be read"));
  writeText(folder / "rgb.txt", "# nothing\n");
  EXPECT_THAT(messageOf([&] { heel::readStampedFiles(folder / "rgb.txt"); }),
              HasSubstr("rgb.txt lists nothing"));
}

TEST(NearestInTime, FindsTheNearestWithinTheLimitInAnyOrder) {
  const std::vector<heel::StampedFile> files = {{1.000, ""}, {2.000, ""}, {9.000, ""}};
  const std::vector<heel::StampedFile> others = {{2.004, ""}, {1.030, ""}, {0.990, ""}};
  EXPECT_THAT(heel::nearestInTime(files, others, 0.02),
              ElementsAre(std::optional<std::size_t>(2), std::optional<std::size_t>(0),
                          std::optional<std::size_t>()));
  EXPECT_THAT(heel::nearestInTime({{1.0, ""}}, {}, 0.02),
              ElementsAre(std::optional<std::size_t>()));
}

TEST(StampOfName, KnowsSecondsMicrosecondsAndNanoseconds) {
  EXPECT_EQ(heel::stampOfName("rgb/1305031102.175304.png"), 1305031102.175304);
  EXPECT_EQ(heel::stampOfName("0.25.pcd"), 0.25);
  EXPECT_EQ(heel::stampOfName("1305031102175304.png"), 1305031102.175304);
  EXPECT_EQ(heel::stampOfName("1403636579763555584.png"), 1403636579.763555584);
  for (const char* name : {"000001.png", "frame_0.5.png", "left.png", "1.2.3.png", ""}) {
    EXPECT_EQ(heel::stampOfName(name), std::nullopt) << name;
  }
}

TEST(StampsOfFiles, PrefersTheListThenTheNamesThenTheRate) {
  const TempFolder folder;
  const std::filesystem::path times = folder / "times.txt";
  bool nominal = true;
  EXPECT_THAT(heel::stampsOfFiles(times, {"1.5.pcd", "2.5.pcd"}, 10.0, nominal),
              ElementsAre(1.5, 2.5));
  EXPECT_FALSE(nominal);
  EXPECT_THAT(heel::stampsOfFiles(times, {"first.pcd", "last.pcd"}, 10.0, nominal),
              ElementsAre(0.0, DoubleEq(0.1)));
  EXPECT_TRUE(nominal);
  EXPECT_THAT(messageOf([&] {
                heel::stampsOfFiles(times, {"1.5.pcd", "map.pcd"}, 10.0, nominal);
              }),
              HasSubstr("map.pcd: its name tells no time"));
  writeText(times, "3.0\n4.0\n");
  EXPECT_THAT(heel::stampsOfFiles(times, {"1.5.pcd", "2.5.pcd"}, 10.0, nominal),
              ElementsAre(3.0, 4.0));
  EXPECT_FALSE(nominal);
  EXPECT_THAT(messageOf([&] { heel::stampsOfFiles(times, {"1.5.pcd"}, 10.0, nominal); }),
              HasSubstr("times.txt lists 2 times for 1 files"));
}

}  // namespace
