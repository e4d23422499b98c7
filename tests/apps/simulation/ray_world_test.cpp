// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/floor_plan.hpp>
#include <heel/apps/simulation/random.hpp>
#include <heel/apps/simulation/ray_world.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector3f;

/// Closed form: nearest distance along a ray to a sphere; infinite if it misses.
double toSphere(const Eigen::Vector3d& o, const Eigen::Vector3d& d, const Eigen::Vector3d& c,
                double r) {
  const Eigen::Vector3d q = o - c;
  const double b = q.dot(d), root = b * b - (q.squaredNorm() - r * r);
  return root < 0 || -b - std::sqrt(root) < 0 ? INFINITY : -b - std::sqrt(root);
}

/// Closed form: nearest distance along a ray to an infinite cylinder about the segment a-b, within
/// the segment.
double toTube(const Eigen::Vector3d& o, const Eigen::Vector3d& d, const Eigen::Vector3d& a,
              const Eigen::Vector3d& b, double r) {
  const Eigen::Vector3d axis = (b - a).normalized();
  const Eigen::Vector3d dp = d - axis * axis.dot(d), op = (o - a) - axis * axis.dot(o - a);
  const double A = dp.squaredNorm(), B = dp.dot(op), C = op.squaredNorm() - r * r;
  const double root = B * B - A * C;
  if (root < 0) return INFINITY;
  const double t = (-B - std::sqrt(root)) / A, along = axis.dot(o + t * d - a);
  return t < 0 || along < 0 || along > (b - a).norm() ? INFINITY : t;
}

TEST(FloorPlan, HasStepsDownThatNoMapShows) {
  Scene scene;
  FloorArea rug, step;
  rug.low = {-2.0, -2.0};
  rug.high = {2.0, 2.0};
  step.low = {1.0, -0.5};
  step.high = {3.0, 0.5};
  step.depth_m = 0.3;
  scene.floor_areas = {rug, step};
  const Geometry geometry = makeGeometry(scene);
  const RayWorld world(geometry);
  const auto down_m = [&](float x, float y) {
    return world.trace({x, y, 1.0F}, {0.0F, 0.0F, -1.0F}).distance;
  };
  for (const auto& [x, y] : {std::pair{0.5F, 0.0F}, {1.5F, 0.7F}, {1.5F, -0.7F}, {3.2F, 0.0F}}) {
    EXPECT_NEAR(down_m(x, y), 1.0F, 0.003F) << x << ", " << y;
  }
  EXPECT_NEAR(down_m(1.5F, 0.0F), 1.3F, 1e-5F);
  EXPECT_NEAR(down_m(2.9F, 0.4F), 1.3F, 1e-5F);
  const RayHit side = world.trace({0.0F, 0.0F, 1.0F}, {3.0F, 0.0F, -1.1F});
  EXPECT_NEAR(side.distance, 1.0F, 1e-5F) << "its far side";
  EXPECT_LT(side.normal.x(), -0.99F);
  EXPECT_LT(FloorPlan(scene).clearance({1.5, 0.0}), 0.0);
  EXPECT_GT(FloorPlan(scene, true).clearance({1.5, 0.0}), 0.0);
}

class RayWorldTest : public ::testing::Test {
 protected:
  /// 2000 rays from the origin in a cone about +x.
  template <typename Truth>
  void expectDistances(const RayWorld& world, const Truth& truth, double tolerance) {
    RandomStream random(5);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector3d d =
          Eigen::Vector3d(1.0, random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)).normalized();
      const double expected = truth(Eigen::Vector3d::Zero(), d);
      const RayHit hit = world.trace(Vector3f::Zero(), d.cast<float>());
      if (hit.kind == RayHit::Kind::kNothing || !std::isfinite(expected)) {
        // A ray that just grazes a round shape may go either way.
        grazed_ += (hit.kind == RayHit::Kind::kNothing) == std::isfinite(expected);
        continue;
      }
      EXPECT_NEAR(hit.distance, expected, tolerance);
      ++hits;
    }
    EXPECT_GT(hits, 100);
    EXPECT_LE(grazed_, 4);
  }
  int grazed_ = 0;
};

TEST_F(RayWorldTest, MeetsAPlaneAtItsClosedForm) {
  Geometry geometry;
  geometry.faces.push_back({{4, 10, -10}, {0, -20, 0}, {0, 0, 20}, {-1, 0, 0}});
  expectDistances(
      RayWorld(geometry), [](const auto&, const auto& d) { return 4.0 / d.x(); }, 1e-5);
}

TEST_F(RayWorldTest, MeetsABoxAtItsClosedForm) {
  Scene scene;
  Furniture box;
  box.parts.emplace_back();
  box.parts[0].base = {3.0, 0.0, -0.5};
  box.parts[0].size_m = {1.0, 1.2, 1.0};
  scene.furniture.push_back(box);
  scene.ceiling_m = 0.0;
  Geometry geometry = makeGeometry(scene);
  geometry.faces.erase(geometry.faces.begin());  // The floor.
  expectDistances(
      RayWorld(geometry),
      [](const auto&, const auto& d) {  // Slab test: the last entry, if before the first exit.
        const double enter_x = 2.5 / d.x(), exit_x = 3.5 / d.x();
        const double exit_y = 0.6 / std::abs(d.y()), exit_z = 0.5 / std::abs(d.z());
        return enter_x < std::min({exit_x, exit_y, exit_z}) ? enter_x : INFINITY;
      },
      1e-5);
}

TEST_F(RayWorldTest, MeetsACylinderAtItsClosedForm) {
  Geometry geometry;
  geometry.faces.push_back({{50, 1, 0}, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}});
  geometry.pillars.push_back({{3.0F, 0.2F, -2.0F}, 0.5F, 4.0F});
  expectDistances(
      RayWorld(geometry),
      [](const auto& o, const auto& d) {
        return toTube(o, d, {3.0, 0.2, -2.0}, {3.0, 0.2, 2.0}, 0.5);
      },
      1e-4);
}

TEST_F(RayWorldTest, MeetsTheFlatEndOfACylinder) {
  Geometry geometry;
  geometry.faces.push_back({{50, 1, 0}, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}});
  geometry.pillars.push_back({{3.0F, 0.0F, -1.0F}, 0.8F, 0.4F});
  const RayHit hit = RayWorld(geometry).trace(Vector3f::Zero(), {3.0F, 0.0F, -0.6F});
  EXPECT_EQ(hit.kind, RayHit::Kind::kPillar);
  EXPECT_NEAR(hit.distance, 1.0, 1e-5);
  EXPECT_NEAR(hit.normal.z(), 1.0, 1e-6);
}

TEST_F(RayWorldTest, MeetsACapsuleAtItsClosedForm) {
  Geometry geometry;
  geometry.faces.push_back({{50, 1, 0}, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}});
  RayWorld world(geometry);
  const Eigen::Vector3d a(3.0, -0.4, -0.3), b(3.4, 0.4, 0.5);
  world.setPeople({{a.cast<float>(), b.cast<float>(), 0.25F, 0.25F}});
  expectDistances(
      world,
      [&](const auto& o, const auto& d) {
        return std::min(
            {toSphere(o, d, a, 0.25), toSphere(o, d, b, 0.25), toTube(o, d, a, b, 0.25)});
      },
      2e-4);
}

TEST_F(RayWorldTest, AnswersTheSameForPacketsAsForSingleRays) {
  Geometry geometry;
  geometry.faces.push_back({{4, 10, -10}, {0, -20, 0}, {0, 0, 20}, {-1, 0, 0}});
  geometry.pillars.push_back({{3.0F, 0.3F, -1.0F}, 0.2F, 2.0F});
  RayWorld world(geometry);
  world.setPeople({{{2.5F, -0.3F, 0.0F}, {2.5F, -0.3F, 0.5F}, 0.2F, 0.1F}});
  for (int row = -20; row <= 20; ++row) {
    std::array<Vector3f, RayWorld::kPacket> directions;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      directions[i] = {1.0F, 0.04F * static_cast<float>(i) - 0.3F, 0.02F * static_cast<float>(row)};
    }
    std::array<RayHit, RayWorld::kPacket> hits;
    world.trace(Vector3f::Zero(), directions.data(), RayWorld::kPacket - 1, hits);
    for (std::size_t i = 0; i + 1 < directions.size(); ++i) {
      const RayHit single = world.trace(Vector3f::Zero(), directions[i]);
      EXPECT_EQ(hits[i].kind, single.kind);
      EXPECT_NEAR(hits[i].distance, single.distance, 1e-4);
    }
  }
}

TEST_F(RayWorldTest, FindsPeopleWithPacketsThatLookAllAround) {
  Geometry geometry;
  geometry.faces.push_back({{4, 10, -10}, {0, -20, 0}, {0, 0, 20}, {-1, 0, 0}});
  RayWorld world(geometry);
  for (int turn = 0; turn < 16; ++turn) {
    const auto ray = [](int i) {
      const float angle = 0.3926991F * static_cast<float>(i);
      return Vector3f(std::cos(angle), std::sin(angle), 0.0F);
    };
    const Vector3f middle = 2.0F * ray(turn), up(0.0F, 0.0F, 0.1F);
    world.setPeople({{middle - up, middle + up, 0.2F, 0.2F}});
    std::array<Vector3f, RayWorld::kPacket> directions;
    for (int i = 0; i < 16; ++i) directions[static_cast<std::size_t>(i)] = ray(i);
    std::array<RayHit, RayWorld::kPacket> hits;
    world.trace(Vector3f::Zero(), directions.data(), RayWorld::kPacket, hits);
    EXPECT_EQ(hits[static_cast<std::size_t>(turn)].kind, RayHit::Kind::kBody) << turn;
  }
}

TEST_F(RayWorldTest, NeverOverlooksAShadowOfAPerson) {
  Geometry geometry;
  geometry.faces.push_back({{50, 1, 0}, {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}});
  RayWorld world(geometry);
  ScenePerson person;
  std::vector<BodyPart> parts;
  BodyPose pose;
  pose.speed_mps = 1.4;
  pose.gait_rad = 1.2;
  appendBody(person, 0, pose, parts);
  world.setPeople(parts);
  RandomStream random(3);
  const auto point = [&] {
    return Vector3f(static_cast<float>(random.uniform(-2, 2)),
                    static_cast<float>(random.uniform(-2, 2)),
                    static_cast<float>(random.uniform(0, 2.5)));
  };
  int blocked = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3f from = point(), to = point();
    if (!world.blocked(from, to, RayTarget::kPeople)) continue;
    ++blocked;
    EXPECT_TRUE(world.peopleNear(from, to, 0.0F));
    EXPECT_EQ(world.blocked(from, &to, 1, RayTarget::kPeople), 1U);
  }
  EXPECT_GT(blocked, 200);
}

}  // namespace
}  // namespace heel
