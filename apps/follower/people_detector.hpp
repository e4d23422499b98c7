// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// People before a known background: steps 2 and 3 of phase 1 (section 2).
#pragma once

#include <heel/cloud/color_cloud.hpp>
#include <heel/segmentation/background_model.hpp>
#include <heel/segmentation/height_crop.hpp>
#include <heel/segmentation/plan_view.hpp>
#include <heel/segmentation/world_blobs.hpp>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <vector>

namespace heel {

/// What is taken for a person before a background that is known.
struct PeopleDetectorParams {
  HeightCropParams height;
  PlanViewParams plan_view;
  WorldBlobParams blobs;
  PersonShape person;
};

/// What one frame shows before the background; every stage's result is in it.
struct PeopleView {
  Foreground foreground;
  ColorCloud::Ptr cloud;         ///< Foreground points in the base frame, organized; NaN elsewhere.
  pcl::IndicesPtr candidates;    ///< Foreground points that have a position.
  pcl::Indices standing;         ///< Of these, the ones at a person's heights.
  std::vector<WorldBlob> blobs;  ///< All blobs, highest score first.
  std::vector<int> people;       ///< Which of them have the shape of a person.
};

/// Finds everyone who stands before the background, frame by frame. Reuses its memory.
class PeopleDetector {
 public:
  /// @param T_base_camera  Maps the camera's optical frame to the base frame (z up from the floor).
  /// @throws std::invalid_argument  if a parameter is out of its range.
  PeopleDetector(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                 const PeopleDetectorParams& params = {});
  // A copy would share the view's cloud.
  PeopleDetector(const PeopleDetector&) = delete;
  PeopleDetector& operator=(const PeopleDetector&) = delete;
  PeopleDetector(PeopleDetector&&) = default;
  PeopleDetector& operator=(PeopleDetector&&) = default;

  /// @return  Valid until the next call.
  /// @throws std::invalid_argument  if the images do not fit the background.
  const PeopleView& detect(const BackgroundModel& background, const cv::Mat& image_bgr,
                           const cv::Mat& depth_m);

  /// The blob that a point of the last view's cloud belongs to (by its place on the floor, so its
  /// feet too), or -1.
  int blobOf(const pcl::PointXYZRGB& point) const {
    return finder_.blobOf(plan_view_.cellAt(point.x, point.y));
  }

 private:
  PinholeCamera camera_;
  Eigen::Isometry3d T_base_camera_;
  HeightCrop height_crop_;
  PlanView plan_view_;
  WorldBlobFinder finder_;
  PersonShape person_;
  PeopleView view_;
};

}  // namespace heel
