// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// One acquisition that teaches several models at once.
#pragma once

#include <heel/apps/experiment/offered_models.hpp>
#include <heel/segmentation/appearance_learner.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace heel {

/// Collects a person's colours for all offered models; those with the same bands share them.
class ModelLessons {
 public:
  explicit ModelLessons(const std::vector<OfferedModel>& models);

  /// As AppearanceLearner.
  void addRoom(const cv::Mat& image_bgr, const cv::Mat& mask = cv::Mat());
  void addPerson(const ColorCloud& cloud, const pcl::Indices& indices);
  void addBody(const ColorCloud& cloud, const pcl::Indices& indices,
               const Eigen::Vector2d& position_m);

  /// The offered model of that number; absent where nothing was seen that its bands could learn.
  std::optional<AppearanceModel> learn(std::size_t model) const;

 private:
  std::vector<OfferedModel> models_;
  std::vector<AppearanceLearner> learners_;
  std::vector<std::size_t> learner_of_;
};

}  // namespace heel
