// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where the robot is on its map: Monte Carlo localization with a laser.
#pragma once

#include <heel/mapping/likelihood_field.hpp>
#include <heel/mapping/motion_model.hpp>
#include <heel/mapping/particle_set.hpp>
#include <heel/mapping/pose_search.hpp>
#include <heel/mapping/scan_beams.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace heel {

/// The defaults suit a robot indoors with a scanner of 180 degrees.
struct LocalizationParams {
  LikelihoodFieldParams field;
  MotionModelParams motion;
  ScanBeamsParams scan;
  PoseSearchParams search;

  /// So many particles are kept when the robot is sure where it is.
  std::size_t min_particles = 500;
  /// Bounds the number of particles, and so the time of a scan; more for a large building.
  std::size_t max_particles = 5000;

  /// Factor on the log-likelihoods of beams: neighbouring beams err together, so 60 of them are
  /// worth fewer independent ones.
  double evidence = 0.15;
  /// A beam's end this near to where the map has it is explained; at least the edge of a cell.
  double near_m = 0.2;
  /// The robot is lost where the fit's short average (ScanResiduals::fit) is lower than this: the
  /// scans contradict the map more than they agree with it.
  double lost_fit = 0.5;
  std::uint64_t seed = 1;  ///< Seed of all that is drawn by chance.
};

/// Where the robot is, and how far that can be trusted.
struct LocalizationEstimate {
  FloorPose pose;  ///< Base frame in the map: the mean of the largest cluster.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y, yaw in that cluster.
  double cluster_share = 0.0;                            ///< Of all weight, that the cluster has.
  ScanResiduals residuals;                               ///< Of the last scan, at the pose.
  double fit = 1.0;                                      ///< Short average of the residuals' fit.
  double usual_fit = 1.0;                                ///< Long average of it.
  /// The pose should not be used: the scans do not fit to it, or it is one of several, or it was
  /// found too few weighed scans ago. A robot that stands still does not get out of the last two.
  bool lost = true;
};

/// Monte Carlo localization on a likelihood field (Thrun, Burgard, Fox: Probabilistic Robotics,
/// chapter 8): KLD-adaptive number of particles, systematic resampling when few are effective, and
/// recovery by a second set of particles. When the map does not explain the scans at the estimate
/// (where a beam that passed through a wall counts more than one that somebody blocked), the map is
/// searched with each scan, and what is found goes on as a filter of its own, the rivals. Both
/// explain every scan more or less well; the odds between them say which is the estimate, and the
/// other is kept, so that it can win back. Rivals end when the scans fit again. The odds begin with
/// the chance that the robot was carried off to just there, one of all the places on the map, and
/// scans count by how far apart they were measured (once every half metre or half radian), for
/// furniture that has moved misleads neighbouring scans alike.
///
/// The same calls give the same results. No allocation once warm.
class Localization {
 public:
  /// @param map             Free cells are where the robot may be.
  /// @param T_base_scanner  The scanner in the robot's base frame.
  /// @throws std::invalid_argument  if the map has no free cell or a parameter is out of range.
  explicit Localization(const OccupancyGrid& map, const FloorPose& T_base_scanner = {},
                        const LocalizationParams& params = {});

  /// Starts again, around a pose that is known up to normal errors of these deviations.
  /// @throws std::invalid_argument  if the pose is not finite.
  void startAt(const FloorPose& pose, double place_m = 0.2, double heading_rad = 0.1);
  /// Starts again with the next scan, anywhere on the free cells.
  void startAnywhere();

  /// The odometry says that the robot has moved: its new pose in the frame of the one before. An
  /// increment that is not finite is passed over.
  void predict(const FloorPose& increment);

  /// @param T_base_then  Where the base was when the scan was measured, in the frame of where the
  ///                     last increment led; the same place unless the scan came late.
  /// @return whether the scan was weighed: it was not if the robot has hardly moved since the last
  ///         one, or no beam was usable: then the robot is less and less sure where it is, the
  ///         further it drives.
  bool update(const LaserScan& scan, const std::vector<FloorDisc>& leave_out = {},
              const FloorPose& T_base_then = {});

  const LocalizationEstimate& estimate() const { return estimate_; }
  const ParticleSet& particles() const { return particles_; }
  const LikelihoodField& field() const { return field_; }
  const LocalizationParams& params() const { return params_; }

 private:
  struct Cluster {
    FloorPose pose;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double share = 0.0;
  };
  void moveAll();
  void driveBlindly();
  void weigh(const BeamEnds& ends, ParticleSet& particles);
  Cluster heaviestCluster(const ParticleSet& particles);
  bool isElsewhere(const FloorPose& change) const;
  void adopt(const Cluster& cluster);
  double logLikelihood(const ScanResiduals& residuals) const;
  void compare(double another_view);
  void judge();
  void resample();

  LocalizationParams params_;
  LikelihoodField field_;
  ScanBeams beams_;
  BeamEnds telling_;  // Those of the scan that say where the robot is.
  PoseSearch search_;
  RandomNumbers random_;
  PoseBins bins_;
  OdometryMotion pending_;  // Since the particles were moved.
  FloorPose cluster_pose_;  // Where the estimate was then.
  ParticleSet particles_;
  ParticleSet drawn_;  // The other buffer of resampling.
  ParticleSet rivals_;
  FloorPose rival_pose_;          // Of the heaviest cluster among them.
  double rivals_log_odds_ = 0.0;  // Of that over the estimate.
  double own_share_ = 0.0;        // Of the estimate's cluster, the rivals apart.
  double searched_ = 0.0;         // So many times the map, since there are rivals.
  std::vector<float> cosine_, sine_, log_likelihood_;
  std::vector<std::uint32_t> bin_of_;
  LocalizationEstimate estimate_;
  bool search_everywhere_ = true;
  bool news_ = true;    // The particles were started and not weighed yet.
  int confirmed_ = 0;   // Weighed scans since the cluster's place was found anew.
  bool unfit_ = false;  // The scans do not fit.
};

}  // namespace heel
