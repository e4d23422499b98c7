// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/appearance_report.hpp>
#include <heel/apps/experiment/people_matrix_experiment.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

struct AppearanceOptions {
  int wardrobes = 20;
  std::uint64_t seed = 1;
  std::filesystem::path out;
  std::filesystem::path people;
  bool people_only = false;
  std::string models;
  std::string light;
  AppearanceExperimentParams params;
};

std::string counted(const Proportion& p) {
  return std::to_string(p.count) + " of " + std::to_string(p.total);
}

std::string withInterval(const Proportion& p) {
  const ShareInterval interval = wilsonInterval(p);
  char text[64];
  std::snprintf(text, sizeof text, "%d of %d (%.0f-%.0f %%)", p.count, p.total,
                100.0 * interval.low, 100.0 * interval.high);
  return text;
}

void printLaboratory(const WardrobeRuns& runs, double min_share) {
  std::printf("section 4.1: 5 people, 5 models, 5 other recordings, 25 runs\n");
  std::printf("  %-32s %-9s %-9s %-22s %s\n", "", "own", "FN", "FP", "target scored higher");
  std::printf("  %-32s %-9s %-9s %-22s %s\n", "the paper", "5 of 5", "0 of 5", "7 of 20 (3 of 12)",
              "in all cases");
  for (const AppearanceRow& row : appearanceTable({runs}, min_share)) {
    const Proportion& missed = row.all.false_negatives;
    const Proportion own{missed.total - missed.count, missed.total};
    const std::string fp =
        counted(row.all.false_positives) + " (" + counted(row.without_pair.false_positives) + ")";
    std::printf("  %-32s %-9s %-9s %-22s %s\n", row.name.c_str(), counted(own).c_str(),
                counted(missed).c_str(), fp.c_str(),
                row.pairs.total == 0 ? "-" : counted(row.pairs).c_str());
  }
  std::printf("  FP in brackets: without one of the pair in similar clothes\n");
}

void printRandom(const std::vector<WardrobeRuns>& runs, double min_share) {
  std::printf("%zu random wardrobes, each with one similar pair (95 %% intervals)\n", runs.size());
  std::printf("  %-32s %-21s %-23s %-23s %-9s %-9s %-14s %s\n", "", "FN", "FP",
              "FP without the pair", "no error", "w/o pair", "target higher", "identified");
  for (const AppearanceRow& row : appearanceTable(runs, min_share)) {
    std::printf("  %-32s %-21s %-23s %-23s %-9s %-9s %-14s %s\n", row.name.c_str(),
                withInterval(row.all.false_negatives).c_str(),
                withInterval(row.all.false_positives).c_str(),
                withInterval(row.without_pair.false_positives).c_str(), counted(row.clean).c_str(),
                counted(row.clean_without).c_str(),
                row.pairs.total == 0 ? "-" : counted(row.pairs).c_str(),
                counted(row.identified).c_str());
  }
}

/// The tables need all the runs: of some of them, nothing is written.
void endIfStopped() {
  if (isStopRequested()) throw Stopped("stopped: nothing is written");
}

/// Each real person's model against all of them.
void runPeople(const AppearanceOptions& options, const std::optional<Output>& output) {
  ProgressBar progress("people", 100);
  WardrobeRuns runs;
  runs.models =
      runPeopleMatrixExperiment(options.people, options.params.models, {}, [&](double share) {
        endIfStopped();
        progress.show(static_cast<std::size_t>(100.0 * share));
      });
  const double min_share = options.params.min_share;
  std::printf("%s: %zu people, each model against everyone\n",
              options.people.filename().string().c_str(), runs.models.front().matrix.size());
  for (const AppearanceRow& row : appearanceTable({runs}, min_share)) {
    std::printf("  %-32s FN %-10s FP %s\n", row.name.c_str(),
                counted(row.all.false_negatives).c_str(), counted(row.all.false_positives).c_str());
  }
  if (output) writeAppearanceFiles(*output, "people", {runs}, min_share);
}

void runSimulated(const AppearanceOptions& options, const std::optional<Output>& output) {
  constexpr std::size_t kSteps = 100;
  const auto all = static_cast<std::size_t>(options.wardrobes) + 1;
  ProgressBar progress("appearance", kSteps * all);
  std::vector<WardrobeRuns> results;
  for (std::size_t i = 0; i < all; ++i) {
    const Wardrobe wardrobe = i == 0 ? laboratoryWardrobe() : randomWardrobe(options.seed + i - 1);
    results.push_back(runAppearanceExperiment(wardrobe, options.params, [&](double share) {
      endIfStopped();
      progress.show(kSteps * i + static_cast<std::size_t>(kSteps * share));
    }));
  }
  const std::vector<WardrobeRuns> random(results.begin() + 1, results.end());
  printLaboratory(results.front(), options.params.min_share);
  if (!random.empty()) printRandom(random, options.params.min_share);
  if (!output) return;
  writeAppearanceFiles(*output, "laboratory", {results.front()}, options.params.min_share);
  if (!random.empty()) writeAppearanceFiles(*output, "random", random, options.params.min_share);
}

void keepModels(std::vector<OfferedModel>& models, const std::string& text) {
  models.erase(std::remove_if(models.begin(), models.end(),
                              [&](const OfferedModel& model) {
                                return model.name.find(text) == std::string::npos;
                              }),
               models.end());
  if (models.empty()) throw std::invalid_argument("no model's name holds '" + text + "'");
}

void run(AppearanceOptions& options) {
  keepModels(options.params.models, options.models);
  options.params.drawn_light = options.light == "drawn";
  std::optional<Output> output = experimentOutput("appearance", options.out, {options.people});
  if (!options.people_only) runSimulated(options, output);
  if (!options.people.empty()) runPeople(options, output);
  endExperiment(output);
}

}  // namespace

void addAppearanceExperiment(CLI::App& verb) {
  auto options = std::make_shared<AppearanceOptions>();
  options->params.scenes = sceneFolder();
  CLI::App* experiment = verb.add_subcommand(
      "appearance", "Who is detected with whose model: the paper's section 4.1, in simulation");
  experiment->footer("Example:\n  heel experiment appearance --out out/appearance");
  experiment->add_option("--wardrobes", options->wardrobes, "random wardrobes besides the paper's")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  experiment->add_option("--seed", options->seed, "of the first random wardrobe")
      ->capture_default_str();
  experiment
      ->add_option("--min-share", options->params.min_share,
                   "followed in so much of the time in view is detected")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  CLI::Option* people = experiment->add_option(
      "--people", options->people,
      "then the same on a recording of real people, empty at first, with truth.csv");
  experiment->add_flag("--people-only", options->people_only, "leave the simulation out")
      ->needs(people);
  experiment->add_option("--models", options->models,
                         "only models whose names, as the tables have them, hold this text");
  addLight(*experiment, options->light);
  experiment->add_option("--out", options->out, "folder for tables and pictures");
  experiment->callback([options] { run(*options); });
}

}  // namespace heel
