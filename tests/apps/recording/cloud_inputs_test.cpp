// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/clouds/cloud_file.hpp>

#include <gmock/gmock.h>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class FindClouds : public testing::Test {
 protected:
  FindClouds() {
    for (const char* name : {"a10.pcd", "a9.pcd", "b.PLY", "notes.txt"}) writeText(at(name), "");
    std::filesystem::create_directories(at("sub.pcd"));
    writeText(at("sub.pcd/c.pcd"), "");
  }

  std::string at(const std::string& name) const { return folder_ / name; }

  TempFolder folder_;
};

TEST_F(FindClouds, TakesAFoldersFilesByNumber) {
  EXPECT_THAT(findClouds({folder_.path()}), ElementsAre(at("a9.pcd"), at("a10.pcd"), at("b.PLY")));
}

TEST_F(FindClouds, TakesWhatFitsAPattern) {
  EXPECT_THAT(findClouds({at("a*.pcd")}), ElementsAre(at("a9.pcd"), at("a10.pcd")));
  EXPECT_THAT(findClouds({at("*/c.pc?")}), ElementsAre(at("sub.pcd/c.pcd")));
}

TEST_F(FindClouds, KeepsTheOrderOfTheCallAndTakesEachOnce) {
  EXPECT_THAT(findClouds({at("b.PLY"), at("*"), at("none.pcd")}),
              ElementsAre(at("b.PLY"), at("a9.pcd"), at("a10.pcd"), at("none.pcd")));
}

TEST_F(FindClouds, TakesAFileThatIsCalledLikeAPattern) {
  writeText(at("[1].pcd"), "");
  EXPECT_THAT(findClouds({at("[1].pcd")}), ElementsAre(at("[1].pcd")));
}

TEST_F(FindClouds, SaysWhereThereAreNone) {
  std::filesystem::create_directories(at("empty"));
  EXPECT_THAT(messageOf([&] { findClouds({at("empty")}); }), HasSubstr("holds no PCD or PLY"));
  EXPECT_THAT(messageOf([&] { findClouds({at("z*.pcd")}); }), HasSubstr("z*.pcd: no PCD or PLY"));
  EXPECT_THAT(messageOf([&] { findClouds({at("notes.txt")}); }), HasSubstr("ends in .pcd or .ply"));
}

}  // namespace
}  // namespace heel::test
