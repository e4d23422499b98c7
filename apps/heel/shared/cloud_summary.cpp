// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/cloud_summary.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/results/result_files.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> columnsWith(const std::vector<std::string>& own) {
  std::vector<std::string> columns = {"file",      "outcome",   "format",    "encoding",
                                      "organized", "width",     "height",    "fields",
                                      "color",     "points_in", "with_place"};
  columns.insert(columns.end(), own.begin(), own.end());
  columns.push_back("reason");
  return columns;
}

}  // namespace

CloudSummary::CloudSummary(const Output& output, const std::vector<std::string>& columns)
    : csv_(output / "summary.csv", columnsWith(columns)), json_(output / "summary.json") {}

void CloudSummary::add(const std::filesystem::path& file, const CloudFate& fate,
                       const std::function<void(CsvWriter&)>& addFields) {
  ++files_;
  ++outcomes_[fate.outcome];
  const CloudFacts& facts = fate.facts;
  const bool is_known = facts.width > 0;
  csv_.text(file.string()).text(fate.outcome).text(facts.format);
  if (is_known) {
    csv_.text(toText(facts.encoding)).flag(facts.isOrganized());
    csv_.integer(static_cast<std::int64_t>(facts.width));
    csv_.integer(static_cast<std::int64_t>(facts.height));
    csv_.text(facts.fields).text(facts.color_field.empty() ? "none" : facts.color_field);
    csv_.integer(static_cast<std::int64_t>(facts.points()));
    csv_.integer(static_cast<std::int64_t>(facts.finite_points));
  } else {
    for (int i = 0; i < 8; ++i) csv_.text("");
  }
  addFields(csv_);
  csv_.text(fate.reason).endRow();
  if (!fate.reason.empty()) {
    reasons_.push_back(
        {{"file", file.string()}, {"outcome", fate.outcome}, {"reason", fate.reason}});
  }
}

std::size_t CloudSummary::count(const std::string& outcome) const {
  const auto found = outcomes_.find(outcome);
  return found == outcomes_.end() ? 0 : found->second;
}

std::string CloudSummary::outcomes() const {
  std::vector<std::pair<std::string, std::size_t>> sorted(outcomes_.begin(), outcomes_.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [outcome, count] : sorted) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + outcome;
  }
  return text;
}

void CloudSummary::close(const nlohmann::ordered_json& more) {
  nlohmann::ordered_json json = {
      {"complete", count(CloudFate::kStopped) == 0}, {"files", files_}, {"outcomes", outcomes_}};
  json.update(more);
  json["reasons"] = reasons_;
  csv_.close();
  writeJson(json_, json);
}

std::string toText(const CloudFacts& facts) {
  const double share =
      static_cast<double>(facts.finite_points) / static_cast<double>(facts.points());
  return facts.format + " " + toText(facts.encoding) + ", " +
         (facts.isOrganized()
              ? "organized " + std::to_string(facts.width) + "x" + std::to_string(facts.height)
              : "not organized") +
         ", " + (facts.color_field.empty() ? "no colour" : "colour in " + facts.color_field) +
         ", fields " + facts.fields + "; " + std::to_string(facts.points()) + " points, " +
         fixedText(100.0 * (1.0 - share), 1) + " % of them NaN";
}

void addCloudBatch(CLI::App& verb, CloudBatch& batch, const std::string& inputs) {
  verb.add_option("IN", batch.names, inputs)->required();
  verb.add_option("--threads", batch.threads, "how many clouds at once; 0: as many as cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

std::vector<std::string> resultNames(const std::vector<fs::path>& clouds,
                                     const std::string& ending) {
  std::set<std::string> taken;
  std::vector<std::string> results;
  for (const fs::path& cloud : clouds) {
    std::string result = cloud.filename().string() + ending;
    if (!taken.insert(result).second) {
      throw std::invalid_argument(cloud.string() + ": another cloud's result has the same name, " +
                                  result);
    }
    results.push_back(std::move(result));
  }
  return results;
}

void tellFailures(const std::vector<std::string>& failures, std::size_t clouds,
                  std::size_t stopped) {
  for (const std::string& why : failures) tell(why);
  const std::string of = " of " + std::to_string(clouds) + " clouds ";
  if (stopped > 0) throw Stopped("stopped: " + std::to_string(stopped) + of + "are not done");
  if (failures.empty()) return;
  throw std::runtime_error(std::to_string(failures.size()) + of + "failed; the others are done");
}

}  // namespace heel
