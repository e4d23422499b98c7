// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/image_extent.hpp>
#include <heel/cloud/stereo_rig.hpp>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

/// Beyond this, a length was most likely not given in metres.
constexpr double kLongestBaseline_m = 10.0;

StereoCamera rectifiedCamera(const cv::Mat& left, const cv::Mat& right, cv::Size size) {
  StereoCamera camera;
  camera.left = {size.width,
                 size.height,
                 left.at<double>(0, 0),
                 left.at<double>(1, 1),
                 left.at<double>(0, 2),
                 left.at<double>(1, 2)};
  // Both projections are of one frame, the left's: P(0, 3) = -fx * the way to the camera.
  camera.baseline_m = left.at<double>(0, 3) / left.at<double>(0, 0) -
                      right.at<double>(0, 3) / right.at<double>(0, 0);
  camera.disparity_offset = right.at<double>(0, 2) - left.at<double>(0, 2);
  return camera;
}

void check(const StereoCamera& camera, const cv::Mat& left_P, const cv::Mat& right_P,
           const std::string& origin) {
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error(origin + ": " + reason);
  };
  const double b = camera.baseline_m;
  checkCameraMemory(origin, camera.left.width, camera.left.height);
  if (!(camera.left.fx > 0.0) || !(camera.left.fy > 0.0)) fail("a focal length is not positive");
  if (!cv::checkRange(right_P) || !cv::checkRange(left_P)) fail("a number is not finite");
  if (std::abs(right_P.at<double>(1, 3)) > std::abs(right_P.at<double>(0, 3))) {
    fail("the cameras stand above each other; only pairs side by side can be matched");
  }
  if (!std::isfinite(b) || std::abs(b) < 1e-6) fail("there is no baseline between the cameras");
  if (b < 0.0) fail("the left and right cameras are swapped, the baseline is negative");
  if (b > kLongestBaseline_m) {
    fail("the baseline is " + std::to_string(b) + " m; give lengths in metres");
  }
}

/// Whether rectifying would move no pixel.
bool isIdentity(const RawCamera& camera) {
  const bool undistorted =
      camera.distortion.empty() || cv::norm(camera.distortion, cv::NORM_INF) < 1e-12;
  const cv::Mat new_K = camera.P.colRange(0, 3);
  return undistorted && cv::norm(camera.R, cv::Mat::eye(3, 3, CV_64F), cv::NORM_INF) < 1e-9 &&
         cv::norm(camera.K, new_K, cv::NORM_INF) < 1e-3;
}

}  // namespace

void setDistortion(const std::string& origin, const std::string& model, const cv::Mat& numbers,
                   RawCamera& camera) {
  if (numbers.empty() || cv::norm(numbers, cv::NORM_INF) < 1e-12) return;
  camera.is_fisheye = model == "equidistant";
  if (!camera.is_fisheye && model != "plumb_bob" && model != "rational_polynomial" &&
      !model.empty()) {
    throw std::runtime_error(origin + ": the distortion model " + model +
                             " is not known (plumb_bob, rational_polynomial, equidistant)");
  }
  camera.distortion = numbers.reshape(1, 1).clone();
}

void checkDistortion(const std::string& origin, const RawCamera& camera) {
  const std::size_t numbers = camera.distortion.total();
  if (camera.is_fisheye && numbers != 4) {
    throw std::runtime_error(origin + ": a distortion of " + std::to_string(numbers) +
                             " numbers is not known of the model equidistant (4)");
  }
  for (const std::size_t known : {0U, 4U, 5U, 8U, 12U, 14U}) {
    if (numbers == known) return;
  }
  throw std::runtime_error(origin + ": a distortion of " + std::to_string(numbers) +
                           " numbers is not known (4, 5, 8, 12 or 14)");
}

void makeRectifyMaps(const RawCamera& camera, cv::Size image_size, int type, cv::Mat& first,
                     cv::Mat& second) {
  if (camera.is_fisheye) {
    cv::fisheye::initUndistortRectifyMap(camera.K, camera.distortion, camera.R, camera.P,
                                         image_size, type, first, second);
  } else {
    cv::initUndistortRectifyMap(camera.K, camera.distortion, camera.R, camera.P, image_size, type,
                                first, second);
  }
}

StereoRig::StereoRig(RawCamera left, RawCamera right, cv::Size image_size,
                     const std::string& origin)
    : camera_(rectifiedCamera(left.P, right.P, image_size)) {
  check(camera_, left.P, right.P, origin);
  for (const RawCamera* raw : {&left, &right}) checkDistortion(origin, *raw);
  if (isIdentity(left) && isIdentity(right)) return;
  makeRectifyMaps(left, image_size, CV_16SC2, left_map_, left_weights_);
  makeRectifyMaps(right, image_size, CV_16SC2, right_map_, right_weights_);
}

StereoRig::StereoRig(const StereoCamera& camera) : camera_(camera) {
  if (!(camera.baseline_m > 0.0)) throw std::invalid_argument("StereoRig: no baseline");
}

void StereoRig::rectify(const cv::Mat& left, const cv::Mat& right, cv::Mat& rectified_left,
                        cv::Mat& rectified_right) const {
  const cv::Size size(camera_.left.width, camera_.left.height);
  if (left.size() != size || right.size() != size) {
    throw std::invalid_argument("StereoRig: the images are not of the calibrated size, " +
                                std::to_string(size.width) + "x" + std::to_string(size.height));
  }
  if (isRectified()) {
    rectified_left = left;
    rectified_right = right;
    return;
  }
  cv::remap(left, rectified_left, left_map_, left_weights_, cv::INTER_LINEAR);
  cv::remap(right, rectified_right, right_map_, right_weights_, cv::INTER_LINEAR);
}

}  // namespace heel
