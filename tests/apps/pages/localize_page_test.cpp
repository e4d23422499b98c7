// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/pages/parsed_page.hpp"
#include "tests/support/follow_run.hpp"
#include <heel/apps/pages/pages.hpp>

#include <algorithm>
#include <string>

namespace {

using heel::LocalizedLog;
using heel::localizePage;
using testing::HasSubstr;
using testing::Not;

/// 10 s through a room, lost from 4 to 6 s.
LocalizedLog someLog() {
  LocalizedLog log;
  log.name = "lab.log";
  log.way_m = 5.0;
  log.lost_share = 0.2;
  for (int i = 0; i <= 100; ++i) {
    const double t_s = 0.1 * i;
    const heel::FloorPose pose{{1.0 + 0.5 * t_s, 2.0}, 0.0};
    log.moments.push_back(
        {50.0 + t_s, pose, 0.05, 0.9, t_s >= 4.0 && t_s < 6.0 ? "lost" : "found", pose});
  }
  return log;
}

TEST(LocalizePage, ShowsTheWayOnTheMap) {
  pugi::xml_document document;
  heel::test::parseSelfContained(localizePage(someLog(), heel::test::flatMap()), document);
  EXPECT_EQ(heel::test::countOf(document, "//path[@class='walls']"), 1U);
  EXPECT_EQ(heel::test::countOf(document, "//path[@class='robot-path']"), 1U);
  EXPECT_EQ(heel::test::countOf(document, "//path[@class='person-path']"), 1U);
  EXPECT_EQ(heel::test::countOf(document, "//div[@class='row bands']//i"), 3U);
  EXPECT_EQ(heel::test::countOf(document, "//div[@class='row chart']"), 3U);
  const auto data = heel::test::dataOf(document);
  EXPECT_EQ(data["lost"].size(), 1U);
  EXPECT_EQ(data["marks"]["now-robot"]["at"].size(), 101U);
}

TEST(LocalizePage, DrawsWhereItWasLostHoweverFarItJumped) {
  LocalizedLog log = someLog();
  for (int i = 40; i < 60; ++i) log.moments[i].estimate.position.y() += 40.0;
  pugi::xml_document document;
  heel::test::parseSelfContained(localizePage(log, heel::test::flatMap()), document);
  const auto path = document.select_node("//path[@class='lost-path']").node();
  const std::string way = path.attribute("d").value();
  // From the last sure place to the first, by way of those that were not.
  EXPECT_EQ(std::count(way.begin(), way.end(), 'M'), 1);
  EXPECT_EQ(std::count(way.begin(), way.end(), 'L'), 3);
  const std::string sure =
      document.select_node("//path[@class='robot-path']").node().attribute("d").value();
  EXPECT_EQ(std::count(sure.begin(), sure.end(), 'M'), 2);
}

TEST(LocalizePage, DoesWithoutAReference) {
  LocalizedLog log = someLog();
  for (auto& moment : log.moments) moment.reference.reset();
  pugi::xml_document document;
  const std::string page = localizePage(log, heel::test::flatMap());
  heel::test::parseSelfContained(page, document);
  EXPECT_EQ(heel::test::countOf(document, "//div[@class='row chart']"), 2U);
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST(LocalizePage, HostileNamesStayTextAndNothingIsAPage) {
  LocalizedLog log = someLog();
  log.name = heel::test::kHostile;
  const std::string page = localizePage(log, heel::test::flatMap());
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  pugi::xml_document document;
  heel::test::parseSelfContained(page, document);
  heel::test::parseSelfContained(localizePage({}, {}), document);
}

}  // namespace
