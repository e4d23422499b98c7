// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/report/atomic_file.hpp"

#include "tests/apps/full_disk.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>

namespace {

using heel::AtomicFile;
using heel::test::isThere;
using heel::test::messageOf;
using heel::test::readText;
using heel::test::TempFolder;
using heel::test::writeText;

TEST(AtomicFile, HasItsNameOnlyWhenItIsComplete) {
  const TempFolder folder;
  AtomicFile file(folder / "a.csv");
  file.write("one\n");
  EXPECT_FALSE(isThere(folder / "a.csv"));
  file.write("two\n");
  file.close();
  EXPECT_FALSE(isThere(folder / "a.csv"));
  file.commit();
  EXPECT_EQ(readText(folder / "a.csv"), "one\ntwo\n");
  EXPECT_FALSE(isThere(heel::temporaryBeside(folder / "a.csv")));
}

TEST(AtomicFile, LeavesTheFormerFileUnlessCommitted) {
  const TempFolder folder;
  writeText(folder / "a.csv", "former");
  { AtomicFile(folder / "a.csv").write("new"); }
  EXPECT_EQ(readText(folder / "a.csv"), "former");
  EXPECT_FALSE(isThere(heel::temporaryBeside(folder / "a.csv")));
  heel::writeFile(folder / "a.csv", "new");
  EXPECT_EQ(readText(folder / "a.csv"), "new");
}

TEST(AtomicFile, FullDiskIsAnErrorThatLeavesNothing) {
  const TempFolder folder;
  const auto path = folder / "a.csv";
  const std::string expected = path.string() + " cannot be written: No space left on device";

  heel::test::makeDiskFullFor(path);  // found when the last bytes are flushed
  EXPECT_EQ(messageOf([&] { heel::writeFile(path, "short"); }), expected);
  EXPECT_FALSE(isThere(path));
  EXPECT_FALSE(isThere(heel::temporaryBeside(path)));

  heel::test::makeDiskFullFor(path);  // found while writing
  EXPECT_EQ(messageOf([&] { AtomicFile(path).write(std::string(1U << 20U, 'x')); }), expected);
  EXPECT_FALSE(isThere(path));
  EXPECT_FALSE(isThere(heel::temporaryBeside(path)));
}

TEST(AtomicFile, FolderThatIsMissingOrAFileIsAnError) {
  const TempFolder folder;
  EXPECT_EQ(messageOf([&] { AtomicFile(folder / "no/a.csv"); }),
            (folder / "no/a.csv").string() + " cannot be written: No such file or directory");
  writeText(folder / "file", "");
  EXPECT_EQ(messageOf([&] { AtomicFile(folder / "file/a.csv"); }),
            (folder / "file/a.csv").string() + " cannot be written: Not a directory");
}

TEST(AtomicFile, NameThatIsTakenByAFolderIsAnError) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "a.csv/inside");
  EXPECT_EQ(messageOf([&] { heel::writeFile(folder / "a.csv", "text"); }),
            (folder / "a.csv").string() + " cannot be written: Is a directory");
  EXPECT_FALSE(isThere(heel::temporaryBeside(folder / "a.csv")));
}

TEST(AtomicFile, WritingAfterTheEndIsACallersError) {
  const TempFolder folder;
  AtomicFile file(folder / "a.csv");
  file.commit();
  EXPECT_THROW(file.write("x"), std::logic_error);
  EXPECT_THROW(file.commit(), std::logic_error);
}

}  // namespace
