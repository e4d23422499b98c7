// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/follow_run.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/pages/follow_page.hpp>

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

namespace {

using heel::FollowLog;
using heel::test::readText;
using heel::test::TempFolder;
using testing::HasSubstr;
using testing::Not;

/// What a headless browser made of a page.
struct Shown {
  std::string dom;
  std::string log;
};

class FollowPageInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null") != 0) {
      GTEST_SKIP() << "no chromium here; install it to test the page in a browser";
    }
  }

  Shown show(const FollowLog& log, const std::string& script_at_end = {}) const {
    heel::FollowPageParams params;
    params.film = "not-there.mp4";
    std::string page = followPage(log, summarize(log), params);
    page.insert(page.rfind("</body>"), script_at_end);
    folder_.write("page.html", page);
    const std::string command =
        "chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr "
        "--virtual-time-budget=3000 --user-data-dir='" +
        (folder_ / "profile").string() + "' --dump-dom 'file://" +
        (folder_ / "page.html").string() + "' >'" + (folder_ / "dom").string() + "' 2>'" +
        (folder_ / "log").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << readText(folder_ / "log");
    return {readText(folder_ / "dom"), readText(folder_ / "log")};
  }

  TempFolder folder_;
};

TEST_F(FollowPageInBrowser, RunsWithoutAnError) {
  const Shown shown = show(heel::test::flatRun());
  EXPECT_THAT(shown.dom, HasSubstr("data-ready=\""));
  EXPECT_THAT(shown.dom, HasSubstr("class=\"now-robot\""));
  EXPECT_THAT(shown.dom, Not(HasSubstr("data-ready=\"0\"")));
  EXPECT_THAT(shown.log, Not(HasSubstr("Uncaught")));
  EXPECT_THAT(shown.dom, HasSubstr("card only-screen gone")) << "a film that is not there";
}

TEST_F(FollowPageInBrowser, EmptyRunIsNoError) {
  const Shown shown = show({});
  EXPECT_THAT(shown.dom, HasSubstr("data-ready=\"0\""));
  EXPECT_THAT(shown.log, Not(HasSubstr("Uncaught")));
}

TEST_F(FollowPageInBrowser, PointingAtTheTimelineShowsThatMoment) {
  FollowLog log = heel::test::flatRun();
  const std::string script =
      "<script>const line = document.getElementById('timeline');"
      "const box = line.getBoundingClientRect();"
      "line.dispatchEvent(new PointerEvent('pointermove', {bubbles: true, clientX: box.right}));"
      "</script>";
  const Shown shown = show(log, script);
  const double end_s = log.samples.back().stamp_s - log.samples.front().stamp_s;
  EXPECT_THAT(shown.dom,
              HasSubstr("<span id=\"now-time\">" + std::to_string(end_s).substr(0, 5) + "</span>"));
  EXPECT_THAT(shown.log, Not(HasSubstr("Uncaught")));
}

}  // namespace
