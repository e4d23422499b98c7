// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_match.hpp"

#include "tests/segmentation/painted_person.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace heel {
namespace {

using test::paint;

WorldBlob blobAt(double x_m) {
  WorldBlob blob;
  blob.position_m = {x_m, 0.0};
  blob.max_height_m = 1.7;
  return blob;
}

/// A person of one colour up to 0.9 m, of another up to 1.45 m, and of a third up to the top.
ColorCloud personOf(Bgr legs, Bgr torso, Bgr head, float top_m = 1.75F) {
  ColorCloud cloud;
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 6.0);
  for (float z = 0.3F; z < top_m; z += 0.002F) {
    const Bgr color = z < 0.9F ? legs : z < 1.45F ? torso : head;
    const auto r = test::toChannel(color.r + noise(generator));
    const auto g = test::toChannel(color.g + noise(generator));
    const auto b = test::toChannel(color.b + noise(generator));
    cloud.push_back({2.0F, 0.0F, z, r, g, b});
  }
  return cloud;
}

AppearanceModel modelOf(std::optional<Stature> stature = {}) {
  AppearanceParams params;
  params.bands = wholeBody();
  params.comparison = BodyComparison::kMatch;
  return AppearanceModel(params,
                         {paint(test::kRed, 500), paint(test::kSkin, 500), paint(test::kNavy, 500)},
                         test::paintRoom(), stature);
}

TEST(BodyMatcher, IsHighForTheSamePerson) {
  BodyMatcher matcher(modelOf());
  EXPECT_GT(matcher.match(personOf(test::kNavy, test::kRed, test::kSkin), blobAt(2)), 0.6);
}

TEST(BodyMatcher, OneOtherGarmentIsEnough) {
  BodyMatcher matcher(modelOf());
  EXPECT_LT(matcher.match(personOf(test::kWhite, test::kRed, test::kSkin), blobAt(2)), 0.1);
  EXPECT_LT(matcher.match(personOf(test::kNavy, test::kWhite, test::kSkin), blobAt(2)), 0.1);
}

Bgr inLight(Bgr color, double share) {
  return {test::toChannel(share * color.b), test::toChannel(share * color.g),
          test::toChannel(share * color.r)};
}

TEST(BodyMatcher, AllowsForTheLightOfAnotherRoom) {
  const ColorCloud dim =
      personOf(inLight(test::kNavy, 0.5), inLight(test::kRed, 0.5), inLight(test::kSkin, 0.5));
  EXPECT_GT(BodyMatcher(modelOf()).match(dim, blobAt(2)), 0.5);
  BodyMatchParams strict;
  strict.max_light_change = 0.0;
  EXPECT_LT(BodyMatcher(modelOf(), strict).match(dim, blobAt(2)), 0.35);
}

TEST(BodyMatcher, KnowsADarkerGarmentFromADarkerRoom) {
  const ColorCloud other = personOf(test::kNavy, inLight(test::kRed, 0.25), test::kSkin);
  EXPECT_LT(BodyMatcher(modelOf()).match(other, blobAt(2)), 0.35);
}

TEST(BodyMatcher, TellsSizesApartWhereClothesAreTheSame) {
  BodyMatcher matcher(modelOf(Stature{1.74, 0.02, 30}));
  const auto match = [&](float top_m) {
    return matcher.match(personOf(test::kNavy, test::kRed, test::kSkin, top_m), blobAt(2));
  };
  EXPECT_GT(match(1.75F), 0.6);
  EXPECT_LT(match(1.62F), 0.2);
  EXPECT_LT(match(1.88F), 0.2);
}

TEST(BodyMatcher, DoesNotTakeSomebodyWhoseHeadIsNotSeen) {
  BodyMatcher matcher(modelOf(Stature{1.74, 0.02, 30}));
  ColorCloud cloud;
  for (const auto& p : personOf(test::kNavy, test::kRed, test::kSkin)) {
    if (p.z < 1.25F) cloud.push_back(p);
  }
  EXPECT_LE(matcher.match(cloud, blobAt(2)), 0.4);
}

TEST(BodyMatcher, SeesOnlyTheCylinder) {
  BodyMatcher matcher(modelOf());
  ColorCloud cloud = personOf(test::kNavy, test::kRed, test::kSkin);
  const double alone = matcher.match(cloud, blobAt(2));
  for (int i = 0; i < 500; ++i) cloud.push_back({2.5F, 0.0F, 1.2F, 0, 255, 0});
  EXPECT_DOUBLE_EQ(matcher.match(cloud, blobAt(2)), alone);
}

TEST(BodyMatcher, SaysLittleWithoutEvidence) {
  BodyMatchParams params;
  params.sharpness = 1.0;
  EXPECT_DOUBLE_EQ(BodyMatcher(modelOf(), params).match(ColorCloud(), blobAt(2)),
                   params.prior_affinity);
}

TEST(BodyMatcher, RejectsBadParameters) {
  for (auto spoil : {+[](BodyMatchParams& p) { p.prior_affinity = 1.5; },
                     +[](BodyMatchParams& p) { p.sharpness = 0.0; },
                     +[](BodyMatchParams& p) { p.max_light_change = -0.1; },
                     +[](BodyMatchParams& p) { p.stature_sigma_m = -1.0; }}) {
    BodyMatchParams params;
    spoil(params);
    EXPECT_THROW(BodyMatcher(modelOf(), params), std::invalid_argument);
  }
}

}  // namespace
}  // namespace heel
