// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The search for a person who was lost: where to look next, until the time for it is over.
#pragma once

#include <heel/planning/search_map.hpp>
#include <heel/planning/surroundings.hpp>

#include <optional>

namespace heel {

/// How a person who is lost is looked for.
struct PersonSearchParams {
  SearchMapParams map;
  double budget_s = 600.0;  ///< A search ends after so long; looks at people are not counted.
  double new_view_s = 3.0;  ///< How often the robot chooses anew where to look.
};

/// Keeps, from the moment of a loss on, where the person can be: spread by time, thinned by looks.
class PersonSearch {
 public:
  /// Of these, one bars the way and one the view.
  /// @throws std::invalid_argument  if a parameter is out of its range, or no cell is free.
  PersonSearch(const OccupancyGrid& floor, const OccupancyGrid& sight,
               const PersonSearchParams& params = {});

  /// Nobody knows where they are.
  void begin() { map_.start(); }
  /// They are lost; a while ago they were here, and walked so.
  /// @param probability  That it was they; else they are still where they were looked for before.
  void lose(const MovingPerson& last, double unseen_s, double probability);
  /// Time goes by without them. @param is_taken  See SearchMap.
  void wait(double elapsed_s, FunctionRef<bool(const Eigen::Vector2d&)> is_taken) {
    map_.spread(elapsed_s, is_taken);
  }
  /// They were not before the camera, which looked from here. @param seenTo  See SearchMap.
  void look(const FloorPose& camera, double elapsed_s,
            FunctionRef<std::optional<SeenTo>(const Eigen::Vector2d&)> seenTo) {
    map_.look(camera, elapsed_s, seenTo);
  }
  /// Somebody is seen there, who is the person with a probability.
  void hold(const Eigen::Vector2d& place, double radius_m, double probability) {
    map_.hold(place, radius_m, probability);
  }
  /// Nor where the laser's beams went through.
  void scan(const LaserScan& scan, const FloorPose& scanner, double elapsed_s) {
    map_.scan(scan, scanner, elapsed_s);
  }

  /// Where they may be; see SearchMap.
  double density(const Eigen::Vector2d& place) const { return map_.density(place); }

  /// Chooses what to look at, if the last choice is old or the robot `is_there`; takes from the
  /// budget. @param way_s  See SearchMap::nextView(). @return whether it is another place.
  bool choose(double elapsed_s, const FloorPose& robot, bool is_there,
              FunctionRef<double(const Eigen::Vector2d&)> way_s);
  /// The choice; nothing if nothing is left to look at.
  const std::optional<SearchView>& view() const { return view_; }
  /// Another choice, next time.
  void restart() { view_.reset(); }
  /// Whether the time is used up, or nothing is left to look at.
  bool isOver() const { return is_over_ || searched_s_ > params_.budget_s; }

 private:
  PersonSearchParams params_;
  SearchMap map_;
  std::optional<SearchView> view_;
  double view_age_s_ = 0.0;
  double searched_s_ = 0.0;
  bool is_over_ = false;
};

}  // namespace heel
