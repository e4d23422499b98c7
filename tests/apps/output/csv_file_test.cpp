// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/output/csv_file.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace {

using heel::fixedText;
using heel::test::messageOf;
using heel::test::TempFolder;
using heel::test::writeText;

TEST(FixedText, HasSoManyDecimalsAndNoNegativeZero) {
  EXPECT_EQ(fixedText(1.0, 3), "1.000");
  EXPECT_EQ(fixedText(-1.2345, 2), "-1.23");
  EXPECT_EQ(fixedText(1305031102.175304, 6), "1305031102.175304");
  EXPECT_EQ(fixedText(-0.0004, 3), "0.000");
  EXPECT_EQ(fixedText(-0.0, 0), "0");
  EXPECT_EQ(fixedText(-0.0006, 3), "-0.001");
  EXPECT_EQ(fixedText(std::nan(""), 3), "");
  EXPECT_EQ(fixedText(std::numeric_limits<double>::infinity(), 3), "");
  EXPECT_EQ(fixedText(std::numeric_limits<double>::max(), 1).size(), 311U);
}

TEST(CsvWriter, QuotesOnlyWhatHasToBe) {
  const TempFolder folder;
  heel::CsvWriter csv(folder / "a.csv", {"n", "text", "value", "yes"});
  csv.integer(-3).text("plain words").number(0.5, 2).flag(true).endRow();
  csv.integer(4).text("a, \"b\"\nc").number(std::nan(""), 2).flag(false).endRow();
  csv.close();
  EXPECT_EQ(heel::test::readText(folder / "a.csv"),
            "n,text,value,yes\n-3,plain words,0.50,1\n4,\"a, \"\"b\"\" c\",,0\n");
}

TEST(CsvWriter, RowOfAnotherWidthIsACallersError) {
  const TempFolder folder;
  heel::CsvWriter csv(folder / "a.csv", {"a", "b"});
  EXPECT_THROW(csv.integer(1).endRow(), std::logic_error);
}

TEST(CsvReader, ReadsWhatTheWriterWrote) {
  const TempFolder folder;
  heel::CsvWriter writer(folder / "a.csv", {"n", "text", "value", "yes"});
  writer.integer(-3).text("a, \"b\" c").number(0.5, 2).flag(true).endRow();
  writer.close();
  heel::CsvReader reader(folder / "a.csv", {"yes", "n", "text", "value"});
  ASSERT_TRUE(reader.next());
  EXPECT_TRUE(reader.flag(0));
  EXPECT_EQ(reader.integer(1), -3);
  EXPECT_EQ(reader.text(2), "a, \"b\" c");
  EXPECT_EQ(reader.number(3), 0.5);
  EXPECT_FALSE(reader.next());
}

TEST(CsvReader, TakesWindowsLinesBlanksAndMoreColumns) {
  const TempFolder folder;
  writeText(folder / "a.csv", "other,x\r\n\r\n1, 2.5 \r\n\n3,4\n");
  heel::CsvReader reader(folder / "a.csv", {"x"});
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(0), 2.5);
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(0), 4.0);
  EXPECT_FALSE(reader.next());
}

TEST(CsvReader, NamesFileLineAndColumnOfWhatIsWrong) {
  const TempFolder folder;
  const auto file = folder / "a.csv";
  const std::string name = file.string();
  const auto message = [&](const std::string& text) {
    writeText(file, text);
    return messageOf([&] {
      heel::CsvReader reader(file, {"x", "n", "b"});
      while (reader.next()) {
        reader.number(0);
        reader.integer(1);
        reader.flag(2);
      }
    });
  };
  EXPECT_EQ(message("x,n,b\n1.5,2,0\n"), "");
  EXPECT_EQ(message(""), name + " is empty; a header line was expected");
  EXPECT_EQ(message("x,n\n"), name + ", line 1: the header has no column 'b'");
  EXPECT_EQ(message("x,n,b\n1,2,1\n1,2\n"), name + ", line 3: there are 2 fields, but 3 columns");
  EXPECT_EQ(message("x,n,b\nabc,2,1\n"), name + ", line 2: x is 'abc', not a number");
  EXPECT_EQ(message("x,n,b\nnan,2,1\n"), name + ", line 2: x is 'nan', not a number");
  EXPECT_EQ(message("x,n,b\n,2,1\n"), name + ", line 2: x is '', not a number");
  EXPECT_EQ(message("x,n,b\n1,2.5,1\n"), name + ", line 2: n is '2.5', not a whole number");
  EXPECT_EQ(message("x,n,b\n1,2,yes\n"), name + ", line 2: b is 'yes', not 0 or 1");
  std::filesystem::remove(file);
  EXPECT_EQ(messageOf([&] { heel::CsvReader(file, {"x"}); }), name + " cannot be read");
}

}  // namespace
