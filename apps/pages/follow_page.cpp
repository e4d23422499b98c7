// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/charts.hpp>
#include <heel/apps/pages/follow_map.hpp>
#include <heel/apps/pages/follow_page.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/page_parts.hpp>

#include "page_assets.hpp"
#include <nlohmann/json.hpp>

#include <cmath>

namespace heel {
namespace {

std::string timesText(int count) {
  return count == 1 ? "once" : count == 2 ? "twice" : std::to_string(count) + " times";
}

std::string lead(const FollowLog& log, const FollowSummary& sum) {
  if (log.is_shadow) {
    return "The robot of this log went <strong>" + shownNumber(sum.distance_m, 1, "m") +
           "</strong> in <strong>" + shownNumber(sum.elapsed_s, 0, "s") +
           "</strong>. Beside it ran Heel, which moved nothing: at each moment it would have "
           "driven otherwise by " +
           shownNumber(sum.command_off_mps, 2, "m/s") + " and " +
           shownNumber(sum.command_off_radps, 2, "rad/s") +
           " (root mean squares). Contacts, clearance and the truth of people are not known.";
  }
  const std::string who = log.person.empty() ? "the person" : escapedHtml(log.person);
  std::string text = "The robot went <strong>" + shownNumber(sum.distance_m, 1, "m") +
                     "</strong> behind " + who + " in <strong>" +
                     shownNumber(sum.elapsed_s, 0, "s") + "</strong>";
  if (std::isfinite(sum.last_distance_m)) {
    text += " and was " + shownNumber(sum.last_distance_m, 2, "m") + " from them at the end";
  }
  text += sum.losses == 0 ? ". It never lost sight of them for more than half a second."
                          : ". It lost them " + timesText(sum.losses) + ".";
  if (sum.contacts_by_robot > 0) {
    text += " <strong class=\"bad\">It touched something " + timesText(sum.contacts_by_robot) +
            ".</strong>";
  }
  if (sum.contactsByPeople() > 0) {
    text += " It was bumped into " + timesText(sum.contactsByPeople()) + ".";
  }
  return text;
}

std::string tiles(const FollowSummary& sum) {
  const auto share = [](double value) { return shownNumber(100.0 * value, 1, "%"); };
  const double yaw_deg = sum.yaw_rms_rad * 180.0 / M_PI;
  return tile("Distance", shownNumber(sum.distance_m, 2, "m"),
              "in " + shownNumber(sum.elapsed_s, 1, "s")) +
         tile("Speed when not seeking", shownNumber(sum.moving_speed_mps, 3, "m/s"),
              shownNumber(sum.driving_speed_mps, 3, "m/s") + " while driving") +
         tile("Time seeking", share(sum.seekShare()),
              shownNumber(sum.seek_s, 1, "s") + "; the paper: 57 to 62\u00a0%") +
         tile("Contacts by the robot", std::to_string(sum.contacts_by_robot),
              std::to_string(sum.contactsByPeople()) + " by people; least clearance " +
                  shownNumber(sum.min_clearance_m, 2, "m"),
              sum.contacts_by_robot == 0 ? Tone::kGood : Tone::kBad) +
         tile("Target in view", share(sum.elapsed_s > 0 ? sum.with_target_s / sum.elapsed_s : 0.0),
              "lost " + timesText(sum.losses)) +
         tile("Wrong person", shownNumber(sum.wrong_person_s, 1, "s"),
              share(sum.wrongShare()) + " of the time",
              sum.wrongShare() < 0.01 ? Tone::kGood : Tone::kBad) +
         tile("Place in the map", shownNumber(sum.position_rms_m, 3, "m"),
              "and " + shownNumber(yaw_deg, 1) + "\u00b0 RMS error") +
         tile("Nearest to the person", shownNumber(sum.best_distance_m, 2, "m"),
              shownNumber(sum.last_distance_m, 2, "m") + " at the end");
}

/// The states as bands, each with its time as a title.
std::string bands(const FollowLog& log, const TimeScale& scale, StateTones& tones) {
  std::string rects;
  for (const StateSpan& span : stateSpans(log.samples)) {
    const double from = 1000.0 * scale.share(span.from_s), to = 1000.0 * scale.share(span.to_s);
    rects += "<rect x=\"" + fixedText(from, 2) + "\" y=\"0\" width=\"" +
             fixedText(std::max(0.0, to - from), 2) + "\" height=\"100\" fill=\"var(" +
             tones.of(span.state) + ")\"><title>" + escapedHtml(wordsOf(span.state)) + ", " +
             fixedText(span.from_s - scale.first_s, 1) + " to " +
             fixedText(span.to_s - scale.first_s, 1) + " s</title></rect>";
  }
  return "<div class=\"row bands\"><div class=\"plot\"><svg viewBox=\"0 0 1000 100\" "
         "preserveAspectRatio=\"none\" role=\"img\" aria-label=\"States over time\">" +
         rects + "</svg></div></div>\n";
}

std::string stateLegend(const FollowLog& log, StateTones& tones) {
  std::map<std::string, double> seconds;
  for (const StateSpan& span : stateSpans(log.samples)) {
    seconds[span.state] += span.to_s - span.from_s;
  }
  std::string items;
  for (const std::string& state : tones.states()) {
    items +=
        "<li><svg viewBox=\"0 0 26 14\" aria-hidden=\"true\"><rect width=\"26\" height=\"14\" "
        "rx=\"4\" fill=\"var(" +
        std::string(tones.of(state)) + ")\"/></svg>" + escapedHtml(wordsOf(state)) + " " +
        shownNumber(seconds[state], 1, "s") + "</li>\n";
  }
  return items;
}

std::string charts(const FollowLog& log, const TimeScale& scale) {
  ChartParams distance;
  distance.title = "Distance to the person";
  distance.unit = "m";
  distance.style = "person";
  distance.least_top = 2.0;
  distance.limit = 1.0;
  distance.limit_text = "dashed: 1 m, where it stops; red: target lost";
  ChartParams speed;
  speed.title = "Speed";
  speed.unit = "m/s";
  speed.style = "robot";
  speed.least_top = 0.1;
  speed.limit = log.max_speed_mps;
  speed.limit_text = "dashed: the limit of " + shownNumber(log.max_speed_mps, 2, "m/s");
  ChartParams clearance;
  clearance.title = "Clearance";
  clearance.unit = "m";
  clearance.style = "clear";
  clearance.least_top = 0.5;
  clearance.most_top = 2.0;
  clearance.limit_text = "gap between the robot and the nearest thing or person";
  ChartParams commanded = speed;
  commanded.title = "Speed that Heel would have driven";
  const std::string lost = lostTimes(log.samples, scale);
  return timeChart(
             log.samples, scale, [](const auto& s) { return s.person_distance_m; }, distance,
             lost) +
         timeChart(
             log.samples, scale, [](const auto& s) { return std::abs(s.speed_true.forward_mps); },
             speed) +
         (log.is_shadow
              ? timeChart(
                    log.samples, scale,
                    [](const auto& s) { return std::abs(s.command.forward_mps); }, commanded)
              : std::string()) +
         timeChart(
             log.samples, scale, [](const auto& s) { return s.clearance_m; }, clearance, lost);
}

std::string snapshots(const FollowLog& log, const TimeScale& scale) {
  std::string figures;
  for (const FollowSnapshot& shot : log.snapshots) {
    const std::string address = pictureAddress(shot.picture_bgr);
    if (address.empty()) continue;
    const std::string caption = escapedHtml(shot.caption);
    figures += "<figure class=\"shot\"><img src=\"" + address + "\" width=\"" +
               std::to_string(shot.picture_bgr.cols) + "\" height=\"" +
               std::to_string(shot.picture_bgr.rows) + "\" alt=\"" + caption +
               "\"/><figcaption><button type=\"button\" data-stamp=\"" +
               fixedText(shot.stamp_s, 3) + "\" title=\"Show this moment on the map\">" +
               shownNumber(shot.stamp_s - scale.first_s, 1, "s") + "</button>" + caption +
               "</figcaption></figure>\n";
  }
  if (figures.empty()) return {};
  return "<section class=\"card\" aria-labelledby=\"seen\"><h2 id=\"seen\">What the robot "
         "saw</h2><div class=\"shots\">\n" +
         figures + "</div></section>";
}

std::string film(const FollowLog& log, const FollowPageParams& params) {
  if (params.film.empty()) return {};
  const std::string poster = log.snapshots.empty()
                                 ? std::string()
                                 : pictureAddress(log.snapshots.front().picture_bgr, 960);
  return "<section class=\"card only-screen\" id=\"film-card\" aria-labelledby=\"film-title\"><h2 "
         "id=\"film-title\">Film</h2><video id=\"film\" controls=\"controls\" "
         "preload=\"metadata\"" +
         (poster.empty() ? std::string() : " poster=\"" + poster + "\"") + " src=\"" +
         escapedHtml(params.film) + "\">The film is " + escapedHtml(params.film) +
         ", beside this page.</video></section>";
}

std::string table1(const FollowSummary& sum) {
  std::string rows;
  for (const PaperRow& row : kPaperTable1) rows += runRow(std::string("Paper, ") + row.name, row);
  return rows + runRow("This run", paperRow(sum), "ours");
}

std::string eyebrow(const FollowLog& log) {
  return "Heel \u00b7 person following in simulation \u00b7 plan " + escapedHtml(log.plan) +
         " \u00b7 seed " + std::to_string(log.seed);
}

}  // namespace

Tone toneOf(const std::string& outcome) {
  if (outcome == "reached") return Tone::kGood;
  const bool is_open =
      outcome == "timeout" || outcome == "done" || outcome == kStoppedRun || outcome.empty();
  return is_open ? Tone::kWarning : Tone::kBad;
}

std::string followPage(const FollowLog& log, const FollowSummary& sum,
                       const FollowPageParams& params) {
  const TimeScale scale(log.samples);
  const MapFrame frame(log);
  StateTones tones;
  const std::string timeline = bands(log, scale, tones) + charts(log, scale);
  const FollowMoments moments = followMoments(log, frame, tones, params.most_moments);
  return filledTemplate(
      assets::kFollowHtml,
      {{"title", escapedHtml(log.scene) + " \u00b7 Heel"},
       {"style", std::string(assets::kPageCss) + assets::kFollowCss},
       {"eyebrow", eyebrow(log)},
       {"headline", escapedHtml(log.scene.empty() ? "A run without a name" : log.scene)},
       {"outcome", escapedHtml(sum.outcome.empty() ? "no outcome" : sum.outcome)},
       {"tone", classOf(toneOf(sum.outcome))},
       {"lead", lead(log, sum)},
       {"tiles", tiles(sum)},
       {"map", followMap(log, frame)},
       {"map_legend", followMapLegend(log)},
       {"timeline", timeline},
       {"state_legend", stateLegend(log, tones)},
       {"ticks", timeTicks(scale)},
       {"last_moment", std::to_string(moments.count == 0 ? 0 : moments.count - 1)},
       {"film", film(log, params)},
       {"snapshots", snapshots(log, scale)},
       {"speed_limit", shownNumber(log.max_speed_mps, 1, "m/s")},
       {"table1", table1(sum)},
       {"driving_speed", shownNumber(sum.driving_speed_mps, 3, "m/s")},
       {"learn_time", shownNumber(sum.learn_s, 0, "s")},
       {"timing", timingTable(log.stages, log.step, log.camera_rate_hz)},
       {"footer", howToRepeat(log.command)},
       {"data", moments.json},
       {"script", assets::kFollowJs}});
}

void writeFollowPage(const OutputPath& file, const FollowLog& log, const FollowSummary& summary,
                     const FollowPageParams& params) {
  writeFile(file, followPage(log, summary, params));
}

}  // namespace heel
