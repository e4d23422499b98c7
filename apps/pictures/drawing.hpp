// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The few marks that Heel's pictures are made of, in one palette.
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace heel {

/// Colours of all pictures, as BGR. What belongs to the target is orange and nothing else is.
namespace palette {
const cv::Scalar kPaper(40, 33, 28);     ///< Behind everything.
const cv::Scalar kPanel(54, 45, 38);     ///< Behind a drawing.
const cv::Scalar kPanelLit(72, 61, 52);  ///< The part of a drawing that the camera sees.
const cv::Scalar kGrid(92, 80, 70);
const cv::Scalar kInk(240, 236, 230);      ///< Text.
const cv::Scalar kInkSoft(176, 166, 156);  ///< Text of less weight.
const cv::Scalar kTarget(48, 150, 255);
const cv::Scalar kTrack(235, 190, 120);     ///< Tracks that are not the target.
const cv::Scalar kBlob(190, 215, 110);      ///< World blobs, and pixels of the target's colours.
const cv::Scalar kGatedOut(140, 130, 122);  ///< Blobs that were not used.
const cv::Scalar kGood(120, 190, 90);
const cv::Scalar kWarning(60, 190, 240);
const cv::Scalar kBad(95, 95, 235);
}  // namespace palette

/// Where a text's point lies on it.
enum class Align { kLeft, kCenter, kRight };

/// Height in pixels of a capital letter at the text sizes below.
constexpr double kTextSize = 0.46;
constexpr double kTextSizeSmall = 0.38;
constexpr double kTextSizeLarge = 0.58;

/// Width of a text in pixels.
int textWidth(const std::string& text, double size = kTextSize);

/// Writes a line of text whose capitals are centred on the point's row.
void drawText(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& color,
              double size = kTextSize, Align align = Align::kLeft);

/// Writes a text on a rounded label; `at` is where the label's left, centre or right is.
/// @return the label's width.
int drawLabel(cv::Mat& picture, const std::string& text, cv::Point at, const cv::Scalar& fill,
              const cv::Scalar& ink, double size = kTextSize, Align align = Align::kLeft);

/// The text, cut with "..." where it is wider than `width` pixels.
std::string fittedText(const std::string& text, int width, double size = kTextSize);

/// Points with sub-pixel places, so that what moves does not jump from pixel to pixel.
using Outline = std::vector<cv::Point2d>;

void drawLine(cv::Mat& picture, cv::Point2d from, cv::Point2d to, const cv::Scalar& color,
              int thickness = 1);
void drawOutline(cv::Mat& picture, const Outline& outline, bool closed, const cv::Scalar& color,
                 int thickness = 1);
void drawCircle(cv::Mat& picture, cv::Point2d center, double radius, const cv::Scalar& color,
                int thickness = 1);

/// Fills an area; `opacity` 1 hides what was there.
void fillOutline(cv::Mat& picture, const Outline& outline, const cv::Scalar& color, double opacity);
void fillCircle(cv::Mat& picture, cv::Point2d center, double radius, const cv::Scalar& color,
                double opacity = 1.0);

/// A colour between two: `share` 0 is `from`, 1 is `to`.
cv::Scalar mixed(const cv::Scalar& from, const cv::Scalar& to, double share);

}  // namespace heel
