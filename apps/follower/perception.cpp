// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/perception.hpp"

#include "apps/follower/depth_images.hpp"
#include "segmentation/image_filter.hpp"

#include <opencv2/core.hpp>
#include <pcl/common/transforms.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace heel {
namespace {

GeometricGate gateOf(const PerceptionParams& params) {
  std::vector<GeometricGate> gates = {tooClose(params.candidates.min_distance_m)};
  if (params.gate) gates.push_back(params.gate);
  return allOf(std::move(gates));
}

std::vector<AppearanceBand> learnedBands(const AppearanceModel& model) {
  std::vector<AppearanceBand> bands;
  std::copy_if(model.bands().begin(), model.bands().end(), std::back_inserter(bands),
               [](const AppearanceBand& band) { return !band.table.empty(); });
  return bands;
}

bool isCandidate(const WorldBlob& blob, const CandidateParams& params) {
  return blob.cells >= params.min_cells && blob.score >= params.min_score &&
         blob.max_height_m >= params.min_height_m;
}

}  // namespace

const char* toText(Stage stage) {
  switch (stage) {
    case Stage::kColorFilter:
      return "color_filter";
    case Stage::kDepth:
      return "depth";
    case Stage::kHeight:
      return "height";
    case Stage::kPlanView:
      return "plan_view";
    case Stage::kTracking:
      return "tracking";
  }
  return "unknown";
}

Perception::Perception(const CameraSetup& setup, const AppearanceModel& model,
                       const PerceptionParams& params)
    : sensor_(setup.sensor),
      camera_(setup.camera),
      T_base_camera_(setup.T_base_camera),
      bands_(learnedBands(model)),
      any_band_(model.filterTable()),
      params_(params),
      matcher_(params.stereo),
      whole_cloud_(pcl::make_shared<ColorCloud>()),
      all_points_(new pcl::Indices),
      candidates_(new pcl::Indices),
      in_band_(new pcl::Indices),
      plan_view_(params.plan_view, {setup.T_base_camera.translation(),
                                    setup.camera.left.fx > 0.0 ? setup.camera.left.fx
                                                               : PlanViewCamera().focal_length_px}),
      finder_(params.blobs),
      tracker_(params.target, params.tracker, gateOf(params)) {
  if (model.params().comparison == BodyComparison::kMatch) {
    body_matcher_.emplace(model, params.match);
  }
  for (const AppearanceBand& band : bands_) {
    height_crops_.emplace_back(HeightCropParams{band.body.min_height_m, band.body.max_height_m});
  }
}

const PerceptionStep& Perception::step(const Frame& frame, const RobotPlace& robot,
                                       const StageDone& done) {
  const auto finished = [&done](Stage stage) {
    if (done) done(stage);
  };
  if (sensor_ == SensorKind::kCloud ? frame.cloud == nullptr : frame.image_bgr.empty()) {
    throw std::invalid_argument("Perception: the frame has not what the sensor gives");
  }
  step_.stamp_s = frame.stamp_s;

  filterColors(frame);
  finished(Stage::kColorFilter);

  measureDepth(frame);
  finished(Stage::kDepth);

  keepStanding();
  finished(Stage::kHeight);

  plan_view_.build(*step_.cloud, step_.standing, &any_band_);
  finder_.find(plan_view_, step_.blobs);
  findCandidates(frame, robot.pose);
  finished(Stage::kPlanView);

  step_.target = tracker_.step(
      frame.stamp_s, step_.observations,
      {robot.pose * Eigen::Vector2d(T_base_camera_.translation().head<2>()), robot.covariance_m2});
  step_.reason = whyNotSeen();
  finished(Stage::kTracking);
  return step_;
}

// A pixel's colour alone decides (section 3.1); where there is no image, a point's.
void Perception::filterColors(const Frame& frame) {
  if (frame.image_bgr.empty()) {
    *whole_cloud_ = *frame.cloud;  // copied first: from an empty cloud, PCL would print a warning
    pcl::transformPointCloud(*whole_cloud_, *whole_cloud_, T_base_camera_.matrix().cast<float>());
    filter_.setInputCloud(whole_cloud_);
    for (auto n = all_points_->size(); n < whole_cloud_->size(); ++n) {
      all_points_->push_back(static_cast<pcl::index_t>(n));
    }
    all_points_->resize(whole_cloud_->size());
    filter_.setIndices(all_points_);
    filter_.setTable(any_band_);
    filter_.filter(*candidates_);
    step_.mask.release();
    step_.color_pixels = static_cast<int>(candidates_->size());
    return;
  }
  filterImage(frame.image_bgr, any_band_, step_.mask);
  step_.color_pixels = cv::countNonZero(step_.mask);
}

// Stereo matching and back-projection, only where the colour passed.
void Perception::measureDepth(const Frame& frame) {
  if (frame.image_bgr.empty()) {
    step_.cloud = whole_cloud_;
  } else {
    switch (sensor_) {
      case SensorKind::kStereo:
        matcher_.match(frame.image_bgr, frame.right_bgr, step_.mask, disparity_);
        disparityToDepth(disparity_, camera_, depth_m_);
        break;
      case SensorKind::kRgbd:
        depth_m_ = frame.depth_m;
        break;
      case SensorKind::kCloud:
        depthOf(*frame.cloud, depth_m_);
        break;
    }
    masked_cloud_.update(depth_m_, frame.image_bgr, step_.mask, camera_.left, T_base_camera_);
    step_.cloud = masked_cloud_.cloud();
    candidates_->assign(masked_cloud_.indices().begin(), masked_cloud_.indices().end());
  }
  step_.color_points = static_cast<int>(candidates_->size());
}

// Each band keeps the points at its own heights that have its own colours.
void Perception::keepStanding() {
  step_.standing.clear();
  filter_.setInputCloud(step_.cloud);
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    height_crops_[i].apply(step_.cloud, candidates_, *in_band_);
    if (bands_.size() > 1) {
      filter_.setTable(bands_[i].table);
      filter_.setIndices(in_band_);
      filter_.filter(*in_band_);
    }
    step_.standing.insert(step_.standing.end(), in_band_->begin(), in_band_->end());
  }
}

void Perception::findCandidates(const Frame& frame, const FloorPose& robot) {
  step_.observations.clear();
  step_.blob_of_observation.clear();
  for (std::size_t i = 0; i < step_.blobs.size(); ++i) {
    WorldBlob& blob = step_.blobs[i];
    if (!isCandidate(blob, params_.candidates)) continue;
    blob.appearance = appearanceOf(blob, frame);
    step_.observations.push_back({robot * blob.position_m, blob.score, blob.appearance,
                                  blob.area_m2 >= params_.candidates.min_start_area_m2});
    step_.blob_of_observation.push_back(static_cast<int>(i));
  }
}

double Perception::appearanceOf(const WorldBlob& blob, const Frame& frame) {
  if (frame.image_bgr.empty()) {
    return body_matcher_ ? body_matcher_->match(*step_.cloud, blob)
                         : bodyAppearance(*step_.cloud, blob, bands_, params_.body);
  }
  const BodyView view{frame.image_bgr, depth_m_, camera_.left, T_base_camera_};
  return body_matcher_ ? body_matcher_->match(view, blob)
                       : bodyAppearance(view, blob, bands_, params_.body);
}

bool Perception::isUnlike(const Eigen::Vector2d& place_m, double within_m) const {
  const double least = params_.target.leastAppearance();
  return std::any_of(tracks().begin(), tracks().end(), [&](const Track& track) {
    return track.status == TrackStatus::kConfirmed && track.appearance() < least &&
           (track.motion.position_m() - place_m).norm() < within_m;
  });
}

// Silence is what users of trackers complain of most: name the first stage that left nothing.
const char* Perception::whyNotSeen() const {
  if (step_.target.reason == TargetReason::kFrameSkipped) return toText(step_.target.reason);
  if (step_.target.status == TargetStatus::kFollowed) return "";
  if (step_.color_pixels == 0) return "no pixel has the target's colours";
  if (step_.color_points == 0) return "no pixel of the target's colours has a depth";
  if (step_.standing.empty()) return "the target's colours are not at a person's height";
  if (step_.blobs.empty()) return "too few points of the target's colours in one place";
  if (step_.observations.empty()) return "no blob is as large and high as a person";
  if (step_.target.reason == TargetReason::kRejectedByGate) return toText(step_.target.verdict);
  return toText(step_.target.reason);
}

}  // namespace heel
