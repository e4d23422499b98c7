// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/cloud/stereo_calibration.hpp>
#include <heel/cloud/stereo_rig.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const cv::Size kSize(640, 480);

/// A pair 0.12 m apart, a little turned against each other, with distortion.
struct RawPair {
  cv::Mat K1 = (cv::Mat_<double>(3, 3) << 510, 0, 325, 0, 508, 236, 0, 0, 1);
  cv::Mat K2 = (cv::Mat_<double>(3, 3) << 515, 0, 316, 0, 513, 244, 0, 0, 1);
  cv::Mat D1 = (cv::Mat_<double>(1, 5) << -0.2, 0.05, 0.001, -0.001, 0.0);
  cv::Mat D2 = (cv::Mat_<double>(1, 5) << -0.18, 0.04, 0.0, 0.001, 0.0);
  cv::Mat R, T = (cv::Mat_<double>(3, 1) << -0.12, 0.002, -0.003);
  RawPair() { cv::Rodrigues(cv::Vec3d(0.01, -0.02, 0.015), R); }
};

/// A folder of its own for each test, removed at the end.
class StereoCalibration : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }

  test::TempFolder folder_;
};

void store(cv::FileStorage& storage, const RawPair& pair,
           const std::vector<std::string>& names = {"M1", "D1", "M2", "D2", "R", "T"}) {
  const std::vector<cv::Mat> values = {pair.K1, pair.D1, pair.K2, pair.D2, pair.R, pair.T};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) storage << names[i] << values[i];
  }
}

fs::path storePair(const fs::path& file, const RawPair& pair,
                   const std::vector<std::string>& names = {"M1", "D1", "M2", "D2", "R", "T"},
                   bool with_size = true) {
  cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
  if (with_size) storage << "image_width" << kSize.width << "image_height" << kSize.height;
  store(storage, pair, names);
  return file;
}

/// Where raw cameras see points of the left camera's frame.
std::vector<cv::Point2d> project(const std::vector<cv::Point3d>& points, const cv::Mat& R,
                                 const cv::Mat& T, const cv::Mat& K, const cv::Mat& D) {
  std::vector<cv::Point2d> pixels;
  cv::Mat rotation;
  cv::Rodrigues(R, rotation);
  cv::projectPoints(points, rotation, T, K, D, pixels);
  return pixels;
}

/// A soft spot; it is moved, but not torn, by rectification.
cv::Mat spotImage(const cv::Point2d& at) {
  cv::Mat image(kSize, CV_32FC1);
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const double r2 = (x - at.x) * (x - at.x) + (y - at.y) * (y - at.y);
      image.at<float>(y, x) = static_cast<float>(255.0 * std::exp(-r2 / 18.0));
    }
  }
  return image;
}

cv::Point2d spot(const cv::Mat& image) {
  const cv::Moments m = cv::moments(image);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

TEST_F(StereoCalibration, RectifiedRawImagesMeasureTheTruth) {
  const RawPair pair;
  const StereoRig rig = readOpenCvCalibration({storePair(folder_ / "stereo.yml", pair)});
  EXPECT_FALSE(rig.isRectified());
  EXPECT_NEAR(rig.camera().baseline_m, cv::norm(pair.T), 1e-9);
  EXPECT_EQ(rig.camera().left.width, 640);
  const std::vector<cv::Point3d> points = {{0.1, 0.0, 1.5}, {-0.3, 0.2, 2.0}, {0.5, -0.4, 3.0}};
  const auto left =
      project(points, cv::Mat::eye(3, 3, CV_64F), cv::Mat::zeros(3, 1, CV_64F), pair.K1, pair.D1);
  const auto right = project(points, pair.R, pair.T, pair.K2, pair.D2);
  std::vector<cv::Point3d> measured;
  const StereoCamera& c = rig.camera();
  for (std::size_t i = 0; i < points.size(); ++i) {
    cv::Mat rectified_left, rectified_right;
    rig.rectify(spotImage(left[i]), spotImage(right[i]), rectified_left, rectified_right);
    const cv::Point2d l = spot(rectified_left), r = spot(rectified_right);
    EXPECT_NEAR(l.y, r.y, 0.1) << "rows agree";
    const double z = c.left.fx * c.baseline_m / (l.x - r.x + c.disparity_offset);
    measured.emplace_back((l.x - c.left.cx) * z / c.left.fx, (l.y - c.left.cy) * z / c.left.fy, z);
  }
  // Rectification turns the frame, which keeps lengths.
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(cv::norm(measured[i]), cv::norm(points[i]), 0.01);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(cv::norm(measured[i] - measured[j]), cv::norm(points[i] - points[j]), 0.02);
    }
  }
}

TEST_F(StereoCalibration, KnowsTheNamesThatPeopleGive) {
  const RawPair pair;
  const double baseline_m = cv::norm(pair.T);
  const std::vector<std::vector<std::string>> conventions = {
      {"K1", "D1", "K2", "D2", "R", "T"},
      {"cameraMatrix1", "distCoeffs1", "cameraMatrix2", "distCoeffs2", "R", "T"},
      {"camera_matrix_left", "dist_coeffs_left", "camera_matrix_right", "dist_coeffs_right",
       "rotation_matrix", "translation_vector"},
      {"left_camera_matrix", "left_distortion_coefficients", "right_camera_matrix",
       "right_distortion_coefficients", "R", "T"}};
  for (const char* file : {"stereo.yml", "stereo.xml", "stereo.json"}) {
    for (const auto& names : conventions) {
      EXPECT_NEAR(readStereoRig(storePair(folder_ / file, pair, names)).camera().baseline_m,
                  baseline_m, 1e-9)
          << names[0] << " in " << file;
    }
  }
}

/// The rig of a file that holds everything, as cv::FileStorage itself reads it.
StereoRig oracleRig(const fs::path& file) {
  const cv::FileStorage storage(file.string(), cv::FileStorage::READ);
  RawCamera cameras[2];
  for (int i = 0; i < 2; ++i) {
    RawCamera& camera = cameras[i];
    for (const auto& [letter, value] :
         {std::pair{"M", &camera.K}, std::pair{"D", &camera.distortion}, std::pair{"R", &camera.R},
          std::pair{"P", &camera.P}}) {
      cv::Mat stored;
      storage[letter + std::to_string(i + 1)] >> stored;
      stored.convertTo(*value, CV_64F);
    }
  }
  cv::Size size;
  storage["imageSize"] >> size;
  return StereoRig(cameras[0], cameras[1], size, file.string());
}

TEST_F(StereoCalibration, ReadsTheVeryNumbersThatOpenCvReads) {
  RawPair pair;
  cv::RNG random(3);
  const auto jitter = [&](cv::Mat1d values) {  // so that all digits count
    for (double& value : values) value *= 1.0 + random.gaussian(1e-3);
  };
  for (const cv::Mat* values : {&pair.K1, &pair.K2, &pair.D1, &pair.D2, &pair.T}) jitter(*values);
  cv::Mat R1, R2, P1, P2, Q;
  cv::stereoRectify(pair.K1, pair.D1, pair.K2, pair.D2, kSize, pair.R, pair.T, R1, R2, P1, P2, Q);
  cv::Mat left(kSize, CV_8UC3), right(kSize, CV_8UC3);
  random.fill(left, cv::RNG::UNIFORM, 0, 256);
  random.fill(right, cv::RNG::UNIFORM, 0, 256);
  for (const char* name : {"stereo.yml", "stereo.yaml", "stereo.xml", "stereo.json"}) {
    for (const int type : {CV_64F, CV_32F}) {
      const fs::path file = folder_ / name;
      {
        cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
        storage << "calibration_time"
                << "Sun, 1 Nov: \"noon\""
                << "imageSize" << kSize;
        storage << "board"
                << "{"
                << "rows" << 7 << "corners" << std::vector<float>{1.5F} << "}";
        const std::vector<std::pair<std::string, cv::Mat>> all = {
            {"M1", pair.K1}, {"D1", pair.D1}, {"M2", pair.K2}, {"D2", pair.D2},
            {"R", pair.R},   {"T", pair.T},   {"R1", R1},      {"R2", R2},
            {"P1", P1},      {"P2", P2},      {"Q", Q}};
        for (const auto& [key, value] : all) {
          cv::Mat stored;
          value.convertTo(stored, type);
          storage << key << stored;
        }
      }
      SCOPED_TRACE(name);
      const StereoRig oracle = oracleRig(file), ours = readStereoRig(file);
      const StereoCamera &a = oracle.camera(), &b = ours.camera();
      EXPECT_EQ(a.left.width, b.left.width);
      EXPECT_EQ(a.left.height, b.left.height);
      EXPECT_EQ(a.left.fx, b.left.fx);
      EXPECT_EQ(a.left.fy, b.left.fy);
      EXPECT_EQ(a.left.cx, b.left.cx);
      EXPECT_EQ(a.left.cy, b.left.cy);
      EXPECT_EQ(a.baseline_m, b.baseline_m);
      EXPECT_EQ(a.disparity_offset, b.disparity_offset);
      cv::Mat left_a, right_a, left_b, right_b;
      oracle.rectify(left, right, left_a, right_a);
      ours.rectify(left, right, left_b, right_b);
      EXPECT_EQ(cv::norm(left_a, left_b, cv::NORM_INF), 0.0);
      EXPECT_EQ(cv::norm(right_a, right_b, cv::NORM_INF), 0.0);
    }
  }
}

TEST_F(StereoCalibration, ReadsTheTwoFilesOfOpenCvsSample) {
  const RawPair pair;
  storePair(folder_ / "intrinsics.yml", pair, {"M1", "D1", "M2", "D2", "", ""}, false);
  storePair(folder_ / "extrinsics.yml", pair, {"", "", "", "", "R", "T"}, false);
  EXPECT_NEAR(readStereoRig(folder_.path(), kSize).camera().baseline_m, cv::norm(pair.T), 1e-9);
  EXPECT_THAT(test::messageOf([&] { readStereoRig(folder_.path()); }),
              AllOf(HasSubstr("intrinsics.yml"), HasSubstr("size of the images is not given")));
}

TEST_F(StereoCalibration, TakesAStoredRectificationAsItIs) {
  const RawPair pair;
  cv::Mat R1, R2, P1, P2, Q;
  cv::stereoRectify(pair.K1, pair.D1, pair.K2, pair.D2, kSize, pair.R, pair.T, R1, R2, P1, P2, Q,
                    cv::CALIB_ZERO_DISPARITY, 0.5);
  const fs::path file = folder_ / "stereo.yml";
  {
    cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
    storage << "imageSize" << kSize;
    store(storage, pair);
    storage << "R1" << R1 << "R2" << R2 << "P1" << P1 << "P2" << P2 << "Q" << Q;
  }
  const StereoCamera camera = readStereoRig(file).camera();
  EXPECT_DOUBLE_EQ(camera.left.fx, P1.at<double>(0, 0));
  EXPECT_DOUBLE_EQ(camera.left.cx, P1.at<double>(0, 2));
  EXPECT_NEAR(camera.baseline_m, cv::norm(pair.T), 1e-9);
}

TEST_F(StereoCalibration, HandsRectifiedImagesOnUntouched) {
  const fs::path file = folder_ / "stereo.yml";
  const cv::Mat P1 = (cv::Mat_<double>(3, 4) << 500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0);
  const cv::Mat P2 = (cv::Mat_<double>(3, 4) << 500, 0, 330, -50, 0, 500, 240, 0, 0, 0, 1, 0);
  {
    cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
    storage << "image_width" << 640 << "image_height" << 480 << "P1" << P1 << "P2" << P2;
  }
  const StereoRig rig = readStereoRig(file);
  EXPECT_TRUE(rig.isRectified());
  EXPECT_DOUBLE_EQ(rig.camera().baseline_m, 0.1);
  EXPECT_DOUBLE_EQ(rig.camera().disparity_offset, 10.0);
  const cv::Mat left(kSize, CV_8UC3, cv::Scalar::all(1)), right = left.clone();
  cv::Mat l, r;
  rig.rectify(left, right, l, r);
  EXPECT_EQ(l.data, left.data);
  EXPECT_EQ(r.data, right.data);
  EXPECT_THROW(rig.rectify(left, right.colRange(0, 600), l, r), std::invalid_argument);
}

TEST_F(StereoCalibration, RefusesASizeThatAsksForTooMuchMemory) {
  cv::FileStorage storage((folder_ / "huge.yml").string(), cv::FileStorage::WRITE);
  storage << "image_width" << 60000 << "image_height" << 60000;
  store(storage, {});
  storage.release();
  EXPECT_THAT(test::messageOf([&] { readStereoRig(folder_ / "huge.yml"); }),
              AllOf(HasSubstr("huge.yml"), HasSubstr("60000x60000 pixels asks for")));
  EXPECT_THAT(test::messageOf([&] {
                readStereoRig(write("calib.txt",
                                    "cam0=[900 0 300; 0 900 200; 0 0 1]\ndoffs=0\n"
                                    "baseline=100\nwidth=1e300\nheight=60000\n"));
              }),
              AllOf(HasSubstr("calib.txt"), HasSubstr("asks for")));
}

TEST_F(StereoCalibration, WithoutASizeIsHeldToWhereTheMiddleOfItsLensIs) {
  const auto file =
      storePair(folder_ / "stereo.yml", {}, {"M1", "D1", "M2", "D2", "R", "T"}, false);
  EXPECT_EQ(readStereoRig(file, kSize).camera().left.width, kSize.width);
  for (const cv::Size& size : {kSize / 2, kSize * 2}) {
    EXPECT_THAT(test::messageOf([&] { readStereoRig(file, size); }),
                AllOf(HasSubstr("stereo.yml"), HasSubstr("is of others than these images")));
  }
}

TEST_F(StereoCalibration, NamesTheFileAndTheReason) {
  const auto said = [&](const fs::path& file) {
    return test::messageOf([&] { readStereoRig(file); });
  };
  const auto stored = [&](const RawPair& pair, const std::vector<std::string>& names) {
    return said(storePair(folder_ / "bad.yml", pair, names));
  };
  EXPECT_THAT(said(folder_ / "none.yml"), AllOf(HasSubstr("none.yml"), HasSubstr("no such file")));
  EXPECT_THAT(test::messageOf([&] { readOpenCvCalibration({folder_ / "none.yml"}); }),
              AllOf(HasSubstr("none.yml"), HasSubstr("no such file")));
  EXPECT_THAT(said(write("text.yml", "hello\n")),
              AllOf(HasSubstr("text.yml"), HasSubstr("holds no named values")));
  EXPECT_THAT(said(write("torn.yml", "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: [")),
              AllOf(HasSubstr("torn.yml"), HasSubstr("not YAML (line 4)")));
  EXPECT_THAT(said(write("torn.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n<M1>")),
              AllOf(HasSubstr("torn.xml"), HasSubstr("not XML")));
  EXPECT_THAT(said(write("other.xml", "<?xml version=\"1.0\"?>\n<pnml/>")),
              HasSubstr("holds no named values"));
  EXPECT_THAT(said(write("long.yml", std::string(2 << 20, ' '))),
              AllOf(HasSubstr("long.yml"), HasSubstr("too large for a calibration")));
  const auto repeated = [](const std::string& text) {
    std::string all;
    for (int i = 0; i < 50000; ++i) all += text;
    return all;
  };
  for (const char* text : {"[", "{", "- ", "? ", "[{"}) {
    EXPECT_THAT(said(write("deep.yml", "%YAML:1.0\n---\nM1:\n" + repeated(text))),
                AllOf(HasSubstr("deep.yml"), HasSubstr("not YAML")))
        << text;
  }
  EXPECT_THAT(said(write("deep.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n" +
                                         repeated("<a>") + repeated("</a>") + "</opencv_storage>")),
              AllOf(HasSubstr("deep.xml"), HasSubstr("(M1) is missing")));
  for (const char* value :
       {"\n  rows: 40000\n  cols: 40000\n  dt: d\n  data: [ 1. ]",
        "\n  rows: -1\n  cols: -1\n  dt: d\n  data: [ 1. ]",
        "\n  rows: 3\n  cols: three\n  dt: d\n  data: [ 1. ]",
        "\n  rows: 3\n  cols: 3\n  dt: d\n  data: [ 1, 2, 3 ]",
        "\n  rows: 1\n  cols: 1\n  dt: d\n  data: [ one ]", " [ 1, 2 ]", " 7"}) {
    EXPECT_THAT(said(write("shape.yml", "%YAML:1.0\n---\nM1:" + std::string(value) + "\n")),
                AllOf(HasSubstr("shape.yml"), HasSubstr("M1 has not the right shape")))
        << value;
  }
  EXPECT_THAT(stored({}, {"", "D1", "M2", "D2", "R", "T"}),
              AllOf(HasSubstr("bad.yml"), HasSubstr("(M1) is missing")));
  EXPECT_THAT(stored({}, {"M1", "D1", "M2", "", "R", "T"}), HasSubstr("(D2) is missing"));
  EXPECT_THAT(stored({}, {"M1", "D1", "M2", "D2", "", "T"}), HasSubstr("(R) is missing"));
  EXPECT_THAT(stored({}, {"M1", "D1", "M2", "D2", "R", ""}), HasSubstr("(T) is missing"));
  RawPair pair;
  pair.D2 = cv::Mat::ones(1, 6, CV_64F);
  EXPECT_THAT(stored(pair, {"M1", "D1", "M2", "D2", "R", "T"}),
              AllOf(HasSubstr("bad.yml: a distortion of 6 numbers is not known")));
  pair = {};
  pair.T = cv::Mat::zeros(3, 1, CV_64F);
  EXPECT_THAT(stored(pair, {"M1", "D1", "M2", "D2", "R", "T"}), HasSubstr("no baseline"));
  pair.T.at<double>(0) = -120.0;
  EXPECT_THAT(stored(pair, {"M1", "D1", "M2", "D2", "R", "T"}), HasSubstr("in metres"));
  pair.T.at<double>(0) = 0.12;
  EXPECT_THAT(stored(pair, {"M1", "D1", "M2", "D2", "R", "T"}), HasSubstr("swapped"));
  pair.T = (cv::Mat_<double>(3, 1) << 0.0, -0.12, 0.0);
  EXPECT_THAT(stored(pair, {"M1", "D1", "M2", "D2", "R", "T"}), HasSubstr("above each other"));
  pair.K1 = cv::Mat::eye(2, 2, CV_64F);
  EXPECT_THAT(stored(pair, {"M1", "D1", "M2", "D2", "R", "T"}), HasSubstr("M1 has not the right"));
  EXPECT_THAT(said(folder_ / "."), HasSubstr("holds no calibration"));
}

std::string cameraInfo(const std::string& P, const std::string& D = "[-0.2, 0.05, 0, 0, 0]",
                       const std::string& more = "") {
  return "image_width: 640\nimage_height: 480\ncamera_name: left\n"
         "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [500, 0, 320, 0, 500, 240, 0, 0, 1]\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: " +
         D +
         "\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
         "projection_matrix:\n  rows: 3\n  cols: 4\n  data: " +
         P + "\n" + more;
}
const char* const kLeftP = "[500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0]";
const char* const kRightP = "[500, 0, 320, -60, 0, 500, 240, 0, 0, 0, 1, 0]";

TEST_F(StereoCalibration, ReadsAPairOfRosFiles) {
  write("left.yaml", cameraInfo(kLeftP));
  write("right.yaml", cameraInfo(kRightP));
  const StereoRig raw = readStereoRig(folder_.path());
  EXPECT_DOUBLE_EQ(raw.camera().baseline_m, 0.12);
  EXPECT_DOUBLE_EQ(raw.camera().left.fx, 500.0);
  EXPECT_EQ(raw.camera().left.height, 480);
  EXPECT_FALSE(raw.isRectified());
  write("left.yaml", cameraInfo(kLeftP, "[0, 0, 0, 0, 0]"));
  write("right.yaml", cameraInfo(kRightP, "[]"));
  EXPECT_TRUE(readStereoRig(folder_.path()).isRectified());
}

/// `camera_info` of a fisheye, turned in its pair.
std::string fisheyeInfo(const cv::Mat& R, double minus_fx_baseline) {
  std::ostringstream text;
  text << "height: 480\nwidth: 640\ndistortion_model: equidistant\nD: [-0.1, 0.02, 0.01, 0.001]\n"
       << "K: [300, 0, 325, 0, 301, 236, 0, 0, 1]\nR: " << R.reshape(1, 1) << "\nP: [280, 0, 320, "
       << minus_fx_baseline << ", 0, 280, 240, 0, 0, 0, 1, 0]\n";
  return text.str();
}

TEST_F(StereoCalibration, OfFisheyesRectifiesByTheirModel) {
  cv::Mat turned[2];
  cv::Rodrigues(cv::Vec3d(0.02, -0.03, 0.01), turned[0]);
  cv::Rodrigues(cv::Vec3d(-0.01, 0.02, -0.02), turned[1]);
  const StereoRig rig = readCameraInfo(write("l.yaml", fisheyeInfo(turned[0], 0.0)),
                                       write("r.yaml", fisheyeInfo(turned[1], -28.0)));
  EXPECT_DOUBLE_EQ(rig.camera().baseline_m, 0.1);
  const cv::Matx33d K(300, 0, 325, 0, 301, 236, 0, 0, 1);
  for (const cv::Vec3d& point : {cv::Vec3d(0.1, 0.0, 1.5), cv::Vec3d(-1.2, 0.6, 2.0)}) {
    cv::Mat raw[2], rectified[2];
    for (const int side : {0, 1}) {
      // R takes the camera's frame to the rectified one, in which the right camera is 0.1 m aside.
      const cv::Vec3d seen = point - cv::Vec3d(0.1 * side, 0.0, 0.0);
      cv::Mat rotation;
      cv::Rodrigues(turned[side].t(), rotation);
      std::vector<cv::Point2d> pixel;
      cv::fisheye::projectPoints(std::vector<cv::Point3d>{cv::Point3d(seen)}, pixel, rotation,
                                 cv::Vec3d(), K, cv::Vec4d(-0.1, 0.02, 0.01, 0.001));
      raw[side] = spotImage(pixel[0]);
    }
    rig.rectify(raw[0], raw[1], rectified[0], rectified[1]);
    for (const int side : {0, 1}) {
      const cv::Point2d at = spot(rectified[side]);
      EXPECT_NEAR(at.x, 320 + 280 * (point[0] - 0.1 * side) / point[2], 0.3) << side;
      EXPECT_NEAR(at.y, 240 + 280 * point[1] / point[2], 0.3) << side;
    }
  }
}

TEST_F(StereoCalibration, ReadsEchoedRosMessages) {
  const auto message = [](const std::string& P) {
    return "height: 480\nwidth: 640\ndistortion_model: plumb_bob\nD: [0, 0, 0, 0, 0]\n"
           "K: [500, 0, 320, 0, 500, 240, 0, 0, 1]\nR: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nP: " +
           P + "\n";
  };
  const fs::path left = write("l.yaml", message(kLeftP)), right = write("r.yaml", message(kRightP));
  EXPECT_DOUBLE_EQ(readCameraInfo(left, right).camera().baseline_m, 0.12);
}

TEST_F(StereoCalibration, SaysWhatIsWrongWithARosFile) {
  const fs::path left = write("left.yaml", cameraInfo(kLeftP));
  const auto said = [&](const std::string& right) {
    const fs::path file = write("right.yaml", right);
    return test::messageOf([&] { readCameraInfo(left, file); });
  };
  EXPECT_THAT(test::messageOf([&] { readStereoRig(folder_.path()); }),
              AllOf(HasSubstr("right.yaml"), HasSubstr("no such file")));
  EXPECT_THAT(said(cameraInfo(kLeftP)), AllOf(HasSubstr("right.yaml"), HasSubstr("no baseline")));
  EXPECT_THAT(said(cameraInfo("[500, 0, 320, 60, 0, 500, 240, 0, 0, 0, 1, 0]")),
              HasSubstr("swapped"));
  EXPECT_THAT(said(cameraInfo("[1, 2]")), HasSubstr("projection_matrix has not 12 elements"));
  EXPECT_THAT(said(cameraInfo("[a, b]")), HasSubstr("not a list of numbers"));
  EXPECT_THAT(said("image_width: 640\nimage_height: 480\n"), HasSubstr("camera_matrix is missing"));
  EXPECT_THAT(said("image_width: 640\n"), HasSubstr("image_height is missing"));
  EXPECT_THAT(said("image_width: x\nimage_height: 3\n"), HasSubstr("not a number"));
  EXPECT_THAT(said("a: [1,"), HasSubstr("not YAML"));
  EXPECT_THAT(said("hello"), HasSubstr("no named values"));
  const auto ofModel = [](const std::string& model, const std::string& D) {
    std::string text = cameraInfo(kRightP, D);
    return text.replace(text.find("plumb_bob"), 9, model);
  };
  EXPECT_THAT(said(ofModel("equidistant", "[-0.2, 0.05, 0, 0, 0]")),
              AllOf(HasSubstr("right.yaml"), HasSubstr("5 numbers"), HasSubstr("equidistant (4)")));
  EXPECT_THAT(
      said(ofModel("kannala", "[-0.2, 0.05, 0, 0]")),
      AllOf(HasSubstr("right.yaml"), HasSubstr("the distortion model kannala is not known")));
  EXPECT_EQ(readCameraInfo(left, write("right.yaml", ofModel("kannala", "[0, 0, 0, 0]")))
                .camera()
                .baseline_m,
            0.12)
      << "no distortion is none, whatever its model";
  std::string small = cameraInfo(kRightP);
  small.replace(small.find("640"), 3, "320");
  EXPECT_THAT(said(small), HasSubstr("its image size is not that of"));
}

TEST_F(StereoCalibration, ReadsMiddleburysFile) {
  const std::string good =
      "cam0=[1000 0 300; 0 1001 250; 0 0 1]\ncam1=[1000 0 330; 0 1001 250; 0 0 1]\n"
      "doffs=30\nbaseline=176.252\n width= 718\nheight=496\nndisp=73\n";
  const StereoRig rig = readStereoRig(write("calib.txt", good));
  EXPECT_TRUE(rig.isRectified());
  EXPECT_DOUBLE_EQ(rig.camera().baseline_m, 0.176252);
  EXPECT_DOUBLE_EQ(rig.camera().disparity_offset, 30.0);
  EXPECT_DOUBLE_EQ(rig.camera().left.fy, 1001.0);
  EXPECT_EQ(rig.camera().left.width, 718);
  EXPECT_DOUBLE_EQ(readStereoRig(folder_.path()).camera().baseline_m, 0.176252);
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return test::messageOf([&] { readStereoRig(write("calib.txt", text)); });
  };
  EXPECT_THAT(said("baseline=176.252", ""),
              AllOf(HasSubstr("calib.txt"), HasSubstr("baseline is")));
  EXPECT_THAT(said("176.252", "0"), HasSubstr("no baseline"));
  EXPECT_THAT(said("cam0=[1000 0", "cam0=[1000"), HasSubstr("cam0 has not 9 numbers"));
  EXPECT_THAT(said("cam0=[1000", "cam0=[0"), HasSubstr("focal length"));
  EXPECT_THAT(test::messageOf([&] { readMiddleburyCalibration(folder_ / "no.txt"); }),
              HasSubstr("no such file"));
}

TEST(StereoRig, RefusesACameraWithoutBaseline) {
  EXPECT_THROW(StereoRig(StereoCamera{}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
