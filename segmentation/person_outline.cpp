// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/person_outline.hpp>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace heel {
namespace {

// Of the classifier: a person of 96 pixels stands in the middle of 64 x 128. People are not all as
// tall, so it also looks a step higher and a step lower.
constexpr float kLeft = 0.35F, kRight = 0.65F;  // Of the board's width, a person's sides,
constexpr float kUpper = 0.2F, kLower = 0.8F;   // and of its height, brow and shins.
constexpr float kBefore_m = 0.4F;               // What is so much nearer is not theirs.
constexpr double kPerson_m = 1.75, kPersonRows = 96.0;
constexpr int kStep = 8;
const cv::Size kBoard(64, 128 + 2 * kStep);
// Log odds by the classifier's value, learned on people and things of real recordings by
// tests/benchmarks/outline_fit.cpp, see docs/results.md.
constexpr double kSlope = 2.6, kUndecided = -2.0;
constexpr double kMisleading = 0.05;  // As GalleryParams::misleading_share of colours.
// Looks at one body are alike: a third of the variance is between bodies, so many are worth three.
// Who sums looks up lets many be worth five or six, so each counts as half.
constexpr double kShare = 0.5;

/// Where the corners of an upright board that faces the camera are in the picture, from the upper
/// left one on; nothing if one is behind the camera.
std::optional<std::array<cv::Point2f, 4>> cornersOf(const BodyView& view,
                                                    const Eigen::Vector2d& place_m) {
  constexpr double m_per_pixel = kPerson_m / kPersonRows;
  const Eigen::Vector2d ray_m = place_m - view.T_base_camera.translation().head<2>();
  const Eigen::Vector2d right = Eigen::Vector2d(ray_m.y(), -ray_m.x()).normalized();
  const Eigen::Isometry3d T_camera_base = view.T_base_camera.inverse();
  std::array<cv::Point2f, 4> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double side = i == 0 || i == 3 ? -0.5 : 0.5, up = i < 2 ? 0.5 : -0.5;
    const Eigen::Vector2d xy = place_m + side * kBoard.width * m_per_pixel * right;
    const double z = 0.5 * kPerson_m + up * kBoard.height * m_per_pixel;
    const Eigen::Vector3d p = T_camera_base * Eigen::Vector3d(xy.x(), xy.y(), z);
    if (p.z() < 0.1) return std::nullopt;
    const Eigen::Vector2f pixel = project(view.camera, p).cast<float>();
    corners[i] = {pixel.x(), pixel.y()};
  }
  return corners;
}

cv::Point2f pointOf(const std::array<cv::Point2f, 4>& corners, float right, float down) {
  const cv::Point2f upper = corners[0] + right * (corners[1] - corners[0]);
  const cv::Point2f lower = corners[3] + right * (corners[2] - corners[3]);
  return upper + down * (lower - upper);
}

/// Whether whoever stands in the middle of the board is in the picture from side to side, and from
/// head to knee, or from the shoulders to the feet: a trunk has no outline.
bool isInPicture(const std::array<cv::Point2f, 4>& corners, const cv::Size& picture) {
  const cv::Rect2f all(cv::Point2f(), picture);
  int in = 0;
  for (int row = 0; row < 5; ++row) {
    const float down = kUpper + 0.25F * static_cast<float>(row) * (kLower - kUpper);
    const auto isSideIn = [&](float right) { return all.contains(pointOf(corners, right, down)); };
    in += isSideIn(kLeft) && isSideIn(kRight) ? 1 : 0;
  }
  return in >= 4;
}

/// Whether most of what has a depth in one half of them is before them.
bool isHalfHidden(const std::array<cv::Point2f, 4>& corners, const BodyView& view,
                  const Eigen::Vector2d& place_m) {
  if (view.depth_m.empty()) return false;
  const Eigen::Vector3d middle(place_m.x(), place_m.y(), 0.5 * kPerson_m);
  const auto depth_m = static_cast<float>((view.T_base_camera.inverse() * middle).z());
  const cv::Rect all(cv::Point(), view.depth_m.size());
  constexpr int kRows = 32, kColumns = 6;
  const auto between = [](float from, float to, int i, int count) {
    return from + (static_cast<float>(i) + 0.5F) / static_cast<float>(count) * (to - from);
  };
  for (const float side : {kLeft, kRight}) {
    int before = 0, others = 0;
    for (int row = 0; row < kRows; ++row) {
      const float down = between(kUpper, kLower, row, kRows);
      for (int column = 0; column < kColumns; ++column) {
        const cv::Point pixel = pointOf(corners, between(side, 0.5F, column, kColumns), down);
        const float at_m = all.contains(pixel) ? view.depth_m.at<float>(pixel) : 0.0F;
        if (at_m > 0.0F) ++(at_m < depth_m - kBefore_m ? before : others);
      }
    }
    if (before > others) return true;
  }
  return false;
}

}  // namespace

PersonOutline::PersonOutline() {
  const std::vector<float> detector = cv::HOGDescriptor::getDefaultPeopleDetector();
  weights_ = Eigen::Map<const Eigen::VectorXf>(detector.data(),
                                               static_cast<Eigen::Index>(detector.size()) - 1);
  bias_ = detector.back();
}

std::optional<double> PersonOutline::classify(const BodyView& view,
                                              const Eigen::Vector2d& place_m) {
  const auto corners = cornersOf(view, place_m);
  if (!corners || !isInPicture(*corners, view.image_bgr.size()) ||
      isHalfHidden(*corners, view, place_m)) {
    return std::nullopt;
  }
  const auto width = static_cast<float>(kBoard.width), height = static_cast<float>(kBoard.height);
  const std::array<cv::Point2f, 4> board = {
      {{0.0F, 0.0F}, {width, 0.0F}, {width, height}, {0.0F, height}}};
  cv::warpPerspective(view.image_bgr, board_,
                      cv::getPerspectiveTransform(corners->data(), board.data()), kBoard,
                      cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::cvtColor(board_, grey_, cv::COLOR_BGR2GRAY);  // In poor light colours are mostly noise.
  hog_.compute(grey_, gradients_, {kStep, kStep});
  const Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3>> windows(gradients_.data(),
                                                                          weights_.size(), 3);
  const Eigen::Vector3f values = windows.transpose() * weights_;
  return static_cast<double>(values.maxCoeff() + bias_);
}

double PersonOutline::logPerson(const BodyView& view, const Eigen::Vector2d& place_m) {
  const std::optional<double> value = classify(view, place_m);
  if (!value) return 0.0;
  const double ratio = std::exp(kSlope * (*value - kUndecided));
  return kShare * std::log(((1.0 - kMisleading) * ratio + kMisleading) /
                           ((1.0 - kMisleading) + kMisleading * ratio));
}

}  // namespace heel
