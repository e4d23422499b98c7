// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What the pages of runs share: film, map and timeline with one cursor. See assets/run.js.
#pragma once

#include <heel/apps/pages/page_parts.hpp>
#include <heel/apps/pages/run_moments.hpp>

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace heel {

/// A film beside a page.
struct PageFilm {
  std::string name;              ///< Of its file; empty: there is none.
  double rate_hz = 10.0;         ///< Its pictures per second.
  std::vector<double> stamps_s;  ///< When each of its pictures was taken, in order.
  cv::Mat poster_bgr;            ///< Shown until it is played; may be empty.
};

/// A stretch of time, with a word on it.
struct Band {
  double from_s = 0.0;
  double to_s = 0.0;
  std::string text;
  std::string tone;  ///< A variable of page.css: "--s-follow".
};

/// A row of the timeline that is made of bands.
struct BandRow {
  std::string title;
  std::vector<Band> bands;
  bool has_legend = true;  ///< Below it, how long each word held; without, the row is thin.
  std::string note = {};
};

/// A row of the timeline that is a chart of one column of the moments.
struct Chart {
  std::string title;
  std::string unit;
  std::string note;
  std::string column;
  std::string tone;
  int decimals = 2;
  double least_top = 1;      ///< The scale reaches from 0 up to this at least,
  double most_top = 1e9;     ///< and at most up to this.
  double limit = kNotKnown;  ///< A dashed line at this value, if it is known.
  bool has_losses = false;   ///< The times without a target are tinted.
};

/// All that such a page shows. Texts other than those of `bands` and `charts` are HTML and put in
/// as they are.
struct RunPage {
  std::string title, eyebrow, headline, outcome, lead, tiles, map, map_legend, values, sections,
      footer;
  Tone tone = Tone::kNeutral;
  PageFilm film;
  std::vector<BandRow> bands;
  std::vector<Chart> charts;
};

/// The whole page, well-formed as XML too. It has no address of anything outside of it but the
/// film's, and is complete without.
std::string filledRunPage(const RunPage& page, RunMoments moments);

/// A figure of the moment that the cursor is at, for RunPage::values.
std::string momentValue(const std::string& name, const std::string& column, int decimals,
                        const std::string& unit);

/// A picture with a button that moves the cursor there. The caption is a plain text.
std::string stillFigure(double stamp_s, double first_s, const std::string& caption,
                        const cv::Mat& picture_bgr);

/// A section of such figures; empty for none.
std::string stillsSection(const std::string& title, const std::string& figures);

}  // namespace heel
