// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The few means that Heel's pages are made with.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace heel {

/// The text as it may stand in HTML, between tags or in a quoted attribute. What XML does not allow
/// (control characters) becomes a blank.
std::string escapedHtml(std::string_view text);

/// JSON that may stand in a script element: it holds no '<', '>' or '&'.
std::string scriptJson(const nlohmann::ordered_json& value);

/// A picture as a "data:" address, JPEG, at most `max_width_px` wide; empty for an empty picture.
std::string pictureAddress(const cv::Mat& picture_bgr, int max_width_px = 720);

/// A template's text with each {{name}} replaced. Values are put in as they are.
/// @throws std::logic_error  if a name has no value, or a value no name: a page is whole.
std::string filledTemplate(std::string_view page, const std::map<std::string, std::string>& values);

/// `value` with so many decimals, and a dash where it is not known.
std::string shownNumber(double value, int decimals, std::string_view unit = {});

/// A path of SVG through the points; where a point is not finite the path is broken.
std::string svgPath(const std::vector<Eigen::Vector2d>& points, int decimals = 2);

/// The points without those that are within `tolerance` of the line through their neighbours
/// (Douglas and Peucker). Points that are not finite stay.
std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& points,
                                        double tolerance);

}  // namespace heel
