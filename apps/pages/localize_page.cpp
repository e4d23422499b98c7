// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pages/pages.hpp>
#include <heel/apps/pictures/map_picture.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace heel {
namespace {

using Eigen::Vector2d;

bool hasReference(const LocalizedLog& log) {
  return std::any_of(log.moments.begin(), log.moments.end(),
                     [](const LocalizedMoment& moment) { return moment.reference.has_value(); });
}

std::string mapOf(const LocalizedLog& log, const OccupancyGrid& map, const MapFrame& frame) {
  const Vector2d nowhere(kNotKnown, kNotKnown);
  std::vector<Vector2d> found, lost, references;
  bool was_lost = false;
  for (const LocalizedMoment& moment : log.moments) {
    const Vector2d at = frame(moment.estimate.position);
    const bool is_lost = moment.state == "lost";
    // The step to or from a place that was not sure, however long, is a lost one.
    if (is_lost && !was_lost && !found.empty()) lost.push_back(found.back());
    found.push_back(is_lost ? nowhere : at);
    lost.push_back(is_lost || was_lost ? at : nowhere);
    references.push_back(moment.reference ? frame(moment.reference->position) : nowhere);
    was_lost = is_lost;
  }
  std::string svg = svgMap(frame, "The map, and the robot's way on it");
  svg += svgWalls(map, frame);
  svg += svgShape("person-path", svgPath(simplified(references, 0.015)));
  svg += svgShape("robot-path", svgPath(simplified(found, 0.015)));
  svg += svgShape("lost-path", svgPath(simplified(lost, 0.015)));
  return svg +
         "<circle id=\"now-reference\" class=\"now-estimate\" r=\".35\" visibility=\"hidden\"/>\n"
         "<g id=\"now-robot\" visibility=\"hidden\"><circle class=\"now-robot\" r=\".25\"/><line "
         "class=\"now-nose\" x1=\"0\" y1=\"0\" x2=\".25\" y2=\"0\"/></g>\n</svg>";
}

RunMoments momentsOf(const LocalizedLog& log, const MapFrame& frame, StateTones& tones) {
  const auto& all = log.moments;
  std::vector<double> stamps_s;
  for (const LocalizedMoment& moment : all) stamps_s.push_back(moment.stamp_s);
  RunMoments moments(stamps_s);
  moments.addState([&](std::size_t i) { return all[i].state; },
                   [](std::size_t) { return std::string(); }, tones);
  moments.addColumn(
      "std", [&](std::size_t i) { return all[i].std_m; }, 1000.0);
  moments.addColumn("fit", [&](std::size_t i) { return 100.0 * all[i].fit; });
  moments.addColumn(
      "error",
      [&](std::size_t i) {
        const auto& reference = all[i].reference;
        return reference ? (all[i].estimate.position - reference->position).norm() : kNotKnown;
      },
      1000.0);
  moments.addMark(
      "now-robot", [&](std::size_t i) { return frame(all[i].estimate.position); },
      [&](std::size_t i) { return all[i].estimate.yaw_rad; });
  moments.addMark("now-reference", [&](std::size_t i) {
    const auto& reference = all[i].reference;
    return reference ? std::optional<Vector2d>(frame(reference->position)) : std::nullopt;
  });
  return moments;
}

}  // namespace

std::string localizePage(const LocalizedLog& log, const OccupancyGrid& map) {
  Eigen::AlignedBox2d bounds = occupiedBounds(map);
  for (const LocalizedMoment& moment : log.moments) {
    if (moment.estimate.position.allFinite()) bounds.extend(moment.estimate.position);
  }
  const MapFrame frame(bounds);
  const bool is_compared = hasReference(log);
  StateTones tones;
  tones.use("found", "--s-face");
  tones.use("lost", "--s-seek");
  RunMoments moments = momentsOf(log, frame, tones);
  RunPage page;
  const std::string name = escapedHtml(log.name);
  page.title = name + " \u00b7 Heel";
  page.eyebrow = "Heel \u00b7 a robot on its map, by laser and wheels";
  page.headline = log.name.empty() ? "A log" : name;
  page.outcome = log.complete ? "complete" : "stopped early";
  page.tone = log.complete ? Tone::kNeutral : Tone::kWarning;
  page.lead = "The robot went <strong>" + shownNumber(log.way_m, 1, "m") + "</strong> in " +
              shownNumber(moments.duration_s(), 0, "s") + ", and did not know where it was for " +
              shownNumber(100.0 * log.lost_share, 1, "%") + " of the scans.";
  page.tiles = tile("Scans", std::to_string(log.moments.size()), "localized") +
               tile("Lost", shownNumber(100.0 * log.lost_share, 1, "%"), "of the scans") +
               tile("Error of the place", shownNumber(log.rms_m, 3, "m"),
                    "RMS while not lost, and " + shownNumber(log.rms_deg, 2, "\u00b0")) +
               tile("Median error", shownNumber(log.median_m, 3, "m"),
                    "worst " + shownNumber(log.worst_m, 2, "m"));
  page.map = mapOf(log, map, frame);
  page.map_legend = legendLine("--robot", "none", "estimate");
  if (log.lost_share > 0.0) page.map_legend += legendLine("--bad", "none", "estimate while lost");
  if (is_compared) page.map_legend += legendLine("--person", "6 4", "reference");
  BandRow states{"The robot's place", {}};
  for (const StateSpan& span : stateSpans(log.moments)) {
    states.bands.push_back({span.from_s, span.to_s, span.state, tones.of(span.state)});
    if (span.state == "lost") moments.addLoss(span.from_s, span.to_s);
  }
  page.bands = {states};
  Chart error{"Distance to the reference", "m", "red: lost", "error", "--person"};
  error.least_top = 0.2;
  error.most_top = 5.0;
  error.has_losses = true;
  Chart deviation{"Standard deviation of the place", "m", "", "std", "--robot", 3};
  deviation.least_top = 0.1;
  deviation.most_top = 2.0;
  Chart fit{"Beams that fit the map", "%", "", "fit", "--s-face", 0};
  fit.least_top = fit.most_top = 100.0;
  page.charts = {deviation, fit};
  if (is_compared) page.charts.insert(page.charts.begin(), error);
  page.footer = "<p>The figures are in poses.csv and summary.json, beside this page.</p>";
  return filledRunPage(page, std::move(moments));
}

}  // namespace heel
