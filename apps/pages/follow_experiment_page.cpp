// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/page_parts.hpp>
#include <heel/apps/pages/pages.hpp>

#include "page_assets.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace heel {
namespace {

using Episodes = std::vector<FollowEpisode>;

std::string share(double value, int decimals = 1) {
  return shownNumber(100.0 * value, decimals, "%");
}

std::string cell(const std::string& text, const std::string& of_class = {}) {
  return "<td" + (of_class.empty() ? of_class : " class=\"" + of_class + "\"") + ">" + text +
         "</td>";
}

std::string rowHead(const std::string& text) { return "<th scope=\"row\">" + text + "</th>"; }

/// The name, as the page calls it.
std::string planName(const std::string& plan) { return escapedHtml(plan) + " plan"; }

/// The paper's experiments, each followed by ours with each plan.
std::string table1Rows(const FollowExperiment& experiment) {
  std::string rows;
  for (const PaperRow& paper : kPaperTable1) {
    rows += runRow(std::string(paper.name) + ", as reported", paper, "paper", true);
    for (const std::string& plan : experiment.plans) {
      for (const FollowEpisode& e : experiment.table1) {
        if (e.name != paper.name || e.plan != plan) continue;
        rows += runRow("\u2003" + planName(plan) + " <span class=\"badge " +
                           classOf(toneOf(e.summary.outcome)) + "\">" +
                           escapedHtml(e.summary.outcome) + "</span>",
                       paperRow(e.summary), plan == experiment.plans.back() ? "ours" : "", true);
      }
    }
  }
  return rows;
}

std::string countRows(const FollowExperiment& experiment) {
  std::string rows;
  for (const std::string& plan : experiment.plans) {
    const EpisodeCounts n = countEpisodes(experiment.episodes, plan);
    if (n.episodes == 0) continue;
    const double not_seeking_s = n.elapsed_s - n.seek_s;
    rows += "<tr>" + rowHead(planName(plan)) + cell(std::to_string(n.episodes)) +
            cell(std::to_string(n.reached), n.reached == n.episodes ? "good" : "") +
            cell(std::to_string(n.with_contact), n.with_contact == 0 ? "good" : "bad") +
            cell(share(n.wrongShare(), 2), n.wrongShare() < kWrongShareLimit ? "good" : "bad") +
            cell(share(n.elapsed_s > 0.0 ? n.seek_s / n.elapsed_s : 0.0)) +
            cell(shownNumber(not_seeking_s > 0.0 ? n.distance_m / not_seeking_s : kNotKnown, 2,
                             "m/s")) +
            cell(shownNumber(n.distance_m, 0, "m")) +
            cell(shownNumber(n.elapsed_s / 60.0, 0, "min")) + "</tr>\n";
  }
  return rows;
}

std::string outcomeRows(const FollowExperiment& experiment) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const FollowEpisode& e : experiment.episodes) ++counts[e.summary.outcome][e.plan];
  std::string rows;
  for (const auto& [outcome, of_plans] : counts) {
    rows += "<tr>" + rowHead("<span class=\"badge " + std::string(classOf(toneOf(outcome))) +
                             "\">" + escapedHtml(outcome) + "</span>");
    for (const std::string& plan : experiment.plans) {
      const auto count = of_plans.find(plan);
      rows += cell(std::to_string(count == of_plans.end() ? 0 : count->second));
    }
    rows += "</tr>\n";
  }
  return rows;
}

std::string headCells(const std::vector<std::string>& plans) {
  std::string cells;
  for (const std::string& plan : plans) cells += "<th scope=\"col\">" + planName(plan) + "</th>";
  return cells;
}

std::string histogramsOf(const FollowExperiment& experiment, const std::string& plan) {
  const auto of = [&](const std::string& title, const std::string& unit, auto&& value) {
    std::vector<double> values;
    for (const FollowEpisode& e : experiment.episodes) {
      if (e.plan == plan) values.push_back(value(e.summary));
    }
    return histogram(title, values, unit);
  };
  using Summary = const FollowSummary&;
  return "<h3>How they were spread, " + planName(plan) + "</h3><div class=\"histograms\">\n" +
         of("Time", "s", [](Summary s) { return s.elapsed_s; }) +
         of("Distance", "m", [](Summary s) { return s.distance_m; }) +
         of("Speed when not seeking", "m/s", [](Summary s) { return s.moving_speed_mps; }) +
         of("Time seeking", "%", [](Summary s) { return 100.0 * s.seekShare(); }) +
         of("Least clearance", "m", [](Summary s) { return s.min_clearance_m; }) +
         of("Error of the place in the map", "m", [](Summary s) { return s.position_rms_m; }) +
         "</div>\n";
}

std::string histograms(const FollowExperiment& experiment) {
  std::string all;
  for (const std::string& plan : experiment.plans) {
    if (countEpisodes(experiment.episodes, plan).episodes > 0) {
      all += histogramsOf(experiment, plan);
    }
  }
  return all;
}

std::string failures(const FollowExperiment& experiment) {
  std::string rows;
  for (const Episodes* all : {&experiment.table1, &experiment.episodes}) {
    for (const FollowEpisode& e : *all) {
      if (!isFailure(e)) continue;
      std::string what = escapedHtml(e.summary.outcome);
      if (const int contacts = e.summary.contacts_by_robot; contacts > 0) {
        what += ", " + std::to_string(contacts) + " contacts";
      }
      if (e.summary.wrongShare() >= kWrongShareLimit) {
        what += ", wrong person " + share(e.summary.wrongShare());
      }
      rows += "<tr>" + rowHead(escapedHtml(e.name)) + cell(std::to_string(e.seed)) +
              cell(escapedHtml(e.plan), "text") + cell(what, "text bad") +
              cell(e.cause.empty() ? "not known" : escapedHtml(e.cause), "wrap") +
              cell(e.command.empty() ? "" : "<code>" + escapedHtml(e.command) + "</code>", "wrap") +
              "</tr>\n";
    }
  }
  if (rows.empty()) return "<p>None: each run reached the person and touched nothing.</p>";
  return "<div class=\"scroll\"><table><thead><tr><th class=\"text\" scope=\"col\">run</th><th "
         "scope=\"col\">seed</th><th class=\"text\" scope=\"col\">plan</th><th class=\"text\" "
         "scope=\"col\">outcome</th><th class=\"text\" scope=\"col\">cause</th><th class=\"text\" "
         "scope=\"col\">repeat it</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>";
}

std::string episodeRows(const Episodes& episodes) {
  std::string rows;
  for (const FollowEpisode& e : episodes) {
    const FollowSummary& s = e.summary;
    rows += "<tr>" + rowHead(escapedHtml(e.name)) + cell(std::to_string(e.seed)) +
            cell(escapedHtml(e.plan), "text") +
            cell(escapedHtml(s.outcome), std::string("text ") + classOf(toneOf(s.outcome))) +
            cell(shownNumber(s.distance_m, 1, "m")) + cell(shownNumber(s.elapsed_s, 0, "s")) +
            cell(share(s.seekShare(), 0)) + cell(shownNumber(s.moving_speed_mps, 2, "m/s")) +
            cell(std::to_string(s.contacts_by_robot), s.contacts_by_robot > 0 ? "bad" : "") +
            cell(std::to_string(s.contactsByPeople())) +
            cell(shownNumber(s.wrong_person_s, 1, "s")) +
            cell(shownNumber(s.min_clearance_m, 2, "m")) +
            cell(shownNumber(s.position_rms_m, 3, "m")) + "</tr>\n";
  }
  return rows;
}

std::string tiles(const FollowExperiment& experiment) {
  const std::string plan = experiment.plans.empty() ? "" : experiment.plans.back();
  const EpisodeCounts n = countEpisodes(experiment.episodes, plan);
  double most_seeking = kNotKnown, least_speed = kNotKnown;
  for (const FollowEpisode& e : experiment.table1) {
    if (e.plan != plan) continue;
    most_seeking = std::fmax(most_seeking, e.summary.seekShare());
    least_speed = std::fmin(least_speed, e.summary.moving_speed_mps);
  }
  const auto tone = [](bool good) { return good ? Tone::kGood : Tone::kBad; };
  const double reached = n.episodes > 0 ? static_cast<double>(n.reached) / n.episodes : kNotKnown;
  return tile("Person reached", std::to_string(n.reached) + " of " + std::to_string(n.episodes),
              "random episodes", n.episodes > 0 ? tone(reached >= 0.95) : Tone::kNeutral) +
         tile("Episodes with a contact by the robot", std::to_string(n.with_contact),
              std::to_string(n.contacts_by_robot) + " contacts in " +
                  shownNumber(n.distance_m, 0, "m") + "; " + std::to_string(n.contacts_by_people) +
                  " by people",
              tone(n.with_contact == 0)) +
         tile("Wrong person followed", share(n.wrongShare(), 2), "of the time",
              tone(n.wrongShare() < kWrongShareLimit)) +
         tile("Seeking in Table 1", "at most " + share(most_seeking, 0),
              "the paper: 57 to 62\u00a0%; speed from " + shownNumber(least_speed, 2, "m/s"),
              std::isfinite(most_seeking) ? tone(most_seeking < 0.2) : Tone::kNeutral);
}

}  // namespace

std::string followExperimentPage(const FollowExperiment& experiment) {
  const auto failed =
      std::count_if(experiment.episodes.begin(), experiment.episodes.end(), isFailure) +
      std::count_if(experiment.table1.begin(), experiment.table1.end(), isFailure);
  return filledTemplate(assets::kExperimentHtml,
                        {{"title", escapedHtml(experiment.title)},
                         {"head", head(escapedHtml(experiment.title) + " · Heel")},
                         {"scripts", scripts(assets::kHistogramsJs)},
                         {"tiles", tiles(experiment)},
                         {"speed_limit", shownNumber(experiment.max_speed_mps, 1, "m/s")},
                         {"table1", table1Rows(experiment)},
                         {"episodes", std::to_string(experiment.episodes.size())},
                         {"counts", countRows(experiment)},
                         {"plans", headCells(experiment.plans)},
                         {"outcomes", outcomeRows(experiment)},
                         {"histograms", histograms(experiment)},
                         {"failed", std::to_string(failed)},
                         {"failures", failures(experiment)},
                         {"rows", episodeRows(experiment.episodes)},
                         {"footer", howToRepeat(experiment.command)}});
}

void writeFollowExperimentPage(const OutputPath& file, const FollowExperiment& experiment) {
  writeFile(file, followExperimentPage(experiment));
}

}  // namespace heel
