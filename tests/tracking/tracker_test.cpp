// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/tracking/looks.hpp"
#include <heel/tracking/tracker.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace heel {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kDt_s = 0.2;

Observation seen(double x, double y, double score = 10.0) {
  return test::seen(x, y, nullptr, score);
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

TEST(Tracker, LooksTellTwoPeopleApartAtOnePlace) {
  const auto step = [](double log_likelihood) {
    Tracker tracker;
    for (int k = 0; k < 5; ++k) {
      tracker.step(kDt_s * k, {seen(1.0, 0.0, 11.0), seen(1.6, 0.0, 10.0)});
    }
    // Both jump to the middle between their places and beyond it.
    const TrackerReport& report = tracker.step(
        1.0, {seen(1.27, 0.0), seen(1.33, 0.0)}, {}, [=](int track_id, int observation) {
          return track_id == 2 - observation ? log_likelihood : -log_likelihood;
        });
    return report.uses[0].track_id;
  };
  EXPECT_EQ(step(0.0), 1);
  EXPECT_EQ(step(2.0), 2);
  EXPECT_EQ(step(-2.0), 1);
}

TEST(Tracker, AsksForTheLooksOfPairsThatCanBeOnly) {
  Tracker tracker;
  for (int k = 0; k < 3; ++k) {
    tracker.step(kDt_s * k, {seen(1.0, 0.0, 11.0), seen(5.0, 0.0, 10.0)});
  }
  std::vector<std::pair<int, int>> asked;
  tracker.step(0.6, {seen(5.0, 0.0), seen(9.0, 0.0), seen(1.0, 0.0)}, {},
               [&](int track_id, int observation) {
                 asked.emplace_back(track_id, observation);
                 return 0.0;
               });
  EXPECT_THAT(asked, ElementsAre(std::pair(1, 2), std::pair(2, 0)));
}

TEST(Tracker, SaysWhichTracksMayHaveSwappedTheirObservations) {
  const auto swapsAfter = [](double apart_m, std::vector<Observation> last,
                             const Tracker::LookLikelihood& looks = {}) {
    Tracker tracker;
    for (int i = 0; i < 20; ++i) tracker.step(kDt_s * i, {seen(0, 0), seen(apart_m, 0)});
    EXPECT_EQ(tracker.tracks().size(), 2U);
    return tracker.step(kDt_s * 20, last, {}, looks).swaps;
  };
  EXPECT_THAT(swapsAfter(2.0, {seen(0, 0), seen(2, 0)}), IsEmpty());
  const std::vector<Swap> even = swapsAfter(0.5, {seen(0.25, 0.1), seen(0.25, -0.1)});
  ASSERT_EQ(even.size(), 1U);
  EXPECT_EQ(even[0].track_a, 1);
  EXPECT_EQ(even[0].track_b, 2);
  EXPECT_NEAR(even[0].probability, 0.5, 1e-9);
  const std::vector<Swap> one = swapsAfter(0.5, {seen(0.25, 0)});
  ASSERT_EQ(one.size(), 1U) << "the other is unseen";
  EXPECT_NEAR(one[0].probability, 0.5, 1e-9);
  const auto knows = [](int track, int observation) {
    return track == 1 + observation ? std::log(9.0) : 0.0;
  };
  const std::vector<Swap> known = swapsAfter(0.5, {seen(0.25, 0.1), seen(0.25, -0.1)}, knows);
  ASSERT_EQ(known.size(), 1U);
  EXPECT_NEAR(known[0].probability, 1.0 / 82.0, 1e-9) << "each look nine times likelier";
}

TEST(Tracker, SaysThatWhoAppearsBesideSomebodyMayBeThem) {
  Tracker tracker;
  for (int i = 0; i < 10; ++i) tracker.step(kDt_s * i, {seen(0, 0)});
  const std::vector<Swap> even = tracker.step(kDt_s * 10, {seen(0.25, 0), seen(-0.25, 0)}).swaps;
  ASSERT_EQ(even.size(), 1U);
  EXPECT_EQ(even[0].track_a, 1);
  EXPECT_EQ(even[0].track_b, 2);
  EXPECT_NEAR(even[0].probability, 0.5, 1e-9);

  Tracker surer;
  for (int i = 0; i < 10; ++i) surer.step(kDt_s * i, {seen(0, 0)});
  EXPECT_THAT(surer.step(kDt_s * 10, {seen(0, 0), seen(2, 0)}).swaps, IsEmpty());
}

// Two walk towards each other, are observed as one for two frames, and as two again.
TEST(Tracker, WhoWereObservedAsOneMayHaveSwapped) {
  Tracker tracker;
  double stamp_s = 0.0;
  for (double x = 1.5; x > 0.3; x -= 0.2) {
    tracker.step(stamp_s += kDt_s, {seen(x, 0), seen(-x, 0)});
  }
  for (int i = 0; i < 2; ++i) tracker.step(stamp_s += kDt_s, {seen(0, 0)});
  const std::vector<Swap> swaps =
      tracker.step(stamp_s += kDt_s, {seen(0.3, 0), seen(-0.3, 0)}).swaps;
  ASSERT_EQ(swaps.size(), 1U);
  EXPECT_GT(swaps[0].probability, 0.15) << "0.09 if the place of both were as sure as of one";
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
  const auto fate = [](double log_likelihood) {
    Tracker tracker;
    for (int k = 0; k < 5; ++k) {
      tracker.step(kDt_s * k, {seen(1.0, 0.0)});
    }
    return tracker.step(1.0, {seen(1.0, 0.0)}, {}, [=](int, int) { return log_likelihood; })
        .uses[0]
        .fate;
  };
  EXPECT_EQ(fate(std::log(0.05)), ObservationFate::kUpdated);  // Into the shade.
  EXPECT_EQ(fate(-20.0), ObservationFate::kBorn) << "but somebody else they can be";
}

TEST(Tracker, APairIsLeftExactlyWhereANewcomerIsLikelier) {
  TrackerParams params;
  Tracker before(params);
  for (int k = 0; k < 5; ++k) before.step(kDt_s * k, {seen(1.0, 0.0)});
  const MotionState expected = predict(before.tracks().front().motion, 0.2, params.motion);
  const Eigen::Matrix2d noise = Eigen::Matrix2d::Identity() * 0.12 * 0.12;
  const double density = std::exp(logLikelihood(innovation(expected, {1.05, 0.0}, noise)));
  // detection * density * looks = (1 - detection) * newcomers there.
  const double even = std::log(0.1 * params.new_density_per_m2 / (0.9 * density));
  for (const bool leave : {false, true}) {
    Tracker tracker = before;
    const double looks = even + (leave ? -1e-6 : 1e-6);
    tracker.step(1.0, {seen(1.05, 0.0)}, {}, [=](int, int) { return looks; });
    EXPECT_EQ(tracker.tracks().front().observation == Track::kUnseen, leave);
  }
}

TEST(Tracker, AnObservationsOwnCovarianceAddsToTheTrackers) {
  TrackerParams blunt_params;
  blunt_params.position_sigma_m = 0.2;
  Tracker sharp, blunt(blunt_params);  // 0.12 m and 0.16 m together are 0.2 m.
  for (int k = 0; k < 10; ++k) {
    Observation unsure = seen(0.1 * k, 0.03 * (k % 3));
    blunt.step(kDt_s * k, {unsure});
    unsure.covariance_m2 = Eigen::Matrix2d::Identity() * 0.16 * 0.16;
    sharp.step(kDt_s * k, {unsure});
    ASSERT_EQ(sharp.tracks().size(), 1U);
    const MotionState &a = sharp.tracks().front().motion, &b = blunt.tracks().front().motion;
    ASSERT_TRUE(a.mean.isApprox(b.mean, 1e-9));
    ASSERT_TRUE(a.covariance.isApprox(b.covariance, 1e-9));
  }
}

TEST(Tracker, IsUnsureInTheDirectionInWhichAnObservationIs) {
  Tracker tracker;
  Observation deep = seen(4.0, 0.0);
  deep.covariance_m2 = Eigen::Vector2d(0.25, 0.0).asDiagonal();
  tracker.step(0.0, {deep});
  const Eigen::Matrix4d& covariance = tracker.tracks().front().motion.covariance;
  EXPECT_NEAR(covariance(0, 0), 0.25 + 0.12 * 0.12, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.12 * 0.12, 1e-12);
  EXPECT_EQ(tracker.step(0.2, {seen(4.8, 0.0)}).uses[0].fate, ObservationFate::kUpdated);
}

TEST(Tracker, SaysHowWellItForetoldAnObservation) {
  Tracker tracker;
  tracker.step(0.0, {seen(1.0, 0.0)});
  EXPECT_EQ(tracker.tracks().front().density_per_m2, 0.0) << "nothing was foretold";
  const MotionState expected = predict(tracker.tracks().front().motion, 0.2, {});
  tracker.step(0.2, {seen(1.1, 0.1)});
  const Eigen::Matrix2d noise = Eigen::Matrix2d::Identity() * 0.12 * 0.12;
  EXPECT_NEAR(tracker.tracks().front().density_per_m2,
              std::exp(logLikelihood(innovation(expected, {1.1, 0.1}, noise))), 1e-9);
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
                         0.6 * person + noise(random)));
    }
    all.push_back(all.front());                                    // Equal ones as well,
    all.push_back(seen(anywhere(random), anywhere(random), 3.0));  // and clutter.
    const auto looks = [&](int track_id, int i) {
      return std::sin(track_id + 10.0 * all[static_cast<std::size_t>(i)].position_m.y());
    };
    straight.step(kDt_s * k, all, {}, looks);
    std::shuffle(all.begin(), all.end(), random);
    shuffled.step(kDt_s * k, all, {}, looks);
    ASSERT_EQ(straight.tracks().size(), shuffled.tracks().size());
    for (std::size_t i = 0; i < straight.tracks().size(); ++i) {
      const Track &a = straight.tracks()[i], &b = shuffled.tracks()[i];
      ASSERT_EQ(a.id, b.id);
      ASSERT_EQ(a.status, b.status);
      ASSERT_EQ(a.motion.mean, b.motion.mean);
      ASSERT_EQ(a.motion.covariance, b.motion.covariance);
      ASSERT_EQ(a.density_per_m2, b.density_per_m2);
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
  Observation unsure = seen(2, 1);
  unsure.covariance_m2(0, 0) = nan;
  const std::vector<Observation> all = {seen(0.1, 0), seen(4, 0),   seen(2, 0), seen(9, 0),
                                        seen(3.5, 1), seen(nan, 0), unsure};
  const TrackerReport& report = tracker.step(0.0, all);
  EXPECT_EQ(report.verdictCount(GateVerdict::kTooClose), 1);
  EXPECT_EQ(report.verdictCount(GateVerdict::kBehindWall), 2);
  EXPECT_EQ(report.verdictCount(GateVerdict::kOutOfBounds), 1);
  EXPECT_EQ(report.verdictCount(GateVerdict::kNotFinite), 2);
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
  Observation little = seen(2.0, 0.0);
  little.can_start = false;
  EXPECT_EQ(tracker.step(0.0, {little}).uses.at(0).fate, ObservationFate::kTooLittle);
  EXPECT_TRUE(tracker.tracks().empty());
  Observation enough = little;
  enough.can_start = true;
  EXPECT_EQ(tracker.step(0.1, {enough}).uses.at(0).fate, ObservationFate::kBorn);
  EXPECT_EQ(tracker.step(0.2, {little}).uses.at(0).fate, ObservationFate::kUpdated);
}

}  // namespace
}  // namespace heel
