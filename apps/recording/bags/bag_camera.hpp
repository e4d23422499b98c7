// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Which topics of a bag are the robot's camera, laser and odometry.
#pragma once

#include <heel/apps/recording/bags/bag_survey.hpp>
#include <heel/apps/recording/bags/bag_topics.hpp>
#include <heel/apps/recording/recording.hpp>

#include <optional>
#include <string>
#include <vector>

namespace heel {

/// The topics that make up a recording.
struct BagCamera {
  std::vector<std::string> others;  ///< Topics of other cameras, which are not read.
  SensorKind sensor = SensorKind::kStereo;
  const BagTopicSummary* first = nullptr;   ///< Left images, colour images, or clouds.
  const BagTopicSummary* second = nullptr;  ///< Right images or depth images; null for clouds.
};

/// Takes the topics that are named, else looks for them: those of cameras that we know (see the
/// table in bag_camera.cpp), stereo images named left and right, colour and depth images, other
/// pairs (infra1 and infra2, cam0 and cam1), clouds with colours. Of several, rectified ones come
/// first, and those that lose nothing.
/// @throws std::runtime_error  one sentence that tells which topics there are.
BagCamera findBagCamera(const BagSurvey& survey, const BagTopics& topics);

/// The camera_info of an image topic: beside it, or with the same frame; null if there is none.
const CameraInfoMsg* findCameraInfo(const BagSurvey& survey, const BagTopicSummary& images);

/// The same.
/// @throws std::runtime_error  one sentence, if there is none.
const CameraInfoMsg& cameraInfoOf(const BagSurvey& survey, const BagTopicSummary& images);

/// Whether depth images are made to fit colour, as their topic's name tells.
bool isNamedRegistered(const BagTopicSummary& depth);

/// Whether images are rectified, as their topic's name tells.
bool isRectified(const BagTopicSummary& images);

/// The topic of this name, else the only or the best of those with such messages; null if there is
/// none. `best` are words of names, the best first.
/// @throws std::runtime_error  if there is no topic of the name, or it holds other messages.
template <class Message>
const BagTopicSummary* findBagTopic(const BagSurvey& survey, const std::string& name,
                                    const std::vector<std::string>& best = {});

/// The frame of the robot that `frame` stands in firmly: the one that `topics` name, else
/// base_footprint or base_link. Absent if tf knows of none.
/// @throws std::runtime_error  if `topics` name a base frame, and tf does not join it to `frame`.
std::optional<std::string> baseFrameOf(const BagSurvey& survey, const BagTopics& topics,
                                       const std::string& frame);

/// Maps points of `frame` to its base frame, see baseFrameOf().
std::optional<Eigen::Isometry3d> placeOnRobot(const BagSurvey& survey, const BagTopics& topics,
                                              const std::string& frame);

/// Where the camera of images with this frame is on its base frame: as placeOnRobot(), but for a
/// frame that is none of a camera's optics (Z ahead, X to the right) but of its body (X ahead, Z
/// up), as Gazebo's cameras name it: then the camera looks along X (REP 103).
struct ImagePlace {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_frame_camera = Eigen::Isometry3d::Identity();
  bool is_body = false;
};
std::optional<ImagePlace> placeOfImages(const BagSurvey& survey, const BagTopics& topics,
                                        const std::string& frame);

/// "X.bag: there are several ...; what is read is A, not B and 2 more (...)".
/// @param topics  All of them; `read` may be among them.
std::string severalNote(const BagSurvey& survey, const std::string& what, const std::string& read,
                        std::vector<std::string> topics, const std::string& how_to_change);

/// "X.bag has no ...; its topics are ...".
[[noreturn]] void failWithTopics(const BagSurvey& survey, const std::string& what);

template <class Message>
const BagTopicSummary* findBagTopic(const BagSurvey& survey, const std::string& name,
                                    const std::vector<std::string>& best) {
  if (!name.empty()) {
    const BagTopicSummary* named = survey.find(name);
    if (named == nullptr) failWithTopics(survey, "has no messages of the topic '" + name + "'");
    if (!named->topic.template holds<Message>()) {
      failWithTopics(survey, "holds no " + std::string(Message::kType) + " on '" + name + "'");
    }
    return named;
  }
  const BagTopicSummary* found = nullptr;
  std::size_t found_rank = 0;
  for (const BagTopicSummary& summary : survey.topics) {
    if (!summary.topic.template holds<Message>() || summary.count == 0) continue;
    std::size_t rank = 0;
    while (rank < best.size() && summary.topic.name.find(best[rank]) == std::string::npos) ++rank;
    if (found != nullptr && rank >= found_rank) continue;
    found = &summary;
    found_rank = rank;
  }
  return found;
}

}  // namespace heel
