// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pages/page_parts.hpp>
#include <heel/apps/pages/pages.hpp>

#include <cmath>

namespace heel {
namespace {

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
  if (log.is_live) {
    return "The robot went <strong>" + shownNumber(sum.distance_m, 1, "m") +
           "</strong> in <strong>" + shownNumber(sum.elapsed_s, 0, "s") +
           "</strong>. It lost them " + timesText(static_cast<std::size_t>(sum.losses)) +
           ". From a picture to the velocity it took " +
           shownNumber(1e3 * sum.latency_median_s, 0, "ms") + ", in 95 of 100 no more than " +
           shownNumber(1e3 * sum.latency_p95_s, 0, "ms") +
           ". Contacts, clearance and the truth of people are not known.";
  }
  const std::string who = log.person.empty() ? "the person" : escapedHtml(log.person);
  std::string text = "The robot went <strong>" + shownNumber(sum.distance_m, 1, "m") +
                     "</strong> behind " + who + " in <strong>" +
                     shownNumber(sum.elapsed_s, 0, "s") + "</strong>";
  if (std::isfinite(sum.last_distance_m)) {
    text += " and was " + shownNumber(sum.last_distance_m, 2, "m") + " from them at the end";
  }
  text += sum.losses == 0
              ? ". It never lost sight of them for more than half a second."
              : ". It lost them " + timesText(static_cast<std::size_t>(sum.losses)) + ".";
  if (sum.contacts_by_robot > 0) {
    text += " <strong class=\"bad\">It touched something " +
            timesText(static_cast<std::size_t>(sum.contacts_by_robot)) + ".</strong>";
  }
  if (sum.contactsByPeople() > 0) {
    text +=
        " It was bumped into " + timesText(static_cast<std::size_t>(sum.contactsByPeople())) + ".";
  }
  return text;
}

std::string tiles(const FollowLog& log, const FollowSummary& sum) {
  const auto share = [](double value) { return shownNumber(100.0 * value, 1, "%"); };
  const double yaw_deg = sum.yaw_rms_rad * 180.0 / M_PI;
  return tile(
             "Distance", shownNumber(sum.distance_m, 2, "m"),
             "in " + shownNumber(sum.elapsed_s, 1, "s") +
                 (sum.learn_s > 0.0 ? ", after " + shownNumber(sum.learn_s, 0, "s") + " of learning"
                                    : std::string())) +
         tile("Speed while driving", shownNumber(sum.driving_speed_mps, 3, "m/s"),
              shownNumber(sum.moving_speed_mps, 3, "m/s") + " over all time not seeking") +
         tile("Time seeking", share(sum.seekShare()),
              shownNumber(sum.seek_s, 1, "s") + "; the paper: 57 to 62\u00a0%") +
         (!log.hasTruth()
              ? std::string()
              : tile("Contacts by the robot", std::to_string(sum.contacts_by_robot),
                     std::to_string(sum.contactsByPeople()) + " by people; least clearance " +
                         shownNumber(sum.min_clearance_m, 2, "m"),
                     sum.contacts_by_robot == 0 ? Tone::kGood : Tone::kBad)) +
         tile("Target in view", share(sum.elapsed_s > 0 ? sum.with_target_s / sum.elapsed_s : 0.0),
              "lost " + timesText(static_cast<std::size_t>(sum.losses))) +
         (!log.hasTruth() ? std::string()
                          : tile("Wrong person", shownNumber(sum.wrong_person_s, 1, "s"),
                                 share(sum.wrongShare()) + " of the time",
                                 sum.wrongShare() < 0.01 ? Tone::kGood : Tone::kBad)) +
         (log.is_live ? std::string()
                      : tile("Place in the map", shownNumber(sum.position_rms_m, 3, "m"),
                             "and " + shownNumber(yaw_deg, 1) + "\u00b0 RMS error")) +
         tile("Nearest to the person", shownNumber(sum.best_distance_m, 2, "m"),
              shownNumber(sum.last_distance_m, 2, "m") + " at the end");
}

BandRow stateBands(const FollowLog& log, StateTones& tones) {
  BandRow row{"What the robot does", {}};
  for (const StateSpan& span : stateSpans(log.samples)) {
    row.bands.push_back({span.from_s, span.to_s, wordsOf(span.state), tones.of(span.state)});
  }
  return row;
}

std::vector<Chart> charts(const FollowLog& log) {
  Chart distance{"Distance to the person", "m", "dashed: 1 m, where it stops; red: target lost",
                 "distance", "--person"};
  distance.least_top = 2.0;
  distance.limit = 1.0;
  distance.has_losses = true;
  Chart speed{"Speed", "m/s",
              "dashed: the limit of " + shownNumber(log.drive.max_speed_mps, 2, "m/s"), "speed",
              "--robot"};
  speed.least_top = 0.1;
  speed.limit = log.drive.max_speed_mps;
  Chart clearance{"Clearance", "m", "gap between the robot and the nearest thing or person",
                  "clearance", "--s-face"};
  clearance.least_top = 0.5;
  clearance.most_top = 2.0;
  clearance.has_losses = true;
  if (!log.is_shadow) return {distance, speed, clearance};
  Chart commanded = speed;
  commanded.title = "Speed that Heel would have driven";
  commanded.column = "commanded";
  return {distance, speed, commanded, clearance};
}

RunMoments moments(const FollowLog& log, const MapFrame& frame, StateTones& tones) {
  constexpr std::size_t kMost = 1500;  // That can be pointed at; the others are passed over.
  std::vector<double> stamps_s;
  double start_s = 0.0;
  for (const FollowSample& sample : log.samples) {
    stamps_s.push_back(sample.stamp_s);
    if (sample.state == "learn") start_s = sample.stamp_s;
  }
  RunMoments moments(stamps_s, kMost);
  const auto of = [&](auto&& value) {
    return [&log, value](std::size_t i) { return value(log.samples[i]); };
  };
  using Sample = const FollowSample&;
  moments.addState(of([](Sample s) { return s.state; }), of([](Sample s) { return s.reason; }),
                   tones);
  moments.addColumn("distance", of([](Sample s) { return s.person_distance_m; }));
  moments.addColumn("speed", of([](Sample s) { return std::abs(s.speed_true.forward_mps); }));
  if (log.is_shadow) {
    moments.addColumn("commanded", of([](Sample s) { return std::abs(s.command.forward_mps); }));
  }
  moments.addColumn("clearance", of([](Sample s) { return s.clearance_m; }));
  moments.addColumn("error", of([](Sample s) {
                      return (s.robot_estimated.position - s.robot_true.position).norm();
                    }));
  addFollowMarks(log, frame, moments);
  moments.startAt(start_s);
  double lost_s = kNotKnown;
  for (const TargetEvent& event : targetEvents(log.samples)) {
    if (event.is_found) moments.addLoss(lost_s, event.stamp_s);
    lost_s = event.is_found ? kNotKnown : event.stamp_s;
  }
  if (std::isfinite(lost_s)) moments.addLoss(lost_s, log.samples.back().stamp_s);
  return moments;
}

std::string stills(const FollowLog& log) {
  std::string figures;
  for (const FollowSnapshot& shot : log.snapshots) {
    figures += stillFigure(shot.stamp_s, log.samples.empty() ? 0.0 : log.samples.front().stamp_s,
                           shot.caption, shot.picture_bgr);
  }
  return stillsSection("What the robot saw", figures);
}

std::string table1(const FollowSummary& sum) {
  std::string rows;
  for (const PaperRow& row : kPaperTable1) rows += runRow(std::string("Paper, ") + row.name, row);
  return rows + runRow("This run", paperRow(sum), "ours");
}

std::string besideThePaper(const FollowLog& log, const FollowSummary& sum) {
  return "<section class=\"card\"><div class=\"two\"><section aria-labelledby=\"paper\"><h2 "
         "id=\"paper\">Beside the paper</h2><div class=\"scroll\"><table><caption>Table 1 of the "
         "paper; both with a limit of " +
         shownNumber(log.drive.max_speed_mps, 1, "m/s") +
         "</caption><thead><tr><th class=\"text\" scope=\"col\">run</th><th "
         "scope=\"col\">distance</th><th scope=\"col\">time</th><th scope=\"col\">speed</th><th "
         "scope=\"col\">seeking</th><th scope=\"col\">share</th></tr></thead><tbody>\n" +
         table1(sum) +
         "</tbody></table></div><p class=\"note\">Seeking is the time spent looking for the lost "
         "person. Speed is distance over the time not spent seeking, the waits beside the person "
         "included; " +
         shownNumber(sum.driving_speed_mps, 3, "m/s") +
         " while the wheels turned. Learning the person beforehand (" +
         shownNumber(sum.learn_s, 0, "s") +
         ") is in none of these figures.</p></section><section aria-labelledby=\"cost\"><h2 "
         "id=\"cost\">Time per step</h2>" +
         timingTable(log.stages, log.step, log.camera_rate_hz) + "</section></div></section>\n";
}

}  // namespace

Tone toneOf(const std::string& outcome) {
  if (outcome == "reached") return Tone::kGood;
  const bool is_open =
      outcome == "timeout" || outcome == "done" || outcome == kStoppedRun || outcome.empty();
  return is_open ? Tone::kWarning : Tone::kBad;
}

std::string followPage(const FollowLog& log, const FollowSummary& sum, const PageFilm& film) {
  const MapFrame frame = followFrame(log);
  StateTones tones;
  RunPage page;
  page.title = escapedHtml(log.scene) + " \u00b7 Heel";
  page.eyebrow = "Heel \u00b7 person following";
  if (log.hasTruth()) page.eyebrow += " in simulation";
  page.eyebrow += " \u00b7 plan " + escapedHtml(wordsOf(log.plan));
  if (log.hasTruth()) page.eyebrow += " \u00b7 seed " + std::to_string(log.seed);
  page.headline = escapedHtml(log.scene.empty() ? "A run without a name" : log.scene);
  page.outcome = escapedHtml(sum.outcome.empty() ? "no outcome" : sum.outcome);
  page.tone = toneOf(sum.outcome);
  page.lead = lead(log, sum);
  page.tiles = tiles(log, sum);
  page.map = followMap(log, frame);
  page.map_legend = followMapLegend(log);
  page.values = momentValue("person is at", "distance", 2, "m") +
                momentValue("speed", "speed", 2, "m/s") +
                momentValue("clearance", "clearance", 2, "m") +
                momentValue("off in the map", "error", 2, "m");
  page.bands = {stateBands(log, tones)};
  page.charts = charts(log);
  page.film = film;
  if (!log.snapshots.empty()) page.film.poster_bgr = log.snapshots.front().picture_bgr;
  page.sections = stills(log) + besideThePaper(log, sum);
  page.footer = howToRepeat(log.command);
  return filledRunPage(page, moments(log, frame, tones));
}

void writeFollowPage(const OutputPath& file, const FollowLog& log, const FollowSummary& summary,
                     const PageFilm& film) {
  writeFile(file, followPage(log, summary, film));
}

}  // namespace heel
