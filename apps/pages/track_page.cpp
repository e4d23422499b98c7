// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pages/pages.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace heel {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostRows = 8;     // of others in the timeline
constexpr std::size_t kMostOthers = 40;  // in the table and on the map
constexpr std::size_t kMostAtOnce = 12;  // marks on the map
constexpr double kFarthest_m = 15.0;     // from the robot: who is farther does not widen the map

/// The target's states in words, and their tones.
struct StateWords {
  const char* state;
  const char* words;
  const char* tone;
};
constexpr StateWords kStates[] = {{"none yet", "not found yet", "--s-learn"},
                                  {"followed", "seen", "--s-face"},
                                  {"coasting", "predicted, not seen", "--s-return"},
                                  {"ambiguous", "several may be it", "--s-search"},
                                  {"lost", "lost", "--s-seek"}};

StateWords wordsFor(const std::string& state) {
  for (const StateWords& known : kStates) {
    if (state == known.state) return known;
  }
  return {"", state.c_str(), "--s-stop"};
}

/// One of the other tracks over the whole recording.
struct Other {
  int id = 0;
  std::vector<Band> bands;
  std::vector<Vector2d> way_m;  ///< NaN where it was not there.
  double first_s = 0.0, last_s = 0.0, seen_s = 0.0, nearest_m = 1e9;
  double probability_sum = 0.0;
  std::size_t samples = 0, last_sample = 0;

  double probability() const { return probability_sum / static_cast<double>(samples); }
  bool isPerson() const { return probability() > 0.5; }
};

double nextStamp(const TrackLog& log, std::size_t i) {
  return log.samples[std::min(i + 1, log.samples.size() - 1)].stamp_s;
}

void add(const TrackLog& log, std::size_t i, const OtherTrack& track, Other& other) {
  const TrackSample& sample = log.samples[i];
  const double until_s = nextStamp(log, i);
  const char* const text = track.is_seen ? "seen" : "predicted, not seen";
  const bool goes_on = other.samples > 0 && other.last_sample + 1 == i;
  if (other.samples == 0) other.first_s = sample.stamp_s;
  if (!goes_on && other.samples > 0) other.way_m.emplace_back(kNotKnown, kNotKnown);
  if (goes_on && other.bands.back().text == text) {
    other.bands.back().to_s = until_s;
  } else {
    other.bands.push_back(
        {sample.stamp_s, until_s, text, track.is_seen ? "--s-follow" : "--s-return"});
  }
  other.way_m.push_back(track.position_m);
  other.last_s = sample.stamp_s;
  if (track.is_seen) other.seen_s += until_s - sample.stamp_s;
  other.nearest_m = std::fmin(other.nearest_m, (track.position_m - sample.robot.position).norm());
  other.probability_sum += track.person_probability;
  other.last_sample = i;
  ++other.samples;
}

/// The other tracks: people before things, who was there longest first.
std::vector<Other> othersOf(const TrackLog& log) {
  std::map<int, Other> by_id;
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    for (const OtherTrack& track : log.samples[i].others) {
      by_id[track.id].id = track.id;
      add(log, i, track, by_id[track.id]);
    }
  }
  std::vector<Other> others;
  for (auto& entry : by_id) others.push_back(std::move(entry.second));
  std::stable_sort(others.begin(), others.end(), [](const Other& a, const Other& b) {
    return a.isPerson() != b.isPerson() ? a.isPerson() : a.samples > b.samples;
  });
  return others;
}

std::string nameOf(const Other& other) {
  return (other.isPerson() ? "Somebody else, track " : "Rather a thing, track ") +
         std::to_string(other.id);
}

// --- The map: x, forward, goes up ----------------------------------------------------------------

Vector2d upward(const Vector2d& place_m) { return {-place_m.y(), place_m.x()}; }

MapFrame frameOf(const TrackLog& log) {
  Eigen::AlignedBox2d bounds;
  const auto extend = [&](const Vector2d& place_m, const Vector2d& robot_m) {
    if (place_m.allFinite() && (place_m - robot_m).norm() < kFarthest_m) {
      bounds.extend(upward(place_m));
    }
  };
  for (const TrackSample& sample : log.samples) {
    const Vector2d& robot_m = sample.robot.position;
    if (!robot_m.allFinite()) continue;
    extend(robot_m - Vector2d(0.4, 0.0), robot_m);
    if (sample.target_m) extend(*sample.target_m, robot_m);
    for (const OtherTrack& other : sample.others) extend(other.position_m, robot_m);
    if (log.moves || &sample != &log.samples.front()) continue;
    for (const Vector2d& place_m : log.seen_floor_m) extend(sample.robot * place_m, robot_m);
  }
  return MapFrame(bounds);
}

std::string wayPath(const std::string& of_class, const MapFrame& frame,
                    const std::vector<Vector2d>& way_m) {
  std::vector<Vector2d> drawn;
  for (const Vector2d& place_m : way_m) drawn.push_back(frame(upward(place_m)));
  return svgShape(of_class, svgPath(simplified(drawn, 0.015)));
}

std::string boundsPath(const TrackLog& log, const MapFrame& frame) {
  if (!log.bounds_m) return {};
  const Vector2d a = log.bounds_m->min(), b = log.bounds_m->max();
  return wayPath("bounds", frame, {a, {a.x(), b.y()}, b, {b.x(), a.y()}, a});
}

/// The robot and what its camera sees, in its own frame, x to the right.
std::string robotMark(const TrackLog& log) {
  std::vector<Vector2d> view;
  for (const Vector2d& place_m : log.seen_floor_m) view.emplace_back(place_m.x(), -place_m.y());
  const std::string path = svgPath(view);
  return "<g id=\"now-robot\" visibility=\"hidden\">" +
         svgShape("now-view", path.empty() ? path : path + "Z") +
         "<circle class=\"now-robot\" r=\".2\"/><line class=\"now-nose\" x1=\"0\" y1=\"0\" "
         "x2=\".2\" y2=\"0\"/></g>\n";
}

std::size_t mostAtOnce(const TrackLog& log) {
  std::size_t most = 0;
  for (const TrackSample& sample : log.samples) most = std::max(most, sample.others.size());
  return std::min(most, kMostAtOnce);
}

std::string mapOf(const TrackLog& log, const std::vector<Other>& others, const MapFrame& frame) {
  std::string svg = svgMap(frame, "Seen from above: where the target and others were");
  svg += robotMark(log) + boundsPath(log, frame);
  for (std::size_t i = 0; i < std::min(others.size(), kMostOthers); ++i) {
    svg += wayPath("other-path", frame, others[i].way_m);
  }
  std::vector<Vector2d> target_m, robot_m;
  for (const TrackSample& sample : log.samples) {
    target_m.push_back(sample.target_m.value_or(Vector2d(kNotKnown, kNotKnown)));
    robot_m.push_back(sample.robot.position);
  }
  if (log.moves) svg += wayPath("robot-path", frame, robot_m);
  svg += wayPath("person-path", frame, target_m);
  for (std::size_t i = 0; i < mostAtOnce(log); ++i) {
    svg += "<g id=\"now-other-" + std::to_string(i) +
           "\" visibility=\"hidden\"><circle class=\"now-other\" r=\".2\"/><text "
           "y=\".09\">0</text></g>\n";
  }
  return svg +
         "<circle id=\"now-target\" class=\"now-person\" r=\".25\" visibility=\"hidden\"/>\n</svg>";
}

std::string mapLegend(const TrackLog& log, const std::vector<Other>& others,
                      const MapFrame& frame) {
  std::string items = legendLine("--person", "6 4", "target");
  items += legendLine("--robot", "none", log.moves ? "robot" : "robot (it stands)");
  if (!others.empty()) items += legendLine("--other", "1 4", "others, by track number");
  if (!log.seen_floor_m.empty()) {
    items += legendItem("<path class=\"now-view\" d=\"M1 7L25 0V14Z\"/>", "what the camera sees");
  }
  return items + legendItem(
                     "<path class=\"lattice\" stroke=\"var(--soft)\" fill=\"none\" "
                     "d=\"M6 0h14v14h-14Z\"/>",
                     shownNumber(frame.step_m(), frame.step_m() < 1.0 ? 1 : 0, "m"));
}

// --- The timeline --------------------------------------------------------------------------------

RunMoments momentsOf(const TrackLog& log, const MapFrame& frame, StateTones& tones) {
  std::vector<double> stamps_s;
  for (const TrackSample& sample : log.samples) stamps_s.push_back(sample.stamp_s);
  RunMoments moments(stamps_s);
  const auto& samples = log.samples;
  moments.addState([&](std::size_t i) { return std::string(wordsFor(samples[i].state).words); },
                   [&](std::size_t i) { return samples[i].reason; }, tones);
  moments.addColumn("distance", [&](std::size_t i) {
    const TrackSample& s = samples[i];
    return s.target_m ? (*s.target_m - s.robot.position).norm() : kNotKnown;
  });
  moments.addColumn("confidence", [&](std::size_t i) {
    return samples[i].target_m ? 100.0 * samples[i].confidence : kNotKnown;
  });
  moments.addColumn("colors", [&](std::size_t i) { return 100.0 * samples[i].color_share; });
  moments.addColumn("others", [&](std::size_t i) { return double(samples[i].others.size()); });
  const auto drawn = [&](const Vector2d& place_m) { return frame(upward(place_m)); };
  moments.addMark(
      "now-robot", [&](std::size_t i) { return drawn(samples[i].robot.position); },
      [&](std::size_t i) { return samples[i].robot.yaw_rad + M_PI / 2.0; });
  moments.addMark("now-target", [&](std::size_t i) {
    const auto& target_m = samples[i].target_m;
    return target_m ? std::optional<Vector2d>(drawn(*target_m)) : std::nullopt;
  });
  for (std::size_t k = 0; k < mostAtOnce(log); ++k) {
    const auto has = [&samples, k](std::size_t i) { return k < samples[i].others.size(); };
    moments.addMark(
        "now-other-" + std::to_string(k),
        [&](std::size_t i) {
          return has(i) ? std::optional<Vector2d>(drawn(samples[i].others[k].position_m))
                        : std::nullopt;
        },
        nullptr,
        [&](std::size_t i) { return has(i) ? std::to_string(samples[i].others[k].id) : ""; });
  }
  return moments;
}

/// Times without a target, from the first time on that there was one.
std::vector<StateSpan> losses(const TrackLog& log) {
  std::vector<StateSpan> spans;
  bool was_found = false, is_lost = false;
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    const bool has = log.samples[i].target_m.has_value();
    was_found = was_found || has;
    if (!has && was_found) {
      if (!is_lost) spans.push_back({"lost", log.samples[i].stamp_s, 0.0});
      spans.back().to_s = nextStamp(log, i);
    }
    is_lost = !has && was_found;
  }
  return spans;
}

std::vector<BandRow> bandsOf(const TrackLog& log, const std::vector<Other>& others,
                             StateTones& tones) {
  BandRow states{"The target", {}}, reasons{"Why it is not seen", {}};
  for (const StateSpan& span : stateSpans(log.samples)) {
    const StateWords words = wordsFor(span.state);
    states.bands.push_back({span.from_s, span.to_s, words.words, words.tone});
  }
  for (const StateSpan& span : stateSpans(log.samples, &TrackSample::reason)) {
    if (span.state.empty()) continue;
    reasons.bands.push_back({span.from_s, span.to_s, span.state, tones.of(span.state)});
  }
  std::vector<BandRow> rows = {states, reasons};
  for (std::size_t i = 0; i < std::min(others.size(), kMostRows); ++i) {
    rows.push_back(
        {nameOf(others[i]), others[i].bands, false, i == 0 ? "blue: seen; yellow: predicted" : ""});
  }
  return rows;
}

std::vector<Chart> chartsOf() {
  Chart distance{"Distance of the target", "m", "red: there is no target", "distance", "--person"};
  distance.least_top = 2.0;
  distance.has_losses = true;
  Chart confidence{"Confidence that it is the target", "%", "", "confidence", "--s-face", 0};
  confidence.least_top = confidence.most_top = 100.0;
  confidence.has_losses = true;
  Chart colors{"Picture with the target's colours", "%", "", "colors", "--robot", 1};
  return {distance, confidence, colors};
}

// --- Words and figures ---------------------------------------------------------------------------

struct Sums {
  double all_s = 0.0, seen_s = 0.0, predicted_s = 0.0, longest_s = 0.0;
  std::size_t losses = 0;
  std::optional<double> found_s;  ///< Since the beginning.
};

Sums sumsOf(const TrackLog& log) {
  Sums sums;
  if (log.samples.empty()) return sums;
  const double first_s = log.samples.front().stamp_s;
  sums.all_s = log.samples.back().stamp_s - first_s;
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    const TrackSample& sample = log.samples[i];
    const double held_s = nextStamp(log, i) - sample.stamp_s;
    if (sample.state == "followed") sums.seen_s += held_s;
    if (sample.state == "coasting") sums.predicted_s += held_s;
    if (sample.target_m && !sums.found_s) sums.found_s = sample.stamp_s - first_s;
  }
  for (const StateSpan& span : losses(log)) {
    ++sums.losses;
    sums.longest_s = std::fmax(sums.longest_s, span.to_s - span.from_s);
  }
  return sums;
}

std::string leadOf(const TrackLog& log, const Sums& sums) {
  const std::string who = log.person.empty() ? "The target" : escapedHtml(log.person);
  if (!sums.found_s) {
    return "<strong>" + who + "</strong> is in no frame of this recording, as far as can be told.";
  }
  std::string text = "<strong>" + who + "</strong> was found after " +
                     shownNumber(*sums.found_s, 1, "s") + ", seen for <strong>" +
                     shownNumber(sums.seen_s, 1, "s") + "</strong> of " +
                     shownNumber(sums.all_s, 1, "s");
  return text +
         (sums.losses == 0 ? ", and never lost." : ", and lost " + timesText(sums.losses) + ".");
}

std::string tilesOf(const TrackLog& log, const Sums& sums, const std::vector<Other>& others) {
  const auto share = [&](double held_s) {
    return sums.all_s > 0.0 ? shownNumber(100.0 * held_s / sums.all_s, 1, "%")
                            : shownNumber(kNotKnown, 1);
  };
  const auto people = std::count_if(others.begin(), others.end(),
                                    [](const Other& other) { return other.isPerson(); });
  const std::string skipped =
      log.skipped == 0 ? "none left out" : std::to_string(log.skipped) + " left out";
  return tile("Target seen", share(sums.seen_s), shownNumber(sums.seen_s, 1, "s"),
              sums.found_s ? Tone::kGood : Tone::kBad) +
         tile("Predicted, not seen", share(sums.predicted_s),
              shownNumber(sums.predicted_s, 1, "s")) +
         tile("Lost", sums.losses == 0 ? "never" : timesText(sums.losses),
              sums.losses == 0 ? "once it was found"
                               : "longest for " + shownNumber(sums.longest_s, 1, "s")) +
         tile("Others", std::to_string(people),
              "tracks of people; " + std::to_string(others.size() - std::size_t(people)) +
                  " of things") +
         tile("Frames", std::to_string(log.samples.size()), skipped) +
         tile("Time", shownNumber(sums.all_s, 1, "s"), escapedHtml(log.layout)) +
         tile("Robot", log.moves ? "moves" : "stands",
              log.moves ? "places in the frame " + escapedHtml(log.frame)
                        : "places as seen from it") +
         tile("Model", escapedHtml(log.person.empty() ? "without a name" : log.person),
              "learned before");
}

std::string warningsSection(const TrackLog& log) {
  if (log.warnings.empty()) return {};
  std::string items;
  for (const std::string& warning : log.warnings) items += "<li>" + escapedHtml(warning) + "</li>";
  return "<section class=\"card\" aria-labelledby=\"warnings\"><h2 id=\"warnings\">What to know "
         "about this recording</h2><ul>" +
         items + "</ul></section>\n";
}

std::string othersSection(const TrackLog& log, const std::vector<Other>& others) {
  std::string section =
      "<section class=\"card\" aria-labelledby=\"others\"><h2 id=\"others\">Who else was "
      "there</h2>";
  if (others.empty()) return section + "<p>Nobody else was tracked.</p></section>\n";
  const double first_s = log.samples.front().stamp_s;
  std::string rows;
  for (std::size_t i = 0; i < std::min(others.size(), kMostOthers); ++i) {
    const Other& o = others[i];
    rows += "<tr><th scope=\"row\">" + nameOf(o) + "</th><td>" +
            shownNumber(100.0 * o.probability(), 0, "%") + "</td><td>" +
            shownNumber(o.first_s - first_s, 1, "s") + "</td><td>" +
            shownNumber(o.last_s - first_s, 1, "s") + "</td><td>" + shownNumber(o.seen_s, 1, "s") +
            "</td><td>" + shownNumber(o.nearest_m, 2, "m") + "</td></tr>\n";
  }
  section +=
      "<p class=\"note\">A track is what was followed without a break: who is lost and comes back "
      "may get a new one, and the target's own track is here for the times when it was not yet, or "
      "no longer, taken for the target.</p><div class=\"scroll\"><table><thead><tr><th "
      "class=\"text\" scope=\"col\">who</th><th scope=\"col\">a person</th><th "
      "scope=\"col\">from</th><th scope=\"col\">to</th><th scope=\"col\">seen for</th><th "
      "scope=\"col\">nearest to the robot</th></tr></thead><tbody>\n" +
      rows + "</tbody></table></div>";
  if (others.size() > kMostOthers) {
    section += "<p class=\"note\">and " + std::to_string(others.size() - kMostOthers) +
               " that were there for a shorter time: see tracks.csv</p>";
  }
  return section + "</section>\n";
}

std::string picture(const cv::Mat& picture_bgr, const std::string& what) {
  const std::string address = pictureAddress(picture_bgr, 1200);
  if (address.empty()) return {};
  return "<img class=\"model\" src=\"" + address + "\" alt=\"" + what + "\"/>";
}

std::string modelSection(const TrackLog& log) {
  const std::string colors = picture(log.colors_bgr, "The model's colours");
  if (colors.empty()) return {};
  return "<section class=\"card\" aria-labelledby=\"model\"><h2 id=\"model\">How the target is "
         "known</h2><p class=\"note\">The colours of the model " +
         escapedHtml(log.person) +
         ", a row for each part of the body: those of the person, those of the room, and those "
         "that are taken for the person's.</p>" +
         colors + picture(log.learned_bgr, "Who was learned") + "</section>\n";
}

}  // namespace

std::string trackPage(const TrackLog& log, const PageFilm& film) {
  const std::vector<Other> others = othersOf(log);
  const MapFrame frame = frameOf(log);
  const Sums sums = sumsOf(log);
  StateTones tones;
  for (const StateWords& known : kStates) tones.use(known.words, known.tone);
  RunMoments moments = momentsOf(log, frame, tones);
  for (const StateSpan& span : losses(log)) moments.addLoss(span.from_s, span.to_s);
  const auto found = std::find_if(log.samples.begin(), log.samples.end(),
                                  [](const TrackSample& s) { return s.target_m.has_value(); });
  if (found != log.samples.end()) moments.startAt(found->stamp_s);
  RunPage page;
  page.title = escapedHtml(log.recording) + " \u00b7 Heel";
  page.eyebrow = "Heel \u00b7 a learned person in a recording \u00b7 " + escapedHtml(log.layout);
  page.headline = escapedHtml(log.recording.empty() ? "A recording" : log.recording);
  page.outcome = !log.complete ? "stopped early" : sums.found_s ? "found" : "not found";
  page.tone = !log.complete ? Tone::kWarning : sums.found_s ? Tone::kGood : Tone::kBad;
  page.lead = leadOf(log, sums);
  page.tiles = tilesOf(log, sums, others);
  page.map = mapOf(log, others, frame);
  page.map_legend = mapLegend(log, others, frame);
  page.values = momentValue("target is at", "distance", 2, "m") +
                momentValue("confidence", "confidence", 0, "%") +
                momentValue("others", "others", 0, "");
  page.film = film;
  page.bands = bandsOf(log, others, tones);
  page.charts = chartsOf();
  std::string stills;
  for (const FollowSnapshot& still : log.stills) {
    stills += stillFigure(still.stamp_s, moments.first_s(), still.caption, still.picture_bgr);
    if (page.film.poster_bgr.empty()) page.film.poster_bgr = still.picture_bgr;
  }
  page.sections = warningsSection(log) + othersSection(log, others) + modelSection(log) +
                  stillsSection("What the robot saw", stills);
  page.footer =
      "<p>The figures are in tracks.csv and frames.csv, beside this page; X is forward, here "
      "up.</p>";
  return filledRunPage(page, std::move(moments));
}

}  // namespace heel
