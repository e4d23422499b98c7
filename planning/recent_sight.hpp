// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a robot's sensors have seen lately: things, and where there are none.
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace heel {

/// A camera, and what a picture of it renews.
struct CameraView {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();  ///< z is the line of sight.
  /// What is within these tangents of the line of sight, across and up,
  Eigen::Array2d half_view = Eigen::Array2d::Zero();
  double nearest_m = 0.45;  ///< and further from the camera than this,
  double range_m = 2.0;     ///< and nearer than this.
};

/// Where the sensors are, and for how long what they saw is known.
struct RecentSightParams {
  FloorPose T_base_scanner;  ///< Where the laser scanner is, in the base frame.
  /// What no sensor looks at any more is known for so long: longer than a robot takes to turn
  /// about, shorter than people stay. A user's choice.
  double remembers_s = 4.0;
  /// So many of a picture's points in a cell of 5 cm are a thing; fewer are errors of the stereo.
  int min_points = 6;
  std::vector<CameraView> cameras;  ///< Each is told by its place here.
};

/// A point of what was seen.
struct SeenThing {
  static constexpr int kByLaser = -1;

  Eigen::Vector2d place;
  double height_m;  ///< Of the highest that a picture saw there; 0 by the laser, and of a step.
  double seen_s;
  int camera;                ///< Which one saw it, or kByLaser.
  bool is_sure;              ///< By the laser, or in two pictures one after the other.
  bool roams;                ///< It came from elsewhere in the last `remembers_s`,
  bool is_somebody;          ///< or in the last half minute (at most 8 times that).
  Eigen::Vector2d velocity;  ///< Of what roams: of the middle of all within a body's width.
  double gait_mps;  ///< Its owner's velocity is so far from that, any way; 0 for who stands.
};

/// Remembers the newest scans, and the points that scans and pictures saw. All poses are of the
/// base in one frame that does not jump, the odometry's. Nothing is allocated once as many things
/// have been seen as ever will be.
///
/// What a scan sees five standard deviations of the laser's ranges, and no less than 5 cm, before
/// where another saw nothing has come there: it may be somebody who walks. These errors are
/// measured while the robot stands, by what most of the beams tell; until then they are taken for 1
/// cm. To them comes 5% of the way between the two scans, and of the turn, for the odometry.
class RecentSight {
 public:
  static constexpr std::size_t kMostThings = 4096;

  /// @param range_m  What a scan sees further away is left out.
  /// @param keeps_m  What the laser saw stand so near to the base's origin is known until it is
  ///                 looked at again: an end of a long body that turns would swing into it.
  /// @throws std::invalid_argument  if a parameter is out of its range.
  RecentSight(const RecentSightParams& params, double range_m, double keeps_m = 0.0);

  /// @param base     Where the base was at `stamp_s`, when the scan was measured.
  /// A scan that is not later than the last is left out.
  void addScan(const LaserScan& scan, const FloorPose& base, double stamp_s);

  /// What is out of the view of the camera's next picture is known on if two pictures have seen it:
  /// one alone may be an error of the stereo. All of a picture's points over the floor that are in
  /// the robot's way, in the base frame of `stamp_s` [m].
  /// @param camera  Which one took it, of the parameters'.
  /// @param steps  All that is known of where the floor ends, there: a robot is near a step long
  ///               after it saw it.
  /// @throws std::out_of_range  if there is no such camera.
  void addPoints(int camera, const std::vector<Eigen::Vector3f>& points, const FloorPose& base,
                 double stamp_s, const std::vector<Eigen::Vector2d>& steps = {});

  /// Standard deviation of the laser's ranges, as far as it is known [m].
  double laserSigma() const { return sigma_m_; }

  /// At most kMostThings, of which some may be older than is remembered.
  const std::vector<SeenThing>& things() const { return things_; }

  /// When the newest scan was measured.
  double newest_s() const { return looks_[newest_].stamp_s; }

  /// The middle of the body that a thing is a part of, as far as the newest scan sees it: of all
  /// that is somebody's within a body's width. Absent unless two beams or more see somebody there:
  /// a leg is as wide as that, and one alone is an error.
  std::optional<Eigen::Vector2d> bodyAround(const SeenThing& thing) const;

  /// Distance from a place to the nearest of them [m].
  double clearance(const Eigen::Vector2d& place) const;

  /// Whether a scan since then has seen that a place is free: both beams beside it end no nearer
  /// than `short_m` before it.
  bool isSeen(const Eigen::Vector2d& place, double short_m, double since_s);

  /// Whether all beams of the newest scan, so far to both sides of a place, end beyond it.
  bool seesFree(const Eigen::Vector2d& place, double aside_m) const;

  /// What a robot that stands can not see of its way straight on: the strips along both sides of
  /// the body of this radius, whose foremost disc is so far ahead, so wide, as far ahead as its
  /// scanner's first and last beam leave them [m].
  double besideView(double body_m, double front_m) const;

 private:
  struct Look {
    Eigen::Vector2d scanner = Eigen::Vector2d::Zero();
    Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();  // from the odometry's axes to its own
    double stamp_s = 0.0;
    double driven_m = 0.0, turned_rad = 0.0;  // since the first
    LaserScan scan;
  };
  struct Part {
    Eigen::Vector2d place;
    double stamp_s;
  };
  using Parts = std::vector<Part>::const_iterator;
  struct Cell {
    std::uint16_t points = 0;
    bool is_sure = false;
    Eigen::Vector2f nearest = Eigen::Vector2f::Zero();
    float highest_m = 0.0F;
  };
  static double beamTo(const Look& look, const Eigen::Vector2d& at);
  static bool endsBeyond(const Look& look, double beam, double away_m);
  static bool endBeyond(const Look& look, const Eigen::Vector2d& place, double aside_m,
                        double beyond_m);
  bool sees(const Look& look, const Eigen::Vector2d& thing) const;
  static bool sawFree(const Look& look, const Eigen::Vector2d& place, double short_m);
  bool isInPicture(const SeenThing& thing, const FloorPose& T_base_world) const;
  const Look& lookBefore(std::size_t count) const;
  bool wasFree(const Eigen::Vector2d& place, const Look& now, const Look& before) const;
  double lastFree(const Eigen::Vector2d& place) const;
  Parts partsSince(Parts end, double stamp_s) const;  // of those before `end`
  static bool middleOf(Parts first, Parts end, Eigen::Vector2d& at);
  void tellWalk(SeenThing& thing) const;
  void tellWalks(double stamp_s);
  void keep(const SeenThing& thing);
  void layOut();
  void measureErrors(const Look& look, const Look& last);

  RecentSightParams params_;
  double range_m_, keeps_m_;
  double sigma_m_;
  double surface_m_;             // so far behind a beam's end is the thing that it hit
  double measured_ = 0.0;        // so many scans of a robot that stood
  std::vector<double> steps_m_;  // of the beams, from the last scan to this
  std::vector<SeenThing> things_;
  Eigen::ArrayX2d places_;   // theirs, in the first rows
  std::vector<Look> looks_;  // a ring; looks_[newest_] is the last,
  std::size_t newest_ = 0;
  Look next_;                // and this the one to come
  std::vector<Part> parts_;  // of somebody, in the scans of the last stride, as they came
  std::size_t saw_ = 0;      // the look that saw the last place that was asked for
  std::vector<Cell> cells_;
  std::vector<double> points_s_;  // of each camera's last picture
};

}  // namespace heel
