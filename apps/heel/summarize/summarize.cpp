// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/sqlite_file.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/output/output.hpp>
#include <heel/apps/pages/pages.hpp>
#include <heel/apps/results/run_table.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace heel {
namespace {

struct SummarizeOptions {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path out;
  std::string by;
};

/// What tells the quality of a run, the first of them that the runs have; and whether much is bad.
constexpr std::array<std::pair<const char*, bool>, 3> kQualities = {
    {{"evaluation.target.right_answer_share", false},
     {"wrong_person_s", true},
     {"frames_with_target", false}}};

WorstRuns worstBy(const RunTable& table, const std::string& by) {
  const std::vector<std::string> figures = table.figures();
  const auto isThere = [&figures](const std::string& column) {
    return std::find(figures.begin(), figures.end(), column) != figures.end();
  };
  WorstRuns worst;
  if (by.empty()) {
    for (const auto& [column, highest_first] : kQualities) {
      if (!isThere(column)) continue;
      worst.column = column;
      worst.highest_first = highest_first;
      break;
    }
    return worst;
  }
  worst.highest_first = by.front() != '+';
  worst.column = worst.highest_first ? by : by.substr(1);
  if (!isThere(worst.column)) {
    throw std::invalid_argument("--worst: there is no figure '" + worst.column +
                                "' that differs among the runs");
  }
  return worst;
}

std::string quotedName(const std::string& name) {
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

void insertRuns(SqliteFile& database, const RunTable& table, const std::string& places) {
  SqliteQuery insert = database.query("INSERT INTO runs VALUES (" + places + ")");
  for (const RunRow& run : table.runs) {
    insert.reset();
    insert.bind(1, run.name).bind(2, std::int64_t{run.exit_code}).bind(3, run.reason);
    int place = 4;
    for (const std::string& column : table.columns) {
      const auto field = run.fields.find(column);
      if (field == run.fields.end()) {
        insert.bindNull(place++);
      } else if (const auto* text = std::get_if<std::string>(&field->second)) {
        insert.bind(place++, *text);
      } else {
        insert.bind(place++, std::get<double>(field->second));
      }
    }
    insert.run();
  }
}

/// The same as summary.csv, where numbers are numbers.
void writeDatabase(const OutputPath& file, const RunTable& table) {
  writeWith(file, [&table](const std::filesystem::path& path) {
    SqliteFile database(path, SqliteFile::Use::kCreate);
    std::string columns = "\"name\" TEXT, \"exit\" INTEGER, \"reason\" TEXT";
    std::string places = "?, ?, ?";
    for (const std::string& column : table.columns) {
      columns += ", " + quotedName(column);
      places += ", ?";
    }
    database.run("BEGIN");
    database.run("CREATE TABLE runs (" + columns + ")");
    insertRuns(database, table, places);
    database.run("COMMIT");
    database.close();
  });
}

void print(const RunTable& table) {
  const auto failed = std::count_if(table.runs.begin(), table.runs.end(),
                                    [](const RunRow& run) { return run.exit_code != 0; });
  const double cpu_s =
      std::accumulate(table.runs.begin(), table.runs.end(), 0.0,
                      [](double sum, const RunRow& run) { return sum + run.cpu_s; });
  std::printf("%zu runs, %zu of them failed; %.2f hours of a processor\n", table.runs.size(),
              static_cast<std::size_t>(failed), cpu_s / 3600.0);
  for (const RunRow& run : table.runs) {
    if (run.exit_code == 0) continue;
    std::printf("  %s: exit code %d, %s\n", run.name.c_str(), run.exit_code, run.reason.c_str());
  }
}

void run(const SummarizeOptions& options) {
  const RunTable table = readRuns(options.folders);
  const WorstRuns worst = worstBy(table, options.by);
  Output output({"summarize",
                 OutputKind::kFolder,
                 options.out,
                 options.folders,
                 {"summary.html", "summary.csv", "summary.db", "machine.csv"}});
  writeRunsCsv(output / "summary.csv", table);
  writeMachineCsv(output / "machine.csv", table);
  writeDatabase(output / "summary.db", table);
  writeFile(output / "summary.html", summaryPage(table, worst));
  output.commit();
  print(table);
  std::printf("wrote %s: summary.html summary.csv summary.db machine.csv\n", output.path().c_str());
}

}  // namespace

void addSummarize(CLI::App& app) {
  auto options = std::make_shared<SummarizeOptions>();
  CLI::App* verb = app.add_subcommand("summarize", "Make one table and one page of many results");
  verb->footer(
      "Example:\n"
      "  heel summarize out/track --out out/summary\n"
      "A FOLDER holds the results of many runs: NAME/summary.json, and beside it, if they are\n"
      "there, NAME.evaluation.json, as 'heel evaluate --out' writes it, and NAME.json with\n"
      "\"exit\" and \"reason\" of a run that failed. Writes summary.html, summary.csv, summary.db\n"
      "(SQLite, the table 'runs'), and machine.csv: what each run took.");
  verb->add_option("FOLDER", options->folders, "folders with results")->required();
  verb->add_option("--worst", options->by,
                   "the figure that tells the worst runs: those with the most of it; with a '+' "
                   "before it, with the least (default: the share of right answers, the time with "
                   "a wrong person, or the frames with a target)");
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->callback([options] { run(*options); });
}

}  // namespace heel
