// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/body_appearance.hpp"

#include "tests/segmentation/painted_person.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

using test::kBlack;
using test::kRed;
using test::kSkin;

AppearanceModel redPerson() { return {{}, test::paintPerson(), test::paintRoom()}; }

void add(ColorCloud& cloud, double x, double y, double z, Bgr c, int count = 1) {
  for (int i = 0; i < count; ++i) {
    cloud.push_back(
        {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), c.r, c.g, c.b});
  }
}

std::vector<WorldBlob> blobsAt(const std::vector<Eigen::Vector2d>& places) {
  std::vector<WorldBlob> blobs;
  for (const auto& place : places) {
    blobs.emplace_back();
    blobs.back().position_m = place;
  }
  return blobs;
}

TEST(BodyAppearance, IsTheGeometricMeanOfTheBandsShares) {
  ColorCloud cloud;
  add(cloud, 2.0, 0.1, 1.2, kRed, 60);  // torso: 60 of 80 pass
  add(cloud, 2.1, 0.0, 1.3, kBlack, 20);
  add(cloud, 2.0, 0.0, 1.6, kSkin, 10);  // head: 10 of 40
  add(cloud, 2.0, 0.0, 1.7, kRed, 30);   // not the colour of this head
  add(cloud, 2.3, 0.0, 1.2, kRed, 99);   // outside the cylinder
  add(cloud, 2.0, 0.0, 0.5, kRed, 99);   // in no band
  auto blobs = blobsAt({{2.0, 0.0}});
  BodyAppearance(redPerson()).score(cloud, blobs);
  EXPECT_NEAR(blobs[0].appearance, std::sqrt((60.0 + 20) / (80 + 40) * (10.0 + 20) / (40 + 40)),
              1e-12);
}

TEST(BodyAppearance, SaysNothingEitherWayWhereNothingIsSeen) {
  auto blobs = blobsAt({{2.0, 0.0}});
  BodyAppearance(redPerson()).score(ColorCloud(), blobs);
  EXPECT_NEAR(blobs[0].appearance, 0.5, 1e-12);
}

TEST(BodyAppearance, LeavesOutBandsThatWereNeverLearned) {
  const AppearanceModel model({}, {test::paint(kRed, 900), ColorHistogram()}, test::paintRoom());
  ColorCloud cloud;
  add(cloud, 2.0, 0.0, 1.2, kRed, 60);
  add(cloud, 2.0, 0.0, 1.7, kBlack, 500);
  auto blobs = blobsAt({{2.0, 0.0}});
  BodyAppearance(model).score(cloud, blobs);
  EXPECT_NEAR(blobs[0].appearance, 80.0 / 100.0, 1e-12);
}

TEST(BodyAppearance, PrefersTheTargetToABiggerStranger) {
  ColorCloud cloud;
  add(cloud, 2.0, 0.0, 1.2, kRed, 200);
  add(cloud, 2.0, 0.0, 1.6, kSkin, 100);
  add(cloud, 2.0, 1.0, 1.2, kBlack, 900);
  add(cloud, 2.0, 1.0, 1.2, kRed, 300);  // more of the target's colour than the target
  add(cloud, 2.0, 1.0, 1.6, kSkin, 100);
  auto blobs = blobsAt({{2.0, 0.0}, {2.0, 1.0}});
  BodyAppearance(redPerson()).score(cloud, blobs);
  EXPECT_GT(blobs[0].appearance, 1.5 * blobs[1].appearance);
}

TEST(BodyAppearance, AgreesWithBruteForceAnywhere) {
  const AppearanceModel model = redPerson();
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> place(-12.0, 12.0);
  std::uniform_real_distribution<double> around(-0.4, 0.4);
  std::uniform_real_distribution<double> height(0.0, 2.4);
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 40; ++i) places.emplace_back(place(generator), place(generator));
  places.emplace_back(places[0].x() + 0.2, places[0].y());  // two that share points
  ColorCloud cloud;
  for (int i = 0; i < 20000; ++i) {
    const auto& p = places[static_cast<std::size_t>(i) % places.size()];
    const double x = p.x() + around(generator);
    const double y = p.y() + around(generator);
    add(cloud, x, y, height(generator), i % 3 == 0 ? kRed : i % 3 == 1 ? kSkin : kBlack);
  }
  add(cloud, std::numeric_limits<float>::quiet_NaN(), 0.0, 0.0, kRed);
  add(cloud, 1e30, -1e30, 1.2, kRed);
  auto blobs = blobsAt(places);
  const BodyAppearanceParams params;
  BodyAppearance(model, params).score(cloud, blobs);
  for (const WorldBlob& blob : blobs) {
    double product = 1.0;
    for (const AppearanceBand& band : model.bands()) {
      int points = 0;
      int passing = 0;
      for (const auto& p : cloud) {
        const float dx = p.x - static_cast<float>(blob.position_m.x());
        const float dy = p.y - static_cast<float>(blob.position_m.y());
        const auto radius = static_cast<float>(params.radius_m * params.radius_m);
        if (!(dx * dx + dy * dy < radius) || !band.body.contains(p.z)) continue;
        ++points;
        if (band.table.passes(p.b, p.g, p.r)) ++passing;
      }
      product *= (passing + params.prior_points) / (points + 2 * params.prior_points);
    }
    EXPECT_NEAR(blob.appearance, std::sqrt(product), 1e-9);
  }
}

TEST(BodyAppearance, RefusesParametersOutOfRange) {
  BodyAppearanceParams params;
  params.radius_m = 0.0;
  EXPECT_THROW(BodyAppearance(redPerson(), params), std::invalid_argument);
  params = {};
  params.prior_points = 0.0;
  EXPECT_THROW(BodyAppearance(redPerson(), params), std::invalid_argument);
}

}  // namespace
}  // namespace heel
