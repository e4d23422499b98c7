// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_motion.hpp>
#include <heel/apps/recording/bags/bag_odometry.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace heel {

BagMotion::BagMotion(const BagSurvey& survey, const BagTopics& topics,
                     const std::string& camera_frame)
    : path_(survey.path), frames_(survey.frames) {
  constexpr double kAround_s = 2.0;  // poses before and after the first and the last frame
  const auto base = baseFrameOf(survey, topics, camera_frame);
  addOdometry(survey, topics);
  query_ = survey.queryOf({}, true, kAround_s);
  if (!odometry_topic_.empty()) query_.topics.push_back(odometry_topic_);
  motion_.of_camera = !base;
  if (!odometry_topic_.empty()) motion_.warning = severalOdometries(survey, topics);
  if (findWay(base.value_or(camera_frame), topics)) return;
  // Something moves, but tf does not join the camera to it.
  motion_.of_camera = false;
  for (const std::string& frame :
       {odometry_frame_, std::string("base_footprint"), std::string("base_link")}) {
    if (!findWay(frame, topics)) continue;
    motion_.warning = path_.string() + ": tf does not tell where the camera is on '" + frame +
                      "', which moves; it is taken to be above its origin and to look ahead";
    return;
  }
}

/// Odometry messages are a link of the tree: from their child frame, or from what it stands in
/// firmly.
void BagMotion::addOdometry(const BagSurvey& survey, const BagTopics& topics) {
  const BagTopicSummary* odometry = findOdometry(survey, topics);
  if (odometry == nullptr) return;
  odometry_world_ = odometry->frame_id.empty() ? "odom" : odometry->frame_id;
  const std::string child =
      odometry->child_frame_id.empty() ? "base_link" : odometry->child_frame_id;
  odometry_frame_ = child;
  auto link = frames_.find(child);
  for (std::size_t steps = 0; steps < frames_.size() && link != frames_.end(); ++steps) {
    if (link->second.moves || link->second.parent == odometry_world_) break;
    odometry_frame_ = link->second.parent;
    link = frames_.find(odometry_frame_);
  }
  // Of two that tell of a motion tf is taken: it does so for all of its frames in the same way.
  if (link != frames_.end() && link->second.moves && topics.odometry.empty()) return;
  if (const auto T = survey.transform(odometry_frame_, child)) T_child_frame_ = T->inverse();
  odometry_topic_ = odometry->topic.name;
  frames_[odometry_frame_] = {odometry_world_, Eigen::Isometry3d::Identity(), true};
}

bool BagMotion::findWay(const std::string& from, const BagTopics& topics) {
  way_.clear();
  std::string at = frameName(from);
  std::set<std::string> met;
  for (auto link = frames_.find(at); link != frames_.end() && met.insert(at).second;
       link = frames_.find(at)) {
    const BagSurvey::Link& up = link->second;
    way_.push_back({at, up.parent, std::nullopt});
    if (!up.moves) way_.back().T_parent_frame = up.T_parent_child;
    at = up.parent;
  }
  motion_.frame_id = worldFrame(topics);
  const auto top = std::find_if(way_.begin(), way_.end(),
                                [&](const Link& link) { return link.parent == motion_.frame_id; });
  if (motion_.frame_id.empty() || top == way_.end()) {
    way_.clear();
    return false;
  }
  way_.erase(top + 1, way_.end());
  return true;
}

/// The frame in which the way is told; empty if nothing on the way moves.
std::string BagMotion::worldFrame(const BagTopics& topics) const {
  if (!topics.world_frame.empty()) return frameName(topics.world_frame);
  const auto first_moving = std::find_if(
      way_.begin(), way_.end(), [](const Link& link) { return !link.T_parent_frame.has_value(); });
  const auto leads_to = [&](const std::string& frame) {
    return std::any_of(first_moving, way_.end(),
                       [&](const Link& link) { return link.parent == frame; });
  };
  std::vector<std::string> names = {odometry_world_, "odom"};
  const std::array bases = {frameName(topics.base_frame), std::string("base_footprint"),
                            std::string("base_link")};
  for (const std::string& base : bases) {
    const auto link = frames_.find(base);
    if (link != frames_.end() && link->second.moves) names.push_back(link->second.parent);
  }
  names.insert(names.end(), bases.begin(), bases.end());  // a camera that turns on a robot
  for (const std::string& name : names) {
    if (!name.empty() && leads_to(name)) return name;
  }
  return {};
}

std::map<std::string, Trajectory> BagMotion::readLinks() const {
  std::map<std::string, Trajectory> moving;
  std::map<std::string, std::string> parents;
  for (const Link& link : way_) {
    if (link.T_parent_frame) continue;
    moving[link.frame];
    parents[link.frame] = link.parent;
  }
  const bool by_odometry = !odometry_topic_.empty() && moving.count(odometry_frame_) > 0;
  const auto bag = openBag(path_);
  bag->select(query_);
  BagMessage raw;
  OdometryMsg odometry;
  TFMessageMsg transforms;
  const auto stampOf = [&raw](const HeaderMsg& header) {
    return secondsOf(header.stamp.ns != 0 ? header.stamp.ns : raw.stamp_ns);
  };
  while (bag->next(raw)) {
    const BagTopic& topic = bag->topics()[raw.topic];
    try {
      if (by_odometry && topic.name == odometry_topic_) {
        bag->read(raw, odometry);
        const PoseMsg& pose = odometry.pose.pose;
        moving[odometry_frame_].add(stampOf(odometry.header),
                                    poseOf(pose.position, pose.orientation) * T_child_frame_);
      } else if (topic.holds<TFMessageMsg>()) {
        bag->read(raw, transforms);
        for (const TransformStampedMsg& t : transforms.transforms) {
          const std::string frame = frameName(t.child_frame_id);
          const auto link = parents.find(frame);
          if (link == parents.end() || link->second != frameName(t.header.frame_id)) continue;
          if (by_odometry && frame == odometry_frame_) continue;
          PointMsg place;
          setPoint(place, {t.transform.translation.x, t.transform.translation.y,
                           t.transform.translation.z});
          moving[frame].add(stampOf(t.header), poseOf(place, t.transform.rotation));
        }
      }
    } catch (const std::runtime_error&) {
      // One pose fewer; the others go on.
    }
  }
  return moving;
}

std::optional<RobotMotion> BagMotion::read() const {
  if (way_.empty()) return std::nullopt;
  const auto moving = readLinks();
  std::set<double> stamps_s;
  for (const auto& [frame, poses] : moving) {
    for (const double stamp_s : poses.stamps_s()) stamps_s.insert(stamp_s);
  }
  RobotMotion motion = motion_;
  if (moving.empty()) {
    constexpr double kAlways = std::numeric_limits<double>::infinity();
    motion.poses = Trajectory({kAlways, kAlways});
    stamps_s.insert(0.0);
  }
  for (const double stamp_s : stamps_s) {
    std::optional<Eigen::Isometry3d> T;
    for (const Link& link : way_) {
      const auto step =
          link.T_parent_frame ? link.T_parent_frame : moving.at(link.frame).at(stamp_s);
      if (!step) {
        T.reset();
        break;
      }
      T = T ? *step * *T : *step;  // the first as it is, to its last digit
    }
    if (T) motion.poses.add(stamp_s, *T);
  }
  if (motion.poses.empty()) return std::nullopt;
  return motion;
}

}  // namespace heel
