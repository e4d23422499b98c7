// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where a person who was lost can have gone, and where to look for them.
///
/// Goes beyond the paper, whose robot only turns on the spot ("no search is implemented here").
#pragma once

#include <heel/mapping/floor_pose.hpp>
#include <heel/mapping/laser_scan.hpp>
#include <heel/planning/coarse_floor.hpp>
#include <heel/planning/surroundings.hpp>
#include <heel/planning/trajectory.hpp>

#include <array>
#include <optional>
#include <vector>

namespace heel {

/// How the belief is divided, how people walk, and what the robot sees.
struct SearchMapParams {
  double cell_size_m = 0.2;    ///< Edge of a cell of the belief.
  double body_radius_m = 0.2;  ///< Radius of a person.

  // How people walk.
  double usual_speed_mps = 0.5;  ///< Speed of somebody who stood when last seen, pauses included.
  double straight_s = 2.0;       ///< Time after which a walker has turned by 45 degrees.
  /// Standard deviation of the place where the person was last seen.
  double place_sigma_m = 0.3;

  // What the robot sees, and how it moves.
  DriveLimits limits;              ///< The robot's.
  double field_of_view_rad = 1.0;  ///< Horizontal field of view of the camera.
  double min_range_m = 0.6;        ///< The camera sees nobody nearer than this.
  double max_range_m = 5.0;        ///< The camera sees nobody further away than this.
  double max_scan_m = 6.0;         ///< Legs further away than this can be missed by the laser.
  double notice_s = 0.3;           ///< Time for which a person in view goes unnoticed, on average.
  double spare_m = 0.09;           ///< Free room around the robot at a place to look from.
  double look_s = 1.5;             ///< Time that a look takes, until a track is sure.
  double view_spacing_m = 0.6;     ///< Distance from one place to look from to the next.
};

/// How far one sees on the way to a place.
struct SeenTo {
  SeenTo(const Eigen::Vector2d& to, bool somebody = false) : place(to), by_somebody(somebody) {}
  Eigen::Vector2d place;  ///< There, or where something that the map does not show hides it.
  bool by_somebody;  ///< Somebody stands there, who has just come if nothing was seen there before.
};

/// A place to look from.
struct SearchView {
  FloorPose camera;     ///< Where the camera should be, and look to.
  double chance = 0.0;  ///< That the person is in view there, as far as is known now.
  double time_s = 0.0;  ///< To get there and look.
};

/// A belief about where a lost person is, over the cells of the floor and the eight ways in which
/// they can be walking.
///
/// It begins where the person was last seen, walking as they did. With time it spreads as people
/// walk: mostly straight on, along walls and through doorways, never further than they can have
/// walked. What the camera has looked at without finding them loses its share. So does a room whose
/// doors are seen shut, the longer, the more: they may have been shut when the person came by.
///
/// Deterministic. Nothing allocates after the first start() and nextView().
class SearchMap {
 public:
  /// @param floor  What bars the way, for people and robot.
  /// @param sight  What bars the view of a person: who stands behind a table is seen.
  /// @throws std::invalid_argument  if a parameter is not positive (min_range_m may be 0), or no
  ///                                cell is free.
  SearchMap(const OccupancyGrid& floor, const OccupancyGrid& sight,
            const SearchMapParams& params = {});

  const CoarseFloor& floor() const { return floor_; }

  /// The person may be anywhere.
  void start();

  /// The person was last seen here, with this velocity [m/s], both in the map's frame, so long ago.
  /// @param probability  That it was they; else they are where they were looked for before.
  void start(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity, double ago_s = 0.0,
             double probability = 1.0);

  /// Time goes by. Without a start() nothing happens.
  /// @param is_taken  Whether somebody is seen at a place: they are there still, and nobody else.
  void spread(double elapsed_s, FunctionRef<bool(const Eigen::Vector2d& place)> is_taken);
  void spread(double elapsed_s) {
    spread(elapsed_s, [](const Eigen::Vector2d&) { return false; });
  }

  /// The camera has looked from here for a while, and the person was not found.
  /// @param seenTo  Absent if it is not known. What hides a place is taken to stand there, and
  ///                nobody to walk through it, for as long again as it has till then, or until it
  ///                is seen through. It came half way between when it was last seen through and
  ///                when it was seen first.
  void look(const FloorPose& camera, double elapsed_s,
            FunctionRef<std::optional<SeenTo>(const Eigen::Vector2d&)> seenTo);
  void look(const FloorPose& camera, double elapsed_s) {
    look(camera, elapsed_s,
         [](const Eigen::Vector2d& place) -> std::optional<SeenTo> { return SeenTo(place); });
  }

  /// Somebody is seen at a place, who is the person with a probability: so is the belief there.
  void hold(const Eigen::Vector2d& place, double radius_m, double probability);

  /// The laser has scanned from here for a while: nobody is where its beams went through.
  void scan(const LaserScan& scan, const FloorPose& scanner, double elapsed_s);

  /// The probability that the person is in a cell of the floor; their sum is 1 after a start().
  const std::vector<double>& belief() const { return belief_; }

  /// The same per square metre of floor, within half a metre of a place.
  double density(const Eigen::Vector2d& place) const;

  /// The place from which there is most to see per time, getting there and turning once around
  /// included, and the look from it that promises most. None before start(), or where no chance is
  /// left within reach. Ask again after each look.
  /// @param way_s  How long it takes to get to a place now, if longer than on the map; infinite
  ///               where no way leads: such places come last.
  std::optional<SearchView> nextView(const FloorPose& camera,
                                     FunctionRef<double(const Eigen::Vector2d&)> way_s);
  std::optional<SearchView> nextView(const FloorPose& camera) {
    return nextView(camera, [](const Eigen::Vector2d&) { return 0.0; });
  }

 private:
  static constexpr std::size_t kHeadings = kWays.size();
  static constexpr std::size_t kBearings = 36;
  using Shares = std::array<double, kHeadings>;    ///< Of one cell, by way.
  using Bearings = std::array<double, kBearings>;  ///< Of what is in view, to the left from +X.

  /// Something that the map does not show stands in a cell, and hides what is behind it.
  struct Screen {
    bool stands = false;
    double free_s = 0.0;  ///< When it was last seen through, on the clock; at first, its beginning.
    double since_s = 0.0;  ///< When it came: half way from then until it was seen first.
    double last_s = 0.0;   ///< When it was last seen.
  };

  void turn();
  void walk();
  void shut();
  void sumUp();
  bool isBarred(int cell, double in_s = 0.0) const;
  double passes(const Screen& screen, double in_s) const;
  double passes(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double in_s) const;
  template <typename Use>
  void forCellsBetween(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Use use) const;
  void findViews();
  void thin(double elapsed_s, FunctionRef<bool(int cell)> is_empty);
  bool isSeenThrough(const LaserScan& scan, const FloorPose& scanner,
                     const Eigen::Vector2d& point) const;
  bool seesBody(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  bool isInView(const FloorPose& camera, const Eigen::Vector2d& point) const;
  std::size_t visibleIndex(std::size_t view, int cell) const;
  Bearings chancesAround(std::size_t view, double in_s) const;
  SearchView bestLook(std::size_t view, double way_s, double yaw_rad) const;

  SearchMapParams params_;
  CoarseFloor floor_;
  std::vector<Shares> shares_;
  std::vector<Shares> next_;
  std::vector<double> belief_;
  std::vector<Shares> others_;     ///< Memory of start(), as the next are.
  std::vector<Screen> screens_;    ///< By cell.
  std::vector<bool> is_taken_;     ///< By cell; memory of spread().
  std::vector<int> seen_;          ///< Cells in a look; memory of look().
  std::vector<float> walked_m_;    ///< From where the person was last seen.
  std::vector<double> reached_s_;  ///< On the clock: nobody can have walked there sooner.
  std::vector<double> shut_s_;     ///< Till when it is counted that every way there is barred.
  std::vector<float> open_m_;      ///< The ways that are not; memory of shut().
  int start_ = -1;                 ///< The cell where the person was last seen, if known,
  double lost_s_ = 0.0;            ///< and when, on the clock, weighed by how likely it was they.
  CoarseFloor::Open open_;
  double speed_mps_;
  double clock_s_ = 0.0;
  double carried_s_ = 0.0;  ///< Time that has gone by but is less than a step.

  int reach_cells_ = 0;           ///< Half the edge of a window around a view.
  std::vector<int> view_cells_;   ///< Places to look from.
  std::vector<bool> is_visible_;  ///< Of the cells in the window around each view, row by row.
  std::vector<float> way_m_;      ///< Of the robot; memory of nextView(), as the next are.
  std::vector<double> chances_;   ///< By view, as the next,
  std::vector<double> rates_;     ///< which is per time.
  std::vector<std::size_t> by_rate_;
  CoarseFloor::Open way_open_;
};

}  // namespace heel
