// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One frame and what was made of it, as a picture.
#pragma once

#include <heel/cloud/pinhole_camera.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// A world blob to draw.
struct DrawnBlob {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  int points = 0;       ///< Points that it rests on; more points, a larger mark.
  bool is_used = true;  ///< False if the geometric gate threw it out.
};

/// A track to draw.
struct DrawnTrack {
  int id = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
  double height_m = 1.75;
  bool is_target = false;
  bool is_seen = true;                   ///< False while it goes on by prediction alone.
  double confidence = 0.0;               ///< Of the target, in [0, 1].
  std::vector<Eigen::Vector2d> trail_m;  ///< Where it was, the oldest first.
};

/// How the state of the following is to be taken.
enum class Tone { kNeutral, kGood, kWarning, kBad };

/// All that one picture shows. Places are on the floor, in a frame with Z up whose z = 0 is the
/// floor.
struct DrawnFrame {
  cv::Mat image_bgr;  ///< CV_8UC3; may be empty.
  cv::Mat mask;       ///< CV_8UC1 of the same size, not 0 where the colour passed; may be empty.
  PinholeCamera camera;
  Eigen::Isometry3d T_floor_camera = Eigen::Isometry3d::Identity();
  std::vector<DrawnBlob> blobs;
  std::vector<DrawnTrack> tracks;
  bool camera_turns = false;  ///< Then the plan view reaches as far behind it as ahead.
  std::optional<Eigen::AlignedBox2d> bounds_m;  ///< Outside of it nobody is looked for.

  std::size_t frame = 0;
  double stamp_s = 0.0;
  std::string state;   ///< One or two words: "following".
  std::string reason;  ///< A short sentence; may be empty.
  Tone tone = Tone::kNeutral;
};

/// How far the plan view reaches in front of the camera.
inline constexpr double kPlanAhead_m = 8.5;

/// Size of the pictures of one film. All of its pictures are of one size.
struct AnnotateParams {
  int panel_height_px = 600;  ///< Of the image and of the plan view beside it.
};

/// Size of the pictures; both numbers are even, as films need it.
cv::Size pictureSize(const AnnotateParams& params = {});

/// Draws the image with the mask outlined, the blobs' places and the tracks; beside it the plan
/// view with a grid of metres, the floor that the camera sees, blobs and tracks with their trails;
/// above both the state, the reason, the frame and the time.
///
/// @param picture  Out: CV_8UC3 of pictureSize(); its memory is reused.
/// @throws std::invalid_argument  if the mask's size is not the image's, or a type is wrong.
void annotate(const DrawnFrame& scene, const AnnotateParams& params, cv::Mat& picture);

}  // namespace heel
