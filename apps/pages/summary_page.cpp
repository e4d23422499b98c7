// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/run_end.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/page_parts.hpp>
#include <heel/apps/pages/pages.hpp>
#include <heel/cloud/files.hpp>
#include <heel/cloud/image_extent.hpp>

#include "page_assets.hpp"
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;

std::string meaningOf(int exit_code) {
  switch (static_cast<ExitCode>(exit_code)) {
    case ExitCode::kDone:
      return "done";
    case ExitCode::kFault:
      return "a fault of ours or of the machine";
    case ExitCode::kUsage:
      return "a wrong call";
    case ExitCode::kBadInput:
      return "bad input";
    case ExitCode::kNothingFound:
      return "nothing found";
    case ExitCode::kStopped:
      return "stopped";
  }
  return "exit code " + std::to_string(exit_code);
}

/// The call as a shell takes it.
std::string commandOf(const RunRow& run) {
  std::string command;
  for (const std::string& word : run.call) {
    constexpr const char* kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
    const bool is_plain = !word.empty() && word.find_first_not_of(kPlain) == std::string::npos;
    std::string quoted = word;
    for (std::size_t at = 0; !is_plain && (at = quoted.find('\'', at)) != std::string::npos;) {
      quoted.replace(at, 1, "'\\''");
      at += 4;
    }
    command += (command.empty() ? "" : " ") + (is_plain ? word : "'" + quoted + "'");
  }
  return command;
}

std::string commandCell(const RunRow& run) {
  return "<td class=\"wrap\">" +
         (run.call.empty() ? "" : "<code>" + escapedHtml(commandOf(run)) + "</code>") + "</td>";
}

std::string tiles(const RunTable& table) {
  std::map<int, std::size_t> fates;
  for (const RunRow& run : table.runs) ++fates[run.exit_code];
  std::string all = tile("Runs", std::to_string(table.runs.size()), "");
  for (const auto& [exit_code, count] : fates) {
    all +=
        tile(meaningOf(exit_code), std::to_string(count), "exit code " + std::to_string(exit_code),
             exit_code == 0 ? Tone::kGood : Tone::kBad);
  }
  return all;
}

std::string failureRows(const RunTable& table) {
  std::string rows;
  for (const RunRow& run : table.runs) {
    if (run.exit_code == 0) continue;
    rows += "<tr><th scope=\"row\">" + escapedHtml(run.name) + "</th><td class=\"text bad\">" +
            meaningOf(run.exit_code) + "</td><td class=\"wrap\">" + escapedHtml(run.reason) +
            "</td>" + commandCell(run) + "</tr>\n";
  }
  return rows;
}

std::string histograms(const RunTable& table) {
  std::string all;
  for (const std::string& column : table.figures()) {
    std::vector<double> values;
    for (const RunRow& run : table.runs) values.push_back(run.number(column));
    all += histogram(escapedHtml(column), values);
  }
  return all;
}

/// The middle one of a run's stills.
cv::Mat stillOf(const fs::path& results) {
  std::vector<fs::path> stills;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(results, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("frame_", 0) == 0 && entry.path().extension() == ".png") {
      stills.push_back(entry.path());
    }
  }
  if (stills.empty()) return {};
  std::sort(stills.begin(), stills.end());
  const fs::path& middle = stills[stills.size() / 2];
  std::string bytes;
  const std::uint8_t* data = nullptr;
  try {
    bytes = readWholeFile(middle);
    data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    checkImageMemory(middle.string() + ": the image", data, bytes.size(), 3);
  } catch (const std::runtime_error&) {
    return {};  // a page without that picture is better than none
  }
  return cv::imdecode(
      cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<std::uint8_t*>(data)),
      cv::IMREAD_COLOR);
}

std::string worstRuns(const RunTable& table, const WorstRuns& worst) {
  std::vector<const RunRow*> runs;
  for (const RunRow& run : table.runs) {
    if (run.exit_code == 0 && std::isfinite(run.number(worst.column))) runs.push_back(&run);
  }
  std::stable_sort(runs.begin(), runs.end(), [&](const RunRow* a, const RunRow* b) {
    const double difference = a->number(worst.column) - b->number(worst.column);
    return worst.highest_first ? difference > 0.0 : difference < 0.0;
  });
  runs.resize(std::min(runs.size(), worst.count));
  std::string all;
  for (const RunRow* run : runs) {
    const std::string picture = pictureAddress(stillOf(run->results), 480);
    all += "<figure class=\"worst\">" +
           (picture.empty() ? "" : "<img alt=\"\" src=\"" + picture + "\"/>") + "<figcaption><b>" +
           escapedHtml(run->name) + "</b> " + shownNumber(run->number(worst.column), 3) +
           "<br/><code>" + escapedHtml(commandOf(*run)) + "</code></figcaption></figure>\n";
  }
  return all;
}

std::string rows(const RunTable& table) {
  std::string all;
  for (const RunRow& run : table.runs) {
    all += "<tr><th scope=\"row\">" + escapedHtml(run.name) + "</th><td>" +
           std::to_string(run.exit_code) + "</td>";
    for (const std::string& column : table.columns) {
      const auto field = run.fields.find(column);
      const auto* text =
          field == run.fields.end() ? nullptr : std::get_if<std::string>(&field->second);
      const double number = run.number(column);
      all += "<td>" +
             (text != nullptr                ? escapedHtml(*text)
              : std::isnan(number)           ? std::string()
              : number == std::round(number) ? shownNumber(number, 0)
                                             : shownNumber(number, 3)) +
             "</td>";
    }
    all += "</tr>\n";
  }
  return all;
}

std::string heads(const RunTable& table) {
  std::string all;
  for (const std::string& column : table.columns) {
    all += "<th scope=\"col\">" + escapedHtml(column) + "</th>";
  }
  return all;
}

}  // namespace

std::string summaryPage(const RunTable& table, const WorstRuns& worst) {
  const auto failed = std::count_if(table.runs.begin(), table.runs.end(),
                                    [](const RunRow& run) { return run.exit_code != 0; });
  const std::string by = worst.column.empty()
                             ? "Nothing to order them by."
                             : std::string(worst.highest_first ? "Most" : "Least") + " <code>" +
                                   escapedHtml(worst.column) + "</code> first.";
  return filledTemplate(assets::kSummaryHtml, {{"head", head("Summary · Heel")},
                                               {"scripts", scripts(assets::kHistogramsJs)},
                                               {"tiles", tiles(table)},
                                               {"failed", std::to_string(failed)},
                                               {"failures", failureRows(table)},
                                               {"histograms", histograms(table)},
                                               {"by", by},
                                               {"worst", worstRuns(table, worst)},
                                               {"columns", heads(table)},
                                               {"rows", rows(table)}});
}

}  // namespace heel
