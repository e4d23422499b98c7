// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/gate_experiment.hpp>
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
#include <vector>

namespace heel {
namespace {

struct GateOptions {
  SimulatedRuns simulated{10};
  GateExperimentParams params;
};

/// Of all recordings.
struct Sum {
  double right_s = 0.0, wrong_s = 0.0, duration_s = 0.0;
  int worse_than_1s = 0;  ///< Recordings with more than a second on something wrong.

  void add(const GateOutcome& outcome) {
    right_s += outcome.right_target_s;
    wrong_s += outcome.wrong_target_s;
    duration_s += outcome.target.duration_s;
    worse_than_1s += outcome.wrong_target_s > 1.0 ? 1 : 0;
  }
  void print(const char* name) const {
    std::printf(
        "  gate %-4s target followed %.1f s, something else %.1f s of %.1f s; more than a "
        "second of that in %d recordings\n",
        name, right_s, wrong_s, duration_s, worse_than_1s);
  }
  nlohmann::ordered_json toJson() const {
    return {{"right_target_s", right_s},
            {"wrong_target_s", wrong_s},
            {"duration_s", duration_s},
            {"recordings_over_1s_wrong", worse_than_1s}};
  }
};

void writeFiles(const Output& output, const std::vector<GateRun>& runs, const Sum& with,
                const Sum& without) {
  CsvWriter csv(output / "gate.csv", {"seed", "gate", "right_target_s", "wrong_target_s",
                                      "frames_in_view", "recall", "duration_s"});
  for (const GateRun& run : runs) {
    for (const bool gated : {true, false}) {
      const GateOutcome& outcome = gated ? run.with_gate : run.without_gate;
      csv.integer(static_cast<std::int64_t>(run.seed))
          .flag(gated)
          .number(outcome.right_target_s, 2)
          .number(outcome.wrong_target_s, 2)
          .integer(outcome.target.frames_in_view)
          .number(outcome.target.recall(), 4)
          .number(outcome.target.duration_s, 2)
          .endRow();
    }
  }
  csv.close();
  writeJson(output / "summary.json", {{"complete", !isStopRequested()},
                                      {"recordings", runs.size()},
                                      {"with_gate", with.toJson()},
                                      {"without_gate", without.toJson()}});
}

void run(GateOptions& options) {
  std::optional<Output> output = experimentOutput("gate", options.simulated.out);
  const auto count = static_cast<std::size_t>(options.simulated.recordings);
  ProgressBar progress("gate", count);
  std::vector<GateRun> runs;
  Sum with, without;
  for (std::size_t i = 0; i < count && !isStopRequested(); ++i) {
    runs.push_back(runGateExperiment(options.simulated.seed + i, options.params));
    with.add(runs.back().with_gate);
    without.add(runs.back().without_gate);
    progress.show(i + 1);
  }
  std::printf("a target among posters and a coat of the same colour, %zu recordings\n",
              runs.size());
  with.print("on:");
  without.print("off:");
  if (output) writeFiles(*output, runs, with, without);
  endExperiment(output);
}

}  // namespace

void addGateExperiment(CLI::App& verb) {
  auto options = std::make_shared<GateOptions>();
  CLI::App* experiment = verb.add_subcommand(
      "gate", "What the map's walls are good for: a target among posters of the same colour");
  experiment->footer("Example:\n  heel experiment gate --out out/gate");
  addSimulatedRuns(*experiment, options->simulated, options->params.scenes);
  experiment->callback([options] { run(*options); });
}

}  // namespace heel
