// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/evaluate/evaluation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

TrackRow track(double stamp_s, int id, bool is_target, double x_m) {
  TrackRow row;
  row.stamp_s = stamp_s;
  row.track_id = id;
  row.is_target = is_target;
  row.position_m = {x_m, 0.0};
  return row;
}

TruthRow person(double stamp_s, const char* name, double x_m) {
  TruthRow row;
  row.stamp_s = stamp_s;
  row.person = name;
  row.position_m = {x_m, 0.0};
  return row;
}

TEST(AlignByStamp, PutsRowsOfOneMomentTogetherInOrderOfTime) {
  const auto moments = alignByStamp({track(0.2, 1, true, 1), track(0.0, 1, true, 1)},
                                    {person(0.205, "ann", 1), person(0.4, "ann", 1)});
  ASSERT_EQ(moments.size(), 3U);
  EXPECT_EQ(moments[0].tracks.size(), 1U);
  EXPECT_EQ(moments[0].truth.size(), 0U);
  EXPECT_EQ(moments[1].tracks.size(), 1U);
  EXPECT_EQ(moments[1].truth.size(), 1U);
  EXPECT_EQ(moments[2].truth.size(), 1U);
}

TEST(AlignByStamp, HasAMomentForEachFrameAndNoOther) {
  const auto moments = alignByStamp({track(0.2, 1, true, 1)},
                                    {person(0.205, "ann", 1), person(0.4, "ann", 1)}, {0.1, 0.2});
  ASSERT_EQ(moments.size(), 2U);
  EXPECT_TRUE(moments[0].tracks.empty() && moments[0].truth.empty()) << "nobody was there";
  EXPECT_TRUE(moments[1].tracks.size() == 1 && moments[1].truth.size() == 1);
}

TEST(Evaluate, CountsFramesWithoutAnybodyAsRightlySilent) {
  const auto figures = evaluate(
      alignByStamp({track(1, 1, true, 1)}, {person(1, "ann", 1), person(9, "ann", 1)}, {0, 1, 2}));
  EXPECT_EQ(figures.person.frames, 3);
  EXPECT_EQ(figures.person.frames_in_view, 1) << "at 9 s nobody looked";
  EXPECT_EQ(figures.person.recall(), 1.0);
  EXPECT_EQ(figures.person.rightAnswerShare(), 1.0);
}

// Ann is at 1 m, Bob at 3 m. The target's track is on Ann, then on Bob, then nowhere; a second
// track stays on Bob for the first two moments.
std::vector<Moment> annThenBobThenNobody() {
  return alignByStamp({track(0, 1, true, 1.1), track(0, 2, false, 3), track(1, 1, true, 3.1),
                       track(1, 2, false, 3)},
                      {person(0, "ann", 1), person(0, "bob", 3), person(1, "ann", 1),
                       person(1, "bob", 3), person(2, "ann", 1), person(2, "bob", 3)});
}

TEST(Evaluate, TakesTheFirstPersonForTheTarget) {
  const Evaluation result = evaluate(annThenBobThenNobody());
  EXPECT_EQ(result.target, "ann");
  EXPECT_DOUBLE_EQ(result.person.recall(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(result.person.wrongPersonShare(), 1.0 / 3.0);
}

TEST(Evaluate, JudgesAnyPersonAsTheTarget) {
  EvaluationParams params;
  params.target = "bob";
  EXPECT_DOUBLE_EQ(evaluate(annThenBobThenNobody(), params).person.recall(), 1.0 / 3.0);
}

TEST(Evaluate, CountsAllTracksAgainstAllPeople) {
  const ClearMot people = evaluate(annThenBobThenNobody()).people;
  EXPECT_EQ(people.truths, 6);
  EXPECT_EQ(people.matches, 3);
  EXPECT_EQ(people.misses, 3);
  EXPECT_EQ(people.false_positives, 1);
}

TEST(Evaluate, LeavesOutTracksOfThings) {
  auto moments = annThenBobThenNobody();
  for (Moment& moment : moments) {
    for (TrackRow& row : moment.tracks) row.person_probability = 0.1;
  }
  const Evaluation result = evaluate(moments);
  EXPECT_EQ(result.people.matches, 2) << "the target is a person, whatever else is said";
  EXPECT_EQ(result.people.false_positives, 0);
  EXPECT_EQ(result.things, 2);
}

TEST(Evaluate, SaysThatTracksAndTruthHaveNothingInCommon) {
  const auto apart = alignByStamp({track(5, 1, true, 1)}, {person(0, "ann", 1)});
  EXPECT_THROW(evaluate(apart), std::runtime_error);
  const auto nobody_tracked = alignByStamp({}, {person(0, "ann", 1)});
  EXPECT_EQ(evaluate(nobody_tracked).person.recall(), 0.0);
}

TEST(Evaluate, LooksOnlyAtTheGivenTime) {
  EvaluationParams params;
  params.to_s = 0.5;
  EXPECT_DOUBLE_EQ(evaluate(annThenBobThenNobody(), params).person.recall(), 1.0);
}

TEST(Evaluate, SaysWhoIsNotInTheTruth) {
  EvaluationParams params;
  params.target = "eve";
  try {
    evaluate(annThenBobThenNobody(), params);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("there is no 'eve' in the truth"));
  }
  EXPECT_THROW(evaluate({}), std::runtime_error);
}

}  // namespace
}  // namespace heel
