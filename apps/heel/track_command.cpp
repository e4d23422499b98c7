// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/perception.hpp"
#include "apps/heel/bag_options.hpp"
#include "apps/heel/commands.hpp"
#include "apps/heel/lap_clock.hpp"
#include "apps/heel/track_output.hpp"
#include "apps/report/progress_bar.hpp"
#include "apps/report/run_end.hpp"
#include "segmentation/appearance_model_io.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

struct Options {
  std::filesystem::path recording;
  std::filesystem::path model;
  std::filesystem::path out = "out";
  std::filesystem::path bag;
  RecordingParams opening;
  std::vector<double> start_m;
  std::vector<double> bounds_m;
  bool no_film = false;
};

void print(const TrackOutput& output, std::size_t skipped) {
  std::printf("%zu frames, the target seen or predicted in %zu", output.frames(),
              output.framesWithTarget());
  if (skipped > 0) std::printf("; %zu frame%s could not be read", skipped, skipped == 1 ? "" : "s");
  std::printf("\n");
  for (const auto& [state, frames] : output.framesByState()) {
    std::printf("  %-10s %6zu\n", state.c_str(), frames);
  }
  std::printf("results in %s: %s\n", output.folder().c_str(), output.fileNames().c_str());
}

void run(const Options& options) {
  const AppearanceModel model = loadAppearance(options.model);
  const CameraSetup setup = findCameraSetup(*openRecording(options.recording, options.opening));
  for (const std::string& warning : setup.warnings) warn(warning);

  PerceptionParams params;
  TrackOutputParams output_params;
  output_params.film = !options.no_film;
  output_params.bag = options.bag;
  output_params.inputs = {options.recording, options.model};
  if (!options.bounds_m.empty()) {
    const Eigen::Vector2d lowest(options.bounds_m[0], options.bounds_m[1]);
    const Eigen::Vector2d highest(options.bounds_m[2], options.bounds_m[3]);
    params.gate = insideBounds(lowest, highest);
    output_params.bounds_m = Eigen::AlignedBox2d(lowest, highest);
  }
  Perception perception(setup, model, params);
  if (!options.start_m.empty()) perception.startAt({options.start_m[0], options.start_m[1]});

  const auto recording = openRecording(options.recording, options.opening);
  TrackOutput output(options.out, recording->info(), setup, output_params);
  ProgressBar progress("tracking", recording->info().frame_count);
  TrackEnd end;
  end.warnings = setup.warnings;
  Frame frame;
  StageTimes times_ms{};
  while (!isStopRequested() && recording->next(frame)) {
    LapClock clock;
    try {
      const PerceptionStep& step = perception.step(frame, {}, nullptr, [&](Stage stage) {
        times_ms[static_cast<std::size_t>(stage)] = clock.lap_ms();
      });
      output.add(frame, perception, step, times_ms);
    } catch (const std::invalid_argument& error) {
      end.skipped.push_back({frame.number, frame.name + ": " + error.what()});
    }
    progress.show(frame.number);
  }
  end.complete = !isStopRequested();
  end.skipped.insert(end.skipped.end(), recording->skipped().begin(), recording->skipped().end());
  if (output.frames() == 0) {
    if (!end.complete) throw Stopped("stopped before the first frame; nothing is written");
    throw std::runtime_error(nothingReadMessage(*recording, end.skipped));
  }
  for (const SkippedFrame& frame_left_out : end.skipped) warn(frame_left_out.reason);
  output.commit(end);
  print(output, end.skipped.size());
  if (!end.complete) {
    throw Stopped("stopped: the results are those of " + std::to_string(output.frames()) +
                  " frames");
  }
  if (output.framesWithTarget() == 0) {
    throw NothingFound(options.recording.string() + ": the person is in no frame");
  }
}

}  // namespace

void addTrack(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("track", "Follow a learned person through a recording");
  verb->footer(
      "Example:\n"
      "  heel track recordings/kitchen --model person.yaml --out out/kitchen\n"
      "Writes tracks.csv (who is where), frames.csv (what every stage left of each frame, and why\n"
      "there is no target), timing.csv, summary.json, and the film tracks.mp4 with stills.");
  verb->add_option("RECORDING", options->recording, "folder of a recording, or a bag")->required();
  verb->add_option("--model", options->model, "the person, as 'heel learn' wrote it")->required();
  verb->add_option("--out", options->out, "folder for the results")->capture_default_str();
  verb->add_option("--start", options->start_m,
                   "where the person stands in the first frame [m] (default: found by their looks)")
      ->expected(2)
      ->option_text("X Y");
  verb->add_option("--bounds", options->bounds_m,
                   "the room: nobody outside of it is taken for the person [m]")
      ->expected(4)
      ->option_text("X0 Y0 X1 Y1");
  verb->add_flag("--no-film", options->no_film, "write the tables only");
  addResultBag(*verb, options->bag);
  addCameraTopics(*verb, options->opening.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
