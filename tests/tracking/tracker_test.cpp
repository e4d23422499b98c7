// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/tracker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kDt_s = 0.2;

Observation seen(double x, double y, double score = 10.0, double appearance = 0.5) {
  return {{x, y}, score, appearance};
}

TEST(Tracker, ConfirmsATrackSeenOftenEnough) {
  Tracker tracker;
  EXPECT_EQ(tracker.step(0.0, {seen(1, 0)}).born, 1);
  EXPECT_EQ(tracker.tracks().front().status, TrackStatus::kTentative);
  EXPECT_EQ(tracker.step(0.2, {}).updated, 0);
  EXPECT_EQ(tracker.step(0.4, {seen(1, 0)}).updated, 1);  // 2 of 3
  EXPECT_EQ(tracker.tracks().front().status, TrackStatus::kConfirmed);
  EXPECT_EQ(tracker.tracks().front().id, 1);
}

TEST(Tracker, DropsATrackNotSeenOftenEnough) {
  Tracker tracker;
  tracker.step(0.0, {seen(1, 0)});
  tracker.step(0.2, {});
  EXPECT_EQ(tracker.tracks().size(), 1U);
  const TrackerReport& report = tracker.step(0.4, {});
  EXPECT_THAT(tracker.tracks(), IsEmpty());
  EXPECT_THAT(report.lost, IsEmpty());  // It was never believed.
}

TEST(Tracker, CoastsThenLosesAndNeverUsesAnIdAgain) {
  TrackerParams params;
  params.max_coast_s = 0.5;
  Tracker tracker(params);
  tracker.step(0.0, {seen(1.0, 0)});
  tracker.step(0.2, {seen(1.1, 0)});
  tracker.step(0.4, {});
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.tracks().front().status, TrackStatus::kCoasting);
  EXPECT_GT(tracker.tracks().front().motion.mean.x(), 1.1);  // It walks on.
  tracker.step(0.6, {});
  EXPECT_THAT(tracker.step(0.8, {}).lost, ElementsAre(1));
  EXPECT_THAT(tracker.tracks(), IsEmpty());
  tracker.step(1.0, {seen(1.0, 0)});
  EXPECT_EQ(tracker.tracks().front().id, 2);
}

TEST(Tracker, KeepsTwoPeopleApartWhoCross) {
  Tracker tracker;
  int right_goer = 0, left_goer = 0;
  for (int k = 0; k <= 30; ++k) {
    // Along x towards each other at 1 m/s, 0.3 m apart in y.
    const double along = 0.2 * k;
    const TrackerReport& report =
        tracker.step(kDt_s * k, {seen(along, 0.0), seen(6.0 - along, 0.3)});
    if (k == 0) {
      right_goer = report.uses[0].track_id;
      left_goer = report.uses[1].track_id;
    }
    ASSERT_EQ(report.uses[0].track_id, right_goer) << "frame " << k;
    ASSERT_EQ(report.uses[1].track_id, left_goer) << "frame " << k;
  }
  EXPECT_EQ(tracker.tracks().size(), 2U);
}

TEST(Tracker, CarriesAnIdThroughAnOcclusion) {
  Tracker tracker;
  for (int k = 0; k <= 25; ++k) {
    const bool hidden = k >= 10 && k < 15;
    std::vector<Observation> all;
    if (!hidden) {
      all.push_back(seen(0.15 * k, 1.0));
    }
    tracker.step(kDt_s * k, all);
  }
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.tracks().front().id, 1);
  EXPECT_NEAR(tracker.tracks().front().motion.mean.x(), 0.15 * 25, 0.05);
}

TEST(Tracker, LosesThePersonWhoLeavesAndKeepsTheOther) {
  Tracker tracker;
  for (int k = 0; k <= 30; ++k) {
    std::vector<Observation> all = {seen(2.0, 2.0, 10.0)};
    if (k < 10) {
      all.push_back(seen(2.0, -2.0, 9.0));
    }
    tracker.step(kDt_s * k, all);
  }
  ASSERT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.tracks().front().id, 1);  // The higher score is started first.
}

TEST(Tracker, PrefersTheHigherScoreOfSeveralThatCompete) {
  Tracker tracker;
  tracker.step(0.0, {seen(1, 0)});
  tracker.step(0.2, {seen(1, 0)});
  const TrackerReport& report = tracker.step(0.4, {seen(1.05, 0, 2.0), seen(0.93, 0, 20.0)});
  EXPECT_EQ(report.uses[1].fate, ObservationFate::kUpdated);
  EXPECT_EQ(report.uses[0].fate, ObservationFate::kFragment);
  EXPECT_EQ(report.uses[0].track_id, 1);
}

TEST(Tracker, EachObservationIsExplainedByItsOwnTrack) {
  // The confuser stays where the target would be predicted to go; only one of them is seen.
  Tracker tracker;
  for (int k = 0; k < 10; ++k) {
    tracker.step(kDt_s * k, {seen(0.1 * k, 0.0, 10.0), seen(1.1, 0.35, 10.0)});
  }
  const TrackerReport& report = tracker.step(2.0, {seen(1.1, 0.35)});
  const Track* confuser = tracker.findTrack(report.uses[0].track_id);
  ASSERT_NE(confuser, nullptr);
  EXPECT_NEAR(confuser->motion.velocity_mps().norm(), 0.0, 0.05);
  const Track* target = tracker.findTrack(3 - confuser->id);
  ASSERT_NE(target, nullptr);
  EXPECT_EQ(target->status, TrackStatus::kCoasting);
}

TEST(Tracker, AppearanceTellsTwoPeopleApartAtOnePlace) {
  Tracker tracker;
  for (int k = 0; k < 5; ++k) {
    tracker.step(kDt_s * k, {seen(1.0, 0.0, 11.0, 0.9), seen(1.6, 0.0, 10.0, 0.1)});
  }
  // Both jump to the middle between their places and beyond it; colour says who is who.
  const TrackerReport& report =
      tracker.step(1.0, {seen(1.27, 0.0, 10.0, 0.1), seen(1.33, 0.0, 10.0, 0.9)});
  EXPECT_EQ(report.uses[0].track_id, 2);
  EXPECT_EQ(report.uses[1].track_id, 1);
}

TEST(Tracker, TentativeTracksTakeWhatTheOthersLeave) {
  TrackerParams params;
  params.motion.velocity_memory_s = 0.1;  // Nobody is expected to go anywhere.
  params.motion.acceleration_density = 0.01;
  params.start_speed_sigma_mps = 0.1;
  Tracker tracker(params);
  tracker.step(0.0, {seen(0, 0)});
  tracker.step(0.2, {seen(0, 0)});
  const TrackerReport& report = tracker.step(0.4, {seen(0.7, 0)});
  ASSERT_EQ(report.born, 1);  // Too far for track 1, which coasts.
  // Nearer to the young track's place than to the confirmed one's, which chooses first.
  EXPECT_EQ(tracker.step(0.6, {seen(0.36, 0)}).uses[0].track_id, 1);
}

TEST(Tracker, UnlikeLooksAloneDoNotPartAPersonFromTheirTrack) {
  Tracker tracker;
  for (int k = 0; k < 5; ++k) {
    tracker.step(kDt_s * k, {seen(1.0, 0.0, 10.0, 0.9)});
  }
  // Into the shade: the appearance falls to a tenth.
  EXPECT_EQ(tracker.step(1.0, {seen(1.0, 0.0, 10.0, 0.09)}).uses[0].track_id, 1);
}

TEST(Tracker, AveragesAppearanceOverTimeWhateverTheFrameRate) {
  TrackerParams params;
  params.appearance_memory_s = 0.5;
  for (const int frames : {5, 10, 30}) {
    Tracker tracker(params);
    tracker.step(0.0, {seen(1, 0, 10.0, 0.4)});
    for (int k = 1; k <= frames; ++k) {
      tracker.step(1.0 * k / frames, {seen(1, 0, 10.0, 0.8)});
    }
    // e^-2 of the logarithm's first value is left after two time constants.
    EXPECT_NEAR(tracker.tracks().front().log_appearance,
                std::log(0.8) + (std::log(0.4) - std::log(0.8)) * std::exp(-2.0), 1e-12);
  }
}

TEST(Tracker, AddsAndConfirmsTracksOnRequest) {
  Tracker tracker;
  EXPECT_THROW(tracker.addTrack({0.0, 0.0}), std::logic_error);
  tracker.step(0.0, {seen(1, 0)});
  const int added = tracker.addTrack({3.0, 0.0});
  EXPECT_EQ(tracker.findTrack(added)->status, TrackStatus::kCoasting);
  tracker.confirmTrack(1);
  EXPECT_EQ(tracker.findTrack(1)->status, TrackStatus::kConfirmed);
  EXPECT_EQ(tracker.step(0.2, {seen(3.1, 0)}).uses[0].track_id, added);
  EXPECT_EQ(tracker.findTrack(99), nullptr);
  EXPECT_THROW(tracker.confirmTrack(99), std::invalid_argument);
  EXPECT_THROW(tracker.addTrack({std::nan(""), 0.0}), std::invalid_argument);
}

TEST(Tracker, TheOrderOfObservationsHasNoInfluence) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.08);
  std::uniform_real_distribution<double> anywhere(0.0, 5.0);
  Tracker straight, shuffled;
  for (int k = 0; k < 100; ++k) {
    std::vector<Observation> all;
    for (int person = 0; person < 5; ++person) {
      all.push_back(seen(2.5 + 2.0 * std::sin(0.1 * k + person) + noise(random),
                         0.6 * person + noise(random), 10.0, 0.2 * person));
    }
    all.push_back(all.front());                                         // Equal ones as well,
    all.push_back(seen(anywhere(random), anywhere(random), 3.0, 0.0));  // and clutter.
    straight.step(kDt_s * k, all);
    std::shuffle(all.begin(), all.end(), random);
    shuffled.step(kDt_s * k, all);
    ASSERT_EQ(straight.tracks().size(), shuffled.tracks().size());
    for (std::size_t i = 0; i < straight.tracks().size(); ++i) {
      const Track &a = straight.tracks()[i], &b = shuffled.tracks()[i];
      ASSERT_EQ(a.id, b.id);
      ASSERT_EQ(a.status, b.status);
      ASSERT_EQ(a.motion.mean, b.motion.mean);
      ASSERT_EQ(a.motion.covariance, b.motion.covariance);
      ASSERT_EQ(a.log_appearance, b.log_appearance);
    }
  }
}

TEST(Tracker, CountsWhatTheGateRejectsAndWhy) {
  const GeometricGate wall_at_3 = [](const Observation& o, const Viewpoint& from) {
    return o.position_m.x() > 3.0 && from.position_m.x() < 3.0 ? GateVerdict::kBehindWall
                                                               : GateVerdict::kAccepted;
  };
  Tracker tracker({}, allOf({tooClose(0.4), insideBounds({-5, -5}, {5, 5}), wall_at_3}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Observation> all = {seen(0.1, 0), seen(4, 0),   seen(2, 0),
                                        seen(9, 0),   seen(3.5, 1), seen(nan, 0)};
  const TrackerReport& report = tracker.step(0.0, all);
  EXPECT_EQ(report.verdictCount(GateVerdict::kTooClose), 1);
  EXPECT_EQ(report.verdictCount(GateVerdict::kBehindWall), 2);
  EXPECT_EQ(report.verdictCount(GateVerdict::kOutOfBounds), 1);
  EXPECT_EQ(report.verdictCount(GateVerdict::kNotFinite), 1);
  EXPECT_EQ(report.verdictCount(GateVerdict::kAccepted), 1);
  EXPECT_EQ(report.born, 1);
  EXPECT_EQ(report.uses[1].fate, ObservationFate::kRejected);
  EXPECT_EQ(report.uses[1].verdict, GateVerdict::kBehindWall);
  EXPECT_EQ(report.uses[2].fate, ObservationFate::kBorn);
}

TEST(Tracker, ATrackIsNotUpdatedFromBehindTheWall) {
  const GeometricGate wall_at_3 = [](const Observation& o, const Viewpoint&) {
    return o.position_m.x() > 3.0 ? GateVerdict::kBehindWall : GateVerdict::kAccepted;
  };
  Tracker tracker({}, wall_at_3);
  for (int k = 0; k < 6; ++k) {
    tracker.step(kDt_s * k, {seen(2.0 + 0.2 * k, 0.0)});
  }
  const Track& track = tracker.tracks().front();
  EXPECT_EQ(track.status, TrackStatus::kConfirmed);  // At 3.0 m, the last place before the wall.
  tracker.step(1.2, {seen(3.2, 0.0)});
  EXPECT_EQ(tracker.tracks().front().status, TrackStatus::kCoasting);
}

TEST(Tracker, SkipsAFrameWhoseStampIsNotLater) {
  Tracker tracker;
  tracker.step(1.0, {seen(1, 0)});
  const TrackerReport& report = tracker.step(1.0, {seen(1, 0), seen(3, 0)});
  EXPECT_EQ(report.status, StepStatus::kSkipped);
  EXPECT_EQ(report.uses.size(), 2U);
  EXPECT_EQ(report.uses[0].fate, ObservationFate::kIgnored);
  EXPECT_EQ(tracker.step(0.5, {seen(3, 0)}).status, StepStatus::kSkipped);
  EXPECT_EQ(tracker.tracks().size(), 1U);
  EXPECT_EQ(tracker.step(1.2, {seen(1, 0)}).status, StepStatus::kRegular);
  EXPECT_DOUBLE_EQ(tracker.report().dt_s, 0.2);
}

TEST(Tracker, LosesAllTracksInALongGap) {
  Tracker tracker;
  tracker.step(0.0, {seen(1, 0)});
  tracker.step(0.2, {seen(1, 0)});
  const TrackerReport& report = tracker.step(60.0, {seen(1, 0)});
  EXPECT_EQ(report.status, StepStatus::kGap);
  EXPECT_THAT(report.lost, ElementsAre(1));
  EXPECT_EQ(tracker.tracks().front().id, 2);
}

TEST(Tracker, StartsAnewWhenTheClockWasSetBack) {
  Tracker tracker;
  tracker.step(1000.0, {seen(1, 0)});
  tracker.step(1000.2, {seen(1, 0)});
  EXPECT_EQ(tracker.step(0.0, {seen(1, 0)}).status, StepStatus::kGap);
  EXPECT_EQ(tracker.step(0.2, {seen(1, 0)}).status, StepStatus::kRegular);
  EXPECT_EQ(tracker.tracks().front().id, 2);
}

TEST(Tracker, RejectsAStampThatIsNoNumber) {
  Tracker tracker;
  EXPECT_THROW(tracker.step(std::numeric_limits<double>::infinity(), {}), std::invalid_argument);
}

TEST(Tracker, NamesTheParameterThatIsOutOfRange) {
  const auto text = [](auto change) {
    TrackerParams params;
    change(params);
    try {
      Tracker tracker(params);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(text([](TrackerParams&) {}), "accepted");
  EXPECT_THAT(text([](TrackerParams& p) { p.gate_prob = 1.0; }), ::testing::HasSubstr("gate_prob"));
  EXPECT_THAT(text([](TrackerParams& p) { p.position_sigma_m = 0.0; }),
              ::testing::HasSubstr("position_sigma_m"));
  EXPECT_THAT(text([](TrackerParams& p) { p.confirm_hits = 4; }),
              ::testing::HasSubstr("confirm_hits"));
  EXPECT_THAT(text([](TrackerParams& p) { p.max_coast_s = -1.0; }),
              ::testing::HasSubstr("max_coast_s"));
}

TEST(Tracker, ContinuesButDoesNotStartOnTooLittle) {
  Tracker tracker;
  Observation little{{2.0, 0.0}, 10.0, 0.5, false};
  EXPECT_EQ(tracker.step(0.0, {little}).uses.at(0).fate, ObservationFate::kTooLittle);
  EXPECT_TRUE(tracker.tracks().empty());
  Observation enough = little;
  enough.can_start = true;
  EXPECT_EQ(tracker.step(0.1, {enough}).uses.at(0).fate, ObservationFate::kBorn);
  EXPECT_EQ(tracker.step(0.2, {little}).uses.at(0).fate, ObservationFate::kUpdated);
}

}  // namespace
}  // namespace heel
