// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

// The follower's actions: from what the plan says to a velocity.

#include <heel/apps/follower/follower.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kHalfBody_m = 0.25;
constexpr double kRings_m = 0.1;         // Between rings on which room to turn is looked for,
constexpr double kFurthestTurn_m = 1.5;  // up to so far off.

}  // namespace

// A speed for what the plan says (section 3.3); nothing moves while it is not safe.
void Follower::drive() {
  noteProgress();
  step_.goal.reset();
  step_.path = nullptr;
  step_.velocity = {};
  looks_away_ = false;
  if (step_.is_paused) {
    step_.reason = "told to wait";
    return;
  }
  if (step_.is_learning) {
    step_.reason = "learns whom to follow";
    return;
  }
  if (!watch_.blindness().empty()) {
    step_.reason = watch_.blindness();
    return;
  }
  if (step_.robot.lost) {  // Another view may tell; the last gate lets it turn where it can.
    step_.reason = "does not know where it is";
    step_.velocity.turn_radps = params_.lost_turn_radps;
    return;
  }
  step_.reason = target_.hasPlace() || step_.perception == nullptr ? "" : step_.perception->reason;
  if (action_ != FollowingAction::kStop && makesRoom()) return;
  switch (action_) {
    case FollowingAction::kStop:
      break;
    case FollowingAction::kFollow:
      follow();
      break;
    case FollowingAction::kFace:
      face();
      break;
    case FollowingAction::kGoToLastSeen:
      goToLastSeen();
      break;
    case FollowingAction::kSeek:
      seek();
      break;
    case FollowingAction::kSearch:
      search();
      break;
  }
}

// Whoever wants to go somewhere, and turns this way and that, is stuck too.
void Follower::noteProgress() {
  const Vector2d& here = step_.robot.pose.position;
  if ((here - stood_at_).norm() > robot_.drive.radius_m) {
    stood_at_ = here;
    stuck_s_ = 0.0;
  } else if (step_.path != nullptr && !step_.path->empty() &&
             (step_.path->back() - here).norm() > params_.drive.depart_m) {
    stuck_s_ += dt_s_;
  }
}

// Stands off the person, in view of them and in nobody's way.
void Follower::follow() {
  if (!person_) return driveTo(last_.position);
  const MovingPerson& target = *person_;
  const auto clearance = [this](const Vector2d& p) { return planner_.clearance().clearance(p); };
  const auto sees = [this](const Vector2d& from, const Vector2d& to) {
    const double eye_m = robot_.camera.T_base_camera.translation().z();
    return !walls_ ||
           walls_->lineOfSight({from.x(), from.y(), eye_m}, {to.x(), to.y(), eye_m}, kHalfBody_m);
  };
  const auto place = goal_chooser_.choose(target, step_.robot.pose, clearance, sees, doorways_);
  driveTo(place ? place->pose.position : *step_.target);
}

// From within a metre somebody who stood there would be seen: no need to go on.
void Follower::goToLastSeen() {
  const Vector2d& place = last_.position;
  driveTo(place);
  const bool is_near = (place - step_.robot.pose.position).norm() < params_.near_m;
  has_arrived_ = has_arrived_ || is_near;
}

// Somebody who may be the person is looked at before any other place.
bool Follower::looksAtSuspect() {
  const Track* track = suspect();
  if (track == nullptr) return false;
  step_.reason += (step_.reason.empty() ? "" : "; ") + std::string("looks who that is");
  const Vector2d place = track->motion.position_m();
  looked_s_ += dt_s_;
  lookAt(place);
  const bool is_ahead = std::abs(bearingOf(step_.robot.pose, place)) < params_.ahead_rad;
  const bool is_far = (place - step_.robot.pose.position).norm() > params_.far_m;
  if (is_ahead && is_far) driveTo(place);  // From nearer more is seen.
  return true;
}

// Who is likeliest to be the target; null if nobody is worth a look.
const Track* Follower::suspect() const {
  if (looked_s_ > params_.first_looks_s + params_.look_share * unseen_s_) return nullptr;
  const Track* best = nullptr;
  double most = params_.worth_a_look;
  const Identity& identity = perception_->identity();
  for (const Track& track : perception_->tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    const double probability = identity.targetProbability(track.id);
    if (probability <= most) continue;
    most = probability;
    best = &track;
  }
  return best;
}

// Where to look for the person first: where they are if they walked on.
MovingPerson Follower::expected() const {
  MovingPerson person = last_;
  person.position += std::min(unseen_s_, params_.walks_on_s) * person.velocity;
  return person;
}

// A turn on the spot, towards the side where the person was last seen.
void Follower::seek() {
  if (looksAtSuspect()) return;
  lookAt(step_.robot.pose * Vector2d(0.0, seek_side_));
  const double most_radps = params_.seek_radps;
  double& turn_radps = step_.velocity.turn_radps;
  turn_radps = std::clamp(turn_radps, -most_radps, most_radps);
  turned_rad_ += std::abs(watch_.increment().yaw_rad);
}

// Goes where the chance to see the person is best, and looks there.
void Follower::search() {
  if (looksAtSuspect()) return;
  if (!search_) {
    step_.reason += (step_.reason.empty() ? "" : "; ") + std::string("waits: there is no map");
    return;
  }
  const auto way_m = [this](const Vector2d& place) {
    planner_.plan(step_.robot.pose.position, place, plan_);
    return plan_.found() ? plan_.length_m : std::numeric_limits<double>::infinity();
  };
  if (search_->choose(dt_s_, step_.robot.pose, is_there_, way_m)) local_planner_.reset();
  is_there_ = false;
  const std::optional<SearchView>& view = search_->view();
  if (!view) return;
  driveTo(view->camera.position);
  if (!has_arrived_) return;
  lookAt(view->camera * Vector2d(2.0, 0.0));
  is_there_ = step_.velocity.forward_mps == 0.0 && step_.velocity.turn_radps == 0.0;
}

// A round robot touches nothing by turning. A long one goes to where it can turn.
void Follower::lookAt(const Vector2d& place) {
  const DriveLimits& drive = robot_.drive;
  const double turn_radps =
      turnToFace(drive, {step_.robot.pose, speed_}, place, params_.drive.facing);
  step_.velocity = {0.0, turn_radps};
  if (axisReach(drive) == 0.0 || turn_radps == 0.0) return;
  plan_.path.clear();
  step_.velocity = localCommand(place);
  if (step_.velocity.turn_radps == 0.0) driveTo(turningPlace());
}

// The nearest with room to turn, in rings about the robot; else that with the most room.
Vector2d Follower::turningPlace() const {
  const double need_m = turningRadius(robot_.drive) + params_.drive.margin_m;
  Vector2d best = step_.robot.pose.position;
  double most_m = room_.clearance(best);
  for (double away_m = kRings_m; away_m < kFurthestTurn_m && most_m < need_m; away_m += kRings_m) {
    for (int i = 0; i < 16; ++i) {
      const double angle = M_PI + M_PI / 8.0 * i;  // behind it first: from there it came
      const Vector2d way(std::cos(angle), std::sin(angle));
      const Vector2d place = step_.robot.pose * Vector2d(away_m * way);
      const double room_m = room_.clearance(place);
      if (room_m <= most_m) continue;
      most_m = room_m;
      best = place;
    }
  }
  return best;
}

// Nothing gets to the wheels but through it.
void Follower::passLastGate() {
  const GatedVelocity gated = last_gate_.pass(step_.velocity, {motion_.pose(), speed_},
                                              steady_s_ - motion_.stamp_s(), steady_s_);
  step_.velocity = gated.velocity;
  if (gated.reason == GateReason::kFree) return;
  step_.reason += (step_.reason.empty() ? "" : "; ") + std::string(describe(gated.reason));
}

// +1: to the left.
double Follower::sideOf(const Vector2d& place) const {
  return bearingOf(step_.robot.pose, place) < 0.0 ? -1.0 : 1.0;
}

// Stays where it is, turned to the person, unless it must make room: nobody waits at a doorway
// that the robot stands in.
void Follower::face() {
  if (standsInDoorway()) {
    looks_away_ = true;  // The person waits: making room goes before keeping them in view.
    follow();
    // Close by they leave no room to drive, and will be in view when they have gone past.
    const bool is_beside =
        step_.target && (*step_.target - step_.robot.pose.position).norm() < params_.beside_m;
    if (is_beside && step_.velocity.forward_mps >= 0.0) lookAt(*step_.target);
    return;
  }
  plan_.path.clear();
  step_.velocity = localCommand(looks_away_ ? std::nullopt : step_.target);
}

bool Follower::standsInDoorway() const {
  const GoalChooserParams& goal = goal_chooser_.params();
  return std::any_of(doorways_.begin(), doorways_.end(), [&](const DoorwayOnMap& d) {
    return inPassage(d, step_.robot.pose.position, goal.doorway_depth_m, goal.radius_m) > 0.0;
  });
}

// Where there is no room for two, the robot leaves the way to a person.
bool Follower::makesRoom() {
  if (!making_room_) {
    if (const MovingPerson* person = whoWantsPast()) goAside(*person);
  }
  if (!making_room_) return false;
  MakingRoom& room = *making_room_;
  room.since_s += dt_s_;
  const auto isThere = [&](const auto& person) {
    return (person.position - room.before).norm() < params_.far_m;
  };
  const bool waits = room.is_for_target ? !person_ || isThere(*person_)
                                        : std::any_of(people_.begin(), people_.end(), isThere);
  if (!waits || room.since_s > params_.makes_room_s || room.waited_s > params_.waits_aside_s) {
    making_room_.reset();
    return false;
  }
  looks_away_ = true;
  driveTo(room.place);
  if (std::exchange(has_arrived_, false)) {  // not where the plan wants to be
    room.waited_s += dt_s_;
    if (step_.target) lookAt(*step_.target);
  }
  return true;
}

// The target who comes up to it, or anybody while it gets nowhere; null: nobody.
const MovingPerson* Follower::whoWantsPast() {
  if (person_ && isInTheWayOf(*person_)) return &*person_;
  if (stuck_s_ <= params_.give_up_s) return nullptr;
  stuck_s_ = 0.0;
  const auto end = people_.begin() + static_cast<std::ptrdiff_t>(seen_people_);
  const auto waits =
      std::find_if(people_.begin(), end, [this](const auto& p) { return isInTheWayOf(p); });
  return waits == end ? nullptr : &*waits;
}

bool Follower::isInTheWayOf(const MovingPerson& person) const {
  const Vector2d& here = step_.robot.pose.position;
  const Vector2d to_robot = here - person.position;
  const bool comes = person.velocity.dot(to_robot) > params_.comes_mps * to_robot.norm();
  if (to_robot.norm() > (comes ? params_.far_m : params_.beside_m)) return false;
  const auto room = [this](const Vector2d& p) { return room_.clearance(p); };
  return standsInDoorway() || !leavesRoom(here, person.position, room, params_.wayside);
}

void Follower::goAside(const MovingPerson& person) {
  const Vector2d& here = step_.robot.pose.position;
  const auto room = [this](const Vector2d& p) { return room_.clearance(p); };
  findWaysides(here, person.position, room, doorways_, params_.wayside, waysides_);
  for (const Vector2d& place : waysides_) {
    planner_.plan(here, place, plan_);
    const bool is_near = plan_.length_m < 1.5 * params_.wayside.reach_m;
    if (!plan_.found() || !is_near || (plan_.end - place).norm() > params_.wayside.apart_m) {
      continue;
    }
    making_room_ = MakingRoom{place, here, person_ && &person == &*person_};
    local_planner_.reset();
    return;
  }
}

// Around what the map and the moment show, in view of the person if there is one.
void Follower::driveTo(const Vector2d& goal) {
  const FloorPose& pose = step_.robot.pose;
  planner_.plan(pose.position, goal, plan_);
  if (!plan_.found()) {  // What is in the way may be gone by then: as the map has it.
    planner_.setObstacles({});
    planner_.plan(pose.position, goal, plan_);
    planner_.setObstacles(unseen_.standing(), &things_);
  }
  if (!plan_.found()) plan_.path.clear();
  step_.velocity = localCommand(looks_away_ ? std::nullopt : step_.target);
  step_.goal = goal;
  step_.path = &plan_.path;
  has_arrived_ = has_arrived_ || !plan_.found();
}

// Along the path, if there is one, without touching anything; else turned to the face.
VelocityCommand Follower::localCommand(const std::optional<Vector2d>& face) {
  // The map's walls may be off, and what is near them is left out of the layer: not so what the
  // last gate sees, which leaves as little room as this.
  const FloorPose to_motion = motion_.pose() * step_.robot.pose.inverse();
  const double spare_m = params_.drive.margin_m - params_.last_gate.margin_m;
  const auto room = [&](const Vector2d& p) {
    return std::min(room_.clearance(p), last_gate_.clearance(to_motion * p) + spare_m);
  };
  last_gate_.locate({motion_.pose(), speed_}, steady_s_ - motion_.stamp_s(), steady_s_);
  const auto permits = [&](const VelocityCommand& velocity) { return last_gate_.lets(velocity); };
  hidden_.clear();
  const FloorPose from_motion = to_motion.inverse();
  for (const Vector2d& place : hiding_places_) hidden_.push_back(from_motion * place);
  local_planner_.expect(hidden_);
  const LocalPlan now =
      local_planner_.step(step_.robot.pose, speed_, plan_.path, room, people_, face, permits);
  has_arrived_ = now.status == DriveStatus::kArrived || now.blocked_s > params_.give_up_s;
  step_.reason += (step_.reason.empty() ? "" : "; ") + std::string(describe(now.reason));
  return now.command;
}

}  // namespace heel
