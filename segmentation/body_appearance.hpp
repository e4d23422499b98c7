// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How much of a body that stands where a blob is looks like the target.
#pragma once

#include "cloud/color_cloud.hpp"
#include "segmentation/appearance_model.hpp"
#include "segmentation/world_blobs.hpp"

#include <cstdint>
#include <vector>

namespace heel {

struct BodyAppearanceParams {
  double radius_m = 0.2;       ///< Of the upright cylinder that stands for the body.
  double prior_points = 20.0;  ///< Points that pass, and as many that do not, before any is seen.
};

/// Gives blobs their appearance: not how large they are, nor how well the pixels that passed the
/// filter did so, but which share of the body's points passes it.
///
/// For each band of the model, n of the N points that the cylinder holds at the band's heights pass
/// the band's table; the band's share is (n + prior) / (N + 2 prior), and the appearance, in (0,
/// 1), is the geometric mean of the bands' shares. A band of which nothing is seen counts 0.5: it
/// says nothing either way. A person in other clothes lets some pixels pass too; what gives them
/// away is all the rest of them.
class BodyAppearance {
 public:
  /// @throws std::invalid_argument  if a parameter is not positive.
  explicit BodyAppearance(const AppearanceModel& model, const BodyAppearanceParams& params = {});

  /// Sets `appearance` of each blob.
  /// @param cloud  All the points that are known around the blobs, whether they pass the filter or
  ///               not, in the frame of the blobs; z is the height. Points without position are
  ///               left out.
  void score(const ColorCloud& cloud, std::vector<WorldBlob>& blobs);

 private:
  struct Band {
    BodyBand body;
    ColorTable table;
  };
  struct Share {
    int passing = 0;
    int points = 0;
  };

  void markCells(const std::vector<WorldBlob>& blobs);

  BodyAppearanceParams params_;
  std::vector<Band> bands_;
  std::vector<std::uint8_t> near_;  // cells of a coarse grid that a body reaches into
  std::vector<Share> shares_;       // of each blob, its bands one after the other
};

}  // namespace heel
