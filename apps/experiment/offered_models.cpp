// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/offered_models.hpp"

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
  return {{"paper, k = 1", make(ColorModel::kPrincipalColors, 1, upperBody())},
          {"paper, k from the data", make(ColorModel::kPrincipalColors, 0, upperBody())},
          {"paper, k = 1, torso + head", make(ColorModel::kPrincipalColors, 1, torsoAndHead())},
          {"paper, k = 1, + legs", make(ColorModel::kPrincipalColors, 1, wholeBody())},
          {"ratio to the room", make(ColorModel::kColorRatio, 1, upperBody())},
          {"ratio, torso + head (default)", AppearanceParams()},
          {"ratio, torso + head + legs", make(ColorModel::kColorRatio, 1, wholeBody())}};
}

}  // namespace heel
