// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The parts of an annotated picture: its frame, the image and the plan.
#pragma once

#include <heel/apps/pictures/annotate.hpp>
#include <heel/apps/pictures/drawing.hpp>

#include <string>
#include <vector>

namespace heel {

/// The colour of a tone.
const cv::Scalar& colorOf(Tone tone);

/// The state on a label, why, and at the right end the time.
void drawHeader(const std::string& state, Tone tone, const std::string& reason,
                const std::string& time, cv::Mat& header);

/// A mark and what it means.
struct LegendEntry {
  enum class Mark { kDisc, kRing, kSquare, kLine };
  std::string text;
  cv::Scalar color;
  Mark mark = Mark::kDisc;
};

/// Writes the entries in one row.
void drawLegend(const std::vector<LegendEntry>& entries, cv::Mat& footer);

/// Draws the scene's image, fitted into `panel`: what the mask lets pass is outlined, and blobs and
/// tracks are marked where they stand.
void drawImage(const DrawnFrame& scene, cv::Mat& panel);

/// Projects a point of the floor's frame into the image [px]; absent behind the camera.
std::optional<cv::Point2d> projectToImage(const Eigen::Vector3d& point_m,
                                          const PinholeCamera& camera,
                                          const Eigen::Isometry3d& T_floor_camera);

/// Draws the scene as seen from above into `panel`, the camera below, looking up.
/// @param ahead_m  How far the drawing reaches in front of the camera.
void drawPlan(const DrawnFrame& scene, double ahead_m, cv::Mat& panel);

/// The part of the floor within `range_m` of the camera that lies in its image; empty without a
/// camera. Its places are in the floor's frame.
std::vector<Eigen::Vector2d> visibleFloor(const PinholeCamera& camera,
                                          const Eigen::Isometry3d& T_floor_camera, double range_m);

}  // namespace heel
