// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_odometry.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>

namespace heel {
namespace {

constexpr std::size_t kMostPoses = 200;  // seconds of odometry
constexpr double kOtherClock_s = 1.0;    // What is so much older than all of it has another clock.

bool tellsTruth(const BagTopicSummary& t) {
  return t.topic.name.find("truth") != std::string::npos;
}

/// The base frame that tf moves, if any.
std::string movingBase(const BagSurvey& survey, const BagTopics& topics) {
  for (const std::string& base :
       {frameName(topics.base_frame), std::string("base_footprint"), std::string("base_link")}) {
    const auto link = survey.frames.find(base);
    if (link != survey.frames.end() && link->second.moves) return base;
  }
  return {};
}

/// Topics of what tells the truth, or of what does not.
std::vector<const BagTopicSummary*> allPoses(const BagSurvey& survey, bool of_truth) {
  std::vector<const BagTopicSummary*> all;
  for (const BagTopicSummary& t : survey.topics) {
    if (t.topic.holds<OdometryMsg>() && t.count > 0 && tellsTruth(t) == of_truth) {
      all.push_back(&t);
    }
  }
  return all;
}

/// The lower the better. Pictures and satellites lose their way now and then, and jump.
int odometryRank(const std::string& name) {
  static const std::regex kLast("gps|visual|camera|rtabmap|(/|_)vo(/|_|$)");
  static const std::regex kOdom("/odom$"), kFiltered("odometry/filtered$");
  if (std::regex_search(name, kLast)) return 4;
  if (name == "/odom") return 0;
  if (std::regex_search(name, kOdom)) return 1;
  return std::regex_search(name, kFiltered) ? 2 : 3;
}

const BagTopicSummary* findTruth(const BagSurvey& survey, const std::string& name) {
  if (!name.empty()) return findBagTopic<OdometryMsg>(survey, name);
  const auto all = allPoses(survey, true);
  return all.empty() ? nullptr : all.front();
}

}  // namespace

const BagTopicSummary* findOdometry(const BagSurvey& survey, const BagTopics& topics) {
  if (!topics.odometry.empty()) return findBagTopic<OdometryMsg>(survey, topics.odometry);
  const auto all = allPoses(survey, false);
  const auto best = std::min_element(all.begin(), all.end(), [](const auto* a, const auto* b) {
    return odometryRank(a->topic.name) < odometryRank(b->topic.name);
  });
  return best == all.end() ? nullptr : *best;
}

std::string severalOdometries(const BagSurvey& survey, const BagTopics& topics) {
  if (!topics.odometry.empty()) return {};
  std::vector<std::string> names;
  for (const BagTopicSummary* t : allPoses(survey, false)) names.push_back(t->topic.name);
  if (names.size() < 2) return {};
  return severalNote(survey, "topics of odometry", findOdometry(survey, topics)->topic.name, names,
                     "--odometry-topic reads another");
}

BagPoses::BagPoses(const BagSurvey& survey, const BagTopics& topics) {
  const BagTopicSummary* odometry = findOdometry(survey, topics);
  const BagTopicSummary* truth = findTruth(survey, topics.truth);
  if (odometry != nullptr) odometry_topic_ = odometry->topic.name;
  if (truth != nullptr) truth_topic_ = truth->topic.name;
  if (odometry == nullptr) odometry_frame_ = movingBase(survey, topics);
}

void BagPoses::add(Poses& poses, const StampedPose& pose) {
  if (!pose.pose.position.allFinite() || !std::isfinite(pose.pose.yaw_rad)) return;
  poses.push_back(pose);
  if (poses.size() > kMostPoses) poses.pop_front();
}

std::optional<FloorPose> BagPoses::at(const Poses& poses, double stamp_s) {
  if (poses.empty()) return std::nullopt;
  const auto latest = std::find_if(poses.rbegin(), poses.rend(), [&](const StampedPose& p) {
    return p.stamp_s <= stamp_s + 1e-6;
  });
  if (latest != poses.rend()) return latest->pose;
  const bool is_other_clock = stamp_s < poses.front().stamp_s - kOtherClock_s;
  return is_other_clock ? poses.back().pose : poses.front().pose;
}

void BagPoses::takeOdometry(const BagReader& bag, const BagMessage& raw, Poses& poses) {
  bag.read(raw, message_);
  add(poses, {secondsOf(message_.header.stamp.ns), floorPoseOf(message_.pose.pose)});
}

void BagPoses::take(const BagReader& bag, const BagMessage& raw) {
  const BagTopic& topic = bag.topics()[raw.topic];
  try {
    if (topic.name == odometry_topic_) {
      takeOdometry(bag, raw, odometry_);
      parent_frame_ = frameName(message_.header.frame_id);
    } else if (topic.name == truth_topic_) {
      takeOdometry(bag, raw, truth_);
    } else if (!odometry_frame_.empty() && topic.holds<TFMessageMsg>()) {
      bag.read(raw, transforms_);
      for (const TransformStampedMsg& t : transforms_.transforms) {
        if (frameName(t.child_frame_id) != odometry_frame_) continue;
        PoseMsg pose;
        setPoint(pose.position, {t.transform.translation.x, t.transform.translation.y, 0.0});
        pose.orientation = t.transform.rotation;
        parent_frame_ = frameName(t.header.frame_id);
        add(odometry_, {secondsOf(t.header.stamp.ns), floorPoseOf(pose)});
      }
    }
  } catch (const std::runtime_error&) {
    // One pose fewer; the others go on.
  }
}

std::vector<std::string> BagPoses::topics() const {
  std::vector<std::string> names;
  for (const std::string& name : {odometry_topic_, truth_topic_}) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

std::vector<StampedPose> readBagPoses(const std::filesystem::path& path, const BagTopics& topics) {
  const BagSurvey survey = surveyBag(path);
  BagPoses poses(survey, topics);
  if (!poses.hasTruth() && !poses.hasOdometry()) {
    failWithTopics(survey, "does not tell where the robot was (no Odometry, no tf that moves it)");
  }
  const auto bag = openBag(path);
  bag->select(survey.queryOf(poses.topics(), true));
  std::vector<StampedPose> all;
  BagMessage raw;
  while (bag->next(raw)) {
    poses.take(*bag, raw);
    const StampedPose* last = poses.hasTruth() ? poses.lastTruth() : poses.lastOdometry();
    if (last != nullptr && (all.empty() || all.back().stamp_s != last->stamp_s)) {
      all.push_back(*last);
    }
  }
  return all;
}

}  // namespace heel
