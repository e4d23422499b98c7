// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Phase 2, a frame in and the target's place out (section 3).
#pragma once

#include <heel/apps/follower/camera_setup.hpp>
#include <heel/apps/follower/depth_images.hpp>
#include <heel/apps/follower/laser_bodies.hpp>
#include <heel/apps/recording/frame.hpp>
#include <heel/cloud/color_cloud.hpp>
#include <heel/cloud/stereo_matcher.hpp>
#include <heel/mapping/floor_pose.hpp>
#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/appearance_model.hpp>
#include <heel/segmentation/body_description.hpp>
#include <heel/segmentation/height_crop.hpp>
#include <heel/segmentation/person_outline.hpp>
#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/world_blobs.hpp>
#include <heel/tracking/target.hpp>

#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace heel {

/// The stages of the chain, in order.
enum class Stage { kColorFilter, kDepth, kHeight, kPlanView, kTracking };
inline constexpr int kStages = 5;
const char* toText(Stage stage);

/// What a blob must be to be looked at as a person. Lenient: only the parts of a body that have the
/// target's colours are seen.
struct CandidateParams {
  int min_cells = 10;          ///< A blob has at least so many cells of the plan view.
  double min_score = 12.0;     ///< The heights of a blob's cells sum to at least this [m].
  double min_height_m = 1.25;  ///< A blob's highest point is at least this high.
  /// Least area of a blob that starts a track: that of a head and a shoulder. A track goes on with
  /// less, for little of a person passes who is half hidden or in the shade.
  double min_start_area_m2 = 0.05;
  /// Blobs nearer than this to the camera, on the floor, are "too close".
  double min_distance_m = 0.3;
};

/// The parameters of the stages of phase 2, in their order.
struct PerceptionParams {
  StereoMatcherParams stereo;
  PlanViewParams plan_view;
  WorldBlobParams blobs;
  CandidateParams candidates;
  BodyDescriberParams body;
  TrackerParams tracker;
  TargetParams target;
  GeometricGate gate;  ///< Where a person can be seen; anywhere if empty.
};

/// Where the robot is when a frame is taken. A robot that stands still has its base frame as world.
struct RobotPlace {
  FloorPose pose;                                           ///< Base frame to world.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();  ///< Of its position.
};

/// What one frame brought, stage by stage. References are to the perception's own memory, valid
/// until the next frame.
struct PerceptionStep {
  double stamp_s = 0.0;
  int color_pixels = 0;  ///< Pixels (of an unorganized cloud: points) of the target's colours.
  int color_points = 0;  ///< Of these, the ones with a position.
  cv::Mat mask;          ///< CV_8UC1, the pixels of the target's colours; empty: no image.
  ColorCloud::ConstPtr cloud;    ///< In the base frame.
  pcl::Indices standing;         ///< Points of the target's colours at their heights.
  std::vector<WorldBlob> blobs;  ///< All blobs, highest score first; in the base frame.
  /// The blobs that may be people, then what only the laser saw; in the world.
  std::vector<Observation> observations;
  std::vector<int> blob_of_observation;  ///< Which blob each is, as far as it is one.
  TargetEstimate target;

  /// The stage that lost the target, and why, as a short sentence; empty if it is seen.
  std::string reason;
};

/// What a model says of whom to look for, as the gallery wants it.
TargetLooks looksOf(const AppearanceModel& model);

/// Finds the target in one frame after the other. Value in, value out; holds the stages' memory.
class Perception {
 public:
  /// Told after each stage, so that the caller, who has the clock, can time them.
  using StageDone = std::function<void(Stage)>;

  /// @param density  Where the target may be who is lost; see TargetDensity.
  /// @throws std::invalid_argument  if a parameter is out of its range.
  Perception(const CameraSetup& setup, const AppearanceModel& model,
             const PerceptionParams& params = {}, TargetDensity density = {});

  /// The target is at this place of the world in the next frame (after phase 1, say).
  void startAt(const Eigen::Vector2d& position_m) { tracker_.startAt(position_m); }

  /// Stamps need not be regular; one that is not later than the last is skipped by the tracker.
  /// @param legs  What the robot's laser sees; null: it has none.
  /// @throws std::invalid_argument  if the frame has not what the sensor gives, or its images do
  ///                                not fit each other.
  const PerceptionStep& step(const Frame& frame, const RobotPlace& robot = {},
                             const LaserBodies* legs = nullptr, const StageDone& done = {});

  /// Goes on by the laser alone, when no frame comes.
  const PerceptionStep& step(double stamp_s, const RobotPlace& robot, const LaserBodies& legs);

  /// The track that is likeliest to be the target; null: none may be.
  const Track* likeliest() const { return tracker_.likeliest(); }
  /// That the target is at a place; see TargetTracker.
  double probabilityAt(const Eigen::Vector2d& place_m, int but = TargetEstimate::kNoTrack) const {
    return tracker_.probabilityAt(place_m, but);
  }
  const Identity& identity() const { return tracker_.identity(); }
  const std::vector<Track>& tracks() const { return tracker_.tracker().tracks(); }
  const TrackerReport& report() const { return tracker_.tracker().report(); }

 private:
  void filterColors(const Frame& frame);
  void measureDepth(const Frame& frame);
  void keepStanding();
  void findCandidates(const FloorPose& robot);
  void addLegs(const LaserBodies& legs);
  void measureBodies(const Frame& frame);
  void describeBodies(const Frame& frame, const FloorPose& robot);
  void track(const RobotPlace& robot, const LaserBodies* legs, bool has_image);
  Eigen::Matrix2d depthCovariance(const Eigen::Vector2d& position_m) const;
  const char* whyNotSeen() const;

  SensorKind sensor_;
  StereoCamera camera_;
  Eigen::Isometry3d T_base_camera_;
  std::vector<AppearanceBand> bands_;  // those that were learned
  ColorTable any_band_;                // for pixels whose height is not known yet
  PerceptionParams params_;

  StereoMatcher matcher_;
  cv::Mat disparity_, depth_m_;
  MaskedCloud masked_cloud_;
  ColorCloud::Ptr whole_cloud_;
  pcl::IndicesPtr all_points_;  // of an unorganized cloud
  pcl::IndicesPtr candidates_;
  std::vector<HeightCrop> height_crops_;  // one a band
  AppearanceFilter<pcl::PointXYZRGB> filter_;
  pcl::IndicesPtr in_band_;
  PlanView plan_view_;
  WorldBlobFinder finder_;
  BodyDescriber describer_;
  PersonOutline outline_;
  BodyView view_;                  // of the frame at hand
  std::vector<WorldBlob> bodies_;  // of the observations, in the base frame
  std::vector<cv::Rect> boards_;   // where they are in the image
  cv::Mat has_depth_;
  CoarseDepth coarse_depth_;
  std::vector<BodyDescription> looks_;  // of the observations
  // Of what the camera and the laser saw: what may be one person, the nearest first.
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs_;
  std::vector<bool> has_legs_, has_looks_;
  TargetTracker tracker_;
  PerceptionStep step_;
};

}  // namespace heel
