// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/follower.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

/// What the parts must know of the robot.
FollowerParams fitted(FollowerParams params, const RobotDescription& robot) {
  params.obstacles.max_height_m = robot.height_m;
  params.obstacles.laser_height_m = robot.scanner_height_m;
  params.gate.eye_height_m = robot.camera.T_base_camera.translation().z();
  params.gate.depth_error_pm = params.legs.depth_error_pm = depthErrorOf(robot.camera.camera);
  params.paths.robot_radius_m = robot.drive.radius_m;
  params.goal.radius_m = robot.drive.radius_m;
  params.wayside.radius_m = robot.drive.radius_m;
  params.drive.limits = robot.drive;
  return params;
}

constexpr double kFullTurn_rad = 6.283185307179586;

}  // namespace

FollowerParams::FollowerParams() {
  learn.appearance.bands = wholeBody();  // a robot that keeps its distance sees trousers, too
  learn.appearance.comparison = BodyComparison::kMatch;
  perception.match.sharpness = 1.3;        // lenient: a home's rooms differ in their light
  perception.match.unknown_stature = 1.0;  // close by, heads are above the picture
  perception.target.min_appearance = 0.5;  // matching tells people well apart: few are in between
  perception.target.appearance_frames = 2;
  perception.target.release_share = 0.7;
  perception.target.release_s = 1.0;
  perception.target.release_started = true;
  perception.target.takeover_ratio = 1.4;
  perception.target.sure_appearance = 0.6;
  perception.target.most_doubt = 8;
  paths.bend_room_m = 0.12;  // round a corner with some room one sees further behind it
  paths.safety_m = 0.08;  // more than the local planner's margin, or it stops where the path goes
  goal.ahead_cost = 0.0;  // people who are followed turn and stop; round them is out of their view
  goal.lead_s = 0.2;      // they turn often
  goal.most_standoff_m = 1.25;  // who is followed wants company, even behind a doorway
  goal.doorway_depth_m = 0.95;  // somebody who comes out of it must get past the robot
  drive.margin_m = 0.06;        // the map's walls are as far off as localization is
  drive.terms.weights[static_cast<std::size_t>(DriveTerm::kView)] = 4.0;  // or the target is lost
  obstacles.min_points = 6;      // coarse stereo errs in specks
  obstacles.min_memory_s = 0.7;  // a false match of one frame must not close a doorway for long
  obstacles.memory_gain = 3.0;   // in a home with people, what was there is soon out of date
  obstacles.max_memory_s = 8.0;
}

const char* toText(FollowStage stage) {
  switch (stage) {
    case FollowStage::kBegin:
      return "begin";
    case FollowStage::kLocalize:
      return "localize";
    case FollowStage::kLookAround:
      return "look_around";
    case FollowStage::kLearn:
      return "learn";
    case FollowStage::kSee:
      return "see";
    case FollowStage::kDecide:
      return "decide";
    case FollowStage::kDrive:
      return "drive";
  }
  return "unknown";
}

const char* FollowStep::state() const { return is_learning ? "learn" : nameOf(action); }

Follower::Follower(const RobotDescription& robot, std::shared_ptr<const WallMap> walls,
                   PetriPlan plan, const std::optional<FloorPose>& start,
                   const FollowerParams& params)
    : robot_(robot),
      params_(fitted(params, robot)),
      walls_(std::move(walls)),
      floor_(walls_->floorGrid({0.05, robot.height_m})),
      to_walls_(floor_, 1.0),
      watch_(params_.watch),
      localization_(
          walls_->floorGrid({robot.scanner_height_m - 0.05, robot.scanner_height_m + 0.05}),
          robot.T_base_scanner, params_.localization),
      layer_(params_.obstacles),
      obstacle_points_(robot.camera, params_.obstacle_points),
      people_around_(params_.people),
      laser_gate_(std::make_shared<LaserGate>(
          [this](const Vector2d& p) { return localization_.field().distance_m(p); }, params_.legs)),
      learner_(std::in_place, robot.camera, params_.learn),
      runner_(std::move(plan)),
      room_(floor_, 1.0),
      planner_(floor_, params_.paths),
      local_planner_(params_.drive),
      goal_chooser_(params_.goal),
      target_place_(params_.place),
      search_(floor_, walls_->floorGrid({1.1, 1.4}), params_.search),
      doorways_(findDoorways(floor_)) {
  if (start) localization_.startAt(*start);
}

const FollowStep& Follower::step(const RobotReadings& readings, const StageDone& done) {
  const auto finished = [&done](FollowStage stage) {
    if (done) done(stage);
  };
  finished(FollowStage::kBegin);
  dt_s_ = std::clamp(readings.stamp_s - step_.stamp_s, 0.0, params_.watch.max_gap_s);
  step_.stamp_s = readings.stamp_s;
  step_.acquisition = nullptr;
  step_.perception = nullptr;
  watch_.step(readings);
  if (!watch_.timeJumped()) steady_s_ += dt_s_;

  localize(readings);
  finished(FollowStage::kLocalize);

  lookAround(readings);
  finished(FollowStage::kLookAround);

  const bool learns = learner_.has_value();
  if (watch_.imageIsGood()) learns ? learn(*readings.frame) : see(*readings.frame);
  finished(learns ? FollowStage::kLearn : FollowStage::kSee);

  decide(readings);
  finished(FollowStage::kDecide);

  drive();
  finished(FollowStage::kDrive);
  return step_;
}

// Monte Carlo localization; beams that end on people are left out.
void Follower::localize(const RobotReadings& readings) {
  if (watch_.odometryIsGood()) {
    localization_.predict(watch_.increment());
    if (dt_s_ > 0.0) {
      speed_ = {watch_.increment().position.x() / dt_s_, watch_.increment().yaw_rad / dt_s_};
    }
  }
  if (readings.scan != nullptr) {
    masked_.clear();
    const FloorPose T_base_world = localization_.estimate().pose.inverse();
    for (const MovingPerson& person : people_) {
      masked_.push_back({T_base_world * person.position, params_.target_radius_m});
    }
    localization_.update(*readings.scan, masked_);
  }
  step_.robot = localization_.estimate();
  laser_gate_->step(readings.scan, step_.robot.pose * robot_.T_base_scanner, dt_s_);
}

// What stands and moves around the robot that no map shows.
void Follower::lookAround(const RobotReadings& readings) {
  if (step_.is_learning) return;  // whoever is there now will be the one to follow
  const FloorPose& pose = step_.robot.pose;
  std::optional<FloorDisc> own;
  if (step_.target) own = FloorDisc{*step_.target, params_.target_radius_m};
  layer_.begin(readings.stamp_s, pose, own);
  if (readings.scan != nullptr) {
    layer_.addScan(*readings.scan, robot_.T_base_scanner,
                   [this](const Vector2d& p) { return isMapped(p); });
    people_around_.step(readings.stamp_s, *readings.scan, pose * robot_.T_base_scanner,
                        [this](const Vector2d& p) { return localization_.field().distance_m(p); });
  }
  obstacles_age_s_ += dt_s_;
  if (watch_.imageIsGood() && obstacles_age_s_ > params_.obstacles_every_s - 1e-6) {
    keepUnmapped(obstacle_points_.of(*readings.frame));
    layer_.addPoints(unmapped_);
    obstacles_age_s_ = 0.0;
  }
  layer_.finish();
  notePeople();
  planner_.setObstacles(standing_, &layer_.window());
  room_.setLayer({}, &layer_.window());
}

// Who walks is left to the local planner; around who stands leads another way.
void Follower::notePeople() {
  people_.clear();
  if (target_place_.now()) {
    people_.push_back(*target_place_.now());
  } else if (target_place_.unseen_s() < params_.beside_s) {  // passes where no sensor looks
    people_.push_back(target_place_.expected());
  }
  for (const MovingPerson& person : people_around_.people()) {
    const bool is_target =
        step_.target && (person.position - *step_.target).norm() < params_.target_radius_m;
    if (!is_target) people_.push_back(person);
  }
  standing_.clear();
  for (const MovingPerson& person : people_) {
    if (person.velocity.norm() > params_.stands_mps) continue;
    standing_.push_back({person.position, person.radius_m + params_.beside_people_m});
  }
}

bool Follower::isMapped(const Vector2d& place) const {
  return to_walls_.at(place) <= params_.mapped_within_m;
}

// People are avoided as people; what the camera saw of them would be in the way where they were.
bool Follower::isSomebody(const Vector2d& place) const {
  return std::any_of(people_.begin(), people_.end(), [&](const MovingPerson& person) {
    return (person.position - place).norm() < params_.target_radius_m;
  });
}

void Follower::keepUnmapped(const std::vector<Eigen::Vector3f>& points) {
  unmapped_.clear();
  for (const Eigen::Vector3f& point : points) {
    const Vector2d place = step_.robot.pose * Vector2d(point.head<2>().cast<double>());
    if (!isMapped(place) && !isSomebody(place)) unmapped_.push_back(point);
  }
}

// Phase 1 (section 2).
void Follower::learn(const Frame& frame) {
  Frame steady = frame;
  steady.stamp_s = steady_s_;  // the learner bears no clock that jumps
  step_.acquisition = &learner_->step(steady);
  if (!learner_->isDone()) return;
  if (!learner_->hasPerson()) {
    throw NobodyLearned("nobody entered to be learned, or several did together");
  }
  PerceptionParams params = params_.perception;
  params.gate =
      allOf({wallGate(walls_, params_.gate),
             [legs = laser_gate_](const auto& seen, const auto&) { return legs->judge(seen); }});
  perception_.emplace(robot_.camera, learner_->learn(), params);
  const Vector2d place = step_.robot.pose * learner_->result().last_place_m;
  perception_->startAt(place);
  target_place_.startAt(place);
  learner_.reset();
  step_.is_learning = false;
}

// Phase 2 (section 3.1, 3.2).
void Follower::see(const Frame& frame) {
  const RobotPlace place{step_.robot.pose, step_.robot.covariance.topLeftCorner<2, 2>()};
  perception_->expectAt(target_place_.isSure() ? step_.target : std::nullopt);
  perception_->exclude(target_place_.others());
  walkers_m_.clear();
  for (const int id : people_around_.walkers()) {
    walkers_m_.push_back(people_around_.find(id)->motion.position_m());
  }
  perception_->vouchFor(walkers_m_);
  step_.perception = &perception_->step(frame, place);
  target_ = step_.perception->target;
  for (const Track& track : perception_->tracks()) {
    if (track.status == TrackStatus::kConfirmed && track.hits >= params_.surely_seen_hits) {
      people_around_.confirm(track.motion.position_m(), params_.place.legs_within_m);
    }
  }
}

// The Petri net plan (section 3.4).
void Follower::decide(const RobotReadings& readings) {
  if (step_.is_learning) return;
  const bool was_known = step_.target.has_value();
  const auto is_in_view = [this](const Vector2d& p) { return isInView(p); };
  const auto is_unlike = [this](const Vector2d& p) {
    return step_.perception != nullptr && perception_->isUnlike(p, params_.place.legs_within_m);
  };
  target_place_.step(target_, people_around_, is_in_view, is_unlike, dt_s_);
  step_.target.reset();
  if (target_place_.now()) {
    step_.target = target_place_.now()->position;
    attention_.clear();
    looked_s_ = 0.0;
  } else {
    if (was_known) search_.lose(target_place_.last(), target_place_.unseen_s());
    search_.wait(dt_s_);
    if (watch_.imageIsGood()) search_.look(step_.robot.pose, dt_s_);
    if (readings.scan != nullptr) {
      search_.scan(*readings.scan, step_.robot.pose * robot_.T_base_scanner, dt_s_);
    }
  }
  checkFacts();
  const PlanStep& now = runner_.step(facts_);
  step_.outcome = now.outcome;
  const FollowingAction action = currentAction(runner_);
  if (action != action_) begin(action);
  step_.action = action_ = action;
}

// Whether the camera sees a whole person there, if there is one.
bool Follower::isInView(const Vector2d& place) const {
  const double away_m = (place - step_.robot.pose.position).norm();
  const PinholeCamera& camera = robot_.camera.camera.left;
  const double half_view_rad = std::atan2(0.5 * camera.width, camera.fx);
  return watch_.imageIsGood() && away_m > params_.near_m && away_m < params_.sees_within_m &&
         std::abs(bearingOf(step_.robot.pose, place)) < 0.8 * half_view_rad;
}

void Follower::checkFacts() {
  using Fact = FollowingCondition;
  const FloorPose& pose = step_.robot.pose;
  const double away_m = step_.target ? (*step_.target - pose.position).norm() : 0.0;
  facts_[Fact::kTargetSeen] = step_.target.has_value();
  facts_[Fact::kTargetLost] = !step_.target && target_place_.unseen_s() > params_.lost_after_s;
  facts_[Fact::kNear] = step_.target && away_m < params_.near_m;
  facts_[Fact::kFar] = step_.target && away_m > params_.far_m;
  facts_[Fact::kArrived] = has_arrived_;
  facts_[Fact::kLookedAround] =
      turned_rad_ > kFullTurn_rad ||
      (!suspect() &&
       std::abs(bearingOf(pose, target_place_.expected().position)) < params_.ahead_rad);
  facts_[Fact::kFullTurn] = turned_rad_ > kFullTurn_rad;
  facts_[Fact::kSearchOver] = search_.isOver();
  facts_[Fact::kBlind] = !watch_.blindness().empty() || step_.robot.lost;
  facts_[Fact::kDone] = false;
}

void Follower::begin(FollowingAction action) {
  local_planner_.reset();
  goal_chooser_.reset();
  has_arrived_ = false;
  search_.restart();
  is_there_ = false;
  if (action != FollowingAction::kFollow && action != FollowingAction::kFace) making_room_.reset();
  if (action == FollowingAction::kSeek) {
    turned_rad_ = 0.0;
    seek_side_ = sideOf(target_place_.expected().position);
  }
}

}  // namespace heel
