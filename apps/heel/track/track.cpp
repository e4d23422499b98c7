// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/follower/wall_gate.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>
#include <heel/apps/heel/shared/lap_clock.hpp>
#include <heel/apps/heel/shared/robot_places.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/heel/track/track_output.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/segmentation/appearance_model_io.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

struct TrackOptions {
  std::filesystem::path recording;
  std::filesystem::path model;
  std::filesystem::path out;
  std::filesystem::path bag;
  RecordingParams opening;
  RecordingPiece piece;
  LogMapOptions map;
  std::vector<double> start_m;
  std::vector<double> bounds_m;
  bool no_film = false;
};

void print(const TrackOutput& output, std::size_t skipped) {
  std::printf("%zu frames, the target seen or predicted in %zu", output.frames(),
              output.framesWithTarget());
  if (skipped > 0) std::printf("; %zu frame%s left out", skipped, skipped == 1 ? " was" : "s were");
  std::printf("\n");
  for (const auto& [state, frames] : output.framesByState()) {
    std::printf("  %-10s %6zu\n", state.c_str(), frames);
  }
  std::printf("results in %s: %s\n", output.folder().c_str(), output.fileNames().c_str());
}

std::vector<std::string> motionWarnings(const RobotPlaces& robot, const MotionWatch& watch,
                                        const Recording& recording, std::size_t lost) {
  std::vector<std::string> warnings;
  if (lost > 0) {
    warnings.push_back(std::to_string(lost) + " frame" + (lost == 1 ? " is" : "s are") +
                       " left out: the robot is not found on the map in them (--robot-start tells "
                       "where it is at first)");
  }
  if (!robot.warning().empty()) warnings.push_back(robot.warning());
  if (const auto leaves_s = watch.leaves_s()) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "the camera seems to move from %.1f s on, and no odometry or tf tells how: places "
        "are as seen from it at each moment, so who stands seems to move",
        *leaves_s - recording.info().first_s);
    warnings.emplace_back(text);
  }
  return warnings;
}

/// Puts the robot on its map, and lets the walls say where nobody is; adds what it warns of.
void useMap(const TrackOptions& options, CameraSetup& setup, RobotPlaces& robot,
            std::vector<GeometricGate>& gates) {
  const LogMap map = openLogMap(options.map);
  for (const std::string& warning : robot.putOnMap(options.recording, options.opening, map)) {
    warn(warning);
    setup.warnings.push_back(warning);
  }
  WallGateParams gate;
  gate.eye_height_m = setup.T_base_camera.translation().z();
  gates.push_back(wallGate(map.walls, gate));
}

/// Where people likely are, who hide walls from the laser.
std::vector<Eigen::Vector2d> peopleOf(const Perception& perception) {
  constexpr double kLikely = 0.5;
  std::vector<Eigen::Vector2d> places;
  for (const Track& track : perception.tracks()) {
    const Evidence who = perception.identity().probabilities(track.id);
    if (track.status == TrackStatus::kTentative || who.sum() - who[kThing] < kLikely) continue;
    places.push_back(track.motion.position_m());
  }
  return places;
}

void run(TrackOptions options) {
  const AppearanceModel model = loadAppearance(options.model);
  auto recording = openRecording(options.recording, options.opening);
  // Of all pieces the same: by how the whole begins.
  CameraSetup setup = findCameraSetup(*openRecording(options.recording, options.opening));
  if (options.piece.count > 1) {
    options.opening.span = options.piece.spanOf(recording->info().duration_s);
    recording = openRecording(options.recording, options.opening);
  }
  for (const std::string& warning : setup.warnings) warn(warning);
  RobotPlaces robot(*recording, setup);
  std::vector<GeometricGate> gates;
  const bool on_map = !options.map.map.empty();
  if (on_map) useMap(options, setup, robot, gates);

  PerceptionParams params;
  TrackOutputParams output_params;
  output_params.film = !options.no_film;
  output_params.bag = options.bag;
  output_params.inputs = {options.recording, options.model};
  if (on_map) output_params.inputs.push_back(mapSource(options.map.map));
  output_params.person = picturedPerson(options.model, model);
  output_params.frame = robot.frame();
  if (!options.bounds_m.empty()) {
    const Eigen::Vector2d lowest(options.bounds_m[0], options.bounds_m[1]);
    const Eigen::Vector2d highest(options.bounds_m[2], options.bounds_m[3]);
    gates.push_back(insideBounds(lowest, highest));
    output_params.bounds_m = Eigen::AlignedBox2d(lowest, highest);
  }
  if (!gates.empty()) params.gate = allOf(std::move(gates));
  Perception perception(setup, model, params);
  const bool is_begin = options.piece.number == 1;
  if (is_begin && !options.start_m.empty())
    perception.startAt({options.start_m[0], options.start_m[1]});

  MotionWatch watch(robot, setup);
  TrackOutput output(options.out, recording->info(), setup, output_params);
  ProgressBar progress("tracking", recording->info().frame_count);
  TrackEnd end;
  std::vector<SkippedFrame> unplaced;  // of a robot that is not found on its map
  end.warnings = setup.warnings;
  const std::string lost_before = recording->info().lost;
  Frame frame;
  std::size_t read = 0;
  StageTimes times_ms{};
  while (!isStopRequested() && recording->next(frame)) {
    ++read;
    const auto place =
        on_map ? robot.at(frame.stamp_s, peopleOf(perception)) : robot.at(frame.stamp_s);
    if (!place) {
      (robot.isLost() ? unplaced : end.skipped)
          .push_back({frame.number, frame.name + ": " + robot.whyAbsent()});
      continue;
    }
    LapClock clock;
    try {
      const PerceptionStep& step = perception.step(frame, *place, nullptr, [&](Stage stage) {
        times_ms[static_cast<std::size_t>(stage)] = clock.lap_ms();
      });
      watch.look(frame);
      output.add(frame, place->pose, perception, step, times_ms);
    } catch (const std::invalid_argument& error) {
      end.skipped.push_back({frame.number, frame.name + ": " + error.what()});
    }
    progress.show(read);
  }
  end.complete = !isStopRequested();
  end.skipped.insert(end.skipped.end(), recording->skipped().begin(), recording->skipped().end());
  if (output.frames() == 0) {
    if (!end.complete) throw Stopped("stopped before the first frame; nothing is written");
    const bool is_mostly_lost = unplaced.size() > end.skipped.size();
    end.skipped.insert(is_mostly_lost ? end.skipped.begin() : end.skipped.end(), unplaced.begin(),
                       unplaced.end());
    throw std::runtime_error(nothingReadMessage(*recording, end.skipped));
  }
  if (!end.skipped.empty()) warn(leftOutNote(end.skipped, ""));
  end.skipped.insert(end.skipped.end(), unplaced.begin(), unplaced.end());
  for (const std::string& warning : motionWarnings(robot, watch, *recording, unplaced.size())) {
    warn(warning);
    end.warnings.push_back(warning);
  }
  if (const std::string& lost = recording->info().lost; lost != lost_before) {
    warn(lost);
    end.warnings.push_back(lost);
  }
  output.commit(end);
  print(output, end.skipped.size());
  if (!end.complete) {
    throw Stopped("stopped: the results are those of " + std::to_string(output.frames()) +
                  " frames");
  }
  if (output.framesWithTarget() == 0) {
    throw NothingFound(options.recording.string() + ": the person is in no frame" +
                       leftOutNote(end.skipped) + "; mostly, " + output.commonestReason() +
                       "; a person in other clothes or in another light has to be learned anew");
  }
}

void addPiece(CLI::App& verb, RecordingPiece& piece) {
  const std::function<void(const std::vector<int>&)> set = [&piece](const std::vector<int>& given) {
    piece.number = given[0];
    piece.count = given[1];
    if (piece.number >= 1 && piece.number <= piece.count) return;
    throw CLI::ValidationError("--piece", "the second of three is 2/3");
  };
  CLI::Option* option =
      verb.add_option_function("--piece", set,
                               "read only this one of as many equally long pieces; see heel join")
          ->delimiter('/')
          ->expected(2)
          ->option_text("I/N")
          ->excludes("--from")
          ->excludes("--to");
  verb.add_option(
          "--overlap", piece.overlap_s,
          "a piece begins so long before its time: by then it is known again who is who [s]")
      ->check(isNotNegative)
      ->needs(option)
      ->capture_default_str();
}

}  // namespace

void addTrack(CLI::App& app) {
  auto options = std::make_shared<TrackOptions>();
  CLI::App* verb = app.add_subcommand("track", "Follow a learned person through a recording");
  verb->footer(
      "Example:\n"
      "  heel track recordings/kitchen --model person.yaml --out out/kitchen\n"
      "Writes report.html (open it in a browser), tracks.csv (who is where), frames.csv (what\n"
      "every stage left of each frame, and why there is no target), timing.csv, summary.json, and\n"
      "the film tracks.mp4 with stills.\n"
      "Places are in the base frame; if the robot moves, as the tf or odometry of a bag tells, or\n"
      "the odometry.csv or groundtruth.txt of a folder, in the odometry's: see summary.json.\n"
      "With --map they are in the map's, where the robot is found by its laser and odometry, or\n"
      "by tf's frame 'map', and nobody is seen through its walls.");
  verb->add_option("RECORDING", options->recording, "folder of a recording, or a bag")->required();
  verb->add_option("--model", options->model, "the person, as 'heel learn' wrote it")->required();
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->add_option("--start", options->start_m,
                   "where the person stands in the first frame [m] (default: found by their looks)")
      ->delimiter(',')
      ->expected(2)
      ->option_text("X,Y");
  verb->add_option("--bounds", options->bounds_m,
                   "the room: nobody outside of it is taken for the person [m]")
      ->delimiter(',')
      ->expected(4)
      ->option_text("X0,Y0,X1,Y1");
  verb->add_option("--map", options->map.map,
                   "the robot's map: a .bt or a map_server YAML, or a scene's name");
  addLogMap(*verb, options->map, options->opening.topics);
  verb->add_flag("--no-film", options->no_film, "draw no film and no stills");
  addResultBag(*verb, options->bag);
  addTimeSpan(*verb, options->opening.span);
  addPiece(*verb, options->piece);
  addCameraTopics(*verb, options->opening.topics);
  addOdometryTopic(*verb, options->opening.topics);
  verb->callback([options] { run(*options); });
}

}  // namespace heel
