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

ObstacleLayerParams layerOf(const RobotDescription& robot, ObstacleLayerParams params) {
  params.max_height_m = robot.height_m;
  params.laser_height_m = robot.scanner_height_m;
  return params;
}

GlobalPlannerParams pathsOf(const RobotDescription& robot, GlobalPlannerParams params) {
  params.robot_radius_m = robot.drive.radius_m;
  return params;
}

LocalPlannerParams driveOf(const RobotDescription& robot, LocalPlannerParams params) {
  params.limits = robot.drive;
  return params;
}

constexpr double kHalfBody_m = 0.25;
constexpr double kFullTurn_rad = 6.283185307179586;

double bearing(const FloorPose& from, const Vector2d& to) {
  const Vector2d way = from.inverse() * to;
  return std::atan2(way.y(), way.x());
}

}  // namespace

FollowerParams::FollowerParams() {
  paths.safety_m = 0.08;  // more than the local planner's margin, or it stops where the path goes
  goal.ahead_cost = 0.0;  // people who are followed turn and stop; round them is out of their view
  goal.lead_s = 0.2;
  drive.terms.weights[static_cast<std::size_t>(DriveTerm::kView)] = 4.0;
  obstacles.min_points = 6;
  obstacles.memory_gain = 3.0;
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
      params_(params),
      walls_(std::move(walls)),
      floor_(walls_->floorGrid({0.05, robot.height_m})),
      to_walls_(floor_, 1.0),
      watch_(params.watch),
      localization_(
          walls_->floorGrid({robot.scanner_height_m - 0.05, robot.scanner_height_m + 0.05}),
          robot.T_base_scanner, params.localization),
      layer_(layerOf(robot, params.obstacles)),
      obstacle_points_(robot.camera, params.obstacle_points),
      people_around_(params.people),
      learner_(std::in_place, robot.camera, params.learn),
      runner_(std::move(plan)),
      planner_(floor_, pathsOf(robot, params.paths)),
      local_planner_(driveOf(robot, params.drive)),
      goal_chooser_(params.goal),
      search_(floor_, params.search),
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

  if (watch_.imageIsGood()) learner_ ? learn(*readings.frame) : see(*readings.frame);
  finished(FollowStage::kSee);

  decide();
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
}

// What stands and moves around the robot that no map shows.
void Follower::lookAround(const RobotReadings& readings) {
  if (step_.is_learning) return;  // whoever is there now will be the one to follow
  const FloorPose& pose = step_.robot.pose;
  std::optional<FloorDisc> own;
  if (step_.target) own = FloorDisc{*step_.target, params_.target_radius_m};
  layer_.begin(readings.stamp_s, pose, own);
  if (readings.scan != nullptr) {
    layer_.addScan(*readings.scan, robot_.T_base_scanner);
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
  planner_.setObstacles({}, &layer_.window());

  people_.clear();
  if (step_.target) {
    people_.push_back({*step_.target, target_velocity_});
  } else if (unseen_s_ < params_.beside_s) {  // may pass by where no sensor looks
    people_.push_back({last_place_ + unseen_s_ * target_velocity_, target_velocity_});
  }
  for (const MovingPerson& person : people_around_.people()) {
    const bool is_target =
        step_.target && (person.position - *step_.target).norm() < params_.target_radius_m;
    if (!is_target) people_.push_back(person);
  }
}

void Follower::keepUnmapped(const std::vector<Eigen::Vector3f>& points) {
  unmapped_.clear();
  for (const Eigen::Vector3f& point : points) {
    const Vector2d place = step_.robot.pose * Vector2d(point.head<2>().cast<double>());
    if (to_walls_.at(place) > params_.mapped_within_m) unmapped_.push_back(point);
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
  WallGateParams gate = params_.gate;
  gate.eye_height_m = robot_.camera.T_base_camera.translation().z();
  gate.depth_error_pm = depthErrorOf(robot_.camera.camera);
  params.gate = wallGate(walls_, gate);
  perception_.emplace(robot_.camera, learner_->learn(), params);
  last_place_ = step_.robot.pose * learner_->result().last_place_m;
  perception_->startAt(last_place_);
  learner_.reset();
  step_.is_learning = false;
}

// Phase 2 (section 3.1, 3.2).
void Follower::see(const Frame& frame) {
  const RobotPlace place{step_.robot.pose, step_.robot.covariance.topLeftCorner<2, 2>()};
  step_.perception = &perception_->step(frame, place);
  target_ = step_.perception->target;
}

// The Petri net plan (section 3.4).
void Follower::decide() {
  if (step_.is_learning) return;
  placeTarget();
  checkFacts();
  const PlanStep& now = runner_.step(facts_);
  step_.outcome = now.outcome;
  const FollowingAction action = currentAction(runner_);
  if (action != action_) begin(action);
  step_.action = action_ = action;
}

// The camera knows who the target is. The laser sees further to the sides: for a while it can go
// on with the target's legs.
void Follower::placeTarget() {
  step_.target.reset();
  legs_alone_s_ = target_.hasPlace() ? 0.0 : legs_alone_s_ + dt_s_;
  if (target_.hasPlace()) {
    step_.target = target_.motion.position_m();
    target_velocity_ = target_.motion.velocity_mps();
    legs_ = people_around_.nearest(*step_.target, params_.legs_within_m);
  } else if (const Track* legs = people_around_.find(legs_);
             legs != nullptr && legs_alone_s_ < params_.legs_alone_s) {
    step_.target = legs->motion.position_m();
    target_velocity_ = legs->motion.velocity_mps();
  }
  if (step_.target) last_place_ = *step_.target;
}

// From the moment of a loss on, where the person can be: spread by time, thinned by looks.
void Follower::rememberTheLost() {
  if (step_.target) {
    unseen_s_ = searched_s_ = 0.0;
    search_is_over_ = false;
    return;
  }
  if (unseen_s_ == 0.0) search_.start(last_place_, target_velocity_);
  unseen_s_ += dt_s_;
  search_.spread(dt_s_);
  if (watch_.imageIsGood()) search_.look(step_.robot.pose, dt_s_);
}

void Follower::checkFacts() {
  using Fact = FollowingCondition;
  const FloorPose& pose = step_.robot.pose;
  const double away_m = step_.target ? (*step_.target - pose.position).norm() : 0.0;
  rememberTheLost();
  facts_[Fact::kTargetSeen] = step_.target.has_value();
  facts_[Fact::kTargetLost] = !step_.target && unseen_s_ > params_.lost_after_s;
  facts_[Fact::kNear] = step_.target && away_m < params_.near_m;
  facts_[Fact::kFar] = step_.target && away_m > params_.far_m;
  facts_[Fact::kArrived] = has_arrived_;
  facts_[Fact::kLookedAround] = turned_rad_ > params_.looked_around_rad;
  facts_[Fact::kFullTurn] = turned_rad_ > kFullTurn_rad;
  facts_[Fact::kSearchOver] = search_is_over_ || searched_s_ > params_.search_s;
  facts_[Fact::kBlind] = !watch_.blindness().empty() || step_.robot.lost;
  facts_[Fact::kDone] = false;
}

void Follower::begin(FollowingAction action) {
  local_planner_.reset();
  goal_chooser_.reset();
  has_arrived_ = false;
  view_.reset();
  if (action == FollowingAction::kSeek) {
    turned_rad_ = 0.0;
    // Where they were going by then, for the robot may stand where they were seen.
    seek_side_ = bearing(step_.robot.pose, last_place_ + target_velocity_) < 0.0 ? -1.0 : 1.0;
  }
}

// A speed for what the plan says (section 3.3); nothing moves while it is not safe.
void Follower::drive() {
  step_.goal.reset();
  step_.path = nullptr;
  step_.velocity = {};
  if (step_.is_learning) {
    step_.reason = "learns whom to follow";
    return;
  }
  if (!watch_.blindness().empty()) {
    step_.reason = watch_.blindness();
    return;
  }
  if (step_.robot.lost) {  // Another view may tell; a round robot touches nothing by turning.
    step_.reason = "does not know where it is";
    step_.velocity.turn_radps = params_.lost_turn_radps;
    return;
  }
  step_.reason = target_.hasPlace() || step_.perception == nullptr ? "" : step_.perception->reason;
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
      driveTo(last_place_);
      break;
    case FollowingAction::kSeek:
      seek();
      break;
    case FollowingAction::kSearch:
      search();
      break;
  }
}

// Stands off the person, in view of them and in nobody's way.
void Follower::follow() {
  if (!step_.target) return driveTo(last_place_);
  const MovingPerson target{*step_.target, target_velocity_};
  const auto clearance = [this](const Vector2d& p) { return planner_.clearance().clearance(p); };
  const auto sees = [this](const Vector2d& from, const Vector2d& to) {
    const double eye_m = robot_.camera.T_base_camera.translation().z();
    return walls_->lineOfSight({from.x(), from.y(), eye_m}, {to.x(), to.y(), eye_m}, kHalfBody_m);
  };
  const auto place = goal_chooser_.choose(target, step_.robot.pose, clearance, sees, doorways_);
  driveTo(place ? place->pose.position : *step_.target);
}

// A turn on the spot, towards the side where the person was last seen.
void Follower::seek() {
  step_.velocity.turn_radps = seek_side_ * params_.seek_radps;
  turned_rad_ += std::abs(watch_.increment().yaw_rad);
}

// Goes where the chance to see the person is best, and looks there.
void Follower::search() {
  searched_s_ += dt_s_;
  view_age_s_ += dt_s_;
  if (!view_ || is_there_ || view_age_s_ > params_.new_view_s) {
    view_ = search_.nextView(step_.robot.pose);
    view_age_s_ = 0.0;
    is_there_ = false;
    local_planner_.reset();
  }
  search_is_over_ = !view_;
  if (!view_) return;
  driveTo(view_->camera.position);
  if (!has_arrived_) return;
  const Vector2d ahead = view_->camera * Vector2d(2.0, 0.0);
  const double turn =
      turnToFace(robot_.drive, {step_.robot.pose, speed_}, ahead, params_.drive.facing);
  step_.velocity = {0.0, turn};
  is_there_ = turn == 0.0;
}

// Stays where it is, turned to the person, unless it must make room: nobody waits at a doorway
// that the robot stands in.
void Follower::face() {
  const Vector2d& here = step_.robot.pose.position;
  const GoalChooserParams& goal = goal_chooser_.params();
  const bool blocks = std::any_of(doorways_.begin(), doorways_.end(), [&](const DoorwayOnMap& d) {
    return inPassage(d, here, goal.doorway_depth_m, goal.radius_m) > 0.0;
  });
  if (blocks) return follow();
  plan_.path.clear();
  step_.velocity = localCommand();
}

// Around what the map and the moment show, in view of the person if there is one.
void Follower::driveTo(const Vector2d& goal) {
  const FloorPose& pose = step_.robot.pose;
  planner_.plan(pose.position, goal, plan_);
  if (!plan_.found()) {  // What is in the way may be gone by then: as the map has it.
    planner_.setObstacles({});
    planner_.plan(pose.position, goal, plan_);
    planner_.setObstacles({}, &layer_.window());
  }
  if (!plan_.found()) plan_.path.clear();
  step_.velocity = localCommand();
  step_.goal = goal;
  step_.path = &plan_.path;
  has_arrived_ = has_arrived_ || !plan_.found();
}

// Along the path, if there is one, without touching anything; in view of the target.
VelocityCommand Follower::localCommand() {
  const auto clearance = [this](const Vector2d& p) { return planner_.clearance().clearance(p); };
  const LocalPlan now =
      local_planner_.step(step_.robot.pose, speed_, plan_.path, clearance, people_, step_.target);
  has_arrived_ = now.status == DriveStatus::kArrived || now.blocked_s > params_.give_up_s;
  step_.reason += (step_.reason.empty() ? "" : "; ") + std::string(describe(now.reason));
  return now.command;
}

}  // namespace heel
