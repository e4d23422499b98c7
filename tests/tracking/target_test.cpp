// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tracking/target.hpp"

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

constexpr double kLike = 0.8;     // The appearance of the target,
constexpr double kUnlike = 0.15;  // and of somebody in other clothes.

Observation seen(double x, double y, double appearance = kLike) {
  return {{x, y}, 10.0, appearance};
}

/// A target tracker that sees at 5 Hz.
class Scene {
 public:
  explicit Scene(const TargetParams& params = {}, GeometricGate gate = {})
      : target_(params, {}, std::move(gate)) {}

  const TargetEstimate& see(const std::vector<Observation>& observations) {
    return target_.step(0.2 * frame_++, observations);
  }
  const TargetEstimate& see(const std::vector<Observation>& observations, int times) {
    for (int i = 0; i < times; ++i) {
      see(observations);
    }
    return target_.estimate();
  }
  TargetTracker& target() { return target_; }

 private:
  TargetTracker target_;
  int frame_ = 0;
};

TEST(TargetTracker, HasNoneBeforeAnybodyComes) {
  Scene run;
  const TargetEstimate& estimate = run.see({});
  EXPECT_EQ(estimate.status, TargetStatus::kNone);
  EXPECT_EQ(estimate.reason, TargetReason::kNobodyInView);
  EXPECT_EQ(estimate.confidence, 0.0);
  EXPECT_FALSE(estimate.hasPlace());
  EXPECT_FALSE(estimate.last_seen);
}

TEST(TargetTracker, StartsOnTheTrackNearestToThePlace) {
  Scene run;
  run.target().startAt({2.1, 0.0});
  const TargetEstimate& estimate = run.see({seen(1.62, -0.1), seen(2.0, 0.6), seen(2.0, 0.1)});
  EXPECT_EQ(estimate.status, TargetStatus::kFollowed);
  EXPECT_EQ(estimate.reason, TargetReason::kStarted);
  EXPECT_NEAR(estimate.motion.mean.y(), 0.1, 1e-9);
  EXPECT_EQ(run.see({seen(2.0, 0.1)}).reason, TargetReason::kSeen);
}

TEST(TargetTracker, StartsWhereNobodyWasObserved) {
  Scene run;
  run.target().startAt({2.0, 0.0});
  EXPECT_EQ(run.see({seen(4.0, 0.0)}).status, TargetStatus::kCoasting);
  EXPECT_EQ(run.target().estimate().reason, TargetReason::kStarted);
  EXPECT_EQ(run.see({seen(4.0, 0.0), seen(2.1, 0.0)}).status, TargetStatus::kFollowed);
  EXPECT_NEAR(run.target().estimate().motion.mean.x(), 2.1, 0.05);
}

TEST(TargetTracker, StartsByAppearanceOnAConfirmedTrack) {
  Scene run;
  EXPECT_EQ(run.see({seen(2, 0), seen(3, 1, kUnlike)}).status, TargetStatus::kNone);
  const TargetEstimate& estimate = run.see({seen(2, 0), seen(3, 1, kUnlike)});
  EXPECT_EQ(estimate.status, TargetStatus::kFollowed);
  EXPECT_EQ(estimate.reason, TargetReason::kRecognized);
  EXPECT_NEAR(estimate.motion.mean.x(), 2.0, 1e-6);
  EXPECT_NEAR(estimate.appearance, kLike, 1e-9);
}

TEST(TargetTracker, WaitsForAStartWhenToldTo) {
  TargetParams params;
  params.start_by_appearance = false;
  Scene run(params);
  const TargetEstimate& estimate = run.see({seen(2, 0)}, 10);
  EXPECT_EQ(estimate.status, TargetStatus::kNone);
  EXPECT_EQ(estimate.reason, TargetReason::kNotStarted);
  EXPECT_EQ(estimate.candidates, 1);
}

TEST(TargetTracker, TakesNobodyWhoLooksOtherwise) {
  Scene run;
  const TargetEstimate& estimate = run.see({seen(2, 0, kUnlike), seen(4, 0, kUnlike)}, 10);
  EXPECT_EQ(estimate.status, TargetStatus::kNone);
  EXPECT_EQ(estimate.reason, TargetReason::kNobodyLooksLike);
}

TEST(TargetTracker, OfTwoWhoLookAlikeNeitherIsTheTarget) {
  Scene run;
  const TargetEstimate& estimate = run.see({seen(2, 0, 0.80), seen(2, 2, 0.75)}, 10);
  EXPECT_EQ(estimate.status, TargetStatus::kAmbiguous);
  EXPECT_EQ(estimate.reason, TargetReason::kSeveralLookLike);
  EXPECT_EQ(estimate.candidates, 2);
  EXPECT_EQ(estimate.track_id, TargetEstimate::kNoTrack);
  EXPECT_FALSE(estimate.hasPlace());
  // One of them leaves; when that track has ended there is no doubt any more.
  EXPECT_EQ(run.see({seen(2, 2, 0.75)}).reason, TargetReason::kRecognized);
}

TEST(TargetTracker, AmbiguityUsesTheRatioOfTheBestTwo) {
  Scene clear;
  EXPECT_EQ(clear.see({seen(2, 0, 0.80), seen(2, 2, 0.68)}, 5).status, TargetStatus::kFollowed);
  Scene unclear;
  EXPECT_EQ(unclear.see({seen(2, 0, 0.80), seen(2, 2, 0.70)}, 5).status, TargetStatus::kAmbiguous);
}

TEST(TargetTracker, WaitsForSeveralFramesWhenToldTo) {
  TargetParams params;
  params.appearance_frames = 3;
  Scene run(params);
  EXPECT_EQ(run.see({seen(2, 0)}, 2).reason, TargetReason::kNotSureYet);  // 1st confirmed frame
  EXPECT_EQ(run.see({seen(2, 0)}).reason, TargetReason::kNotSureYet);
  EXPECT_EQ(run.see({seen(2, 0)}).reason, TargetReason::kRecognized);
}

TEST(TargetTracker, WaitsLongerAfterEachDoubtfulFind) {
  TargetParams params;  // min_appearance 0.41
  params.most_doubt = 4;
  Scene run(params);
  const auto frames = [&run] {  // until somebody is taken who looks like the target at first only
    int count = 0;
    while (run.see({seen(2, 0, 0.5)}).status != TargetStatus::kFollowed) ++count;
    run.see({seen(2, 0, 0.3)}, 20);
    run.see({}, 20);
    return count;
  };
  const int at_once = frames();
  EXPECT_EQ(frames(), at_once + 1);
  EXPECT_EQ(frames(), at_once + 3);
  EXPECT_EQ(frames(), at_once + 3) << "four times is the most";
  // Who goes on looking like the target ends the doubts.
  run.see({seen(2, 0, 0.9)}, 20);
  run.see({}, 20);
  EXPECT_EQ(frames(), at_once);
}

TEST(TargetTracker, NobodysLooksTakeALiveTargetOver) {
  Scene run;
  run.target().startAt({2.0, 0.0});
  run.see({seen(2, 0, 0.5)}, 3);
  const int id = run.target().estimate().track_id;
  // The target's looks fade while somebody else is the very image of it.
  const TargetEstimate& estimate = run.see({seen(2, 0, 0.2), seen(2, 1.0, 0.99)}, 50);
  EXPECT_EQ(estimate.track_id, id);
  EXPECT_EQ(estimate.status, TargetStatus::kFollowed);
  EXPECT_NEAR(estimate.motion.mean.y(), 0.0, 1e-6);
}

TEST(TargetTracker, AConfuserBesideTheTargetDoesNotTakeItsPlace) {
  Scene run;
  run.target().startAt({2.0, 0.0});
  run.see({seen(2.0, 0.0), seen(2.0, 0.6)}, 5);
  // The target is hidden for three frames; the confuser in the same clothes is in its gate.
  const TargetEstimate& hidden = run.see({seen(2.0, 0.5)}, 3);
  EXPECT_EQ(hidden.status, TargetStatus::kCoasting);
  EXPECT_EQ(hidden.reason, TargetReason::kTakenByOther);
  const TargetEstimate& back = run.see({seen(2.0, 0.5), seen(2.0, -0.1)});
  EXPECT_EQ(back.status, TargetStatus::kFollowed);
  EXPECT_LT(back.motion.mean.y(), 0.1);
}

TEST(TargetTracker, TakesWhoIsWhereAnotherSensorHasItThoughTheyLookLittleLikeIt) {
  constexpr double kInTheShade = 0.3;  // Too little to be known by.
  Scene run;
  run.target().startAt({0.0, 0.0});
  run.see({seen(0.0, 0.0)}, 3);
  run.see({}, 10);
  EXPECT_EQ(run.see({seen(1.0, 0.0, kInTheShade)}, 3).reason, TargetReason::kNobodyLooksLike);
  run.target().expectAt(Eigen::Vector2d(2.0, 0.0));
  EXPECT_EQ(run.see({seen(1.0, 0.0, kInTheShade)}, 3).reason, TargetReason::kNobodyLooksLike);
  run.target().expectAt(Eigen::Vector2d(1.1, 0.1));
  EXPECT_EQ(run.see({seen(1.0, 0.0, kInTheShade)}).status, TargetStatus::kFollowed);

  Scene other;
  other.target().startAt({0.0, 0.0});
  other.see({seen(0.0, 0.0)}, 3);
  other.see({}, 10);
  other.target().expectAt(Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(other.see({seen(1.0, 0.0, kUnlike)}, 5).reason, TargetReason::kNobodyLooksLike)
      << "but not somebody in other clothes";
}

TEST(TargetTracker, TakesNobodyWhoIsFarFromWhereAnotherSensorHasIt) {
  Scene run;
  run.target().startAt({0.0, 0.0});
  run.see({seen(0.0, 0.0)}, 3);
  run.target().expectAt(Eigen::Vector2d(0.5, 0.0));
  run.see({}, 60);
  EXPECT_EQ(run.see({seen(4.0, 0.0)}, 3).reason, TargetReason::kOutOfReach);
  run.target().expectAt(std::nullopt);
  EXPECT_EQ(run.see({seen(4.0, 0.0)}, 30).status, TargetStatus::kFollowed)
      << "after a while it can have walked there";
}

TEST(TargetTracker, CoastsThenIsLostAtItsLastPlace) {
  Scene run;
  run.target().startAt({0.0, 0.0});
  for (int k = 0; k < 10; ++k) {
    run.see({seen(0.2 * k, 0.0)});
  }
  const double last_s = 0.2 * 9;
  EXPECT_EQ(run.see({}).status, TargetStatus::kCoasting);
  EXPECT_EQ(run.target().estimate().reason, TargetReason::kNotObserved);
  const TargetEstimate& lost = run.see({}, 5);
  EXPECT_EQ(lost.status, TargetStatus::kLost);
  EXPECT_EQ(lost.reason, TargetReason::kNobodyInView);
  EXPECT_EQ(lost.confidence, 0.0);
  ASSERT_TRUE(lost.last_seen);
  EXPECT_DOUBLE_EQ(lost.last_seen->stamp_s, last_s);
  EXPECT_NEAR(lost.last_seen->position_m.x(), 1.8, 0.05);
  EXPECT_GT(lost.last_seen->velocity_mps.x(), 0.7);
}

TEST(TargetTracker, IsFoundAgainByItsLooks) {
  Scene run;
  run.target().startAt({2.0, 0.0});
  run.see({seen(2, 0), seen(3, 2, kUnlike)}, 5);
  const int id = run.target().estimate().track_id;
  EXPECT_EQ(run.see({seen(3, 2, kUnlike)}, 10).status, TargetStatus::kLost);
  EXPECT_EQ(run.target().estimate().reason, TargetReason::kNobodyLooksLike);
  run.see({seen(3, 2, kUnlike), seen(2.5, -1)}, 2);
  EXPECT_EQ(run.target().estimate().status, TargetStatus::kFollowed);
  EXPECT_EQ(run.target().estimate().reason, TargetReason::kRecognized);
  EXPECT_NE(run.target().estimate().track_id, id);
}

TEST(TargetTracker, LetsGoOfSomebodyTakenOnOneGoodLook) {
  TargetParams params;
  params.release_s = 1.0;
  Scene run(params);
  run.see({seen(2, 0)}, 2);
  ASSERT_EQ(run.target().estimate().reason, TargetReason::kRecognized);
  EXPECT_EQ(run.see({seen(2, 0, kUnlike)}, 5).status, TargetStatus::kFollowed);
  const TargetEstimate& estimate = run.see({seen(2, 0, kUnlike)}, 8);
  EXPECT_EQ(estimate.status, TargetStatus::kLost);
  EXPECT_EQ(estimate.reason, TargetReason::kNobodyLooksLike);
  EXPECT_FALSE(estimate.last_seen);  // Where the wrong one was says nothing of the target.
  EXPECT_EQ(run.see({seen(9, 0)}, 2).reason, TargetReason::kRecognized);
}

TEST(TargetTracker, KeepsATargetThatLooksOtherwiseForAWhile) {
  Scene run;
  run.see({seen(2, 0)}, 2);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(run.see({seen(2, 0, kUnlike)}, 8).status, TargetStatus::kFollowed);
    EXPECT_EQ(run.see({seen(2, 0)}, 4).status, TargetStatus::kFollowed);
  }
}

TEST(TargetTracker, KeepsWhoWasStartedAtAPlaceWhateverTheyLookLike) {
  Scene run;
  run.see({seen(2, 0, kUnlike)});
  run.target().startAt({2, 0});
  EXPECT_EQ(run.see({seen(2, 0, kUnlike)}, 40).status, TargetStatus::kFollowed);
}

TEST(TargetTracker, LetsGoOfWhoWasStartedAtAPlaceWhenToldTo) {
  TargetParams params;
  params.release_started = true;
  Scene run(params);
  run.see({seen(2, 0, kUnlike)});
  run.target().startAt({2, 0});
  EXPECT_EQ(run.see({seen(2, 0, kUnlike)}, 20).status, TargetStatus::kLost);
}

TEST(TargetTracker, GoesOverToWhoLooksClearlyMoreLikeTheTarget) {
  constexpr double kAlike = 0.45;  // Enough to be taken where nobody else is.
  for (const bool goes_over : {false, true}) {
    TargetParams params;
    if (goes_over) params.takeover_ratio = 1.4;
    Scene run(params);
    ASSERT_EQ(run.see({seen(2, 0, kAlike)}, 3).status, TargetStatus::kFollowed);
    run.see({seen(2, 0, kAlike), seen(2, 3)}, 2);
    EXPECT_NEAR(run.target().estimate().motion.mean.y(), 0.0, 0.1) << "not on one look";
    run.see({seen(2, 0, kAlike), seen(2, 3)}, 4);
    EXPECT_NEAR(run.target().estimate().motion.mean.y(), goes_over ? 3.0 : 0.0, 0.1);
  }
}

TEST(TargetTracker, IsNotTakenOverByWhoLooksALittleMoreAlike) {
  TargetParams params;
  params.takeover_ratio = 1.4;
  Scene run(params);
  run.target().startAt({2, 0});
  run.see({seen(2, 0, 0.6), seen(2, 3, 0.8)}, 20);
  EXPECT_NEAR(run.target().estimate().motion.mean.y(), 0.0, 0.1);
}

TEST(TargetTracker, TakesNobodyWhereAnotherIsKnownToBe) {
  Scene run;
  run.target().exclude({{2.1, 0.1}});
  EXPECT_EQ(run.see({seen(2, 0)}, 5).status, TargetStatus::kNone);
  run.target().exclude({});
  EXPECT_EQ(run.see({seen(2, 0)}).status, TargetStatus::kFollowed);
}

TEST(TargetTracker, TakesWhoIsKnownToBeAPersonInAnotherLightAfterSomeTime) {
  TargetParams params;  // min_appearance 0.41, of which 0.6 is 0.246
  params.patient_frames = 8;
  Scene run(params);
  EXPECT_EQ(run.see({seen(2, 0, 0.35)}, 20).status, TargetStatus::kNone) << "may be furniture";
  run.target().vouchFor({{2.1, 0.1}});
  EXPECT_EQ(run.see({seen(2, 0, 0.35)}, 7).reason, TargetReason::kNotSureYet);
  EXPECT_EQ(run.see({seen(2, 0, 0.35)}).status, TargetStatus::kFollowed);
}

TEST(TargetTracker, TakesNoPersonWhoLooksUnlikeTheTargetHoweverLong) {
  TargetParams params;
  params.patient_frames = 8;
  Scene run(params);
  run.target().vouchFor({{2.0, 0.0}});
  EXPECT_EQ(run.see({seen(2, 0, 0.2)}, 30).reason, TargetReason::kNobodyLooksLike);
}

TEST(TargetTracker, IsSureWhoLooksJustLikeItThoughTheyCannotHaveWalkedThere) {
  TargetParams params;
  params.sure_appearance = 0.7;
  Scene run(params);
  run.target().startAt({0.0, 0.0});
  run.see({seen(0, 0)}, 3);
  run.see({}, 6);
  EXPECT_EQ(run.see({seen(8.1, 0, 0.6)}, 4).reason, TargetReason::kOutOfReach);
  EXPECT_EQ(run.see({seen(8.1, 0, 0.8)}, 8).status, TargetStatus::kFollowed);
}

TEST(TargetTracker, IsNotFoundWhereItCannotHaveWalked) {
  Scene run;
  run.target().startAt({0.0, 0.0});
  run.see({seen(0, 0)}, 3);
  run.see({}, 6);  // Lost after 1.0 s.
  // 8.1 m away needs (8.1 - 0.8) / 2.0 = 3.65 s since it was last seen at 0.4 s.
  const TargetEstimate& estimate = run.see({seen(8.1, 0)}, 12);  // up to 4.0 s
  EXPECT_EQ(estimate.status, TargetStatus::kLost);
  EXPECT_EQ(estimate.reason, TargetReason::kOutOfReach);
  EXPECT_EQ(run.see({seen(8.1, 0)}).reason, TargetReason::kRecognized);
}

TEST(TargetTracker, TwoWhoLookAlikeAfterALossAreAmbiguous) {
  Scene run;
  run.target().startAt({2.0, 0.0});
  run.see({seen(2, 0)}, 3);
  run.see({}, 10);
  const TargetEstimate& estimate = run.see({seen(2, 1), seen(2, -1)}, 20);
  EXPECT_EQ(estimate.status, TargetStatus::kAmbiguous);
  EXPECT_TRUE(estimate.last_seen);
}

TEST(TargetTracker, SaysWhenTheGateRejectedTheTarget) {
  const GeometricGate wall_at_3 = [](const Observation& o, const Viewpoint&) {
    return o.position_m.x() > 3.0 ? GateVerdict::kBehindWall : GateVerdict::kAccepted;
  };
  Scene run({}, wall_at_3);
  run.target().startAt({2.9, 0.0});
  run.see({seen(2.9, 0.0)}, 3);
  const TargetEstimate& estimate = run.see({seen(3.1, 0.0)});
  EXPECT_EQ(estimate.status, TargetStatus::kCoasting);
  EXPECT_EQ(estimate.reason, TargetReason::kRejectedByGate);
  EXPECT_EQ(estimate.verdict, GateVerdict::kBehindWall);
  EXPECT_EQ(run.see({seen(2.9, 0.0)}).verdict, GateVerdict::kAccepted);
}

TEST(TargetTracker, IsLostInAGapOfTime) {
  TargetTracker target;
  target.startAt({1.0, 0.0});
  target.step(0.0, {seen(1, 0)});
  target.step(0.2, {seen(1, 0)});
  const TargetEstimate& estimate = target.step(60.0, {seen(1, 0)});
  EXPECT_EQ(estimate.status, TargetStatus::kLost);
  EXPECT_EQ(estimate.reason, TargetReason::kTimeJumped);
  EXPECT_EQ(target.step(60.2, {seen(1, 0)}).reason, TargetReason::kRecognized);
}

TEST(TargetTracker, ForgetsTheReachWhenTheClockWasSetBack) {
  TargetTracker target;
  target.startAt({1.0, 0.0});
  target.step(1000.0, {seen(1, 0)});
  target.step(0.0, {seen(1, 0)});
  EXPECT_EQ(target.step(0.2, {seen(1, 0)}).reason, TargetReason::kRecognized);
}

TEST(TargetTracker, KeepsItsEstimateOverASkippedFrame) {
  TargetTracker target;
  target.startAt({1.0, 0.0});
  target.step(0.2, {seen(1, 0)});
  const TargetEstimate& estimate = target.step(0.1, {});
  EXPECT_EQ(estimate.status, TargetStatus::kFollowed);
  EXPECT_EQ(estimate.reason, TargetReason::kFrameSkipped);
  EXPECT_NEAR(estimate.motion.mean.x(), 1.0, 1e-9);
}

TEST(TargetTracker, ConfidenceFollowsLooksTimeAndRivals) {
  Scene run;
  run.target().startAt({2.0, 0.0});
  EXPECT_NEAR(run.see({seen(2, 0, 0.8), seen(2, 3, 0.8)}, 4).confidence, 0.8, 1e-9);
  // 0.4 s unseen, nobody near.
  EXPECT_NEAR(run.see({seen(2, 3, 0.8)}, 2).confidence, 0.8 * std::exp(-0.4), 1e-9);
  // Somebody of half the appearance is beside the target.
  Scene pair;
  pair.target().startAt({2.0, 0.0});
  EXPECT_NEAR(pair.see({seen(2, 0, 0.8), seen(2, 0.7, 0.4)}, 4).confidence, 0.8 * 0.8 / (0.8 + 0.4),
              1e-9);
}

TEST(TargetTracker, TheOrderOfObservationsHasNoInfluence) {
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0.0, 0.05);
  TargetTracker straight, shuffled;
  for (int k = 0; k < 200; ++k) {
    std::vector<Observation> all;
    for (int person = 0; person < 4; ++person) {
      if ((k / 15 + person) % 3 != 0) {
        all.push_back(seen(2.0 + std::sin(0.1 * k + person) + noise(random), person + noise(random),
                           0.4 + 0.1 * person));
      }
    }
    straight.step(0.2 * k, all);
    std::shuffle(all.begin(), all.end(), random);
    shuffled.step(0.2 * k, all);
    ASSERT_EQ(straight.estimate().status, shuffled.estimate().status);
    ASSERT_EQ(straight.estimate().track_id, shuffled.estimate().track_id);
    ASSERT_EQ(straight.estimate().motion.mean, shuffled.estimate().motion.mean);
    ASSERT_EQ(straight.estimate().confidence, shuffled.estimate().confidence);
  }
}

TEST(TargetTracker, EveryStatusAndReasonHasItsOwnText) {
  std::vector<std::string> texts;
  for (int i = 0; i < kTargetStatuses; ++i) {
    texts.emplace_back(toText(static_cast<TargetStatus>(i)));
  }
  for (int i = 0; i < kTargetReasons; ++i) {
    texts.emplace_back(toText(static_cast<TargetReason>(i)));
  }
  EXPECT_THAT(texts, ::testing::Not(::testing::Contains("unknown")));
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(std::adjacent_find(texts.begin(), texts.end()), texts.end());
}

TEST(TargetTracker, RejectsBadInput) {
  TargetParams params;
  params.min_appearance_ratio = 0.9;
  EXPECT_THROW(TargetTracker{params}, std::invalid_argument);
  params = {};
  params.appearance_frames = 0;
  EXPECT_THROW(TargetTracker{params}, std::invalid_argument);
  TargetTracker target;
  EXPECT_THROW(target.startAt({std::nan(""), 0.0}), std::invalid_argument);
  EXPECT_THROW(target.step(std::numeric_limits<double>::quiet_NaN(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
