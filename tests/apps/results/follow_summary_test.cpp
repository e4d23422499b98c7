// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/output/full_disk.hpp"
#include "tests/support/follow_run.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/results/follow_log.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace {

using Eigen::Vector2d;
using heel::FollowLog;
using heel::FollowSample;
using heel::FollowSummary;
using heel::isWrongPerson;
using heel::summarize;
using heel::test::flatRun;
using heel::test::readText;
using heel::test::TempFolder;

FollowSample at(double stamp_s, const std::string& state, double x_m) {
  FollowSample sample;
  sample.stamp_s = stamp_s;
  sample.state = state;
  sample.robot_true.position = {x_m, 0.0};
  sample.robot_estimated = sample.robot_true;
  return sample;
}

/// Learns for 2 s, drives 3 m in 10 s, seeks for 5 s, stands for 2 s.
FollowLog shortRun() {
  FollowLog log;
  log.outcome = "reached";
  log.samples = {at(0.0, "learn", 0.0), at(2.0, "follow", 0.0), at(12.0, "seek", 3.0),
                 at(17.0, "face", 3.0), at(19.0, "face", 3.0)};
  return log;
}

TEST(FollowSummary, CountsTimeAndWayAsTheTableOfThePaper) {
  const FollowSummary sum = summarize(shortRun());
  EXPECT_EQ(sum.outcome, "reached");
  EXPECT_DOUBLE_EQ(sum.learn_s, 2.0);
  EXPECT_DOUBLE_EQ(sum.elapsed_s, 17.0);
  EXPECT_DOUBLE_EQ(sum.seek_s, 5.0);
  EXPECT_DOUBLE_EQ(sum.distance_m, 3.0);
  EXPECT_DOUBLE_EQ(sum.moving_speed_mps, 3.0 / 12.0);
  EXPECT_DOUBLE_EQ(sum.driving_speed_mps, 0.3);
  EXPECT_DOUBLE_EQ(sum.seekShare(), 5.0 / 17.0);
}

TEST(FollowSummary, ThePapersOwnRowsHoldToTheFormula) {
  for (const heel::PaperRow& row : heel::kPaperTable1) {
    EXPECT_NEAR(row.distance_m / (row.elapsed_s - row.seek_s), row.moving_speed_mps, 0.006);
  }
}

TEST(FollowSummary, AContactLastsUntilItEnds) {
  FollowLog log = shortRun();
  log.samples[1].clearance_m = 0.4;
  log.samples[1].contact = log.samples[2].contact = log.samples[4].contact = true;
  log.samples[3].clearance_m = 0.2;
  const FollowSummary sum = summarize(log);
  EXPECT_EQ(sum.contacts, 2);
  EXPECT_EQ(sum.contactsByPeople(), 2);
  EXPECT_EQ(sum.min_clearance_m, 0.0);
  log.samples[2].contact_by_robot = true;  // It drove on.
  EXPECT_EQ(summarize(log).contacts_by_robot, 1);
  EXPECT_EQ(summarize(log).contactsByPeople(), 1);
  for (FollowSample& sample : log.samples) sample.contact = sample.contact_by_robot = false;
  EXPECT_EQ(summarize(log).contacts, 0);
  EXPECT_EQ(summarize(log).min_clearance_m, 0.2);
}

TEST(FollowSummary, WrongPersonAndTargetAreTimedUntilTheNextSample) {
  FollowLog log = shortRun();
  log.samples[1].target_estimate = Vector2d(1.0, 0.0);
  log.samples[3].target_estimate = Vector2d(1.0, 0.0);
  log.samples[3].wrong_person = true;
  log.samples[1].others_true = {log.samples[1].robot_true.position + Vector2d(0.0, 1.3)};
  log.samples[3].others_true = {log.samples[3].robot_true.position + Vector2d(0.0, 1.1)};
  const FollowSummary sum = summarize(log);
  EXPECT_DOUBLE_EQ(sum.with_target_s, 12.0);
  EXPECT_DOUBLE_EQ(sum.wrong_person_s, 2.0);
  EXPECT_DOUBLE_EQ(sum.near_others_s, 2.0) << "their personal zone ends at 1.2 m";
  EXPECT_DOUBLE_EQ(sum.wrongShare(), 2.0 / 17.0);
  EXPECT_EQ(sum.losses, 2) << "it is found once, and lost again at the end";
}

TEST(FollowSummary, LocalizationIsJudgedOnlyWhileItClaimsToKnow) {
  FollowLog log = shortRun();
  log.samples[1].is_localized = true;  // for 10 s
  log.samples[1].robot_estimated.position += Vector2d(0.3, 0.4);
  log.samples[2].robot_estimated.position += Vector2d(100.0, 0.0);  // and says that it is lost
  log.samples[3].is_localized = true;                               // for 2 s
  log.samples[3].robot_estimated.yaw_rad = 2.0 * M_PI + 0.1;
  const FollowSummary sum = summarize(log);
  EXPECT_DOUBLE_EQ(sum.localized_s, 12.0);
  EXPECT_NEAR(sum.position_rms_m, std::sqrt(10.0 * 0.25 / 12.0), 1e-12);
  EXPECT_NEAR(sum.yaw_rms_rad, std::sqrt(2.0 * 0.01 / 12.0), 1e-9);
}

TEST(FollowSummary, PersonIsJudgedWithoutTheTimeOfSomebodyElse) {
  FollowLog log = shortRun();
  for (FollowSample& sample : log.samples) sample.person_true = Vector2d(5.0, 0.0);
  log.samples[1].target_estimate = Vector2d(5.0, 0.2);
  log.samples[3].target_estimate = Vector2d(9.0, 0.0);
  log.samples[3].wrong_person = true;
  log.samples[2].person_distance_m = 0.8;
  log.samples[3].person_distance_m = 1.1;
  const FollowSummary sum = summarize(log);
  EXPECT_NEAR(sum.person_error_rms_m, 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(sum.best_distance_m, 0.8);
  EXPECT_DOUBLE_EQ(sum.last_distance_m, 1.1);
}

TEST(FollowSummary, NothingIsNotKnownRatherThanWrong) {
  const FollowSummary none = summarize({});
  EXPECT_EQ(none.distance_m, 0.0);
  EXPECT_TRUE(std::isnan(none.moving_speed_mps));
  EXPECT_TRUE(std::isnan(none.min_clearance_m));
  FollowLog log = shortRun();
  log.samples[2].robot_true.position.x() = std::numeric_limits<double>::quiet_NaN();
  log.samples[3].stamp_s = 1.0;  // time jumps back
  EXPECT_TRUE(std::isfinite(summarize(log).distance_m));
  EXPECT_GE(summarize(log).elapsed_s, 0.0);
  EXPECT_TRUE(heel::followJson(log, none)["min_clearance_m"].is_null());
}

TEST(IsWrongPerson, NeedsSomebodyNearerAndSomeDistance) {
  const Vector2d person(0.0, 0.0), other(2.0, 0.0);
  EXPECT_FALSE(isWrongPerson({0.4, 0.0}, person, {other}));
  EXPECT_FALSE(isWrongPerson({0.9, 0.0}, person, {other})) << "still nearer to the person";
  EXPECT_TRUE(isWrongPerson({1.1, 0.0}, person, {other}));
  EXPECT_FALSE(isWrongPerson({1.1, 0.0}, person, {}));
  EXPECT_FALSE(isWrongPerson({0.4, 0.0}, person, {Vector2d(0.4, 0.0)})) << "close together";
  EXPECT_TRUE(isWrongPerson({1.1, 0.0}, std::nullopt, {other}));
}

TEST(TargetEvents, AreLossesAndRecoveries) {
  std::vector<FollowSample> samples;
  for (int i = 0; i < 60; ++i) {
    samples.push_back(at(0.1 * i, "follow", 0.0));
    const bool is_seen = i >= 5 && !(i > 20 && i < 24) && !(i > 30 && i < 45);
    if (is_seen) samples.back().target_estimate = Vector2d(i, 0.0);
  }
  const auto events = heel::targetEvents(samples);
  ASSERT_EQ(events.size(), 2U) << "the short gap and the first sight are none";
  EXPECT_FALSE(events[0].is_found);
  EXPECT_DOUBLE_EQ(events[0].stamp_s, 3.0);
  EXPECT_EQ(events[0].place_m, Vector2d(30.0, 0.0));
  EXPECT_TRUE(events[1].is_found);
  EXPECT_DOUBLE_EQ(events[1].stamp_s, 4.5);
}

TEST(StateSpans, LastUntilTheNextState) {
  const auto spans = heel::stateSpans(shortRun().samples);
  ASSERT_EQ(spans.size(), 4U);
  EXPECT_EQ(spans[1].state, "follow");
  EXPECT_DOUBLE_EQ(spans[1].from_s, 2.0);
  EXPECT_DOUBLE_EQ(spans[1].to_s, 12.0);
  EXPECT_DOUBLE_EQ(spans[3].to_s, 19.0);
  EXPECT_TRUE(heel::stateSpans<FollowSample>({}).empty());
}

TEST(FollowFiles, HoldTheRunAndAreTheSameOnEveryRun) {
  const TempFolder folder;
  const FollowLog log = flatRun();
  for (const char* name : {"a", "b"}) {
    heel::Output output({"follow", heel::OutputKind::kFolder, folder / name, {}});
    heel::writeFollowFiles(output, flatRun(), summarize(flatRun()));
    output.commit();
  }
  for (const char* name : {"/summary.json", "/follow.csv", "/timing.csv"}) {
    EXPECT_EQ(readText(folder / (std::string("a") + name)),
              readText(folder / (std::string("b") + name)));
  }
  EXPECT_THAT(
      readText(folder / "a/timing.csv"),
      testing::StartsWith("stage,mean_ms,median_ms,p95_ms\ncolour filter,1.100,1.000,1.600\n"));
  const auto json = nlohmann::json::parse(readText(folder / "a/summary.json"));
  for (const char* key :
       {"outcome", "distance_m", "elapsed_s", "seek_s", "moving_speed_mps", "contacts_by_robot",
        "contacts_by_people", "wrong_person_s", "near_others_s", "min_clearance_m"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  heel::CsvReader csv(folder / "a/follow.csv", {"stamp_s", "x_m", "localized", "confidence"});
  std::size_t rows = 0;
  while (csv.next()) {
    EXPECT_NEAR(csv.number(0), log.samples[rows].stamp_s, 1e-3);
    EXPECT_NEAR(csv.number(1), log.samples[rows].robot_true.position.x(), 1e-4);
    EXPECT_TRUE(csv.flag(2));
    EXPECT_NEAR(csv.number(3), log.samples[rows].confidence, 1e-3);
    ++rows;
  }
  EXPECT_EQ(rows, log.samples.size());
}

TEST(FollowFiles, OfAStoppedRunSayThatTheyAreNotComplete) {
  FollowLog log = flatRun();
  EXPECT_TRUE(heel::followJson(log, summarize(log))["complete"]);
  log.outcome = heel::kStoppedRun;
  EXPECT_FALSE(heel::followJson(log, summarize(log))["complete"]);
}

}  // namespace
