// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/appearance_experiment.hpp>
#include <heel/apps/experiment/appearance_report.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/experiment/joined_parts.hpp>
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
#include <utility>
#include <vector>

namespace heel {
namespace {

constexpr const char* kLaboratory = "laboratory";
constexpr const char* kRandom = "random";

struct AppearanceOptions {
  int wardrobes = 20;
  std::uint64_t seed = 1;
  std::filesystem::path out;
  bool laboratory = true;
  std::vector<std::filesystem::path> join;
  std::string models;
  std::string light;
  AppearanceExperimentParams params;
};

std::string counted(const Proportion& p) {
  return std::to_string(p.count) + " of " + std::to_string(p.total);
}

void printLaboratory(const WardrobeRuns& runs) {
  std::printf("section 4.1: 5 people, 5 models, 5 other recordings, 25 runs\n");
  std::printf("  %-32s %-9s %-9s %-22s %s\n", "", "own", "FN", "FP", "target scored higher");
  std::printf("  %-32s %-9s %-9s %-22s %s\n", "the paper", "5 of 5", "0 of 5", "7 of 20 (3 of 12)",
              "in all cases");
  for (const AppearanceRow& row : appearanceTable({runs})) {
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

void printRandom(const std::vector<WardrobeRuns>& runs) {
  std::printf("%zu random wardrobes, each with one similar pair (95 %% intervals)\n", runs.size());
  std::printf("  %-32s %-21s %-23s %-23s %-9s %-9s %-14s %s\n", "", "FN", "FP",
              "FP without the pair", "no error", "w/o pair", "target higher", "identified");
  for (const AppearanceRow& row : appearanceTable(runs)) {
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

/// The laboratory's wardrobe and the random ones, or what is wanted of them.
struct SimulatedResults {
  std::vector<WardrobeRuns> laboratory, random;
};

SimulatedResults runSimulated(const AppearanceOptions& options) {
  constexpr std::size_t kSteps = 100;
  const auto random = static_cast<std::size_t>(options.wardrobes);
  ProgressBar progress("appearance", kSteps * (random + (options.laboratory ? 1 : 0)));
  std::size_t done = 0;
  const auto runOf = [&](const Wardrobe& wardrobe) {
    const auto shown = [&](double share) {
      endIfStopped();
      progress.show(done + static_cast<std::size_t>(kSteps * share));
    };
    WardrobeRuns runs = runAppearanceExperiment(wardrobe, options.params, shown);
    done += kSteps;
    return runs;
  };
  SimulatedResults results;
  if (options.laboratory) results.laboratory.push_back(runOf(laboratoryWardrobe()));
  for (std::size_t i = 0; i < random; ++i) {
    results.random.push_back(runOf(randomWardrobe(options.seed + i)));
  }
  return results;
}

bool hasSameModels(const WardrobeRuns& a, const WardrobeRuns& b) {
  return std::equal(a.models.begin(), a.models.end(), b.models.begin(), b.models.end(),
                    [](const ModelRuns& x, const ModelRuns& y) { return x.model == y.model; });
}

/// Those of other calls, in the order of their seeds.
SimulatedResults joinedWardrobes(const std::vector<std::filesystem::path>& parts) {
  SimulatedResults results;
  const auto add = [](const std::filesystem::path& tables, std::vector<WardrobeRuns>& to) {
    if (!std::filesystem::exists(tables)) return;
    for (WardrobeRuns& runs : readAppearanceTables(tables)) {
      if (!to.empty() && !hasSameModels(runs, to.front())) {
        throw std::runtime_error(tables.string() +
                                 ": was made with other models than the first part");
      }
      to.push_back(std::move(runs));
    }
  };
  for (const std::filesystem::path& part : parts) {
    add(part / kLaboratory, results.laboratory);
    add(part / kRandom, results.random);
  }
  if (results.laboratory.empty() && results.random.empty()) {
    throw std::runtime_error("--join: no part holds a wardrobe");
  }
  sortBySeed(results.laboratory);
  sortBySeed(results.random);
  return results;
}

void show(const SimulatedResults& results, const std::optional<Output>& output) {
  if (!results.laboratory.empty()) printLaboratory(results.laboratory.front());
  if (!results.random.empty()) printRandom(results.random);
  if (!output) return;
  writeAppearanceFiles(*output, kLaboratory, results.laboratory);
  writeAppearanceFiles(*output, kRandom, results.random);
}

/// What all runs share, as options.
std::string sharedBy(const AppearanceOptions& options) {
  std::string shared;
  if (!options.models.empty()) shared += " --models " + options.models;
  if (!options.light.empty()) shared += " --light " + options.light;
  return shared;
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
  const bool is_joined = !options.join.empty();
  if (!is_joined && !options.laboratory && options.wardrobes == 0) {
    throw std::invalid_argument("--no-laboratory, and --wardrobes 0: nothing is left to do");
  }
  std::optional<Output> output = experimentOutput("appearance", options.out, options.join);
  const std::string shared = sharedBy(options);
  if (is_joined && sharedOptions(options.join) != shared) {
    throw std::invalid_argument("the parts were made with other options (" +
                                sharedOptions(options.join) + ") than these (" + shared + ")");
  }
  const SimulatedResults results =
      is_joined ? joinedWardrobes(options.join) : runSimulated(options);
  show(results, output);
  if (output) writePartSummary(*output, shared, results.laboratory.size() + results.random.size());
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
  experiment->add_flag_callback(
      "--no-laboratory", [options] { options->laboratory = false; },
      "leave out the paper's wardrobe: the random ones only");
  experiment->add_option("--seed", options->seed, "of the first random wardrobe")
      ->capture_default_str();
  experiment->add_option("--models", options->models,
                         "only models whose names, as the tables have them, hold this text");
  addLight(*experiment, options->light);
  experiment
      ->add_option("--join", options->join,
                   "make no runs: join the results of other calls, with other seeds, to one")
      ->option_text("FOLDER...");
  experiment->add_option("--out", options->out, "folder for tables and pictures");
  experiment->callback([options] { run(*options); });
}

}  // namespace heel
