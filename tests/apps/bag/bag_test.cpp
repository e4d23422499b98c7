// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/ros1_records.hpp>
#include <heel/apps/bag/sqlite_file.hpp>

#include <gmock/gmock.h>

#include <cstring>
#include <random>

namespace heel {
namespace {

using test::messageOf;
using test::readText;
using test::TempFolder;
using test::truncateBy;
using test::writeText;
using testing::HasSubstr;
using testing::IsEmpty;

/// Enough for SQLite to move the root of its tree behind what it finds.
constexpr int kScans = 2000;

LaserScanMsg scanOf(int number) {
  LaserScanMsg scan;
  scan.header.stamp.ns = number * 100000000LL;
  scan.header.frame_id = "laser";
  // Hardly to be packed, so that what is damaged is as much of all formats.
  std::mt19937 random(static_cast<unsigned>(number));
  for (int i = 0; i < 1999; ++i) scan.ranges.push_back(static_cast<float>(random()));
  scan.ranges.push_back(static_cast<float>(number));
  return scan;
}

void writeScans(const std::filesystem::path& path) {
  const auto bag = createBag(path);
  for (int i = 1; i <= kScans; ++i) bag->write("/scan", i * 100000000LL, scanOf(i));
  bag->commit();
}

/// The numbers of the scans that are read; each must be whole.
std::vector<int> readScans(const std::filesystem::path& path, std::string* lost = nullptr) {
  const auto bag = openBag(path);
  std::vector<int> numbers;
  BagMessage raw;
  LaserScanMsg scan;
  while (bag->next(raw)) {
    EXPECT_TRUE(bag->topics()[raw.topic].holds<LaserScanMsg>());
    bag->read(raw, scan);
    EXPECT_EQ(scan.header.stamp.ns, raw.stamp_ns);
    EXPECT_EQ(scan.ranges.size(), 2000U);
    numbers.push_back(static_cast<int>(scan.ranges.back()));
  }
  if (lost != nullptr) *lost = bag->lost();
  return numbers;
}

std::vector<int> allScans() {
  std::vector<int> all;
  for (int i = 1; i <= kScans; ++i) all.push_back(i);
  return all;
}

/// In all formats.
class Bag : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path path() const { return folder_ / GetParam(); }
  /// The one file that holds the messages.
  std::filesystem::path file() const {
    return std::filesystem::is_directory(path()) ? path() / (std::string(GetParam()) + "_0.db3")
                                                 : path();
  }
  TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Formats, Bag,
                         testing::Values("scans.bag", "scans.db3", "scans.mcap", "scans"));

TEST_P(Bag, GivesBackAllThatWasWritten) {
  writeScans(path());
  EXPECT_TRUE(isBag(path()));
  std::string lost;
  EXPECT_EQ(readScans(path(), &lost), allScans());
  EXPECT_THAT(lost, IsEmpty());
}

TEST_P(Bag, HasNoNameBeforeItIsComplete) {
  const auto names = [&] {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      count += entry.path().filename().string().front() == '.' ? 0U : 1U;
    }
    return count;
  };
  {
    const auto bag = createBag(path());
    bag->write("/scan", 1, scanOf(1));
    EXPECT_EQ(names(), 0U);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_P(Bag, TakesThePlaceOfAnOlderOne) {
  writeScans(path());
  const auto bag = createBag(path());
  bag->write("/scan", 100000000, scanOf(1));
  bag->commit();
  EXPECT_EQ(readScans(path()), std::vector<int>{1});
}

TEST_P(Bag, ThatWasCutOffGivesItsBeginning) {
  writeScans(path());
  truncateBy(file(), std::filesystem::file_size(file()) / 2);
  std::string lost;
  const auto numbers = readScans(path(), &lost);
  ASSERT_GT(numbers.size(), 900U);
  ASSERT_LT(numbers.size(), 1100U);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], static_cast<int>(i + 1));
  EXPECT_THAT(lost, HasSubstr(path().string()));
  EXPECT_THAT(lost, HasSubstr("cut off"));
}

TEST_P(Bag, ThatIsDamagedInItsMiddleGivesWhatIsBeforeAndBehind) {
  writeScans(path());
  std::string bytes = readText(file());
  std::memset(&bytes[bytes.size() / 2], 0xA5, 20000);
  writeText(file(), bytes);
  const auto bag = openBag(path());
  std::vector<std::int64_t> stamps;
  BagMessage raw;
  while (bag->next(raw)) stamps.push_back(raw.stamp_ns);
  EXPECT_GT(stamps.size(), 1800U);
  EXPECT_EQ(stamps.front(), 100000000);
  EXPECT_EQ(stamps.back(), kScans * 100000000LL);
}

TEST_P(Bag, ThatIsEmptyOrSomethingElseIsAnErrorOfOneSentence) {
  writeScans(path());
  writeText(file(), "");
  EXPECT_THAT(messageOf([&] { openBag(path()); }), HasSubstr("empty (0 bytes)"));
  writeText(file(), std::string(5000, 'x'));
  EXPECT_THAT(messageOf([&] { openBag(path()); }), HasSubstr("is no ROS"));
  EXPECT_THAT(messageOf([&] { openBag(folder_ / "none.bag"); }), HasSubstr("no such bag"));
}

/// The times of the messages that a query gives, in milliseconds.
std::vector<int> timesOf(BagReader& bag, const BagQuery& query) {
  bag.select(query);
  std::vector<int> times;
  BagMessage raw;
  while (bag.next(raw)) times.push_back(static_cast<int>(raw.stamp_ns / 1000000));
  return times;
}

/// Both topics have a message each 0.1 s, one 10 ms after the other's; all of one come first.
void writeTopicAfterTopic(const std::filesystem::path& path) {
  const auto bag = createBag(path);
  for (const int after_ms : {0, 10}) {
    for (int i = 1; i <= 300; ++i) {
      const std::int64_t ns = (i * 100LL + after_ms) * 1000000;
      bag->write(after_ms == 0 ? "/front" : "/back", ns, scanOf(i));
    }
  }
  bag->commit();
}

TEST_P(Bag, ThatWasWrittenTopicAfterTopicIsReadInTheOrderOfTime) {
  writeTopicAfterTopic(path());
  std::vector<int> expected;
  for (int i = 1; i <= 300; ++i) expected.insert(expected.end(), {i * 100, i * 100 + 10});
  EXPECT_EQ(timesOf(*openBag(path()), {}), expected);
}

TEST_P(Bag, GivesTheTopicsAndTheTimesThatAreAskedFor) {
  writeTopicAfterTopic(path());
  const auto bag = openBag(path());
  const BagQuery query{{"/back"}, 20'000'000'000, 20'210'000'000};
  EXPECT_EQ(timesOf(*bag, query), (std::vector<int>{20010, 20110, 20210}));
  EXPECT_EQ(timesOf(*bag, query), (std::vector<int>{20010, 20110, 20210}));
  EXPECT_THAT(timesOf(*bag, {{"/nothing"}}), IsEmpty());
  EXPECT_EQ(timesOf(*bag, {}).size(), 600U);
}

/// What is damaged elsewhere shows it: it is not met.
TEST_P(Bag, OfWhichAPartIsReadIsOpenedThereOnly) {
  if (std::string(GetParam()).find('.') == std::string::npos || file().extension() == ".db3") {
    GTEST_SKIP() << "SQLite's pages may lie anywhere";
  }
  writeScans(path());
  std::string bytes = readText(file());
  std::memset(&bytes[bytes.size() / 2], 0xA5, 20000);
  writeText(file(), bytes);
  const auto bag = openBag(path());
  EXPECT_EQ(timesOf(*bag, {{}, 180'000'000'000}).size(), 201U);
  EXPECT_THAT(bag->lost(), IsEmpty());
  EXPECT_LT(timesOf(*bag, {}).size(), 2000U);
  EXPECT_THAT(bag->lost(), HasSubstr("damaged"));
}

TEST_P(Bag, TellsByItsIndexHowManyMessagesThereAreAndWhen) {
  writeTopicAfterTopic(path());
  const auto bag = openBag(path());
  const BagIndex* index = bag->index();
  ASSERT_NE(index, nullptr);
  EXPECT_EQ(index->first_ns, 100'000'000);
  EXPECT_EQ(index->last_ns, 30'010'000'000);
  ASSERT_EQ(bag->topics().size(), 2U);
  EXPECT_EQ(bag->topics()[1].name, "/back");
  EXPECT_EQ(index->topics[1].count, 300U);
  EXPECT_EQ(index->topics[1].first_ns, 110'000'000);
  EXPECT_EQ(index->topics[1].last_ns, 30'010'000'000);
}

TEST_P(Bag, WithoutAMessageIsRead) {
  createBag(path())->commit();
  std::string lost;
  EXPECT_THAT(readScans(path(), &lost), IsEmpty());
  EXPECT_THAT(lost, IsEmpty());
}

/// Neither a crash nor more than was there, wherever it ends.
TEST_P(Bag, ThatWasCutOffAnywhereGivesNoMoreThanWasThere) {
  const auto bag = createBag(path());
  OdometryMsg odometry;
  for (int i = 1; i <= 5; ++i) {
    odometry.header.stamp.ns = i;
    bag->write("/odom", i, odometry);
  }
  bag->commit();
  const std::string bytes = readText(file());
  std::size_t before = 0;
  for (std::size_t size = 0; size < bytes.size(); size += 10) {
    writeText(file(), bytes.substr(0, size));
    std::size_t count = 0;
    try {
      const auto cut = openBag(path());
      BagMessage raw;
      while (cut->next(raw)) {
        cut->read(raw, odometry);
        EXPECT_EQ(odometry.header.stamp.ns, raw.stamp_ns);
        ++count;
      }
      EXPECT_TRUE(count == 5 || !cut->lost().empty()) << size;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("scans"));
    }
    EXPECT_GE(count, before) << size;
    EXPECT_LE(count, 5U);
    before = count;
  }
}

TEST(Ros1Bag, WithoutAnIndexIsReadWhole) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  writeScans(path);
  // As a recorder leaves it that was killed: index_pos is 0, and the index is not there.
  std::string bytes = readText(path);
  const auto at = bytes.find("index_pos=") + 10;
  std::uint64_t index = 0;
  std::memcpy(&index, &bytes[at], 8);
  std::memset(&bytes[at], 0, 8);
  writeText(path, bytes.substr(0, index));
  std::string lost;
  EXPECT_EQ(readScans(path, &lost), allScans());
  EXPECT_THAT(lost, HasSubstr("not closed by its recorder"));
}

TEST(Ros1Bag, OfAnotherVersionOfAMessageIsNotTakenForOurs) {
  EXPECT_TRUE(
      (BagTopic{"/scan", "sensor_msgs/LaserScan", LaserScanMsg::kMd5}.holds<LaserScanMsg>()));
  EXPECT_FALSE((BagTopic{"/scan", "sensor_msgs/LaserScan", "0"}.holds<LaserScanMsg>()));
  EXPECT_TRUE((BagTopic{"/tf", "tf/tfMessage", TFMessageMsg::kMd5}.holds<TFMessageMsg>()));
}

TEST(Ros1Bag, WhoseChunkIsDamagedInsideLosesTheMessagesThereOnly) {
  const TempFolder folder;
  const auto path = folder / "a.bag";
  writeScans(path);
  std::string bytes = readText(path);
  std::memset(&bytes[bytes.size() / 2], 0xA5, 20000);  // two scans and a half
  writeText(path, bytes);
  const auto bag = openBag(path);
  BagMessage raw;
  int count = 0;
  while (bag->next(raw)) ++count;
  EXPECT_GE(count, kScans - 4);
  EXPECT_THAT(bag->lost(), HasSubstr("damaged"));
}

TEST(Ros1Bag, OfTheOldFormatSaysHowToConvertIt) {
  const TempFolder folder;
  const auto path = folder.write("a.bag", "#ROSBAG V1.2\nand so on");
  EXPECT_THAT(messageOf([&] { openBag(path); }), HasSubstr("rosbag fix"));
}

/// As `rosbag record --split` leaves it; by their names, the last piece comes first.
class Ros1Pieces : public testing::Test {
 protected:
  void write(const std::string& name, std::vector<int> scans) {
    const auto bag = createBag(pieces() / name);
    for (const int i : scans) bag->write("/scan", i * 100000000LL, scanOf(i));
    bag->commit();
  }
  std::filesystem::path pieces() const { return folder_ / "pieces"; }
  TempFolder folder_;
};

TEST_F(Ros1Pieces, AreReadInTheOrderOfTheirTimes) {
  write("robot_9.bag", {1, 2});
  write("robot_10.bag", {3, 4});
  write("a_robot_11.bag", {5});
  writeText(pieces() / "notes.txt", "in the kitchen");
  EXPECT_TRUE(isBag(pieces()));
  EXPECT_EQ(readScans(pieces()), (std::vector<int>{1, 2, 3, 4, 5}));
  const auto bag = openBag(pieces());
  EXPECT_EQ(bag->form(), BagForm::kRos1);
  EXPECT_EQ(bag->topics().size(), 1U);
  ASSERT_NE(bag->index(), nullptr);
  EXPECT_EQ(bag->index()->topics[0].count, 5U);
}

TEST_F(Ros1Pieces, WithABrokenOneGiveTheOthersAndSaySo) {
  write("robot_0.bag", {1, 2});
  writeText(pieces() / "robot_1.bag", "nothing of a bag");
  std::string lost;
  EXPECT_EQ(readScans(pieces(), &lost), (std::vector<int>{1, 2}));
  EXPECT_THAT(lost, HasSubstr("robot_1.bag can't be read"));
}

TEST_F(Ros1Pieces, ThatWereRecordedAtTheSameTimeAreNoPieces) {
  write("camera.bag", {1, 50});
  write("laser.bag", {10, 60});
  EXPECT_THAT(messageOf([&] { openBag(pieces()); }),
              HasSubstr("pieces: camera.bag and laser.bag were recorded at the same time"));
}

TEST_F(Ros1Pieces, BesideOtherFilesAreNoBag) {
  write("robot_0.bag", {1});
  writeText(pieces() / "tracks.csv", "");
  EXPECT_FALSE(isBag(pieces()));
}

TEST(Ros2Bag, InAStorageThatWeCannotReadIsAnErrorThatNamesIt) {
  const TempFolder folder;
  writeText(
      folder / "b/metadata.yaml",
      "rosbag2_bagfile_information: {storage_identifier: tape, relative_file_paths: [b.reel]}");
  EXPECT_THAT(messageOf([&] { openBag(folder / "b"); }), HasSubstr("tape"));
}

TEST(Ros2Bag, WithoutMetadataIsReadFromItsFiles) {
  const TempFolder folder;
  writeScans(folder / "b");
  std::filesystem::remove(folder / "b/metadata.yaml");
  EXPECT_EQ(readScans(folder / "b"), allScans());
}

TEST(Ros2Bag, NeverReplacesAFolderOfOtherThings) {
  const TempFolder folder;
  writeText(folder / "b/letter.txt", "dear");
  EXPECT_THAT(messageOf<std::invalid_argument>([&] { createBag(folder / "b"); }),
              HasSubstr("did not make"));
  EXPECT_EQ(readText(folder / "b/letter.txt"), "dear");
}

TEST(Ros1Bag, WhoseChunkAsksForTooMuchLosesItAndSaysSo) {
  const TempFolder folder;
  BagBytes bytes(kRos1Magic.begin(), kRos1Magic.end());
  Ros1Fields chunk;
  chunk.set(Ros1Record::kChunk)
      .set("compression", std::string_view("bz2"))
      .set("size", 0xF0000000U);
  appendRecord(bytes, chunk, BagBytes(40, 'B'));
  writeText(folder / "a.bag", {bytes.begin(), bytes.end()});
  const auto bag = openBag(folder / "a.bag");
  BagMessage raw;
  EXPECT_FALSE(bag->next(raw));
  EXPECT_THAT(bag->lost(), HasSubstr("a.bag: a chunk that ends at byte"));
  EXPECT_THAT(bag->lost(), HasSubstr("asks for 3840 MiB of memory"));
}

/// A ROS 2 bag with the statements run on it.
std::filesystem::path changedBag(const TempFolder& folder, const std::string& sql) {
  const auto path = folder / "a.db3";
  const auto bag = createBag(path);
  bag->write("/scan", 1, scanOf(1));
  bag->commit();
  SqliteFile(path, SqliteFile::Use::kCreate).run(sql);
  return path;
}

TEST(Ros2Bag, WhoseTablesAreMadeUpIsRefused) {
  for (const std::string table : {"topics", "messages"}) {
    for (const std::string select :
         {"WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r) SELECT n AS id, n AS "
          "name, n AS type, 'cdr' AS serialization_format, 1 AS topic_id, n AS timestamp, x'00' AS "
          "data FROM r",
          "SELECT 1 AS id, 1 AS topic_id, 1 AS timestamp, zeroblob(900000000) AS data"}) {
      const TempFolder folder;
      const auto path =
          changedBag(folder, "DROP TABLE " + table + "; CREATE VIEW " + table + " AS " + select);
      EXPECT_THAT(messageOf([&] { openBag(path); }), HasSubstr("it has no table '" + table + "'"));
    }
  }
}

TEST(Ros2Bag, WhoseValuesAreMadeUpGivesNone) {
  const TempFolder folder;
  const auto path = changedBag(
      folder,
      "DROP TABLE messages; CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, "
      "timestamp INTEGER, data BLOB GENERATED ALWAYS AS (zeroblob(900000000)) VIRTUAL); INSERT "
      "INTO "
      "messages(topic_id, timestamp) VALUES(1, 1)");
  const auto bag = openBag(path);
  BagMessage raw;
  EXPECT_FALSE(bag->next(raw));
  EXPECT_THAT(bag->lost(), HasSubstr("a.db3"));
}

TEST(SqliteFile, EndsAStatementThatWorksOnWithoutARow) {
  const TempFolder folder;
  SqliteFile file(changedBag(folder, ""), SqliteFile::Use::kRead);
  SqliteQuery endless = file.query(
      "WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r) SELECT max(n) FROM r");
  EXPECT_EQ(endless.step(), SqliteQuery::Row::kBroken);
}

}  // namespace
}  // namespace heel
