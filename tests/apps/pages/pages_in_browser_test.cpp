// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/follow_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/support/track_run.hpp"
#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/pages/pages.hpp>

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

/// Keeps a page from being loaded, and so from being shown, until what it gives is called.
const char* const kHold = R"(<script>
function hold() {
  const frame = document.createElement('iframe');
  frame.style.display = 'none';
  document.body.append(frame);
  frame.contentDocument.open();
  return () => { frame.contentDocument.close(); frame.remove(); };
}
</script>)";

/// A page that shows page.html as a phone does: a window may not be as narrow.
const char* const kPhone = R"(<script>
const release = hold();
addEventListener('message', (event) => {
  document.body.insertAdjacentHTML('beforeend', '<b>said: ' + event.data + '</b>');
  release();
}, {once: true});
</script><iframe src="page.html" width="400" height="30000" style="border: 0"></iframe></body></html>)";

/// Means for the scripts of these tests: what they say ends up in the page.
const char* const kMeans = R"(<script>
const byId = (id) => document.getElementById(id);
const say = (text) => parent === window ?
  document.body.insertAdjacentHTML('beforeend', '<b>said: ' + text + '</b>') :
  parent.postMessage(text, '*');
const now = () => byId('now-time').textContent;
const place = (id) => byId(id).getAttribute('visibility') + ' ' + byId(id).getAttribute('transform');
const key = (key, more) => document.body.dispatchEvent(
  new KeyboardEvent('keydown', {key: key, bubbles: true, ...more}));
/** The pointer goes down at one share of the timeline's width, and up at another. */
function drag(from, to) {
  const box = byId('ruler').getBoundingClientRect();
  const gutter = parseFloat(getComputedStyle(document.documentElement).getPropertyValue('--gutter'));
  const at = (share) => ({bubbles: true, button: 0, pointerType: 'mouse',
                          clientX: box.left + gutter + share * (box.width - gutter)});
  byId('ruler').dispatchEvent(new PointerEvent('pointerdown', at(from)));
  byId('ruler').dispatchEvent(new PointerEvent('pointermove', at(to)));
  byId('ruler').dispatchEvent(new PointerEvent('pointerup', at(to)));
}
/** Waits until something is so, as long as a busy machine may take. */
async function until(isSo) {
  for (let tries = 0; tries < 3000 && !isSo(); ++tries) {
    await new Promise((done) => setTimeout(done, 20));
  }
}
</script>)";

class PagesInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null") != 0) {
      GTEST_SKIP() << "no chromium here; install it to test the pages in a browser";
    }
  }

  /// The page after `script`, which may wait for what it needs.
  Shown show(std::string page, const std::string& script = {}, bool on_phone = false) const {
    page.insert(page.rfind("</body>"),
                kHold + (kMeans + ("<script>{ const release = hold(); (async () => {" + script +
                                   "})().finally(release); }</script>")));
    folder_.write("page.html", page);
    folder_.write("phone.html", "<!DOCTYPE html><html><body>" + (kHold + std::string(kPhone)));
    const std::string command =
        "chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr "
        "--window-size=1400,900 --user-data-dir='" +
        (folder_ / "profile").string() + "' --dump-dom 'file://" +
        (folder_ / (on_phone ? "phone.html" : "page.html")).string() + "' >'" +
        (folder_ / "dom").string() + "' 2>'" + (folder_ / "log").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << readText(folder_ / "log");
    return {readText(folder_ / "dom"), readText(folder_ / "log")};
  }

  /// The page of trackRun() with a film beside it, a picture for each frame.
  std::string trackPageWithFilm() const {
    const heel::TrackLog log = heel::test::trackRun();
    heel::PageFilm film{"film.mp4", 10.0, {}, {}};
    heel::FilmWriter writer(folder_ / film.name, film.rate_hz, {64, 48});
    for (const heel::TrackSample& sample : log.samples) {
      film.stamps_s.push_back(sample.stamp_s);
      writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar(sample.target_m ? 200 : 20, 0, 0)));
    }
    writer.close();
    return trackPage(log, film);
  }

  TempFolder folder_;
};

std::string followPageOf(const FollowLog& log, const std::string& name = {}) {
  heel::PageFilm film;
  film.name = name;
  return followPage(log, summarize(log), film);
}

/// Of three runs, one of which failed.
std::string summaryPageOfThree() {
  heel::RunTable table;
  table.columns = {"a_figure_with_quite_a_long_name.and_another_one_within", "same", "word"};
  for (int i = 0; i < 3; ++i) {
    heel::RunRow& run = table.runs.emplace_back();
    run.name = "a_long_name_of_a_recording_" + std::to_string(i);
    run.exit_code = i == 1 ? 3 : 0;
    run.reason = i == 1 ? "recordings/cut.bag: the bag is truncated" : "";
    run.call = {"heel", "track", "recordings/" + run.name, "--out", "batch/track/" + run.name};
    run.fields = {{table.columns[0], 0.5 * i}, {"same", 1.0}, {"word", std::string("<b>")}};
  }
  heel::WorstRuns worst;
  worst.column = table.columns[0];
  return heel::summaryPage(table, worst);
}

TEST_F(PagesInBrowser, RunWithoutAnError) {
  for (const std::string& page : {followPageOf(heel::test::flatRun()), trackPageWithFilm()}) {
    const Shown shown = show(page, "say(document.querySelectorAll('canvas').length);");
    EXPECT_THAT(shown.dom, HasSubstr("data-ready=\""));
    EXPECT_THAT(shown.dom, Not(HasSubstr("data-ready=\"0\"")));
    EXPECT_THAT(shown.dom, HasSubstr("said: 4")) << "three charts and the ruler";
    EXPECT_THAT(shown.log, Not(HasSubstr("CONSOLE")));
  }
  const Shown experiment = show(followExperimentPage(heel::test::followExperiment()));
  EXPECT_THAT(experiment.dom, HasSubstr("data-ready=\"12\""));
  EXPECT_THAT(experiment.log, Not(HasSubstr("CONSOLE")));
  const Shown summary = show(summaryPageOfThree());
  EXPECT_THAT(summary.dom, HasSubstr("data-ready=\"1\"")) << "one figure differs among the runs";
  EXPECT_THAT(summary.log, Not(HasSubstr("CONSOLE")));
}

TEST_F(PagesInBrowser, EmptyRunsAreNoError) {
  for (const std::string& page :
       {followPageOf({}), heel::trackPage({}), heel::localizePage({}, {})}) {
    const Shown shown = show(page, "key('ArrowRight'); key(' '); drag(.2, .6); drag(.5, .5);");
    EXPECT_THAT(shown.dom, HasSubstr("data-ready=\"0\""));
    EXPECT_THAT(shown.log, Not(HasSubstr("CONSOLE")));
  }
}

TEST_F(PagesInBrowser, FilmThatIsNotThereIsLeftOut) {
  const Shown shown = show(followPageOf(heel::test::flatRun(), "not-there.mp4"),
                           "await until(() => !byId('film'));");
  EXPECT_THAT(shown.dom, HasSubstr("class=\"place no-film\""));
  EXPECT_THAT(shown.dom, Not(HasSubstr("<video")));
  EXPECT_THAT(shown.log, Not(HasSubstr("Uncaught")));
}

TEST_F(PagesInBrowser, ClickOnTheTimelineMovesTheFilmAndTheMap) {
  const Shown shown = show(trackPageWithFilm(), R"(
    const film = byId('film');
    await until(() => film.readyState > 0);
    drag(.75, .75);
    say('now ' + now() + ' ' + byId('now-state').textContent + ' ' + place('now-target'));
    drag(.5, .5);
    say('later ' + now() + ' ' + byId('now-state').textContent + ' ' + place('now-target'));
    await until(() => !film.seeking);
    say('film at ' + film.currentTime.toFixed(2));)");
  EXPECT_THAT(shown.dom, HasSubstr("now 15.0 seen visible translate("));
  EXPECT_THAT(shown.dom, HasSubstr("later 10.0 lost hidden"));
  EXPECT_THAT(shown.dom, HasSubstr("film at 10.05")) << "the middle of its hundredth picture";
  EXPECT_THAT(shown.log, Not(HasSubstr("CONSOLE")));
}

TEST_F(PagesInBrowser, FilmIsOfAFormatThatIsPlayed) {
  const Shown shown = show(trackPageWithFilm(), R"(
    const film = byId('film');
    await until(() => film.readyState > 1);
    say('size ' + film.videoWidth + ', ' + film.duration.toFixed(1) + ' s');)");
  EXPECT_THAT(shown.dom, HasSubstr("said: size 64, 20.1 s"));
}

TEST_F(PagesInBrowser, KeysMoveTheCursorAndPlay) {
  const Shown shown = show(trackPage(heel::test::trackRun()), R"(
    key('Home'); say('home ' + now());
    key('ArrowRight'); key('ArrowRight'); key('ArrowLeft'); say('arrows ' + now());
    key('ArrowRight', {shiftKey: true}); say('shift ' + now());
    key('End'); say('end ' + now());
    key('Home'); key(' '); say('play ' + byId('play').textContent);
    key(' '); say('stop ' + byId('play').textContent);
    key('ArrowRight', {ctrlKey: true}); say('theirs ' + now());)");
  for (const char* said : {"home 0.0", "arrows 0.1", "shift 1.1", "end 20.0", "play Pause",
                           "stop Play", "theirs 0.0"}) {
    EXPECT_THAT(shown.dom, HasSubstr("said: " + std::string(said) + "<"));
  }
  EXPECT_THAT(shown.log, Not(HasSubstr("CONSOLE")));
}

TEST_F(PagesInBrowser, DraggingOverTheTimelineZooms) {
  const Shown shown = show(trackPage(heel::test::trackRun()), R"(
    const width = () => document.querySelector('.wide').style.width;
    drag(.25, .5); say('zoomed ' + width());
    key('0'); say('all ' + width());
    drag(.5, .5); key('+'); say('in ' + width() + ' ' + now());)");
  EXPECT_THAT(shown.dom, HasSubstr("said: zoomed 400%"));
  EXPECT_THAT(shown.dom, HasSubstr("said: all 100%"));
  EXPECT_THAT(shown.dom, HasSubstr("said: in 200% 10.0"));
}

TEST_F(PagesInBrowser, NothingScrollsSidewaysOnAPhone) {
  for (const std::string& page :
       {followPageOf(heel::test::flatRun()), trackPageWithFilm(),
        followExperimentPage(heel::test::followExperiment()), summaryPageOfThree()}) {
    const Shown shown = show(page,
                             "const root = document.documentElement;"
                             "say('width ' + root.clientWidth + ' of ' + root.scrollWidth);",
                             true);
    EXPECT_THAT(shown.dom, HasSubstr("said: width 400 of 400"));
  }
}

}  // namespace
