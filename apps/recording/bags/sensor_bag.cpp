// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_cloud.hpp>
#include <heel/apps/recording/bags/bag_poses.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr const char* kMap = "map";
constexpr const char* kOdom = "odom";
constexpr const char* kBase = "base_footprint";
constexpr const char* kCamera = "camera_optical";
constexpr const char* kFloorCamera = "floor_camera_optical";
constexpr const char* kScanner = "laser";

}  // namespace

Eigen::Isometry3d asInBags(const Eigen::Isometry3d& T) {
  const PoseMsg pose = toPoseMsg(T);
  return poseOf(pose.position, pose.orientation);
}

SensorBag::SensorBag(const std::filesystem::path& path, const RecordingInfo& camera)
    : SensorBag(createBag(BagPlan{path, {}, "simulate"}), camera) {}

SensorBag::SensorBag(std::unique_ptr<BagWriter> bag, const RecordingInfo& camera, bool packs_images)
    : bag_(std::move(bag)), camera_(camera), packs_images_(packs_images) {
  if (camera_.T_base_camera) {
    static_.transforms.push_back(
        toTransform(toPoseMsg(*camera_.T_base_camera), header(0.0, kBase), kCamera));
  }
}

HeaderMsg SensorBag::header(double stamp_s, const char* frame) {
  HeaderMsg header;
  header.stamp.ns = nanosecondsOf(stamp_s);
  header.frame_id = frame;
  return header;
}

void SensorBag::setScanner(const Eigen::Isometry3d& T_base_scanner, float max_range_m) {
  max_range_m_ = max_range_m;
  static_.transforms.push_back(
      toTransform(toPoseMsg(T_base_scanner), header(0.0, kBase), kScanner));
}

/// All of them once, in one message: who comes late gets the last.
void SensorBag::writeStatic(double stamp_s) {
  if (has_static_ || static_.transforms.empty()) return;
  has_static_ = true;
  for (TransformStampedMsg& t : static_.transforms) t.header.stamp.ns = nanosecondsOf(stamp_s);
  bag_->write("/tf_static", nanosecondsOf(stamp_s), static_, true);
}

void SensorBag::writeRaw(const std::string& topic, const HeaderMsg& header, const cv::Mat& image,
                         const char* encoding) {
  const cv::Mat whole = image.isContinuous() ? image : image.clone();
  ImageMsg message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(whole.cols);
  message.height = static_cast<std::uint32_t>(whole.rows);
  message.encoding = encoding;
  message.step = static_cast<std::uint32_t>(whole.elemSize()) * message.width;
  message.data.assign(whole.datastart, whole.dataend);
  bag_->write(topic, message.header.stamp.ns, message);
}

void SensorBag::writeImage(const std::string& topic, double stamp_s, const cv::Mat& image_bgr) {
  if (!packs_images_) {
    return writeRaw(topic + "/image_rect_color", header(stamp_s, kCamera), image_bgr, "bgr8");
  }
  CompressedImageMsg message;
  message.header = header(stamp_s, kCamera);
  message.format = "bgr8; png compressed bgr8";
  if (!cv::imencode(".png", image_bgr, message.data)) {
    throw std::runtime_error(topic + ": an image can't be encoded");
  }
  bag_->write(topic + "/image_rect_color/compressed", message.header.stamp.ns, message);
}

void SensorBag::writeInfo(const std::string& topic, double stamp_s, double baseline_m) {
  const PinholeCamera& c = camera_.camera.left;
  const double cx = c.cx + (baseline_m > 0.0 ? camera_.camera.disparity_offset : 0.0);
  CameraInfoMsg info;
  info.header = header(stamp_s, kCamera);
  info.width = static_cast<std::uint32_t>(c.width);
  info.height = static_cast<std::uint32_t>(c.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {c.fx, 0, cx, 0, c.fy, c.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {c.fx, 0, cx, -c.fx * baseline_m, 0, c.fy, c.cy, 0, 0, 0, 1, 0};
  bag_->write(topic + "/camera_info", info.header.stamp.ns, info);
}

void SensorBag::add(const Frame& frame) {
  const double s = frame.stamp_s;
  writeStatic(s);
  if (camera_.sensor == SensorKind::kStereo) {
    writeInfo("/camera/left", s, 0.0);
    writeImage("/camera/left", s, frame.image_bgr);
    writeInfo("/camera/right", s, camera_.camera.baseline_m);
    writeImage("/camera/right", s, frame.right_bgr);
  } else if (camera_.sensor == SensorKind::kRgbd) {
    writeInfo("/camera/rgb", s, 0.0);
    writeImage("/camera/rgb", s, frame.image_bgr);
    writeRaw("/camera/depth_registered/image_rect", header(s, kCamera), frame.depth_m, "32FC1");
  } else {
    PointCloud2Msg message = toCloudMsg(*frame.cloud);
    message.header = header(s, kCamera);
    bag_->write("/camera/points", message.header.stamp.ns, message);
  }
}

void SensorBag::addFloor(double stamp_s, const cv::Mat& depth_m) {
  writeRaw("/floor_camera/depth/image_rect", header(stamp_s, kFloorCamera), depth_m, "32FC1");
}

void SensorBag::add(double stamp_s, const LaserScan& scan) {
  LaserScanMsg message;
  message.header = header(stamp_s, kScanner);
  message.angle_min = static_cast<float>(scan.first_rad);
  message.angle_increment = static_cast<float>(scan.step_rad);
  message.angle_max =
      static_cast<float>(scan.angle(scan.ranges_m.empty() ? 0 : scan.ranges_m.size() - 1));
  message.range_min = 0.0F;
  message.range_max = max_range_m_;
  message.ranges = scan.ranges_m;
  bag_->write("/scan", message.header.stamp.ns, message);
}

void SensorBag::addOdometry(double stamp_s, const FloorPose& odometry) {
  OdometryMsg message;
  message.header = header(stamp_s, kOdom);
  message.child_frame_id = kBase;
  message.pose.pose = toPoseMsg(odometry);
  bag_->write("/odom", message.header.stamp.ns, message);
  TFMessageMsg transform;
  transform.transforms.push_back(toTransform(message.pose.pose, message.header, kBase));
  bag_->write("/tf", message.header.stamp.ns, transform);
}

void SensorBag::addTruth(double stamp_s, const FloorPose& robot,
                         const std::vector<FloorPose>& people) {
  if (!has_static_) {
    // The odometry starts where the robot stands.
    static_.transforms.push_back(toTransform(toPoseMsg(robot), header(stamp_s, kMap), kOdom));
    writeStatic(stamp_s);
  }
  OdometryMsg message;
  message.header = header(stamp_s, kMap);
  message.child_frame_id = kBase;
  message.pose.pose = toPoseMsg(robot);
  bag_->write("/ground_truth/odom", message.header.stamp.ns, message);
  PoseArrayMsg poses;
  poses.header = message.header;
  for (const FloorPose& person : people) poses.poses.push_back(toPoseMsg(person));
  bag_->write("/ground_truth/people", poses.header.stamp.ns, poses);
}

}  // namespace heel
