// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/people_around.hpp>

#include <algorithm>
#include <cmath>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kChiSquared99 = 9.21;  // of two degrees of freedom
constexpr double kLikely = 0.5;         // Who walks is avoided if they are a person with this.
constexpr double kLegs_m = 0.12;        // So far from the middle of who stands are their legs.

// Whether they move, as surely as 99 of 100.
bool setsOff(const MotionState& motion) {
  const Vector2d velocity = motion.velocity_mps();
  const Eigen::Matrix2d covariance = motion.covariance.bottomRightCorner<2, 2>();
  return velocity.dot(covariance.ldlt().solve(velocity)) > kChiSquared99;
}

}  // namespace

double gaitOf(const MotionState& motion, const Vector2d& place) {
  const Vector2d along = (place - motion.position_m()).stableNormalized();
  return std::sqrt(along.dot(motion.covariance.bottomRightCorner<2, 2>() * along));
}

PeopleAround::PeopleAround(const FollowerParams& params)
    : avoid_above_(params.avoid_above),
      walks_on_s_(params.walks_on_s),
      person_m_(params.target_radius_m),
      known_within_m_(0.5 * params.obstacles.size_m),
      unseen_({params.walks_on_s, params.beside_people_m, params.target_radius_m}) {}

void PeopleAround::step(double stamp_s, const Perception& perception, const RecentSight& sight,
                        const FloorPose& T_frame_world, Situation& now) {
  now.people.clear();
  addTracks(stamp_s, perception, now);
  addComers(sight, T_frame_world.inverse(), now);
  now.seen_people = now.people.size();
  const auto hasLeft = [&](const Vector2d& place) {
    const auto isThingThere = [&](const Track& track) {
      return track.observation != Track::kUnseen &&
             (track.motion.position_m() - place).norm() < person_m_ &&
             perception.identity().probabilities(track.id)[kThing] > 1.0 - avoid_above_;
    };
    const std::vector<Track>& tracks = perception.tracks();
    return isNear(place, now.target) || std::any_of(tracks.begin(), tracks.end(), isThingThere) ||
           (place - now.robot.position).norm() > known_within_m_ ||
           sight.seesFree(T_frame_world * place, kLegs_m);
  };
  unseen_.step(stamp_s, now.people, hasLeft);
  if (now.target) {
    now.people.push_back(*now.target);
  } else if (now.unseen_s < walks_on_s_) {  // passes where no sensor looks
    now.people.push_back(now.expected(walks_on_s_));
  }
}

// Who walks or has just stopped is left to the local planner; around who rests leads another way,
// but for the target: the way leads to them. A way round costs little if nobody stands there.
void PeopleAround::addTracks(double stamp_s, const Perception& perception, Situation& now) const {
  const Identity& identity = perception.identity();
  for (const Track& track : perception.tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    if (isNear(track.motion.position_m(), now.target)) continue;  // their other leg, too
    const Evidence who = identity.probabilities(track.id);
    const double rests_s = identity.restsFor_s(track.id, stamp_s);
    const bool rests = rests_s >= walks_on_s_ && !setsOff(track.motion);
    if (who.sum() - who[kThing] < (rests ? avoid_above_ : kLikely)) continue;
    MovingPerson& person = now.people.emplace_back();
    person.position = track.motion.position_m();
    if (rests) {
      person.rests_s = rests_s;
    } else {
      person.velocity = track.motion.velocity_mps();
      person.gait_mps = gaitOf(track.motion, now.robot.position);
    }
  }
}

// Who came of late to where the laser had seen nothing: who stands close before the robot is no
// person to the camera, and a track of the camera is where somebody was. So who has one counts in
// both places.
void PeopleAround::addComers(const RecentSight& sight, const FloorPose& T_world_frame,
                             Situation& now) const {
  const Eigen::Rotation2Dd turn(T_world_frame.yaw_rad);
  const auto tracks = static_cast<std::ptrdiff_t>(now.people.size());
  for (const SeenThing& thing : sight.things()) {
    if (!thing.is_somebody) continue;
    const Vector2d leg = T_world_frame * thing.place;
    const auto isThere = [&](const MovingPerson& person) { return isNear(leg, person); };
    const auto first = now.people.begin() + tracks;
    if (isNear(leg, now.target) || std::any_of(first, now.people.end(), isThere)) continue;
    const std::optional<Vector2d> body = sight.bodyAround(thing);
    if (!body) continue;
    const bool is_track = std::any_of(now.people.begin(), first, isThere);
    const bool rests = !thing.roams && !is_track;  // If they do, their track tells.
    now.people.push_back({T_world_frame * *body, turn * thing.velocity, MovingPerson().radius_m,
                          thing.gait_mps, rests ? walks_on_s_ : 0.0});
  }
}

bool PeopleAround::isAnybodyAt(const Vector2d& place, const Situation& now) const {
  return std::any_of(now.people.begin(), now.people.end(),
                     [&](const MovingPerson& person) { return isNear(place, person); });
}

bool PeopleAround::isSeenAt(const Vector2d& place, const Situation& now) const {
  return std::any_of(now.people.begin(),
                     now.people.begin() + static_cast<std::ptrdiff_t>(now.seen_people),
                     [&](const MovingPerson& person) { return isNear(place, person); });
}

bool PeopleAround::isNear(const Vector2d& place, const std::optional<MovingPerson>& person) const {
  return person && (person->position - place).norm() < person_m_;
}

const std::vector<FloorDisc>& PeopleAround::discs(const std::vector<MovingPerson>& people,
                                                  const FloorPose& T_frame_world) {
  discs_.clear();
  for (const MovingPerson& person : people) {
    discs_.push_back({T_frame_world * person.position, person_m_});
  }
  return discs_;
}

}  // namespace heel
