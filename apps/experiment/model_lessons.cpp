// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/model_lessons.hpp>

#include <algorithm>

namespace heel {
namespace {

bool sameBands(const std::vector<BodyBand>& a, const std::vector<BodyBand>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const BodyBand& x, const BodyBand& y) {
                      return x.min_height_m == y.min_height_m && x.max_height_m == y.max_height_m;
                    });
}

}  // namespace

ModelLessons::ModelLessons(const std::vector<OfferedModel>& models) : models_(models) {
  std::vector<std::vector<BodyBand>> bands;
  for (const OfferedModel& model : models_) {
    const auto found = std::find_if(bands.begin(), bands.end(), [&](const auto& known) {
      return sameBands(known, model.params.bands);
    });
    learner_of_.push_back(static_cast<std::size_t>(found - bands.begin()));
    if (found != bands.end()) continue;
    bands.push_back(model.params.bands);
    learners_.emplace_back(model.params);
  }
}

void ModelLessons::addRoom(const cv::Mat& image_bgr, const cv::Mat& mask) {
  for (AppearanceLearner& learner : learners_) learner.addRoom(image_bgr, mask);
}

void ModelLessons::addPerson(const ColorCloud& cloud, const pcl::Indices& indices) {
  for (AppearanceLearner& learner : learners_) learner.addPerson(cloud, indices);
}

void ModelLessons::addBody(const ColorCloud& cloud, const pcl::Indices& indices,
                           const Eigen::Vector2d& position_m) {
  for (AppearanceLearner& learner : learners_) learner.addBody(cloud, indices, position_m);
}

std::optional<AppearanceModel> ModelLessons::learn(std::size_t model) const {
  const AppearanceLearner& learner = learners_.at(learner_of_.at(model));
  const bool seen = std::any_of(learner.person().begin(), learner.person().end(),
                                [](const ColorHistogram& histogram) { return !histogram.empty(); });
  if (!seen || learner.room().empty()) return std::nullopt;
  return AppearanceModel(models_[model].params, learner.person(), learner.room(), learner.stature(),
                         learner.portrait());
}

}  // namespace heel
