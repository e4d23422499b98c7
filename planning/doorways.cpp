// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/distance_transform.hpp>
#include <heel/planning/doorways.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kMinWidth_m = 0.55;     // Narrower passages are no doorways.
constexpr double kWidens_m = 0.25;       // On both sides of a doorway the way gets wider by this,
constexpr double kWidensWithin_m = 0.9;  // no further from the doorway than this.
constexpr double kDetour_m = 6.0;  // If it were shut, the way to its other side would be longer.
constexpr double kSide_m2 = 2.0;   // Each side of a doorway leads to at least so much free floor.
constexpr double kOneDoorway_m = 0.6;  // Places nearer to each other than this are one doorway.

using Eigen::Vector2d;

constexpr int kDirections = 16;  // Over half a turn.
constexpr double kFar = std::numeric_limits<double>::infinity();

class DoorwaySearch {
 public:
  DoorwaySearch(const OccupancyGrid& map, const DoorwayParams& params)
      : map_(map), params_(params), seen_(map.cells().size(), 0) {}

  std::vector<DoorwayOnMap> run() {
    std::vector<DoorwayOnMap> places = narrowPlaces();
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.width_m < b.width_m; });
    std::vector<DoorwayOnMap> out;
    std::vector<char> used(places.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (used[i] != 0) continue;
      const DoorwayOnMap merged = merge(places, used, i);
      if (joinsRooms(merged)) out.push_back(merged);
    }
    return out;
  }

 private:
  bool isFree(const Vector2d& p) const { return map_.at(p) == Occupancy::kFree; }

  /// Free way from `p` along a unit vector, up to `most`.
  double freeWay(const Vector2d& p, const Vector2d& along, double most) const {
    const double step = 0.5 * map_.cell_size_m();
    double way = 0.0;
    while (way < most && isFree(p + (way + step) * along)) way += step;
    return way;
  }

  /// Whether the way across gets to be `more` wider within `within` metres.
  bool widens(const Vector2d& p, const Vector2d& along, const Vector2d& across, double width,
              double more, double within) const {
    const double reach = freeWay(p, along, within);
    for (double t = map_.cell_size_m(); t <= reach; t += map_.cell_size_m()) {
      const Vector2d there = p + t * along;
      const double most = width + more;
      if (freeWay(there, across, most) + freeWay(there, -across, most) >= most) return true;
    }
    return false;
  }

  std::vector<DoorwayOnMap> narrowPlaces() const {
    std::vector<DoorwayOnMap> out;
    const double cell = map_.cell_size_m();
    std::vector<std::uint8_t> taken(map_.cells().size());
    std::transform(map_.cells().begin(), map_.cells().end(), taken.begin(),
                   [](Occupancy what) -> std::uint8_t { return what != Occupancy::kFree; });
    std::vector<float> away_m;
    DistanceTransform().compute(taken, map_.width(), map_.height(), cell, away_m);
    // Nothing is the middle of a gap that is further than this from all that is not free, and from
    // the map's edge.
    const double most_m = 0.5 * params_.max_width_m + 3.0 * cell;
    for (int y = 0; y < map_.height(); ++y) {
      for (int x = 0; x < map_.width(); ++x) {
        if (taken[map_.index({x, y})] != 0) continue;
        const double edge_m =
            cell * (1 + std::min({x, y, map_.width() - 1 - x, map_.height() - 1 - y}));
        if (std::min(static_cast<double>(away_m[map_.index({x, y})]), edge_m) > most_m) continue;
        const Vector2d p = map_.center({x, y});
        double least = kFar;
        DoorwayOnMap place;
        for (int i = 0; i < kDirections; ++i) {
          const double angle = M_PI * i / kDirections;
          const Vector2d across(std::cos(angle), std::sin(angle));
          const double a = freeWay(p, across, params_.max_width_m);
          if (a >= params_.max_width_m) continue;
          const double b = freeWay(p, -across, params_.max_width_m);
          const double width = a + b;
          if (width >= least) continue;
          least = width;
          place = {p + 0.5 * (a - b) * across, Vector2d(across.y(), -across.x()), width};
          // Only the middle of a gap stands for it.
          if (std::abs(a - b) > 2.0 * cell) place.width_m = kFar;
        }
        if (!(least >= kMinWidth_m && place.width_m <= params_.max_width_m)) continue;
        const Vector2d across(-place.through.y(), place.through.x());
        const double depth = 0.4;  // Both sides can be walked.
        if (freeWay(place.center, place.through, depth) < depth ||
            freeWay(place.center, -place.through, depth) < depth) {
          continue;
        }
        // A doorway is short: it ends on both sides, and at least one of them is a room.
        const double edge = 0.9 * cell;
        const auto ends = [&](const Vector2d& along) {
          return widens(place.center, along, across, least, edge, params_.depth_m);
        };
        const auto opens = [&](const Vector2d& along) {
          return widens(place.center, along, across, least, kWidens_m, kWidensWithin_m);
        };
        if (ends(place.through) && ends(-place.through) &&
            (opens(place.through) || opens(-place.through))) {
          out.push_back(place);
        }
      }
    }
    return out;
  }

  /// The middle of all places near the `first` that are about as narrow.
  DoorwayOnMap merge(const std::vector<DoorwayOnMap>& places, std::vector<char>& used,
                     std::size_t first) const {
    DoorwayOnMap out = places[first];
    Vector2d sum = Vector2d::Zero();
    int count = 0;
    for (std::size_t i = first; i < places.size(); ++i) {
      if ((places[i].center - places[first].center).norm() > kOneDoorway_m) continue;
      used[i] = 1;
      const bool alike = std::abs(places[i].through.dot(out.through)) > 0.98 &&
                         places[i].width_m < out.width_m + 1.1 * map_.cell_size_m();
      if (!alike) continue;
      sum += places[i].center;
      ++count;
    }
    out.center = sum / count;
    return out;
  }

  bool isShut(const DoorwayOnMap& door, const Vector2d& p) const {
    const Vector2d local = door.local(p);
    return std::abs(local.x()) <= 1.1 * map_.cell_size_m() &&
           std::abs(local.y()) <= 0.5 * door.width_m + 2.0 * map_.cell_size_m();
  }

  /// Whether no short way leads from one side to the other, and each side leads to a room.
  bool joinsRooms(const DoorwayOnMap& door) {
    const Vector2d off = 0.3 * door.through;
    double area = 0.0;
    if (flood(door, door.center + off, door.center - off, area)) return false;
    if (area < kSide_m2) return false;
    if (flood(door, door.center - off, door.center + off, area)) return false;
    return area >= kSide_m2;
  }

  /// Floods from `from` as far as the detour; true if it gets to `to`.
  bool flood(const DoorwayOnMap& door, const Vector2d& from, const Vector2d& to, double& area) {
    ++round_;
    const GridCell goal = map_.cellAt(to);
    front_.assign(1, map_.cellAt(from));
    std::size_t count = 0;
    if (!map_.contains(front_.front()) || !map_.contains(goal)) return true;
    seen_[map_.index(front_.front())] = round_;
    const int most = static_cast<int>(kDetour_m / map_.cell_size_m());
    for (int step = 0; step < most && !front_.empty(); ++step) {
      next_.clear();
      for (const GridCell& c : front_) {
        ++count;
        for (const GridCell& n : {GridCell{c.x + 1, c.y}, GridCell{c.x - 1, c.y},
                                  GridCell{c.x, c.y + 1}, GridCell{c.x, c.y - 1}}) {
          if (!map_.contains(n) || map_.at(n) != Occupancy::kFree) continue;
          if (seen_[map_.index(n)] == round_ || isShut(door, map_.center(n))) continue;
          if (n == goal) return true;
          seen_[map_.index(n)] = round_;
          next_.push_back(n);
        }
      }
      front_.swap(next_);
    }
    area = static_cast<double>(count) * map_.cell_size_m() * map_.cell_size_m();
    return false;
  }

  const OccupancyGrid& map_;
  const DoorwayParams& params_;
  std::vector<int> seen_;  // The round in which a cell was last reached.
  int round_ = 0;
  std::vector<GridCell> front_, next_;
};

}  // namespace

double inPassage(const DoorwayOnMap& doorway, const Eigen::Vector2d& point, double depth_m,
                 double radius_m) {
  const Eigen::Vector2d local = doorway.local(point).cwiseAbs();
  const double across = 0.5 * doorway.width_m + radius_m;
  if (local.x() >= depth_m || local.y() >= across) return 0.0;
  return (1.0 - local.x() / depth_m) * std::min(1.0, 2.0 * (1.0 - local.y() / across));
}

bool isInPassage(const std::vector<DoorwayOnMap>& doorways, const Eigen::Vector2d& point,
                 double depth_m, double radius_m) {
  return std::any_of(doorways.begin(), doorways.end(), [&](const DoorwayOnMap& doorway) {
    return inPassage(doorway, point, depth_m, radius_m) > 0.0;
  });
}

std::vector<DoorwayOnMap> findDoorways(const OccupancyGrid& map, const DoorwayParams& params) {
  if (map.empty()) throw std::invalid_argument("a map without cells has no doorways");
  if (!(params.max_width_m > kMinWidth_m) || !(params.depth_m > 0.0)) {
    throw std::invalid_argument("the doorways' parameters are out of order");
  }
  return DoorwaySearch(map, params).run();
}

}  // namespace heel
