// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_sight.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

constexpr double kClose_m = 0.3;  // As much apart a surface may be and still go on.
// Shares of what is observed in simulated rooms, of people and of things: those that are seen
// through, and as many whose surface goes on at both sides.
constexpr double kOfPeople = 0.02;
constexpr double kOfThings = 0.2;

}  // namespace

DepthSight::Seen DepthSight::compare(const Eigen::Vector2d& place_m, double height_m,
                                     double tolerance_m) const {
  const Eigen::Vector3d p = T_camera_frame_ * Eigen::Vector3d(place_m.x(), place_m.y(), height_m);
  const Eigen::Vector2d pixel = project(camera_, p);
  const Eigen::Array2d size(depth_m_.cols, depth_m_.rows);
  if (!(p.z() > 0.1 && (pixel.array() >= 0.0).all() && (pixel.array() < size).all())) {
    return {Depth::kOutside, 0.0};
  }
  const Eigen::Vector2i at = pixel.cast<int>();
  const auto depth = static_cast<double>(depth_m_.at<float>(at.y(), at.x()));
  if (!(depth > 0.0)) return {Depth::kNone, 0.0};
  const double behind_m = depth - p.z(), share = depth / p.z();
  if (behind_m > tolerance_m) return {Depth::kFarther, share};
  return {behind_m < -tolerance_m ? Depth::kNearer : Depth::kSame, share};
}

DepthSight::Trunk DepthSight::trunkAt(const Eigen::Vector2d& place_m, double tolerance_m) const {
  int hidden = 0, free = 0, outside = 0;
  double nearest = 1.0;
  for (const double height_m : {0.9, 1.2, 1.5}) {
    const Seen seen = compare(place_m, height_m, tolerance_m);
    outside += seen.depth == Depth::kOutside ? 1 : 0;
    free += seen.depth == Depth::kFarther ? 1 : 0;
    hidden += seen.depth == Depth::kNearer ? 1 : 0;
    if (seen.depth == Depth::kNearer) nearest = std::min(nearest, seen.share);
  }
  if (outside >= 2) return {Sight::kOutside, nearest};
  if (free >= 2) return {Sight::kFree, nearest};
  return {hidden >= 2 ? Sight::kHidden : Sight::kUnknown, nearest};
}

std::optional<Eigen::Vector2d> DepthSight::seenTo(const Eigen::Vector2d& place_m) const {
  const Trunk trunk = trunkAt(place_m, kTolerance_m);
  if (trunk.sight == Sight::kFree) return place_m;
  if (trunk.sight != Sight::kHidden) return std::nullopt;
  const Eigen::Vector2d camera_m = T_camera_frame_.inverse().translation().head<2>();
  return camera_m + trunk.nearest * (place_m - camera_m);
}

double DepthSight::logPerson(const Eigen::Vector2d& place_m, const Eigen::Vector2d& side_m,
                             double depth_sigma_m) const {
  static const double odd = std::log(kOfPeople / kOfThings);
  static const double usual = std::log((1.0 - 2.0 * kOfPeople) / (1.0 - 2.0 * kOfThings));
  const double tolerance_m = std::max(kClose_m, 2.0 * depth_sigma_m);
  if (at(place_m, tolerance_m) == Sight::kFree) return odd;
  int sides_seen = 0, sides_same = 0;
  for (const double side : {-1.0, 1.0}) {
    int same = 0, farther = 0;
    for (const double height_m : {0.5, 0.7, 0.9, 1.1, 1.3, 1.5}) {
      const Depth depth = compare(place_m + side * side_m, height_m, tolerance_m).depth;
      same += depth == Depth::kSame ? 1 : 0;
      farther += depth == Depth::kFarther ? 1 : 0;
    }
    if (same + farther < 2) continue;
    ++sides_seen;
    sides_same += same >= farther ? 1 : 0;
  }
  if (sides_seen < 2) return 0.0;
  return sides_same == 2 ? odd : usual;
}

}  // namespace heel
