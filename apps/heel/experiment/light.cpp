// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/light_experiment.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/results/result_files.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace heel {
namespace {

struct LightOptions {
  std::vector<std::filesystem::path> real;
  SimulatedRuns simulated{20};
  PerceptionTruthParams params;
  ExperimentParams real_params;
};

/// Recall and wrong-person share: exposure downwards, white balance across.
void print(const std::string& name, const LightRun& run) {
  std::printf("%s, %d frames with the target in view: recall (wrong person)\n", name.c_str(),
              run.front().frames_in_view);
  const std::vector<LightChange> changes = changesOfLight();
  std::printf("  red against blue ");
  for (std::size_t i = 0; i < 3; ++i)
    std::printf("  %+4.0f %%     ", 100.0 * changes[i].red_against_blue);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (i % 3 == 0) std::printf("\n  %+2.0f stops         ", changes[i].stops);
    std::printf("  %.2f (%.2f)", run[i].recall(), run[i].wrongPersonShare());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void writeFiles(const Output& output, const std::vector<std::pair<std::string, LightRun>>& runs) {
  CsvWriter csv(output / "light.csv", {"recordings", "stops", "red_against_blue", "frames_in_view",
                                       "recall", "wrong_person_share"});
  const std::vector<LightChange> changes = changesOfLight();
  for (const auto& [name, run] : runs) {
    for (std::size_t i = 0; i < run.size(); ++i) {
      csv.text(name)
          .number(changes[i].stops, 1)
          .number(changes[i].red_against_blue, 2)
          .integer(run[i].frames_in_view)
          .number(run[i].recall(), 4)
          .number(run[i].wrongPersonShare(), 4)
          .endRow();
    }
  }
  csv.close();
  writeJson(output / "summary.json", {{"complete", !isStopRequested()}, {"rows", 9 * runs.size()}});
}

void run(LightOptions& options) {
  std::optional<Output> output = experimentOutput("light", options.simulated.out, options.real);
  const auto count = static_cast<std::size_t>(options.simulated.recordings);
  ProgressBar progress("light", count + options.real.size());
  std::vector<std::pair<std::string, LightRun>> runs;
  LightRun sum;
  for (std::size_t i = 0; i < count && !isStopRequested(); ++i) {
    add(sum, runLightExperiment(options.simulated.seed + i, options.params));
    progress.show(i + 1);
  }
  if (!sum.empty()) {
    runs.emplace_back("simulated", sum);
    print(runs.back().first, sum);
  }
  for (std::size_t i = 0; i < options.real.size() && !isStopRequested(); ++i) {
    runs.emplace_back(options.real[i].filename().string(),
                      runLightExperiment(options.real[i], options.real_params));
    print(runs.back().first, runs.back().second);
    progress.show(count + i + 1);
  }
  if (runs.empty()) throw Stopped("stopped before the first run");
  if (output) writeFiles(*output, runs);
  endExperiment(output);
}

}  // namespace

void addLightExperiment(CLI::App& verb) {
  auto options = std::make_shared<LightOptions>();
  CLI::App* experiment = verb.add_subcommand(
      "light", "People learned in one light and looked for in another, simulated and real");
  experiment->footer("Example:\n  heel experiment light recordings/six_people --out out/light");
  experiment->add_option("RECORDING", options->real,
                         "folders with truth.csv, whose pictures are altered likewise");
  experiment
      ->add_option("--background", options->real_params.background_s,
                   "how long their rooms are empty at the beginning [s]")
      ->capture_default_str();
  addSimulatedRuns(*experiment, options->simulated, options->params.scenes);
  experiment->callback([options] { run(*options); });
}

}  // namespace heel
