// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The robot's mind: readings in, a velocity out. The paper's system as one step.
#pragma once

#include <heel/apps/follower/behaviours.hpp>
#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/look_who.hpp>
#include <heel/apps/follower/make_room.hpp>
#include <heel/apps/follower/motion_history.hpp>
#include <heel/apps/follower/people_around.hpp>
#include <heel/apps/follower/pilot.hpp>
#include <heel/apps/follower/sensor_watch.hpp>
#include <heel/apps/follower/things_around.hpp>
#include <heel/mapping/wall_map.hpp>
#include <heel/planning/following_plan.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {

/// The stages of a step, for who times them; kBegin is before the first. The camera's is kLearn in
/// phase 1 and kSee in phase 2.
enum class FollowStage { kBegin, kLocalize, kLearn, kSee, kLookAround, kDecide, kDrive };
inline constexpr int kFollowStages = 7;
const char* toText(FollowStage stage);

/// Phase 1 ended, and there is nobody to follow.
struct NobodyLearned : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What one step came to. References are to the follower's own memory, valid until the next step.
struct FollowStep {
  double stamp_s = 0.0;
  VelocityCommand velocity;
  bool is_learning = true;  ///< Phase 1: the robot stands and learns whom to follow.
  bool is_paused = false;   ///< The robot stands, and only looks.
  FollowingAction action = FollowingAction::kStop;
  PlanOutcome outcome = PlanOutcome::kRunning;
  std::string reason;  ///< Why it does what it does, in a few words.

  LocalizationEstimate robot;
  const AcquisitionStep* acquisition = nullptr;  ///< Of this step's frame, in phase 1.
  const PerceptionStep* perception = nullptr;    ///< Of this step's frame, in phase 2.
  std::optional<Eigen::Vector2d> target;         ///< Where the person is, as far as is known.
  std::optional<Eigen::Vector2d> goal;           ///< Where the robot wants to stand.
  const FloorPath* path = nullptr;               ///< The way there.

  /// The state in a word: "paused", "learn", or the plan's action.
  const char* state() const;
};

/// Follows one person. Value in, value out; holds the stages' memory. Deterministic.
class Follower {
 public:
  /// Told after each stage, so that the caller, who has the clock, can time them.
  using StageDone = std::function<void(FollowStage)>;

  /// @param walls  Null: there is no map. The robot is then where its odometry says, its obstacles
  ///               are those that it sees, and it waits where it would search. It does not leave
  ///               100 m by 100 m around its start.
  /// @param start  Where the robot is at the beginning; absent: found on the map, or the origin.
  /// @throws std::invalid_argument  if a parameter is out of its range.
  Follower(const RobotDescription& robot, std::shared_ptr<const WallMap> walls, PetriPlan plan,
           const std::optional<FloorPose>& start, const FollowerParams& params = {});

  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// Ends phase 1 before its time: follows whom the model tells, wherever they are.
  void skipLearning(const AppearanceModel& whom);

  /// While it is paused the robot stands. It goes on to look, in phase 1 to learn; the plan waits.
  void pause(bool is_paused) { step_.is_paused = is_paused; }

  /// From now on the robot does this where the plan says `action`; null: it stands. It still leaves
  /// the way to people first, and in seek and search looks at who may be the person.
  /// @throws std::invalid_argument  for kStop: then it stands.
  void exchange(FollowingAction action, std::unique_ptr<Behaviour> behaviour);

  /// @throws NobodyLearned  if nobody entered in phase 1, or several did together.
  const FollowStep& step(const RobotReadings& readings, const StageDone& done = {});

  const RobotDescription& robot() const { return robot_; }
  const ObstacleLayer& obstacles() const { return things_.layer(); }
  const OccupancyGrid& floor() const { return floor_; }
  const TargetEstimate& target() const { return target_; }
  /// Why the readings do not let the robot move; empty if they do.
  const std::string& blindness() const { return watch_.blindness(); }
  /// Null in phase 1.
  const Perception* perception() const { return perception_ ? &*perception_ : nullptr; }

 private:
  void tellTime(double stamp_s);
  RobotReadings stamped(const RobotReadings& readings) const;
  Frame onSteadyClock(const Frame& frame);
  FloorPose poseAt(double steady_s) const;
  void localize(const RobotReadings& readings);
  void findOnMap(const LaserScan* scan);
  void lookAround(const RobotReadings& readings);
  void takeIn(RobotCamera by, const Frame& frame, double stamp_s);
  void learn(const Frame& frame);
  void see(const Frame* frame);
  void noteTarget();
  void noteSuspects();
  void decide();
  void checkFacts();
  void begin(FollowingAction action);
  void drive();
  void behave();
  Behaviour* behaviourOf(FollowingAction action) const {
    return behaviours_[static_cast<std::size_t>(action)].get();
  }
  IntentOutcome carryOut(const Intent& intent);
  void passLastGate();

  RobotDescription robot_;
  FollowerParams params_;
  std::shared_ptr<const WallMap> walls_;  // null: there is no map
  FloorPose start_;                       // without a map
  OccupancyGrid floor_;

  SensorWatch watch_;
  MotionHistory motion_;                      // by odometry, on the steady clock
  std::optional<Localization> localization_;  // on the map
  ThingsAround things_;
  PeopleAround people_;
  LaserBodies legs_;
  std::optional<PersonLearner> learner_;
  std::optional<Perception> perception_;
  PlanRunner runner_;
  LastGate last_gate_;
  std::vector<Eigen::Vector2d> hiding_places_;  // in the odometry's frame
  std::vector<Eigen::Vector2d> hidden_;         // there, on the map
  std::optional<PersonSearch> search_;          // the same
  Pilot pilot_;
  Premises premises_;
  MakeRoom make_room_;
  LookWhoThatIs look_who_;
  std::array<std::unique_ptr<Behaviour>, kFollowingActions> behaviours_;

  FollowStep step_;
  Situation now_;
  double steady_s_ = 0.0;         // a clock that does not jump,
  double clock_offset_s_ = 0.0;   // what it is ahead of the readings',
  double frame_s_ = 0.0;          // the newest frame's stamp on it,
  double frame_latency_s_ = 0.0;  // and how old it was when it came
  VelocityCommand speed_;         // by odometry
  TargetEstimate target_;
  int followed_id_ = TargetEstimate::kNoTrack;  // the track that was the target last
  double tracked_s_ = 0.0;  // when the tracks were stepped last, on the steady clock
  double scan_s_ = 0.0;     // the newest scan's stamp, on the steady clock
  FollowingFacts facts_;
  FollowingAction action_ = FollowingAction::kStop;
  FollowingAction begun_ = FollowingAction::kStop;  // the last one but stops
  double since_look_s_ = 0.0;                       // for obstacles, by the camera,
  double since_scan_s_ = 0.0;                       // and since the newest scan
  bool has_arrived_ = false;  // where the last intent led, or as near as can be
};

}  // namespace heel
