// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/commands/small_recording.hpp"

#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>

namespace heel::test {

namespace fs = std::filesystem;

namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocal_px = 131.25, kCenterU = 79.5, kCenterV = 59.5;
constexpr double kCameraHeight_m = 1.0, kWallDistance_m = 5.0, kFrame_s = 0.2;
const cv::Vec3b kTrousers = {110, 60, 30}, kFace = {140, 170, 215};

struct Place {
  double x_m, y_m;
};

/// Walks an ellipse before the camera, at about 1 m/s.
Place placeOf(int step) {
  const double angle = 2.0 * CV_PI * step / 40.0;
  return {3.0 + 0.4 * std::sin(angle), 1.2 * std::cos(angle)};
}

double heightAt(int v, double depth_m) {
  return kCameraHeight_m - (v - kCenterV) * depth_m / kFocal_px;
}

void drawRoom(cv::Mat& image, cv::Mat& depth_m) {
  for (int v = 0; v < kHeight; ++v) {
    const bool is_floor = heightAt(v, kWallDistance_m) < 0.0;
    image.row(v).setTo(is_floor ? SmallRecording::kFloor : SmallRecording::kWall);
    depth_m.row(v).setTo(is_floor ? kCameraHeight_m * kFocal_px / (v - kCenterV) : kWallDistance_m);
  }
}

/// An upright elliptic cylinder, 0.46 m wide and 0.3 m deep, in a person's colours.
void drawPerson(const Place& place, cv::Mat& image, cv::Mat& depth_m) {
  constexpr double kHalfWidth_m = 0.23, kHalfDepth_m = 0.15, kStature_m = 1.75;
  for (int u = 0; u < kWidth; ++u) {
    const double aside = ((kCenterU - u) * place.x_m / kFocal_px - place.y_m) / kHalfWidth_m;
    if (std::abs(aside) > 1.0) continue;
    const double x_m = place.x_m - kHalfDepth_m * std::sqrt(1.0 - aside * aside);
    for (int v = 0; v < kHeight; ++v) {
      const double height_m = heightAt(v, x_m);
      if (height_m < 0.0 || height_m > kStature_m) continue;
      const bool is_jumper = height_m > 0.9 && height_m <= 1.5;
      image.at<cv::Vec3b>(v, u) = is_jumper        ? SmallRecording::kJumper
                                  : height_m > 1.5 ? kFace
                                                   : kTrousers;
      depth_m.at<double>(v, u) = x_m;
    }
  }
}

void addNoise(double grey_levels, double spread_m, cv::RNG& rng, cv::Mat& image, cv::Mat& depth_m) {
  cv::Mat noise(image.size(), CV_16SC3);
  rng.fill(noise, cv::RNG::NORMAL, 0.0, grey_levels);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  cv::Mat depth_noise_m(depth_m.size(), depth_m.type());
  rng.fill(depth_noise_m, cv::RNG::NORMAL, 0.0, spread_m);
  depth_m += depth_noise_m;
}

std::string numbered(const char* format, int number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

void write(const fs::path& file, const cv::Mat& image) {
  cv::imwrite(file.string(), image, {cv::IMWRITE_PNG_COMPRESSION, 1});
}

}  // namespace

fs::path colorImage(const fs::path& folder, int number) {
  return folder / numbered("rgb/%04d.png", number);
}

fs::path depthImage(const fs::path& folder, int number) {
  return folder / numbered("depth/%04d.png", number);
}

void SmallRecording::write(const fs::path& folder) const {
  fs::create_directories(folder / "rgb");
  fs::create_directories(folder / "depth");
  std::ofstream colors(folder / "rgb.txt"), depths(folder / "depth.txt");
  std::ofstream truth(folder / "truth.csv");
  truth << "stamp_s,frame,person,x_m,y_m,exact\n";
  cv::Mat image(kHeight, kWidth, CV_8UC3), depth_m(kHeight, kWidth, CV_64FC1), depth_mm;
  cv::RNG rng(7);
  for (int number = 1; number <= frames(); ++number) {
    const double stamp_s = kFrame_s * (number - 1);
    drawRoom(image, depth_m);
    if (number > empty_frames) {
      const Place place = placeOf(number - empty_frames);
      drawPerson(place, image, depth_m);
      truth << stamp_s << ',' << number << ",rosa," << place.x_m << ',' << place.y_m << ",1\n";
    }
    addNoise(3.0, 0.004, rng, image, depth_m);
    depth_m.convertTo(depth_mm, CV_16U, 1000.0);
    test::write(colorImage(folder, number), image);
    test::write(depthImage(folder, number), depth_mm);
    colors << stamp_s << numbered(" rgb/%04d.png\n", number);
    depths << stamp_s << numbered(" depth/%04d.png\n", number);
  }
  std::ofstream camera(folder / "camera.yaml");
  camera << "width: 160\nheight: 120\nfx: 131.25\nfy: 131.25\ncx: 79.5\ncy: 59.5\n"
            "depth_scale: 1000\n";
  if (has_mounting) camera << "T_ground_camera: [0,0,1,0, -1,0,0,0, 0,-1,0,1, 0,0,0,1]\n";
}

}  // namespace heel::test
