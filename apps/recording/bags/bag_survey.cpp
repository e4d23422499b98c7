// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/recording/bags/bag_survey.hpp>

#include <algorithm>
#include <cmath>
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

bool isLatched(const BagTopic& topic) {
  return topic.holds<TFMessageMsg>() && topic.name.find("static") != std::string::npos;
}

/// Whether a link is elsewhere than at first. Encoders of joints that hold still tremble; how the
/// robot itself is told to move counts to its last digit, for then somebody tells it.
bool hasMoved(const Eigen::Isometry3d& first, const Eigen::Isometry3d& now, bool is_robots) {
  constexpr double kSame = 1e-9;
  constexpr double kTremble_m = 0.002, kTremble_rad = 0.0035;  // 0.2 degrees
  const bool is_same = (first.matrix() - now.matrix()).cwiseAbs().maxCoeff() <= kSame;
  if (is_same || is_robots) return !is_same;
  const Eigen::Isometry3d T = first.inverse() * now;
  return !(T.translation().norm() <= kTremble_m &&
           Eigen::AngleAxisd(T.linear()).angle() <= kTremble_rad);
}

class Surveyor {
 public:
  Surveyor(BagReader& reader, BagSurvey& survey) : reader_(reader), survey_(survey) {}

  void byIndex(const BagIndex& index, const TimeSpan& span) {
    addTopics();
    setSpan(index.first_ns, span);
    for (std::size_t i = 0; i < survey_.topics.size(); ++i) {
      BagTopicSummary& topic = survey_.topics[i];
      const BagIndex::Topic& told = index.topics[i];
      topic.first_ns = told.first_ns;
      topic.last_ns = told.last_ns;
      topic.count = told.count;
      survey_.messages += told.count;
      if (told.count == 0 || !topic.is_known) continue;
      // What is sent once counts until it is sent again.
      const bool is_kept = isLatched(topic.topic) || topic.topic.holds<CameraInfoMsg>();
      BagQuery first = survey_.queryOf({topic.topic.name}, false);
      first.from_ns = std::max(first.from_ns, told.first_ns);
      if (!lookAtFirst(topic, first)) {
        if (is_kept) lookAtFirst(topic, BagQuery{{topic.topic.name}});
        if (!is_kept) topic.count = 0;
      }
      if (!is_kept) cut(topic);
    }
    lookAtTransforms(index);
    survey_.first_ns = std::max(index.first_ns, survey_.span.from_ns);
    survey_.last_ns = std::min(index.last_ns, survey_.span.to_ns);
    finish();
  }

  /// Reads all messages.
  void byScan(const TimeSpan& span) {
    BagMessage raw;
    bool is_first = true;
    while (reader_.next(raw)) {
      addTopics();
      if (is_first) setSpan(raw.stamp_ns, span);
      is_first = false;
      BagTopicSummary& topic = survey_.topics[raw.topic];
      const bool is_within =
          raw.stamp_ns >= survey_.span.from_ns && raw.stamp_ns <= survey_.span.to_ns;
      if (!is_within && !isLatched(topic.topic) && !topic.topic.holds<CameraInfoMsg>()) continue;
      const auto widen = [&](std::int64_t& first_ns, std::int64_t& last_ns, bool is_new) {
        first_ns = is_new ? raw.stamp_ns : std::min(first_ns, raw.stamp_ns);
        last_ns = is_new ? raw.stamp_ns : std::max(last_ns, raw.stamp_ns);
      };
      widen(survey_.first_ns, survey_.last_ns, survey_.messages == 0);
      widen(topic.first_ns, topic.last_ns, topic.count == 0);
      ++survey_.messages;
      ++topic.count;
      if (topic.is_known) lookOrCount(raw, topic);
    }
    addTopics();
    noteLost();
    finish();
  }

 private:
  static bool isFrame(const BagTopicSummary& summary) {
    const BagTopic& t = summary.topic;
    return t.holds<ImageMsg>() || t.holds<CompressedImageMsg>() || t.holds<PointCloud2Msg>();
  }

  void setSpan(std::int64_t first_ns, const TimeSpan& span) {
    if (span.from_s > 0.0) {
      survey_.span.from_ns = first_ns + nanosecondsOf(span.from_s - kSameTime_s);
    }
    if (std::isfinite(span.to_s)) {
      survey_.span.to_ns = first_ns + nanosecondsOf(span.to_s + kSameTime_s);
    }
  }

  bool lookAtFirst(BagTopicSummary& topic, const BagQuery& query) {
    constexpr int kMostTries = 10;  // until one is whole
    reader_.select(query);
    BagMessage raw;
    bool is_there = false;
    for (int i = 0; i < kMostTries && reader_.next(raw); ++i) {
      if (&survey_.topics[raw.topic] != &topic) continue;  // of the same name
      is_there = true;
      const std::size_t broken = topic.broken;
      lookOrCount(raw, topic);
      if (topic.broken == broken) break;
    }
    noteLost();
    return is_there;
  }

  /// Of the times and the number of a whole topic, those of the part.
  void cut(BagTopicSummary& topic) const {
    const auto whole_ns = static_cast<double>(topic.last_ns - topic.first_ns);
    topic.first_ns = std::max(topic.first_ns, survey_.span.from_ns);
    topic.last_ns = std::max(topic.first_ns, std::min(topic.last_ns, survey_.span.to_ns));
    const auto part_ns = static_cast<double>(topic.last_ns - topic.first_ns);
    if (topic.count < 2 || part_ns >= whole_ns) return;
    const double share = part_ns / whole_ns * static_cast<double>(topic.count - 1);
    topic.count = 1 + static_cast<std::size_t>(std::llround(share));
  }

  /// All of the latched ones, the beginning of the others, and some of what follows: enough to see
  /// what moves, for what has moved is elsewhere.
  void lookAtTransforms(const BagIndex& index) {
    constexpr std::int64_t kSecond = 1000000000, kAll = 120 * kSecond;
    constexpr std::int64_t kBeginning = 10 * kSecond, kPieces = 20;
    std::vector<std::string> latched, others;
    for (const BagTopicSummary& t : survey_.topics) {
      if (!t.topic.holds<TFMessageMsg>()) continue;
      (isLatched(t.topic) ? latched : others).push_back(t.topic.name);
    }
    if (!latched.empty()) lookAtTransforms(BagQuery{latched});
    if (others.empty()) return;
    const std::int64_t from = std::max(index.first_ns, survey_.span.from_ns);
    const std::int64_t to = std::min(index.last_ns, survey_.span.to_ns);
    if (from > to) return;
    // Times of a broken index may be further apart than a number can tell.
    const std::int64_t length =
        static_cast<double>(to) - static_cast<double>(from) > 1e18 ? kAll : to - from;
    if (length <= kAll) return lookAtTransforms({others, from, to});
    lookAtTransforms({others, from, from + kBeginning});
    const std::int64_t step = (length - kBeginning) / kPieces;
    for (std::int64_t i = 1; i <= kPieces; ++i) {
      const std::int64_t end = from + kBeginning + i * step;
      lookAtTransforms({others, end - kSecond, end});
    }
  }

  void lookAtTransforms(const BagQuery& query) {
    reader_.select(query);
    BagMessage raw;
    while (reader_.next(raw)) {
      try {
        lookAtFrames(raw);
      } catch (const std::runtime_error&) {
        ++survey_.topics[raw.topic].broken;
      }
    }
    noteLost();
  }

  void noteLost() {
    if (survey_.lost.empty()) survey_.lost = reader_.lost();
  }

  void finish() {
    for (BagTopicSummary& topic : survey_.topics) {
      topic.has_stamps = topic.first_stamp_ns != 0;
      if (!topic.has_stamps) topic.first_stamp_ns = topic.first_ns;
    }
  }

  void addTopics() {
    while (survey_.topics.size() < reader_.topics().size()) addTopic();
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
    is_looked_at_.push_back(false);
  }

  void lookOrCount(const BagMessage& raw, BagTopicSummary& topic) {
    try {
      look(raw, topic);
    } catch (const std::runtime_error&) {
      ++topic.broken;
    }
  }

  void look(const BagMessage& raw, BagTopicSummary& topic) {
    if (topic.topic.holds<TFMessageMsg>()) return lookAtFrames(raw);
    if (topic.topic.holds<MarkerArrayMsg>()) return;
    HeaderMsg header;
    reader_.read(raw, header);
    if (is_looked_at_[raw.topic]) return;
    topic.frame_id = frameName(header.frame_id);
    topic.first_stamp_ns = header.stamp.ns;
    if (topic.topic.holds<ImageMsg>()) {
      ImageHead image;
      reader_.read(raw, image);
      topic.width = image.width;
      topic.height = image.height;
      topic.encoding = printable(image.encoding);
    } else if (topic.topic.holds<CompressedImageMsg>()) {
      lookAtCompressed(raw, topic);
    } else if (topic.topic.holds<PointCloud2Msg>()) {
      PointCloud2Msg cloud;
      reader_.read(raw, cloud);
      topic.width = cloud.width;
      topic.height = cloud.height;
      topic.encoding.clear();
      for (const auto& field : cloud.points_fields) {
        topic.encoding += (topic.encoding.empty() ? "" : " ") + printable(field.name);
      }
    } else if (topic.topic.holds<CameraInfoMsg>()) {
      reader_.read(raw, survey_.camera_infos[topic.topic.name]);
    } else if (topic.topic.holds<OdometryMsg>()) {
      OdometryMsg odometry;
      reader_.read(raw, odometry);
      topic.child_frame_id = frameName(odometry.child_frame_id);
    }
    is_looked_at_[raw.topic] = true;
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
      const std::string child = frameName(t.child_frame_id);
      const auto [known, is_new] = survey_.frames.insert({child, {parent, T, false}});
      BagSurvey::Link& link = known->second;
      const bool is_robots = child == "base_footprint" || child == "base_link";
      if (!is_new && (link.parent != parent || hasMoved(link.T_parent_child, T, is_robots))) {
        link.moves = true;
      }
    }
  }

  BagReader& reader_;
  BagSurvey& survey_;
  std::vector<bool> is_looked_at_;  ///< By topic: a message that is whole.
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

std::string BagSurvey::rootOf(const std::string& frame) const {
  std::string at = frameName(frame);
  for (std::size_t steps = 0; steps < frames.size(); ++steps) {
    const auto link = frames.find(at);
    if (link == frames.end() || link->second.moves) break;
    at = link->second.parent;
  }
  return at;
}

std::optional<Eigen::Isometry3d> BagSurvey::transformBetween(const std::string& to,
                                                             const std::string& from) const {
  std::string common = frameName(to);
  for (std::size_t steps = 0; steps <= frames.size(); ++steps) {
    if (const auto T_common_from = transform(common, from)) {
      const auto T_common_to = transform(common, to);
      return T_common_to ? std::optional(T_common_to->inverse() * *T_common_from) : std::nullopt;
    }
    const auto link = frames.find(common);
    if (link == frames.end() || link->second.moves) return std::nullopt;
    common = link->second.parent;
  }
  return std::nullopt;
}

std::string BagSurvey::topicNames() const {
  std::string names;
  for (const BagTopicSummary& summary : topics) {
    names += (names.empty() ? "" : ", ") + summary.topic.name + " (" + summary.topic.type + ")";
  }
  return names;
}

BagQuery BagSurvey::queryOf(std::vector<std::string> names, bool with_tf, double around_s) const {
  BagQuery query = span;
  query.topics = std::move(names);
  for (const BagTopicSummary& t : topics) {
    if (with_tf && t.topic.holds<TFMessageMsg>()) query.topics.push_back(t.topic.name);
  }
  const std::int64_t around_ns = nanosecondsOf(around_s);
  const BagQuery all;
  if (span.from_ns > all.from_ns + around_ns) query.from_ns -= around_ns;
  if (span.to_ns < all.to_ns - around_ns) query.to_ns += around_ns;
  return query;
}

BagSurvey surveyMessages(BagReader& reader, const std::string& name) {
  BagSurvey survey;
  survey.path = name;
  survey.form = reader.form();
  Surveyor(reader, survey).byScan({});
  return survey;
}

BagSurvey surveyBag(const std::filesystem::path& path, const TimeSpan& span) {
  const auto reader = openBag(path);
  BagSurvey survey;
  survey.path = path;
  survey.form = reader->form();
  Surveyor surveyor(*reader, survey);
  const BagIndex* index = reader->index();
  if (index != nullptr) {
    surveyor.byIndex(*index, span);
  } else {
    surveyor.byScan(span);
  }
  if (survey.messages == 0) {
    const std::string damage = survey.lost.substr(0, survey.lost.rfind("; what else"));
    throw std::runtime_error(damage.empty() ? path.string() + ": there is no message in the bag"
                                            : damage + "; no message in it can be read");
  }
  if (survey.last_ns < survey.span.from_ns) {
    throw std::runtime_error(path.string() + ": there is no message in that part of the bag");
  }
  return survey;
}

}  // namespace heel
