// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/segmentation/painted_person.hpp"
#include <heel/segmentation/appearance_model.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

using test::kBlack;
using test::kFloor;
using test::kRed;
using test::kSkin;
using test::kWhite;
using test::paint;
using test::paintPerson;
using test::paintRoom;

bool passes(const ColorTable& table, Bgr c) { return table.passes(c.b, c.g, c.r); }

TEST(AppearanceModel, DiscountsTheRoomsColorsWhenToldTo) {
  AppearanceParams params;
  params.model = ColorModel::kPrincipalColors;
  params.bands = upperBody();
  ColorHistogram person = paint(kRed, 1000);
  person.merge(paint(kFloor, 1000));
  const AppearanceModel plain(params, {person}, paintRoom());
  params.suppress_background = true;
  const AppearanceModel discounted(params, {person}, paintRoom());
  const auto floor_over_red = [](const AppearanceModel& m) {
    const ColorTable& table = m.bands()[0].table;
    return static_cast<double>(table(kFloor.b, kFloor.g, kFloor.r)) / table(kRed.b, kRed.g, kRed.r);
  };
  EXPECT_LT(floor_over_red(discounted), 0.6 * floor_over_red(plain));
}

TEST(AppearanceModel, LearnsFromMoreThanAMetreUpUnlessTold) {
  for (const BodyBand& band : AppearanceParams().bands) EXPECT_GE(band.min_height_m, 1.0);
  for (const BodyBand& band : upperBody()) EXPECT_GE(band.min_height_m, 1.0);
}

TEST(AppearanceModel, HasATableForEachBand) {
  const AppearanceModel model({}, paintPerson(), paintRoom());
  ASSERT_EQ(model.bands().size(), 2U);
  EXPECT_TRUE(passes(model.bands()[0].table, kRed));
  EXPECT_FALSE(passes(model.bands()[0].table, kSkin));
  EXPECT_TRUE(passes(model.bands()[1].table, kSkin));
  EXPECT_FALSE(passes(model.bands()[1].table, kRed));
}

TEST(AppearanceModel, FilterPassesWhatAnyBandPasses) {
  const AppearanceModel model({}, paintPerson(), paintRoom());
  const ColorTable filter = model.filterTable();
  for (int b = 0; b < 256; b += 5) {
    for (int g = 0; g < 256; g += 5) {
      for (int r = 0; r < 256; r += 5) {
        const Bgr c{static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(g),
                    static_cast<std::uint8_t>(r)};
        ASSERT_EQ(passes(filter, c),
                  passes(model.bands()[0].table, c) || passes(model.bands()[1].table, c));
      }
    }
  }
}

/// The table holds the model's score, in steps of `score_per_level`, for all colours.
void expectTableToFollow(const AppearanceBand& band, const ColorScore& score) {
  for (int b = 0; b < 256; b += 3) {
    for (int g = 0; g < 256; g += 3) {
      for (int r = 0; r < 256; r += 3) {
        const auto b8 = static_cast<std::uint8_t>(b);
        const auto g8 = static_cast<std::uint8_t>(g);
        const auto r8 = static_cast<std::uint8_t>(r);
        const double level =
            score(ColorTable::middle(b8), ColorTable::middle(g8), ColorTable::middle(r8)) /
            band.score_per_level;
        ASSERT_NEAR(band.table(b8, g8, r8), std::min(level, 255.0), 0.5 + 1e-9);
      }
    }
  }
}

TEST(AppearanceModel, TabulatesTheColourRatio) {
  const AppearanceModel model({}, paintPerson(), paintRoom());
  expectTableToFollow(model.bands()[0], colorRatioScore(paint(kRed, 3000), paintRoom()));
}

TEST(AppearanceModel, TabulatesThePapersFormula) {
  AppearanceParams params;
  params.model = ColorModel::kPrincipalColors;
  params.bands = upperBody();
  const AppearanceModel model(params, {paint(kRed, 3000)}, paintRoom());
  expectTableToFollow(model.bands()[0], principalColorScore(paint(kRed, 3000)));
  EXPECT_NEAR(model.bands()[0].delta(),
              model.bands()[0].table.threshold() * model.bands()[0].score_per_level, 1e-15);
}

TEST(AppearanceModel, StatesTheErrorsOfItsTables) {
  AppearanceModel model({}, paintPerson(), paintRoom());
  const auto expectErrors = [&] {
    std::uint64_t lost = 0;
    std::uint64_t wrong = 0;
    const AppearanceBand& torso = model.bands()[0];
    torso.person.forEach([&](Bgr c, std::uint64_t n) { lost += passes(torso.table, c) ? 0 : n; });
    model.room().forEach([&](Bgr c, std::uint64_t n) { wrong += passes(torso.table, c) ? n : 0; });
    EXPECT_EQ(torso.errors().false_negatives, lost);
    EXPECT_EQ(torso.errors().false_positives, wrong);
  };
  expectErrors();
  model.setThreshold(0, 250);
  EXPECT_EQ(model.bands()[0].table.threshold(), 250);
  expectErrors();
  EXPECT_THROW(model.setThreshold(2, 1), std::out_of_range);
}

TEST(AppearanceModel, WorksWithoutABandThatWasNeverSeen) {
  const AppearanceModel model({}, {paint(kRed, 3000), ColorHistogram()}, paintRoom());
  EXPECT_TRUE(model.bands()[1].table.empty());
  EXPECT_TRUE(passes(model.filterTable(), kRed));
  EXPECT_EQ(model.separability().doubt, AppearanceDoubt::kNone);
}

TEST(AppearanceModel, TellsARedPersonFromTheRoom) {
  const Separability answer = AppearanceModel({}, paintPerson(), paintRoom()).separability();
  EXPECT_EQ(answer.doubt, AppearanceDoubt::kNone);
  EXPECT_LT(answer.error_share, 0.05);
  EXPECT_EQ(answer.advice, "");
}

TEST(AppearanceModel, DoubtsAPersonInTheRoomsColours) {
  AppearanceParams params;
  for (const auto model : {ColorModel::kColorRatio, ColorModel::kPrincipalColors}) {
    params.model = model;
    const Separability answer =
        AppearanceModel(params, {paintRoom(), paintRoom()}, paintRoom()).separability();
    EXPECT_EQ(answer.doubt, AppearanceDoubt::kLikeTheRoom);
    EXPECT_GT(answer.error_share, 0.9);
    EXPECT_THAT(answer.advice, testing::HasSubstr("another colour"));
  }
}

TEST(AppearanceModel, DoubtsAHandfulOfPoints) {
  const Separability answer =
      AppearanceModel({}, {paint(kRed, 60), paint(kSkin, 40)}, paintRoom()).separability();
  EXPECT_EQ(answer.doubt, AppearanceDoubt::kTooFewPoints);
  EXPECT_THAT(answer.advice, testing::HasSubstr("longer"));
}

TEST(AppearanceModel, RefusesWhatItCannotBeMadeOf) {
  const ColorHistogram none;
  EXPECT_THROW(AppearanceModel({}, {none, none}, paintRoom()), std::invalid_argument);
  EXPECT_THROW(AppearanceModel({}, paintPerson(), none), std::invalid_argument);
  EXPECT_THROW(AppearanceModel({}, {paint(kRed, 100)}, paintRoom()), std::invalid_argument);
  AppearanceParams params;
  params.bands.clear();
  EXPECT_THROW(AppearanceModel(params, {}, paintRoom()), std::invalid_argument);
  params.bands = {{"upside down", 2.0, 1.0}};
  EXPECT_THROW(AppearanceModel(params, {paint(kRed, 100)}, paintRoom()), std::invalid_argument);
}

}  // namespace
}  // namespace heel
