// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Where things are taken for people, and where people come: how often, place by place.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace heel {

/// What can be said of a place from where the camera stands.
enum class Sight {
  kUnknown,
  kOutside,  ///< Not in the picture.
  kHidden,   ///< Something stands before it.
  kThing,    ///< What stands there seems to be no person, who may touch it though.
  kFree,     ///< It is seen through: nobody is there, or they would be seen.
};

/// Tells what is seen of a place on the floor, in the observations' frame.
using SightOf = std::function<Sight(const Eigen::Vector2d&)>;

/// How fast places are learned at which things look like people.
struct ClutterMapParams {
  /// Things per square metre that look like people, assumed where nothing is known yet.
  double density_per_m2 = 0.1;
  /// How long a place must be looked at for this to count as much as density_per_m2.
  double prior_s = 1.0;
};

/// What was counted of one body.
struct ClutterCount {
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();
  double time_s = 0.0;   ///< In which it was observed there,
  double thing_s = 0.0;  ///< and of it that in which it was a thing, not a person.
};

/// Things and people a square metre.
struct ClutterDensity {
  double things_per_m2 = 0.0;
  double people_per_m2 = 0.0;
};

/// Remembers, for each place, how much of the time in which it was seen a thing was observed there,
/// and how much a person. Things stay: where nothing was, somebody who is there now came; where
/// something always was, it is no person, however alike. A person stays as likely as they did for
/// that share of the time until now. Who is not known counts as both by their probabilities, so
/// that to be there again at once makes them no more of a thing. A torus of cells of 0.25
/// m, 40 m around: what is further apart shares them. Nothing further than 8 m from the camera is
/// looked at.
class ClutterMap {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit ClutterMap(const ClutterMapParams& params = {});

  /// What is observed there, in a look at a time. @param but  Without this.
  ClutterDensity density(const Eigen::Vector2d& place_m, double stamp_s,
                         const ClutterCount& but = {}) const;

  /// Counts time in which the places around were seen through.
  void look(const Eigen::Vector2d& from_m, const SightOf& sight_of, double time_s);

  /// The clock was set to this: whoever was observed somewhere was there until then.
  void setClock(double stamp_s);

  /// Counts what was observed there until a time.
  void add(const ClutterCount& count, double stamp_s);

 private:
  struct Cell {
    float thing_s = 0.0F;
    float person_s = 0.0F;
    float seen_s = 0.0F;
    double last_s = 0.0;  // When somebody or something was observed there last.
  };

  ClutterMapParams params_;
  std::vector<Cell> cells_;
};

}  // namespace heel
