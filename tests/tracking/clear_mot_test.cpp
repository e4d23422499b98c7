// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/clear_mot.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

LabelledPlace at(int id, double x, double y = 0.0) { return {id, {x, y}}; }

constexpr int kAnna = 100;
constexpr int kBen = 200;

TEST(ClearMot, IsPerfectOnTheTruthItself) {
  const std::vector<TrackingFrame> frames = {
      {{at(kAnna, 0.0), at(kBen, 2.0)}, {at(1, 0.0), at(2, 2.0)}},
      {{at(kAnna, 0.5)}, {at(1, 0.5)}},
      {{}, {}}};
  const ClearMot result = clearMot(frames);
  EXPECT_EQ(result.frames, 3);
  EXPECT_EQ(result.truths, 3);
  EXPECT_EQ(result.matches, 3);
  EXPECT_EQ(result.mota(), 1.0);
  EXPECT_EQ(result.moda(), 1.0);
  EXPECT_EQ(result.motp_m(), 0.0);
}

TEST(ClearMot, CountsMatchAHandDerivedScene) {
  const std::vector<TrackingFrame> frames = {
      // Both matched, 0.1 and 0.2 m off.
      {{at(kAnna, 0.0), at(kBen, 2.0)}, {at(1, 0.1), at(2, 2.0, 0.2)}},
      // They pass: the pairs go on at 0.2 m each, although the other pairing would cost nothing.
      {{at(kAnna, 1.0), at(kBen, 1.2)}, {at(1, 1.2), at(2, 1.0)}},
      // Anna has Ben's id now: a mismatch. Ben is missed; 3 is a false positive.
      {{at(kAnna, 0.0), at(kBen, 3.0)}, {at(2, 0.0), at(3, 5.0, 5.0)}},
      // Anna has her own id again: a second mismatch. Ben is missed.
      {{at(kAnna, 0.0), at(kBen, 3.0)}, {at(1, 0.0)}}};
  const ClearMot result = clearMot(frames);
  EXPECT_EQ(result.truths, 8);
  EXPECT_EQ(result.matches, 6);
  EXPECT_EQ(result.misses, 2);
  EXPECT_EQ(result.false_positives, 1);
  EXPECT_EQ(result.mismatches, 2);
  EXPECT_DOUBLE_EQ(result.mota(), 1.0 - 5.0 / 8.0);
  EXPECT_DOUBLE_EQ(result.moda(), 1.0 - 3.0 / 8.0);
  EXPECT_NEAR(result.motp_m(), 0.7 / 6.0, 1e-12);
  EXPECT_DOUBLE_EQ(result.recall(), 0.75);
  EXPECT_DOUBLE_EQ(result.precision(), 6.0 / 7.0);
}

TEST(ClearMot, CountsASwitchAcrossAnAbsence) {
  const std::vector<TrackingFrame> frames = {{{at(kAnna, 0.0)}, {at(1, 0.0)}},
                                             {{}, {}},
                                             {{at(kAnna, 0.0)}, {}},
                                             {{at(kAnna, 0.0)}, {at(2, 0.0)}}};
  EXPECT_EQ(clearMot(frames).mismatches, 1);
}

TEST(ClearMot, WithoutIdentityEachFrameStandsAlone) {
  const std::vector<TrackingFrame> frames = {
      {{at(kAnna, 0.0), at(kBen, 0.4)}, {at(1, 0.0), at(2, 0.4)}},
      {{at(kAnna, 0.0), at(kBen, 0.4)}, {at(2, 0.0), at(1, 0.4)}}};
  ClearMotParams params;
  params.has_identity = false;
  const ClearMot result = clearMot(frames, params);
  EXPECT_EQ(result.mismatches, 0);
  EXPECT_EQ(result.distance_sum_m, 0.0);
  EXPECT_NEAR(clearMot(frames).distance_sum_m, 0.8, 1e-12);
}

TEST(ClearMot, AnIdGoesOnWithItsLastHolder) {
  const std::vector<TrackingFrame> frames = {{{at(kAnna, 0.0)}, {at(1, 0.0)}},
                                             {{at(kBen, 0.2)}, {at(1, 0.2)}},
                                             // Both could keep id 1; Ben had it last.
                                             {{at(kAnna, 0.3), at(kBen, 0.4)}, {at(1, 0.3)}}};
  const ClearMot result = clearMot(frames);
  EXPECT_EQ(result.mismatches, 0);
  EXPECT_NEAR(result.distance_sum_m, 0.1, 1e-12);
}

TEST(ClearMot, MakesMostPairsBeforeShortestOnes) {
  // The nearest pair (Anna, 2) would leave Ben without.
  const std::vector<TrackingFrame> frames = {
      {{at(kAnna, 0.0), at(kBen, 0.4)}, {at(1, -0.45), at(2, 0.05)}}};
  EXPECT_EQ(clearMot(frames).matches, 2);
}

TEST(ClearMot, MatchesUpToTheDistance) {
  ClearMotParams params;
  params.match_distance_m = 0.75;
  EXPECT_EQ(clearMot({{{at(kAnna, 0.0)}, {at(1, 0.75)}}}, params).matches, 1);
  EXPECT_EQ(clearMot({{{at(kAnna, 0.0)}, {at(1, 0.7501)}}}, params).matches, 0);
}

TEST(ClearMot, SaysNothingAboutNothing) {
  EXPECT_TRUE(std::isnan(clearMot({}).mota()));
  EXPECT_TRUE(std::isnan(clearMot({}).motp_m()));
  EXPECT_TRUE(std::isnan(clearMot({{{at(kAnna, 0.0)}, {}}}).precision()));
}

TEST(ClearMot, RejectsBadInput) {
  ClearMotParams params;
  params.match_distance_m = 0.0;
  EXPECT_THROW(clearMot({}, params), std::invalid_argument);
  EXPECT_THROW(clearMot({{{at(1, 0.0), at(1, 1.0)}, {}}}), std::invalid_argument);
  EXPECT_THROW(clearMot({{{}, {at(1, std::numeric_limits<double>::quiet_NaN())}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace heel
