// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The appearance models that the experiments compare.
#pragma once

#include <heel/segmentation/appearance_model.hpp>

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

}  // namespace heel
