// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/fuzz/readers.hpp"

#include "tests/support/cloud_files.hpp"
#include "tests/support/filled_message.hpp"
#include <heel/apps/bag/bag.hpp>
#include <heel/apps/recording/bags/bag_cloud.hpp>
#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/bags/bag_survey.hpp>
#include <heel/apps/recording/bags/sensor_bag.hpp>
#include <heel/apps/recording/camera_file.hpp>
#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/apps/recording/recording.hpp>
#include <heel/apps/recording/stamps.hpp>
#include <heel/apps/results/result_files.hpp>
#include <heel/apps/simulation/scene.hpp>
#include <heel/cloud/stereo_calibration.hpp>
#include <heel/mapping/map_files.hpp>
#include <heel/mapping/wall_map_builder.hpp>
#include <heel/planning/following_plan.hpp>
#include <heel/planning/plan_file.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <opencv2/imgcodecs.hpp>

namespace heel::test {
namespace {

namespace fs = std::filesystem;
using Seeds = std::vector<std::string>;

fs::path put(const fs::path& folder, const std::string& name, const std::string& bytes) {
  writeText(folder / name, bytes);
  return folder / name;
}

/// Reads the bytes as a file of that name.
template <class Read>
auto fromFile(const char* name, const Read& read) {
  return [=](const fs::path& folder, const std::string& bytes) { read(put(folder, name, bytes)); };
}

auto seed(const std::string& text) {
  return [=](const fs::path&) { return Seeds{text}; };
}

template <class Draw>
std::string drawn(const fs::path& folder, const std::string& name, const Draw& draw) {
  draw(folder / name);
  return readText(folder / name);
}

Seeds cloudSeeds(const fs::path& folder, const std::string& ending) {
  const auto ascii = folder / ("ascii" + ending);
  if (ending == ".pcd") {
    writeAsciiPcd(ascii, {pcdPoint(1, 2, 3, 4, 5, 6), "nan nan nan 0"});
  } else {
    writeAsciiPly(ascii, {"1 2 3 4 5 6", "7 8 9 1 2 3"});
  }
  return {readText(ascii), drawn(folder, "packed" + ending, [&](const fs::path& file) {
            writeCloud(file, readCloud(ascii));
          })};
}

void readLog(const fs::path& file) {
  const auto log = openLaserLog(file);
  for (LaserReading reading; log->next(reading);) continue;
}

/// All of it, as a recording if it has a camera, and as a log if it has not.
void readBag(const fs::path& file) {
  surveyBag(file);
  const auto bag = openBag(file);
  for (BagMessage raw; bag->next(raw);) continue;
  std::unique_ptr<Recording> recording;
  try {
    recording = openRecording(file);
  } catch (const std::runtime_error&) {
    return readLog(file);
  }
  for (Frame frame; recording->next(frame);) continue;
  if (!recording->skipped().empty()) throw std::runtime_error(recording->skipped()[0].reason);
}

/// A message that its readers take.
template <class Message>
Message sound() {
  Message message = filled<Message>();
  const cv::Mat image(3, 4, CV_8UC3, cv::Scalar(1, 2, 3));
  if constexpr (std::is_same_v<Message, PointCloud2Msg>) {
    ColorCloud cloud;
    cloud.push_back({1.0F, 2.0F, 3.0F, 4, 5, 6});
    message = toCloudMsg(cloud);
  } else if constexpr (std::is_same_v<Message, ImageMsg>) {
    message.width = 4;
    message.height = 3;
    message.encoding = "bgr8";
    message.is_bigendian = 0;
    message.step = 12;
    message.data.assign(image.datastart, image.dataend);
  } else if constexpr (std::is_same_v<Message, CompressedImageMsg>) {
    message.format = "png";
    cv::imencode(".png", image, message.data);
  }
  return message;
}

Seeds bagSeeds(const fs::path& folder, const std::string& ending) {
  const auto drawCamera = [](const fs::path& file) {
    RecordingInfo info;
    info.sensor = SensorKind::kRgbd;
    info.camera.left = {4, 3, 5.0, 5.0, 1.5, 1.0};
    SensorBag bag(file, info);
    Frame frame;
    frame.image_bgr = cv::Mat(3, 4, CV_8UC3, cv::Scalar(1, 2, 3));
    frame.depth_m = cv::Mat(3, 4, CV_32FC1, cv::Scalar(2.0));
    for (; frame.stamp_s < 0.3; frame.stamp_s += 0.1) bag.add(frame);
    bag.commit();
  };
  const auto drawCloud = [](const fs::path& file) {
    RecordingInfo info;
    info.sensor = SensorKind::kCloud;
    SensorBag bag(file, info);
    Frame frame;
    frame.cloud = toColorCloud(sound<PointCloud2Msg>());
    bag.add(frame);
    bag.commit();
  };
  const auto drawOthers = [](const fs::path& file) {
    const auto bag = createBag(file);
    bag->write("/scan", 2, filled<LaserScanMsg>());
    bag->write("/odom", 3, filled<OdometryMsg>());
    bag->write("/tf", 4, filled<TFMessageMsg>());
    bag->commit();
  };
  return {drawn(folder, "camera" + ending, drawCamera), drawn(folder, "cloud" + ending, drawCloud),
          drawn(folder, "others" + ending, drawOthers)};
}

/// The first byte tells which message the others are.
template <class... Messages>
struct MessageList {
  static void read(BagForm form, const std::string& bytes) {
    if (bytes.empty()) return;
    std::size_t i = 0;
    const std::size_t chosen = static_cast<std::uint8_t>(bytes[0]) % sizeof...(Messages);
    (void)((i++ == chosen && (readOne<Messages>(form, bytes), true)) || ...);
  }
  static Seeds seeds(BagForm form) {
    Seeds all;
    (all.push_back(seedOf<Messages>(form, all.size())), ...);
    return all;
  }

 private:
  template <class Message>
  static void readOne(BagForm form, const std::string& bytes) {
    Message message;
    readMessage(form, reinterpret_cast<const std::uint8_t*>(bytes.data()) + 1, bytes.size() - 1,
                message);
    cv::Mat image;
    BagImageReader images;
    if constexpr (std::is_same_v<Message, PointCloud2Msg>) toColorCloud(message);
    if constexpr (std::is_same_v<Message, ImageMsg> ||
                  std::is_same_v<Message, CompressedImageMsg>) {
      isDepthEncoding(textOf(message)) ? images.readDepth(message, image)
                                       : images.readColor(message, image);
    }
  }
  static const std::string& textOf(const ImageMsg& message) { return message.encoding; }
  static const std::string& textOf(const CompressedImageMsg& message) { return message.format; }

  template <class Message>
  static std::string seedOf(BagForm form, std::size_t i) {
    std::vector<std::uint8_t> bytes;
    writeMessage(form, sound<Message>(), bytes);
    return std::string(1, static_cast<char>(i)) + std::string(bytes.begin(), bytes.end());
  }
};
using AllMessages =
    MessageList<ImageMsg, CompressedImageMsg, CameraInfoMsg, PointCloud2Msg, LaserScanMsg,
                OdometryMsg, PathMsg, OccupancyGridMsg, TFMessageMsg, PoseArrayMsg, PoseStampedMsg,
                MarkerArrayMsg, TwistStampedMsg, StringMsg, DiagnosticArrayMsg>;

Seeds mapSeeds(const fs::path& folder) {
  const OccupancyGrid grid({0.0, 0.0}, 0.5, 3, 2);
  return {drawn(folder, "seed.yaml", [&](const fs::path& file) { saveMapServer(grid, file); }),
          readText(folder / "seed.pgm")};
}

Seeds imageSeeds(const fs::path&) {
  Seeds seeds;
  for (const char* format : {".png", ".jpg", ".bmp", ".pgm", ".tif"}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(format, cv::Mat(5, 7, CV_8UC1, cv::Scalar(9)), bytes);
    seeds.emplace_back(bytes.begin(), bytes.end());
  }
  return seeds;
}

/// As cv::FileStorage writes it: raw in YAML, rectified in XML and JSON.
Seeds stereoSeeds(const fs::path& folder) {
  const cv::Matx33d K(90, 0, 32, 0, 90, 24, 0, 0, 1);
  const cv::Matx34d P1(90, 0, 32, 0, 0, 90, 24, 0, 0, 0, 1, 0);
  cv::Matx34d P2 = P1;
  P2(0, 3) = -9;
  using Values = std::vector<std::pair<std::string, cv::Mat>>;
  const auto stored = [&](const std::string& name, const Values& values) {
    return drawn(folder, name, [&](const fs::path& file) {
      cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
      storage << "imageSize" << cv::Size(64, 48);
      for (const auto& [key, value] : values) storage << key << value;
    });
  };
  const Values raw = {{"M1", cv::Mat(K)},
                      {"D1", cv::Mat::zeros(1, 4, CV_64F)},
                      {"M2", cv::Mat(K)},
                      {"D2", cv::Mat::zeros(1, 5, CV_32F)},
                      {"R", cv::Mat::eye(3, 3, CV_64F)},
                      {"T", cv::Mat(cv::Vec3d(-0.1, 0, 0))}};
  const Values rectified = {{"P1", cv::Mat(P1)}, {"P2", cv::Mat(P2)}};
  return {stored("raw.yaml", raw), stored("rectified.xml", rectified),
          stored("rectified.json", rectified)};
}

/// @param t_x  The first row's last number: 0 of a left camera, -f b of a right one.
std::string cameraInfo(const std::string& t_x) {
  return "image_width: 64\nimage_height: 48\ndistortion_model: plumb_bob\n"
         "camera_matrix: {rows: 3, cols: 3, data: [90, 0, 32, 0, 90, 24, 0, 0, 1]}\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [90, 0, 32, " +
         t_x + ", 0, 90, 24, 0, 0, 0, 1, 0]}\n";
}

AppearanceModel smallModel() {
  ColorHistogram person, room;
  for (int i = 0; i < 300; ++i) person.add(200, static_cast<std::uint8_t>(i % 9), 30);
  for (int i = 0; i < 300; ++i) room.add(90, 90, static_cast<std::uint8_t>(90 + i % 9));
  AppearanceParams params;
  params.bands = upperBody();
  return AppearanceModel(params, {person}, room);
}

}  // namespace

const std::vector<FuzzReader>& fuzzReaders() {
  static const std::vector<FuzzReader> kReaders = {
      {"pcd", fromFile("a.pcd", readCloud), [](const auto& f) { return cloudSeeds(f, ".pcd"); }},
      {"ply", fromFile("a.ply", readCloud), [](const auto& f) { return cloudSeeds(f, ".ply"); }},
      {"ros1_bag", fromFile("a.bag", readBag), [](const auto& f) { return bagSeeds(f, ".bag"); }},
      {"ros2_bag", fromFile("a.db3", readBag), [](const auto& f) { return bagSeeds(f, ".db3"); }},
      {"mcap", fromFile("a.mcap", readBag), [](const auto& f) { return bagSeeds(f, ".mcap"); }},
      {"ros1_message", [](const auto&, const auto& b) { AllMessages::read(BagForm::kRos1, b); },
       [](const auto&) { return AllMessages::seeds(BagForm::kRos1); }},
      {"cdr_message", [](const auto&, const auto& b) { AllMessages::read(BagForm::kRos2, b); },
       [](const auto&) { return AllMessages::seeds(BagForm::kRos2); }},
      {"carmen", fromFile("a.log", readLog),
       seed("ODOM 5 5 0 0 0 0 1 h 1\nFLASER 4 1 2 81.9 3.5 1 0 0 1 0 0 0.2 h 0.2\n")},
      {"camera", fromFile("camera.yaml", readCameraFile),
       seed("width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\ndepth_scale: 1000\n"
            "T_ground_camera: [0,0,1,0, -1,0,0,0, 0,-1,0,1.5, 0,0,0,1]\n")},
      {"stereo", fromFile("stereo.yaml", [](const auto& file) { readStereoRig(file); }),
       [](const auto& f) { return stereoSeeds(f); }},
      {"camera_info",
       [](const auto& f, const auto& b) {
         readCameraInfo(put(f, "left.yaml", cameraInfo("0")), put(f, "right.yaml", b));
       },
       seed(cameraInfo("-9"))},
      {"model", fromFile("person.yaml", loadAppearance),
       [](const auto& f) {
         return Seeds{
             drawn(f, "seed.yaml", [](const auto& file) { saveAppearance(smallModel(), file); })};
       }},
      {"scene", fromFile("a.yaml", [](const auto& file) { loadScene(file.string()); }),
       seed("name: small\nwalls:\n  - {from: [0, 0], to: [4, 0]}\n  - {from: [4, 0], to: [0, 4]}\n"
            "  - {from: [0, 4], to: [0, 0]}\n"
            "people:\n  - {name: ann, height_m: 1.7, start: [1, 1]}\nrobot: {start: [2, 1]}\n")},
      {"map",
       [](const auto& f, const auto& b) {
         put(f, "seed.pgm", "P5\n3 2\n255\nabcdef");
         loadMapServer(put(f, "a.yaml", b));
       },
       [](const auto& f) { return Seeds{mapSeeds(f)[0]}; }},
      {"map_image", fromFile("a.pgm", [](const auto& file) { gridFromImage(file, 0.05); }),
       [](const auto& f) { return Seeds{mapSeeds(f)[1]}; }},
      {"wall_map", fromFile("a.bt", [](const auto& file) { loadWallMap(file).floorGrid(); }),
       [](const auto& f) {
         WallMapBuilder builder(0.1);
         builder.addFreeFloor({0.0, 0.0}, {0.5, 0.5});
         const WallMap map = builder.build();
         return Seeds{drawn(f, "seed.bt", [&](const auto& file) { saveWallMap(map, file); })};
       }},
      {"plan", fromFile("a.pnml", [](const auto& file) { loadPlan(file, followingVocabulary()); }),
       [](const auto&) {
         return Seeds{readText(fs::path(HEEL_SOURCE_DIR) / "apps/plans/paper.pnml")};
       }},
      {"tracks", fromFile("tracks.csv", readTracks),
       seed("stamp_s,track_id,is_target,x_m,y_m,vx_mps,vy_mps,score,status\n"
            "1,1,1,0.5,0,0,0,0.9,confirmed\n")},
      {"stamps", fromFile("rgb.txt", readStampedFiles),
       seed("# colour\n0.5 rgb/1.png\n0.75 rgb/2.png\n")},
      {"image",
       [](const auto&, const auto& b) {
         cv::Mat image;
         decodeImage("the image", {b.begin(), b.end()}, cv::IMREAD_COLOR, image);
       },
       imageSeeds}};
  return kReaders;
}

}  // namespace heel::test
