// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/page_parts.hpp>

#include "page_assets.hpp"
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

namespace heel {

const char* classOf(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return "good";
    case Tone::kWarning:
      return "warning";
    case Tone::kBad:
      return "bad";
    case Tone::kNeutral:
      break;
  }
  return "neutral";
}

std::string tile(const std::string& name, const std::string& figure, const std::string& note,
                 Tone tone) {
  return "<div class=\"tile\"><dt>" + name + "</dt><dd class=\"" + classOf(tone) + "\">" + figure +
         "</dd><dd>" + note + "</dd></div>\n";
}

std::string bar(double share, const std::string& of_class) {
  const double percent = 100.0 * std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0);
  return "<span class=\"bar " + of_class + "\"><i style=\"width:" + fixedText(percent, 1) +
         "%\"></i></span>";
}

std::string histogram(const std::string& title, std::vector<double> values,
                      const std::string& unit) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double value) { return !std::isfinite(value); }),
               values.end());
  const std::string head = "<figure class=\"histogram\"><figcaption><b>" + title + "</b>" +
                           (unit.empty() ? "" : " [" + unit + "]");
  if (values.empty()) return head + " no values</figcaption></figure>\n";
  std::sort(values.begin(), values.end());
  const double median = values[values.size() / 2];
  return head + " median " + shownNumber(median, median == std::round(median) ? 0 : 2) +
         "</figcaption><div role=\"img\" aria-label=\"Histogram: " + title + "\" data-values=\"" +
         nlohmann::json(values).dump() + "\"></div></figure>\n";
}

std::string runRow(const std::string& name, const PaperRow& row, const std::string& of_class,
                   bool with_bar) {
  const double share = row.elapsed_s > 0.0 ? row.seek_s / row.elapsed_s : kNotKnown;
  return "<tr class=\"" + of_class + "\"><th scope=\"row\">" + name + "</th><td>" +
         shownNumber(row.distance_m, 2, "m") + "</td><td>" + shownNumber(row.elapsed_s, 1, "s") +
         "</td><td>" + shownNumber(row.moving_speed_mps, 2, "m/s") + "</td><td>" +
         shownNumber(row.seek_s, 1, "s") + "</td><td>" + shownNumber(100.0 * share, 0, "%") +
         "</td>" + (with_bar ? "<td class=\"grow\">" + bar(share) + "</td>" : "") + "</tr>\n";
}

std::string timingTable(const std::vector<StageTime>& stages, const StageTime& step,
                        double camera_rate_hz) {
  if (stages.empty()) return "<p class=\"note\">Nothing was timed.</p>";
  double most_ms = 0.0;
  for (const StageTime& stage : stages) most_ms = std::fmax(most_ms, stage.mean_ms);
  std::string rows;
  for (const StageTime& stage : stages) {
    rows += "<tr><th scope=\"row\">" + escapedHtml(wordsOf(stage.name)) + "</th><td>" +
            shownNumber(stage.mean_ms, 2) + "</td><td>" + shownNumber(stage.p95_ms, 2) +
            "</td><td>" + bar(most_ms > 0.0 ? stage.mean_ms / most_ms : 0.0) + "</td></tr>\n";
  }
  rows += "<tr class=\"ours\"><th scope=\"row\">" + escapedHtml(step.name) + "</th><td>" +
          shownNumber(step.mean_ms, 2) + "</td><td>" + shownNumber(step.p95_ms, 2) +
          "</td><td></td></tr>\n";
  std::string note;
  if (camera_rate_hz > 0.0) {
    const double frame_ms = 1000.0 / camera_rate_hz;
    const char* const verdict = step.p95_ms <= frame_ms    ? "the loop keeps up."
                                : step.mean_ms <= frame_ms ? "the loop keeps up on the whole."
                                                           : "the loop does not keep up.";
    note = "<p class=\"note\">A camera of " + shownNumber(camera_rate_hz, 0, "Hz") + " leaves " +
           shownNumber(frame_ms, 1, "ms") + " a frame: " + verdict + "</p>";
  }
  return "<div class=\"scroll\"><table><caption>Milliseconds of each stage on this "
         "machine</caption><thead><tr><th class=\"text\" scope=\"col\">stage</th><th "
         "scope=\"col\">mean</th><th scope=\"col\">95 %</th><th scope=\"col\"><span "
         "aria-hidden=\"true\">share</span></th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>" + note;
}

std::string howToRepeat(const std::string& command) {
  if (command.empty()) return {};
  return "<p>Repeat it: <code>" + escapedHtml(command) + "</code></p>";
}

std::string head(const std::string& title, const std::string& style) {
  return filledTemplate(
      assets::kHeadHtml,
      {{"title", title}, {"style", std::string(assets::kPageCss) + style + assets::kUplotCss}});
}

std::string scripts(const char* script) {
  return filledTemplate(
      assets::kScriptsHtml,
      {{"uplot_licence", assets::kUplotLicence}, {"uplot", assets::kUplotJs}, {"script", script}});
}

namespace {

const std::map<std::string, std::string> kTones = {
    {"learn", "learn"},         {"follow", "follow"},
    {"face", "face"},           {"goToLastSeen", "return"},
    {"turnToLastSeen", "seek"}, {"seek", "seek"},
    {"search", "search"},       {"look", "search"},
    {"stop", "stop"},           {"wait", "stop"}};
constexpr std::array<const char*, 8> kFurtherTones = {"a", "b", "c", "d", "e", "f", "g", "h"};

}  // namespace

std::string timesText(std::size_t count) {
  return count == 1 ? "once" : count == 2 ? "twice" : std::to_string(count) + " times";
}

std::string wordsOf(const std::string& state) {
  std::string words;
  for (const char c : state) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isupper(byte) != 0 && !words.empty()) words += ' ';
    words += c == '_' ? ' ' : static_cast<char>(std::tolower(byte));
  }
  return words.empty() ? "no state" : words;
}

std::string StateTones::of(const std::string& state) {
  const auto known = std::find(states_.begin(), states_.end(), state);
  if (known != states_.end()) return tones_[static_cast<std::size_t>(known - states_.begin())];
  const auto own = kTones.find(state);
  const std::string tone =
      own != kTones.end() ? own->second : kFurtherTones[others_++ % kFurtherTones.size()];
  use(state, "--s-" + tone);
  return tones_.back();
}

void StateTones::use(const std::string& state, const std::string& tone) {
  states_.push_back(state);
  tones_.push_back(tone);
}

}  // namespace heel
