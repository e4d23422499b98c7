// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/recent_sight.hpp>
#include <heel/planning/surroundings.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kLooks = 20;       // So many are kept of the time that all is known,
constexpr std::size_t kMostLooks = 160;  // of all: for half a minute, if 4 s are remembered;
constexpr std::size_t kSpares = 4;       // and each so many'th is asked who came.
constexpr double kSlip = 0.05;           // Of its way and its turn the odometry may miss so much.
constexpr double kNotYet = -std::numeric_limits<double>::infinity();
constexpr double kCell_m = 0.05;        // Of the camera's points,
constexpr int kCells = 48;              // so many on each side of a square about the robot.
constexpr double kSame_m = 0.1;         // So far apart two pictures may see one thing.
constexpr double kSurface_m = 0.05;     // So far behind a beam's end may be the thing that it hit:
constexpr double kSurfaceSigmas = 5.0;  // errors of ranges are larger once in 200,000 times.
constexpr double kStands = 1e-3;        // Who moves and turns less from scan to scan [m, rad].
constexpr std::size_t kFewBeams = 20;   // Fewer tell nothing of all.
constexpr double kManyScans = 100.0;    // A mean over more forgets the oldest.
constexpr double kMedianStep = 0.954;   // Of two normal errors' difference: 0.6745 * sqrt(2) sigma.
constexpr double kBody_m = 0.4;         // So far apart are parts of one body.
constexpr double kLeg_m = 0.12;         // So wide is one.
constexpr double kStride_s = 0.5;       // So long takes a step of somebody who walks.
constexpr double kGait_mps = 0.4;  // So far off how somebody seems to walk is, at most: 95 of 100.
constexpr double kRounding_rad = 1e-9;

}  // namespace

RecentSight::RecentSight(const RecentSightParams& params, double range_m, double keeps_m)
    : params_(params),
      range_m_(range_m),
      keeps_m_(keeps_m),
      sigma_m_(kSurface_m / kSurfaceSigmas),
      surface_m_(kSurface_m),
      places_(kMostThings, 2),
      looks_(kMostLooks),
      cells_(kCells * kCells),
      points_s_(params.cameras.size(), kNotYet) {
  const auto check = [](const std::initializer_list<double>& values) {
    for (const double value : values) {
      if (!(value >= 0.0) || !std::isfinite(value)) {
        throw std::invalid_argument("RecentSightParams: a parameter is out of its range");
      }
    }
  };
  check({params.remembers_s, params.min_points - 1.0});
  for (const CameraView& view : params.cameras) {
    check({view.half_view.minCoeff(), view.nearest_m, view.range_m});
  }
  things_.reserve(kMostThings);
  for (Look& look : looks_) look.stamp_s = kNotYet;
}

// How many beams after the first a place is; the greatest is one before the first.
double RecentSight::beamTo(const Look& look, const Vector2d& at) {
  return look.scan.beamAt(std::atan2(at.y(), at.x()));
}

// Whether a beam ends beyond a distance.
bool RecentSight::endsBeyond(const Look& look, double beam, double away_m) {
  const std::size_t i = look.scan.index(beam);
  if (i >= look.scan.ranges_m.size()) return false;
  const auto range_m = static_cast<double>(look.scan.ranges_m[i]);
  return range_m > 0.0 && range_m > away_m;  // Not where it is not a number.
}

// Whether the beam next to a thing goes through it, or ends at it.
bool RecentSight::sees(const Look& look, const Vector2d& thing) const {
  const Vector2d at = look.turn * (thing - look.scanner);
  return endsBeyond(look, std::round(beamTo(look, at)), at.norm() - surface_m_);
}

// Whether a look has seen that a place is free: both beams beside it end no nearer than `short_m`
// before it.
bool RecentSight::sawFree(const Look& look, const Vector2d& place, double short_m) {
  const Vector2d at = look.turn * (place - look.scanner);
  const double beam = std::floor(beamTo(look, at)), away_m = at.norm() - short_m;
  return endsBeyond(look, beam, away_m) && endsBeyond(look, beam + 1.0, away_m);
}

// Of the ring of looks, the one that saw the last place is asked first.
bool RecentSight::isSeen(const Vector2d& place, double short_m, double since_s) {
  if (looks_[saw_].stamp_s >= since_s && sawFree(looks_[saw_], place, short_m)) return true;
  for (std::size_t i = 0; i < looks_.size() && lookBefore(i).stamp_s >= since_s; ++i) {
    if (!sawFree(lookBefore(i), place, short_m)) continue;
    saw_ = static_cast<std::size_t>(&lookBefore(i) - looks_.data());
    return true;
  }
  return false;
}

// Whether all beams so far to both sides of a place end so far beyond it.
bool RecentSight::endBeyond(const Look& look, const Vector2d& place, double aside_m,
                            double beyond_m) {
  const Vector2d at = look.turn * (place - look.scanner);
  const double away_m = at.norm();
  if (!(aside_m < away_m)) return false;  // Not where it is not a number.
  const double beams = std::ceil(aside_m / away_m / std::abs(look.scan.step_rad));
  const double first = std::floor(beamTo(look, at));
  for (double k = -beams; k <= beams + 1.0; ++k) {
    if (!endsBeyond(look, first + k, away_m + beyond_m)) return false;
  }
  return true;
}

bool RecentSight::seesFree(const Vector2d& place, double aside_m) const {
  return endBeyond(looks_[newest_], place, aside_m, 0.0);
}

// The look that was `count` before the last.
const RecentSight::Look& RecentSight::lookBefore(std::size_t count) const {
  return looks_[(newest_ + looks_.size() - count) % looks_.size()];
}

// Whether a look saw nothing where another sees something. Seen from elsewhere, an error of the
// range is one aside: so an edge is no news beside itself.
bool RecentSight::wasFree(const Vector2d& place, const Look& now, const Look& before) const {
  const Vector2d way = (place - now.scanner).normalized();
  const Vector2d was = place - before.scanner;
  const double away_m = was.norm(), turned_rad = now.turned_rad - before.turned_rad;
  const double slips_m = kSlip * (now.driven_m - before.driven_m + away_m * turned_rad);
  const double aside_m =
      surface_m_ * std::abs(way.x() * was.y() - way.y() * was.x()) / away_m + slips_m;
  return endBeyond(before, place, aside_m, surface_m_ + slips_m);
}

// When a look last saw nothing where the last sees something.
double RecentSight::lastFree(const Vector2d& place) const {
  const Look& now = looks_[newest_];
  for (std::size_t i = 1; i < looks_.size(); i += kSpares) {
    const Look& look = lookBefore(i);
    if (now.stamp_s - look.stamp_s > kStays_s) break;
    if (wasFree(place, now, look)) return look.stamp_s;
  }
  return kNotYet;
}

// The middle of what was somebody's within a body's width of `at` in one scan; false if nothing
// was.
bool RecentSight::middleOf(Parts first, Parts end, Vector2d& at) {
  Vector2d sum = Vector2d::Zero();
  int count = 0;
  for (Parts part = first; part != end; ++part) {
    if ((part->place - at).squaredNorm() > kBody_m * kBody_m) continue;
    sum += part->place;
    ++count;
  }
  if (count > 0) at = sum / count;
  return count > 0;
}

RecentSight::Parts RecentSight::partsSince(Parts end, double stamp_s) const {
  return std::lower_bound(parts_.begin(), end, stamp_s,
                          [](const Part& part, double s) { return part.stamp_s < s; });
}

// How somebody walks by the middle of their parts, from scan to scan back for a stride: one leg
// stands while the other swings.
void RecentSight::tellWalk(SeenThing& thing) const {
  thing.velocity.setZero();
  thing.gait_mps = kFastestWalk_mps;
  Vector2d at = thing.place, now = at;
  for (Parts end = parts_.end(); end != parts_.begin();) {
    const double stamp_s = std::prev(end)->stamp_s;
    const Parts first = partsSince(end, stamp_s);
    if (!middleOf(first, end, at)) break;
    end = first;
    const double in_s = thing.seen_s - stamp_s;
    if (in_s == 0.0) {
      now = at;
      continue;
    }
    const bool stands = in_s > 0.5 * kStride_s && (now - at).norm() < surface_m_;
    thing.velocity = stands ? Vector2d::Zero() : Vector2d((now - at) / in_s);
    thing.gait_mps = stands ? 0.0 : kGait_mps;
  }
}

// How all that the newest scan saw walks. Whose parts may be taken for those of somebody who
// stands: how they walk is not known.
void RecentSight::tellWalks(double stamp_s) {
  const auto isOlder = [&](const SeenThing& thing) { return thing.seen_s != stamp_s; };
  const auto first = std::find_if(things_.rbegin(), things_.rend(), isOlder).base();
  std::for_each(first, things_.end(), [this](SeenThing& thing) {
    if (thing.roams) tellWalk(thing);
  });
  for (auto thing = first; thing != things_.end(); ++thing) {
    const auto standsBeside = [&](const SeenThing& other) {
      return other.is_somebody && other.gait_mps == 0.0 &&
             (other.place - thing->place).squaredNorm() < 4.0 * kBody_m * kBody_m;
    };
    if (thing->gait_mps == 0.0 || std::none_of(first, things_.end(), standsBeside)) continue;
    thing->velocity.setZero();
    thing->gait_mps = kFastestWalk_mps;
  }
}

// Most of what a standing robot sees stands, too. A thing that moved is beyond errors, or too few.
void RecentSight::measureErrors(const Look& look, const Look& last) {
  const std::vector<float>& now_m = look.scan.ranges_m;
  const std::vector<float>& last_m = last.scan.ranges_m;
  if (now_m.size() != last_m.size() || look.driven_m - last.driven_m > kStands ||
      look.turned_rad - last.turned_rad > kStands) {
    return;
  }
  steps_m_.clear();
  for (std::size_t i = 0; i < now_m.size(); ++i) {
    const double a = static_cast<double>(now_m[i]), b = static_cast<double>(last_m[i]);
    const double step_m = std::abs(a - b);
    if (a > 0.0 && a < range_m_ && b > 0.0 && step_m < kSame_m) steps_m_.push_back(step_m);
  }
  if (steps_m_.size() < kFewBeams) return;
  const auto middle = steps_m_.begin() + static_cast<std::ptrdiff_t>(steps_m_.size() / 2);
  std::nth_element(steps_m_.begin(), middle, steps_m_.end());
  measured_ = std::min(measured_ + 1.0, kManyScans);
  sigma_m_ += (*middle / kMedianStep - sigma_m_) / measured_;
  surface_m_ = std::max(kSurface_m, kSurfaceSigmas * sigma_m_);
}

void RecentSight::addScan(const LaserScan& scan, const FloorPose& base, double stamp_s) {
  if (!(stamp_s > looks_[newest_].stamp_s) || scan.step_rad == 0.0) return;
  const FloorPose scanner = base * params_.T_base_scanner;
  next_.scanner = scanner.position;
  next_.turn = Eigen::Rotation2Dd(-scanner.yaw_rad).toRotationMatrix();
  next_.stamp_s = stamp_s;
  next_.scan.first_rad = scan.first_rad;
  next_.scan.step_rad = scan.step_rad;
  if (next_.scan.ranges_m.capacity() < scan.ranges_m.size()) {
    for (Look& each : looks_) each.scan.ranges_m.reserve(scan.ranges_m.size());
  }
  next_.scan.ranges_m.assign(scan.ranges_m.begin(), scan.ranges_m.end());
  const Look& last = looks_[newest_];
  next_.driven_m = last.driven_m + (next_.scanner - last.scanner).norm();
  const Eigen::Matrix2d turned = next_.turn * last.turn.transpose();
  next_.turned_rad = last.turned_rad + std::abs(std::atan2(turned(1, 0), turned(0, 0)));
  measureErrors(next_, last);
  const double apart_s = params_.remembers_s / static_cast<double>(kLooks - 1);
  if (last.stamp_s - lookBefore(1).stamp_s >= apart_s) newest_ = (newest_ + 1) % looks_.size();
  std::swap(looks_[newest_], next_);
  const Look& look = looks_[newest_];
  const double keeps_m2 = keeps_m_ * keeps_m_;
  things_.erase(
      std::remove_if(things_.begin(), things_.end(),
                     [&](const SeenThing& thing) {
                       const bool is_old = stamp_s - thing.seen_s > params_.remembers_s;
                       const bool by_laser = thing.camera == SeenThing::kByLaser;
                       const bool is_kept = by_laser && !thing.roams &&
                                            (thing.place - base.position).squaredNorm() < keeps_m2;
                       return (is_old && !is_kept) || (by_laser && sees(look, thing.place));
                     }),
      things_.end());
  parts_.erase(parts_.begin(), partsSince(parts_.end(), stamp_s - kStride_s));
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m > 0.0 && range_m < range_m_)) continue;
    const double angle = scan.angle(i);
    const Vector2d place = scanner * Vector2d(range_m * std::cos(angle), range_m * std::sin(angle));
    const double free_s = lastFree(place);
    const bool is_somebody = free_s > kNotYet;
    const bool roams = stamp_s - free_s <= params_.remembers_s;
    if (is_somebody) parts_.push_back({place, stamp_s});
    keep({place, 0.0, stamp_s, SeenThing::kByLaser, true, roams, is_somebody, Vector2d::Zero(),
          0.0});
  }
  tellWalks(stamp_s);
  layOut();
}

// Whether a picture shows the place at the thing's height: what is low leaves it early.
bool RecentSight::isInPicture(const SeenThing& thing, const FloorPose& T_base_world) const {
  const CameraView& view = params_.cameras[static_cast<std::size_t>(thing.camera)];
  const Vector2d at = T_base_world * thing.place;
  const Eigen::Vector3d seen =
      view.T_base_camera.inverse() * Eigen::Vector3d(at.x(), at.y(), thing.height_m);
  const double away_m = (at - view.T_base_camera.translation().head<2>()).norm();
  return seen.z() > view.nearest_m && away_m < view.range_m &&
         (seen.head<2>().array().abs() < view.half_view * seen.z()).all();
}

void RecentSight::addPoints(int camera, const std::vector<Eigen::Vector3f>& points,
                            const FloorPose& base, double stamp_s,
                            const std::vector<Vector2d>& steps) {
  double& last_s = points_s_.at(static_cast<std::size_t>(camera));
  if (!(stamp_s > last_s)) return;
  last_s = stamp_s;
  const FloorPose T_base_world = base.inverse();
  std::fill(cells_.begin(), cells_.end(), Cell{});
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2f at = point.head<2>();
    const Eigen::Vector2d cell = at.cast<double>().array() / kCell_m + kCells / 2.0;
    const bool is_near = (cell.array() >= 0.0).all() && (cell.array() < kCells).all();
    if (!is_near || !(point.z() > 0.0F)) continue;  // NaN too
    Cell& c =
        cells_[static_cast<std::size_t>(cell.y()) * kCells + static_cast<std::size_t>(cell.x())];
    if (c.points == 0 || at.norm() < c.nearest.norm()) c.nearest = at;
    c.highest_m = std::max(c.highest_m, point.z());
    ++c.points;
  }
  const auto placeOf = [&](const Cell& c) { return base * Vector2d(c.nearest.cast<double>()); };
  for (Cell& cell : cells_) {
    if (cell.points < params_.min_points) continue;
    cell.is_sure = std::any_of(things_.begin(), things_.end(), [&](const SeenThing& thing) {
      return thing.camera == camera && (thing.place - placeOf(cell)).norm() < kSame_m;
    });
  }
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const SeenThing& thing) {
                                 return thing.camera == camera &&
                                        (!thing.is_sure || thing.height_m == 0.0 ||
                                         isInPicture(thing, T_base_world));
                               }),
                things_.end());
  for (const Cell& cell : cells_) {
    if (cell.points < params_.min_points) continue;
    keep({placeOf(cell), static_cast<double>(cell.highest_m), stamp_s, camera, cell.is_sure, false,
          false, Vector2d::Zero(), 0.0});
  }
  for (const Vector2d& step : steps) {
    if (step.lpNorm<Eigen::Infinity>() > 0.5 * kCells * kCell_m) continue;
    keep({base * step, 0.0, stamp_s, camera, true, false, false, Vector2d::Zero(), 0.0});
  }
  layOut();
}

// Where there is no room for more, the oldest goes.
void RecentSight::keep(const SeenThing& thing) {
  if (things_.size() >= kMostThings) {
    things_.erase(things_.begin(), things_.begin() + kMostThings / 4);
  }
  things_.push_back(thing);
}

std::optional<Vector2d> RecentSight::bodyAround(const SeenThing& thing) const {
  if (!thing.is_somebody || thing.seen_s != newest_s()) return std::nullopt;
  const Parts first = partsSince(parts_.end(), newest_s());
  const auto isOfLeg = [&](const Part& part) {
    return (part.place - thing.place).squaredNorm() < kLeg_m * kLeg_m;
  };
  Vector2d at = thing.place;
  if (std::count_if(first, parts_.end(), isOfLeg) < 2 || !middleOf(first, parts_.end(), at)) {
    return std::nullopt;
  }
  return at;
}

// What clearance() reads, in a row.
void RecentSight::layOut() {
  for (std::size_t i = 0; i < things_.size(); ++i) {
    places_.row(static_cast<Eigen::Index>(i)) = things_[i].place.transpose();
  }
}

double RecentSight::clearance(const Vector2d& place) const {
  if (things_.empty()) return std::numeric_limits<double>::infinity();
  const auto places = places_.topRows(static_cast<Eigen::Index>(things_.size()));
  return std::sqrt(
      ((places.col(0) - place.x()).square() + (places.col(1) - place.y()).square()).minCoeff());
}

double RecentSight::besideView(double body_m, double front_m) const {
  const LaserScan& scan = looks_[newest_].scan;
  if (scan.ranges_m.empty()) return 0.0;
  const double yaw_rad = params_.T_base_scanner.yaw_rad;
  const double first_rad = yaw_rad + scan.first_rad;
  const double last_rad = yaw_rad + scan.angle(scan.ranges_m.size()) - scan.step_rad;
  const double half_rad = std::min(std::abs(first_rad), std::abs(last_rad));
  if (half_rad + 2.0 * std::abs(scan.step_rad) >= M_PI) return 0.0;
  const double ahead_m = params_.T_base_scanner.position.x() - front_m +
                         body_m / std::tan(std::max(half_rad, kRounding_rad));
  const double within_m = std::clamp(ahead_m, 0.0, body_m);
  return body_m - std::sqrt(body_m * body_m - within_m * within_m);
}

}  // namespace heel
