// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/experiments.hpp>
#include <heel/apps/experiment/offered_models.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/experiment/experiment_commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace heel {
namespace {

struct ExperimentOptions {
  std::filesystem::path recording;
  std::vector<std::filesystem::path> others;
  ExperimentParams params;
};

void runDetector(const ExperimentOptions& options) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin;
  double total_ms = 0.0;
  WorkTimer timer;
  timer.start = [&] { begin = Clock::now(); };
  timer.stop = [&] {
    total_ms += std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  };
  const ClearMot result = runDetectorExperiment(options.recording, options.params, timer);
  std::printf("phase 1 as a people detector, match within %.2f m, %d frames\n", kDetectorDistance_m,
              result.frames);
  std::printf("  MODA %.3f  recall %.3f  precision %.3f  (%d of %d found, %d false)\n",
              result.moda(), result.recall(), result.precision(), result.matches, result.truths,
              result.false_positives);
  std::printf("  mean distance %.3f m, %.2f ms a frame\n", result.motp_m(),
              total_ms / result.frames);
}

void printRow(const std::string& name, const TargetMetrics& m) {
  std::printf("  %-32s recall %.3f  wrong person %.3f  (%d frames)\n", name.c_str(), m.recall(),
              m.wrongPersonShare(), m.frames_in_view);
}

void runProtocol(const ExperimentOptions& options) {
  std::printf("the paper's protocol: learned alone, then followed by appearance alone\n");
  for (const OfferedModel& offered : offeredModels()) {
    ExperimentParams params = options.params;
    params.appearance = offered.params;
    const ProtocolResult result = runProtocolExperiment(options.recording, params);
    std::printf("%s: %s learned in %d frames\n", offered.name.c_str(), result.person.c_str(),
                result.learned.acquisition.person_frames);
    printRow(options.recording.filename().string(), result.following);
    for (const std::filesystem::path& other : options.others) {
      printRow(other.filename().string(),
               runFollowingExperiment(other, result.learned.model, result.person));
    }
  }
}

void printTarget(const std::string& name, const TargetResult& result) {
  const TargetMetrics& cold = result.cold;
  std::printf("  %-26s %4d  %.2f %.2f   %.2f %.2f   %.2f %.2f %5d  %.2f    %.2f\n", name.c_str(),
              result.started.frames_in_view, result.best_blob.recall(),
              result.best_blob.wrongPersonShare(), result.started.recall(),
              result.started.wrongPersonShare(), cold.recall(), cold.wrongPersonShare(),
              cold.frames - cold.frames_in_view, cold.claimedShare(), cold.rightAnswerShare());
}

void printError(const Reliability& reliability) {
  std::printf("  expected calibration error %.3f; exact probabilities would have %.3f by chance\n",
              reliability.expectedError(), reliability.errorByChance());
}

void print(const Reliability& reliability) {
  std::printf("  said to be the target with      and is, of    each # is one in fifty\n");
  for (std::size_t i = 0; i < reliability.bins.size(); ++i) {
    const Reliability::Bin& bin = reliability.bins[i];
    if (bin.count == 0) continue;
    const double is = static_cast<double>(bin.right) / bin.count;
    std::printf("  %.1f to %.1f, in the mean %.2f  %7.2f %5d    %s\n", 0.1 * static_cast<double>(i),
                0.1 * static_cast<double>(i + 1), bin.said / bin.count, is, bin.count,
                std::string(static_cast<std::size_t>(std::lround(50.0 * is)), '#').c_str());
  }
  printError(reliability);
}

void runTargets(const ExperimentOptions& options) {
  std::vector<std::filesystem::path> recordings = options.others;
  recordings.insert(recordings.begin(), options.recording);
  std::printf(
      "each person as the target: recall and share of frames on a wrong person; found by\n"
      "looks, also the frames they are not in, and the shares claimed then and right of all\n");
  for (const OfferedModel& offered : offeredModels()) {
    ExperimentParams params = options.params;
    params.appearance = offered.params;
    std::printf("%s\n  %-26s %4s  best blob   started   by looks  not in  claimed right\n",
                offered.name.c_str(), "person", "n");
    const auto results = runTargetsExperiment(recordings, params);
    TargetResult part, all;
    for (std::size_t i = 0; i < results.size(); ++i) {
      printTarget(results[i].person, results[i]);
      part.add(results[i]);
      all.add(results[i]);
      const bool is_last = i + 1 == results.size();
      if (!is_last && results[i + 1].learned_in == results[i].learned_in &&
          results[i + 1].sought_in == results[i].sought_in) {
        continue;
      }
      if (is_last && recordings.size() == 1) break;
      printTarget(results[i].learned_in.filename().string() + ", " +
                      results[i].sought_in.filename().string(),
                  part);
      printError(part.cold.reliability);
      part = {};
    }
    printTarget("all", all);
    print(all.cold.reliability);
  }
}

}  // namespace

void addSimulatedRuns(CLI::App& experiment, SimulatedRuns& runs, std::filesystem::path& scenes) {
  scenes = sceneFolder();
  experiment.add_option("--recordings", runs.recordings, "how many simulated ones")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  experiment.add_option("--seed", runs.seed, "of the first")->capture_default_str();
  experiment.add_option("--out", runs.out, "folder for tables");
}

std::optional<Output> experimentOutput(const std::string& name, const std::filesystem::path& out,
                                       const std::vector<std::filesystem::path>& inputs) {
  if (out.empty()) return std::nullopt;
  return std::optional<Output>(
      std::in_place,
      OutputPlan{"experiment " + name, OutputKind::kFolder, out, inputs, {"summary.json"}});
}

void endExperiment(std::optional<Output>& output) {
  if (output) {
    output->commit(!isStopRequested());
    std::printf("wrote %s\n", output->path().c_str());
  }
  if (isStopRequested()) throw Stopped("stopped: the results are those of the runs so far");
}

void addExperiment(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("experiment", "Measure Heel on recordings with truth, and in simulation");
  verb->require_subcommand(1);
  verb->footer(
      "Example:\n"
      "  heel experiment targets recordings/six_people\n"
      "Recordings: a still camera, empty at first, with people's true places in truth.csv.");
  const auto add = [verb](const char* name, const char* what,
                          void (*run)(const ExperimentOptions&)) {
    auto options = std::make_shared<ExperimentOptions>();
    CLI::App* experiment = verb->add_subcommand(name, what);
    experiment->footer(std::string("Example:\n  heel experiment ") + name +
                       " recordings/six_people");
    experiment->add_option("RECORDING", options->recording, "folder with truth.csv")->required();
    experiment
        ->add_option("--background", options->params.background_s,
                     "how long the room is empty at the beginning [s]")
        ->capture_default_str();
    experiment->callback([options, run] { run(*options); });
    return std::make_pair(experiment, options);
  };
  add("detector", "Phase 1 as a detector of everyone in view", runDetector);
  auto [targets, targets_options] =
      add("targets", "Each person as the target, learned in one half and looked for in the other",
          runTargets);
  targets->add_option("OTHERS", targets_options->others,
                      "more recordings; who is in two is learned in each and looked for in the "
                      "other");
  auto [protocol, options] =
      add("protocol", "The first person learned while alone, then followed", runProtocol);
  protocol->add_option("OTHERS", options->others, "more recordings of the same person");
  addAppearanceExperiment(*verb);
  addFollowExperiment(*verb);
  addGateExperiment(*verb);
  addLightExperiment(*verb);
  addLocalizationExperiment(*verb);
  addPerceptionExperiment(*verb);
}

}  // namespace heel
