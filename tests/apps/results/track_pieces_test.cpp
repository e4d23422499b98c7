// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/results/track_log.hpp>

#include <gmock/gmock.h>

#include <map>
#include <vector>

namespace {

using heel::FrameRow;
using heel::join;
using heel::Seam;
using heel::TrackRow;
using heel::TrackTables;
using testing::ElementsAre;

/// Frames at these stamps, counted from 1, without a target; in each of them, tracks at these x.
TrackTables piece(const std::vector<double>& stamps_s, const std::map<int, double>& x_of_track) {
  TrackTables tables;
  for (const double stamp_s : stamps_s) {
    FrameRow& frame = tables.frames.emplace_back();
    frame.frame = tables.frames.size();
    frame.stamp_s = stamp_s;
    for (const auto& [id, x_m] : x_of_track) {
      TrackRow& track = tables.tracks.emplace_back();
      track.stamp_s = stamp_s;
      track.track_id = id;
      track.position_m.x() = x_m;
    }
  }
  return tables;
}

std::vector<int> tracksAt(const TrackTables& tables, double stamp_s) {
  std::vector<int> ids;
  for (const TrackRow& row : tables.tracks) {
    if (row.stamp_s == stamp_s) ids.push_back(row.track_id);
  }
  return ids;
}

TEST(Pieces, TakeEachFrameFromOneOfThem) {
  TrackTables whole = piece({1.0, 2.0, 3.0}, {{1, 0.0}});
  const Seam seam = join(whole, piece({2.0, 3.0, 4.0, 5.0}, {{1, 0.0}}));
  std::vector<double> stamps_s;
  std::vector<std::size_t> numbers;
  for (const FrameRow& row : whole.frames) {
    stamps_s.push_back(row.stamp_s);
    numbers.push_back(row.frame);
  }
  EXPECT_THAT(stamps_s, ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0));
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(whole.tracks.size(), 5U);
  EXPECT_EQ(seam.first_frame, 3U);
  EXPECT_EQ(seam.shift, 1);
}

TEST(Pieces, KeepTheNumberOfWhoIsAtTheSamePlace) {
  TrackTables whole = piece({1.0, 2.0}, {{3, 0.0}, {8, 2.0}});
  join(whole, piece({2.0, 3.0}, {{1, 2.01}, {2, 0.02}}));
  EXPECT_THAT(tracksAt(whole, 3.0), ElementsAre(8, 3));
}

TEST(Pieces, PairTheNearestFirst) {
  TrackTables whole = piece({1.0, 2.0}, {{1, 0.0}, {2, 0.2}});
  join(whole, piece({2.0, 3.0}, {{1, 0.19}, {2, 0.01}}));
  EXPECT_THAT(tracksAt(whole, 3.0), ElementsAre(2, 1));
}

TEST(Pieces, GiveNewNumbersToNewTracks) {
  TrackTables whole = piece({1.0, 2.0}, {{1, 0.0}, {4, 5.0}});
  TrackTables next = piece({2.0, 3.0}, {{1, 0.5}});
  next.tracks.push_back(next.tracks.back());
  next.tracks.back().track_id = 4;  // came after the seam
  join(whole, next);
  EXPECT_THAT(tracksAt(whole, 3.0), ElementsAre(5, 6));
}

TEST(Pieces, KeepTheTarget) {
  TrackTables whole = piece({1.0, 2.0}, {{7, 0.0}});
  TrackTables next = piece({2.0, 3.0, 4.0}, {{1, 0.0}});
  next.frames[1].target_id = 1;
  join(whole, next);
  EXPECT_EQ(whole.frames[2].target_id, 7);
  EXPECT_EQ(whole.frames[3].target_id, 0);
}

TEST(Pieces, ThatDoNotOverlapHaveNoTracksInCommon) {
  TrackTables whole = piece({1.0, 2.0}, {{1, 0.0}});
  const Seam seam = join(whole, piece({3.0, 4.0}, {{1, 0.0}}));
  EXPECT_THAT(tracksAt(whole, 3.0), ElementsAre(2));
  EXPECT_EQ(seam.shift, 2) << "it counts from 1 again";
  EXPECT_EQ(whole.frames.back().frame, 4U);
}

TEST(Pieces, ThatCountAsTheWholeDoesKeepTheirNumbers) {
  TrackTables whole = piece({1.0, 2.0}, {});
  TrackTables next = piece({3.0, 4.0}, {});
  for (FrameRow& row : next.frames) row.frame += 5;
  EXPECT_EQ(join(whole, next).shift, 0);
}

TEST(Pieces, MustGoOn) {
  TrackTables whole = piece({1.0, 2.0}, {});
  EXPECT_THROW(join(whole, piece({0.5, 2.0}, {})), std::invalid_argument);
  EXPECT_THROW(join(whole, {}), std::invalid_argument);
  EXPECT_EQ(whole.frames.size(), 2U);
}

}  // namespace
