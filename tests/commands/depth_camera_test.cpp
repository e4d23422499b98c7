// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// heel capture and heel live --camera, from recordings of OpenNI2: to it they are the same thing
/// as cameras.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/side_by_side.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <array>
#include <csignal>
#include <cstdint>
#include <functional>

namespace heel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// What is in an .oni file.
struct Oni {
  int frames = 3;
  cv::Size colors = {64, 48}, depths = {64, 48};
  double view_rad = 1.0;  ///< 0: it does not say.
  bool is_mirrored = false;
  bool has_depth = true;
  std::uint64_t depth_late_us = 2000;
  std::uint64_t step_us = 33000;
  std::function<std::array<cv::Mat, 2>(int)> pictures = nullptr;  ///< If others: RGB, millimetres.
};

/// The bytes of an .oni file: colours of blue 7, green 20 and the frame's number, red 200, the
/// leftmost column black; depths of 1 m and as many millimetres.
class OniBytes {
 public:
  explicit OniBytes(const Oni& oni) {
    constexpr std::uint32_t kImage = 3, kDepth = 2, kRgb = 200, kMillimetres = 100;
    bytes_ = "NI10";
    add<std::uint8_t>(1, 0);
    add<std::uint16_t>(1);
    add<std::uint32_t>(0, ~0U, ~0U, 2);  // build, latest stamp in two halves, last node
    addNode(1, "Image", kImage, kRgb, 3, oni.colors, oni);
    if (oni.has_depth) addNode(2, "Depth", kDepth, kMillimetres, 2, oni.depths, oni);
    for (std::uint32_t node = 1; node <= (oni.has_depth ? 2 : 1); ++node) {
      addRecord(9, node, "");
      addRecord(8, node, of<std::uint32_t>(~0U, ~0U, ~0U));
    }
    for (std::uint32_t i = 1; i <= static_cast<std::uint32_t>(oni.frames); ++i) {
      cv::Mat color(oni.colors, CV_8UC3, cv::Scalar(200, 20 + i, 7));
      color.col(0).setTo(0);
      cv::Mat depth(oni.depths, CV_16UC1, cv::Scalar(1000 + i));
      if (oni.pictures) {
        const std::array<cv::Mat, 2> pair = oni.pictures(static_cast<int>(i));
        color = pair[0];
        depth = pair[1];
      }
      addPicture(1, oni.step_us * i, i, color);
      if (oni.has_depth) addPicture(2, oni.step_us * i + oni.depth_late_us, i, depth);
    }
    addRecord(11, 0, "");
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T, typename... Values>
  static std::string of(Values... values) {
    std::string out;
    for (const T value : {static_cast<T>(values)...}) {
      out.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return out;
  }
  template <typename T, typename... Values>
  void add(Values... values) {
    bytes_ += of<T>(values...);
  }
  static std::string named(const std::string& name) {
    return of<std::uint32_t>(name.size() + 1) + name + '\0';
  }

  void addRecord(std::uint32_t kind, std::uint32_t node, const std::string& fields,
                 const std::string& payload = "") {
    bytes_ += std::string("NIR\0", 4);
    add<std::uint32_t>(kind, node, 28 + fields.size(), payload.size());
    add<std::uint64_t>(0);
    bytes_ += fields + payload;
  }
  void addProperty(std::uint32_t node, const std::string& name, std::uint64_t value) {
    addRecord(3, node, named(name) + of<std::uint32_t>(8) + of<std::uint64_t>(value));
  }
  void addProperty(std::uint32_t node, const std::string& name, const std::string& value) {
    addRecord(6, node, named(name) + of<std::uint32_t>(value.size()) + value);
  }
  void addNode(std::uint32_t node, const std::string& name, std::uint32_t kind,
               std::uint32_t format, int pixel_bytes, cv::Size size, const Oni& oni) {
    addRecord(13, node,
              named(name) + of<std::uint32_t>(kind) + "NONE" + of<std::uint32_t>(oni.frames) +
                  of<std::uint64_t>(0, 0, 0));
    addProperty(node, "xnMapOutputMode", of<std::uint32_t>(size.width, size.height, 30));
    addProperty(node, "oniPixelFormat", format);
    addProperty(node, "oniRequiredFrameSize",
                static_cast<std::uint64_t>(size.area() * pixel_bytes));
    addProperty(node, "xnCropping", of<std::uint32_t>(0, 0, 0));
    addProperty(node, "xnMirror", static_cast<std::uint64_t>(oni.is_mirrored));
    if (oni.view_rad > 0) addProperty(node, "xnFOV", of<double>(oni.view_rad, oni.view_rad));
  }
  void addPicture(std::uint32_t node, std::uint64_t stamp_us, std::uint32_t number,
                  const cv::Mat& picture) {
    addRecord(10, node, of<std::uint64_t>(stamp_us) + of<std::uint32_t>(number),
              {picture.ptr<char>(), picture.total() * picture.elemSize()});
  }

  std::string bytes_;
};

class CaptureDepth : public testing::Test {
 protected:
  void SetUp() override {
#ifndef HEEL_HAS_OPENNI
    GTEST_SKIP() << "Heel is built without OpenNI2";
#endif
  }

  HeelRun capture(const std::string& bytes, const std::vector<std::string>& more = {}) {
    writeText(folder_ / "room.oni", bytes);
    return heel({"capture", folder_ / "room.oni", "--out", folder_ / "out"}, more);
  }
  HeelRun capture(const Oni& oni, const std::vector<std::string>& more = {}) {
    return capture(OniBytes(oni).bytes(), more);
  }
  std::string cameraFile(const std::string& width, const std::string& scale) {
    writeText(folder_ / "camera.yaml", "width: " + width +
                                           "\nheight: 48\nfx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\n" +
                                           "depth_scale: " + scale + "\n" + kLevelMounting);
    return folder_ / "camera.yaml";
  }
  bool wroteNothing() { return !std::filesystem::exists(folder_ / "out"); }

  TempFolder folder_;
};

TEST_F(CaptureDepth, WritesARecordingThatTheOtherVerbsRead) {
  const HeelRun run = capture(Oni{}, {"--calibration", cameraFile("64", "1000")});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("3 pairs of 64x48 over 0.1 s"));
  EXPECT_THAT(filesBelow(folder_ / "out"),
              ElementsAre("camera.yaml", "depth.txt", "depth/000001.png", "depth/000002.png",
                          "depth/000003.png", "rgb.txt", "rgb/000001.png", "rgb/000002.png",
                          "rgb/000003.png"));
  const cv::Mat color = cv::imread(folder_ / "out/rgb/000002.png");
  EXPECT_EQ(color.at<cv::Vec3b>(20, 30), cv::Vec3b(7, 22, 200));
  EXPECT_EQ(color.at<cv::Vec3b>(20, 0), cv::Vec3b(0, 0, 0));
  const cv::Mat depth = cv::imread(folder_ / "out/depth/000002.png", cv::IMREAD_UNCHANGED);
  EXPECT_EQ(depth.at<std::uint16_t>(20, 30), 1002);
  const HeelRun inspected = heel({"inspect", folder_ / "out"});
  EXPECT_TRUE(succeeds(inspected));
  EXPECT_THAT(inspected.out, HasSubstr("RGB-D folder, TUM layout, 3 frames over 0.1 s"));
}

TEST_F(CaptureDepth, CalibratesByTheFieldOfView) {
  ASSERT_TRUE(succeeds(capture(Oni{})));
  EXPECT_THAT(readText(folder_ / "out/camera.yaml"),
              testing::AllOf(HasSubstr("fx: 58.57"), HasSubstr("fy: 58.57"), HasSubstr("cx: 31.5"),
                             HasSubstr("depth_scale: 1000")));
}

TEST_F(CaptureDepth, AsksForTheCalibrationOfACameraThatDoesNotTellItsFieldOfView) {
  EXPECT_TRUE(failsWith(capture(Oni{3, {64, 48}, {64, 48}, 0.0}),
                        {"room.oni", "field of view", "--calibration"}));
  EXPECT_TRUE(wroteNothing());
}

TEST_F(CaptureDepth, TurnsMirroredPicturesBack) {
  Oni oni;
  oni.is_mirrored = true;
  ASSERT_TRUE(succeeds(capture(oni)));
  const cv::Mat color = cv::imread(folder_ / "out/rgb/000001.png");
  EXPECT_EQ(color.at<cv::Vec3b>(20, 63), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(color.at<cv::Vec3b>(20, 0), cv::Vec3b(7, 21, 200));
}

TEST_F(CaptureDepth, WarnsWhereDepthMayNotBeInThePixelsOfColours) {
  EXPECT_THAT(capture(Oni{}).warnings(), ElementsAre(HasSubstr("pixels of its colours")));
}

TEST_F(CaptureDepth, JoinsPicturesOfTheNearestTimes) {
  Oni oni;
  oni.depth_late_us = 30000;  // A depth is 3 ms older than the colours after it.
  const HeelRun run = capture(oni);
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("2 pairs"));
  const cv::Mat color = cv::imread(folder_ / "out/rgb/000001.png");
  const cv::Mat depth = cv::imread(folder_ / "out/depth/000001.png", cv::IMREAD_UNCHANGED);
  EXPECT_EQ(color.at<cv::Vec3b>(20, 30), cv::Vec3b(7, 22, 200));
  EXPECT_EQ(depth.at<std::uint16_t>(20, 30), 1001);
}

TEST_F(CaptureDepth, EndsAfterTheTimeThatItIsGiven) {
  Oni oni;
  oni.frames = 30;
  const HeelRun run = capture(oni, {"--duration", "0.5"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("16 pairs"));
}

TEST_F(CaptureDepth, RefusesWhatItCantRecord) {
  EXPECT_TRUE(failsWith(heel({"capture", folder_ / "no.oni", "--out", folder_ / "out"}),
                        {"no.oni", "no such recording"}));
  EXPECT_TRUE(failsWith(heel({"capture", "openni:nowhere", "--out", folder_ / "out"}),
                        {"openni:nowhere", "no such camera"}));
  EXPECT_TRUE(failsWith(capture("not one"), {"room.oni", "no recording"}));
  Oni oni;
  oni.frames = 0;
  EXPECT_TRUE(failsWith(capture(oni), {"room.oni", "gives no pictures"}));
  oni = {};
  oni.has_depth = false;
  EXPECT_TRUE(failsWith(capture(oni), {"room.oni", "has no depth"}));
  oni = {};
  oni.depths = {32, 24};
  EXPECT_TRUE(failsWith(capture(oni), {"room.oni", "different sizes"}));
  oni = {};
  oni.frames = 80;
  oni.depth_late_us = 10'000'000;
  EXPECT_TRUE(failsWith(capture(oni), {"room.oni", "do not come at the same time"}));
  EXPECT_TRUE(failsWith(capture(Oni{}, {"--calibration", cameraFile("80", "1000")}),
                        {"camera.yaml", "of images of 80x48, and these are of 64x48"}));
  EXPECT_TRUE(failsWith(capture(Oni{}, {"--calibration", cameraFile("64", "5000")}),
                        {"camera.yaml", "'depth_scale' must be 1000"}));
  EXPECT_TRUE(wroteNothing());
}

TEST_F(CaptureDepth, KeepsWhatCameBeforeTheCameraFailed) {
  const std::string whole = OniBytes(Oni{}).bytes();
  const HeelRun run = capture(whole.substr(0, whole.size() * 6 / 10));
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.errors(), ElementsAre(HasSubstr("room.oni: gives no more pictures")));
  EXPECT_THAT(
      filesBelow(folder_ / "out"),
      ElementsAre("camera.yaml", "depth.txt", "depth/000001.png", "rgb.txt", "rgb/000001.png"));
}

TEST(LiveCamera, SeesAPersonAsOftenAsTrackDoesInARecording) {
#ifndef HEEL_HAS_OPENNI
  GTEST_SKIP() << "Heel is built without OpenNI2";
#endif
  constexpr int kFirst = 15, kFrames = 31;  // 2 s of the empty room, then somebody enters
  const TempFolder folder;
  SmallRecording().write(folder / "room");
  writeSmallModel(folder / "rosa.yaml");
  Oni oni;
  oni.frames = kFrames;
  oni.colors = oni.depths = cv::imread(colorImage(folder / "room", 1)).size();
  oni.step_us = 200000;
  oni.pictures = [&folder](int number) {
    cv::Mat color = cv::imread(colorImage(folder / "room", kFirst - 1 + number));
    cv::cvtColor(color, color, cv::COLOR_BGR2RGB);
    const std::string depth = depthImage(folder / "room", kFirst - 1 + number);
    return std::array<cv::Mat, 2>{color, cv::imread(depth, cv::IMREAD_UNCHANGED)};
  };
  writeText(folder / "room.oni", OniBytes(oni).bytes());
  const HeelRun live =
      heel({"live", "--camera", folder / "room.oni", "--calibration", folder / "room/camera.yaml",
            "--model", folder / "rosa.yaml", "--port", "0"});
  ASSERT_TRUE(live.succeeded()) << live.err;
  EXPECT_THAT(live.err, HasSubstr("pictures are at http://127.0.0.1:"));
  // Its first 2 s, till and with 2.2 s, only place the camera.
  const HeelRun track = heel({"track", folder / "room", "--model", folder / "rosa.yaml", "--out",
                              folder / "out", "--no-film", "--from", "5.1", "--to", "8.9"});
  ASSERT_TRUE(succeeds(track));
  const std::string seen = track.out.substr(0, track.out.find('\n'));
  EXPECT_THAT(seen, testing::StartsWith("19 frames, the target seen or predicted in 1"));
  EXPECT_EQ("19 pictures" + seen.substr(seen.find(',')) + '\n', live.out);
}

TEST(LiveCamera, EndsBySignalsAndSaysThatNobodyWasSeen) {
#ifndef HEEL_HAS_OPENNI
  GTEST_SKIP() << "Heel is built without OpenNI2";
#endif
  const TempFolder folder;
  writeSmallModel(folder / "rosa.yaml");
  writeText(folder / "camera.yaml",
            "width: 64\nheight: 48\nfx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\ndepth_scale: 1000\n" +
                std::string(kLevelMounting));
  Oni oni;
  oni.frames = 1000;
  writeText(folder / "room.oni", OniBytes(oni).bytes());
  const HeelRun run =
      heelSignalled({"live", "--camera", folder / "room.oni", "--calibration",
                     folder / "camera.yaml", "--model", folder / "rosa.yaml", "--port", "0"},
                    "pictures are at", {SIGINT});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_THAT(run.err, HasSubstr("room.oni: the person was not seen"));
}

TEST(LiveCamera, RefusesCallsThatMakeNoSense) {
  EXPECT_TRUE(failsWith(heel({"live", "--camera", "0"}), {"--camera", "--model"}));
  EXPECT_TRUE(failsWith(heel({"live", "--camera", "0", "--model", "x", "--map", "home"}),
                        {"--camera", "excludes", "--map"}));
  EXPECT_TRUE(failsWith(heel({"live", "--width", "64", "--out", "x"}), {"--width", "--camera"}));
  EXPECT_TRUE(failsWith(heel({"live"}), {"--out"}));
}

}  // namespace
}  // namespace heel::test
