// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/appearance_band.hpp"

#include <stdexcept>

namespace heel {

ColorTable anyBand(const AppearanceBands& bands) {
  if (bands.empty()) {
    throw std::invalid_argument("anyBand: there is no band");
  }
  if (bands.size() == 1) {
    return bands.front().table;
  }
  return ColorTable([&](std::uint8_t b, std::uint8_t g, std::uint8_t r) -> std::uint8_t {
    for (const AppearanceBand& band : bands) {
      if (band.table.passes(b, g, r)) return 255;
    }
    return 0;
  });
}

}  // namespace heel
