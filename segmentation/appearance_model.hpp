// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The target's appearance: what phase 1 leaves for phase 2 (paper, section 2).
#pragma once

#include <heel/segmentation/appearance_threshold.hpp>
#include <heel/segmentation/body_description.hpp>
#include <heel/segmentation/color_histogram.hpp>
#include <heel/segmentation/color_score.hpp>
#include <heel/segmentation/color_table.hpp>
#include <heel/segmentation/stature.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Which of the offered models scores a colour.
enum class ColorModel {
  kPrincipalColors,  ///< The paper's.
  kColorRatio,       ///< The person's colours against the room's.
  kHueSaturation,    ///< A joint histogram of hue and saturation.
};

/// Heights over the floor that share their colours.
struct BodyBand {
  std::string name;
  double min_height_m = 1.0;
  double max_height_m = 2.2;

  bool contains(double height_m) const {
    return height_m >= min_height_m && height_m < max_height_m;
  }
};

/// The paper's: all that is higher than 1 m.
std::vector<BodyBand> upperBody();
/// Higher than 1 m, the head by itself.
std::vector<BodyBand> torsoAndHead();
/// The head, the torso, and the legs: trousers tell people in similar jumpers apart. Goes beyond
/// the paper, for it learns from points below 1 m too.
std::vector<BodyBand> wholeBody();

/// How an appearance is modelled.
struct AppearanceParams {
  /// How colours are scored; kPrincipalColors is the paper's way.
  ColorModel model = ColorModel::kColorRatio;
  /// Bands of height whose colours are learned each by itself. upperBody() is the paper's;
  /// wholeBody(), which `heel learn` takes, finds trousers too.
  std::vector<BodyBand> bands = torsoAndHead();
  ThresholdParams threshold;
  ColorRatioParams color_ratio;
  PrincipalColorParams principal_colors;
  HueSaturationParams hue_saturation;
  /// Multiplies a colour's score by p / (p + q), where p and q are the person's and the room's
  /// smoothed shares of that colour: what the empty room has as well counts little. kColorRatio
  /// does so anyway.
  bool suppress_background = false;
  /// A band with more errors than this does not tell the person from the room.
  double max_error_share = 0.6;
  std::uint64_t min_points = 500;  ///< A band with fewer points than this is not relied on.
};

/// What is known of one band.
struct AppearanceBand {
  BodyBand body;
  ColorHistogram person;       ///< Of all the target's points in the band, over time.
  ColorTable table;            ///< With its threshold; empty if the band has no points.
  double score_per_level = 0;  ///< The model's score at level 1 of the table.
  ErrorCurve error_curve{};    ///< Of the table, on what was learned from.

  const ColorErrors& errors() const { return error_curve[table.threshold()]; }
  /// The threshold in the model's own unit: the paper's delta.
  double delta() const { return table.threshold() * score_per_level; }
};

/// Whether a model can tell its person from the room.
enum class AppearanceDoubt {
  kNone,
  kTooFewPoints,  ///< No band has enough of them.
  kLikeTheRoom,   ///< In each band that has, most is lost or most of the room passes.
};

/// How well the person's colours can be told from the room's.
struct Separability {
  AppearanceDoubt doubt = AppearanceDoubt::kNone;
  double error_share = 1.0;  ///< Of the best band: both error shares together; 0 is perfect.
  std::string advice;        ///< A sentence for people, what is wrong and what to do; may be empty.
};

/// The appearance of one person: counted colours, and the tables that follow from them.
///
/// A value type. It keeps the counts, so that errors can be counted long after phase 1.
class AppearanceModel {
 public:
  /// @param person  Counts of each of `params.bands`, in their order.
  /// @param room    Counts of what is not the person.
  /// @param portrait  What all of the person looks like; absent: made of `person`.
  /// @throws std::invalid_argument  if a parameter is out of range, all of `person` is empty, or
  ///                                `room` is.
  AppearanceModel(AppearanceParams params, std::vector<ColorHistogram> person, ColorHistogram room,
                  std::optional<Stature> stature = {}, BodyDescription portrait = {});

  const AppearanceParams& params() const { return params_; }
  const std::vector<AppearanceBand>& bands() const { return bands_; }
  const ColorHistogram& room() const { return room_; }
  const std::optional<Stature>& stature() const { return stature_; }
  const BodyDescription& portrait() const { return portrait_; }

  /// The paper's filter: passes what passes the table of any band. Its scores are 0 and 255.
  ColorTable filterTable() const;

  /// Sets a band's threshold by hand; its errors follow.
  /// @throws std::out_of_range  if there is no such band.
  void setThreshold(std::size_t band, std::uint8_t threshold);

  Separability separability() const;

 private:
  AppearanceParams params_;
  std::vector<AppearanceBand> bands_;
  ColorHistogram room_;
  std::optional<Stature> stature_;
  BodyDescription portrait_;
};

}  // namespace heel
