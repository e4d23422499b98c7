// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/results/result_files.hpp>

#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

constexpr int kStampDecimals = 6;  // microseconds, as robots' logs have them
constexpr int kPlaceDecimals = 4;  // a tenth of a millimetre: below every sensor's noise
constexpr int kAngleDecimals = 6;
constexpr int kScoreDecimals = 4;
constexpr int kTimingDecimals = 3;

// The order in which the readers ask for the columns.
const std::vector<std::string> kTrackColumns = {"stamp_s", "track_id", "is_target", "x_m",   "y_m",
                                                "vx_mps",  "vy_mps",   "score",     "status"};
const std::string kPersonColumn = "person_probability";  // tables of others need not have it
const std::vector<std::string> kTruthColumns = {"stamp_s", "frame", "person",
                                                "x_m",     "y_m",   "exact"};
const std::vector<std::string> kFrameColumns = {
    "frame", "stamp_s",      "color_pixels", "color_points", "standing_points",
    "blobs", "observations", "tracks",       "target_id",    "confidence",
    "state", "reason",       "robot_x_m",    "robot_y_m",    "robot_yaw_rad"};

std::vector<std::string> trackColumns() {
  std::vector<std::string> columns = kTrackColumns;
  columns.push_back(kPersonColumn);
  return columns;
}

std::vector<std::string> timingColumns(const std::vector<std::string>& stages) {
  std::vector<std::string> columns = {"frame"};
  for (const auto& stage : stages) columns.push_back(stage + "_ms");
  return columns;
}

}  // namespace

ResultFiles::ResultFiles(const Output& output, const std::vector<std::string>& stages)
    : tracks_(output / "tracks.csv", trackColumns()),
      frames_(output / "frames.csv", kFrameColumns) {
  if (!stages.empty()) timing_.emplace(output / "timing.csv", timingColumns(stages));
}

void ResultFiles::add(const TrackRow& row) {
  tracks_.number(row.stamp_s, kStampDecimals)
      .integer(row.track_id)
      .flag(row.is_target)
      .number(row.position_m.x(), kPlaceDecimals)
      .number(row.position_m.y(), kPlaceDecimals)
      .number(row.velocity_mps.x(), kPlaceDecimals)
      .number(row.velocity_mps.y(), kPlaceDecimals)
      .number(row.score, kScoreDecimals)
      .text(row.status)
      .number(row.person_probability, kScoreDecimals)
      .endRow();
}

void ResultFiles::add(const FrameRow& row) {
  frames_.integer(static_cast<std::int64_t>(row.frame)).number(row.stamp_s, kStampDecimals);
  for (const int count : {row.color_pixels, row.color_points, row.standing_points, row.blobs,
                          row.observations, row.tracks}) {
    frames_.integer(count);
  }
  frames_.integer(row.target_id)
      .number(row.confidence, kScoreDecimals)
      .text(row.state)
      .text(row.reason)
      .number(row.robot.position.x(), kPlaceDecimals)
      .number(row.robot.position.y(), kPlaceDecimals)
      .number(row.robot.yaw_rad, kAngleDecimals)
      .endRow();
}

void ResultFiles::addTiming(std::size_t frame, const std::vector<double>& stages_ms) {
  timing_->integer(static_cast<std::int64_t>(frame));
  for (const double ms : stages_ms) timing_->number(ms, kTimingDecimals);
  timing_->endRow();
}

void ResultFiles::close() {
  tracks_.close();
  frames_.close();
  if (timing_) timing_->close();
}

void writeJson(const OutputPath& file, const nlohmann::ordered_json& value) {
  using Json = nlohmann::ordered_json;
  writeFile(file, value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<TrackRow> readTracks(const fs::path& file) {
  CsvReader csv(file, kTrackColumns, {kPersonColumn});
  std::vector<TrackRow> rows;
  while (csv.next()) {
    TrackRow row;
    row.stamp_s = csv.number(0);
    row.track_id = static_cast<int>(csv.integer(1));
    row.is_target = csv.flag(2);
    row.position_m = {csv.number(3), csv.number(4)};
    row.velocity_mps = {csv.number(5), csv.number(6)};
    row.score = csv.number(7);
    row.status = csv.text(8);
    if (csv.has(9)) row.person_probability = csv.number(9);
    rows.push_back(row);
  }
  return rows;
}

std::vector<FrameRow> readFrames(const fs::path& file) {
  CsvReader csv(file, kFrameColumns);
  std::vector<FrameRow> rows;
  while (csv.next()) {
    FrameRow& row = rows.emplace_back();
    row.frame = csv.count(0);
    row.stamp_s = csv.number(1);
    std::size_t column = 2;
    for (int* count : {&row.color_pixels, &row.color_points, &row.standing_points, &row.blobs,
                       &row.observations, &row.tracks, &row.target_id}) {
      *count = static_cast<int>(csv.integer(column++));
    }
    row.confidence = csv.number(9);
    row.state = csv.text(10);
    row.reason = csv.text(11);
    row.robot = {{csv.number(12), csv.number(13)}, csv.number(14)};
  }
  return rows;
}

std::vector<TruthRow> readTruth(const fs::path& file) {
  CsvReader csv(file, kTruthColumns);
  std::vector<TruthRow> rows;
  while (csv.next()) {
    TruthRow row;
    row.stamp_s = csv.number(0);
    row.frame = csv.count(1);
    row.person = csv.text(2);
    row.position_m = {csv.number(3), csv.number(4)};
    row.exact = csv.flag(5);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace heel
