// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/perception_truth_experiment.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/results/result_files.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

namespace heel {
namespace {

struct PerceptionExperimentOptions {
  SimulatedRuns simulated{50};
  PerceptionTruthParams params;
};

void printRow(const char* name, const std::vector<PerceptionTruthRun>& runs) {
  if (runs.empty()) return;
  const PerceptionTruthRun sum = sumOf(runs);
  std::printf("%s, %zu recordings, %d frames with the target in view\n", name, runs.size(),
              sum.target.frames_in_view);
  std::printf("  colour filter:    pixel precision %.3f, recall %.3f\n", sum.filter.precision(),
              sum.filter.recall());
  std::printf("  + depth, height:  pixel precision %.3f, recall %.3f\n", sum.standing.precision(),
              sum.standing.recall());
  std::printf("  target: recall %.3f, wrong person %.3f, wrong target %.1f s of %.1f s\n",
              sum.target.recall(), sum.target.wrongPersonShare(), sum.target.wrong_target_s,
              sum.target.duration_s);
  std::printf("  place:  mean error %.3f m\n", sum.target.meanError_m());
  std::printf("  CLEAR MOT: MOTA %.3f, MOTP %.3f m, %d misses, %d false, %d switches\n",
              sum.mot.mota(), sum.mot.motp_m(), sum.mot.misses, sum.mot.false_positives,
              sum.mot.mismatches);
}

nlohmann::ordered_json toJson(const PerceptionTruthRun& run) {
  return {{"filter_precision", run.filter.precision()},
          {"filter_recall", run.filter.recall()},
          {"standing_precision", run.standing.precision()},
          {"standing_recall", run.standing.recall()},
          {"target_recall", run.target.recall()},
          {"wrong_person_share", run.target.wrongPersonShare()},
          {"wrong_target_s", run.target.wrong_target_s},
          {"duration_s", run.target.duration_s},
          {"mean_error_m", run.target.meanError_m()},
          {"mota", run.mot.mota()},
          {"motp_m", run.mot.motp_m()},
          {"switches", run.mot.mismatches}};
}

void writeFiles(const Output& output, const std::vector<PerceptionTruthRun>& runs) {
  CsvWriter csv(output / "recordings.csv",
                {"seed", "similar", "filter_precision", "filter_recall", "standing_precision",
                 "standing_recall", "frames_in_view", "target_recall", "wrong_person_share",
                 "wrong_target_s", "mean_error_m", "mota", "motp_m", "switches"});
  for (const PerceptionTruthRun& run : runs) {
    csv.integer(static_cast<std::int64_t>(run.seed))
        .flag(run.similar)
        .number(run.filter.precision(), 4)
        .number(run.filter.recall(), 4)
        .number(run.standing.precision(), 4)
        .number(run.standing.recall(), 4)
        .integer(run.target.frames_in_view)
        .number(run.target.recall(), 4)
        .number(run.target.wrongPersonShare(), 4)
        .number(run.target.wrong_target_s, 2)
        .number(run.target.meanError_m(), 4)
        .number(run.mot.mota(), 4)
        .number(run.mot.motp_m(), 4)
        .integer(run.mot.mismatches)
        .endRow();
  }
  csv.close();
  nlohmann::ordered_json summary = toJson(sumOf(runs));
  summary["complete"] = !isStopRequested();
  summary["recordings"] = runs.size();
  writeJson(output / "summary.json", summary);
}

void run(PerceptionExperimentOptions& options) {
  std::optional<Output> output = experimentOutput("perception", options.simulated.out);
  const auto count = static_cast<std::size_t>(options.simulated.recordings);
  ProgressBar progress("perception", count);
  std::vector<PerceptionTruthRun> runs;
  for (std::size_t i = 0; i < count && !isStopRequested(); ++i) {
    runs.push_back(runPerceptionTruthExperiment(options.simulated.seed + i, options.params));
    progress.show(i + 1);
  }
  if (runs.empty()) throw Stopped("stopped before the first run");
  std::vector<PerceptionTruthRun> similar, others;
  for (const PerceptionTruthRun& r : runs) (r.similar ? similar : others).push_back(r);
  printRow("beside somebody in other clothes", others);
  printRow("beside somebody in a similar top", similar);
  printRow("all", runs);
  if (output) writeFiles(*output, runs);
  endExperiment(output);
}

}  // namespace

void addPerceptionExperiment(CLI::App& verb) {
  auto options = std::make_shared<PerceptionExperimentOptions>();
  CLI::App* experiment = verb.add_subcommand(
      "perception", "The perception against exact truth, on simulated recordings");
  experiment->footer("Example:\n  heel experiment perception --out out/perception");
  addSimulatedRuns(*experiment, options->simulated, options->params.scenes);
  experiment->callback([options] { run(*options); });
}

}  // namespace heel
