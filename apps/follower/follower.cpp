// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/follower.hpp>
#include <heel/planning/hiding_places.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr double kOpenFloor_m = 100.0;  // Without a map, so far across.
constexpr double kAnywhere_m2 = 1e4;    // Of a robot that is lost, whatever its particles say.

OccupancyGrid openFloor(const Vector2d& middle) {
  constexpr double kCell_m = 0.1;
  constexpr int kCells = static_cast<int>(kOpenFloor_m / kCell_m);
  return {middle - Vector2d::Constant(0.5 * kOpenFloor_m), kCell_m, kCells, kCells};
}

}  // namespace

const char* toText(FollowStage stage) {
  switch (stage) {
    case FollowStage::kBegin:
      return "begin";
    case FollowStage::kLocalize:
      return "localize";
    case FollowStage::kLearn:
      return "learn";
    case FollowStage::kSee:
      return "see";
    case FollowStage::kLookAround:
      return "look_around";
    case FollowStage::kDecide:
      return "decide";
    case FollowStage::kDrive:
      return "drive";
  }
  return "unknown";
}

const char* FollowStep::state() const {
  return is_paused ? "paused" : is_learning ? "learn" : nameOf(action);
}

Follower::Follower(const RobotDescription& robot, std::shared_ptr<const WallMap> walls,
                   PetriPlan plan, const std::optional<FloorPose>& start,
                   const FollowerParams& params)
    : robot_(robot),
      params_(fittedTo(robot, params)),
      walls_(std::move(walls)),
      start_(start.value_or(FloorPose{})),
      floor_(walls_ ? walls_->floorGrid({0.05, robot.height_m}) : openFloor(start_.position)),
      watch_(robot.camera, params_.watch, robot.floor_camera),
      things_(robot, params_, floor_),
      people_(params_),
      legs_(params_.legs),
      learner_(std::in_place, robot.camera, params_.learn),
      runner_(std::move(plan)),
      last_gate_(params_.last_gate),
      pilot_(floor_, params_.paths, params_.drive, params_.give_up_s),
      premises_(params_, walls_, findDoorways(floor_)),
      make_room_(premises_, params_),
      look_who_(premises_, params_) {
  step_.robot.pose = start_;
  step_.robot.lost = false;
  if (walls_) {
    localization_.emplace(walls_->floorGrid(HeightBand::around(robot.scanner_height_m)),
                          robot.T_base_scanner, params_.localization);
    if (start) localization_->startAt(*start);
    step_.robot = localization_->estimate();
    search_.emplace(floor_, walls_->floorGrid({1.1, 1.4}), params_.search);
  }
  using Action = FollowingAction;
  exchange(Action::kFollow, std::make_unique<FollowTarget>(premises_, params_.goal));
  exchange(Action::kFace, std::make_unique<FaceTarget>(premises_, params_));
  exchange(Action::kGoToLastSeen, std::make_unique<GoToLastSeen>(params_.near_m));
  exchange(Action::kSeek, std::make_unique<SeekTarget>(params_.seek_radps, params_.walks_on_s));
  exchange(Action::kSearch, std::make_unique<SearchForTarget>(search_ ? &*search_ : nullptr));
}

void Follower::exchange(FollowingAction action, std::unique_ptr<Behaviour> behaviour) {
  if (action == FollowingAction::kStop) {
    throw std::invalid_argument("a robot that stops does nothing");
  }
  behaviours_[static_cast<std::size_t>(action)] = std::move(behaviour);
  if (action == begun_) begin(action);
}

const FollowStep& Follower::step(const RobotReadings& readings, const StageDone& done) {
  const auto finished = [&done](FollowStage stage) {
    if (done) done(stage);
  };
  finished(FollowStage::kBegin);
  step_.stamp_s = readings.stamp_s;
  step_.acquisition = nullptr;
  step_.perception = nullptr;
  if (!step_.is_learning) learner_.reset();
  const RobotReadings usable = watch_.step(stamped(readings));
  tellTime(readings.stamp_s);

  localize(usable);
  finished(FollowStage::kLocalize);

  const bool learns = learner_.has_value();
  if (!learns) see(usable.frame);
  if (learns && usable.frame != nullptr) learn(*usable.frame);
  finished(learns ? FollowStage::kLearn : FollowStage::kSee);

  lookAround(usable);
  finished(FollowStage::kLookAround);

  decide();
  finished(FollowStage::kDecide);

  drive();
  passLastGate();
  finished(FollowStage::kDrive);
  return step_;
}

// Where the clock jumps, none of the stages' time passes.
void Follower::tellTime(double stamp_s) {
  now_.elapsed_s = watch_.elapsed_s();
  if (!watch_.timeJumped()) {
    steady_s_ = stamp_s + clock_offset_s_;
  } else if (std::isfinite(stamp_s)) {
    clock_offset_s_ = steady_s_ - stamp_s;
  }
}

RobotReadings Follower::stamped(const RobotReadings& readings) const {
  RobotReadings all = readings;
  if (!all.scan_stamp_s) all.scan_stamp_s = readings.stamp_s - robot_.scan_latency_s;
  if (!all.odometry_stamp_s) all.odometry_stamp_s = readings.stamp_s - robot_.wheels_latency_s;
  return all;
}

// Where the robot was, by odometry back from where it is.
FloorPose Follower::poseAt(double steady_s) const {
  return step_.robot.pose * motion_.seenFromNow(steady_s);
}

// A frame is as old as it says, unless it was taken before the clock jumped; never older than one
// before it.
Frame Follower::onSteadyClock(const Frame& frame) {
  frame_s_ = std::max(frame_s_, steady_s_ - watch_.imageAge_s());
  frame_latency_s_ = steady_s_ - frame_s_;
  Frame steady = frame;
  steady.stamp_s = frame_s_;
  return steady;
}

// Monte Carlo localization; beams that end on people are left out. Without a map, odometry.
void Follower::localize(const RobotReadings& readings) {
  if (readings.odometry) {
    const FloorPose& moved = watch_.increment();
    const double in_s = watch_.increment_s();
    if (localization_) localization_->predict(moved);
    motion_.add(steady_s_ - watch_.odometryAge_s(), moved);
    if (in_s > 0.0) speed_ = {moved.position.x() / in_s, moved.yaw_rad / in_s};
  }
  if (readings.scan != nullptr) {
    scan_s_ = std::max(scan_s_, steady_s_ - watch_.scanAge_s());
    last_gate_.addScan(*readings.scan, motion_.at(scan_s_), scan_s_);
  }
  if (localization_) {
    findOnMap(readings.scan);
  } else {
    step_.robot.pose = start_ * motion_.pose();
  }
  if (readings.scan != nullptr) {
    const FloorPose from_motion = step_.robot.pose * motion_.pose().inverse();
    findHidingPlaces(
        *readings.scan, motion_.at(scan_s_) * robot_.T_base_scanner,
        [&](const Vector2d& place) { return pilot_.room_m(from_motion * place); },
        MovingPerson().radius_m, hiding_places_);
  }
  now_.robot = step_.robot.pose;
  now_.turned_rad = watch_.increment().yaw_rad;
  const auto to_walls = [this](const Vector2d& p) {
    return localization_ ? localization_->field().distance_m(p) : kOpenFloor_m;
  };
  legs_.step(readings.scan, poseAt(scan_s_) * robot_.T_base_scanner, to_walls, now_.elapsed_s);
}

void Follower::findOnMap(const LaserScan* scan) {
  if (scan != nullptr) {
    localization_->update(*scan,
                          people_.discs(now_.people, localization_->estimate().pose.inverse()),
                          motion_.seenFromNow(scan_s_));
  }
  step_.robot = localization_->estimate();
}

// What stands and moves around the robot that no map shows.
void Follower::lookAround(const RobotReadings& readings) {
  if (step_.is_learning) return;  // whoever is there now will be the one to follow
  const FloorPose& pose = step_.robot.pose;
  std::optional<FloorDisc> own;
  if (now_.target) own = FloorDisc{now_.target->position, params_.target_radius_m};
  // What is seen where people are may walk off.
  things_.begin(steady_s_, pose, own, people_.discs(now_.people, {}));
  const bool searches = search_ && !step_.robot.lost;
  if (search_) {
    search_->wait(now_.elapsed_s,
                  [&](const Vector2d& place) { return people_.isSeenAt(place, now_); });
  }
  since_scan_s_ += now_.elapsed_s;
  if (readings.scan != nullptr) {
    const FloorPose T_base_scanner = motion_.seenFromNow(scan_s_) * robot_.T_base_scanner;
    things_.addScan(*readings.scan, T_base_scanner);
    if (searches) {
      search_->scan(*readings.scan, pose * T_base_scanner,
                    std::min(since_scan_s_, params_.watch.max_scan_age_s));
    }
    since_scan_s_ = 0.0;
  }
  things_.feel(step_.velocity, speed_, now_.elapsed_s);
  since_look_s_ += now_.elapsed_s;
  if (readings.frame != nullptr && since_look_s_ > params_.obstacles_every_s - 1e-6) {
    takeIn(RobotCamera::kAhead, *readings.frame, frame_s_);
    if (searches) {
      const FloorPose then = pose * motion_.seenFromNow(frame_s_);
      // Where a picture has no depth the laser may have seen a door's leaf.
      search_->look(then, std::min(since_look_s_, params_.watch.max_image_age_s),
                    [&, sight = things_.sight(),
                     T_then_world = then.inverse()](const Vector2d& p) -> std::optional<SeenTo> {
                      // A body hides its own place: whose it is, identity says.
                      if (people_.isAnybodyAt(p, now_)) return SeenTo(p, true);
                      const auto to = sight.seenTo(T_then_world * p);
                      if (!to) return things_.firstBetween(then.position, p);
                      return SeenTo(then * *to, people_.isAnybodyAt(then * *to, now_));
                    });
      for (const Track& track : perception_->tracks()) {
        if (now_.target || track.observation == Track::kUnseen) continue;
        search_->hold(track.motion.position_m(), params_.target_radius_m,
                      perception_->identity().targetProbability(track.id));
      }
    }
    since_look_s_ = 0.0;
  }
  if (readings.floor != nullptr) {
    takeIn(RobotCamera::kFloor, *readings.floor, steady_s_ - watch_.floorAge_s());
  }
  things_.finish();
  people_.step(steady_s_, *perception_, last_gate_.sight(), motion_.pose() * pose.inverse(), now_);
  pilot_.setAround(things_.apartFrom(now_.people), things_.layer().stood_s(), people_.resting());
}

void Follower::takeIn(RobotCamera by, const Frame& frame, double stamp_s) {
  const std::vector<Eigen::Vector3f>& points = things_.look(by, frame);
  const FloorPose T_base_then = motion_.seenFromNow(stamp_s);
  last_gate_.addPoints(static_cast<int>(by), points, motion_.at(stamp_s), stamp_s,
                       things_.stepsFrom(step_.robot.pose * T_base_then));
  things_.addPoints(by, points, T_base_then);
}

// Phase 1 (section 2).
void Follower::learn(const Frame& frame) {
  step_.acquisition = &learner_->step(onSteadyClock(frame));
  if (!learner_->isDone()) return;
  if (!learner_->hasPerson()) {
    throw NobodyLearned("nobody entered to be learned, or several did together");
  }
  const Vector2d place = step_.robot.pose * learner_->result().last_place_m;
  skipLearning(learner_->learn());
  perception_->startAt(place);
  now_.last.position = place;
  if (search_) search_->lose(now_.last, 0.0, 1.0);
}

void Follower::skipLearning(const AppearanceModel& whom) {
  PerceptionParams params = params_.perception;
  if (walls_) params.gate = wallGate(walls_, params_.gate);
  const auto density = [this](const Vector2d& place) -> std::optional<double> {
    const bool is_known = followed_id_ != TargetEstimate::kNoTrack && !step_.robot.lost;
    if (now_.target || !search_ || !is_known) return std::nullopt;
    return search_->density(place);
  };
  perception_.emplace(robot_.camera, whom, params, density);
  now_.last.position = step_.robot.pose.position;  // for want of a better place
  if (search_) search_->begin();
  step_.is_learning = false;
}

// Phase 2 (section 3.1, 3.2), by camera and laser.
void Follower::see(const Frame* frame) {
  const auto placeAt = [this](double stamp_s) -> RobotPlace {
    if (step_.robot.lost) return {poseAt(stamp_s), kAnywhere_m2 * Eigen::Matrix2d::Identity()};
    return {poseAt(stamp_s), step_.robot.covariance.topLeftCorner<2, 2>()};
  };
  const LaserBodies* legs = legs_.isFresh() ? &legs_ : nullptr;
  if (frame != nullptr) {
    tracked_s_ = steady_s_;
    const Frame now = onSteadyClock(*frame);
    step_.perception = &perception_->step(now, placeAt(now.stamp_s), legs);
    target_ = step_.perception->target;
  } else if (legs != nullptr && steady_s_ - tracked_s_ > params_.no_frame_s) {
    tracked_s_ = steady_s_;
    // No later than the next image, or that would be too late to count.
    const double stamp_s = std::min(scan_s_, steady_s_ - frame_latency_s_);
    target_ = perception_->step(stamp_s, placeAt(scan_s_), *legs).target;
  } else if (target_.hasPlace() &&
             steady_s_ - tracked_s_ > params_.perception.tracker.max_coast_s) {
    target_.status = TargetStatus::kLost;
  }
  noteTarget();
}

void Follower::noteTarget() {
  const bool was_known = now_.target.has_value();
  now_.target.reset();
  step_.target.reset();
  now_.unseen_s += now_.elapsed_s;
  if (target_.hasPlace()) {
    now_.target =
        MovingPerson{target_.motion.position_m(), target_.motion.velocity_mps(),
                     MovingPerson().radius_m, gaitOf(target_.motion, step_.robot.pose.position)};
    const double rests_s = perception_->identity().restsFor_s(target_.track_id, steady_s_);
    if (rests_s >= params_.walks_on_s) now_.target->rests_s = rests_s;
    step_.target = now_.target->position;
  }
  const bool is_seen_now = tracked_s_ == steady_s_;
  if (target_.status == TargetStatus::kFollowed && is_seen_now) {
    now_.last = *now_.target;
    followed_id_ = target_.track_id;
    now_.unseen_s = 0.0;
  }
  if (was_known && !now_.target && search_) {
    // As it seems now: it may be lost because it was somebody else.
    const double were_there = perception_->identity().hadTarget(followed_id_) +
                              perception_->probabilityAt(now_.last.position, followed_id_);
    search_->lose(now_.last, now_.unseen_s, std::min(were_there, 1.0));
  }
  noteSuspects();
  look_who_.watch(now_);
}

// Who may be the target, and how much the search promises.
void Follower::noteSuspects() {
  now_.suspects.clear();
  if (now_.target) return;
  for (const Track& track : perception_->tracks()) {
    if (track.status == TrackStatus::kTentative) continue;
    const Vector2d place = track.motion.position_m();
    now_.suspects.push_back({place, perception_->probabilityAt(place)});
  }
  const std::optional<SearchView> view = search_ ? search_->view() : std::nullopt;
  const double per_s = view ? view->chance / view->time_s : params_.seek_radps / (2.0 * M_PI);
  now_.elsewhere_per_s = perception_->identity().away() * per_s;
}

// The Petri net plan (section 3.4).
void Follower::decide() {
  if (step_.is_learning) return;
  if (step_.is_paused) return;
  checkFacts();
  const PlanStep& now = runner_.step(facts_);
  step_.outcome = now.outcome;
  const FollowingAction action = currentAction(runner_);
  // A stop only holds what the robot does: it goes on with that after.
  if (action != FollowingAction::kStop && action != begun_) begin(action);
  step_.action = action_ = action;
}

void Follower::checkFacts() {
  using Fact = FollowingCondition;
  const FloorPose& pose = step_.robot.pose;
  const double away_m = now_.target ? (now_.target->position - pose.position).norm() : 0.0;
  facts_[Fact::kTargetSeen] = now_.target.has_value();
  const bool is_ahead =
      std::abs(bearingOf(pose, now_.expected(params_.walks_on_s).position)) < params_.ahead_rad;
  // Who is out of view because the way to them leads round something is not lost yet.
  const bool is_on_the_way = step_.path != nullptr && !has_arrived_;
  facts_[Fact::kTargetLost] =
      !now_.target && now_.unseen_s > params_.lost_after_s && (is_ahead || !is_on_the_way);
  facts_[Fact::kNear] = now_.target && away_m < params_.near_m;
  facts_[Fact::kFar] = now_.target && away_m > params_.far_m;
  facts_[Fact::kArrived] = has_arrived_;
  facts_[Fact::kFullTurn] = facts_[Fact::kSearchOver] = false;
  for (const auto& behaviour : behaviours_) {
    if (behaviour) behaviour->tell(facts_);
  }
  facts_[Fact::kLookedAround] = facts_[Fact::kFullTurn] || (!look_who_.wants() && is_ahead);
  facts_[Fact::kBlind] = !watch_.blindness().empty() || step_.robot.lost;
  facts_[Fact::kDone] = false;
}

void Follower::begin(FollowingAction action) {
  begun_ = action;
  pilot_.reset();
  has_arrived_ = false;
  if (Behaviour* behaviour = behaviourOf(action)) behaviour->begin(now_);
}

}  // namespace heel
