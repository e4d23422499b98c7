// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/run_page.hpp>

#include "page_assets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

std::string swatch(const Band& band, double seconds) {
  return "<li><svg viewBox=\"0 0 26 14\" aria-hidden=\"true\"><rect width=\"26\" height=\"14\" "
         "rx=\"4\" fill=\"var(" +
         band.tone + ")\"/></svg>" + escapedHtml(band.text) + " " + shownNumber(seconds, 1, "s") +
         "</li>\n";
}

/// The words of the row, in their order, with how long they held.
std::string legendOf(const BandRow& row) {
  std::vector<std::pair<const Band*, double>> words;
  for (const Band& band : row.bands) {
    const auto same = [&](const auto& word) { return word.first->text == band.text; };
    auto word = std::find_if(words.begin(), words.end(), same);
    if (word == words.end()) word = words.insert(word, {&band, 0.0});
    word->second += band.to_s - band.from_s;
  }
  std::string items;
  for (const auto& [band, seconds] : words) items += swatch(*band, seconds);
  return "<ul class=\"legend\">\n" + items + "</ul>";
}

std::string bandRow(const BandRow& row, const RunMoments& moments) {
  std::string bands;
  for (const Band& band : row.bands) {
    const double from = band.from_s - moments.first_s(), to = band.to_s - moments.first_s();
    const double percent = 100.0 / moments.duration_s();
    const std::string text = escapedHtml(band.text);
    bands += "<i style=\"left:" + fixedText(percent * from, 3) +
             "%;width:" + fixedText(percent * std::max(0.0, to - from), 3) + "%;--tone:var(" +
             band.tone + ")\" title=\"" + text + ", " + fixedText(from, 1) + " to " +
             fixedText(to, 1) + " s\"><span>" + text + "</span></i>";
  }
  const std::string title = escapedHtml(row.title);
  return "<div class=\"row bands" + std::string(row.has_legend ? "" : " thin") +
         "\"><div class=\"name\"><span><b>" + title + "</b></span><span>" + escapedHtml(row.note) +
         "</span></div><div class=\"plot\" role=\"img\" aria-label=\"" + title +
         " over time\"><div class=\"wide\">" + bands + "</div></div>" +
         (row.has_legend ? legendOf(row) : std::string()) + "</div>\n";
}

std::string value(const std::string& element, const std::string& column, int decimals,
                  const std::string& unit) {
  return "<" + element + " data-column=\"" + column + "\" data-digits=\"" +
         std::to_string(decimals) + "\" data-unit=\"" + escapedHtml(unit) + "\"></" + element + ">";
}

std::string chartRow(const Chart& chart, const std::string& id) {
  const std::string title = escapedHtml(chart.title);
  return "<div class=\"row chart\"><div class=\"name\"><span><b>" + title + "</b> " +
         value("output", chart.column, chart.decimals, chart.unit) + "</span><span>" +
         escapedHtml(chart.note) + "</span></div><div class=\"plot\" id=\"" + id +
         "\" role=\"img\" aria-label=\"" + title + " over time\"></div></div>\n";
}

/// As run.js takes it.
nlohmann::ordered_json dataOf(const Chart& chart, const std::string& id) {
  nlohmann::ordered_json data{{"id", id},
                              {"column", chart.column},
                              {"tone", chart.tone},
                              {"least_top", chart.least_top},
                              {"most_top", chart.most_top},
                              {"tint", chart.has_losses},
                              {"limit", nullptr}};
  if (std::isfinite(chart.limit)) data["limit"] = chart.limit;
  return data;
}

std::string filmCard(const PageFilm& film) {
  if (film.name.empty()) return {};
  const std::string poster = pictureAddress(film.poster_bgr, 960), name = escapedHtml(film.name);
  return "<figure class=\"film-card only-screen\" id=\"film-card\"><video id=\"film\" "
         "controls=\"controls\" muted=\"muted\" playsinline=\"playsinline\" preload=\"auto\"" +
         (poster.empty() ? poster : " poster=\"" + poster + "\"") + " src=\"" + name +
         "\">The film is " + name + ", beside this page.</video></figure>";
}

}  // namespace

std::string filledRunPage(const RunPage& page, RunMoments moments) {
  if (!page.film.name.empty()) moments.addFilm(page.film.rate_hz, page.film.stamps_s);
  std::string timeline;
  for (const BandRow& row : page.bands) timeline += bandRow(row, moments);
  nlohmann::ordered_json charts = nlohmann::ordered_json::array();
  for (const Chart& chart : page.charts) {
    const std::string id = "chart-" + std::to_string(charts.size());
    timeline += chartRow(chart, id);
    charts.push_back(dataOf(chart, id));
  }
  const std::size_t count = moments.count();
  return filledTemplate(assets::kRunHtml,
                        {{"head", head(page.title, assets::kRunCss)},
                         {"eyebrow", page.eyebrow},
                         {"headline", page.headline},
                         {"outcome", page.outcome},
                         {"tone", classOf(page.tone)},
                         {"lead", page.lead},
                         {"tiles", page.tiles},
                         {"place", page.film.name.empty() ? " no-film" : ""},
                         {"film", filmCard(page.film)},
                         {"map", page.map},
                         {"map_legend", page.map_legend},
                         {"values", page.values},
                         {"timeline", timeline},
                         {"last_moment", std::to_string(count == 0 ? 0 : count - 1)},
                         {"sections", page.sections},
                         {"footer", page.footer},
                         {"data", moments.json(charts)},
                         {"scripts", scripts(assets::kRunJs)}});
}

std::string momentValue(const std::string& name, const std::string& column, int decimals,
                        const std::string& unit) {
  return "<div><dt>" + name + "</dt>" + value("dd", column, decimals, unit) + "</div>\n";
}

std::string stillFigure(double stamp_s, double first_s, const std::string& caption,
                        const cv::Mat& picture_bgr) {
  const std::string address = pictureAddress(picture_bgr), text = escapedHtml(caption);
  if (address.empty()) return {};
  return "<figure class=\"shot\"><img src=\"" + address + "\" width=\"" +
         std::to_string(picture_bgr.cols) + "\" height=\"" + std::to_string(picture_bgr.rows) +
         "\" alt=\"" + text + "\"/><figcaption><button type=\"button\" data-stamp=\"" +
         fixedText(stamp_s, 3) + "\" title=\"Show this moment on the map\">" +
         shownNumber(stamp_s - first_s, 1, "s") + "</button>" + text + "</figcaption></figure>\n";
}

std::string stillsSection(const std::string& title, const std::string& figures) {
  if (figures.empty()) return {};
  return "<section class=\"card\" aria-labelledby=\"stills\"><h2 id=\"stills\">" + title +
         "</h2><div class=\"shots\">\n" + figures + "</div></section>\n";
}

}  // namespace heel
