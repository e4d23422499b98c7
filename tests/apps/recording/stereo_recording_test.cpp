// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/folders/indexed_recording.hpp>
#include <heel/apps/recording/recording.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace {

using heel::openRecording;
using heel::test::messageOf;
using heel::test::TempFolder;
using heel::test::writeText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const cv::Size kSize(32, 24);

/// A camera_info file; the projection's principal point is `shift` right of the raw camera's.
std::string cameraInfo(double shift, double minus_fx_baseline) {
  return "image_width: 32\nimage_height: 24\ncamera_name: c\ndistortion_model: plumb_bob\n"
         "camera_matrix: {rows: 3, cols: 3, data: [30, 0, 15.5, 0, 30, 11.5, 0, 0, 1]}\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [30, 0, " +
         std::to_string(15.5 + shift) + ", " + std::to_string(minus_fx_baseline) +
         ", 0, 30, 11.5, 0, 0, 0, 1, 0]}\n";
}

const std::string kMiddlebury =
    "cam0=[30 0 15.5; 0 30 11.5; 0 0 1]\ncam1=[30 0 17.5; 0 30 11.5; 0 0 1]\ndoffs=2\n"
    "baseline=120\nwidth=32\nheight=24\nndisp=16\n";

class StereoFolder : public testing::Test {
 protected:
  /// Left images have the grey value n in frame n, right ones 100 + n.
  void writeImage(const std::string& name, int value, cv::Size size = kSize) const {
    std::filesystem::create_directories((folder / name).parent_path());
    cv::imwrite((folder / name).string(), cv::Mat(size, CV_8UC3, cv::Scalar::all(value)));
  }
  void writeRosCalibration(double shift = 0.0) const {
    writeText(folder / "left.yaml", cameraInfo(shift, 0.0));
    writeText(folder / "right.yaml", cameraInfo(shift, -30.0 * 0.12));
  }
  /// Opens the folder and reads all; the numbers of the frames that came.
  std::vector<std::size_t> readAll() {
    recording = openRecording(folder.path());
    std::vector<std::size_t> numbers;
    stamps_s.clear();
    while (recording->next(frame)) {
      numbers.push_back(frame.number);
      stamps_s.push_back(frame.stamp_s);
      EXPECT_EQ(frame.image_bgr.at<cv::Vec3b>(5, 5)[0], frame.number);
      EXPECT_EQ(frame.right_bgr.at<cv::Vec3b>(5, 5)[0], 100 + frame.number);
      EXPECT_TRUE(frame.depth_m.empty());
    }
    return numbers;
  }

  TempFolder folder;
  std::unique_ptr<heel::Recording> recording;
  heel::Frame frame;
  std::vector<double> stamps_s;
};

struct Layout {
  const char* name;
  std::string left, right;  ///< What comes before the number.
};

class StereoLayouts : public StereoFolder, public testing::WithParamInterface<Layout> {};

TEST_P(StereoLayouts, AreRead) {
  for (const int n : {1, 2, 3}) {
    writeImage(GetParam().left + std::to_string(n + 8) + ".png", n);  // 9, 10, 11: by number
    writeImage(GetParam().right + std::to_string(n + 8) + ".png", 100 + n);
  }
  writeText(folder / "calib.txt", kMiddlebury);
  EXPECT_THAT(readAll(), ElementsAre(1, 2, 3));
  EXPECT_THAT(stamps_s, ElementsAre(0.0, 0.1, 0.2));
  EXPECT_THAT(recording->skipped(), IsEmpty());
  const auto& info = recording->info();
  EXPECT_EQ(info.sensor, heel::SensorKind::kStereo);
  EXPECT_TRUE(info.nominal_stamps);
  EXPECT_EQ(info.camera.left.width, 32);
  EXPECT_DOUBLE_EQ(info.camera.baseline_m, 0.12);
  EXPECT_DOUBLE_EQ(info.camera.disparity_offset, 2.0);
}

INSTANTIATE_TEST_SUITE_P(All, StereoLayouts,
                         testing::Values(Layout{"LeftRight", "left/", "right/"},
                                         Layout{"Kitti", "image_0/", "image_1/"},
                                         Layout{"KittiColour", "image_2/00", "image_3/00"},
                                         Layout{"Euroc", "cam0/data/", "cam1/data/"},
                                         Layout{"OneFolder", "left_", "right_"}),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_F(StereoFolder, SinglePairIsARecordingOfOneFrame) {
  writeImage("im0.png", 1);
  writeImage("im1.png", 101);
  writeText(folder / "calib.txt", kMiddlebury);
  EXPECT_THAT(readAll(), ElementsAre(1));
  EXPECT_EQ(recording->info().duration_s, 0.0);
}

TEST_F(StereoFolder, RawImagesAreRectified) {
  cv::Mat raw(kSize, CV_8UC3);
  cv::RNG(3).fill(raw, cv::RNG::UNIFORM, 0, 255);
  std::filesystem::create_directories(folder / "left");
  std::filesystem::create_directories(folder / "right");
  cv::imwrite((folder / "left/1.png").string(), raw);
  cv::imwrite((folder / "right/1.png").string(), raw);
  writeRosCalibration(2.0);  // the rectified view is the raw one, moved by two columns
  recording = openRecording(folder.path());
  EXPECT_DOUBLE_EQ(recording->info().camera.left.cx, 17.5);
  EXPECT_NEAR(recording->info().camera.baseline_m, 0.12, 1e-9);
  ASSERT_TRUE(recording->next(frame));
  for (const auto& image : {frame.image_bgr, frame.right_bgr}) {
    EXPECT_EQ(cv::norm(image.colRange(2, 32), raw.colRange(0, 30), cv::NORM_INF), 0.0);
  }
}

TEST_F(StereoFolder, RectifiedImagesAreTakenAsTheyAre) {
  writeImage("left/1.png", 1);
  writeImage("right/1.png", 101);
  writeRosCalibration();
  EXPECT_THAT(readAll(), ElementsAre(1));
}

TEST_F(StereoFolder, CalibrationWithoutASizeTakesTheImages) {
  writeImage("left/1.png", 1);
  writeImage("right/1.png", 101);
  cv::FileStorage calib((folder / "calib.yaml").string(), cv::FileStorage::WRITE);
  const cv::Mat K = (cv::Mat_<double>(3, 3) << 30, 0, 15.5, 0, 30, 11.5, 0, 0, 1);
  const cv::Mat D = cv::Mat::zeros(1, 5, CV_64F), R = cv::Mat::eye(3, 3, CV_64F);
  calib << "M1" << K << "D1" << D << "M2" << K << "D2" << D << "R" << R << "T"
        << (cv::Mat_<double>(3, 1) << -0.12, 0, 0);
  calib.release();
  EXPECT_THAT(readAll(), ElementsAre(1));
  EXPECT_EQ(recording->info().camera.left.height, 24);
}

TEST_F(StereoFolder, TakesTimesFromAListTheNamesOrTwoLists) {
  writeText(folder / "calib.txt", kMiddlebury);
  writeImage("cam0/1403636579763555584.png", 1);
  writeImage("cam1/1403636579763555584.png", 101);
  writeImage("cam0/1403636579813555456.png", 2);
  writeImage("cam1/1403636579813555456.png", 102);
  readAll();
  EXPECT_THAT(stamps_s, ElementsAre(1403636579.763555584, 1403636579.813555456));
  EXPECT_FALSE(recording->info().nominal_stamps);

  writeText(folder / "times.txt", "0.25\n0.75\n");
  readAll();
  EXPECT_THAT(stamps_s, ElementsAre(0.25, 0.75));

  writeText(folder / "left.txt", "7.0 cam0/1403636579763555584.png\n");
  writeText(folder / "right.txt",
            "3.0 cam1/1403636579813555456.png\n7.001 cam1/1403636579763555584.png\n");
  EXPECT_THAT(readAll(), ElementsAre(1));
  EXPECT_THAT(stamps_s, ElementsAre(7.0));
}

TEST_F(StereoFolder, PairsByTimeWhereTheNamesDiffer) {
  writeText(folder / "calib.txt", kMiddlebury);
  for (const int n : {1, 2, 3}) {
    writeImage("left/5." + std::to_string(n) + "00.png", n);
    if (n != 2) writeImage("right/5." + std::to_string(n) + "03.png", 100 + n);
  }
  EXPECT_THAT(readAll(), ElementsAre(1, 3));
  ASSERT_THAT(recording->skipped(), SizeIs(1));
  EXPECT_EQ(recording->skipped()[0].reason,
            (folder / "left/5.200.png").string() + ": the right image of this pair is missing");
}

TEST_F(StereoFolder, PairsInOrderWhereNothingElseHelps) {
  writeText(folder / "calib.txt", kMiddlebury);
  for (const int n : {1, 2}) {
    writeImage("left/l" + std::to_string(n) + ".png", n);
    writeImage("right/r" + std::to_string(n) + ".png", 100 + n);
  }
  EXPECT_THAT(readAll(), ElementsAre(1, 2));
  writeImage("left/l3.png", 3);
  EXPECT_EQ(messageOf([&] { openRecording(folder.path()); }),
            folder.path().string() +
                ": the left and right images (3 and 2) can't be paired, neither by name nor by "
                "number");
}

TEST_F(StereoFolder, LeavesOutPairsThatAreDamagedAndSaysWhy) {
  writeText(folder / "calib.txt", kMiddlebury);
  for (const int n : {1, 2, 3, 4, 5}) {
    writeImage("left/" + std::to_string(n) + ".png", n);
    writeImage("right/" + std::to_string(n) + ".png", 100 + n);
  }
  std::filesystem::remove(folder / "right/1.png");
  std::filesystem::remove(folder / "left/2.png");
  heel::test::truncateBy(folder / "left/3.png", 15);
  writeImage("right/4.png", 104, {24, 32});
  EXPECT_THAT(readAll(), ElementsAre(5));
  std::vector<std::string> reasons;
  for (const auto& skipped : recording->skipped()) reasons.push_back(skipped.reason);
  EXPECT_THAT(
      reasons,
      ElementsAre((folder / "left/1.png").string() + ": the right image of this pair is missing",
                  (folder / "right/2.png").string() + ": the left image of this pair is missing",
                  (folder / "left/3.png").string() + ": the image is truncated",
                  (folder / "right/4.png").string() +
                      ": the image is 24x32, but the calibration says 32x24"));
}

TEST_F(StereoFolder, SaysWhichSideHasNoImages) {
  writeImage("left/1.png", 1);
  writeText(folder / "calib.txt", kMiddlebury);
  EXPECT_EQ(messageOf([&] { openRecording(folder.path()); }),
            (folder / "right").string() + ": there are no images");
  const TempFolder other;
  cv::imwrite((other / "right1.png").string(), cv::Mat(kSize, CV_8UC3));
  EXPECT_EQ(messageOf([&] { openRecording(other.path()); }),
            (other / "left*.png").string() + ": there are no images");
}

TEST_F(StereoFolder, SaysWhatTheCalibrationLacks) {
  writeImage("left/1.png", 1);
  writeImage("right/1.png", 101);
  EXPECT_THAT(messageOf([&] { openRecording(folder.path()); }),
              HasSubstr(folder.path().string() + ": it holds no calibration"));
  writeText(folder / "left.yaml", cameraInfo(0.0, 0.0));
  writeText(folder / "right.yaml", cameraInfo(0.0, 0.0));
  EXPECT_THAT(messageOf([&] { openRecording(folder.path()); }),
              HasSubstr("there is no baseline between the cameras"));
}

TEST_F(StereoFolder, TakesRateAndMountingFromTheCameraFile) {
  writeImage("im0.png", 1);
  writeImage("im1.png", 101);
  writeText(folder / "calib.txt", kMiddlebury);
  writeText(folder / "camera.yaml",
            "rate_hz: 4\nT_ground_camera: [0,0,1,0, -1,0,0,0, 0,-1,0,1.2, 0,0,0,1]\n");
  recording = openRecording(folder.path());
  ASSERT_TRUE(recording->info().T_base_camera.has_value());
  EXPECT_EQ(recording->info().T_base_camera->translation().z(), 1.2);
}

TEST(FilesIn, ComeInTheOrderOfTheirNumbers) {
  const TempFolder folder;
  for (const char* name : {"a10.png", "a9.png", "a09.png", "b1.png", "a9b.png", "a.png"}) {
    writeText(folder / name, "");
  }
  std::filesystem::create_directory(folder / "a5.png");
  std::vector<std::string> names;
  for (const auto& file : heel::filesIn(folder.path(), [](const auto&) { return true; })) {
    names.push_back(file.filename());
  }
  EXPECT_THAT(names, ElementsAre("a.png", "a09.png", "a9.png", "a9b.png", "a10.png", "b1.png"));
  EXPECT_THAT(heel::filesIn(folder / "none", [](const auto&) { return true; }), IsEmpty());
}

class RealPair : public testing::TestWithParam<std::string> {};

TEST_P(RealPair, IsARecordingOfOneFrame) {
  const std::string name = "stereo_pairs/" + GetParam();
  HEEL_NEED_DATA(name);
  const auto recording = openRecording(heel::test::dataFolder() / name);
  EXPECT_EQ(recording->info().name, GetParam());
  EXPECT_EQ(recording->info().sensor, heel::SensorKind::kStereo);
  heel::Frame frame;
  ASSERT_TRUE(recording->next(frame));
  const auto& left = recording->info().camera.left;
  EXPECT_EQ(frame.image_bgr.size(), cv::Size(left.width, left.height));
  EXPECT_EQ(frame.right_bgr.size(), frame.image_bgr.size());
  EXPECT_GT(cv::norm(frame.image_bgr, frame.right_bgr, cv::NORM_INF), 50.0);
  EXPECT_FALSE(recording->next(frame));
  EXPECT_THAT(recording->skipped(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Data, RealPair,
                         testing::Values("Adirondack", "Motorcycle", "Piano", "Teddy"));

}  // namespace
