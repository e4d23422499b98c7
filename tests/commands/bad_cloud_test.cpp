// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Clouds that can't be used.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace heel::test {
namespace {

class BadCloud : public testing::Test {
 protected:
  BadCloud() { writeSmallModel(folder_ / "person.yaml"); }

  void write(const std::string& fields, const std::vector<std::string>& points) {
    const std::string sizes = fields == "x y z" ? "4 4 4" : "4 4 4 4";
    const std::string types = fields == "x y z" ? "F F F" : "F F F U";
    const std::string ones = fields == "x y z" ? "1 1 1" : "1 1 1 1";
    const std::string count = std::to_string(points.size());
    std::string text = "VERSION .7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types +
                       "\nCOUNT " + ones + "\nWIDTH " + count +
                       "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA ascii\n";
    for (const std::string& point : points) text += point + "\n";
    writeText(folder_ / "in.pcd", text);
  }

  /// To inspect a cloud without colours is no error.
  void expectAllFail(const std::vector<std::string>& parts, bool inspect_too = true) {
    const auto before = filesBelow(folder_.path());
    EXPECT_TRUE(failsWith(heel({"filter", "--model", folder_ / "person.yaml", folder_ / "in.pcd",
                                folder_ / "out.pcd"}),
                          parts));
    const HeelRun inspected = heel({"inspect", folder_ / "in.pcd", "--out", folder_ / "in.png"});
    if (inspect_too) {
      EXPECT_TRUE(failsWith(inspected, parts));
    }
    EXPECT_TRUE(failsWith(heel({"track", folder_ / "in.pcd", "--model", folder_ / "person.yaml",
                                "--out", folder_ / "out"}),
                          parts));
    EXPECT_EQ(filesBelow(folder_.path()), before);
  }

  TempFolder folder_;
};

TEST_F(BadCloud, WithoutColourSaysSo) {
  write("x y z", {"1 2 3", "4 5 6"});
  expectAllFail({"in.pcd", "no colour"}, false);
  const HeelRun inspected = heel({"inspect", folder_ / "in.pcd"});
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(inspected.out, testing::HasSubstr("no colour"));
}

TEST_F(BadCloud, WithoutPointsSaysSo) {
  write("x y z rgb", {});
  expectAllFail({"in.pcd", "empty"});
}

TEST_F(BadCloud, OfNothingButNaNSaysSo) {
  write("x y z rgb", {"nan nan nan 255", "nan nan nan 255"});
  expectAllFail({"in.pcd", "all 2 points", "NaN"});
}

TEST_F(BadCloud, ThatIsNoPcdFileSaysSo) {
  writeText(folder_ / "in.pcd", "no cloud at all");
  expectAllFail({"in.pcd", "not a PCD file"});
}

TEST_F(BadCloud, ThatIsNotThereIsNamed) { expectAllFail({"in.pcd"}); }

}  // namespace
}  // namespace heel::test
