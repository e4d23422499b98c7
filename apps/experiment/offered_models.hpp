// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The appearance models that the experiments compare, and how one acquisition teaches them all.
#pragma once

#include <heel/segmentation/appearance_learner.hpp>
#include <heel/segmentation/appearance_model.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// A way to model an appearance, with the name that tables give it.
struct OfferedModel {
  std::string name;
  AppearanceParams params;
};

/// All that Heel offers, the paper's first.
std::vector<OfferedModel> offeredModels();

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
