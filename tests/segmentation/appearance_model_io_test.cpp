// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/painted_person.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/segmentation/appearance_model_io.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class AppearanceFile : public testing::Test {
 protected:
  static AppearanceModel makeModel() {
    AppearanceParams params;
    params.model = ColorModel::kPrincipalColors;
    params.principal_colors.count = 2;
    params.threshold.rule = ThresholdRule::kMostSelective;
    params.threshold.max_false_negative_share = 0.1234567;
    AppearanceModel model(params, test::paintPerson(), test::paintRoom());
    model.setThreshold(1, 77);
    return model;
  }

  std::string text() const { return test::readText(file_); }

  void write(const std::string& text) const { test::writeText(file_, text); }

  /// Saves a good model with one piece of its text replaced.
  void saveWith(const std::string& what, const std::string& instead) const {
    saveAppearance(makeModel(), file_);
    std::string changed = text();
    const auto at = changed.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    write(changed.replace(at, what.size(), instead));
  }

  /// With stripes of an older format.
  void saveOlder(int format, const std::vector<std::string>& stripes) const {
    saveAppearance(makeModel(), file_);
    std::string changed = text(), portrait = "portrait:\n";
    for (const std::string& stripe : stripes) portrait += "  - |\n    " + stripe + "\n";
    const std::size_t from = changed.find("portrait:"), to = changed.find("\nroom:");
    changed.replace(from, to - from, portrait);
    const std::string now = "heel_appearance: 4";
    write(changed.replace(changed.find(now), now.size(),
                          "heel_appearance: " + std::to_string(format)));
  }

  std::string complaint() const {
    return test::messageOf([&] { loadAppearance(file_); });
  }

  test::TempFolder folder_;
  fs::path file_ = folder_ / "person.yaml";
};

TEST_F(AppearanceFile, GivesBackTheModel) {
  const AppearanceModel model = makeModel();
  saveAppearance(model, file_);
  const AppearanceModel loaded = loadAppearance(file_);
  ASSERT_EQ(loaded.bands().size(), model.bands().size());
  for (std::size_t i = 0; i < model.bands().size(); ++i) {
    const AppearanceBand& a = model.bands()[i];
    const AppearanceBand& b = loaded.bands()[i];
    EXPECT_EQ(a.body.name, b.body.name);
    EXPECT_EQ(a.body.min_height_m, b.body.min_height_m);
    EXPECT_EQ(a.body.max_height_m, b.body.max_height_m);
    EXPECT_TRUE(test::sameColors(a.person, b.person));
    EXPECT_TRUE(std::equal(a.table.data(), a.table.data() + ColorTable::kCells, b.table.data()));
    EXPECT_EQ(a.table.threshold(), b.table.threshold());
    EXPECT_EQ(a.errors().false_positives, b.errors().false_positives);
    EXPECT_EQ(a.errors().false_negatives, b.errors().false_negatives);
  }
  EXPECT_TRUE(test::sameColors(model.room(), loaded.room()));
  EXPECT_EQ(loaded.params().principal_colors.count, 2);
  EXPECT_EQ(loaded.params().threshold.max_false_negative_share, 0.1234567);
}

TEST_F(AppearanceFile, GivesBackTheStatureAndThePortrait) {
  AppearanceParams params;
  params.model = ColorModel::kHueSaturation;
  params.suppress_background = true;
  saveAppearance(
      AppearanceModel(params, test::paintPerson(), test::paintRoom(), Stature{1.73, 0.015, 42}),
      file_);
  const AppearanceModel loaded = loadAppearance(file_);
  EXPECT_EQ(loaded.params().model, ColorModel::kHueSaturation);
  EXPECT_TRUE(loaded.params().suppress_background);
  ASSERT_TRUE(loaded.stature());
  EXPECT_EQ(loaded.stature()->height_m, 1.73);
  EXPECT_EQ(loaded.stature()->spread_m, 0.015);
  EXPECT_EQ(loaded.stature()->frames, 42);
  const AppearanceModel model = makeModel();
  saveAppearance(model, file_);
  EXPECT_TRUE((loadAppearance(file_).portrait().colors - model.portrait().colors).abs().maxCoeff() <
              1e-6F);
}

TEST_F(AppearanceFile, OfTheFirstFormatHasAPortraitOfItsBands) {
  const AppearanceModel model = makeModel();
  saveAppearance(model, file_);
  std::string old = text();
  const std::size_t from = old.find("portrait:"), to = old.find("\nroom:");
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  old.erase(from, to + 1 - from);
  old.replace(old.find("heel_appearance: 4"), 18, "heel_appearance: 1");
  std::ofstream(file_) << old;
  EXPECT_TRUE((loadAppearance(file_).portrait().colors - model.portrait().colors).abs().maxCoeff() <
              1e-6F);
}

TEST_F(AppearanceFile, OfFormat2HasItsColoursAmongMoreBins) {
  // The first of 12 x 12 x 6 bins, and the last.
  saveOlder(2, std::vector<std::string>(8, "0 0.25\n    863 0.75"));
  const BodyDescription read = loadAppearance(file_).portrait();
  // Three bins more on each side of both colour axes, of 18.
  EXPECT_EQ(read.colors((3 * 18 + 3) * 6 + 0, 4), 0.25F);
  EXPECT_EQ(read.colors((14 * 18 + 14) * 6 + 5, 4), 0.75F);
}

TEST_F(AppearanceFile, OfFormat3HasStripesThatWereOneAlike) {
  saveOlder(3, {"0 1", "1 1", "2 1", "3 1", "4 1", "5 1", "6 1", "7 1"});
  const BodyDescription read = loadAppearance(file_).portrait();
  ASSERT_EQ(read.colors.cols(), 10);
  const std::vector<int> was = {0, 1, 2, 3, 4, 5, 6, 6, 7, 7};  // 1.45 to 1.65 m, and to 2 m
  for (int stripe = 0; stripe < 10; ++stripe) {
    EXPECT_EQ(read.colors(was[static_cast<std::size_t>(stripe)], stripe), 1.0F) << stripe;
    EXPECT_EQ(read.colors.col(stripe).sum(), 1.0F) << stripe;
  }
}

TEST_F(AppearanceFile, WithAPortraitThatIsNoneIsRefused) {
  saveAppearance(makeModel(), file_);
  std::string broken = text();
  const std::size_t first = broken.find_first_of("0123456789", broken.find("portrait:"));
  broken.insert(first, "9");  // of the bin
  std::ofstream(file_) << broken;
  EXPECT_THAT(complaint(), HasSubstr("portrait"));
}

TEST_F(AppearanceFile, IsTheSameWhenWrittenAgain) {
  saveAppearance(makeModel(), file_);
  const std::string first = text();
  saveAppearance(loadAppearance(file_), file_);
  EXPECT_EQ(text(), first);
}

TEST_F(AppearanceFile, KeepsABandWithoutPoints) {
  saveAppearance(
      AppearanceModel({}, {test::paint(test::kRed, 600), ColorHistogram()}, test::paintRoom()),
      file_);
  EXPECT_TRUE(loadAppearance(file_).bands()[1].table.empty());
}

TEST_F(AppearanceFile, TakesAThresholdSetByHand) {
  saveWith("threshold: 77", "threshold: 99");
  EXPECT_EQ(loadAppearance(file_).bands()[1].table.threshold(), 99);
}

TEST_F(AppearanceFile, ThatIsMissingIsNamed) {
  EXPECT_THAT(complaint(), AllOf(HasSubstr("person.yaml"), HasSubstr("no such file")));
}

TEST_F(AppearanceFile, ThatWasCutOffIsRefused) {
  saveAppearance(makeModel(), file_);
  std::string cut = text();
  cut.resize(cut.find_last_not_of('\n'));
  cut.resize(cut.rfind('\n') + 1);  // without the room's last colour
  std::ofstream(file_) << cut;
  EXPECT_THAT(complaint(), AllOf(HasSubstr("person.yaml"), HasSubstr("truncated")));
}

TEST_F(AppearanceFile, OfTheFutureIsRefused) {
  saveWith("heel_appearance: 4", "heel_appearance: 5");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("person.yaml"), HasSubstr("is 5, but this"),
                                 HasSubstr("only versions up to 4")));
}

TEST_F(AppearanceFile, NamesAMissingField) {
  saveWith("hue_bins", "other_bins");
  EXPECT_THAT(complaint(), HasSubstr("'hue_bins' of the principal_colors is missing"));
  saveWith("max_height_m", "height_m");
  EXPECT_THAT(complaint(), HasSubstr("'max_height_m' of the band is missing"));
  saveWith("room:", "hall:");
  EXPECT_THAT(complaint(), HasSubstr("'room' of the appearance model is missing"));
}

TEST_F(AppearanceFile, NamesAFieldThatIsWrong) {
  saveWith("value_bins: 32", "value_bins: many");
  EXPECT_THAT(complaint(),
              HasSubstr("'value_bins' of the principal_colors must be a number, not 'many'"));
  saveWith("model: principal_colors", "model: magic");
  EXPECT_THAT(complaint(),
              HasSubstr("'model' of the appearance model is 'magic', which is not known"));
  saveWith("threshold: 77", "threshold: 256");
  EXPECT_THAT(complaint(), HasSubstr("'threshold' of the band is 256, but must be at most 255"));
  saveWith("hue_bins: 36", "hue_bins: 0");
  EXPECT_THAT(complaint(), HasSubstr("not a valid appearance model: hue and value need"));
  saveWith("hue_bins: 36", "hue_bins: 100000000");
  EXPECT_THAT(complaint(), HasSubstr("not a valid appearance model: hue and value need"));
  saveWith("min_points", "max_points: 3\nmin_points");
  EXPECT_THAT(complaint(), HasSubstr("'max_points' is not a key of the appearance model"));
}

TEST_F(AppearanceFile, NamesAColourThatIsWrong) {
  saveWith("colors: |\n", "colors: |\n      1 2 3\n");
  EXPECT_THAT(complaint(),
              HasSubstr("'colors' of the band has a line that is not 'blue green red"));
  saveWith("colors: |\n", "colors: |\n      1 2 256 4\n");
  EXPECT_THAT(complaint(),
              HasSubstr("'colors' of the band has a colour out of range: '1 2 256 4'"));
}

TEST_F(AppearanceFile, OfAnotherKindIsRefused) {
  write("camera: {fx: 500}\n");
  EXPECT_THAT(complaint(), HasSubstr("person.yaml is not an appearance model"));
  write("");
  EXPECT_THAT(complaint(), HasSubstr("person.yaml: the appearance model must be a map"));
  write("a: [1, 2\nb: }");
  EXPECT_THAT(complaint(), HasSubstr("person.yaml, line 2: not YAML"));
}

TEST_F(AppearanceFile, IsLeftAloneWhenItCannotBeWritten) {
  const fs::path nowhere = folder_ / "none" / "person.yaml";
  try {
    saveAppearance(makeModel(), nowhere);
    FAIL() << "no complaint";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("person.yaml cannot be written"),
                                HasSubstr("No such file or directory")));
  }
}

TEST_F(AppearanceFile, LeavesNothingBesideIt) {
  saveAppearance(makeModel(), file_);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(AppearanceFile, SaysThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  fs::create_symlink("/dev/full", file_.string() + ".part");
  try {
    saveAppearance(makeModel(), file_);
    FAIL() << "no complaint";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("No space left on device"));
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_FALSE(fs::exists(file_.string() + ".part"));
}

}  // namespace
}  // namespace heel
