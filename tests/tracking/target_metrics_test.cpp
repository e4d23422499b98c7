// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/target_metrics.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

using ::testing::ElementsAre;
using Place = std::optional<Eigen::Vector2d>;

Place x(double x_m) { return Eigen::Vector2d(x_m, 0.0); }

/// The target at 0, one other at 5.
TargetFrame frame(double stamp_s, const Place& estimate, bool in_view = true) {
  return {stamp_s, in_view ? x(0.0) : Place(), {*x(5.0)}, estimate, {}, 0.0};
}

TEST(TargetMetrics, JudgesWhomAnEstimateIsOf) {
  EXPECT_EQ(judge(frame(0.0, {})), EstimateOf::kNone);
  EXPECT_EQ(judge(frame(0.0, x(0.5))), EstimateOf::kTarget);
  EXPECT_EQ(judge(frame(0.0, x(0.51))), EstimateOf::kNobody);
  EXPECT_EQ(judge(frame(0.0, x(4.5))), EstimateOf::kWrongPerson);
  EXPECT_EQ(judge(frame(0.0, x(0.0), false)), EstimateOf::kNobody);
  EXPECT_EQ(judge(frame(0.0, x(1.5)), 2.0), EstimateOf::kTarget);
  EXPECT_THROW(judge(frame(0.0, {}), 0.0), std::invalid_argument);
}

TEST(TargetMetrics, CountsMatchAHandDerivedRun) {
  const TargetMetrics m = targetMetrics({frame(0.0, x(0.1)),         // right, 0.1 m off
                                         frame(1.0, x(0.3)),         // right, 0.3 m off
                                         frame(3.0, x(5.0)),         // wrong person for 0.5 s
                                         frame(3.5, x(2.0)),         // nobody
                                         frame(4.0, {}),             // none
                                         frame(5.0, x(5.2), false),  // away: wrong for 1.0 s
                                         frame(6.0, x(0.0), false),  // away: on nobody
                                         frame(7.0, {}, false),      // away, and said so
                                         frame(8.0, x(5.0))});       // wrong, the last frame
  EXPECT_EQ(m.frames, 9);
  EXPECT_EQ(m.frames_in_view, 6);
  EXPECT_EQ(m.right, 2);
  EXPECT_EQ(m.wrong_person, 2);
  EXPECT_EQ(m.nobody, 1);
  EXPECT_EQ(m.none, 1);
  EXPECT_EQ(m.absent_wrong_person, 1);
  EXPECT_EQ(m.absent_nobody, 1);
  EXPECT_DOUBLE_EQ(m.recall(), 2.0 / 6.0);
  EXPECT_DOUBLE_EQ(m.wrongPersonShare(), 2.0 / 6.0);
  EXPECT_DOUBLE_EQ(m.meanError_m(), 0.2);
  EXPECT_DOUBLE_EQ(m.wrong_target_s, 1.5);
  EXPECT_DOUBLE_EQ(m.duration_s, 8.0);
}

TEST(TargetMetrics, MeasuresDelaysFromWhenTheTargetCouldBeHad) {
  const TargetMetrics m = targetMetrics({frame(0.0, {}),          // not acquired yet
                                         frame(1.0, x(0.0)),      // acquired: no delay counted
                                         frame(2.0, {}),          // lost in view ...
                                         frame(3.0, x(5.0)),      //
                                         frame(4.0, x(0.0)),      // ... back after 2 s
                                         frame(5.0, {}, false),   // away
                                         frame(6.0, {}),          // in view again ...
                                         frame(6.5, x(0.0)),      // ... back after 0.5 s
                                         frame(7.0, {}, false),   // away
                                         frame(8.0, x(0.0)),      // at once: 0 s
                                         frame(9.0, {}),          // lost in view ...
                                         frame(10.0, {}, false),  // ... and left: not reacquired
                                         frame(11.0, {})});       // the end: not reacquired
  EXPECT_THAT(m.reacquisition_delays_s, ElementsAre(2.0, 0.5, 0.0));
  EXPECT_EQ(m.not_reacquired, 2);
  EXPECT_DOUBLE_EQ(m.meanReacquisitionDelay_s(), 2.5 / 3.0);
  EXPECT_DOUBLE_EQ(m.longestReacquisitionDelay_s(), 2.0);
}

TEST(TargetMetrics, SaysWhenSomebodyElseIsNearer) {
  TargetFrame close = frame(0.0, x(0.3));
  close.others_m = {*x(0.4)};
  EXPECT_EQ(targetMetrics({close}).right, 1);
  EXPECT_EQ(targetMetrics({close}).contested, 1);
  close.others_m = {*x(0.7)};
  EXPECT_EQ(targetMetrics({close}).contested, 0);
}

TEST(TargetMetrics, CountsTheFramesWithoutTheTarget) {
  const TargetMetrics m = targetMetrics({frame(0.0, x(0.1)),         // right
                                         frame(1.0, {}),             // silent, wrongly
                                         frame(2.0, x(5.2), false),  // claimed of somebody else,
                                         frame(3.0, x(0.0), false),  // of nobody,
                                         frame(4.0, {}, false),      // or rightly not
                                         frame(5.0, {}, false)});
  EXPECT_DOUBLE_EQ(m.claimedShare(), 0.5);
  EXPECT_DOUBLE_EQ(m.rightAnswerShare(), 0.5);
}

TEST(TargetMetrics, ComparesProbabilitiesWithWhatIsSo) {
  const auto said = [](double stamp_s, double x_m, double probability, bool in_view) {
    TargetFrame result = frame(stamp_s, {}, in_view);
    result.likeliest_m = x(x_m);
    result.probability = probability;
    return result;
  };
  const Reliability r = targetMetrics({said(0.0, 0.1, 0.95, true),   // so
                                       said(1.0, 0.1, 0.95, false),  // not so: it is away
                                       said(2.0, 3.0, 0.25, true),   // not so: elsewhere
                                       said(3.0, 0.0, 1.0, true)})
                            .reliability;
  EXPECT_EQ(r.bins[9].count, 3);
  EXPECT_EQ(r.bins[9].right, 2);
  EXPECT_DOUBLE_EQ(r.bins[9].said, 2.9);
  EXPECT_EQ(r.bins[2].count, 1);
  EXPECT_DOUBLE_EQ(r.expectedError(), (0.9 + 0.25) / 4.0);
  Reliability twice = r;
  twice.add(r);
  EXPECT_EQ(twice.bins[9].count, 6);
  EXPECT_DOUBLE_EQ(twice.expectedError(), r.expectedError());
  EXPECT_TRUE(std::isnan(Reliability().expectedError()));
  EXPECT_TRUE(std::isnan(Reliability().errorByChance()));
  EXPECT_THROW(twice.add(1.1, true), std::invalid_argument);
  EXPECT_THROW(twice.add(std::nan(""), true), std::invalid_argument);
}

TEST(Reliability, TellsTheErrorThatChanceMakes) {
  Reliability r;
  for (int i = 0; i < 3; ++i) r.add(0.25, false);
  // Of 0 to 3 that are so, each off by its distance from 0.75.
  const double p[] = {27.0 / 64, 27.0 / 64, 9.0 / 64, 1.0 / 64};
  const double off = 0.75 * p[0] + 0.25 * p[1] + 1.25 * p[2] + 2.25 * p[3];
  EXPECT_NEAR(r.errorByChance(), off / 3.0, 1e-12);
  r.add(1.0, true);  // What is certain has no chance.
  EXPECT_NEAR(r.errorByChance(), off / 4.0, 1e-12);
}

TEST(TargetMetrics, SaysNothingAboutNothing) {
  const TargetMetrics m = targetMetrics({});
  EXPECT_TRUE(std::isnan(m.recall()));
  EXPECT_TRUE(std::isnan(m.wrongPersonShare()));
  EXPECT_TRUE(std::isnan(m.meanError_m()));
  EXPECT_TRUE(std::isnan(m.meanReacquisitionDelay_s()));
}

TEST(TargetMetrics, RejectsStampsThatDoNotIncrease) {
  EXPECT_THROW(targetMetrics({frame(1.0, {}), frame(1.0, {})}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
