// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/output/output.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/apps/pages/pages.hpp>
#include <heel/apps/results/track_log.hpp>
#include <heel/cloud/files.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct JoinOptions {
  std::vector<fs::path> pieces;
  fs::path out;
};

struct Piece {
  fs::path folder;
  TrackTables tables;
  Json summary;
};

Piece readPiece(const fs::path& folder) {
  Piece piece{folder, {readFrames(folder / "frames.csv"), readTracks(folder / "tracks.csv")}, {}};
  const fs::path file = folder / "summary.json";
  piece.summary = Json::parse(readWholeFile(file), nullptr, false);
  const bool is_whole = piece.summary.is_object() && !piece.tables.frames.empty() &&
                        piece.summary.value("complete", Json()) == true &&
                        piece.summary.value("frames_skipped", Json()).is_array() &&
                        piece.summary.value("warnings", Json()).is_array();
  if (!is_whole)
    throw std::runtime_error(file.string() + ": these are no complete results of heel track");
  return piece;
}

/// What must be the same of all pieces of a recording.
void checkIsOfTheSame(const Piece& piece, const Piece& first) {
  for (const char* key : {"recording", "layout", "person", "frame", "camera"}) {
    const Json ours = first.summary.value(key, Json()), theirs = piece.summary.value(key, Json());
    if (ours == theirs) continue;
    throw std::runtime_error(piece.folder.string() + ": its " + key + " is " + theirs.dump() +
                             ", that of " + first.folder.string() + " " + ours.dump());
  }
}

/// Frames that were left out, as the whole counts.
void appendSkipped(Json& whole, const Json& of_piece, const Seam& seam) {
  for (Json skipped : of_piece) {
    const Json frame = skipped.is_object() ? skipped.value("frame", Json()) : Json();
    if (!frame.is_number_unsigned() || frame.get<std::size_t>() < seam.first_frame) continue;
    skipped["frame"] = frame.get<std::ptrdiff_t>() + seam.shift;
    whole.push_back(std::move(skipped));
  }
}

void append(Piece& whole, Piece next) {
  try {
    const Seam seam = join(whole.tables, std::move(next.tables));
    appendSkipped(whole.summary["frames_skipped"], next.summary["frames_skipped"], seam);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(next.folder.string() + ": " + error.what());
  }
  Json& warnings = whole.summary["warnings"];
  for (const Json& warning : next.summary["warnings"]) {
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  }
}

/// Counts the frames anew; returns how many have a target.
std::size_t count(Piece& whole) {
  const auto& frames = whole.tables.frames;
  std::map<std::string, std::size_t> states, reasons;
  for (const FrameRow& row : frames) {
    ++states[row.state];
    if (!row.reason.empty()) ++reasons[row.reason];
  }
  const auto with_target = static_cast<std::size_t>(std::count_if(
      frames.begin(), frames.end(), [](const FrameRow& row) { return row.target_id != 0; }));
  whole.summary["duration_s"] = frames.back().stamp_s - frames.front().stamp_s;
  whole.summary["frames"] = frames.size();
  whole.summary["frames_with_target"] = with_target;
  whole.summary["frames_by_state"] = states;
  whole.summary["frames_by_reason"] = reasons;
  return with_target;
}

TrackLog logOf(const Piece& whole) {
  const auto text = [&](const char* key) {
    const Json value = whole.summary.value(key, Json());
    return value.is_string() ? value.get<std::string>() : std::string();
  };
  TrackLog log;
  log.recording = text("recording");
  log.layout = text("layout");
  log.person = text("person");
  log.frame = text("frame");
  log.moves = log.frame != "base";
  log.skipped = whole.summary["frames_skipped"].size();
  for (const Json& warning : whole.summary["warnings"]) {
    if (warning.is_string()) log.warnings.push_back(warning.get<std::string>());
  }
  const Json width = whole.summary.value("/camera/width"_json_pointer, Json());
  const Json height = whole.summary.value("/camera/height"_json_pointer, Json());
  const bool has_size = width.is_number() && height.is_number();
  const double pixels = has_size ? width.get<double>() * height.get<double>() : 0.0;
  auto begin = whole.tables.tracks.begin();
  for (const FrameRow& frame : whole.tables.frames) {
    const auto end = std::find_if(begin, whole.tables.tracks.end(),
                                  [&](const TrackRow& row) { return row.stamp_s > frame.stamp_s; });
    log.samples.push_back(sampleOf(frame, {begin, end}, pixels));
    begin = end;
  }
  return log;
}

void run(const JoinOptions& options) {
  std::vector<Piece> pieces;
  std::transform(options.pieces.begin(), options.pieces.end(), std::back_inserter(pieces),
                 readPiece);
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return a.tables.frames.back().stamp_s < b.tables.frames.back().stamp_s;
  });
  Piece whole = std::move(pieces.front());
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    checkIsOfTheSame(pieces[i], whole);
    append(whole, std::move(pieces[i]));
  }
  const std::size_t with_target = count(whole);

  Output output({"join",
                 OutputKind::kFolder,
                 options.out,
                 options.pieces,
                 {"report.html", "tracks.csv", "frames.csv", "summary.json"}});
  ResultFiles files(output);
  for (const TrackRow& row : whole.tables.tracks) files.add(row);
  for (const FrameRow& row : whole.tables.frames) files.add(row);
  files.close();
  writeJson(output / "summary.json", whole.summary);
  writeFile(output / "report.html", trackPage(logOf(whole)));
  output.commit();
  std::printf("%zu pieces, %zu frames, the target seen or predicted in %zu\n", pieces.size(),
              whole.tables.frames.size(), with_target);
  std::printf("wrote %s: report.html tracks.csv frames.csv summary.json\n", output.path().c_str());
  if (with_target == 0) throw NothingFound("the person is in no frame of the pieces");
}

}  // namespace

void addJoin(CLI::App& app) {
  auto options = std::make_shared<JoinOptions>();
  CLI::App* verb =
      app.add_subcommand("join", "Join the results of a recording that was tracked in pieces");
  verb->footer(
      "Example:\n"
      "  heel track long.bag --model person.yaml --piece 1/2 --no-film --out out/1\n"
      "  heel track long.bag --model person.yaml --piece 2/2 --no-film --out out/2\n"
      "  heel join out/1 out/2 --out out/long\n"
      "Each frame is taken from one piece; where two of them overlap, from the earlier. Whoever is "
      "at\n"
      "the same place in the last frame that both have is the same track. timing.csv stays with "
      "the\n"
      "pieces.");
  verb->add_option("PIECE", options->pieces, "folders of heel track")->required();
  verb->add_option("--out", options->out, "folder for the results")->required();
  verb->callback([options] { run(*options); });
}

}  // namespace heel
