// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/mcap_records.hpp>

#include <gmock/gmock.h>
#include <lz4frame.h>

#include <cstring>

namespace heel {
namespace {

using test::messageOf;
using test::readText;
using test::TempFolder;
using test::writeText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A file put together record by record, as other writers make them.
class McapParts {
 public:
  explicit McapParts(const std::string& profile = "ros2", const std::string& encoding = "cdr")
      : bytes_(kMcapMagic.begin(), kMcapMagic.end()), encoding_(encoding) {
    appendRecord(bytes_, McapRecord::kHeader, McapContent().text(profile).text("test"));
  }

  /// The schema and the channel of "/odom", and odometry of these times.
  BagBytes odometry(const std::vector<int>& times_ns) const {
    BagBytes records;
    McapContent schema, channel;
    schema.number(std::uint16_t{1}).text("nav_msgs/msg/Odometry").text("ros2msg").text("");
    appendRecord(records, McapRecord::kSchema, schema);
    channel.number(std::uint16_t{7}).number(std::uint16_t{1}).text("/odom").text(encoding_);
    appendRecord(records, McapRecord::kChannel, channel.list({}));
    const BagForm form = encoding_ == "ros1" ? BagForm::kRos1 : BagForm::kRos2;
    for (const int ns : times_ns) {
      OdometryMsg odometry;
      odometry.header.stamp.ns = ns;
      BagBytes bytes;
      writeMessage(form, odometry, bytes);
      McapContent message;
      message.number(std::uint16_t{7}).number(std::uint32_t{0}).time(ns).time(ns).raw(bytes);
      appendRecord(records, McapRecord::kMessage, message);
    }
    return records;
  }

  McapParts& add(const BagBytes& records) {
    bytes_.insert(bytes_.end(), records.begin(), records.end());
    return *this;
  }
  McapParts& addChunk(const std::string& packing, const BagBytes& packed, std::uint64_t size,
                      std::uint32_t crc = 0) {
    McapContent chunk;
    chunk.time(0).time(0).number(size).number(crc).text(packing);
    chunk.number<std::uint64_t>(packed.size()).raw(packed);
    appendRecord(bytes_, McapRecord::kChunk, chunk);
    return *this;
  }

  std::filesystem::path write(const TempFolder& folder, bool is_closed = true) {
    BagBytes bytes = bytes_;
    if (is_closed) {
      appendRecord(bytes, McapRecord::kDataEnd, McapContent().number(std::uint32_t{0}));
      McapContent footer;
      footer.number(std::uint64_t{0}).number(std::uint64_t{0}).number(std::uint32_t{0});
      appendRecord(bytes, McapRecord::kFooter, footer);
      bytes.insert(bytes.end(), kMcapMagic.begin(), kMcapMagic.end());
    }
    writeText(folder / "a.mcap", {bytes.begin(), bytes.end()});
    return folder / "a.mcap";
  }

 private:
  BagBytes bytes_;
  std::string encoding_;
};

/// The times of the odometry that is read.
std::vector<int> readTimes(const std::filesystem::path& path, std::string* lost = nullptr) {
  const auto bag = openBag(path);
  std::vector<int> times_ns;
  BagMessage raw;
  OdometryMsg odometry;
  while (bag->next(raw)) {
    EXPECT_EQ(bag->topics()[raw.topic].name, "/odom");
    EXPECT_TRUE(bag->topics()[raw.topic].holds<OdometryMsg>());
    bag->read(raw, odometry);
    EXPECT_EQ(odometry.header.stamp.ns, raw.stamp_ns);
    times_ns.push_back(static_cast<int>(raw.stamp_ns));
  }
  if (lost != nullptr) *lost = bag->lost();
  return times_ns;
}

BagBytes packedByLz4(const BagBytes& bytes) {
  BagBytes packed(LZ4F_compressFrameBound(bytes.size(), nullptr));
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

TEST(Mcap, WithoutChunksIsRead) {
  const TempFolder folder;
  McapParts parts;
  std::string lost;
  EXPECT_THAT(readTimes(parts.add(parts.odometry({1, 2, 3})).write(folder), &lost),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(lost, IsEmpty());
}

TEST(Mcap, OfEveryPackingIsRead) {
  const TempFolder folder;
  McapParts parts;
  const BagBytes one = parts.odometry({1, 2}), two = parts.odometry({3, 4, 5, 6, 7, 8});
  BagBytes packed;
  ASSERT_TRUE(packByZstd(two, packed));
  parts.addChunk("", one, one.size()).addChunk("zstd", packed, two.size());
  const BagBytes three = parts.odometry({9});
  parts.addChunk("lz4", packedByLz4(three), three.size());
  EXPECT_THAT(readTimes(parts.write(folder)), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
}

TEST(Mcap, OfRos1MessagesIsReadWithoutAProfileToo) {
  for (const char* profile : {"ros1", ""}) {
    const TempFolder folder;
    McapParts parts(profile, "ros1");
    const BagBytes records = parts.odometry({4});
    const auto path = parts.addChunk("", records, records.size()).write(folder);
    EXPECT_EQ(openBag(path)->form(), BagForm::kRos1);
    EXPECT_THAT(readTimes(path), ElementsAre(4));
  }
}

TEST(Mcap, WithRecordsAndChannelsThatAreUnknownIsReadWithoutThem) {
  const TempFolder folder;
  McapParts parts;
  BagBytes foreign;
  appendRecord(foreign, static_cast<McapRecord>(0x90), McapContent().text("private"));
  McapContent channel, message;
  channel.number(std::uint16_t{8}).number(std::uint16_t{0}).text("/json").text("json");
  appendRecord(foreign, McapRecord::kChannel, channel.list({}));
  message.number(std::uint16_t{8}).number(std::uint32_t{0}).time(1).time(1);
  appendRecord(foreign, McapRecord::kMessage, message);
  EXPECT_THAT(readTimes(parts.add(foreign).add(parts.odometry({3})).write(folder)), ElementsAre(3));
}

TEST(Mcap, ThatItsRecorderDidNotCloseSaysSo) {
  const TempFolder folder;
  McapParts parts;
  std::string lost;
  EXPECT_THAT(readTimes(parts.add(parts.odometry({1})).write(folder, false), &lost),
              ElementsAre(1));
  EXPECT_THAT(lost, HasSubstr("a.mcap: the bag was not closed by its recorder"));
}

TEST(Mcap, WhoseChunkHasAnotherChecksumLosesItAndSaysSo) {
  const TempFolder folder;
  McapParts parts;
  const BagBytes wrong = parts.odometry({1}), right = parts.odometry({2});
  parts.addChunk("", wrong, wrong.size(), 12345);
  parts.addChunk("", right, right.size(), mcapCrc(right.data(), right.size()));
  std::string lost;
  EXPECT_THAT(readTimes(parts.write(folder), &lost), ElementsAre(2));
  EXPECT_THAT(lost, HasSubstr("a.mcap: the chunk at byte"));
}

TEST(Mcap, WhoseChunkAsksForTooMuchLosesItAndSaysSo) {
  const TempFolder folder;
  McapParts parts;
  parts.addChunk("zstd", BagBytes(40, 'Z'), 0xF0000000U).add(parts.odometry({5}));
  std::string lost;
  EXPECT_THAT(readTimes(parts.write(folder), &lost), ElementsAre(5));
  EXPECT_THAT(lost, HasSubstr("asks for 3840 MiB of memory"));
}

TEST(Mcap, PackedByWhatIsUnknownSaysSo) {
  const TempFolder folder;
  McapParts parts;
  std::string lost;
  EXPECT_THAT(readTimes(parts.addChunk("brotli", {1, 2}, 2).write(folder), &lost), IsEmpty());
  EXPECT_THAT(lost, HasSubstr("packed by 'brotli'"));
}

/// As `ros2 bag record` leaves it, with a split.
TEST(Mcap, OfAFolderIsReadFileAfterFile) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "b");
  for (const int part : {0, 1}) {
    const auto bag = createBag(folder / ("b/b_" + std::to_string(part) + ".mcap"));
    OdometryMsg odometry;
    for (int i = 1; i <= 2; ++i) {
      odometry.header.stamp.ns = 10 * part + i;
      bag->write("/odom", odometry.header.stamp.ns, odometry);
    }
    bag->commit();
  }
  EXPECT_TRUE(isBag(folder / "b"));
  EXPECT_THAT(readTimes(folder / "b"), ElementsAre(1, 2, 11, 12));
  writeText(folder / "b/metadata.yaml",
            "rosbag2_bagfile_information: {storage_identifier: mcap, relative_file_paths: "
            "[b_0.mcap, b_1.mcap]}");
  const auto bag = openBag(folder / "b");
  ASSERT_NE(bag->index(), nullptr);
  EXPECT_EQ(bag->index()->topics[0].count, 4U);
  EXPECT_EQ(bag->index()->last_ns, 12);
  std::filesystem::remove(folder / "b/b_1.mcap");
  std::string lost;
  EXPECT_THAT(readTimes(folder / "b", &lost), ElementsAre(1, 2));
  EXPECT_THAT(lost, HasSubstr("b_1.mcap"));
}

TEST(Mcap, WhoseSummaryIsDamagedIsReadWithoutIt) {
  const TempFolder folder;
  const auto path = folder / "a.mcap";
  const auto bag = createBag(path);
  OdometryMsg odometry;
  for (int i = 1; i <= 3; ++i) {
    odometry.header.stamp.ns = i;
    bag->write("/odom", i, odometry);
  }
  bag->commit();
  std::string bytes = readText(path);
  bytes[bytes.size() - 60] = static_cast<char>(bytes[bytes.size() - 60] ^ 0x55);
  writeText(path, bytes);
  EXPECT_EQ(openBag(path)->index(), nullptr);
  EXPECT_THAT(readTimes(path), ElementsAre(1, 2, 3));
}

}  // namespace
}  // namespace heel
