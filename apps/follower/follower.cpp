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

constexpr double kFullTurn_rad = 6.283185307179586;

}  // namespace

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
      params_(fittedTo(robot, params)),
      walls_(walls ? std::move(walls) : throw std::invalid_argument("Follower: there is no map")),
      floor_(walls_->floorGrid({0.05, robot.height_m})),
      to_walls_(floor_, 1.0),
      watch_(robot.camera, params_.watch),
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
  step_.stamp_s = readings.stamp_s;
  step_.acquisition = nullptr;
  step_.perception = nullptr;
  const RobotReadings usable = watch_.step(readings);
  tellTime(readings.stamp_s);

  localize(usable);
  finished(FollowStage::kLocalize);

  lookAround(usable);
  finished(FollowStage::kLookAround);

  const bool learns = learner_.has_value();
  if (usable.frame != nullptr) learns ? learn(*usable.frame) : see(*usable.frame);
  finished(learns ? FollowStage::kLearn : FollowStage::kSee);

  decide(usable);
  finished(FollowStage::kDecide);

  drive();
  finished(FollowStage::kDrive);
  return step_;
}

// Where the clock jumps, none of the stages' time passes.
void Follower::tellTime(double stamp_s) {
  dt_s_ = watch_.elapsed_s();
  if (!watch_.timeJumped()) {
    steady_s_ = stamp_s + clock_offset_s_;
  } else if (std::isfinite(stamp_s)) {
    clock_offset_s_ = steady_s_ - stamp_s;
  }
}

// A frame is as old as it says, unless it was taken before the clock jumped; never older than one
// before it.
Frame Follower::onSteadyClock(const Frame& frame) {
  const double age_s = step_.stamp_s - frame.stamp_s;
  const bool is_of_this_clock = age_s >= 0.0 && age_s <= params_.watch.max_gap_s;
  frame_s_ = std::max(frame_s_, is_of_this_clock ? steady_s_ - age_s : steady_s_);
  Frame steady = frame;
  steady.stamp_s = frame_s_;
  return steady;
}

// Monte Carlo localization; beams that end on people are left out.
void Follower::localize(const RobotReadings& readings) {
  if (readings.odometry) {
    const FloorPose& moved = watch_.increment();
    const double in_s = watch_.increment_s();
    localization_.predict(moved);
    if (in_s > 0.0) speed_ = {moved.position.x() / in_s, moved.yaw_rad / in_s};
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
  layer_.begin(steady_s_, pose, own);
  if (readings.scan != nullptr) {
    layer_.addScan(*readings.scan, robot_.T_base_scanner,
                   [this](const Vector2d& p) { return isMapped(p); });
    people_around_.step(steady_s_, *readings.scan, pose * robot_.T_base_scanner,
                        [this](const Vector2d& p) { return localization_.field().distance_m(p); });
  }
  obstacles_age_s_ += dt_s_;
  if (readings.frame != nullptr && obstacles_age_s_ > params_.obstacles_every_s - 1e-6) {
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
  step_.acquisition = &learner_->step(onSteadyClock(frame));
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
  std::vector<Identity::Hint> hints;
  if (step_.target && target_place_.isSure()) hints.push_back({*step_.target, 0.5, 3.0, 2.0});
  for (const Vector2d& other : target_place_.others()) hints.push_back({other, 0.3, -4.0, 0.0});
  for (const int id : people_around_.walkers()) {
    hints.push_back({people_around_.find(id)->motion.position_m(), 0.4, 0.0, 2.0});
  }
  perception_->setHints(std::move(hints));
  step_.perception = &perception_->step(onSteadyClock(frame), place);
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
    return step_.perception != nullptr && isSomebodyElse(p);
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
    if (readings.frame != nullptr) search_.look(step_.robot.pose, dt_s_);
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

// Whether the camera sees somebody there who is not the target.
bool Follower::isSomebodyElse(const Vector2d& place) const {
  const std::vector<Track>& tracks = perception_->tracks();
  return std::any_of(tracks.begin(), tracks.end(), [&](const Track& track) {
    return track.status == TrackStatus::kConfirmed &&
           (track.motion.position_m() - place).norm() < params_.place.legs_within_m &&
           perception_->identity().targetProbability(track.id) < params_.worth_a_look;
  });
}

// Whether the camera sees a whole person there, if there is one.
bool Follower::isInView(const Vector2d& place) const {
  const double away_m = (place - step_.robot.pose.position).norm();
  return watch_.imageIsGood() && away_m > params_.near_m && away_m < params_.sees_within_m &&
         std::abs(bearingOf(step_.robot.pose, place)) < 0.8 * robot_.halfView_rad();
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
