// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/localization_experiment.hpp>
#include <heel/apps/experiment/roaming_driver.hpp>
#include <heel/apps/simulation/scene_map.hpp>
#include <heel/apps/simulation/simulator.hpp>
#include <heel/mapping/localization.hpp>

#include <Eigen/LU>

#include <cmath>

namespace heel {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kCellSize_m = 0.05;      // Of the map, which shows what a laser's height has.
constexpr double kTracking_s = 120.0;     // How long the robot is tracked from a known start.
constexpr double kGlobal_s = 60.0;        // How long it may take to find out where it is.
constexpr double kBeforeKidnap_s = 15.0;  // How long it is tracked before it is carried off.
constexpr double kRight_m = 0.3;          // An estimate this near to the truth ...
constexpr double kRight_rad = 0.175;      // ... is right.

/// People who never come to an end, and wait for nobody for long.
Scene restless(Scene scene, const FloorPose& start) {
  for (ScenePerson& person : scene.people) {
    person.repeat = true;
    for (PathStep& step : person.path) step.patience_s = std::min(step.patience_s, 2.0);
  }
  scene.robot.start = start.position;
  scene.robot.start_yaw_rad = start.yaw_rad;
  return scene;
}

/// A robot that roams and is localized.
class Roaming {
 public:
  Roaming(const Scene& scene, std::uint64_t seed, const FloorPose& start, RoamingDriver& driver)
      : simulator_(restless(scene, start), {seed, 1, false}), driver_(driver) {
    step({});
  }

  /// Goes on for a step and tells localization all that was measured.
  void step(Localization& localization) {
    step(driver_.drive(readings_->truth));
    if (readings_->odometry) {
      localization.predict(odometry_.inverse() * *readings_->odometry);
      odometry_ = *readings_->odometry;
    }
    if (readings_->laser != nullptr) localization.update(*readings_->laser);
  }

  const FloorPose& truth() const { return readings_->truth.robot; }

 private:
  void step(const VelocityCommand& command) {
    readings_ = &simulator_.step(readings_ == nullptr ? 0.0 : kStep_s, command);
    if (readings_->odometry && readings_->stamp_s <= 0.0) odometry_ = *readings_->odometry;
  }

  Simulator simulator_;
  RoamingDriver& driver_;
  const Readings* readings_ = nullptr;
  FloorPose odometry_;
};

/// Adds up errors over a run.
class Score {
 public:
  void add(double now_s, const FloorPose& truth, const Localization& localization) {
    const LocalizationEstimate& e = localization.estimate();
    ++all_;
    particles_ += static_cast<double>(localization.particles().size());
    if (e.lost && !run.noticed_s) run.noticed_s = now_s;
    if (has_last_) run.way_m += (truth.position - last_.position).norm();
    last_ = truth;
    has_last_ = true;
    const Eigen::Vector2d off = e.pose.position - truth.position;
    const Eigen::Vector3d error(off.x(), off.y(), wrapped(e.pose.yaw_rad - truth.yaw_rad));
    const bool right = off.norm() <= kRight_m && std::abs(error.z()) <= kRight_rad;
    if (e.lost) {
      ++lost_;
    } else {
      square_m_ += off.squaredNorm();
      square_rad_ += error.z() * error.z();
      consistency_ +=
          error.dot((e.covariance + 1e-8 * Eigen::Matrix3d::Identity()).inverse() * error);
      run.worst_m = std::max(run.worst_m, off.norm());
      wrong_ += right ? 0 : 1;
    }
    if (!right || e.lost) {
      run.right_s.reset();
    } else if (!run.right_s) {
      run.right_s = now_s;
    }
    run.duration_s = now_s;
  }

  LocalizationRun result() {
    const double all = std::max(all_, 1), used = std::max(all_ - lost_, 1);
    run.rms_m = std::sqrt(square_m_ / used);
    run.rms_rad = std::sqrt(square_rad_ / used);
    run.consistency = consistency_ / used;
    run.lost_share = lost_ / all;
    run.wrong_share = wrong_ / all;
    run.mean_particles = particles_ / all;
    return run;
  }

  LocalizationRun run;

 private:
  int all_ = 0, lost_ = 0, wrong_ = 0;
  double square_m_ = 0.0, square_rad_ = 0.0, consistency_ = 0.0, particles_ = 0.0;
  FloorPose last_;
  bool has_last_ = false;
};

Localization makeLocalization(const Scene& scene, std::uint64_t seed) {
  LocalizationParams own;
  own.seed = hashOf(seed, 72);
  const Eigen::Vector3d& at = scene.robot.laser.at;
  return Localization(laserGrid(scene, kCellSize_m), {at.head<2>(), 0.0}, own);
}

LocalizationRun finish(Roaming& roaming, Localization& localization, std::uint64_t seed,
                       double duration_s) {
  Score score;
  score.run.seed = seed;
  const auto steps = std::lround(duration_s / kStep_s);
  for (long i = 1; i <= steps; ++i) {
    roaming.step(localization);
    score.add(static_cast<double>(i) * kStep_s, roaming.truth(), localization);
  }
  return score.result();
}

}  // namespace

LocalizationRun runTracking(const Scene& scene, std::uint64_t seed) {
  Localization localization = makeLocalization(scene, seed);
  RoamingDriver driver(scene, seed);
  const FloorPose start = driver.randomPose();
  localization.startAt(start);
  Roaming roaming(scene, seed, start, driver);
  return finish(roaming, localization, seed, kTracking_s);
}

LocalizationRun runGlobalStart(const Scene& scene, std::uint64_t seed) {
  Localization localization = makeLocalization(scene, seed);
  RoamingDriver driver(scene, seed);
  Roaming roaming(scene, seed, driver.randomPose(), driver);
  return finish(roaming, localization, seed, kGlobal_s);
}

LocalizationRun runKidnapped(const Scene& scene, std::uint64_t seed) {
  Localization localization = makeLocalization(scene, seed);
  RoamingDriver driver(scene, seed);
  const FloorPose start = driver.randomPose();
  localization.startAt(start);
  FloorPose left;
  {
    Roaming before(scene, seed, start, driver);
    for (long i = std::lround(kBeforeKidnap_s / kStep_s); i > 0; --i) {
      before.step(localization);
    }
    left = before.truth();
  }
  FloorPose there = driver.randomPose();
  while ((there.position - left.position).norm() < 2.0) there = driver.randomPose();
  RoamingDriver driver_there(scene, hashOf(seed, 73));
  Roaming after(scene, hashOf(seed, 74), there, driver_there);
  return finish(after, localization, seed, kGlobal_s);
}

}  // namespace heel
