// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What many runs need of the command: to be resumed, watched, joined and summarized.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/sqlite_file.hpp>
#include <heel/apps/output/output.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace heel::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ManyRuns : public testing::Test {
 protected:
  ManyRuns() {
    SmallRecording().write(folder_ / "room");
    writeSmallModel(folder_ / "person.yaml");
  }

  HeelRun track(const std::string& out, const std::vector<std::string>& more = {}) const {
    return heel({"track", folder_ / "room", "--model", folder_ / "person.yaml", "--out",
                 folder_ / out, "--no-film"},
                more);
  }
  std::string textOf(const std::string& name) const { return readText(folder_ / name); }

  TempFolder folder_;
};

TEST_F(ManyRuns, AreNotMadeAgainWhenResumed) {
  ASSERT_TRUE(succeeds(track("out")));
  const std::string manifest = textOf("out/.heel");
  const HeelRun again = track("out", {"--resume", "--threads", "1", "--progress=json"});
  EXPECT_TRUE(succeeds(again));
  EXPECT_THAT(again.out, HasSubstr("is complete already"));
  EXPECT_EQ(textOf("out/.heel"), manifest);
}

TEST_F(ManyRuns, AreMadeAgainWhenTheCallOrAnInputIsAnotherOrAResultIsGone) {
  const auto isMadeAgain = [this](const std::vector<std::string>& more) {
    const std::string before = textOf("out/.heel");
    EXPECT_TRUE(succeeds(track("out", more)));
    return textOf("out/.heel") != before;
  };
  ASSERT_TRUE(succeeds(track("out")));
  EXPECT_FALSE(isMadeAgain({"--resume"}));
  EXPECT_TRUE(isMadeAgain({"--resume", "--from", "0.1"}));
  EXPECT_FALSE(isMadeAgain({"--from", "0.1", "--resume"}));
  fs::remove(folder_ / "out/tracks.csv");
  EXPECT_TRUE(isMadeAgain({"--from", "0.1", "--resume"}));
  writeText(folder_ / "out/tracks.csv", "");
  EXPECT_TRUE(isMadeAgain({"--from", "0.1", "--resume"}));
  writeText(folder_ / "room/notes.txt", "new");
  EXPECT_TRUE(isMadeAgain({"--from", "0.1", "--resume"}));
  const std::string manifest = textOf("out/.heel");
  writeText(folder_ / "out/.heel", manifest.substr(0, manifest.size() / 2));
  EXPECT_TRUE(isMadeAgain({"--from", "0.1", "--resume"}));
}

TEST_F(ManyRuns, AreMadeAgainWhenTheirBagIsGone) {
  const std::string bag = folder_ / "out.bag";
  const auto isDone = [&] {
    const HeelRun run = track("out", {"--bag", bag, "--resume"});
    EXPECT_TRUE(succeeds(run));
    return run.out.find("is complete already") != std::string::npos;
  };
  EXPECT_FALSE(isDone());
  EXPECT_TRUE(isDone());
  fs::remove(bag);
  EXPECT_FALSE(isDone());
  EXPECT_TRUE(isDone());
}

TEST_F(ManyRuns, OfWhatIsOneFileAreResumedToo) {
  const std::vector<std::string> learn = {"learn", folder_ / "room", "--out",
                                          folder_ / "learned.yaml", "--resume"};
  const HeelRun first = heel(learn);
  ASSERT_TRUE(succeeds(first));
  const HeelRun second = heel(learn);
  EXPECT_TRUE(succeeds(second));
  EXPECT_THAT(second.out, HasSubstr("is complete already"));
}

TEST_F(ManyRuns, TellWhatTheyTook) {
  ASSERT_TRUE(succeeds(track("out")));
  const auto facts = nlohmann::json::parse(factsAt(folder_ / "out"));
  EXPECT_EQ(facts["call"][1], "track");
  EXPECT_EQ(facts["inputs"].size(), 2U);
  EXPECT_EQ(facts["inputs"][1]["bytes"], fs::file_size(folder_ / "person.yaml"));
  EXPECT_GE(facts["wall_s"], 0.0);
  EXPECT_GT(facts["cpu_s"], 0.0);
  EXPECT_GT(facts["peak_memory_mib"], 10.0);
  EXPECT_THAT(facts["began"].get<std::string>(), testing::MatchesRegex("20..-..-..T..:..:..Z"));
  EXPECT_TRUE(factsAt(folder_ / "room").empty()) << "somebody else's";
}

TEST_F(ManyRuns, TellProgramsHowFarTheyAre) {
  const HeelRun run = track("out", {"--progress", "json"});
  ASSERT_TRUE(succeeds(run));
  std::istringstream lines(run.err);
  int told = 0;
  double last = -1.0;
  for (std::string line; std::getline(lines, line);) {
    const auto progress = nlohmann::json::parse(line, nullptr, false);
    if (progress.is_discarded()) continue;  // a sentence
    EXPECT_EQ(progress["progress"], "tracking");
    EXPECT_GE(progress["done"], last);
    last = progress["done"];
    EXPECT_LE(last, progress["of"]);
    ++told;
  }
  EXPECT_GT(told, 10);
}

/// Each row without the track's number, and without what is no place.
std::vector<std::string> placesIn(const std::string& table) {
  std::istringstream lines(table);
  std::vector<std::string> places;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    places.push_back(fields[0] + " " + fields[2] + " " + fields[3].substr(0, 4) + " " +
                     fields[4].substr(0, 4));
  }
  return places;
}

TEST_F(ManyRuns, OfPiecesAreJoinedToTheSameTracks) {
  ASSERT_TRUE(succeeds(track("whole")));
  const auto trackPiece = [this](const std::string& i) {
    return track(i, {"--piece", i + "/3", "--overlap", "3"});
  };
  EXPECT_TRUE(findsNothing(trackPiece("1"))) << "somebody enters after 5.2 of 13 s";
  ASSERT_TRUE(succeeds(trackPiece("2")));
  ASSERT_TRUE(succeeds(trackPiece("3")));
  const HeelRun run =
      heel({"join", folder_ / "3", folder_ / "1", folder_ / "2", "--out", folder_ / "joined"});
  EXPECT_TRUE(succeeds(run));
  EXPECT_EQ(placesIn(textOf("joined/tracks.csv")), placesIn(textOf("whole/tracks.csv")));
  const auto whole = summaryIn(folder_ / "whole");
  const auto joined = summaryIn(folder_ / "joined");
  for (const char* key :
       {"recording", "frames", "frames_skipped", "frames_with_target", "camera"}) {
    EXPECT_EQ(joined[key], whole[key]) << key;
  }
  EXPECT_THAT(textOf("joined/report.html"), HasSubstr("</html>"));
}

TEST_F(ManyRuns, OfPiecesThatDoNotBelongTogetherAreNotJoined) {
  ASSERT_TRUE(succeeds(track("1", {"--piece", "1/2"})));
  fs::copy(folder_ / "room", folder_ / "yard", fs::copy_options::recursive);
  ASSERT_TRUE(succeeds(heel({"track", folder_ / "yard", "--model", folder_ / "person.yaml",
                             "--no-film", "--piece", "2/2", "--out", folder_ / "2"})));
  const auto join = [this](const std::string& second) {
    return heel({"join", folder_ / "1", folder_ / second, "--out", folder_ / "joined"});
  };
  EXPECT_TRUE(failsWith(join("2"), {"its recording is \"yard\", that of"}));
  EXPECT_TRUE(failsWith(join("room"), {"room/frames.csv"}));
  EXPECT_TRUE(failsWith(join("1"), {"ends before the one that it is to follow"}));
  EXPECT_FALSE(fs::exists(folder_ / "joined"));
  EXPECT_EQ(track("x", {"--piece", "3/2"}).exit_code, 2);
  EXPECT_EQ(track("x", {"--piece", "1/2", "--to", "3"}).exit_code, 2);
}

TEST_F(ManyRuns, BecomeOneTableAndOnePage) {
  fs::create_directories(folder_ / "runs");
  ASSERT_TRUE(succeeds(track("runs/kitchen")));
  ASSERT_TRUE(succeeds(track("runs/yard", {"--from", "0.5"})));
  writeText(folder_ / "runs/kitchen.evaluation.json", R"({"target": {"recall": 0.25}})");
  writeText(folder_ / "runs/yard.evaluation.json", R"({"target": {"recall": 0.75}})");
  writeText(folder_ / "runs/cut.json",
            R"({"exit": 3, "reason": "<b>, \"cut\"", "call": ["heel", "track", "it's"]})");
  writeText(folder_ / "runs/odd/summary.json", "[1, 2");
  const HeelRun run = heel({"summarize", folder_ / "runs", "--worst", "+evaluation.target.recall",
                            "--out", folder_ / "sum"});
  ASSERT_TRUE(succeeds(run));
  EXPECT_THAT(run.out, HasSubstr("4 runs, 2 of them failed"));

  SqliteFile database(folder_ / "sum/summary.db", SqliteFile::Use::kRead);
  SqliteQuery rows = database.query(
      "SELECT name, exit, reason, CAST(\"evaluation.target.recall\" * 100 AS INTEGER), frames "
      "FROM runs ORDER BY name");
  const auto next = [&rows] {
    EXPECT_EQ(rows.step(), SqliteQuery::Row::kThere);
    return rows.text(0) + " " + rows.text(1) + " " + rows.text(2) + " " + rows.text(3);
  };
  EXPECT_EQ(next(), "cut 3 <b>, \"cut\" ");
  EXPECT_EQ(next(), "kitchen 0  25");
  EXPECT_EQ(rows.integer(4), static_cast<std::int64_t>(SmallRecording().frames()));
  EXPECT_THAT(next(), HasSubstr("odd 3 " + (folder_ / "runs/odd/summary.json").string()));
  EXPECT_EQ(next(), "yard 0  75");

  const std::string page = textOf("sum/summary.html");
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;, "));
  EXPECT_THAT(page, Not(HasSubstr("<b>, ")));
  EXPECT_THAT(page, HasSubstr("heel track &#39;it&#39;\\&#39;&#39;s&#39;"));
  const auto worst =
      page.substr(page.find("The worst"), page.find("How the figures") - page.find("The worst"));
  EXPECT_LT(worst.find("kitchen"), worst.find("yard")) << "the least first";
  EXPECT_THAT(textOf("sum/machine.csv"), HasSubstr("\nkitchen,"));
}

TEST_F(ManyRuns, GiveTheSameSummaryWheneverTheyWereMade) {
  for (const std::string out : {"a", "b"}) {
    ASSERT_TRUE(succeeds(track("runs/kitchen")));
    ASSERT_TRUE(succeeds(heel({"summarize", folder_ / "runs", "--out", folder_ / out})));
  }
  for (const std::string name : {"summary.csv", "summary.db", "summary.html"}) {
    EXPECT_THAT(textOf("a/" + name), Not(IsEmpty())) << name;
    EXPECT_EQ(textOf("a/" + name), textOf("b/" + name)) << name;
  }
}

TEST_F(ManyRuns, ThatAreNoneAreNotSummarized) {
  EXPECT_TRUE(failsWith(heel({"summarize", folder_ / "room", "--out", folder_ / "sum"}),
                        {"room: holds no results of runs"}));
  EXPECT_TRUE(failsWith(heel({"summarize", folder_ / "nowhere", "--out", folder_ / "sum"}),
                        {"nowhere: cannot be read"}));
  ASSERT_TRUE(succeeds(track("out")));
  EXPECT_TRUE(
      failsWith(heel({"summarize", folder_ / "out", "--worst", "beauty", "--out", folder_ / "sum"}),
                {"--worst: there is no figure 'beauty'"}));
  EXPECT_FALSE(fs::exists(folder_ / "sum"));
}

class JoinedHomes : public testing::Test {
 protected:
  /// Results of so many homes, of which nobody has the time to be found.
  HeelRun make(const std::string& out, int seed, int episodes,
               const std::vector<std::string>& more = {}) const {
    return heel({"experiment", "follow", "--no-table1", "--seed", std::to_string(seed),
                 "--episodes", std::to_string(episodes), "--limit", "0.3", "--out", folder_ / out},
                more);
  }
  HeelRun join(const std::vector<std::string>& parts, const std::string& out) const {
    std::vector<std::string> call = {"experiment", "follow", "--join"};
    for (const std::string& part : parts) call.push_back(folder_ / part);
    call.insert(call.end(), {"--out", folder_ / out});
    return heel(call);
  }
  TempFolder folder_;
};

TEST_F(JoinedHomes, AreTheSameHoweverTheyWereCut) {
  ASSERT_TRUE(succeeds(make("whole", 5, 3)));
  ASSERT_TRUE(succeeds(make("first", 5, 1)));
  ASSERT_TRUE(succeeds(make("rest", 6, 2, {"--threads", "1"})));
  ASSERT_TRUE(succeeds(join({"rest", "first"}, "joined")));
  EXPECT_THAT(filesBelow(folder_ / "whole"), Not(IsEmpty()));
  EXPECT_TRUE(contentOf(folder_ / "whole") == contentOf(folder_ / "joined"));
  EXPECT_THAT(readText(folder_ / "joined/report.html"),
              HasSubstr("heel experiment follow --episodes 3 --seed 5 --no-table1 --limit 0.3"));
}

TEST_F(JoinedHomes, TellOfSeedsThatAreMissing) {
  ASSERT_TRUE(succeeds(make("first", 5, 1)));
  ASSERT_TRUE(succeeds(make("later", 8, 1)));
  const HeelRun run = join({"first", "later"}, "joined");
  EXPECT_TRUE(run.succeeded());
  EXPECT_THAT(run.err, HasSubstr("heel: no part has the seeds 6 to 7"));
}

TEST_F(JoinedHomes, MustBeOfOneExperiment) {
  ASSERT_TRUE(succeeds(make("first", 5, 1)));
  ASSERT_TRUE(succeeds(make("rough", 6, 1, {"--rough", "latency"})));
  EXPECT_TRUE(failsWith(join({"first", "first"}, "out"), {"the same run", "seed 5"}));
  EXPECT_TRUE(failsWith(join({"first", "rough"}, "out"), {"rough", "other options"}));
  writeText(folder_ / "other/summary.json", R"({"complete": true})");
  EXPECT_TRUE(failsWith(join({"other"}, "out"), {"no complete results of this experiment"}));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace heel::test
