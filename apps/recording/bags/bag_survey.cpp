// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/recording/bags/bag_survey.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

/// The beginning of an Image, without its pixels.
struct ImageHead {
  HeaderMsg header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("height", m.height);
    a("width", m.width);
    a("encoding", m.encoding);
  }
};

/// The beginning of a CompressedImage.
struct CompressedHead {
  HeaderMsg header;
  std::string format;

  template <class Self, class Archive>
  static void fields(Self& m, Archive& a) {
    a("header", m.header);
    a("format", m.format);
  }
};

class Surveyor {
 public:
  Surveyor(const BagReader& reader, BagSurvey& survey) : reader_(reader), survey_(survey) {}

  void add(const BagMessage& raw) {
    for (std::size_t i = survey_.topics.size(); i < reader_.topics().size(); ++i) addTopic();
    BagTopicSummary& topic = survey_.topics[raw.topic];
    ++topic.count;
    if (survey_.messages++ == 0) survey_.first_ns = survey_.last_ns = raw.stamp_ns;
    survey_.first_ns = std::min(survey_.first_ns, raw.stamp_ns);
    survey_.last_ns = std::max(survey_.last_ns, raw.stamp_ns);
    recorded_[raw.topic].add(raw.stamp_ns, isFrame(topic));
    if (!topic.is_known) return;
    try {
      look(raw, topic);
    } catch (const std::runtime_error&) {
      ++topic.broken;
    }
  }

  /// Also lists the topics of which there is no message.
  void finish() {
    while (survey_.topics.size() < reader_.topics().size()) addTopic();
    for (std::size_t i = 0; i < survey_.topics.size(); ++i) {
      BagTopicSummary& topic = survey_.topics[i];
      topic.has_stamps = stamped_[i].count > 0 && stamped_[i].last != 0;
      Times& times = topic.has_stamps ? stamped_[i] : recorded_[i];
      topic.stamps_s = std::move(times.all_s);
      topic.first_ns = times.first;
      topic.last_ns = times.last;
      topic.backward_stamps = times.backward;
    }
  }

 private:
  struct Times {
    std::size_t count = 0, backward = 0;
    std::int64_t first = 0, last = 0, before = 0;
    std::vector<double> all_s;

    void add(std::int64_t ns, bool keep) {
      if (keep) all_s.push_back(secondsOf(ns));
      if (count == 0) first = last = ns;
      if (count > 0 && ns <= before) ++backward;
      first = std::min(first, ns);
      last = std::max(last, ns);
      before = ns;
      ++count;
    }
  };

  static bool isFrame(const BagTopicSummary& summary) {
    const BagTopic& t = summary.topic;
    return t.holds<ImageMsg>() || t.holds<CompressedImageMsg>() || t.holds<PointCloud2Msg>();
  }

  void addTopic() {
    BagTopicSummary summary;
    summary.topic = reader_.topics()[survey_.topics.size()];
    const BagTopic& t = summary.topic;
    summary.is_known = isFrame(summary) || t.holds<CameraInfoMsg>() || t.holds<LaserScanMsg>() ||
                       t.holds<OdometryMsg>() || t.holds<PathMsg>() ||
                       t.holds<OccupancyGridMsg>() || t.holds<PoseArrayMsg>() ||
                       t.holds<PoseStampedMsg>() || t.holds<TFMessageMsg>() ||
                       t.holds<MarkerArrayMsg>();
    survey_.topics.push_back(summary);
    recorded_.emplace_back();
    stamped_.emplace_back();
  }

  void look(const BagMessage& raw, BagTopicSummary& topic) {
    const bool first = topic.count == 1;
    HeaderMsg header;
    if (topic.topic.holds<TFMessageMsg>()) return lookAtFrames(raw);
    if (topic.topic.holds<MarkerArrayMsg>()) return;
    reader_.read(raw, header);
    if (first) topic.frame_id = frameName(header.frame_id);
    stamped_[raw.topic].add(header.stamp.ns, isFrame(topic));
    if (first && topic.topic.holds<ImageMsg>()) {
      ImageHead image;
      reader_.read(raw, image);
      topic.width = image.width;
      topic.height = image.height;
      topic.encoding = printable(image.encoding);
    } else if (first && topic.topic.holds<CompressedImageMsg>()) {
      lookAtCompressed(raw, topic);
    } else if (first && topic.topic.holds<PointCloud2Msg>()) {
      PointCloud2Msg cloud;
      reader_.read(raw, cloud);
      topic.width = cloud.width;
      topic.height = cloud.height;
      for (const auto& field : cloud.points_fields) {
        topic.encoding += (topic.encoding.empty() ? "" : " ") + printable(field.name);
      }
    } else if (first && topic.topic.holds<CameraInfoMsg>()) {
      reader_.read(raw, survey_.camera_infos[topic.topic.name]);
    } else if (topic.topic.holds<OdometryMsg>()) {
      OdometryMsg odometry;
      reader_.read(raw, odometry);
      if (first) topic.child_frame_id = frameName(odometry.child_frame_id);
    }
  }

  void lookAtCompressed(const BagMessage& raw, BagTopicSummary& topic) {
    CompressedImageMsg image;
    reader_.read(raw, image);
    topic.encoding = printable(image.format);
    cv::Mat pixels;
    BagImageReader decoder;
    if (isDepthEncoding(image.format)) {
      decoder.readDepth(image, pixels);
    } else {
      decoder.readColor(image, pixels);
    }
    topic.width = static_cast<std::uint32_t>(pixels.cols);
    topic.height = static_cast<std::uint32_t>(pixels.rows);
  }

  void lookAtFrames(const BagMessage& raw) {
    reader_.read(raw, frames_);
    for (const TransformStampedMsg& t : frames_.transforms) {
      const std::string parent = frameName(t.header.frame_id);
      const Eigen::Vector3d at(t.transform.translation.x, t.transform.translation.y,
                               t.transform.translation.z);
      PointMsg place;
      setPoint(place, at);
      const Eigen::Isometry3d T = poseOf(place, t.transform.rotation);
      const auto [known, is_new] =
          survey_.frames.insert({frameName(t.child_frame_id), {parent, T, false}});
      BagSurvey::Link& link = known->second;
      constexpr double kSame = 1e-9;
      if (!is_new && (link.parent != parent ||
                      (link.T_parent_child.matrix() - T.matrix()).cwiseAbs().maxCoeff() > kSame)) {
        link.moves = true;
      }
    }
  }

  const BagReader& reader_;
  BagSurvey& survey_;
  std::vector<Times> recorded_, stamped_;
  TFMessageMsg frames_;
};

}  // namespace

std::string frameName(const std::string& frame_id) {
  const bool has_slash = !frame_id.empty() && frame_id.front() == '/';
  return printable(has_slash ? frame_id.substr(1) : frame_id);
}

double BagTopicSummary::duration_s() const { return secondsOf(last_ns) - secondsOf(first_ns); }

double BagTopicSummary::rate_hz() const {
  return count > 1 && last_ns > first_ns ? static_cast<double>(count - 1) / duration_s() : 0.0;
}

const BagTopicSummary* BagSurvey::find(const std::string& topic) const {
  for (const BagTopicSummary& summary : topics) {
    if (summary.topic.name == topic && summary.count > 0) return &summary;
  }
  return nullptr;
}

std::optional<Eigen::Isometry3d> BagSurvey::transform(const std::string& base,
                                                      const std::string& frame) const {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  std::string at = frameName(frame);
  bool is_first = true;
  for (std::size_t steps = 0; steps <= frames.size(); ++steps) {
    if (at == base) return T;
    const auto link = frames.find(at);
    if (link == frames.end() || link->second.moves) return std::nullopt;
    // The first is taken as it is, to its last digit.
    T = is_first ? link->second.T_parent_child : link->second.T_parent_child * T;
    is_first = false;
    at = link->second.parent;
  }
  return std::nullopt;  // round in a circle
}

std::string BagSurvey::topicNames() const {
  std::string names;
  for (const BagTopicSummary& summary : topics) {
    names += (names.empty() ? "" : ", ") + summary.topic.name + " (" + summary.topic.type + ")";
  }
  return names;
}

BagSurvey surveyBag(const std::filesystem::path& path) {
  const auto reader = openBag(path);
  BagSurvey survey;
  survey.path = path;
  survey.form = reader->form();
  Surveyor surveyor(*reader, survey);
  BagMessage raw;
  while (reader->next(raw)) surveyor.add(raw);
  surveyor.finish();
  survey.lost = reader->lost();
  if (survey.messages == 0) {
    const std::string damage = survey.lost.substr(0, survey.lost.rfind("; what else"));
    throw std::runtime_error(damage.empty() ? path.string() + ": there is no message in the bag"
                                            : damage + "; no message in it can be read");
  }
  return survey;
}

}  // namespace heel
