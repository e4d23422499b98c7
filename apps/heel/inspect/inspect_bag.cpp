// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/inspect/inspect.hpp>
#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

/// "2014-09-11 18:22:01 UTC", or seconds if the bag does not count from 1970.
std::string toText(std::int64_t ns) {
  const std::time_t s = ns / 1000000000;
  char text[64];
  constexpr std::time_t kYear2000 = 946684800;
  std::tm parts{};
  if (s > kYear2000 && gmtime_r(&s, &parts) != nullptr) {
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &parts);
  } else {
    std::snprintf(text, sizeof text, "%.1f s", secondsOf(ns));
  }
  return text;
}

std::string detailsOf(const BagTopicSummary& t) {
  std::string text;
  if (!t.is_known) text = ", not read by heel";
  if (t.topic.holds<PointCloud2Msg>() && t.height > 1) {
    text += ", " + std::to_string(t.width) + "x" + std::to_string(t.height) + " points";
  } else if (t.topic.holds<PointCloud2Msg>()) {
    text += ", " + std::to_string(t.width) + " points";
  } else if (t.width > 0) {
    text += ", " + std::to_string(t.width) + "x" + std::to_string(t.height);
  }
  if (!t.encoding.empty()) text += " " + t.encoding;
  if (!t.frame_id.empty()) text += ", frame " + t.frame_id;
  if (t.broken > 0) text += ", " + std::to_string(t.broken) + " broken";
  return text;
}

void printTopics(const BagSurvey& survey) {
  std::size_t name = 0, type = 0;
  for (const BagTopicSummary& t : survey.topics) {
    name = std::max(name, t.topic.name.size());
    type = std::max(type, t.topic.type.size());
  }
  for (const BagTopicSummary& t : survey.topics) {
    std::printf("  %-*s  %-*s %7zu", static_cast<int>(name), t.topic.name.c_str(),
                static_cast<int>(type), t.topic.type.c_str(), t.count);
    if (t.rate_hz() > 0.0) std::printf("  %6.1f s at %.1f Hz", t.duration_s(), t.rate_hz());
    std::printf("%s\n", detailsOf(t).c_str());
  }
}

void printFrames(const BagSurvey& survey) {
  for (const auto& [child, link] : survey.frames) {
    const Eigen::Vector3d at = link.T_parent_child.translation();
    std::printf("  frame %s in %s", child.c_str(), link.parent.c_str());
    if (link.moves) {
      std::printf(", moving\n");
    } else {
      std::printf(" at (%.3f, %.3f, %.3f) m\n", at.x(), at.y(), at.z());
    }
  }
}

bool namesCamera(const BagTopics& t) {
  return !(t.left + t.right + t.color + t.depth + t.cloud).empty();
}

}  // namespace

bool inspectBag(const std::filesystem::path& path, const RecordingParams& opening) {
  const BagTopics& topics = opening.topics;
  const BagSurvey survey = surveyBag(path, opening.span);
  std::printf(
      "%s: ROS %d bag, %zu messages on %zu topic%s over %.1f s, from %s\n",
      std::filesystem::canonical(path).filename().c_str(), survey.form == BagForm::kRos1 ? 1 : 2,
      survey.messages, survey.topics.size(), survey.topics.size() == 1 ? "" : "s",
      secondsOf(survey.last_ns) - secondsOf(survey.first_ns), toText(survey.first_ns).c_str());
  printTopics(survey);
  printFrames(survey);
  bool has_camera = true;
  try {
    findBagCamera(survey, topics);
  } catch (const std::runtime_error&) {
    if (namesCamera(topics)) throw;
    has_camera = false;
  }
  // With a camera, its setup says so among its warnings.
  if (!has_camera && !survey.lost.empty()) warn(survey.lost);
  return has_camera;
}

}  // namespace heel
