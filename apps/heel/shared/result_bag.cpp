// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/result_bag.hpp>
#include <heel/apps/recording/bags/bag_map.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {
namespace {

constexpr const char* kTracksTopic = "/heel/tracks";
constexpr const char* kMarkersTopic = "/heel/markers";
constexpr const char* kTargetTopic = "/heel/target";
constexpr const char* kPathTopic = "/heel/path";
constexpr const char* kImageTopic = "/heel/image/compressed";
constexpr double kBody_m = 0.45, kStature_m = 1.7;  // of the cylinders

/// Where someone is, facing where they go.
PoseMsg poseOf(const MotionState& motion) {
  const Eigen::Vector2d velocity = motion.velocity_mps();
  return toPoseMsg(FloorPose{motion.position_m(), std::atan2(velocity.y(), velocity.x())});
}

MarkerMsg body(const HeaderMsg& header, const Track& track, bool is_target) {
  MarkerMsg marker;
  marker.header = header;
  marker.ns = "people";
  marker.id = track.id;
  marker.type = MarkerMsg::kCylinder;
  marker.pose = poseOf(track.motion);
  marker.pose.position.z = kStature_m / 2.0;
  setPoint(marker.scale, {kBody_m, kBody_m, kStature_m});
  marker.color =
      is_target ? ColorRGBAMsg{0.1F, 0.7F, 0.2F, 0.7F} : ColorRGBAMsg{0.5F, 0.5F, 0.5F, 0.6F};
  return marker;
}

MarkerMsg label(MarkerMsg marker, const Track& track, bool is_target) {
  marker.ns = "names";
  marker.type = MarkerMsg::kText;
  marker.pose.position.z = kStature_m + 0.2;
  setPoint(marker.scale, {0.0, 0.0, 0.2});
  marker.color.a = 1.0F;
  marker.text = (is_target ? "target " : "") + std::to_string(track.id);
  return marker;
}

}  // namespace

ResultBag::ResultBag(const BagPlan& plan, std::string frame)
    : path_(plan.path), frame_(std::move(frame)), bag_(createBag(plan)) {}

ResultBag::ResultBag(std::unique_ptr<BagWriter> network, std::string frame)
    : frame_(std::move(frame)), bag_(std::move(network)) {
  bag_->announce<PoseArrayMsg>(kTracksTopic);
  bag_->announce<MarkerArrayMsg>(kMarkersTopic);
  bag_->announce<PoseStampedMsg>(kTargetTopic);
  bag_->announce<PathMsg>(kPathTopic);
  bag_->announce<CompressedImageMsg>(kImageTopic);
}

bool ResultBag::isImageWatched() const { return bag_->isHeard(kImageTopic); }

HeaderMsg ResultBag::header(double stamp_s) const {
  HeaderMsg result;
  result.stamp.ns = nanosecondsOf(stamp_s);
  result.frame_id = frame_;
  return result;
}

void ResultBag::addRobot(double stamp_s, const FloorPose& pose) {
  TFMessageMsg message;
  message.transforms.push_back(toTransform(toPoseMsg(pose), header(stamp_s), "base_footprint"));
  bag_->write("/tf", nanosecondsOf(stamp_s), message);
}

void ResultBag::addTracks(double stamp_s, const std::vector<Track>& tracks,
                          const TargetEstimate& target) {
  PoseArrayMsg poses;
  poses.header = header(stamp_s);
  MarkerArrayMsg markers;
  MarkerMsg& clear = markers.markers.emplace_back();
  clear.header = poses.header;
  clear.action = MarkerMsg::kDeleteAll;
  for (const Track& track : tracks) {
    if (track.status == TrackStatus::kTentative) continue;
    const bool is_target = track.id == target.track_id;
    poses.poses.push_back(poseOf(track.motion));
    markers.markers.push_back(body(poses.header, track, is_target));
    markers.markers.push_back(label(markers.markers.back(), track, is_target));
  }
  const std::int64_t ns = poses.header.stamp.ns;
  bag_->write(kTracksTopic, ns, poses);
  bag_->write(kMarkersTopic, ns, markers);
  if (target.hasPlace()) {
    bag_->write(kTargetTopic, ns, PoseStampedMsg{poses.header, poseOf(target.motion)});
  }
}

void ResultBag::addPath(double stamp_s, const FloorPath& path) {
  PathMsg message;
  message.header = header(stamp_s);
  for (const Eigen::Vector2d& point : path) {
    message.poses.push_back({message.header, toPoseMsg(FloorPose{point, 0.0})});
  }
  bag_->write(kPathTopic, message.header.stamp.ns, message);
}

void ResultBag::addMap(double stamp_s, const OccupancyGrid& map) {
  OccupancyGridMsg message = toMessage(map);
  message.header = header(stamp_s);
  message.info.map_load_time = message.header.stamp;
  bag_->write("/map", message.header.stamp.ns, message, true);
}

void ResultBag::addImage(double stamp_s, const cv::Mat& image_bgr) {
  CompressedImageMsg message;
  message.header = header(stamp_s);
  message.format = "bgr8; jpeg compressed bgr8";
  if (!cv::imencode(".jpg", image_bgr, message.data)) {
    throw std::runtime_error(path_.string() + ": a picture can't be encoded");
  }
  bag_->write(kImageTopic, message.header.stamp.ns, message);
}

}  // namespace heel
