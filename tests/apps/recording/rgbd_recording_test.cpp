// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/recording.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>

namespace {

using heel::openRecording;
using heel::test::messageOf;
using heel::test::TempFolder;
using heel::test::writeText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kCamera =
    "width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\ndepth_scale: 1000\n"
    "T_ground_camera: [0,0,1,0, -1,0,0,0, 0,-1,0,1.5, 0,0,0,1]\n";

/// Four frames, 0.2 s apart; frame n has the colour n and a depth of n metres.
class RgbdFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string colors = "# stamp file\n", depths = colors;
    std::filesystem::create_directories(folder / "rgb");
    std::filesystem::create_directories(folder / "depth");
    for (int n = 1; n <= 4; ++n) {
      const std::string stamp = "10." + std::to_string(2 * n), name = std::to_string(n) + ".png";
      writeColor(n, cv::Size(16, 12));
      writeDepth(n, cv::Size(16, 12));
      colors += stamp + "00 rgb/" + name + "\n";
      depths += stamp + "08 depth/" + name + "\n";  // 8 ms later than the colour
    }
    writeText(folder / "rgb.txt", colors);
    writeText(folder / "depth.txt", depths);
    writeText(folder / "camera.yaml", kCamera);
  }

  std::filesystem::path color(int n) const {
    return folder / ("rgb/" + std::to_string(n) + ".png");
  }
  std::filesystem::path depth(int n) const {
    return folder / ("depth/" + std::to_string(n) + ".png");
  }
  void writeColor(int n, cv::Size size) const {
    cv::imwrite(color(n).string(), cv::Mat(size, CV_8UC3, cv::Scalar::all(n)));
  }
  void writeDepth(int n, cv::Size size) const {
    cv::imwrite(depth(n).string(), cv::Mat(size, CV_16UC1, cv::Scalar(1000 * n)));
  }

  /// Reads all; the numbers of the frames that came.
  std::vector<std::size_t> readAll(const heel::RecordingParams& params = {}) {
    recording = openRecording(folder.path(), params);
    std::vector<std::size_t> numbers;
    while (recording->next(frame)) {
      numbers.push_back(frame.number);
      EXPECT_EQ(frame.image_bgr.at<cv::Vec3b>(3, 4)[1], frame.number);
      EXPECT_FLOAT_EQ(frame.depth_m.at<float>(3, 4), static_cast<float>(frame.number));
    }
    return numbers;
  }

  TempFolder folder;
  std::unique_ptr<heel::Recording> recording;
  heel::Frame frame;
};

TEST_F(RgbdFolder, GivesEveryFrameWithItsStamp) {
  EXPECT_THAT(readAll(), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(recording->skipped(), IsEmpty());
  EXPECT_DOUBLE_EQ(frame.stamp_s, 10.8);
  EXPECT_EQ(frame.name, color(4).string());
  EXPECT_TRUE(frame.right_bgr.empty());
  EXPECT_EQ(frame.cloud, nullptr);
  EXPECT_FALSE(recording->next(frame));
}

TEST_F(RgbdFolder, GivesThePartThatIsAskedFor) {
  heel::RecordingParams params;
  params.span = {0.2, 0.4};
  EXPECT_THAT(readAll(params), ElementsAre(2, 3));
  EXPECT_EQ(recording->info().frame_count, 2U);
}

TEST_F(RgbdFolder, ReadsNothingOutsideOfThePart) {
  std::filesystem::remove(color(1));
  std::filesystem::remove(color(4));
  heel::RecordingParams params;
  params.span = {0.2, 0.4};
  EXPECT_THAT(readAll(params), ElementsAre(2, 3));
  EXPECT_THAT(recording->skipped(), IsEmpty());
  params.span = {0.7, 0.9};
  EXPECT_THAT(readAll(params), IsEmpty());
  EXPECT_EQ(recording->info().frame_count, 0U);
}

TEST(RecordingPiece, GoesBackIntoTheOneBefore) {
  const auto span = [](int number, int count) {
    return heel::RecordingPiece{number, count, 2.0}.spanOf(30.0);
  };
  EXPECT_EQ(span(1, 1).from_s, 0.0);
  EXPECT_TRUE(std::isinf(span(1, 1).to_s));
  EXPECT_EQ(span(1, 3).from_s, 0.0);
  EXPECT_EQ(span(1, 3).to_s, 10.0);
  EXPECT_EQ(span(2, 3).from_s, 8.0);
  EXPECT_EQ(span(2, 3).to_s, 20.0);
  EXPECT_EQ(span(3, 3).from_s, 18.0);
  EXPECT_TRUE(std::isinf(span(3, 3).to_s)) << "what comes while it is read belongs to it";
}

TEST_F(RgbdFolder, TellsWhatHoldsForTheWhole) {
  const auto info = openRecording(folder.path())->info();
  EXPECT_EQ(info.name, folder.path().filename());
  EXPECT_EQ(info.sensor, heel::SensorKind::kRgbd);
  EXPECT_EQ(info.frame_count, 4U);
  EXPECT_NEAR(info.duration_s, 0.6, 1e-12);
  EXPECT_FALSE(info.nominal_stamps);
  EXPECT_EQ(info.camera.left.width, 16);
  EXPECT_EQ(info.camera.left.fy, 21.0);
  EXPECT_EQ(info.camera.baseline_m, 0.0);
  ASSERT_TRUE(info.T_base_camera.has_value());
  // 2 m in front of the camera is 2 m ahead, at the camera's height.
  EXPECT_TRUE(
      (*info.T_base_camera * Eigen::Vector3d(0, 0, 2)).isApprox(Eigen::Vector3d(2, 0, 1.5)));
}

TEST_F(RgbdFolder, LeavesOutFramesThatAreDamagedAndSaysWhy) {
  std::filesystem::remove(color(1));
  heel::test::truncateBy(depth(2), 20);
  writeColor(3, cv::Size(12, 16));
  EXPECT_THAT(readAll(), ElementsAre(4));
  ASSERT_THAT(recording->skipped(), SizeIs(3));
  EXPECT_EQ(recording->skipped()[0].number, 1U);
  EXPECT_EQ(recording->skipped()[0].reason, color(1).string() + ": the image is missing");
  EXPECT_EQ(recording->skipped()[1].reason, depth(2).string() + ": the image is truncated");
  EXPECT_EQ(recording->skipped()[2].reason,
            color(3).string() + ": the image is 12x16, but camera.yaml says 16x12");
}

TEST_F(RgbdFolder, SaysWhenNothingCouldBeRead) {
  for (int n = 1; n <= 4; ++n) writeDepth(n, cv::Size(8, 6));
  EXPECT_THAT(readAll(), IsEmpty());
  EXPECT_EQ(heel::nothingReadMessage(*recording),
            "none of the 4 frames of " + folder.path().filename().string() +
                " could be read; the first: " + depth(1).string() +
                ": the image is 8x6, but camera.yaml says 16x12");
}

TEST_F(RgbdFolder, LeavesOutFramesWhoseTimeRunsBackwardsOrStandsStill) {
  writeText(folder / "rgb.txt", "10.2 rgb/1.png\n10.1 rgb/2.png\n10.2 rgb/3.png\n10.4 rgb/4.png\n");
  writeText(folder / "depth.txt",
            "10.1 depth/2.png\n10.2 depth/1.png\n10.2 depth/3.png\n10.4 depth/4.png\n");
  EXPECT_THAT(readAll(), ElementsAre(1, 4));
  ASSERT_THAT(recording->skipped(), SizeIs(2));
  EXPECT_EQ(recording->skipped()[0].reason,
            color(2).string() + ": the time runs backwards, from 10.200000 s to 10.100000 s");
  EXPECT_EQ(recording->skipped()[1].reason,
            color(3).string() + ": the time stands still, from 10.200000 s to 10.200000 s");
}

TEST_F(RgbdFolder, LeavesOutColourWithoutDepthAtThatTime) {
  writeText(folder / "depth.txt", "10.208 depth/1.png\n10.621 depth/3.png\n10.82 depth/4.png\n");
  EXPECT_THAT(readAll(), ElementsAre(1, 4));
  ASSERT_THAT(recording->skipped(), SizeIs(2));
  EXPECT_EQ(recording->skipped()[0].reason,
            color(2).string() + ": there is no depth image within 0.020000 s of it");
}

TEST_F(RgbdFolder, WithOneStampFarAheadLosesThatFrameAlone) {
  for (const char* list : {"rgb.txt", "depth.txt"}) {
    std::string text = heel::test::readText(folder / list);
    const auto line = text.find('\n', text.find("2.png"));
    const auto begin = text.rfind('\n', line - 1) + 1;
    text.replace(begin, text.find(' ', begin) - begin, "1000000000");
    writeText(folder / list, text);
  }
  readAll();
  ASSERT_THAT(recording->skipped(), SizeIs(1));
  EXPECT_THAT(recording->skipped()[0].reason, HasSubstr("the time jumps ahead to 1000000000"));
  EXPECT_NEAR(recording->info().duration_s, 0.6, 1e-9);
}

TEST_F(RgbdFolder, WithoutCameraFileSaysWhatToWrite) {
  std::filesystem::remove(folder / "camera.yaml");
  const std::string message = messageOf([&] { openRecording(folder.path()); });
  EXPECT_THAT(message, HasSubstr((folder / "camera.yaml").string() + " is missing: write one"));
  EXPECT_THAT(message, HasSubstr("640, 480, 525.0, 525.0, 319.5, 239.5 and 5000"));
}

TEST_F(RgbdFolder, NamesWhatIsWrongInTheCameraFile) {
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string text = kCamera;
    text.replace(text.find(from), from.size(), to);
    writeText(folder / "camera.yaml", text);
    return messageOf([&] { openRecording(folder.path()); });
  };
  const std::string file = (folder / "camera.yaml").string();
  EXPECT_EQ(message("fx: 20", "# fx"), file + ", line 1: 'fx' of the camera is missing");
  EXPECT_THAT(message("fx: 20", "fx: wide"), HasSubstr("'fx' of the camera must be a number"));
  EXPECT_THAT(message("fx: 20", "fx: 0"), HasSubstr("is 0, but must be more than 0"));
  EXPECT_THAT(message("width: 16", "width: 16.5"), HasSubstr("must be a whole number"));
  EXPECT_EQ(message("depth_scale: 1000", ""), file + " has no 'depth_scale'");
  EXPECT_THAT(message("1.5, 0,0,0,1", "1.5"), HasSubstr("must be a list of 16 numbers"));
  EXPECT_THAT(message("[0,0,1,0", "[0,0,2,0"),
              HasSubstr("'T_ground_camera' of the camera is not a rotation and a translation"));
  EXPECT_THAT(message("1.5, 0,0,0,1", "1.5, 0,0,x,1"), HasSubstr("must be a number, not 'x'"));
  EXPECT_THAT(message("T_ground_camera", "T_ground_camara"),
              HasSubstr("'T_ground_camara' is not a key of the camera, and 'T_ground_camera' is"));
  EXPECT_THAT(message("width: 16\nheight: 12", "width: 99999\nheight: 99999"),
              HasSubstr("a camera of 99999x99999 pixels asks for"));
  EXPECT_THAT(message(kCamera, "just words"), HasSubstr("the camera must be a map of keys"));
  EXPECT_THAT(message("fx: 20", "fx: [20"), HasSubstr("not YAML"));
}

TEST_F(RgbdFolder, WithoutOneOfItsListsNamesIt) {
  std::filesystem::remove(folder / "depth.txt");
  EXPECT_EQ(messageOf([&] { openRecording(folder.path()); }),
            (folder / "depth.txt").string() + " cannot be read");
}

TEST(OpenRecording, SaysThatThereIsNoSuchFolder) {
  EXPECT_EQ(messageOf([] { openRecording("/no/such/folder"); }), "/no/such/folder does not exist");
}

TEST(OpenRecording, NamesTheKnownLayoutsForAnyOtherFolder) {
  const TempFolder folder;
  const std::string message = messageOf([&] { openRecording(folder.path()); });
  EXPECT_THAT(message, HasSubstr(folder.path().string() + " holds no recording"));
  for (const char* layout : {"rgb.txt", "left/ and right/", "im0.png", "*.pcd"}) {
    EXPECT_THAT(message, HasSubstr(layout));
  }
  writeText(folder / "notes.txt", "hello");
  EXPECT_THAT(messageOf([&] { openRecording(folder / "notes.txt"); }),
              HasSubstr("neither a folder, nor a PCD file (.pcd), nor a bag"));
}

TEST(OpenRecording, RefusesParametersThatAreNotPositive) {
  heel::RecordingParams params;
  params.nominal_rate_hz = 0.0;
  EXPECT_THROW(openRecording("/", params), std::invalid_argument);
  params = {};
  params.max_stamp_difference_s = std::nan("");
  EXPECT_THROW(openRecording("/", params), std::invalid_argument);
}

struct RealRgbd {
  const char* name;
  std::size_t frames;
  double height_m;  ///< Of the camera over the floor.
};

class RealRgbdRecording : public testing::TestWithParam<RealRgbd> {};

TEST_P(RealRgbdRecording, IsReadToItsEnd) {
  const auto& [name, frames, height_m] = GetParam();
  HEEL_NEED_DATA(name);
  const auto recording = openRecording(heel::test::dataFolder() / name);
  EXPECT_EQ(recording->info().name, name);
  EXPECT_EQ(recording->info().frame_count, frames);
  EXPECT_NEAR(recording->info().duration_s, 0.2 * static_cast<double>(frames - 1), 1e-9);
  ASSERT_TRUE(recording->info().T_base_camera.has_value());
  EXPECT_NEAR(recording->info().T_base_camera->translation().z(), height_m, 0.005);
  heel::Frame frame;
  std::size_t count = 0;
  while (recording->next(frame)) {
    ++count;
    EXPECT_EQ(frame.number, count);
    EXPECT_NEAR(frame.stamp_s, 0.2 * static_cast<double>(count - 1), 1e-9);
    EXPECT_EQ(frame.image_bgr.size(), cv::Size(640, 480));
    const int valid = cv::countNonZero(frame.depth_m == frame.depth_m);
    EXPECT_GT(valid, 640 * 480 / 2) << frame.name;
    double nearest_m = 0.0, farthest_m = 0.0;
    cv::minMaxLoc(frame.depth_m, &nearest_m, &farthest_m, nullptr, nullptr,
                  frame.depth_m == frame.depth_m);
    EXPECT_GT(nearest_m, 0.3);
    EXPECT_LT(farthest_m, 12.0);
  }
  EXPECT_EQ(count, frames);
  EXPECT_THAT(recording->skipped(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Data, RealRgbdRecording,
                         testing::Values(RealRgbd{"six_people", 108, 2.357},
                                         RealRgbd{"one_person", 38, 2.362}),
                         [](const auto& param) { return std::string(param.param.name); });

}  // namespace
