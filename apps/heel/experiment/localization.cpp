// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/localization_experiment.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/results/result_files.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {
namespace {

struct LocalizationOptions {
  std::size_t tracking = 10, global = 100, kidnapped = 50;
  std::uint64_t seed = 1;
  std::filesystem::path out;
};

using Runs = std::vector<LocalizationRun>;
using RunOne = LocalizationRun (*)(const Scene&, std::uint64_t);

Runs runAll(const char* title, std::size_t count, RunOne one, const Scene& scene,
            const LocalizationOptions& options) {
  ProgressBar progress(title, count);
  Runs runs;
  for (std::size_t i = 0; i < count && !isStopRequested(); ++i) {
    runs.push_back(one(scene, options.seed + i));
    progress.show(i + 1);
  }
  return runs;
}

template <typename Value>
double meanOf(const Runs& runs, Value value) {
  double sum = 0.0;
  for (const LocalizationRun& run : runs) sum += value(run);
  return sum / static_cast<double>(runs.size());
}

/// The middle and the last of the times that are there; NaN if none is.
std::pair<double, double> timesOf(const Runs& runs, std::optional<double> LocalizationRun::*time) {
  std::vector<double> times;
  for (const LocalizationRun& run : runs) {
    if (run.*time) times.push_back(*(run.*time));
  }
  if (times.empty()) return {std::nan(""), std::nan("")};
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.back()};
}

nlohmann::ordered_json summaryOf(const Runs& runs) {
  const auto count = [&](auto is) { return std::count_if(runs.begin(), runs.end(), is); };
  const auto [right, last_right] = timesOf(runs, &LocalizationRun::right_s);
  const auto [noticed, last_noticed] = timesOf(runs, &LocalizationRun::noticed_s);
  const double square_m = meanOf(runs, [](const auto& r) { return r.rms_m * r.rms_m; });
  const double square_rad = meanOf(runs, [](const auto& r) { return r.rms_rad * r.rms_rad; });
  return {{"runs", runs.size()},
          {"rms_m", std::sqrt(square_m)},
          {"rms_deg", std::sqrt(square_rad) * kDegrees},
          {"lost_share", meanOf(runs, [](const auto& r) { return r.lost_share; })},
          {"wrong_share", meanOf(runs, [](const auto& r) { return r.wrong_share; })},
          {"consistency", meanOf(runs, [](const auto& r) { return r.consistency; })},
          {"mean_particles", meanOf(runs, [](const auto& r) { return r.mean_particles; })},
          {"right_at_end", count([](const auto& r) { return r.right_s.has_value(); })},
          {"right_median_s", right},
          {"right_last_s", last_right},
          {"noticed", count([](const auto& r) { return r.noticed_s.has_value(); })},
          {"noticed_median_s", noticed},
          {"noticed_last_s", last_noticed}};
}

void print(const char* title, const nlohmann::ordered_json& s) {
  std::printf("%s\n", title);
  for (const auto& [key, value] : s.items()) {
    std::printf("  %-18s %.4g\n", key.c_str(),
                value.is_null() ? std::nan("") : value.get<double>());
  }
}

void addRows(CsvWriter& csv, const char* kind, const Runs& runs) {
  const double none = std::nan("");
  for (const LocalizationRun& run : runs) {
    csv.text(kind)
        .integer(static_cast<std::int64_t>(run.seed))
        .number(run.duration_s, 1)
        .number(run.way_m, 2)
        .number(run.rms_m, 4)
        .number(run.rms_rad * kDegrees, 3)
        .number(run.worst_m, 3)
        .number(run.lost_share, 4)
        .number(run.wrong_share, 4)
        .number(run.consistency, 2)
        .number(run.mean_particles, 0)
        .number(run.noticed_s.value_or(none), 1)
        .number(run.right_s.value_or(none), 1)
        .endRow();
  }
}

void run(const LocalizationOptions& options) {
  std::optional<Output> output = experimentOutput("localization", options.out);
  const Scene scene = loadScene(sceneFolder() / "home.yaml");
  const Runs tracking = runAll("tracking", options.tracking, runTracking, scene, options);
  const Runs global = runAll("global start", options.global, runGlobalStart, scene, options);
  const Runs kidnapped = runAll("kidnapped", options.kidnapped, runKidnapped, scene, options);
  nlohmann::ordered_json summary;
  summary["complete"] = !isStopRequested();
  const auto add = [&](const char* name, const Runs& runs) {
    if (runs.empty()) return;
    summary[name] = summaryOf(runs);
    print(name, summary[name]);
  };
  add("tracking", tracking);
  add("global_start", global);
  add("kidnapped", kidnapped);
  if (!output) return endExperiment(output);
  CsvWriter csv(*output / "runs.csv",
                {"kind", "seed", "duration_s", "way_m", "rms_m", "rms_deg", "worst_m", "lost_share",
                 "wrong_share", "consistency", "mean_particles", "noticed_s", "right_s"});
  addRows(csv, "tracking", tracking);
  addRows(csv, "global_start", global);
  addRows(csv, "kidnapped", kidnapped);
  csv.close();
  writeJson(*output / "summary.json", summary);
  endExperiment(output);
}

}  // namespace

void addLocalizationExperiment(CLI::App& verb) {
  auto options = std::make_shared<LocalizationOptions>();
  CLI::App* experiment = verb.add_subcommand(
      "localization", "Localization against exact truth, in a simulated flat with people in it");
  experiment->footer("Example:\n  heel experiment localization --out out/localization");
  experiment->add_option("--tracking", options->tracking, "runs from a known start")
      ->capture_default_str();
  experiment->add_option("--global", options->global, "runs from anywhere")->capture_default_str();
  experiment->add_option("--kidnapped", options->kidnapped, "runs with a robot that is carried off")
      ->capture_default_str();
  experiment->add_option("--seed", options->seed, "of the first run")->capture_default_str();
  experiment->add_option("--out", options->out, "folder for tables");
  experiment->callback([options] { run(*options); });
}

}  // namespace heel
