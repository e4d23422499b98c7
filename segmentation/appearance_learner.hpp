// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Collects the colours of phase 1 and makes the target's appearance of them (paper, section 2).
#pragma once

#include <heel/cloud/color_cloud.hpp>
#include <heel/segmentation/appearance_model.hpp>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <pcl/types.h>

#include <vector>

namespace heel {

/// Feed it the frames of phase 1, then ask for the model. Memory does not grow with their number.
class AppearanceLearner {
 public:
  /// @throws std::invalid_argument  if `params` has no band.
  explicit AppearanceLearner(const AppearanceParams& params = {});

  /// Counts the colours of the room, which false positives are counted on.
  /// @param image_bgr  CV_8UC3.
  /// @param mask       CV_8UC1 of the same size, not 0 where the room is seen; empty: everywhere.
  /// @throws std::invalid_argument  if sizes or types do not fit.
  void addRoom(const cv::Mat& image_bgr, const cv::Mat& mask = cv::Mat());

  /// Counts the colours of the person's points, each for the bands that hold its height.
  /// @param cloud    In a frame whose z is the height over the floor.
  /// @param indices  The person's points, of any height; those without position are left out.
  void addPerson(const ColorCloud& cloud, const pcl::Indices& indices);

  /// Describes the person who stands at a place in this frame. Of an organized cloud, a head that
  /// the picture's upper edge may have cut off is not measured.
  /// @param indices  The person's points.
  void addBody(const ColorCloud& cloud, const pcl::Indices& indices,
               const Eigen::Vector2d& position_m);

  const ColorHistogram& room() const { return room_; }

  /// Counts of each band.
  const std::vector<ColorHistogram>& person() const { return person_; }

  /// @throws std::invalid_argument  if nothing of the person, or of the room, has been added.
  AppearanceModel learn() const { return {params_, person_, room_, stature(), portrait()}; }

  /// The mean of all looks so far; without colours if there was none.
  BodyDescription portrait() const { return portrait_.mean(); }

  /// Of all frames so far.
  std::optional<Stature> stature() const { return statureFrom(heights_m_); }

 private:
  AppearanceParams params_;
  std::vector<ColorHistogram> person_;
  ColorHistogram room_;
  BodyDescriber describer_;
  BodyDescription look_;  // Of the frame that is being added.
  BodyPortrait portrait_;
  std::vector<double> heights_m_;  // Of the frames that showed one.
};

}  // namespace heel
