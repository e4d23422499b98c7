// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/pages/parsed_page.hpp"
#include "tests/support/follow_run.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/pages/pages.hpp>

#include <gmock/gmock.h>

#include <limits>
#include <string>

namespace {

using heel::followExperimentPage;
using heel::FollowLog;
using heel::followPage;
using heel::summarize;
using heel::test::countOf;
using heel::test::dataOf;
using heel::test::flatRun;
using heel::test::kHostile;
using heel::test::parseSelfContained;
using testing::HasSubstr;
using testing::Not;

std::string pageOf(const FollowLog& log) { return followPage(log, summarize(log)); }

void expectSelfContained(const std::string& page) {
  pugi::xml_document document;
  parseSelfContained(page, document);
}

TEST(FollowPage, IsWellFormedAndSelfContained) {
  const std::string page = pageOf(flatRun());
  expectSelfContained(page);
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_LT(page.size(), 400000U);
}

TEST(FollowPage, ShowsTheRun) {
  pugi::xml_document document;
  parseSelfContained(pageOf(flatRun()), document);
  EXPECT_EQ(countOf(document, "//path[@class='walls']"), 1U);
  EXPECT_EQ(countOf(document, "//path[@class='robot-path']"), 1U);
  EXPECT_EQ(countOf(document, "//path[@class='person-path']"), 1U);
  EXPECT_EQ(countOf(document, "//g[@class='mark lost']"), 2U);
  EXPECT_EQ(countOf(document, "//g[@class='mark found']"), 2U);
  EXPECT_EQ(countOf(document, "//div[@class='row chart']"), 3U);
  EXPECT_EQ(countOf(document, "//figure[@class='shot']"), 3U);
  EXPECT_EQ(countOf(document, "//video"), 0U);
  const auto bands = countOf(document, "//div[@class='row bands']//i");
  EXPECT_EQ(bands, heel::stateSpans(flatRun().samples).size());
  EXPECT_EQ(countOf(document, "//img[not(@alt)] | //svg[not(@aria-label) and not(@aria-hidden)]"),
            0U);
}

TEST(FollowPage, DataAreTheRunsMoments) {
  pugi::xml_document document;
  FollowLog log = flatRun();
  parseSelfContained(pageOf(log), document);
  const auto data = dataOf(document);
  const std::size_t count = data["t"].size();
  EXPECT_LE(count, 1501U);
  EXPECT_EQ(data["state"].size(), count);
  EXPECT_EQ(data["reason"].size(), count);
  for (const char* column : {"distance", "speed", "clearance", "error"}) {
    EXPECT_EQ(data["columns"][column].size(), count) << column;
  }
  for (const char* mark : {"now-robot", "now-person", "now-estimate", "now-other-0"}) {
    EXPECT_EQ(data["marks"][mark]["at"].size(), count) << mark;
  }
  EXPECT_EQ(data["t"].back(), log.samples.back().stamp_s);
  EXPECT_EQ(data["states"][0]["name"], "learn");
  const double x = data["marks"]["now-robot"]["at"][0][0],
               wanted = log.samples[0].robot_true.position.x() + 0.3;
  EXPECT_NEAR(x, wanted, 0.006) << "the map begins 5 cm, and its margin 30 cm, left of x = 0";
}

TEST(FollowPage, HostileNamesStayText) {
  FollowLog log = flatRun();
  log.scene = log.plan = log.person = log.outcome = log.command = kHostile;
  log.samples[50].state = log.samples[60].reason = kHostile;
  log.snapshots[0].caption = kHostile;
  log.stages[0].name = kHostile;
  heel::PageFilm film;
  film.name = kHostile;
  const std::string page = followPage(log, summarize(log), film);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype));
  EXPECT_EQ(countOf(document, "//script"), 3U);
  EXPECT_THAT(document.select_node("//h1").node().text().as_string(),
              testing::StartsWith("<script>alert('x')</script>\"&]]>{{style}}"));
}

TEST(FollowPage, BytesThatAreNoTextDoNotCostThePage) {
  FollowLog log = flatRun();
  log.samples[0].reason = log.samples[0].state = "\xff\xfe";
  pugi::xml_document document;
  parseSelfContained(pageOf(log), document);
}

TEST(FollowPage, NothingAndOneSampleMakeAPage) {
  FollowLog log;
  expectSelfContained(pageOf(log));
  log.samples.resize(1);
  expectSelfContained(pageOf(log));
  log.map = heel::test::flatMap();
  log.samples[0].person_true = Eigen::Vector2d(1.0, 2.0);
  expectSelfContained(pageOf(log));
}

TEST(FollowPage, WhatIsNotKnownIsADash) {
  FollowLog log = flatRun();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (auto& sample : log.samples) {
    sample.clearance_m = sample.person_distance_m = nan;
    sample.robot_true.position.setConstant(nan);
    sample.robot_true.yaw_rad = sample.speed_true.forward_mps = nan;
    sample.person_true = sample.target_estimate = Eigen::Vector2d(nan, nan);
    sample.others_true = {Eigen::Vector2d(nan, nan)};
  }
  log.drive.max_speed_mps = log.stages[0].mean_ms = nan;
  const std::string page = pageOf(log);
  expectSelfContained(page);
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, HasSubstr("\u2013"));
}

TEST(FollowPage, SaysWhetherTheLoopKeepsUpWithTheCamera) {
  FollowLog log = flatRun();  // 33.3 ms a frame
  log.step = {"step", 20.0, 30.0};
  EXPECT_THAT(pageOf(log), HasSubstr("the loop keeps up."));
  log.step.p95_ms = 40.0;
  EXPECT_THAT(pageOf(log), HasSubstr("the loop keeps up on the whole."));
  log.step.mean_ms = 35.0;
  EXPECT_THAT(pageOf(log), HasSubstr("the loop does not keep up."));
}

TEST(FollowPage, FilmIsTheOnlyFileBesideIt) {
  heel::PageFilm film;
  film.name = "follow.mp4";
  pugi::xml_document document;
  const std::string page = followPage(flatRun(), summarize(flatRun()), film);
  ASSERT_TRUE(document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype));
  EXPECT_STREQ(document.select_node("//video/@src").attribute().value(), "follow.mp4");
  EXPECT_EQ(countOf(document, "//video[starts-with(@poster, 'data:image/jpeg')]"), 1U);
}

TEST(FollowPage, LongRunsAreThinnedOut) {
  FollowLog log = flatRun();
  const auto one = log.samples;
  for (int copy = 1; copy < 20; ++copy) {
    for (auto sample : one) {
      sample.stamp_s += copy * 156.1;
      log.samples.push_back(sample);
    }
  }
  EXPECT_LT(pageOf(log).size(), 800000U);
}

TEST(FollowExperimentPage, IsWellFormedAndListsEveryFailure) {
  heel::FollowExperiment experiment = heel::test::followExperiment();
  std::string page = followExperimentPage(experiment);
  expectSelfContained(page);
  EXPECT_THAT(page, HasSubstr("99 of 100"));
  EXPECT_THAT(page, HasSubstr("Failures: 2"));
  EXPECT_THAT(page, HasSubstr("heel follow home-43 --seed 43"));
  experiment.episodes[0].name = experiment.episodes[0].cause = kHostile;
  experiment.episodes[0].summary.contacts = experiment.episodes[0].summary.contacts_by_robot = 2;
  experiment.plans[0] = experiment.title = kHostile;
  page = followExperimentPage(experiment);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("Failures: 3"));
  expectSelfContained(page);
  expectSelfContained(followExperimentPage({}));
}

TEST(CountEpisodes, SumsThoseOfOnePlan) {
  heel::FollowExperiment experiment = heel::test::followExperiment();
  experiment.episodes[1].summary.contacts = experiment.episodes[1].summary.contacts_by_robot = 2;
  experiment.episodes[1].summary.wrong_person_s = 3.0;
  const auto counts = heel::countEpisodes(experiment.episodes, "look-around");
  EXPECT_EQ(counts.episodes, 100);
  EXPECT_EQ(counts.reached, 99);
  EXPECT_EQ(counts.with_contact, 1);
  EXPECT_EQ(counts.contacts_by_robot, 2);
  EXPECT_DOUBLE_EQ(counts.wrong_person_s, 3.0);
  EXPECT_TRUE(heel::isFailure(experiment.episodes[1]));
  EXPECT_EQ(heel::countEpisodes(experiment.episodes, "none").episodes, 0);
}

}  // namespace
