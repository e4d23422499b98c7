// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/depth_sight.hpp>
#include <heel/apps/follower/perception.hpp>
#include <heel/apps/follower/wall_gate.hpp>
#include <heel/segmentation/image_filter.hpp>

#include <opencv2/core.hpp>
#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr double kBody_m = 0.4;       // Legs this near to a place may be of somebody there.
constexpr double kBeside_m = 0.45;    // So far from the middle of somebody nothing is theirs.
constexpr double kMissedLegs = 0.05;  // Of people in its view, the laser misses as many.

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

TargetLooks looksOf(const AppearanceModel& model) {
  TargetLooks looks;
  looks.target = model.portrait().colors;
  looks.room = BodyDescriber::binsOf(model.room());
  looks.anybody = BodyDescriber::clothes();
  constexpr double kUsualStature_m = 1.7;
  const double stature_m = model.stature() ? model.stature()->height_m : kUsualStature_m;
  for (int stripe = 0; stripe < BodyDescriber::kStripes; ++stripe) {
    looks.garments.push_back(BodyDescriber::garmentOf(stripe, stature_m));
  }
  // Lamps and white balances change colours by about so much, rooms and exposures brightness.
  constexpr double kLightSigma = 0.2, kBrightnessSigma = 0.6;
  const auto addTint = [&looks](int red, int blue, int brighter) {
    const double steps = BodyDescriber::kLightStep / kLightSigma;
    const double brightness = brighter * BodyDescriber::kBrightnessStep / kBrightnessSigma;
    looks.tints.push_back(
        {BodyDescriber::inLight(red, blue, brighter),
         -0.5 * ((red * red + blue * blue) * steps * steps + brightness * brightness)});
  };
  for (int red = -1; red <= 1; ++red) {
    for (int blue = -1; blue <= 1; ++blue) {
      if (red != 0 || blue != 0) addTint(red, blue, 0);
    }
  }
  for (const int brighter : {-2, -1, 1, 2}) addTint(0, 0, brighter);
  if (model.stature()) {
    looks.stature_m = model.stature()->height_m;
    looks.stature_sigma_m = std::hypot(0.05, model.stature()->spread_m);
  }
  return looks;
}

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
                       const PerceptionParams& params, TargetDensity density)
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
      describer_(params.body),
      view_{{},
            {},
            setup.camera.left,
            setup.T_base_camera,
            setup.sensor == SensorKind::kStereo ? params.stereo.disparities : 0},
      coarse_depth_(setup.camera, params.stereo),
      tracker_(params.target, params.tracker, gateOf(params), looksOf(model), std::move(density)) {
  for (const AppearanceBand& band : bands_) {
    height_crops_.emplace_back(HeightCropParams{band.body.min_height_m, band.body.max_height_m});
  }
}

const PerceptionStep& Perception::step(const Frame& frame, const RobotPlace& robot,
                                       const LaserBodies* legs, const StageDone& done) {
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
  findCandidates(robot.pose);
  finished(Stage::kPlanView);

  if (legs != nullptr) addLegs(*legs);
  describeBodies(frame, robot.pose);
  track(robot, legs, !frame.image_bgr.empty());
  finished(Stage::kTracking);
  return step_;
}

const PerceptionStep& Perception::step(double stamp_s, const RobotPlace& robot,
                                       const LaserBodies& legs) {
  step_.stamp_s = stamp_s;
  step_.observations.clear();
  step_.blob_of_observation.clear();
  addLegs(legs);
  track(robot, &legs, false);
  return step_;
}

void Perception::track(const RobotPlace& robot, const LaserBodies* legs, bool has_image) {
  Viewpoint viewpoint;
  viewpoint.position_m = robot.pose * Eigen::Vector2d(T_base_camera_.translation().head<2>());
  viewpoint.covariance_m2 = robot.covariance_m2;
  const DepthSight by_depth(depth_m_, camera_.left,
                            (basePose(robot.pose) * T_base_camera_).inverse());
  const auto sight_of = [&](const Eigen::Vector2d& place_m) {
    const Sight by_legs = legs != nullptr ? legs->sightOf(place_m) : Sight::kUnknown;
    if (by_legs == Sight::kFree || by_legs == Sight::kHidden || !has_image) return by_legs;
    const Sight sight = by_depth.at(place_m);
    // With a laser, who is not in the picture need not be out of sight.
    return sight == Sight::kOutside && legs != nullptr ? Sight::kUnknown : sight;
  };
  if (legs != nullptr || has_image) viewpoint.sight_of = std::cref(sight_of);
  step_.target = tracker_.step(step_.stamp_s, step_.observations, viewpoint);
  step_.reason = whyNotSeen();
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

void Perception::findCandidates(const FloorPose& robot) {
  step_.observations.clear();
  step_.blob_of_observation.clear();
  for (std::size_t i = 0; i < step_.blobs.size(); ++i) {
    const WorldBlob& blob = step_.blobs[i];
    if (!isCandidate(blob, params_.candidates)) continue;
    Observation& seen = step_.observations.emplace_back();
    seen.position_m = robot * blob.position_m;
    seen.score = blob.score;
    seen.can_start = blob.area_m2 >= params_.candidates.min_start_area_m2;
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(robot.yaw_rad).toRotationMatrix();
    seen.covariance_m2 = R * depthCovariance(blob.position_m) * R.transpose();
    step_.blob_of_observation.push_back(static_cast<int>(i));
  }
}

// The camera tells who somebody is, the laser where; and what stands on no legs is hardly a person.
void Perception::addLegs(const LaserBodies& legs) {
  const std::vector<Observation>& bodies = legs.bodies();
  has_looks_.assign(bodies.size(), false);
  pairs_.clear();
  for (std::size_t k = 0; k < step_.observations.size(); ++k) {
    const Observation& seen = step_.observations[k];
    const double within_m = kBody_m + 2.0 * std::sqrt(seen.covariance_m2.trace());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const double apart_m = (bodies[i].position_m - seen.position_m).norm();
      if (apart_m < within_m) pairs_.push_back({apart_m, k, i});
    }
  }
  std::sort(pairs_.begin(), pairs_.end());  // the nearest first
  has_legs_.assign(step_.observations.size(), false);
  for (const auto& [apart_m, k, i] : pairs_) {
    if (has_legs_[k] || has_looks_[i]) continue;
    has_legs_[k] = has_looks_[i] = true;
    step_.observations[k].position_m = bodies[i].position_m;
    step_.observations[k].covariance_m2 = bodies[i].covariance_m2;
  }
  for (std::size_t k = 0; k < has_legs_.size(); ++k) {
    Observation& seen = step_.observations[k];
    const Sight sight = has_legs_[k] ? Sight::kUnknown : legs.sightOf(seen.position_m);
    if (sight == Sight::kFree || sight == Sight::kThing) {
      seen.log_person += std::log(kMissedLegs);
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!has_looks_[i]) step_.observations.push_back(bodies[i]);
  }
}

// Where the target's colours are, depth is finer.
void Perception::measureBodies(const Frame& frame) {
  view_.image_bgr = frame.image_bgr;
  view_.depth_m = depth_m_;
  if (sensor_ != SensorKind::kStereo || bodies_.empty()) return;
  boards_.clear();
  for (const WorldBlob& body : bodies_) {
    boards_.push_back(describer_.boardOf(view_, body));
    boards_.push_back(describer_.headOf(view_, body));
  }
  view_.depth_m = coarse_depth_.of(frame, boards_);
  cv::compare(depth_m_, 0.0, has_depth_, cv::CMP_GT);
  depth_m_.copyTo(view_.depth_m, has_depth_);
}

// Whom only the laser found is looked at, too: other clothes than the target's say who it is not.
void Perception::describeBodies(const Frame& frame, const FloorPose& robot) {
  const FloorPose T_base_world = robot.inverse();
  bodies_.clear();
  for (const int blob : step_.blob_of_observation) {
    bodies_.push_back(step_.blobs[static_cast<std::size_t>(blob)]);
  }
  for (std::size_t k = bodies_.size(); k < step_.observations.size(); ++k) {
    bodies_.emplace_back().position_m = T_base_world * step_.observations[k].position_m;
  }
  measureBodies(frame);
  if (looks_.size() < bodies_.size()) looks_.resize(bodies_.size());
  const DepthSight sight(view_.depth_m, camera_.left, T_base_camera_.inverse());
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Observation& seen = step_.observations[k];
    if (frame.image_bgr.empty()) {
      describer_.describe(*step_.cloud, bodies_[k].position_m, looks_[k]);
    } else {
      describer_.describe(view_, bodies_[k], looks_[k]);
      const Eigen::Vector2d& place = bodies_[k].position_m;
      const Eigen::Vector2d ray = place - T_base_camera_.translation().head<2>();
      const Eigen::Vector2d side_m = kBeside_m * Eigen::Vector2d(-ray.y(), ray.x()).normalized();
      seen.log_person += sight.logPerson(place, side_m, std::sqrt(depthCovariance(place).trace()));
      seen.log_person += outline_.logPerson(view_, place);
    }
    if (looks_[k].colors.sum() > 0.0F) seen.look = &looks_[k].colors;
    seen.stature_m = looks_[k].stature_m;
  }
}

// A disparity's error is the same everywhere, so depth's grows with the square of the distance.
Eigen::Matrix2d Perception::depthCovariance(const Eigen::Vector2d& position_m) const {
  if (sensor_ != SensorKind::kStereo) return Eigen::Matrix2d::Zero();
  const Eigen::Vector2d ray = position_m - T_base_camera_.translation().head<2>();
  const double sigma_m = depthErrorOf(camera_) * ray.squaredNorm();
  const Eigen::Vector2d along = ray.normalized() * sigma_m;
  return along * along.transpose();
}

// Silence is what users of trackers complain of most: name the first stage that left nothing.
const char* Perception::whyNotSeen() const {
  if (step_.target.reason == TargetReason::kFrameSkipped) return toText(step_.target.reason);
  if (step_.target.status == TargetStatus::kFollowed) return "";
  if (step_.color_pixels == 0) return "no pixel has the target's colours";
  if (step_.color_points == 0) return "no pixel of the target's colours has a depth";
  if (step_.standing.empty()) return "the target's colours are not at a person's height";
  if (step_.blobs.empty()) return "too few points of the target's colours in one place";
  if (step_.blob_of_observation.empty()) return "no blob is as large and high as a person";
  if (step_.target.reason == TargetReason::kRejectedByGate) return toText(step_.target.verdict);
  return toText(step_.target.reason);
}

}  // namespace heel
