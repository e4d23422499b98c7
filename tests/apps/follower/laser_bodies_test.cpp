// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/allocation_count.hpp"
#include <heel/apps/follower/laser_bodies.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;

/// A scanner somewhere in a room of 6 m x 6 m; the map shows its walls and a round pillar.
class LaserBodiesTest : public testing::Test {
 protected:
  struct Disc {
    Vector2d center;
    double radius_m;
  };

  static double mapped(const Vector2d& p) {
    const double walls = std::min(p.minCoeff(), (Vector2d(6.0, 6.0) - p).minCoeff());
    return std::min(walls, (p - Vector2d(2.0, 4.5)).norm() - 0.3);
  }

  // Sphere tracing: as far as nothing can be, again and again.
  LaserScan scan(double first_rad = -kPi, double view_rad = 2.0 * kPi) const {
    LaserScan made;
    made.first_rad = first_rad;
    made.step_rad = kPi / 180.0;
    for (int i = 0; i < static_cast<int>(std::lround(view_rad / made.step_rad)); ++i) {
      const double angle = made.angle(static_cast<std::size_t>(i));
      const Vector2d along(std::cos(angle), std::sin(angle));
      double range = 0.0;
      for (double free = 1.0; free > 1e-4 && range < 20.0; range += free) {
        const Vector2d p = scanner * Vector2d(range * along);
        free = mapped(p);
        for (const Disc& d : discs) free = std::min(free, (p - d.center).norm() - d.radius_m);
      }
      made.ranges_m.push_back(static_cast<float>(range));
    }
    return made;
  }

  void step(const LaserScan* seen, double elapsed_s) {
    bodies.step(
        seen, scanner, [](const Vector2d& p) { return mapped(p); }, elapsed_s);
  }
  void look(const LaserScan& seen) { step(&seen, 0.1); }
  void look() { look(scan()); }

  void person(const Vector2d& at) {
    discs.push_back({at + Vector2d(0.0, 0.12), 0.06});
    discs.push_back({at - Vector2d(0.0, 0.12), 0.06});
  }

  FloorPose scanner{{1.0, 3.0}, 0.4};
  std::vector<Disc> discs;
  LaserBodies bodies;
};

TEST_F(LaserBodiesTest, FindsAPersonWhereverTheyStand) {
  look();
  EXPECT_TRUE(bodies.bodies().empty()) << "the map shows all";
  for (const Vector2d& at :
       {Vector2d(3.0, 3.0), Vector2d(5.6, 2.0), Vector2d(4.0, 5.5), Vector2d(1.0, 1.5)}) {
    discs.clear();
    person(at);
    look();
    ASSERT_EQ(bodies.bodies().size(), 1U) << at.transpose();
    EXPECT_LT((bodies.bodies()[0].position_m - at).norm(), 0.18) << "the legs' near sides";
    EXPECT_EQ(bodies.bodies()[0].look, nullptr);
    EXPECT_EQ(bodies.sightOf(at), Sight::kUnknown) << "somebody may be there";
    EXPECT_EQ(bodies.sightOf(at + Vector2d(0.2, 0.1)), Sight::kUnknown) << "seen a little off";
  }
}

TEST_F(LaserBodiesTest, TwoWhoStandApartAreTwo) {
  person({3.0, 2.0});
  person({3.0, 2.9});
  look();
  EXPECT_EQ(bodies.bodies().size(), 2U);
}

TEST_F(LaserBodiesTest, NobodyIsWhereBeamsGoThroughOrEndAtTheMap) {
  look();
  EXPECT_EQ(bodies.sightOf({3.0, 3.0}), Sight::kFree) << "free floor";
  EXPECT_EQ(bodies.sightOf({5.6, 3.0}), Sight::kFree) << "the wall, seen too near";
  EXPECT_EQ(bodies.sightOf({2.0, 4.3}), Sight::kThing) << "the pillar";
  LaserScan seen = scan();
  std::fill(seen.ranges_m.begin(), seen.ranges_m.end(), std::numeric_limits<float>::infinity());
  look(seen);
  EXPECT_EQ(bodies.sightOf({3.0, 3.0}), Sight::kFree) << "beams without an end";
}

TEST_F(LaserBodiesTest, AWideThingIsNobody) {
  for (double y = 2.4; y < 3.7; y += 0.1) discs.push_back({{3.5, y}, 0.1});  // a shelf
  look();
  EXPECT_TRUE(bodies.bodies().empty());
  EXPECT_EQ(bodies.sightOf({3.5, 3.0}), Sight::kThing);
  person({2.9, 3.0});
  look();
  EXPECT_EQ(bodies.sightOf({2.9, 3.0}), Sight::kUnknown) << "before the shelf";
}

// A fridge is no wider than legs in a stride, but it is one surface.
TEST_F(LaserBodiesTest, AWideSurfaceIsNobodyWhereLegsInAStrideAreSomebody) {
  const Vector2d at(3.0, 3.0);
  discs.push_back({at, 0.35});
  look();
  EXPECT_TRUE(bodies.bodies().empty());
  EXPECT_EQ(bodies.sightOf(at), Sight::kThing);
  discs = {{at + Vector2d(0.0, 0.2), 0.08}, {at - Vector2d(0.0, 0.2), 0.08}};
  look();
  EXPECT_EQ(bodies.bodies().size(), 1U);
  discs = {{at, 0.22}};  // a long skirt
  look();
  EXPECT_EQ(bodies.bodies().size(), 1U);
}

TEST_F(LaserBodiesTest, SaysNothingOfWhatItDoesNotSee) {
  EXPECT_FALSE(bodies.isFresh()) << "no scan yet";
  discs.push_back({{2.5, 3.0}, 0.4});  // a tub; somebody may stand behind it
  look();
  EXPECT_EQ(bodies.sightOf({4.0, 3.0}), Sight::kHidden);
  look(scan(-kPi / 4.0, kPi / 2.0));
  EXPECT_EQ(bodies.sightOf({1.0, 1.0}), Sight::kUnknown) << "to the side of its view";
  LaserScan seen = scan();
  std::fill(seen.ranges_m.begin(), seen.ranges_m.end(), std::numeric_limits<float>::quiet_NaN());
  look(seen);
  EXPECT_EQ(bodies.sightOf({3.0, 2.0}), Sight::kUnknown);
  EXPECT_EQ(bodies.sightOf(scanner.position), Sight::kUnknown);
}

TEST_F(LaserBodiesTest, BeamsMayBeginAnywhere) {
  person({3.0, 3.0});
  for (const double first_rad : {-kPi, -0.4, 0.0, kPi}) {
    look(scan(first_rad));
    EXPECT_EQ(bodies.sightOf({3.0, 3.0}), Sight::kUnknown) << first_rad;
    EXPECT_EQ(bodies.sightOf({3.0, 1.5}), Sight::kFree) << first_rad;
    LaserScan backwards = scan(first_rad);
    std::reverse(backwards.ranges_m.begin(), backwards.ranges_m.end());
    backwards.first_rad = backwards.angle(backwards.ranges_m.size() - 1);
    backwards.step_rad *= -1.0;
    look(backwards);
    EXPECT_EQ(bodies.sightOf({3.0, 3.0}), Sight::kUnknown) << first_rad;
    EXPECT_EQ(bodies.sightOf({3.0, 1.5}), Sight::kFree) << first_rad;
  }
}

TEST_F(LaserBodiesTest, AScanIsOldSoon) {
  look();
  step(nullptr, 0.2);
  EXPECT_TRUE(bodies.isFresh());
  step(nullptr, 0.2);
  EXPECT_FALSE(bodies.isFresh());
}

TEST_F(LaserBodiesTest, AllocatesNothingOnceWarm) {
  person({3.0, 3.0});
  const LaserScan seen = scan();
  look(seen);
  const long before = test::allocations();
  look(seen);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace heel
