// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/evaluate/evaluation.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

struct EvaluateOptions {
  std::filesystem::path tracks;
  std::filesystem::path truth;
  std::filesystem::path out;
  EvaluationParams params;
};

/// Of the places that are given while the target is in view, those that are right.
double shareOfRightPlaces(const TargetMetrics& person) {
  const int given = person.frames_in_view - person.none;
  return given > 0 ? static_cast<double>(person.right) / given
                   : std::numeric_limits<double>::quiet_NaN();
}

nlohmann::ordered_json toJson(const Evaluation& result) {
  const ClearMot& people = result.people;
  const TargetMetrics& person = result.person;
  return {{"people",
           {{"frames", people.frames},
            {"truths", people.truths},
            {"matches", people.matches},
            {"misses", people.misses},
            {"false_positives", people.false_positives},
            {"switches", people.mismatches},
            {"things_left_out", result.things},
            {"mota", people.mota()},
            {"motp_m", people.motp_m()}}},
          {"target",
           {{"name", result.target},
            {"frames_in_view", person.frames_in_view},
            {"recall", person.recall()},
            {"right_places_share", shareOfRightPlaces(person)},
            {"wrong_person_share", person.wrongPersonShare()},
            {"wrong_target_s", person.wrong_target_s},
            {"frames_not_in_view", person.frames - person.frames_in_view},
            {"claimed_share", person.claimedShare()},
            {"right_answer_share", person.rightAnswerShare()},
            {"mean_error_m", person.meanError_m()},
            {"mean_reacquisition_delay_s", person.meanReacquisitionDelay_s()},
            {"longest_reacquisition_delay_s", person.longestReacquisitionDelay_s()}}}};
}

/// An error in metres; without anybody found there is none.
void printPlace(const char* name, double error_m) {
  if (std::isfinite(error_m)) std::printf("  %-20s  %6.3f m\n", name, error_m);
}

void print(const Evaluation& result) {
  const ClearMot& people = result.people;
  const TargetMetrics& person = result.person;
  std::printf("the target, %s, in %d frames\n", result.target.c_str(), person.frames_in_view);
  std::printf("  recall                %6.3f\n", person.recall());
  if (std::isfinite(shareOfRightPlaces(person))) {
    std::printf("  right places          %6.3f   of those that are given\n",
                shareOfRightPlaces(person));
  }
  std::printf("  wrong person          %6.3f   also when absent: %.1f s in all\n",
              person.wrongPersonShare(), person.wrong_target_s);
  if (person.frames > person.frames_in_view) {
    std::printf("  claimed when absent   %6.3f   in %d frames\n", person.claimedShare(),
                person.frames - person.frames_in_view);
  }
  std::printf("  right answers         %6.3f\n", person.rightAnswerShare());
  printPlace("mean error", person.meanError_m());
  if (person.reacquisition_delays_s.empty()) {
    std::printf("  found again                0   times\n");
  } else {
    std::printf("  found again           %6zu   times, after %.1f s on average\n",
                person.reacquisition_delays_s.size(), person.meanReacquisitionDelay_s());
  }
  std::printf("the tracks of people against all people (CLEAR MOT)\n");
  std::printf("  MOTA                  %6.3f   %d of %d found, %d false, %d switches\n",
              people.mota(), people.matches, people.truths, people.false_positives,
              people.mismatches);
  printPlace("MOTP", people.motp_m());
  if (result.things > 0) {
    std::printf("  %d places of tracks that are rather things are left out\n", result.things);
  }
}

/// A folder stands for the table in it.
fs::path tableAt(const fs::path& path, const char* name) {
  return fs::is_directory(path) ? path / name : path;
}

/// The frames that were looked at, as 'heel track' tells of them beside its tracks.
std::vector<double> framesBeside(const fs::path& tracks) {
  std::vector<double> stamps_s;
  const fs::path file = tracks.parent_path() / "frames.csv";
  if (!fs::exists(file)) return stamps_s;
  for (const FrameRow& frame : readFrames(file)) stamps_s.push_back(frame.stamp_s);
  std::sort(stamps_s.begin(), stamps_s.end());
  return stamps_s;
}

/// Whether the tracks are in the frame of the map, as 'heel track' tells beside them.
bool areOnMap(const fs::path& tracks) {
  std::ifstream file(tracks.parent_path() / "summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  return summary.is_object() && summary.value("frame", nlohmann::json()) == "map";
}

void run(EvaluateOptions options) {
  options.tracks = tableAt(options.tracks, "tracks.csv");
  options.truth = tableAt(options.truth, areOnMap(options.tracks) ? "truth_map.csv" : "truth.csv");
  const Evaluation result =
      evaluate(alignByStamp(readTracks(options.tracks), readTruth(options.truth),
                            framesBeside(options.tracks)),
               options.params);
  print(result);
  if (options.out.empty()) return;
  Output output({"evaluate", OutputKind::kFile, options.out, {options.tracks, options.truth}});
  writeJson(output.file(), toJson(result));
  output.commit();
}

}  // namespace

void addEvaluate(CLI::App& app) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App* verb = app.add_subcommand("evaluate", "Compare tracks with where people really were");
  verb->footer(
      "Example:\n"
      "  heel evaluate out/wardrobe recordings/wardrobe --target navy_jumper\n"
      "TRUTH is a table with the columns stamp_s,frame,person,x_m,y_m,exact. Where frames.csv is\n"
      "beside the tracks, the frames in it count, and no others.");
  verb->add_option("TRACKS", options->tracks, "tracks.csv of 'heel track', or its folder")
      ->required();
  verb->add_option("TRUTH", options->truth, "truth.csv, or the recording's folder")->required();
  verb->add_option("--target", options->params.target,
                   "who was to be followed (default: the first person of the truth)");
  verb->add_option("--distance", options->params.match_distance_m,
                   "how far an estimate may be from a person to count [m]")
      ->capture_default_str();
  verb->add_option("--from", options->params.from_s,
                   "leave out what is before this stamp [s], not so long after the beginning");
  verb->add_option("--to", options->params.to_s,
                   "leave out what is after this stamp [s], as --from");
  verb->add_option("--out", options->out, "write the figures as JSON to this file");
  verb->callback([options] { run(*options); });
}

}  // namespace heel
