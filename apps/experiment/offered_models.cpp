// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/offered_models.hpp>

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

}  // namespace heel
