// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/experiment/experiments.hpp"
#include "apps/experiment/offered_models.hpp"
#include "apps/heel/commands.hpp"
#include "apps/heel/experiment_commands.hpp"
#include "apps/heel/scene_argument.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace heel {
namespace {

struct Options {
  std::filesystem::path recording;
  std::filesystem::path other;
  ExperimentParams params;
};

void runDetector(const Options& options) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin;
  double total_ms = 0.0;
  WorkTimer timer;
  timer.start = [&] { begin = Clock::now(); };
  timer.stop = [&] {
    total_ms += std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  };
  const ClearMot result = runDetectorExperiment(options.recording, options.params, timer);
  std::printf("phase 1 as a people detector, match within %.2f m, %d frames\n",
              options.params.detector_distance_m, result.frames);
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

void runProtocol(const Options& options) {
  std::printf("the paper's protocol: learned alone, then followed by appearance alone\n");
  for (const OfferedModel& offered : offeredModels()) {
    ExperimentParams params = options.params;
    params.appearance = offered.params;
    const ProtocolResult result = runProtocolExperiment(options.recording, params);
    std::printf("%s: %s learned in %d frames\n", offered.name.c_str(), result.person.c_str(),
                result.learned.acquisition.person_frames);
    printRow(options.recording.filename().string(), result.following);
    if (!options.other.empty()) {
      printRow(options.other.filename().string(),
               runFollowingExperiment(options.other, result.learned.model, result.person, params));
    }
  }
}

/// Sums over people: each frame counts the same.
struct Sum {
  int frames = 0, right = 0, wrong = 0;
  void add(const TargetMetrics& m) {
    frames += m.frames_in_view;
    right += m.right;
    wrong += m.wrong_person;
  }
  void print() const {
    std::printf("  %.2f %.2f ", static_cast<double>(right) / frames,
                static_cast<double>(wrong) / frames);
  }
};

void runTargets(const Options& options) {
  std::printf("each person as the target: recall and share of frames on a wrong person\n");
  for (const OfferedModel& offered : offeredModels()) {
    ExperimentParams params = options.params;
    params.appearance = offered.params;
    std::printf("%s\n  %-26s %5s   best blob   started   found by looks\n", offered.name.c_str(),
                "person", "n");
    Sum best, started, cold;
    for (const TargetResult& result : runTargetsExperiment(options.recording, params)) {
      Sum one_best, one_started, one_cold;
      one_best.add(result.best_blob);
      one_started.add(result.started);
      one_cold.add(result.cold);
      std::printf("  %-26s %5d ", result.person.c_str(), result.started.frames_in_view);
      one_best.print();
      one_started.print();
      one_cold.print();
      std::printf("\n");
      best.add(result.best_blob);
      started.add(result.started);
      cold.add(result.cold);
    }
    std::printf("  %-26s %5d ", "all", started.frames);
    best.print();
    started.print();
    cold.print();
    std::printf("\n");
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
  const auto add = [verb](const char* name, const char* what, void (*run)(const Options&)) {
    auto options = std::make_shared<Options>();
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
  add("targets", "Each person as the target, learned in one half and looked for in the other",
      runTargets);
  auto [protocol, options] =
      add("protocol", "The first person learned while alone, then followed", runProtocol);
  protocol->add_option("OTHER", options->other, "another recording of the same person");
  addAppearanceExperiment(*verb);
  addFollowExperiment(*verb);
  addGateExperiment(*verb);
  addLightExperiment(*verb);
  addLocalizationExperiment(*verb);
  addPerceptionExperiment(*verb);
}

}  // namespace heel
