// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/results/run_table.hpp>
#include <heel/cloud/files.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace heel {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kSummary = "summary.json";
constexpr const char* kEvaluation = ".evaluation";
constexpr int kMostDepth = 8;  // of objects in objects

constexpr std::size_t kMostColumns = 1900;  // SQLite takes 2,000

/// Columns in the order in which they are first met. Databases do not tell capitals apart: of two
/// names that differ in nothing else, as of those that each run has anyway, the second is left out.
struct Columns {
  std::vector<std::string> names;
  std::map<std::string, std::string> known = {{"name", ""}, {"exit", ""}, {"reason", ""}};
  bool add(const std::string& name) {
    if (name.find('\0') != std::string::npos || names.size() == kMostColumns) return false;
    std::string folded = name;
    for (char& c : folded) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto [place, is_new] = known.emplace(folded, name);
    if (is_new) names.push_back(name);
    return place->second == name;
  }
};

ordered_json readObject(const fs::path& file) {
  ordered_json value = ordered_json::parse(readWholeFile(file), nullptr, false);
  if (!value.is_object()) throw std::runtime_error(file.string() + ": is no JSON object");
  return value;
}

void addFields(const ordered_json& object, const std::string& prefix, RunRow& run, Columns& columns,
               int depth = 0) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    if (value.is_object() && depth < kMostDepth) {
      addFields(value, name + ".", run, columns, depth + 1);
      continue;
    }
    RunField field;
    if (value.is_boolean()) field = value.get<bool>() ? 1.0 : 0.0;
    if (value.is_number()) field = value.get<double>();
    if (value.is_array()) field = static_cast<double>(value.size());
    if (value.is_string()) field = value.get<std::string>();
    if (value.is_null() || value.is_object()) continue;
    if (columns.add(name)) run.fields[name] = field;
  }
}

template <typename T>
T valueOf(const ordered_json& object, const char* key, T otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  try {
    return found->template get<T>();
  } catch (const ordered_json::exception&) {
    return otherwise;
  }
}

/// A run's parts, as far as they are there.
struct Parts {
  fs::path results, fate, evaluation;
};

void addFate(const fs::path& file, RunRow& run) {
  const ordered_json fate = readObject(file);
  const auto code = fate.find("exit");
  if (code == fate.end() || !code->is_number_integer()) {
    throw std::runtime_error(file.string() + ": has no whole number 'exit'");
  }
  run.exit_code = code->get<int>();
  run.reason = valueOf(fate, "reason", run.reason);
  run.call = valueOf(fate, "call", run.call);
}

void addResults(const fs::path& folder, RunRow& run, Columns& columns) {
  const ordered_json summary = readObject(folder / kSummary);
  addFields(summary, "", run, columns);
  if (!valueOf(summary, "complete", true)) {
    run.exit_code = static_cast<int>(ExitCode::kStopped);
    run.reason = "it was stopped before its end";
  }
  const ordered_json facts = ordered_json::parse(factsAt(folder), nullptr, false);
  if (!facts.is_object()) return;
  run.call = valueOf(facts, "call", run.call);
  run.host = valueOf(facts, "host", run.host);
  run.wall_s = valueOf(facts, "wall_s", run.wall_s);
  run.cpu_s = valueOf(facts, "cpu_s", run.cpu_s);
  run.peak_memory_mib = valueOf(facts, "peak_memory_mib", run.peak_memory_mib);
}

RunRow readRun(const std::string& name, const Parts& parts, Columns& columns) {
  RunRow run;
  run.name = name;
  run.results = parts.results;
  try {
    if (!parts.results.empty()) addResults(parts.results, run, columns);
    if (!parts.fate.empty()) addFate(parts.fate, run);
    if (!parts.evaluation.empty()) {
      addFields(readObject(parts.evaluation), "evaluation.", run, columns);
    }
  } catch (const std::runtime_error& error) {
    run.exit_code = static_cast<int>(ExitCode::kBadInput);
    run.reason = error.what();
  }
  return run;
}

/// What lies in a folder, by the runs' names.
std::map<std::string, Parts> partsIn(const fs::path& folder) {
  std::map<std::string, Parts> runs;
  std::error_code unreadable;
  if (fs::exists(folder / kSummary, unreadable)) {
    const fs::path full = fs::weakly_canonical(folder);
    runs[full.filename().string()].results = folder;
    return runs;
  }
  std::error_code error, ignored;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path path = entry.path();
    if (path.filename().string().front() == '.') continue;  // a run that goes on
    if (fs::is_directory(path, ignored)) {
      if (fs::exists(path / kSummary, ignored)) runs[path.filename().string()].results = path;
    } else if (path.extension() == ".json") {
      const fs::path name = path.stem();
      const bool is_evaluation = name.extension() == kEvaluation;
      Parts& run = runs[is_evaluation ? name.stem().string() : name.string()];
      (is_evaluation ? run.evaluation : run.fate) = path;
    }
  }
  if (error) throw std::runtime_error(folder.string() + ": cannot be read: " + error.message());
  if (runs.empty()) throw std::runtime_error(folder.string() + ": holds no results of runs");
  return runs;
}

std::string textOf(const RunField& field) {
  if (const auto* text = std::get_if<std::string>(&field)) return *text;
  return ordered_json(std::get<double>(field)).dump();  // the shortest that reads the same
}

}  // namespace

double RunRow::number(const std::string& column) const {
  const auto field = fields.find(column);
  const auto* value = field == fields.end() ? nullptr : std::get_if<double>(&field->second);
  return value == nullptr ? std::numeric_limits<double>::quiet_NaN() : *value;
}

std::vector<std::string> RunTable::figures() const {
  std::vector<std::string> figures;
  for (const std::string& column : columns) {
    std::set<double> values;
    for (const RunRow& run : runs) {
      if (const double value = run.number(column); std::isfinite(value)) values.insert(value);
    }
    if (values.size() > 1) figures.push_back(column);
  }
  return figures;
}

RunTable readRuns(const std::vector<fs::path>& folders) {
  RunTable table;
  Columns columns;
  for (const fs::path& folder : folders) {
    for (const auto& [name, parts] : partsIn(folder)) {
      table.runs.push_back(readRun(name, parts, columns));
    }
  }
  std::stable_sort(table.runs.begin(), table.runs.end(),
                   [](const RunRow& a, const RunRow& b) { return a.name < b.name; });
  table.columns = std::move(columns.names);
  return table;
}

void writeRunsCsv(const OutputPath& file, const RunTable& table) {
  std::vector<std::string> names = {"name", "exit", "reason"};
  names.insert(names.end(), table.columns.begin(), table.columns.end());
  CsvWriter csv(file, names);
  for (const RunRow& run : table.runs) {
    csv.text(run.name).integer(run.exit_code).text(run.reason);
    for (const std::string& column : table.columns) {
      const auto field = run.fields.find(column);
      csv.text(field == run.fields.end() ? "" : textOf(field->second));
    }
    csv.endRow();
  }
  csv.close();
}

void writeMachineCsv(const OutputPath& file, const RunTable& table) {
  CsvWriter csv(file, {"name", "host", "wall_s", "cpu_s", "peak_memory_mib"});
  for (const RunRow& run : table.runs) {
    csv.text(run.name).text(run.host).number(run.wall_s, 2).number(run.cpu_s, 2);
    csv.number(run.peak_memory_mib, 2).endRow();
  }
  csv.close();
}

}  // namespace heel
