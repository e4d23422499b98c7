// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/pages/parsed_page.hpp"
#include "tests/support/track_run.hpp"
#include <heel/apps/pages/pages.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <string>

namespace {

using heel::TrackLog;
using heel::trackPage;
using heel::test::trackRun;
using testing::HasSubstr;
using testing::Not;

TEST(TrackPage, ShowsWhatHappened) {
  const std::string page = trackPage(trackRun());
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  pugi::xml_document document;
  heel::test::parseSelfContained(page, document);
  EXPECT_EQ(heel::test::countOf(document, "//div[@class='row bands']"), 2U);
  EXPECT_EQ(heel::test::countOf(document, "//div[@class='row bands thin']"), 2U);
  EXPECT_EQ(heel::test::countOf(document, "//div[@class='row chart']"), 3U);
  EXPECT_EQ(heel::test::countOf(document, "//path[@class='person-path']"), 1U);
  EXPECT_EQ(heel::test::countOf(document, "//path[@class='other-path']"), 2U);
  EXPECT_EQ(heel::test::countOf(document, "//img[@class='model']"), 1U);
  EXPECT_EQ(heel::test::countOf(document, "//figure[@class='shot']"), 1U);
  EXPECT_THAT(page, HasSubstr("<strong>rosa</strong> was found after 2.0\u00a0s"));
  EXPECT_THAT(page, HasSubstr("and lost once."));
}

TEST(TrackPage, SaysInWordsWhyThereIsNoTarget) {
  pugi::xml_document document;
  heel::test::parseSelfContained(trackPage(trackRun()), document);
  std::vector<std::string> titles;
  for (const auto& band : document.select_nodes("(//div[@class='row bands'])[2]//i")) {
    titles.emplace_back(band.node().attribute("title").value());
  }
  EXPECT_THAT(titles, testing::ElementsAre("nobody in view, 0.0 to 2.0 s",
                                           "nothing observed near its place, 7.0 to 8.0 s",
                                           "no pixel has the target's colours, 8.0 to 11.0 s"));
}

TEST(TrackPage, NamesPeopleBeforeThings) {
  const std::string page = trackPage(trackRun());
  const auto person = page.find("Somebody else, track 4"), thing = page.find("a thing, track 9");
  ASSERT_NE(thing, std::string::npos);
  EXPECT_LT(person, thing);
  TrackLog alone = trackRun();
  for (auto& sample : alone.samples) sample.others.clear();
  EXPECT_THAT(trackPage(alone), HasSubstr("Nobody else was tracked."));
}

TEST(TrackPage, GivesTheSameBytes) { EXPECT_EQ(trackPage(trackRun()), trackPage(trackRun())); }

TEST(TrackPage, DrawsForwardUp) {
  pugi::xml_document document;
  TrackLog log = trackRun();
  log.samples.resize(30);
  log.samples.back().target_m = Eigen::Vector2d(4.0, 1.0);
  heel::test::parseSelfContained(trackPage(log), document);
  const auto marks = heel::test::dataOf(document)["marks"];
  const auto robot = marks["now-robot"]["at"].back(), target = marks["now-target"]["at"].back();
  EXPECT_NEAR(double(robot[1]) - double(target[1]), 4.0, 0.011);
  EXPECT_NEAR(double(robot[0]) - double(target[0]), 1.0, 0.011);
}

TEST(TrackPage, EachMomentHasItsPictureOfTheFilm) {
  pugi::xml_document document;
  const TrackLog log = trackRun();
  heel::PageFilm film{"tracks.mp4", 10.0, {}, {}};
  for (std::size_t i = 0; i < log.samples.size(); i += 2) {
    film.stamps_s.push_back(log.samples[i].stamp_s);
  }
  const std::string page = trackPage(log, film);
  ASSERT_TRUE(document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype));
  EXPECT_STREQ(document.select_node("//video/@src").attribute().value(), "tracks.mp4");
  const auto pictures = heel::test::dataOf(document)["film"]["picture"];
  EXPECT_EQ(pictures[0], 0);
  EXPECT_EQ(pictures[9], 4);
  EXPECT_EQ(pictures[10], 5);
}

TEST(TrackPage, HostileNamesStayText) {
  TrackLog log = trackRun();
  log.recording = log.layout = log.person = log.frame = heel::test::kHostile;
  log.samples[50].state = log.samples[60].reason = heel::test::kHostile;
  log.stills[0].caption = heel::test::kHostile;
  log.warnings = {heel::test::kHostile, "\xff\xfe"};
  const std::string page = trackPage(log, {heel::test::kHostile, 10.0, {100.0}, {}});
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype));
  EXPECT_EQ(heel::test::countOf(document, "//script"), 3U);
}

TEST(TrackPage, NothingAndWhatIsNotKnownMakeAPage) {
  pugi::xml_document document;
  heel::test::parseSelfContained(trackPage({}), document);
  TrackLog log = trackRun();
  log.samples.resize(1);
  heel::test::parseSelfContained(trackPage(log), document);
  const double nan = std::nan("");
  log = trackRun();
  log.moves = true;
  for (auto& sample : log.samples) {
    sample.robot = {{nan, nan}, nan};
    sample.target_m = Eigen::Vector2d(nan, nan);
    sample.confidence = sample.color_share = nan;
    for (auto& other : sample.others) other.position_m.setConstant(nan);
  }
  const std::string page = trackPage(log);
  heel::test::parseSelfContained(page, document);
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

}  // namespace
