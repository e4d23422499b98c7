// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/offered_models.hpp>

#include <algorithm>
#include <utility>

namespace heel {

std::vector<OfferedModel> offeredModels() {
  const auto make = [](ColorModel model, int colors, std::vector<BodyBand> bands) {
    AppearanceParams params;
    params.model = model;
    params.principal_colors.count = colors;
    params.bands = std::move(bands);
    return params;
  };
  const auto discounted = [&](ColorModel model, int colors) {
    AppearanceParams params = make(model, colors, upperBody());
    params.suppress_background = true;
    return params;
  };
  return {{"paper, k = 1", make(ColorModel::kPrincipalColors, 1, upperBody())},
          {"paper, k from the data", make(ColorModel::kPrincipalColors, 0, upperBody())},
          {"paper, k = 1, torso + head", make(ColorModel::kPrincipalColors, 1, torsoAndHead())},
          {"paper, k = 1, + legs", make(ColorModel::kPrincipalColors, 1, wholeBody())},
          {"paper, k = 1, room discounted", discounted(ColorModel::kPrincipalColors, 1)},
          {"paper, k from the data, disc.", discounted(ColorModel::kPrincipalColors, 0)},
          {"hue-saturation", make(ColorModel::kHueSaturation, 1, upperBody())},
          {"hue-saturation, room discounted", discounted(ColorModel::kHueSaturation, 1)},
          {"ratio to the room", make(ColorModel::kColorRatio, 1, upperBody())},
          {"ratio, torso + head", make(ColorModel::kColorRatio, 1, torsoAndHead())},
          {"ratio, + legs (default)", make(ColorModel::kColorRatio, 1, wholeBody())}};
}

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
