// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The moments of a run that a page's cursor goes to, and what was then.
#pragma once

#include <heel/apps/pages/page_parts.hpp>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Columns of values, a row for each moment. All functions are asked with the index of a sample.
class RunMoments {
 public:
  /// @param stamps_s  Of the samples, in order.
  /// @param most      Longer runs are thinned out evenly to about as many.
  RunMoments(const std::vector<double>& stamps_s, std::size_t most = 3000);

  std::size_t count() const { return chosen_.size(); }
  double first_s() const { return first_s_; }
  double duration_s() const { return duration_s_; }  ///< Above 0.

  using Number = std::function<double(std::size_t)>;
  using Place = std::function<std::optional<Eigen::Vector2d>(std::size_t)>;
  using Text = std::function<std::string(std::size_t)>;

  /// @param steps  It is rounded to this part of one; what is not finite is not known.
  void addColumn(const std::string& name, const Number& value, double steps = 100.0);

  /// The place of the mark of this id in the map's drawing; it is hidden while it has none.
  /// @param turn_rad  Its turn, counter-clockwise; may be null.
  /// @param label     The text of its last element; may be null.
  void addMark(const std::string& id, const Place& place, const Number& turn_rad = nullptr,
               const Text& label = nullptr);

  /// The state, in words that are not escaped, and why.
  void addState(const Text& state, const Text& reason, StateTones& tones);

  /// Where the cursor is at first.
  void startAt(double stamp_s);

  /// Times to tint in charts.
  void addLoss(double from_s, double to_s);

  /// Which picture of the film each moment has.
  void addFilm(double rate_hz, const std::vector<double>& stamps_s);

  /// For a script element; `charts` as run.js takes them.
  std::string json(const nlohmann::ordered_json& charts);

 private:
  std::size_t momentAt(double stamp_s) const;

  std::vector<std::size_t> chosen_;
  std::vector<double> stamps_s_;  ///< Of those.
  double first_s_ = 0.0;
  double duration_s_ = 1.0;
  nlohmann::ordered_json json_;
};

}  // namespace heel
