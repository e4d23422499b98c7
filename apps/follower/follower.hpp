// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The robot's mind: readings in, a velocity out. The paper's system as one step.
#pragma once

#include <heel/apps/follower/follower_params.hpp>
#include <heel/apps/follower/motion_history.hpp>
#include <heel/apps/follower/sensor_watch.hpp>
#include <heel/apps/follower/unseen_people.hpp>
#include <heel/mapping/wall_map.hpp>
#include <heel/planning/clearance_map.hpp>
#include <heel/planning/following_plan.hpp>

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

  /// Ends phase 1 before its time: follows whom the model tells, wherever they are.
  void skipLearning(const AppearanceModel& whom);

  /// While it is paused the robot stands. It goes on to look, in phase 1 to learn; the plan waits.
  void pause(bool is_paused) { step_.is_paused = is_paused; }

  /// @throws NobodyLearned  if nobody entered in phase 1, or several did together.
  const FollowStep& step(const RobotReadings& readings, const StageDone& done = {});

  const RobotDescription& robot() const { return robot_; }
  const ObstacleLayer& obstacles() const { return layer_; }
  const OccupancyGrid& floor() const { return floor_; }
  const TargetEstimate& target() const { return target_; }
  /// Why the readings do not let the robot move; empty if they do.
  const std::string& blindness() const { return watch_.blindness(); }
  /// Null in phase 1.
  const Perception* perception() const { return perception_ ? &*perception_ : nullptr; }

 private:
  /// Somebody wants to get past the robot, which goes aside.
  struct MakingRoom {
    Eigen::Vector2d place;   // where it goes
    Eigen::Vector2d before;  // where it was then
    bool is_for_target = false;
    double since_s = 0.0;
    double waited_s = 0.0;
  };

  void tellTime(double stamp_s);
  RobotReadings stamped(const RobotReadings& readings) const;
  Frame onSteadyClock(const Frame& frame);
  FloorPose poseAt(double steady_s) const;
  void localize(const RobotReadings& readings);
  void findOnMap(const LaserScan* scan);
  void lookAround(const RobotReadings& readings);
  void learn(const Frame& frame);
  void see(const Frame* frame);
  void noteTarget();
  void decide();
  void checkFacts();
  void begin(FollowingAction action);
  void drive();
  void noteProgress();
  void feelAround();
  void noteComers();
  void notePeople();
  void keepThings();
  void layOutPeople(const FloorPose& T_frame_world);
  bool isMapped(const Eigen::Vector2d& place) const;
  void keepUnmapped(const std::vector<Eigen::Vector3f>& points, const FloorPose& T_base_then);
  void driveTo(const Eigen::Vector2d& goal);
  VelocityCommand localCommand(const std::optional<Eigen::Vector2d>& face);
  void follow();
  void face();
  bool standsInDoorway() const;
  bool makesRoom();
  const MovingPerson* whoWantsPast();
  bool isInTheWayOf(const MovingPerson& person) const;
  void goAside(const MovingPerson& person);
  void goToLastSeen();
  bool looksAtSuspect();
  const Track* suspect() const;
  MovingPerson expected() const;
  void seek();
  void search();
  void lookAt(const Eigen::Vector2d& place);
  Eigen::Vector2d turningPlace() const;
  double sideOf(const Eigen::Vector2d& place) const;
  void passLastGate();

  RobotDescription robot_;
  FollowerParams params_;
  std::shared_ptr<const WallMap> walls_;  // null: there is no map
  FloorPose start_;                       // without a map
  OccupancyGrid floor_;

  SensorWatch watch_;
  MotionHistory motion_;                      // by odometry, on the steady clock
  std::optional<Localization> localization_;  // on the map
  ObstacleLayer layer_;
  OccupancyGrid things_;  // its window, people apart
  ObstaclePoints obstacle_points_;
  LaserBodies legs_;
  std::optional<PersonLearner> learner_;
  std::optional<Perception> perception_;
  PlanRunner runner_;
  ClearanceMap room_;  // to things
  GlobalPlanner planner_;
  LocalPlanner local_planner_;
  LastGate last_gate_;
  std::vector<Eigen::Vector2d> hiding_places_;  // in the odometry's frame
  std::vector<Eigen::Vector2d> hidden_;         // there, on the map
  GoalChooser goal_chooser_;
  std::optional<PersonSearch> search_;  // the same
  std::vector<DoorwayOnMap> doorways_;

  FollowStep step_;
  double dt_s_ = 0.0;
  double steady_s_ = 0.0;        // a clock that does not jump,
  double clock_offset_s_ = 0.0;  // what it is ahead of the readings',
  double frame_s_ = 0.0;         // and the newest frame's stamp on it
  VelocityCommand speed_;        // by odometry
  double stalled_s_ = 0.0;       // so long the wheels have not turned, though they should
  TargetEstimate target_;
  std::optional<MovingPerson> person_;          // the target, where it is known to be;
  MovingPerson last_;                           // where it was when last seen,
  double unseen_s_ = 0.0;                       // so long ago,
  int followed_id_ = TargetEstimate::kNoTrack;  // as this track
  double tracked_s_ = 0.0;  // when the tracks were stepped last, on the steady clock
  double scan_s_ = 0.0;     // the newest scan's stamp, on the steady clock
  FollowingFacts facts_;
  FollowingAction action_ = FollowingAction::kStop;
  FollowingAction begun_ = FollowingAction::kStop;  // the last one but stops
  double obstacles_age_s_ = 0.0;
  double turned_rad_ = 0.0;   // in the present seek
  double seek_side_ = 1.0;    // +1: to the left
  double looked_s_ = 0.0;     // at suspects, since then
  bool is_there_ = false;     // at the search's view, and turned to it
  bool has_arrived_ = false;  // where the last driveTo() went, or as near as can be
  bool looks_away_ = false;   // from the target, in this step
  Eigen::Vector2d stood_at_ = Eigen::Vector2d::Zero();  // and has not left since,
  double stuck_s_ = 0.0;                                // though it wanted to for so long
  std::optional<MakingRoom> making_room_;
  std::vector<Eigen::Vector2d> waysides_;
  GlobalPlan plan_;
  std::vector<MovingPerson> people_;
  std::size_t seen_people_ = 0;          // the first ones, who are seen, and not the target
  std::vector<FloorDisc> people_discs_;  // all, in the frame last asked for
  UnseenPeople unseen_;
  std::vector<Eigen::Vector3f> unmapped_;  // points in the base frame
  std::vector<Eigen::Vector2d> steps_;     // down, in the base frame of the last picture
};

}  // namespace heel
