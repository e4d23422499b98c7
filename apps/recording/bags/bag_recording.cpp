// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_cloud.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/recording/bags/bag_recording.hpp>
#include <heel/apps/recording/clouds/pcd_file.hpp>
#include <heel/apps/recording/stamp_order.hpp>
#include <heel/cloud/image_extent.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

/// So many messages wait for a partner at the most.
constexpr std::size_t kMostWaiting = 64;
/// So many frames are read ahead: they tell whether one has a wrong time, and their partners have
/// come meanwhile.
constexpr std::size_t kReadAhead = 8;

template <std::size_t N>
cv::Mat matrixOf(const std::array<double, N>& values) {
  return cv::Mat(3, static_cast<int>(N) / 3, CV_64F, const_cast<double*>(values.data())).clone();
}

/// A camera as camera_info tells; what is rectified already has neither distortion nor rotation.
RawCamera cameraOf(const std::string& origin, const CameraInfoMsg& info, bool is_rectified) {
  RawCamera camera;
  camera.P = matrixOf(info.P);
  camera.K = is_rectified ? camera.P.colRange(0, 3).clone() : matrixOf(info.K);
  camera.R = is_rectified ? cv::Mat(cv::Mat::eye(3, 3, CV_64F)) : matrixOf(info.R);
  if (!is_rectified) setDistortion(origin, info.distortion_model, cv::Mat(info.D), camera);
  return camera;
}

/// Gives the right camera its baseline by tf, where neither P has one, as simulators leave it; only
/// of cameras that stand side by side and look the same way, for what P says holds of no others.
void takeBaselineFromTf(const BagSurvey& survey, const BagCamera& camera, const RawCamera& left,
                        RawCamera& right) {
  constexpr double kSameWay_rad = 1e-3, kAside = 0.01;  // less than a pixel
  if (left.P.at<double>(0, 3) != 0.0 || right.P.at<double>(0, 3) != 0.0) return;
  const auto T = survey.transformBetween(camera.first->frame_id, camera.second->frame_id);
  if (!T || !T->matrix().allFinite()) return;
  const Eigen::Vector3d way = T->translation();
  const bool is_turned = Eigen::AngleAxisd(T->rotation()).angle() > kSameWay_rad;
  if (is_turned || std::hypot(way.y(), way.z()) > kAside * std::abs(way.x())) return;
  right.P.at<double>(0, 3) = -right.P.at<double>(0, 0) * way.x();
}

/// Without distortion: rectified as P tells, else raw as K does.
PinholeCamera pinholeOf(const CameraInfoMsg& info, bool is_rectified) {
  const int width = static_cast<int>(info.width), height = static_cast<int>(info.height);
  if (is_rectified) return {width, height, info.P[0], info.P[5], info.P[2], info.P[6]};
  return {width, height, info.K[0], info.K[4], info.K[2], info.K[5]};
}

/// The maps that take the distortion out of raw images; none if there is none.
void makeMaps(const std::string& origin, const CameraInfoMsg& info, cv::Mat& x, cv::Mat& y) {
  RawCamera camera = cameraOf(origin, info, false);
  if (camera.distortion.empty()) return;
  checkCameraMemory(origin, info.width, info.height);
  checkDistortion(origin, camera);
  camera.R = cv::Mat::eye(3, 3, CV_64F);
  camera.P = camera.K;
  makeRectifyMaps(camera, {static_cast<int>(info.width), static_cast<int>(info.height)}, CV_32FC1,
                  x, y);
}

void undistortDepth(const cv::Mat& raw_m, const cv::Mat& x, const cv::Mat& y, cv::Mat& depth_m) {
  cv::remap(raw_m, depth_m, x, y, cv::INTER_NEAREST, cv::BORDER_CONSTANT,
            cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
}

/// Which of several cameras is read, and one that is not.
std::string severalCameras(const BagSurvey& survey, const BagCamera& camera) {
  std::string read = camera.first->topic.name;
  if (camera.second != nullptr) read += " with " + camera.second->topic.name;
  return severalNote(survey, "cameras", read, camera.others, "name the topics to read another");
}

/// The camera's place, if tf tells it. Clouds are in the axes of their frame, whichever those are.
void placeCamera(const BagSurvey& survey, const BagTopics& topics, const BagCamera& camera,
                 RecordingInfo& info) {
  const std::string& frame = camera.first->frame_id;
  info.base_frame = baseFrameOf(survey, topics, frame).value_or("");
  if (camera.sensor == SensorKind::kCloud) {
    info.T_base_camera = placeOnRobot(survey, topics, frame);
    return;
  }
  const auto place = placeOfImages(survey, topics, frame);
  if (!place) return;
  info.T_base_camera = place->T_base_camera;
  if (!place->is_body) return;
  info.warnings.push_back(survey.path.string() + ": the images' frame '" + frame +
                          "' looks like a body's (X ahead, Z up); the camera is taken to look "
                          "along its X");
}

std::string layoutOf(const BagSurvey& survey, const BagCamera& camera) {
  std::string text = survey.form == BagForm::kRos1 ? "ROS 1 bag, " : "ROS 2 bag, ";
  text += camera.first->topic.name;
  if (camera.second != nullptr) text += " and " + camera.second->topic.name;
  return text;
}

}  // namespace

std::unique_ptr<Recording> BagRecording::open(const std::filesystem::path& path,
                                              const RecordingParams& params) {
  auto recording = open(surveyBag(path, params.span), openBag(path), params);
  recording->info_.name = std::filesystem::canonical(path).filename().string();
  return recording;
}

std::unique_ptr<Recording> BagRecording::openLive(const BagSurvey& survey,
                                                  std::unique_ptr<BagReader> reader,
                                                  const RecordingParams& params) {
  auto recording = open(survey, std::move(reader), params);
  recording->is_live_ = true;
  return recording;
}

std::unique_ptr<BagRecording> BagRecording::open(const BagSurvey& survey,
                                                 std::unique_ptr<BagReader> reader,
                                                 const RecordingParams& params) {
  const BagCamera camera = findBagCamera(survey, params.topics);
  RecordingInfo info;
  info.name = survey.path.string();
  info.layout = layoutOf(survey, camera);
  info.sensor = camera.sensor;
  info.frame_count = camera.first->count;
  info.lost = survey.lost;
  if (!camera.others.empty()) info.warnings.push_back(severalCameras(survey, camera));
  placeCamera(survey, params.topics, camera, info);
  BagMotion motion(survey, params.topics, camera.first->frame_id);
  std::unique_ptr<BagRecording> recording(
      new BagRecording(survey, std::move(reader), camera, std::move(motion), std::move(info)));
  if (camera.sensor == SensorKind::kStereo) recording->setUpStereo(survey, camera);
  if (camera.sensor == SensorKind::kRgbd) recording->setUpRgbd(survey, camera, params.topics);
  return recording;
}

BagRecording::BagRecording(const BagSurvey& survey, std::unique_ptr<BagReader> reader,
                           const BagCamera& camera, BagMotion motion, RecordingInfo info)
    : path_(survey.path.string()), bag_(std::move(reader)), bag_motion_(std::move(motion)) {
  info_ = std::move(info);
  const auto queueOf = [](const BagTopicSummary& topic) {
    Queue queue;
    queue.topic = topic.topic.name;
    queue.is_compressed = topic.topic.holds<CompressedImageMsg>();
    queue.has_stamps = topic.has_stamps;
    return queue;
  };
  first_ = queueOf(*camera.first);
  if (camera.second != nullptr) second_ = queueOf(*camera.second);
  std::vector<std::string> read = {first_.topic};
  if (camera.second != nullptr) read.push_back(second_.topic);
  bag_->select(survey.queryOf(std::move(read), false));
  info_.first_s = secondsOf(camera.first->first_stamp_ns);
  info_.duration_s = camera.first->duration_s();
  const double rate_hz = camera.first->rate_hz();
  limit_s_ = rate_hz > 0.0 ? 0.5 / rate_hz : 0.02;
}

void BagRecording::setUpStereo(const BagSurvey& survey, const BagCamera& camera) {
  const CameraInfoMsg& left_info = cameraInfoOf(survey, *camera.first);
  const CameraInfoMsg& right_info = cameraInfoOf(survey, *camera.second);
  const bool is_rectified = isRectified(*camera.first);
  const std::string origin = path_ + ", camera_info of ";
  const RawCamera left = cameraOf(origin + first_.topic, left_info, is_rectified);
  RawCamera right = cameraOf(origin + second_.topic, right_info, is_rectified);
  takeBaselineFromTf(survey, camera, left, right);
  rig_.emplace(left, right,
               cv::Size(static_cast<int>(left_info.width), static_cast<int>(left_info.height)),
               origin + first_.topic);
  info_.camera = rig_->camera();
}

void BagRecording::setUpRgbd(const BagSurvey& survey, const BagCamera& camera,
                             const BagTopics& topics) {
  const CameraInfoMsg& info = cameraInfoOf(survey, *camera.first);
  const bool is_rectified = isRectified(*camera.first) && info.P[0] > 0.0;
  info_.camera.left = depth_camera_ = pinholeOf(info, is_rectified);
  if (!isCalibrated(info_.camera.left)) {
    throw std::runtime_error(path_ + ": the camera_info of " + first_.topic +
                             " is empty: the camera was not calibrated");
  }
  if (!is_rectified) {
    makeMaps(path_ + ", camera_info of " + first_.topic, info, undistort_x_, undistort_y_);
  }
  setUpDepth(survey, camera, topics);
}

/// Depth that was made to fit colour has its frame and its intrinsics; what has not is registered.
void BagRecording::setUpDepth(const BagSurvey& survey, const BagCamera& camera,
                              const BagTopics& topics) {
  const BagTopicSummary &color = *camera.first, &depth = *camera.second;
  const CameraInfoMsg* info = findCameraInfo(survey, depth);
  const bool is_rectified = info != nullptr && isRectified(depth) && info->P[0] > 0.0;
  const PinholeCamera own = info != nullptr ? pinholeOf(*info, is_rectified) : PinholeCamera();
  const bool knows_own = isCalibrated(own);
  const bool fits_image = knows_own ? seesTheSame(own, info_.camera.left)
                                    : depth.width == color.width && depth.height == color.height;
  const bool same_frame = depth.frame_id == color.frame_id;
  if (fits_image && (same_frame || isNamedRegistered(depth))) return;
  const std::string origin = path_ + ", " + depth.topic.name;
  if (!knows_own) {
    throw std::runtime_error(origin + ": depth is not registered to the colour of " +
                             color.topic.name + ", and has no camera_info to do so");
  }
  std::optional<Eigen::Isometry3d> T_color_depth;
  if (!color.frame_id.empty() && !depth.frame_id.empty()) {
    T_color_depth = survey.transformBetween(color.frame_id, depth.frame_id);
  }
  if (T_color_depth) {
    const auto of_color = placeOfImages(survey, topics, color.frame_id);
    const auto of_depth = placeOfImages(survey, topics, depth.frame_id);
    if (of_color) T_color_depth = of_color->T_frame_camera.inverse() * *T_color_depth;
    if (of_depth) T_color_depth = *T_color_depth * of_depth->T_frame_camera;
  }
  if (!T_color_depth) {
    throw std::runtime_error(origin + ": depth is not registered to the colour of " +
                             color.topic.name + ", and tf does not tell where '" + depth.frame_id +
                             "' is from '" + color.frame_id + "'");
  }
  if (!T_color_depth->matrix().allFinite()) {
    throw std::runtime_error(origin + ": tf's place of '" + depth.frame_id + "' is not finite");
  }
  depth_camera_ = own;
  if (!is_rectified) {
    makeMaps(path_ + ", camera_info of " + depth.topic.name, *info, depth_x_, depth_y_);
  }
  registration_.emplace(own, info_.camera.left, *T_color_depth);
  info_.layout += ", registered by Heel";
}

std::string BagRecording::nameOf(const Waiting& message) const {
  return path_ + ", " + first_.topic + " message " + std::to_string(message.number);
}

void BagRecording::take(const BagMessage& raw, Queue& queue) {
  Waiting message;
  message.number = ++queue.count;
  message.stamp_s = secondsOf(raw.stamp_ns);
  if (queue.has_stamps) {
    HeaderMsg header;
    try {
      bag_->read(raw, header);
    } catch (const std::runtime_error&) {
      return;  // it is told of where the frame is missed
    }
    message.stamp_s = secondsOf(header.stamp.ns);
  }
  message.bytes.assign(raw.data, raw.data + raw.size);
  queue.waiting.push_back(std::move(message));
}

bool BagRecording::readMessage() {
  BagMessage raw;
  while (bag_->next(raw)) {
    const std::string& topic = bag_->topics()[raw.topic].name;
    if (topic != first_.topic && topic != second_.topic) continue;
    take(raw, topic == first_.topic ? first_ : second_);
    if (second_.waiting.size() > kMostWaiting) second_.waiting.pop_front();
    return true;
  }
  at_end_ = !is_live_;
  return false;
}

/// Whether the partner of the first that waits can be told, if it has one, and that its time is
/// right.
bool BagRecording::isDecided() const {
  if (at_end_ || first_.waiting.size() > kMostWaiting) return true;
  if (first_.waiting.size() <= (is_live_ ? 0 : kReadAhead)) return false;
  // A live robot's first partner that fits is taken: the best may be the next, but that is late.
  const double from_s = first_.waiting.front().stamp_s - (is_live_ ? limit_s_ : 0.0);
  return info_.sensor == SensorKind::kCloud ||
         std::any_of(second_.waiting.begin(), second_.waiting.end(),
                     [&](const Waiting& other) { return other.stamp_s >= from_s; });
}

/// Whether so many live frames in a row were older than one before, each newer than the last of
/// them, that it is the time that has gone back.
bool BagRecording::beginsAnew(double stamp_s) {
  constexpr std::size_t kFrames = 5;  // fewer may be late
  if (!is_live_ || stamp_s > last_s_) {
    older_ = 0;
    return false;
  }
  older_ = older_ > 0 && stamp_s > older_s_ ? older_ + 1 : 1;
  older_s_ = stamp_s;
  return older_ >= kFrames;
}

void BagRecording::checkStamp(double stamp_s) {
  if (beginsAnew(stamp_s)) {
    older_ = 0;
    last_s_ = -std::numeric_limits<double>::infinity();
    // What waits of the time before has no partner any more, and would be taken for the newest.
    const auto is_past = [&](const Waiting& other) { return other.stamp_s > stamp_s + limit_s_; };
    std::deque<Waiting>& others = second_.waiting;
    others.erase(std::remove_if(others.begin(), others.end(), is_past), others.end());
  }
  std::vector<double> following_s;
  for (const Waiting& next : first_.waiting) following_s.push_back(next.stamp_s);
  checkGoesOn(stamp_s, last_s_);
  checkIsNotAhead(stamp_s, last_s_, following_s);
  last_s_ = stamp_s;
}

std::optional<BagRecording::Waiting> BagRecording::takePartner(double stamp_s) {
  const auto apart = [&](const Waiting& m) { return std::abs(m.stamp_s - stamp_s); };
  const auto nearest =
      std::min_element(second_.waiting.begin(), second_.waiting.end(),
                       [&](const Waiting& a, const Waiting& b) { return apart(a) < apart(b); });
  if (nearest == second_.waiting.end() || apart(*nearest) > limit_s_) return std::nullopt;
  Waiting partner = std::move(*nearest);
  second_.waiting.erase(second_.waiting.begin(), nearest + 1);
  return partner;
}

bool BagRecording::next(Frame& frame) {
  while (true) {
    while (!isDecided() && readMessage()) continue;
    if (is_live_ && !isDecided()) return false;
    if (first_.waiting.empty()) {
      // By its index, damage is found where it is read.
      if (info_.lost.empty()) info_.lost = bag_->lost();
      return false;
    }
    const Waiting first = std::move(first_.waiting.front());
    first_.waiting.pop_front();
    try {
      checkStamp(first.stamp_s);
      std::optional<Waiting> second;
      if (info_.sensor != SensorKind::kCloud) {
        second = takePartner(first.stamp_s);
        if (!second) {
          throw std::runtime_error("there is no image on " + second_.topic + " within " +
                                   std::to_string(limit_s_) + " s of it");
        }
      }
      makeFrame(first, second ? &*second : nullptr, frame);
    } catch (const std::runtime_error& error) {
      skipped_.push_back({first.number, nameOf(first) + ": " + error.what()});
      continue;
    }
    frame.number = first.number;
    frame.stamp_s = first.stamp_s;
    frame.name = nameOf(first);
    return true;
  }
}

void BagRecording::makeFrame(const Waiting& first, const Waiting* second, Frame& frame) {
  frame.right_bgr.release();
  frame.depth_m.release();
  frame.cloud.reset();
  const auto partner = [&](const auto& read) {
    try {
      read();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("with it on " + second_.topic + ": " + error.what());
    }
  };
  if (info_.sensor == SensorKind::kCloud) {
    readCloud(first, frame);
  } else if (info_.sensor == SensorKind::kStereo) {
    // What the rig hands on as it is must not be overwritten while the frame is in use.
    readColor(first_, first, rig_->isRectified() ? frame.image_bgr : raw_left_);
    partner(
        [&] { readColor(second_, *second, rig_->isRectified() ? frame.right_bgr : raw_right_); });
    if (!rig_->isRectified()) {
      rig_->rectify(raw_left_, raw_right_, frame.image_bgr, frame.right_bgr);
    }
  } else {
    const bool undistort = !undistort_x_.empty();
    readColor(first_, first, undistort ? raw_left_ : frame.image_bgr);
    if (undistort) {
      cv::remap(raw_left_, frame.image_bgr, undistort_x_, undistort_y_, cv::INTER_LINEAR);
    }
    if (registration_) {
      partner([&] { readDepth(*second, raw_right_); });
      if (!depth_x_.empty()) undistortDepth(raw_right_, depth_x_, depth_y_, undistorted_depth_);
      registration_->apply(depth_x_.empty() ? raw_right_ : undistorted_depth_, frame.depth_m);
    } else {
      partner([&] { readDepth(*second, undistort ? raw_right_ : frame.depth_m); });
      if (undistort) undistortDepth(raw_right_, undistort_x_, undistort_y_, frame.depth_m);
    }
  }
}

void BagRecording::checkSize(const cv::Mat& image, const PinholeCamera& camera,
                             const char* what) const {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::runtime_error(std::string(what) + " is " + std::to_string(image.cols) + "x" +
                           std::to_string(image.rows) + ", but camera_info says " +
                           std::to_string(camera.width) + "x" + std::to_string(camera.height));
}

void BagRecording::readColor(const Queue& queue, const Waiting& message, cv::Mat& image_bgr) {
  if (queue.is_compressed) {
    heel::readMessage(bag_->form(), message.bytes.data(), message.bytes.size(), compressed_);
    images_.readColor(compressed_, image_bgr);
  } else {
    heel::readMessage(bag_->form(), message.bytes.data(), message.bytes.size(), image_);
    images_.readColor(image_, image_bgr);
  }
  checkSize(image_bgr, info_.camera.left, "the image");
}

void BagRecording::readDepth(const Waiting& message, cv::Mat& depth_m) {
  if (second_.is_compressed) {
    heel::readMessage(bag_->form(), message.bytes.data(), message.bytes.size(), compressed_);
    images_.readDepth(compressed_, depth_m);
  } else {
    heel::readMessage(bag_->form(), message.bytes.data(), message.bytes.size(), image_);
    images_.readDepth(image_, depth_m);
  }
  checkSize(depth_m, depth_camera_, "the depth image");
}

void BagRecording::readCloud(const Waiting& message, Frame& frame) {
  heel::readMessage(bag_->form(), message.bytes.data(), message.bytes.size(), cloud_);
  frame.cloud = toColorCloud(cloud_);
  if (frame.cloud->isOrganized()) {
    colorsOf(*frame.cloud, frame.image_bgr);
  } else {
    frame.image_bgr.release();
  }
}

}  // namespace heel
