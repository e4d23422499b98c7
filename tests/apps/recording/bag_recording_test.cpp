// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/bags/bag_odometry.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/apps/recording/recording.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace heel {
namespace {

using test::messageOf;
using test::TempFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth = 32, kHeight = 24;

HeaderMsg header(double stamp_s, const char* frame = "optical") {
  HeaderMsg result;
  result.stamp.ns = std::llround(stamp_s * 1e9);
  result.frame_id = frame;
  return result;
}

CameraInfoMsg cameraInfo(double minus_fx_baseline) {
  CameraInfoMsg info;
  info.header = header(0.1);
  info.width = kWidth;
  info.height = kHeight;
  info.K = {30, 0, 15.5, 0, 30, 11.5, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {30, 0, 15.5, minus_fx_baseline, 0, 30, 11.5, 0, 0, 0, 1, 0};
  return info;
}

ImageMsg image(double stamp_s, const std::string& encoding, int value, std::uint32_t pixel_bytes) {
  ImageMsg message;
  message.header = header(stamp_s);
  message.width = kWidth;
  message.height = kHeight;
  message.encoding = encoding;
  message.step = kWidth * pixel_bytes + 8;  // rows may be padded
  message.data.assign(std::size_t{message.step} * kHeight, static_cast<std::uint8_t>(value));
  return message;
}

struct Read {
  std::vector<std::size_t> numbers;
  std::vector<double> stamps_s;
  std::vector<SkippedFrame> skipped;
  RecordingInfo info;
  Frame last;
};

Read readAll(const std::filesystem::path& path, const BagTopics& topics = {},
             const TimeSpan& span = {}) {
  RecordingParams params;
  params.topics = topics;
  params.span = span;
  const auto recording = openRecording(path, params);
  Read read;
  while (recording->next(read.last)) {
    read.numbers.push_back(read.last.number);
    read.stamps_s.push_back(read.last.stamp_s);
  }
  read.skipped = recording->skipped();
  read.info = recording->info();
  return read;
}

class BagRecordings : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path path() const { return folder_ / GetParam(); }

  std::unique_ptr<BagWriter> beginStereo(const std::string& images = "image_raw") {
    auto bag = createBag(path());
    bag->write("/stereo/left/camera_info", 1, cameraInfo(0.0));
    bag->write("/stereo/right/camera_info", 1, cameraInfo(-3.0));
    left_ = "/stereo/left/" + images;
    right_ = "/stereo/right/" + images;
    return bag;
  }
  void addLeft(BagWriter& bag, double s) {
    bag.write(left_, std::llround(s * 1e9), image(s, "bgr8", 10, 3));
  }
  void addRight(BagWriter& bag, double s) {
    bag.write(right_, std::llround(s * 1e9), image(s, "mono8", 90, 1));
  }

  TempFolder folder_;
  std::string left_, right_;
};
INSTANTIATE_TEST_SUITE_P(Forms, BagRecordings, testing::Values("r.bag", "r.db3", "r.mcap"));

TEST_P(BagRecordings, PairsStereoImagesWithinHalfAFrame) {
  const auto bag = beginStereo();
  for (int i = 1; i <= 5; ++i) {
    addLeft(*bag, 0.1 * i);
    if (i != 3) addRight(*bag, 0.1 * i + 0.02);
  }
  bag->commit();
  const Read read = readAll(path());
  EXPECT_THAT(read.numbers, ElementsAre(1, 2, 4, 5));
  EXPECT_THAT(read.stamps_s, ElementsAre(0.1, 0.2, 0.4, 0.5));
  ASSERT_THAT(read.skipped, SizeIs(1));
  EXPECT_EQ(read.skipped[0].number, 3U);
  EXPECT_THAT(read.skipped[0].reason, HasSubstr("no image on /stereo/right/image_raw"));
  EXPECT_EQ(read.info.sensor, SensorKind::kStereo);
  EXPECT_DOUBLE_EQ(read.info.camera.baseline_m, 0.1);
  EXPECT_EQ(read.info.frame_count, 5U);
  EXPECT_FALSE(read.info.T_base_camera);
  EXPECT_EQ(read.last.image_bgr.at<cv::Vec3b>(3, 3), cv::Vec3b(10, 10, 10));
  EXPECT_EQ(read.last.right_bgr.at<cv::Vec3b>(3, 3), cv::Vec3b(90, 90, 90));
}

TEST_P(BagRecordings, TakesTheNearestPartnerInWhateverOrderTheyCome) {
  const auto bag = beginStereo();
  for (int i = 1; i <= 4; ++i) addRight(*bag, 0.1 * i);
  for (int i = 1; i <= 4; ++i) addLeft(*bag, 0.1 * i);
  bag->commit();
  EXPECT_THAT(readAll(path()).numbers, ElementsAre(1, 2, 3, 4));
}

TEST_P(BagRecordings, WrittenTopicAfterTopicLoseNoFrame) {
  const auto bag = beginStereo();
  for (int i = 1; i <= 300; ++i) addLeft(*bag, 0.1 * i);
  for (int i = 1; i <= 300; ++i) addRight(*bag, 0.1 * i);
  bag->commit();
  const Read read = readAll(path());
  EXPECT_THAT(read.numbers, SizeIs(300));
  EXPECT_THAT(read.skipped, IsEmpty());
}

TEST_P(BagRecordings, GiveThePartThatIsAskedFor) {
  const auto bag = createBag(path());
  TFMessageMsg message;
  TransformStampedMsg camera;
  camera.header = header(0.1, "base_link");
  camera.child_frame_id = "optical";
  camera.transform.translation.z = 1.5;
  message.transforms = {camera};
  bag->write("/tf_static", 100'000'000, message, true);
  bag->write("/left/camera_info", 100'000'000, cameraInfo(0.0));
  bag->write("/right/camera_info", 100'000'000, cameraInfo(-3.0));
  left_ = "/left/image_raw";
  right_ = "/right/image_raw";
  for (int i = 1; i <= 100; ++i) {
    addLeft(*bag, 0.1 * i);
    addRight(*bag, 0.1 * i);
  }
  bag->commit();
  // The bag begins at 0.1 s.
  const Read read = readAll(path(), {}, {4.95, 5.35});
  ASSERT_THAT(read.stamps_s, SizeIs(4));
  EXPECT_NEAR(read.stamps_s.front(), 5.1, 1e-9);
  EXPECT_NEAR(read.stamps_s.back(), 5.4, 1e-9);
  EXPECT_NEAR(read.info.first_s, 5.1, 1e-9);
  EXPECT_EQ(read.info.frame_count, 5U);  // about
  ASSERT_TRUE(read.info.T_base_camera);  // what is latched holds on
  EXPECT_DOUBLE_EQ(read.info.T_base_camera->translation().z(), 1.5);
  EXPECT_THAT(readAll(path(), {}, {9.75, 1e9}).stamps_s, SizeIs(2));
  EXPECT_THAT(messageOf([&] {
                readAll(path(), {}, {20.0, 30.0});
              }),
              HasSubstr("no message in that part of the bag"));
  EXPECT_THAT(messageOf<std::invalid_argument>([&] {
                readAll(path(), {}, {5.0, 4.0});
              }),
              HasSubstr("must begin"));
}

TEST_P(BagRecordings, LeavesOutFramesWhoseTimeRunsBackwards) {
  const auto bag = beginStereo();
  std::int64_t recorded_ns = 0;
  for (const double s : {0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.4}) {
    recorded_ns += 100'000'000;
    bag->write(left_, recorded_ns, image(s, "bgr8", 10, 3));
    bag->write(right_, recorded_ns, image(s, "mono8", 90, 1));
  }
  bag->commit();
  const Read read = readAll(path());
  EXPECT_THAT(read.stamps_s, ElementsAre(0.1, 0.2, 0.3, 0.4));
  ASSERT_THAT(read.skipped, SizeIs(3));
  EXPECT_THAT(read.skipped[0].reason, HasSubstr("backwards, from 0.3"));
}

TEST_P(BagRecordings, WithOneStampFarAheadLoseThatFrameAlone) {
  for (const bool left : {true, false}) {
    const auto bag = beginStereo();
    for (int i = 1; i <= 100; ++i) {
      // The left one comes first: its partner is waited for.
      const std::int64_t recorded_ns = i * 100'000'000LL;
      const double s = 0.1 * i, wrong_s = i == 50 ? 1e6 : s;
      bag->write(left_, recorded_ns, image(left ? wrong_s : s, "bgr8", 10, 3));
      bag->write(right_, recorded_ns + 1, image(left ? s : wrong_s, "mono8", 90, 1));
    }
    bag->commit();
    const Read read = readAll(path());
    EXPECT_THAT(read.numbers, SizeIs(99));
    EXPECT_NEAR(read.info.duration_s, 9.9, 1e-6);
    ASSERT_THAT(read.skipped, SizeIs(1));
    EXPECT_EQ(read.skipped[0].number, 50U);
    EXPECT_THAT(read.skipped[0].reason, HasSubstr(left ? "jumps ahead to 1000000" : "no image on"));
  }
}

TEST_P(BagRecordings, FindsTheCameraOnTheRobotInTf) {
  const auto bag = beginStereo();
  TFMessageMsg message;
  TransformStampedMsg camera;
  camera.header = header(0.0, "/base_link");
  camera.child_frame_id = "optical";
  camera.transform.translation.z = 1.5;
  message.transforms = {camera};
  camera.header.frame_id = "base_footprint";
  camera.child_frame_id = "base_link";
  camera.transform.translation.z = 0.25;
  message.transforms.push_back(camera);
  bag->write("/tf_static", 1, message, true);
  addLeft(*bag, 0.1);
  addRight(*bag, 0.1);
  bag->commit();
  const Read read = readAll(path());
  ASSERT_TRUE(read.info.T_base_camera);
  EXPECT_DOUBLE_EQ(read.info.T_base_camera->translation().z(), 1.75);
  BagTopics topics;
  topics.base_frame = "base_link";
  EXPECT_DOUBLE_EQ(readAll(path(), topics).info.T_base_camera->translation().z(), 1.5);
  topics.base_frame = "torso";
  EXPECT_THAT(messageOf([&] { readAll(path(), topics); }),
              HasSubstr("is on 'torso'; it is on 'base_footprint', 'base_link'"));
}

TEST(Ros1Pieces, KnowInTheLastWhatTfAndCameraInfoSaidInTheFirst) {
  const TempFolder folder;
  TFMessageMsg tf;
  tf.transforms.resize(1);
  tf.transforms[0].header = header(0.0, "base_link");
  tf.transforms[0].child_frame_id = "optical";
  tf.transforms[0].transform.translation.z = 1.5;
  for (const int piece : {0, 1}) {
    const auto bag = createBag(folder / ("pieces/robot_" + std::to_string(piece) + ".bag"));
    if (piece == 0) {
      bag->write("/tf_static", 1, tf, true);
      bag->write("/left/camera_info", 1, cameraInfo(0.0));
      bag->write("/right/camera_info", 1, cameraInfo(-3.0));
    }
    for (int i = 1; i <= 30; ++i) {
      const double s = 3.0 * piece + 0.1 * i;
      for (const char* topic : {"/left/image_raw", "/right/image_raw"}) {
        bag->write(topic, std::llround(s * 1e9), image(s, "mono8", i, 1));
      }
    }
    bag->commit();
  }
  for (const double from_s : {0.0, 4.0}) {
    TimeSpan span;
    span.from_s = from_s;
    const Read read = readAll(folder / "pieces", {}, span);
    EXPECT_THAT(read.numbers, SizeIs(from_s == 0.0 ? 60 : 21)) << from_s;
    EXPECT_DOUBLE_EQ(read.stamps_s.back(), 6.0);
    ASSERT_TRUE(read.info.T_base_camera) << from_s;
    EXPECT_EQ(read.info.T_base_camera->translation().z(), 1.5);
    EXPECT_THAT(read.skipped, IsEmpty());
  }
}

TEST_P(BagRecordings, OfStereoWithoutABaselineTakeTfs) {
  const auto open = [&](const Eigen::Isometry3d& T_left_right) {
    TFMessageMsg tf;
    tf.transforms.resize(1);
    tf.transforms[0].header = header(0.0, "left_optical");
    tf.transforms[0].child_frame_id = "right_optical";
    TransformMsg& T = tf.transforms[0].transform;
    T.translation.x = T_left_right.translation().x();
    T.translation.y = T_left_right.translation().y();
    const Eigen::Quaterniond q(T_left_right.linear());
    T.rotation.y = q.y();
    T.rotation.w = q.w();
    const auto bag = createBag(path());
    bag->write("/tf_static", 1, tf, true);
    for (const std::string side : {"left", "right"}) {
      ImageMsg picture = image(0.1, "mono8", 90, 1);
      picture.header.frame_id = side + "_optical";
      bag->write("/stereo/" + side + "/camera_info", 1, cameraInfo(0.0));
      bag->write("/stereo/" + side + "/image_rect", 100'000'000, picture);
    }
    bag->commit();
    return readAll(path()).info.camera.baseline_m;
  };
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = 0.12;
  EXPECT_NEAR(open(T), 0.12, 1e-12);
  T.translation().y() = 0.05;
  EXPECT_THAT(messageOf([&] { open(T); }), HasSubstr("there is no baseline")) << "one is higher";
  T.translation().y() = 0.0;
  T.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));
  EXPECT_THAT(messageOf([&] { open(T); }), HasSubstr("there is no baseline")) << "one is turned";
}

TEST_P(BagRecordings, TakesATopicByItsNameWithoutWhatCompressionAddsToIt) {
  const auto bag = beginStereo();
  for (const auto& [topic, value] : {std::pair(left_, 10), std::pair(right_, 90)}) {
    CompressedImageMsg message;
    message.header = header(0.1);
    message.format = "bgr8; png compressed bgr8";
    cv::imencode(".png", cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(value)), message.data);
    bag->write(topic + "/compressed", 100'000'000, message);
  }
  bag->commit();
  BagTopics topics;
  topics.left = left_;
  topics.right = right_;
  const Read read = readAll(path(), topics);
  EXPECT_THAT(read.numbers, ElementsAre(1));
  EXPECT_EQ(read.last.right_bgr.at<cv::Vec3b>(3, 3), cv::Vec3b(90, 90, 90));
}

TEST_P(BagRecordings, NamesTheTopicsWhereThereIsNoCamera) {
  const auto bag = createBag(path());
  bag->write("/scan", 1, LaserScanMsg());
  bag->commit();
  EXPECT_THAT(messageOf([&] { readAll(path()); }),
              HasSubstr("its topics are /scan (sensor_msgs/LaserScan)"));
  BagTopics topics;
  topics.left = "/a";
  topics.right = "/b";
  EXPECT_THAT(messageOf([&] { readAll(path(), topics); }),
              HasSubstr("no messages of the topic '/a'"));
  topics.right = "";
  EXPECT_THAT(messageOf([&] { readAll(path(), topics); }), HasSubstr("needs both"));
}

TEST_P(BagRecordings, SaysThatACameraHasNoCalibration) {
  const auto bag = createBag(path());
  left_ = "/left/image_raw";
  right_ = "/right/image_raw";
  addLeft(*bag, 0.1);
  addRight(*bag, 0.1);
  bag->commit();
  EXPECT_THAT(messageOf([&] { readAll(path()); }), HasSubstr("no camera_info"));
}

TEST_P(BagRecordings, WithoutAMessageAreAnError) {
  createBag(path())->commit();
  EXPECT_THAT(messageOf([&] { readAll(path()); }), HasSubstr("no message in the bag"));
}

TEST_P(BagRecordings, ReadsDepthInMillimetresAndInMetres) {
  for (const bool metres : {false, true}) {
    const auto bag = createBag(path());
    ImageMsg depth = image(0.1, metres ? "32FC1" : "16UC1", 0, metres ? 4 : 2);
    const std::uint16_t mm = 1500;
    const float m = 1.5F;
    std::memcpy(&depth.data[depth.step], metres ? static_cast<const void*>(&m) : &mm,
                metres ? 4 : 2);
    bag->write("/camera/rgb/camera_info", 1, cameraInfo(0.0));
    bag->write("/camera/depth_registered/image_raw", 100000000, depth);
    bag->write("/camera/rgb/image_raw", 100000000, image(0.1, "rgb8", 7, 3));
    bag->commit();
    const Read read = readAll(path());
    EXPECT_EQ(read.info.sensor, SensorKind::kRgbd);
    ASSERT_THAT(read.numbers, ElementsAre(1));
    EXPECT_FLOAT_EQ(read.last.depth_m.at<float>(1, 0), 1.5F);
    EXPECT_TRUE(std::isnan(read.last.depth_m.at<float>(0, 0)));
  }
}

/// A camera whose depth is of a frame of its own, 0.1 m to the left of the colour's: at 1 m, what
/// it sees is 3 px further to the left in the colour image.
std::unique_ptr<BagWriter> beginUnregistered(const std::filesystem::path& path,
                                             const std::string& camera, bool with_tf) {
  auto bag = createBag(path);
  CameraInfoMsg info = cameraInfo(0.0);
  bag->write(camera + "/color/camera_info", 1, info);
  info.header.frame_id = "depth_optical";
  bag->write(camera + "/depth/camera_info", 1, info);
  ImageMsg depth = image(0.1, "16UC1", 0, 2);
  depth.header.frame_id = "depth_optical";
  const std::uint16_t mm = 1000;
  std::memcpy(&depth.data[10 * depth.step + 2 * 20], &mm, 2);
  bag->write(camera + "/depth/image_rect_raw", 100000000, depth);
  bag->write(camera + "/color/image_raw", 100000000, image(0.1, "rgb8", 7, 3));
  if (!with_tf) return bag;
  TFMessageMsg message;
  TransformStampedMsg link;
  link.header = header(0.1, "camera_link");
  link.child_frame_id = "optical";
  link.transform.translation.x = 0.1;
  message.transforms.push_back(link);
  link.child_frame_id = "depth_optical";
  link.transform.translation.x = 0.0;
  message.transforms.push_back(link);
  bag->write("/tf_static", 1, message, true);
  return bag;
}

/// An image whose brightness is eight times the column.
ImageMsg rampImage(double stamp_s) {
  ImageMsg ramp = image(stamp_s, "mono8", 0, 1);
  for (std::size_t i = 0; i < ramp.data.size(); ++i) {
    ramp.data[i] = static_cast<std::uint8_t>(8 * std::min<std::size_t>(i % ramp.step, 31));
  }
  return ramp;
}

/// Depth of 10 mm times the column, and 1 m.
ImageMsg rampDepth(double stamp_s) {
  ImageMsg ramp = image(stamp_s, "16UC1", 0, 2);
  for (std::size_t v = 0; v < kHeight; ++v) {
    for (std::size_t u = 0; u < kWidth; ++u) {
      const auto mm = static_cast<std::uint16_t>(1000 + 10 * u);
      std::memcpy(&ramp.data[v * ramp.step + 2 * u], &mm, sizeof mm);
    }
  }
  return ramp;
}

TEST_P(BagRecordings, TakeTheDistortionOutByItsModel) {
  const auto readWith = [&](const std::string& model, std::vector<double> D) {
    CameraInfoMsg info = cameraInfo(0.0);
    info.distortion_model = model;
    info.D = std::move(D);
    const auto bag = createBag(path());
    bag->write("/rgb/camera_info", 1, info);
    bag->write("/rgb/image_raw", 100'000'000, rampImage(0.1));
    bag->write("/depth/image_raw", 100'000'000, rampDepth(0.1));
    bag->commit();
    return readAll(path()).last;
  };
  // The pixel (27, 20), and its column in the raw image.
  const double x = 11.5 / 30, y = 8.5 / 30, r = std::hypot(x, y), theta = std::atan(r);
  const auto columnOf = [](double scale) { return 15.5 + 11.5 * scale; };
  const std::tuple<const char*, std::vector<double>, double> models[] = {
      {"equidistant",
       {-0.3, 0.1, 0.0, 0.0},
       columnOf(theta * (1 - 0.3 * std::pow(theta, 2) + 0.1 * std::pow(theta, 4)) / r)},
      {"plumb_bob", {-0.3, 0.1, 0.0, 0.0, 0.0}, columnOf(1 - 0.3 * r * r + 0.1 * std::pow(r, 4))},
      {"", {-0.3, 0.1, 0.0, 0.0}, columnOf(1 - 0.3 * r * r + 0.1 * std::pow(r, 4))},
      {"", {}, 27.0},
      {"made_up", {0.0, 0.0}, 27.0}};
  for (const auto& [model, D, column] : models) {
    const Frame frame = readWith(model, D);
    ASSERT_FALSE(frame.image_bgr.empty()) << model;
    EXPECT_NEAR(frame.image_bgr.at<cv::Vec3b>(20, 27)[0] / 8.0, column, 0.1) << model;
    EXPECT_NEAR(frame.depth_m.at<float>(20, 27), 1.0 + 0.01 * std::round(column), 1e-6) << model;
  }
  EXPECT_THAT(messageOf([&] {
                readWith("made_up", {-0.3, 0.1, 0.0, 0.0});
              }),
              AllOf(HasSubstr(path().string() + ", camera_info of /rgb/image_raw"),
                    HasSubstr("the distortion model made_up is not known")));
}

TEST_P(BagRecordings, RegisterDepthOfAnotherFrameToColour) {
  beginUnregistered(path(), "/camera", true)->commit();
  const Read read = readAll(path());
  ASSERT_THAT(read.numbers, ElementsAre(1));
  EXPECT_FLOAT_EQ(read.last.depth_m.at<float>(10, 17), 1.0F);
  EXPECT_TRUE(std::isnan(read.last.depth_m.at<float>(10, 20)));
  EXPECT_THAT(read.info.layout, HasSubstr("registered by Heel"));
  EXPECT_THAT(read.info.warnings, IsEmpty());
}

TEST_P(BagRecordings, SayThatDepthCannotBeRegisteredWithoutTf) {
  beginUnregistered(path(), "/camera", false)->commit();
  EXPECT_THAT(messageOf([&] { readAll(path()); }),
              HasSubstr("/camera/depth/image_rect_raw: depth is not registered to the colour of "
                        "/camera/color/image_raw, and tf does not tell where 'depth_optical' is "
                        "from 'optical'"));
}

TEST_P(BagRecordings, TakeAPngOf16BitsForDepth) {
  for (const char* format : {"16UC1; png compressed ", "mono16; png compressed "}) {
    CompressedImageMsg depth;
    depth.header = header(0.1);
    depth.format = format;
    cv::Mat raw(kHeight, kWidth, CV_16UC1, cv::Scalar(2500));
    raw.at<std::uint16_t>(0, 0) = 0;
    cv::imencode(".png", raw, depth.data);
    const auto bag = createBag(path());
    bag->write("/camera/rgb/camera_info", 1, cameraInfo(0.0));
    bag->write("/camera/rgb/image_raw", 100'000'000, image(0.1, "rgb8", 90, 3));
    bag->write("/camera/depth_registered/image_raw/compressed", 100'000'000, depth);
    bag->commit();
    const Read read = readAll(path());
    ASSERT_EQ(read.info.sensor, SensorKind::kRgbd) << format;
    EXPECT_FLOAT_EQ(read.last.depth_m.at<float>(5, 5), 2.5F) << format;
    EXPECT_TRUE(std::isnan(read.last.depth_m.at<float>(0, 0))) << format;
  }
}

/// Infrared, heat, and how sure depth is come in the encodings of depth, too.
class OtherImages : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<BagWriter> begin() {
    auto bag = createBag(folder_ / "r.bag");
    bag->write("/camera/a/camera_info", 1, cameraInfo(0.0));
    bag->write(GetParam(), 100'000'000, image(0.1, "16UC1", 2, 2));
    bag->write("/camera/a/image_color", 100'000'000, image(0.1, "rgb8", 90, 3));
    return bag;
  }
  Frame read() const { return readAll(folder_ / "r.bag").last; }
  TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Names, OtherImages,
                         testing::Values("/camera/a_ir/image_raw", "/camera/a/image_ir_rect",
                                         "/camera/ir2/image_raw", "/camera/infra1/image_raw",
                                         "/a/thermal/image_raw", "/a/confidence/confidence_map",
                                         "/a/Infrared_0/image/data", "/camera/amplitude"));

TEST_P(OtherImages, AreNotTakenForDepth) {
  const auto bag = begin();
  bag->write("/camera/sd/image", 100'000'000, image(0.1, "16UC1", 4, 2));
  bag->commit();
  EXPECT_NEAR(read().depth_m.at<float>(5, 5), 0.001 * 0x404, 1e-6);
}

TEST_P(OtherImages, AloneAreNoDepth) {
  begin()->commit();
  EXPECT_THAT(messageOf([&] { read(); }), HasSubstr("no colour with depth images"));
}

TEST_P(OtherImages, AreNotTakenForColour) {
  const auto bag = createBag(folder_ / "r.bag");
  bag->write("/camera/a/camera_info", 1, cameraInfo(0.0));
  bag->write(GetParam(), 100'000'000, image(0.1, "mono8", 2, 1));
  bag->write("/camera/a/image", 100'000'000, image(0.1, "rgb8", 90, 3));
  bag->write("/camera/a/depth", 100'000'000, image(0.1, "16UC1", 4, 2));
  bag->commit();
  EXPECT_EQ(read().image_bgr.at<cv::Vec3b>(5, 5), cv::Vec3b(90, 90, 90));
}

TEST_P(BagRecordings, PreferDepthThatIsNamedSo) {
  const auto bag = createBag(path());
  bag->write("/camera/camera_info", 1, cameraInfo(0.0));
  bag->write("/camera/range/image_rect", 100'000'000, image(0.1, "16UC1", 2, 2));
  bag->write("/depth_camera/ir/image_rect", 100'000'000, image(0.1, "16UC1", 3, 2));
  bag->write("/depth_camera/sd/image", 100'000'000, image(0.1, "16UC1", 4, 2));
  bag->write("/camera/image_raw", 100'000'000, image(0.1, "rgb8", 90, 3));
  bag->commit();
  EXPECT_NEAR(readAll(path()).last.depth_m.at<float>(5, 5), 0.001 * 0x404, 1e-6);
}

TEST_P(BagRecordings, NameTheCameraThatIsReadOfTwo) {
  const auto bag = beginUnregistered(path(), "/front", true);
  bag->write("/rear/color/image_raw", 100000000, image(0.1, "rgb8", 7, 3));
  bag->write("/rear/depth/image_rect_raw", 100000000, image(0.1, "16UC1", 0, 2));
  bag->commit();
  const Read read = readAll(path());
  ASSERT_THAT(read.info.warnings, SizeIs(1));
  EXPECT_THAT(read.info.warnings[0],
              HasSubstr("what is read is /front/color/image_raw with /front/depth/image_rect_raw, "
                        "not /rear/color/image_raw and 1 more"));
}

/// Stereo images in a frame that tf turns so on base_link.
void writeTurned(const std::filesystem::path& path, const Eigen::Quaterniond& turn) {
  const auto bag = createBag(path);
  TFMessageMsg message;
  TransformStampedMsg camera;
  camera.header = header(0.1, "base_link");
  camera.child_frame_id = "optical";
  camera.transform.translation.z = 1.5;
  camera.transform.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
  message.transforms = {camera};
  bag->write("/tf_static", 100'000'000, message, true);
  bag->write("/left/camera_info", 100'000'000, cameraInfo(0.0));
  bag->write("/right/camera_info", 100'000'000, cameraInfo(-3.0));
  bag->write("/left/image_raw", 100'000'000, image(0.1, "bgr8", 10, 3));
  bag->write("/right/image_raw", 100'000'000, image(0.1, "bgr8", 10, 3));
  bag->commit();
}

TEST_P(BagRecordings, AnImageFrameThatIsABodysIsTakenAsOptical) {
  // A camera that looks to the left by 0.3 and down by 0.1, as the axes of its body have it.
  const Eigen::Quaterniond body = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
  writeTurned(path(), body);
  const Read read = readAll(path());
  const Eigen::Isometry3d& T = *read.info.T_base_camera;
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.0, 0.0, 1.5)));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitZ()).isApprox(body * Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(body * -Eigen::Vector3d::UnitY()));
  EXPECT_EQ(read.info.base_frame, "base_link");
  EXPECT_THAT(read.info.warnings, ElementsAre(HasSubstr("the images' frame 'optical' looks like a "
                                                        "body's (X ahead, Z up)")));
}

TEST_P(BagRecordings, AnOpticalFrameIsTakenAsItIs) {
  // Steeply down, which is what comes nearest to a body's frame of all that people mount.
  const Eigen::Quaterniond optical = Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitZ()) *
                                     Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitX());
  writeTurned(path(), optical);
  const Read read = readAll(path());
  EXPECT_TRUE(read.info.T_base_camera->linear().isApprox(optical.toRotationMatrix()));
  EXPECT_THAT(read.info.warnings, IsEmpty());
}

TEST_P(BagRecordings, GiveBackWhatASensorBagWasGiven) {
  RecordingInfo info;
  info.camera.left = {kWidth, kHeight, 30.1, 30.2, 15.3, 11.4};
  info.sensor = SensorKind::kRgbd;
  info.T_base_camera = asInBags(Eigen::Translation3d(0.1, 0.2, 1.3) *
                                Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()));
  Frame frame;
  frame.image_bgr = cv::Mat(kHeight, kWidth, CV_8UC3);
  cv::randu(frame.image_bgr, 0, 255);
  frame.depth_m = cv::Mat(kHeight, kWidth, CV_32FC1);
  cv::randu(frame.depth_m, 0.5, 6.0);
  SensorBag bag(path(), info);
  for (int i = 1; i <= 20; ++i) {
    frame.stamp_s = i / 30.0;
    bag.add(frame);
  }
  bag.commit();
  const Read read = readAll(path());
  EXPECT_THAT(read.numbers, SizeIs(20));
  EXPECT_EQ(read.info.camera.left.fx, info.camera.left.fx);
  EXPECT_EQ(read.info.camera.left.cy, info.camera.left.cy);
  EXPECT_TRUE(read.info.T_base_camera->isApprox(*info.T_base_camera, 1e-15));
  EXPECT_EQ(cv::norm(read.last.image_bgr, frame.image_bgr), 0.0);
  EXPECT_EQ(cv::norm(read.last.depth_m, frame.depth_m), 0.0);
  EXPECT_NEAR(read.stamps_s.back(), 20 / 30.0, 1e-9);
}

TEST_P(BagRecordings, OfCloudsGiveTheirColoursAsAnImage) {
  auto cloud = pcl::make_shared<ColorCloud>(4, 3);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    auto& p = (*cloud)[i];
    p.x = p.y = 0.0F;
    p.z = static_cast<float>(i);
    p.r = 200;
  }
  Frame frame;
  frame.cloud = cloud;
  frame.stamp_s = 1.5;
  RecordingInfo info;
  info.sensor = SensorKind::kCloud;
  SensorBag bag(path(), info);
  bag.add(frame);
  bag.commit();
  const Read read = readAll(path());
  ASSERT_THAT(read.stamps_s, ElementsAre(1.5));
  EXPECT_EQ(read.last.cloud->at(3, 2).z, 11.0F);
  EXPECT_EQ(read.last.image_bgr.at<cv::Vec3b>(2, 3), cv::Vec3b(0, 0, 200));
}

TEST_P(BagRecordings, OfCloudsMayHavePlacesOf64Bits) {
  constexpr std::uint8_t kFloat32 = 7, kFloat64 = 8;
  PointCloud2Msg cloud;
  cloud.header = header(1.5);
  cloud.width = 1;
  cloud.height = 2;
  cloud.points_fields = {{"x", 0, kFloat64, 1},
                         {"y", 8, kFloat64, 1},
                         {"z", 16, kFloat64, 1},
                         {"rgb", 24, kFloat32, 1}};
  cloud.point_step = 28;
  cloud.row_step = 40;  // rows may be padded
  cloud.data.assign(80, 0);
  const double places[2][3] = {{0.1, -2.0, 3.0}, {1e300, 5.0, 6.0}};
  for (std::size_t row = 0; row < 2; ++row) {
    std::memcpy(&cloud.data[row * 40], places[row], sizeof places[row]);
    cloud.data[row * 40 + 26] = 200;
  }
  const auto bag = createBag(path());
  bag->write("/points", 1500000000, cloud);
  bag->commit();
  const Read read = readAll(path());
  ASSERT_THAT(read.stamps_s, ElementsAre(1.5));
  EXPECT_EQ(read.last.cloud->at(0, 0).getVector3fMap(), Eigen::Vector3f(0.1F, -2.0F, 3.0F));
  EXPECT_EQ(read.last.cloud->at(0, 0).r, 200);
  EXPECT_EQ(read.last.cloud->at(0, 1).z, 6.0F);
  EXPECT_FALSE(read.last.cloud->is_dense) << "1e300 is no float of 32 bits";
}

TEST_P(BagRecordings, ThatAreCutOffGiveTheirBeginning) {
  auto bag = beginStereo();
  for (int i = 1; i <= 2000; ++i) {
    addLeft(*bag, 0.1 * i);
    addRight(*bag, 0.1 * i);
  }
  bag->commit();
  test::truncateBy(path(), std::filesystem::file_size(path()) / 2);
  const Read read = readAll(path());
  EXPECT_THAT(read.numbers.size(), testing::AllOf(testing::Gt(600U), testing::Lt(1400U)));
  EXPECT_THAT(read.info.lost, HasSubstr("cut off"));
  EXPECT_THAT(readAll(path(), {}, {9.95, 11.95}).numbers, SizeIs(20));
}

TEST_P(BagRecordings, GiveScansWithTheLatestOdometry) {
  SensorBag bag(path(), {});
  Eigen::Isometry3d T_base_scanner = Eigen::Isometry3d::Identity();
  T_base_scanner.translation() = Eigen::Vector3d(0.2, 0.0, 0.3);
  bag.setScanner(T_base_scanner, 10.0F);
  for (int i = 0; i < 4; ++i) {
    const double s = 0.1 * i;
    bag.addTruth(s, {{1.0 * i, 2.0}, 0.5}, {});
    bag.addOdometry(s, {{1.0 * i, 0.0}, 0.25});
    if (i % 2 == 1) bag.add(s, LaserScan{-1.5, 0.5, {1.0F, 12.0F, 3.0F}});
  }
  bag.commit();
  const auto log = openLaserLog(path());
  ASSERT_TRUE(log->T_base_scanner());
  EXPECT_DOUBLE_EQ(log->T_base_scanner()->position.x(), 0.2);
  LaserReading reading;
  ASSERT_TRUE(log->next(reading));
  ASSERT_TRUE(log->next(reading));
  EXPECT_DOUBLE_EQ(reading.stamp_s, 0.3);
  EXPECT_THAT(reading.scan.ranges_m,
              ElementsAre(1.0F, std::numeric_limits<float>::infinity(), 3.0F));
  EXPECT_DOUBLE_EQ(reading.odometry.position.x(), 3.0);
  EXPECT_NEAR(reading.odometry.yaw_rad, 0.25, 1e-12);
  ASSERT_TRUE(reading.reference);
  EXPECT_DOUBLE_EQ(reading.reference->position.y(), 2.0);
  EXPECT_FALSE(log->next(reading));
  EXPECT_THAT(readBagPoses(path(), {}), SizeIs(4));
}

TEST(BagImageReader, KnowsTheBayerPatternByItsFirstRow) {
  ImageMsg message = image(0.0, "bayer_rggb8", 0, 1);
  for (std::size_t v = 0; v < kHeight; v += 2) {  // only the red pixels have light
    for (std::size_t u = 0; u < kWidth; u += 2) message.data[v * message.step + u] = 200;
  }
  cv::Mat bgr;
  BagImageReader().readColor(message, bgr);
  EXPECT_EQ(bgr.at<cv::Vec3b>(10, 10), cv::Vec3b(0, 0, 200));
}

TEST(BagImageReader, KnowsTheBayerPatternOfACompressedImageToo) {
  cv::Mat mosaic(kHeight, kWidth, CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < kHeight; v += 2) {  // only the red pixels have light
    for (int u = 0; u < kWidth; u += 2) mosaic.at<std::uint8_t>(v, u) = 200;
  }
  CompressedImageMsg message;
  cv::Mat bgr;
  BagImageReader reader;
  for (const char* ending : {".png", ".jpg"}) {
    message.format = "bayer_rggb8; jpeg compressed ";
    cv::imencode(ending, mosaic, message.data, {cv::IMWRITE_JPEG_QUALITY, 100});
    reader.readColor(message, bgr);
    ASSERT_EQ(bgr.type(), CV_8UC3);
    EXPECT_LE(cv::norm(bgr.at<cv::Vec3b>(10, 10), cv::Vec3b(0, 0, 200), cv::NORM_INF), 3) << ending;
  }
  message.format = "bayer_rggb8; jpeg compressed bgr8";  // a colour image already
  cv::imencode(".png", cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(10, 20, 30)), message.data);
  reader.readColor(message, bgr);
  EXPECT_EQ(bgr.at<cv::Vec3b>(10, 10), cv::Vec3b(10, 20, 30));
  message.format = "bayer_xyz; jpeg compressed ";
  cv::imencode(".png", mosaic, message.data);
  EXPECT_THAT(messageOf([&] { reader.readColor(message, bgr); }), HasSubstr("'bayer_xyz; jpeg"));
}

TEST(BagImageReader, ReadsCompressedDepth) {
  cv::Mat raw(kHeight, kWidth, CV_16UC1, cv::Scalar(2000));
  raw.at<std::uint16_t>(0, 0) = 0;
  std::vector<std::uint8_t> png;
  cv::imencode(".png", raw, png);
  CompressedImageMsg message;
  message.format = "16UC1; compressedDepth";
  message.data.assign(12, 0);
  message.data.insert(message.data.end(), png.begin(), png.end());
  cv::Mat depth_m;
  BagImageReader reader;
  reader.readDepth(message, depth_m);
  EXPECT_FLOAT_EQ(depth_m.at<float>(5, 5), 2.0F);
  EXPECT_TRUE(std::isnan(depth_m.at<float>(0, 0)));
  message.format = "32FC1; compressedDepth png";  // inverse depth: a / (value - b)
  const float a = 4000.0F, b = 1000.0F;
  std::memcpy(&message.data[4], &a, 4);
  std::memcpy(&message.data[8], &b, 4);
  reader.readDepth(message, depth_m);
  EXPECT_FLOAT_EQ(depth_m.at<float>(5, 5), 4.0F);
  message.data.resize(20);
  EXPECT_THAT(messageOf([&] { reader.readDepth(message, depth_m); }), HasSubstr("truncated"));
}

TEST(BagImageReader, SaysWhatItCannotRead) {
  cv::Mat out;
  BagImageReader reader;
  EXPECT_THAT(messageOf([&] { reader.readColor(image(0, "nv12", 0, 3), out); }),
              HasSubstr("'nv12'"));
  ImageMsg shorter = image(0, "bgr8", 0, 3);
  shorter.data.resize(100);
  EXPECT_THAT(messageOf([&] { reader.readColor(shorter, out); }), HasSubstr("fewer bytes"));
}

TEST(RealBags, AreListedRight) {
  HEEL_NEED_DATA("laser_bags/demo_stationary_simple_environment.bag");
  const BagSurvey survey =
      surveyBag(test::dataFolder() / "laser_bags/demo_stationary_simple_environment.bag");
  ASSERT_THAT(survey.topics, SizeIs(1));
  const BagTopicSummary& scans = survey.topics[0];
  EXPECT_EQ(scans.topic.name, "/scan");
  EXPECT_TRUE(scans.topic.holds<LaserScanMsg>());
  EXPECT_EQ(scans.count, 1265U);
  EXPECT_EQ(scans.frame_id, "laser");
  EXPECT_NEAR(scans.duration_s(), 126.0, 0.1);
  EXPECT_THAT(survey.lost, IsEmpty());
}

TEST(RealBags, OfScansAloneSayThatThereIsNoOdometry) {
  HEEL_NEED_DATA("laser_bags/demo_stationary_simple_environment.bag");
  const auto path = test::dataFolder() / "laser_bags/demo_stationary_simple_environment.bag";
  EXPECT_THAT(messageOf([&] { openLaserLog(path); }), HasSubstr("no odometry"));
}

}  // namespace
}  // namespace heel
