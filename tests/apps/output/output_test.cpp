// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/output/full_disk.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/output/output.hpp>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>

namespace heel::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// All below a folder, hidden things too.
std::vector<std::string> contentOf(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class OutputTest : public testing::Test {
 protected:
  OutputPlan planFor(const std::string& name, OutputKind kind = OutputKind::kFolder) const {
    return {"test", kind, folder_ / name, {}};
  }

  /// Writes files of these names, with `text` in them.
  void write(const OutputPlan& plan, const std::vector<std::string>& names,
             const std::string& text = "new", bool complete = true) const {
    Output output(plan);
    for (const std::string& name : names) writeFile(output / name, text);
    output.commit(complete);
  }

  std::string refusalOf(const OutputPlan& plan) const {
    return messageOf<std::invalid_argument>([&] { const Output output(plan); });
  }

  TempFolder folder_;
};

TEST_F(OutputTest, HasItsPlaceOnlyWhenItIsCommitted) {
  Output output(planFor("out"));
  writeFile(output / "a.csv", "a");
  writeFile(output / "deep/b.csv", "b");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  output.commit();
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "a");
  EXPECT_EQ(readText(folder_ / "out/deep/b.csv"), "b");
  EXPECT_THAT(contentOf(folder_.path()),
              ElementsAre("out", "out/.heel", "out/a.csv", "out/deep", "out/deep/b.csv"));
}

TEST_F(OutputTest, LeavesTheFormerOneUnlessCommitted) {
  write(planFor("out"), {"a.csv"}, "former");
  {
    const Output output(planFor("out"));
    writeFile(output / "a.csv", "new");
  }
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "former");
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre("out", "out/.heel", "out/a.csv"));
}

TEST_F(OutputTest, TakesTheFormersFilesAway) {
  write(planFor("out"), {"a.csv", "deep/b.csv"}, "former");
  write(planFor("out"), {"a.csv"});
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "new");
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre("out", "out/.heel", "out/a.csv"));
}

TEST_F(OutputTest, KeepsWhatSomebodyElsePutIntoTheFolder) {
  write(planFor("out"), {"a.csv", "deep/b.csv"}, "former");
  writeText(folder_ / "out/notes.txt", "mine");
  writeText(folder_ / "out/deep/frame_000001.png", "mine");
  write(planFor("out"), {"a.csv"});
  EXPECT_EQ(readText(folder_ / "out/notes.txt"), "mine");
  EXPECT_EQ(readText(folder_ / "out/deep/frame_000001.png"), "mine");
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "new");
  EXPECT_FALSE(fs::exists(folder_ / "out/deep/b.csv"));
}

TEST_F(OutputTest, RefusesNamesThatSomebodyElsesFilesHave) {
  writeText(folder_ / "out/a.csv", "mine");
  OutputPlan plan = planFor("out");
  plan.names = {"a.csv"};
  EXPECT_THAT(refusalOf(plan), HasSubstr("out/a.csv: is there already"));
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre("out", "out/a.csv"));
}

TEST_F(OutputTest, GoesBesideIfANameIsTakenMeanwhile) {
  Output output(planFor("out"));
  writeFile(output / "a.csv", "new");
  writeText(folder_ / "out/a.csv", "mine");
  EXPECT_THAT(messageOf([&] { output.commit(); }),
              testing::AllOf(HasSubstr("out/a.csv is there already"), HasSubstr("out.1")));
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "mine");
  EXPECT_EQ(readText(folder_ / "out.1/a.csv"), "new");
}

TEST_F(OutputTest, ThatIsNotCompleteReplacesNoCompleteOne) {
  write(planFor("out"), {"a.csv"}, "nine hours");
  write(planFor("out"), {"a.csv"}, "a second", false);
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "nine hours");
  EXPECT_EQ(readText(folder_ / "out.1/a.csv"), "a second");
  write(planFor("out.1"), {"a.csv"}, "two seconds", false);
  EXPECT_EQ(readText(folder_ / "out.1/a.csv"), "two seconds");
}

TEST_F(OutputTest, DoesNotReplaceWhatAnotherCommandMade) {
  write(planFor("out"), {"a.csv"}, "former");
  OutputPlan other = planFor("out");
  other.by = "other";
  EXPECT_THAT(refusalOf(other), HasSubstr("holds results of 'heel test'"));
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "former");
}

TEST_F(OutputTest, MayNotMixWithWhatIsRead) {
  writeText(folder_ / "in/deep/a.png", "picture");
  fs::create_directory_symlink(folder_ / "in", folder_ / "link");
  for (const auto& [out, in] :
       std::vector<std::pair<std::string, std::string>>{{"in", "in"},
                                                        {"in/", "in"},
                                                        {"in/out", "in"},
                                                        {".", "in"},
                                                        {"link/out", "in"},
                                                        {"in", "link"},
                                                        {"in", "in/deep/a.png"}}) {
    OutputPlan plan = planFor(out);
    plan.inputs = {folder_ / in};
    EXPECT_THAT(refusalOf(plan), HasSubstr("which is read")) << out << " of " << in;
  }
  OutputPlan file = planFor("in/a.bag", OutputKind::kFile);
  file.inputs = {folder_ / "in"};
  EXPECT_THAT(refusalOf(file), HasSubstr("which is read"));
  OutputPlan beside = planFor("inner", OutputKind::kFolder);
  beside.inputs = {folder_ / "in"};
  EXPECT_EQ(refusalOf(beside), "");
  EXPECT_EQ(readText(folder_ / "in/deep/a.png"), "picture");
}

TEST_F(OutputTest, IsWrittenByOneRunAtATime) {
  Output first(planFor("out"));
  writeFile(first / "a.csv", "first");
  EXPECT_THAT(refusalOf(planFor("out")), HasSubstr("another run writes there"));
  first.commit();
  write(planFor("out"), {"a.csv"}, "second");
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "second");
}

TEST_F(OutputTest, OfAKilledRunIsRemovedByTheNextOne) {
  write(planFor("out"), {"a.csv"}, "former");
  const pid_t child = fork();
  if (child == 0) {
    const Output output(planFor("out"));
    writeFile(output / "deep/b.csv", "never finished");
    _exit(0);  // as if killed: nothing is cleaned up
  }
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(fs::exists(folder_ / ".out.heel-part/deep/b.csv"));
  EXPECT_EQ(readText(folder_ / "out/a.csv"), "former");
  write(planFor("out"), {"a.csv"});
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre("out", "out/.heel", "out/a.csv"));
}

TEST_F(OutputTest, DoesNotRemoveAFolderThatOnlyHasTheNameOfAKilledRuns) {
  writeText(folder_ / ".out.heel-part/letter.txt", "dear");
  EXPECT_THAT(refusalOf(planFor("out")), HasSubstr("is in the way"));
  EXPECT_EQ(readText(folder_ / ".out.heel-part/letter.txt"), "dear");
}

TEST_F(OutputTest, DoesNotTrustAManifestToNameFilesElsewhere) {
  writeText(folder_ / "precious.txt", "mine");
  writeText(folder_ / "elsewhere/b.txt", "mine");
  write(planFor("out"), {"a.csv"});
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "out/link");
  writeText(folder_ / "out/.heel", "#\n\"test\" complete\n\"a.csv\"\n\"../precious.txt\"\n\"" +
                                       (folder_ / "precious.txt").string() +
                                       "\"\n\"link/b.txt\"\n");
  write(planFor("out"), {"c.csv"});
  EXPECT_EQ(readText(folder_ / "precious.txt"), "mine");
  EXPECT_EQ(readText(folder_ / "elsewhere/b.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "out/a.csv"));
}

TEST_F(OutputTest, KnowsItsFilesWhateverTheirNames) {
  const std::vector<std::string> names = {"with \"quotes\"", "with\nline", "back\\slash", "\xff"};
  write(planFor("out"), names, "former");
  write(planFor("out"), {"a.csv"});
  EXPECT_THAT(contentOf(folder_ / "out"), ElementsAre(".heel", "a.csv"));
}

TEST_F(OutputTest, StaysTheSameFolderForWhomStandsInIt) {
  write(planFor("out"), {"a.csv"}, "former");
  const fs::path before = fs::current_path();
  fs::current_path(folder_ / "out");
  write({"test", OutputKind::kFolder, ".", {}}, {"b.csv"});
  EXPECT_EQ(readText("b.csv"), "new");
  EXPECT_FALSE(fs::exists("a.csv"));
  fs::current_path(before);
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre("out", "out/.heel", "out/b.csv"));
}

TEST_F(OutputTest, FileReplacesOnlyOneThatItMade) {
  const OutputPlan plan = planFor("a.yaml", OutputKind::kFile);
  write(plan, {"a.yaml", "a.png"}, "former");
  write(plan, {"a.yaml", "a.png"});
  EXPECT_EQ(readText(folder_ / "a.png"), "new");
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre(".a.yaml.heel", "a.png", "a.yaml"));
  writeText(folder_ / "b.yaml", "mine");
  EXPECT_THAT(refusalOf(planFor("b.yaml", OutputKind::kFile)), HasSubstr("is there already"));
  OutputPlan with_picture = planFor("c.yaml", OutputKind::kFile);
  with_picture.names = {"a.png"};
  EXPECT_THAT(refusalOf(with_picture), HasSubstr("a.png: is there already"));
}

TEST_F(OutputTest, ThatMustBeAloneRefusesAFolderOfOtherThings) {
  OutputPlan plan = planFor("out");
  plan.alone = true;
  write(plan, {"a.csv"}, "former");
  write(plan, {"a.csv"});
  writeText(folder_ / "out/letter.txt", "dear");
  EXPECT_THAT(refusalOf(plan), HasSubstr("did not make"));
}

TEST_F(OutputTest, ThatCannotBeWrittenIsNamed) {
  writeText(folder_ / "file", "");
  const auto problem = [](const OutputPlan& plan) {
    return messageOf<OutputError>([&] { const Output output(plan); });
  };
  EXPECT_EQ(problem(planFor("file")),
            (folder_ / "file").string() + " cannot be written: Not a directory");
  EXPECT_THAT(problem(planFor("file/out")), HasSubstr("file/out cannot be written"));
  fs::create_directories(folder_ / "a.png/inside");
  EXPECT_EQ(problem(planFor("a.png", OutputKind::kFile)),
            (folder_ / "a.png").string() + " cannot be written: Is a directory");
  EXPECT_THROW(Output({"test", OutputKind::kFile, "", {}}), std::invalid_argument);
}

TEST_F(OutputTest, FullDiskIsAnErrorThatNamesTheFileAsItWillBeCalled) {
  const FileSizeLimit limit(4000);
  {
    const Output output(planFor("out"));
    EXPECT_EQ(
        messageOf<OutputError>([&] { writeFile(output / "a.csv", std::string(100'000, 'x')); }),
        (folder_ / "out/a.csv").string() + " cannot be written: File too large");
    EXPECT_EQ(messageOf<OutputError>([&] {
                writeWith(output / "b.bt", [](const fs::path& file) {
                  throw std::runtime_error(file.string() + ": no room");
                });
              }),
              (folder_ / "out/b.bt").string() + ": no room");
  }
  EXPECT_THAT(contentOf(folder_.path()), ElementsAre());
}

TEST(OutputFileTest, FullDiskIsAnErrorThatLeavesNothing) {
  const TempFolder folder;
  const auto path = folder / "a.csv";
  const std::string expected = path.string() + " cannot be written: No space left on device";
  makeDiskFullFor(path);  // found when the last bytes are flushed
  EXPECT_EQ(messageOf([&] { writeFile(path, "short"); }), expected);
  EXPECT_FALSE(isThere(path));
  makeDiskFullFor(path);  // found while writing
  EXPECT_EQ(messageOf([&] { OutputFile(path).write(std::string(1U << 20U, 'x')); }), expected);
  EXPECT_FALSE(isThere(path));
}

TEST(OutputFileTest, ThatWasNotClosedIsRemoved) {
  const TempFolder folder;
  OutputFile(folder / "a.csv").write("half");
  EXPECT_FALSE(isThere(folder / "a.csv"));
  OutputFile file(folder / "a.csv");
  file.write("whole");
  file.close();
  EXPECT_EQ(readText(folder / "a.csv"), "whole");
  EXPECT_THROW(file.write("x"), std::logic_error);
}

}  // namespace
}  // namespace heel::test
