// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_camera.hpp>
#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/cloud/ground_plane.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

using Words = std::pair<const char*, const char*>;

bool has(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

/// What image_transport adds to an image's name.
constexpr std::array kTransportEnds = {"/compressedDepth", "/compressed"};

/// A topic's name without that.
std::string plainName(std::string name) {
  for (const std::string end : kTransportEnds) {
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) {
      name.resize(name.size() - end.size());
    }
  }
  return name;
}

bool isImage(const BagTopicSummary& t) {
  return t.count > 0 && (t.topic.holds<ImageMsg>() || t.topic.holds<CompressedImageMsg>());
}

bool saysDepth(const BagTopicSummary& t) {
  return has(t.topic.name, "depth") || has(t.topic.name, "Depth");
}

/// Whether images are of what is neither depth nor colour, as a part of their topic's name tells.
bool isNamedOther(const BagTopicSummary& t) {
  static const std::regex kOther(
      "(^|[^a-zA-Z])([iI][rR]([^a-zA-Z]|$)|[iI]nfra|[tT]hermal|[cC]onfidence|[aA]mplitude)");
  return std::regex_search(t.topic.name, kOther);
}

bool isDepthImage(const BagTopicSummary& t) {
  const bool has_16_bits = t.encoding == "mono16" || t.encoding.rfind("mono16; png", 0) == 0;
  return isImage(t) && (isDepthEncoding(t.encoding) || (has_16_bits && saysDepth(t)));
}

bool isColorImage(const BagTopicSummary& t) {
  // Depth that was made a JPEG, to look at, is neither.
  return isImage(t) && !isDepthImage(t) && !has(t.topic.name, "depth/");
}

/// The lower the better.
int rankOf(const BagTopicSummary& t) {
  const std::string name = plainName(t.topic.name);
  const std::array kinds = {"image_rect_color", "image_rect", "image_color", "image_raw", "image"};
  int rank = 0;
  while (rank < 5 && !has(name, kinds[static_cast<std::size_t>(rank)])) ++rank;
  return 2 * rank + (t.topic.holds<CompressedImageMsg>() ? 1 : 0);
}

int depthRankOf(const BagTopicSummary& t) {
  return rankOf(t) + (isNamedRegistered(t) ? 0 : 100) + (saysDepth(t) ? 0 : 200) +
         (isNamedOther(t) ? 400 : 0);
}

template <class Is, class Rank>
const BagTopicSummary* best(const BagSurvey& survey, const Is& is, const Rank& rank) {
  const BagTopicSummary* found = nullptr;
  for (const BagTopicSummary& t : survey.topics) {
    if (is(t) && (found == nullptr || rank(t) < rank(*found))) found = &t;
  }
  return found;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The best pair whose names differ by these words.
std::optional<BagCamera> findPair(const BagSurvey& survey, const Words& words) {
  BagCamera found;
  for (const BagTopicSummary& left : survey.topics) {
    if (!isColorImage(left) || !has(left.topic.name, words.first)) continue;
    const auto* right = survey.find(replaced(left.topic.name, words.first, words.second));
    if (right == nullptr || !isColorImage(*right)) continue;
    if (found.first == nullptr || rankOf(left) < rankOf(*found.first)) {
      found.first = &left;
      found.second = right;
    }
  }
  if (found.first == nullptr) return std::nullopt;
  return found;
}

std::optional<BagCamera> findRgbd(const BagSurvey& survey) {
  BagCamera found;
  found.sensor = SensorKind::kRgbd;
  const auto is_depth = [](const BagTopicSummary& t) {
    return isDepthImage(t) && (saysDepth(t) || !isNamedOther(t));
  };
  found.second = best(survey, is_depth, depthRankOf);
  if (found.second == nullptr) return std::nullopt;
  const auto is_color = [](const BagTopicSummary& t) {
    return isColorImage(t) && !isNamedOther(t);
  };
  // Depth has the colour camera's size where it was made to fit it.
  const auto fits = [&](const BagTopicSummary& t) {
    return is_color(t) && t.width == found.second->width && t.height == found.second->height;
  };
  found.first = best(survey, fits, rankOf);
  if (found.first == nullptr) found.first = best(survey, is_color, rankOf);
  if (found.first == nullptr) return std::nullopt;
  return found;
}

/// The topics of cameras that are known, by how their names end.
struct KnownCamera {
  SensorKind sensor;
  const char* first;   ///< Left or colour.
  const char* second;  ///< Right or depth.
};
constexpr KnownCamera kKnownCameras[] = {
    // ZED
    {SensorKind::kStereo, "/left/image_rect_color", "/right/image_rect_color"},
    {SensorKind::kRgbd, "/rgb/image_rect_color", "/depth/depth_registered"},
    // RealSense; its viewer
    {SensorKind::kRgbd, "/color/image_raw", "/aligned_depth_to_color/image_raw"},
    {SensorKind::kRgbd, "/color/image_raw", "/depth/image_rect_raw"},
    {SensorKind::kRgbd, "/sensor_1/Color_0/image/data", "/sensor_0/Depth_0/image/data"},
    // Kinect Azure, registered; OAK; Kinect Azure, not registered; Orbbec
    {SensorKind::kRgbd, "/rgb/image_raw", "/depth_to_rgb/image_raw"},
    {SensorKind::kRgbd, "/rgb/image_raw", "/stereo/image_raw"},
    {SensorKind::kRgbd, "/rgb/image_raw", "/depth/image_raw"},
    {SensorKind::kRgbd, "/color/image_raw", "/depth/image_raw"},
};

/// What a topic is called before `end`, if it ends so; raw or compressed.
std::optional<std::string> nameBefore(const BagTopicSummary& t, const std::string& end) {
  const std::string name = plainName(t.topic.name);
  if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0) {
    return std::nullopt;
  }
  return name.substr(0, name.size() - end.size());
}

std::optional<BagCamera> findKnown(const BagSurvey& survey) {
  for (const KnownCamera& known : kKnownCameras) {
    const auto is_second = known.sensor == SensorKind::kRgbd ? isDepthImage : isColorImage;
    for (const BagTopicSummary& first : survey.topics) {
      const auto camera = nameBefore(first, known.first);
      if (!camera || !isColorImage(first)) continue;
      const auto fits = [&](const BagTopicSummary& t) {
        return is_second(t) && nameBefore(t, known.second) == camera;
      };
      const BagTopicSummary* second = best(survey, fits, rankOf);
      const auto fits_better = [&](const BagTopicSummary& t) {
        return isDepthImage(t) && isNamedRegistered(t) && t.topic.name.rfind(*camera, 0) == 0;
      };
      if (known.sensor == SensorKind::kRgbd && second != nullptr && !isNamedRegistered(*second) &&
          std::any_of(survey.topics.begin(), survey.topics.end(), fits_better)) {
        continue;
      }
      const auto same = [&](const BagTopicSummary& t) {
        return isColorImage(t) && nameBefore(t, known.first) == camera;
      };
      if (second != nullptr) return BagCamera{{}, known.sensor, best(survey, same, rankOf), second};
    }
  }
  return std::nullopt;
}

/// What the names of a camera's topics begin with, up to the last '/' that they share.
std::string commonName(const BagCamera& camera) {
  const std::string& a = camera.first->topic.name;
  const std::string& b = camera.second != nullptr ? camera.second->topic.name : a;
  const auto end = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  const std::string shared(a.begin(), end);
  return shared.substr(0, shared.rfind('/') + 1);
}

bool isColoredCloud(const BagTopicSummary& t) {
  return t.count > 0 && t.topic.holds<PointCloud2Msg>() && has(t.encoding, "rgb");
}

/// Images and coloured clouds whose names are not of this camera, where its name tells it apart.
void addOthers(const BagSurvey& survey, BagCamera& camera) {
  const std::string own = commonName(camera);
  if (own.size() < 2) return;
  for (const BagTopicSummary& t : survey.topics) {
    if ((isImage(t) || isColoredCloud(t)) && t.topic.name.rfind(own, 0) != 0) {
      camera.others.push_back(t.topic.name);
    }
  }
}

const BagTopicSummary* named(const BagSurvey& survey, const std::string& name,
                             bool (*is)(const BagTopicSummary&), const char* what) {
  const BagTopicSummary* topic = survey.find(name);
  for (const char* end : kTransportEnds) {
    if (topic == nullptr) topic = survey.find(name + end);
  }
  if (topic == nullptr) failWithTopics(survey, "has no messages of the topic '" + name + "'");
  if (!is(*topic)) failWithTopics(survey, std::string("holds no ") + what + " on '" + name + "'");
  return topic;
}

/// The topics that the options name; nothing if they name none.
std::optional<BagCamera> namedCamera(const BagSurvey& survey, const BagTopics& topics) {
  const auto both = [&](const std::string& a, const std::string& b, const char* what) {
    if (a.empty() != b.empty()) {
      failWithTopics(survey, std::string("needs both topics named, of the ") + what);
    }
    return !a.empty();
  };
  BagCamera camera;
  if (both(topics.left, topics.right, "left and the right images")) {
    camera.first = named(survey, topics.left, isImage, "images");
    camera.second = named(survey, topics.right, isImage, "images");
    return camera;
  }
  if (both(topics.color, topics.depth, "colour and the depth images")) {
    camera.sensor = SensorKind::kRgbd;
    camera.first = named(survey, topics.color, isImage, "images");
    camera.second = named(survey, topics.depth, isDepthImage, "depth images (16UC1, 32FC1)");
    return camera;
  }
  if (topics.cloud.empty()) return std::nullopt;
  camera.sensor = SensorKind::kCloud;
  camera.first = named(survey, topics.cloud, isColoredCloud, "clouds with colours (a field rgb)");
  return camera;
}

}  // namespace

std::string severalNote(const BagSurvey& survey, const std::string& what, const std::string& read,
                        std::vector<std::string> topics, const std::string& how_to_change) {
  topics.erase(std::remove(topics.begin(), topics.end(), read), topics.end());
  std::string text = survey.path.string() + ": there are several " + what + "; what is read is " +
                     read + ", not " + topics.at(0);
  if (topics.size() > 1) text += " and " + std::to_string(topics.size() - 1) + " more";
  return text + " (" + how_to_change + ")";
}

void failWithTopics(const BagSurvey& survey, const std::string& what) {
  throw std::runtime_error(survey.path.string() + " " + what + "; its topics are " +
                           survey.topicNames());
}

namespace {

BagCamera findAnyCamera(const BagSurvey& survey) {
  if (const auto camera = findKnown(survey)) return *camera;
  if (const auto camera = findPair(survey, {"left", "right"})) return *camera;
  if (const auto camera = findRgbd(survey)) return *camera;
  for (const Words& words : {Words("infra1", "infra2"), Words("cam0", "cam1"),
                             Words("image_0", "image_1"), Words("camera0", "camera1")}) {
    if (const auto camera = findPair(survey, words)) return *camera;
  }
  BagCamera clouds;
  clouds.sensor = SensorKind::kCloud;
  clouds.first = best(survey, isColoredCloud, [](const BagTopicSummary& t) {
    return t.height > 1 ? 0 : 1;  // organized ones have a picture, too
  });
  if (clouds.first != nullptr) return clouds;
  failWithTopics(survey,
                 "has no stereo images, no colour with depth images, and no coloured clouds");
}

}  // namespace

BagCamera findBagCamera(const BagSurvey& survey, const BagTopics& topics) {
  if (const auto camera = namedCamera(survey, topics)) return *camera;
  BagCamera camera = findAnyCamera(survey);
  addOthers(survey, camera);
  return camera;
}

bool isNamedRegistered(const BagTopicSummary& depth) {
  const auto says = [&](const char* word) { return has(depth.topic.name, word); };
  return says("aligned") || says("registered") || says("depth_to_rgb");
}

bool isRectified(const BagTopicSummary& images) { return has(images.topic.name, "rect"); }

const CameraInfoMsg* findCameraInfo(const BagSurvey& survey, const BagTopicSummary& images) {
  const std::string name = plainName(images.topic.name);
  const std::string folder = name.substr(0, name.rfind('/'));
  // The RealSense viewer has images and infos in folders of their own.
  for (const std::string& beside :
       {folder + "/camera_info", folder.substr(0, folder.rfind('/')) + "/info/camera_info"}) {
    const auto info = survey.camera_infos.find(beside);
    if (info != survey.camera_infos.end()) return &info->second;
  }
  for (const auto& [topic, info] : survey.camera_infos) {
    if (frameName(info.header.frame_id) == images.frame_id) return &info;
  }
  return nullptr;
}

const CameraInfoMsg& cameraInfoOf(const BagSurvey& survey, const BagTopicSummary& images) {
  if (const CameraInfoMsg* info = findCameraInfo(survey, images)) return *info;
  failWithTopics(survey, "has no camera_info of the images on '" + images.topic.name +
                             "' (record it with them, or read the images as a folder with a "
                             "camera.yaml or a stereo calibration)");
}

std::optional<std::string> baseFrameOf(const BagSurvey& survey, const BagTopics& topics,
                                       const std::string& frame) {
  if (!topics.base_frame.empty()) {
    if (survey.transform(frameName(topics.base_frame), frame)) return frameName(topics.base_frame);
    std::set<std::string> bases;
    for (const auto& [child, link] : survey.frames) {
      if (survey.transform(link.parent, frame)) bases.insert("'" + link.parent + "'");
    }
    std::string known;
    for (const std::string& base : bases) known += (known.empty() ? "; it is on " : ", ") + base;
    throw std::runtime_error(survey.path.string() + ": tf does not tell where '" + frame +
                             "' is on '" + topics.base_frame + "'" + known);
  }
  for (const char* base : {"base_footprint", "base_link"}) {
    if (survey.transform(base, frame)) return base;
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> placeOnRobot(const BagSurvey& survey, const BagTopics& topics,
                                              const std::string& frame) {
  const auto base = baseFrameOf(survey, topics, frame);
  return base ? survey.transform(*base, frame) : std::nullopt;
}

std::optional<ImagePlace> placeOfImages(const BagSurvey& survey, const BagTopics& topics,
                                        const std::string& frame) {
  const auto T = placeOnRobot(survey, topics, frame);
  if (!T) return std::nullopt;
  // No camera's optics are so: its Z would look at the ceiling.
  constexpr double kMost_rad = M_PI / 6.0;
  ImagePlace place;
  place.is_body = (*T)(2, 2) > std::cos(kMost_rad) && std::abs((*T)(2, 0)) < std::sin(kMost_rad);
  if (place.is_body) place.T_frame_camera = baseFromCamera(Mounting());
  place.T_base_camera = place.is_body ? *T * place.T_frame_camera : *T;
  return place;
}

}  // namespace heel
