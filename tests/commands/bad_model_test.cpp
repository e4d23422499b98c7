// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Models that can't be used.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"

namespace heel::test {
namespace {

/// A model file whose text is changed, and everything that reads it.
class BadModel : public testing::Test {
 protected:
  void replaceFirst(const std::string& from, const std::string& to) {
    writeSmallModel(file_);
    std::string text = readText(file_);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    writeText(file_, text.replace(at, from.size(), to));
  }

  void expectAllFail(const std::vector<std::string>& parts) {
    const std::string model = file_.string();
    const std::string out = (folder_ / "out").string();
    EXPECT_TRUE(failsWith(heel({"inspect", model, "--out", out + "/a.png"}), parts));
    EXPECT_TRUE(failsWith(heel({"track", folder_.path(), "--model", model, "--out", out}), parts));
    EXPECT_TRUE(failsWith(heel({"filter", "--model", model, "in.pcd", out + "/a.pcd"}), parts));
    EXPECT_FALSE(std::filesystem::exists(out));
  }

  TempFolder folder_;
  std::filesystem::path file_ = folder_ / "person.yaml";
};

TEST_F(BadModel, OfAFutureVersionIsRefused) {
  replaceFirst("heel_appearance: 4", "heel_appearance: 99");
  expectAllFail({"person.yaml", "is 99", "up to 4"});
}

TEST_F(BadModel, WithAMissingFieldNamesTheField) {
  replaceFirst("max_height_m", "max_hight_m");
  expectAllFail({"person.yaml", "'max_height_m' of the band is missing"});
}

TEST_F(BadModel, OfAnotherKindOfFileIsRefused) {
  writeText(file_, "scene: kitchen\n");
  expectAllFail({"person.yaml", "not an appearance model"});
}

TEST_F(BadModel, ThatIsNotThereIsNamed) { expectAllFail({"person.yaml", "no such file"}); }

}  // namespace
}  // namespace heel::test
