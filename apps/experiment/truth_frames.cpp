// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/truth_frames.hpp>

#include <algorithm>

namespace heel {

TruthFrames::TruthFrames(const std::filesystem::path& recording) {
  for (TruthRow& row : readTruth(recording / "truth.csv")) {
    if (std::find(people_.begin(), people_.end(), row.person) == people_.end()) {
      people_.push_back(row.person);
    }
    rows_[row.frame].push_back(std::move(row));
  }
}

const std::vector<TruthRow>& TruthFrames::at(std::size_t frame) const {
  static const std::vector<TruthRow> kNobody;
  const auto found = rows_.find(frame);
  return found == rows_.end() ? kNobody : found->second;
}

std::optional<Eigen::Vector2d> TruthFrames::placeOf(const std::string& person,
                                                    std::size_t frame) const {
  for (const TruthRow& row : at(frame)) {
    if (row.person == person) return row.position_m;
  }
  return std::nullopt;
}

std::size_t TruthFrames::firstFrameOfOthers(const std::string& person) const {
  for (const auto& [frame, rows] : rows_) {
    for (const TruthRow& row : rows) {
      if (row.person != person) return frame;
    }
  }
  return 0;
}

std::vector<std::size_t> TruthFrames::exactFrames(const std::string& person) const {
  std::vector<std::size_t> frames;
  for (const auto& [frame, rows] : rows_) {
    for (const TruthRow& row : rows) {
      if (row.person == person && row.exact) frames.push_back(frame);
    }
  }
  return frames;
}

TargetFrame TruthFrames::targetFrame(const std::string& person, std::size_t frame,
                                     double stamp_s) const {
  TargetFrame result;
  result.stamp_s = stamp_s;
  for (const TruthRow& row : at(frame)) {
    if (row.person == person) {
      result.target_m = row.position_m;
    } else {
      result.others_m.push_back(row.position_m);
    }
  }
  return result;
}

}  // namespace heel
