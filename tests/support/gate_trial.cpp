// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/gate_trial.hpp"

#include <heel/planning/last_gate.hpp>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <random>

namespace heel::test {
namespace {

using Eigen::Vector2d;

constexpr int kPeriods = 20;
constexpr int kTicks = 20;  // a period
constexpr double kTick_s = 0.005;

struct Post {
  Vector2d at;
  double radius_m;
  double nearest_m;  // from its rim to the robot's; where that is less than 0, the most so far
  bool is_seen = false;
  std::bitset<64> seen{};  // parts of its rim, by their direction
};

std::size_t partOf(const Post& post, const Vector2d& towards) {
  const Vector2d way = towards - post.at;
  const double turn = std::atan2(way.y(), way.x()) / (2.0 * M_PI) + 0.5;
  return static_cast<std::size_t>(turn * 64.0) % 64;
}

/// A robot among posts, all of it drawn. Keeps its memory from trial to trial.
struct World {
  void draw(std::mt19937_64& random, std::uint64_t seed);
  double between(double low, double high) { return low + (high - low) * share(); }
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(*random_); }
  void scan(const FloorPose& base, LaserScan& out);
  double roomTo(const Post& post, const FloorPose& robot) const;
  double touch(Post& post, const DriveState& robot) const;

  LastGateParams params;
  int scan_ticks = 0, odometry_ticks = 0, wheel_ticks = 0;  // how late they are
  bool is_long = false;
  bool looks_round = true;
  std::size_t beams = 360;
  bool is_uneven = false;    // Commands come early too, each as late as it happens to,
  bool tells_means = false;  // and odometry tells the mean speed of the last period.
  std::vector<Post> posts;
  std::mt19937_64* random_ = nullptr;
};

void World::draw(std::mt19937_64& random, std::uint64_t seed) {
  random_ = &random;
  is_uneven = seed % 2 == 0;
  tells_means = seed / 2 % 2 == 0;
  DriveLimits& limits = params.limits;
  limits.radius_m = between(0.15, 0.35);
  limits.max_speed_mps = between(0.2, 1.0);
  limits.max_reverse_mps = limits.max_speed_mps;
  limits.max_acceleration_mps2 = between(0.3, 1.5);
  limits.max_braking_mps2 = between(0.3, 2.0);
  std::mt19937_64 body(seed);
  is_long = seed / 8 % 2 == 1;
  const double longest_m = is_long ? 0.4 : 0.0;
  beams = is_long ? 720 : 360;  // It touches what is twice as far from the scanner.
  limits.front_m = std::uniform_real_distribution<double>(0.0, longest_m)(body);
  limits.back_m = -std::uniform_real_distribution<double>(0.0, longest_m)(body);
  params.sight.T_base_scanner.position = {0.1, 0.0};
  const bool is_late = share() < 0.7;
  scan_ticks = is_late ? static_cast<int>(between(0.0, kTicks)) : 0;
  odometry_ticks = is_late ? static_cast<int>(between(0.0, kTicks)) : 0;
  wheel_ticks = is_late ? static_cast<int>(between(0.0, 1.5 * kTicks)) : 0;
  params.wheels_latency_s = wheel_ticks * kTick_s;
  looks_round = share() < 0.7;
  posts.clear();
  const int count = 1 + static_cast<int>(between(0.0, 12.0));
  for (int i = 0; i < count; ++i) {
    Post post;
    post.radius_m = between(0.02, 0.15);
    const double away_m = between(0.3, 1.6), angle = between(-M_PI, M_PI);
    post.at = away_m * Vector2d(std::cos(angle), std::sin(angle));
    post.nearest_m = roomTo(post, {});
    if (post.nearest_m > -0.03) posts.push_back(post);
  }
}

void World::scan(const FloorPose& base, LaserScan& out) {
  const FloorPose scanner = base * params.sight.T_base_scanner;
  const double view_rad = looks_round ? 2.0 * M_PI : 220.0 / 180.0 * M_PI;
  out.first_rad = -0.5 * view_rad;
  out.step_rad = view_rad / static_cast<double>(beams);
  out.ranges_m.resize(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const double angle = scanner.yaw_rad + out.angle(i);
    const Vector2d way(std::cos(angle), std::sin(angle));
    Post* hit = nullptr;
    double range_m = std::numeric_limits<double>::infinity();
    for (Post& post : posts) {
      const Vector2d to = post.at - scanner.position;
      const double along = to.dot(way), aside2 = to.squaredNorm() - along * along;
      const double depth2 = post.radius_m * post.radius_m - aside2;
      if (along <= 0.0 || depth2 <= 0.0 || along - std::sqrt(depth2) >= range_m) continue;
      range_m = along - std::sqrt(depth2);
      hit = &post;
    }
    if (hit != nullptr) {
      hit->is_seen = true;
      hit->seen.set(partOf(*hit, scanner.position + range_m * way));
    }
    out.ranges_m[i] = static_cast<float>(range_m);
  }
}

double World::roomTo(const Post& post, const FloorPose& robot) const {
  const Vector2d near = axisOf(params.limits, robot).nearest(post.at);
  return (post.at - near).norm() - post.radius_m - params.limits.radius_m;
}

// How much deeper in the post the robot is than it ever was since it touched it.
double World::touch(Post& post, const DriveState& robot) const {
  const double gap_m = std::min(roomTo(post, robot.pose), 0.0);
  // An end of a long body swings, on trust, to where the scanner has not looked.
  const Vector2d axis = axisOf(params.limits, robot.pose).nearest(post.at);
  if (is_long && !post.seen[partOf(post, axis)]) post.nearest_m = gap_m;
  if (!post.is_seen) return 0.0;
  post.nearest_m = std::max(std::min(post.nearest_m, 0.0), gap_m);
  return post.nearest_m - gap_m;
}

bool adds(double given, double asked) {
  return std::abs(given) > std::abs(asked) || given * asked < 0.0;
}

}  // namespace

// The ticks at which the commands that are sent each period come to the wheels, in their order.
std::array<int, kPeriods> arrivals(const World& world, std::uint64_t seed) {
  std::mt19937_64 random(~seed);
  std::uniform_int_distribution<int> late(0, world.wheel_ticks);
  std::array<int, kPeriods> ticks{};
  int last = 0;
  for (int period = 0; period < kPeriods; ++period) {
    last = std::max(last, period * kTicks + (world.is_uneven ? late(random) : world.wheel_ticks));
    ticks[static_cast<std::size_t>(period)] = last;
  }
  return ticks;
}

GateTrial runGateTrial(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  static thread_local World world;
  static thread_local LaserScan scan;
  world.draw(random, seed);
  const std::array<int, kPeriods> arrives = arrivals(world, seed);
  const DriveLimits& limits = world.params.limits;
  LastGate gate(world.params);
  GateTrial trial;
  VelocityCommand wanted;
  std::array<VelocityCommand, kPeriods> sent;
  DriveState state;
  std::array<DriveState, kPeriods * kTicks + 1> past;  // at the beginning of each tick
  int ticks_past = 0;
  VelocityCommand obeyed;
  int obeys_period = -1;
  const auto before = [&](int ticks) {
    return past[static_cast<std::size_t>(std::max(ticks_past - ticks, 0))];
  };
  const auto odometry = [&] {
    DriveState told = before(world.odometry_ticks);
    if (!world.tells_means) return told;
    told.speed = {};
    for (int tick = 0; tick < kTicks; ++tick) {
      const VelocityCommand& speed = before(world.odometry_ticks + tick).speed;
      told.speed.forward_mps += speed.forward_mps / kTicks;
      told.speed.turn_radps += speed.turn_radps / kTicks;
    }
    return told;
  };
  for (int period = 0; period < kPeriods; ++period) {
    const double now_s = period * limits.period_s;
    if (period > 0) {
      const FloorPose base = before(world.scan_ticks).pose;
      world.scan(base, scan);
      gate.addScan(scan, base, now_s - world.scan_ticks * kTick_s);
    }
    if (period % 5 == 0 || world.share() < 0.2) {
      wanted = {world.between(-1.3, 1.3) * limits.max_speed_mps, world.between(-1.2, 1.2)};
      if (world.share() < 0.3) wanted.turn_radps = 0.0;
    }
    const GatedVelocity out = gate.pass(wanted, odometry(), world.odometry_ticks * kTick_s, now_s);
    sent[static_cast<std::size_t>(period)] = out.velocity;
    trial.adds_speed = trial.adds_speed || adds(out.velocity.forward_mps, wanted.forward_mps) ||
                       adds(out.velocity.turn_radps, wanted.turn_radps);
    ++trial.situations;
    trial.held_back += out.reason != GateReason::kFree ? 1 : 0;
    for (int tick = 0; tick < kTicks; ++tick) {
      while (obeys_period < period &&
             arrives[static_cast<std::size_t>(obeys_period + 1)] <= ticks_past) {
        obeyed = sent[static_cast<std::size_t>(++obeys_period)];
      }
      state = driven(limits, state, obeyed, kTick_s);
      past[static_cast<std::size_t>(++ticks_past)] = state;
      trial.way_m += std::abs(state.speed.forward_mps) * kTick_s;
      for (Post& post : world.posts)
        trial.deepest_m = std::max(trial.deepest_m, world.touch(post, state));
    }
  }
  return trial;
}

}  // namespace heel::test
