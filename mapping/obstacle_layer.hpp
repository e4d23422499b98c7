// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What stands around the robot now and is not on the map: furniture, people, table tops.
#pragma once

#include <heel/mapping/distance_transform.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/mapping/occupancy_grid.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace heel {

/// How far the layer sees and how long it remembers. The defaults suit a robot at walking pace
/// indoors, with a planar laser at 10 Hz and a stereo camera.
struct ObstacleLayerParams {
  double size_m = 16.0;  ///< Edge of the window that is looked at, with the robot in its middle.
  double cell_size_m = 0.05;  ///< Edge of a cell.

  double min_height_m = 0.06;  ///< Points lower than this are floor.
  double max_height_m = 1.2;   ///< Points higher than this pass over the robot.
  double point_range_m = 4.0;  ///< Points further than this from the robot are too uncertain.
  int min_points = 3;          ///< Points in a cell, in one frame, that make an obstacle.
  double own_radius_m = 0.15;  ///< What seems this near to the base's origin is the robot itself.

  double laser_height_m = 0.3;  ///< Height of the laser's plane over the floor.
  /// Points this near to the laser's plane are seen by the laser too.
  double laser_thickness_m = 0.1;
  double laser_min_range_m = 0.05;  ///< Shorter ranges of the laser are faults.
  double laser_max_range_m = 8.0;   ///< A beam without an echo has seen free space up to here.
  /// A beam clears as far as its neighbours are no further apart than this; beyond, a chair's leg
  /// fits between two beams, and its absence in a scan says nothing.
  double clear_spacing_m = 0.05;
  double clear_after_s = 0.3;  ///< What was seen more recently than this is not cleared.

  /// An obstacle that was seen for less than this is remembered for no longer than this, and so are
  /// people: a false match of one frame must not close a doorway for long.
  double min_memory_s = 0.5;
  /// Any other is remembered for 30 times as long as it was seen, until it is seen through (it may
  /// be too near to be), or for so long at most.
  double max_memory_s = 60.0;
};

/// A rolling window of the floor in world axes around the robot, with what the laser and the
/// camera's points saw there recently.
///
/// One frame is `begin`, then any number of scans and points, then `finish`; results are those of
/// the last `finish`. Cells that stay in the window keep what they hold, bit by bit, when the robot
/// moves.
///
/// The two sources are kept apart. A planar laser passes under table tops and chair seats and over
/// low boxes, and has no echo of a black sofa. So its free space clears what the laser itself saw,
/// and of what the camera saw only cells that had points in the laser's plane, before an echo. All
/// else stays until the camera sees through it, or it is old; people are forgotten soon, for they
/// walk.
///
/// Time is what `begin` says, and only its increase counts: a clock that is set back ages nothing,
/// and one that is set forward forgets. Poses may be in any frame that does not jump; odometry's
/// keeps obstacles sharper than one that localization corrects.
///
/// Nothing is allocated after the construction, but for more people than ever.
class ObstacleLayer {
 public:
  /// @throws std::invalid_argument  if a parameter is out of range.
  explicit ObstacleLayer(const ObstacleLayerParams& params = {});

  const ObstacleLayerParams& params() const { return params_; }

  /// Moves the window to the robot.
  /// @param stamp_s  Of the readings that follow.
  /// @param target   Where the person is who is followed: readings in there are left out. What was
  ///                 seen there before stays until it is forgotten.
  /// @param people   Where others are: what is seen in there is remembered for `min_memory_s`.
  /// @throws std::invalid_argument  if a number is not finite.
  void begin(double stamp_s, const FloorPose& T_world_base,
             const std::optional<FloorDisc>& target = std::nullopt,
             const std::vector<FloorDisc>& people = {});

  /// Each beam clears the cells before its end, and the end is an obstacle. Ranges that are not
  /// numbers or too short are left out; infinite ones are free up to `laser_max_range_m`.
  /// @param is_mapped  Whether the map shows what is at a place: no obstacle of this layer then. A
  ///                   wall seen with a little error would else make doorways narrower.
  /// @throws std::invalid_argument  if the scan's angles are not finite or the laser is further off
  ///                                than the window is wide.
  void addScan(const LaserScan& scan, const FloorPose& T_base_laser,
               const std::function<bool(const Eigen::Vector2d&)>& is_mapped = {});

  /// Points in the base frame; those that are not finite are left out. Points of one frame add up
  /// in their cells, over all calls.
  void addPoints(const std::vector<Eigen::Vector3f>& points);
  void addPoints(const Eigen::Vector3f* points, std::size_t count);

  /// Something is there that no sensor sees; remembered for `max_memory_s`, whatever is seen.
  void touch(const Eigen::Vector2d& in_base);

  /// Forgets what the camera saw where it now sees through it.
  /// @param sees_through  Asked for points in the base frame, at the height of what was seen.
  void clear(const std::function<bool(const Eigen::Vector3f&)>& sees_through);

  /// Forgets what is old and renews the results.
  void finish();

  /// The window: occupied where something was seen and not yet forgotten, else free, as far as
  /// this layer knows. As large as the window from the start, and free before the first frame.
  const OccupancyGrid& window() const { return window_; }

  /// Middles of the occupied cells, in the world.
  const std::vector<Eigen::Vector2d>& obstacles() const { return obstacles_; }

  /// Of these, where all points were at the height 0.
  const std::vector<Eigen::Vector2d>& steps() const { return steps_; }

  /// From the middle of the point's cell to the middle of the nearest occupied one [m]; that is at
  /// most 1.42 cells more than from the point to the cell itself. Infinite without obstacles and
  /// outside of the window, where nothing is known.
  double distance(const Eigen::Vector2d& point) const;

  /// For how long what is in each of the window's cells has been seen there [s], row by row:
  /// infinite for steps and for what was touched, not a number where nothing is.
  const std::vector<float>& stood_s() const { return stood_s_; }

  /// Distances of the window's cells [m], row by row.
  const std::vector<float>& distances_m() const { return distances_m_; }

 private:
  /// Since when a source has seen something in a cell, and when it last did.
  struct Trace {
    double since_s = 0.0;
    double seen_s = 0.0;
    bool known = false;

    double lasted_s() const { return seen_s - since_s; }
  };
  struct Cell {
    Trace laser;
    Trace points;
    double touched_s = -std::numeric_limits<double>::infinity();
    bool at_laser_height = false;  // the points
    bool frame_at_laser_height = false;
    float height_m = 0.0F;  // of the highest of the points, as last seen
    bool frame_is_somebody = false;
    float frame_height_m = 0.0F;
    std::uint16_t frame_points = 0;
  };

  bool remembered(const Trace& trace) const;
  void see(Trace& trace, bool is_somebody) const;
  bool mayClear(const Trace& trace) const;
  bool inWindow(const GridCell& world_cell) const;
  std::size_t slot(const GridCell& world_cell) const;
  GridCell worldCell(const Eigen::Vector2d& point) const;
  bool leftOut(const Eigen::Vector2d& point) const;
  bool isSomebody(const Eigen::Vector2d& point) const;
  void roll(const GridCell& corner);
  void forgetUnderRobot();
  void requireFrame() const;
  void clearAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double length_m,
                  bool has_echo);
  void addPoint(const Eigen::Vector3f& point);

  ObstacleLayerParams params_;
  int cells_per_edge_;
  std::vector<Cell> cells_;  // a ring in both directions, by world cell modulo the window
  GridCell corner_;          // world cell of the window's least x and y
  bool begun_ = false;
  double clock_s_ = 0.0;  // advances by the positive steps of the stamps
  std::optional<double> stamp_s_;
  FloorPose T_world_base_;
  std::optional<FloorDisc> target_;
  std::vector<FloorDisc> people_;
  std::vector<std::size_t> touched_;  // cells with points in this frame

  OccupancyGrid window_;
  std::vector<Eigen::Vector2d> obstacles_, steps_;
  std::vector<std::uint8_t> occupied_;
  std::vector<float> distances_m_;
  std::vector<float> stood_s_;
  DistanceTransform transform_;
};

}  // namespace heel
