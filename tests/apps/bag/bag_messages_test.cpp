// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/filled_message.hpp"

#include <gmock/gmock.h>

namespace heel {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
class EveryMessage : public testing::Test {};
using Messages =
    testing::Types<ImageMsg, CompressedImageMsg, CameraInfoMsg, PointCloud2Msg, LaserScanMsg,
                   OdometryMsg, PathMsg, OccupancyGridMsg, TFMessageMsg, PoseArrayMsg,
                   PoseStampedMsg, MarkerArrayMsg, TwistStampedMsg, StringMsg, DiagnosticArrayMsg>;
TYPED_TEST_SUITE(EveryMessage, Messages);

TYPED_TEST(EveryMessage, ComesBackAsItWasInBothForms) {
  for (const BagForm form : {BagForm::kRos1, BagForm::kRos2}) {
    const auto message = test::filled<TypeParam>();
    Bytes bytes, again;
    writeMessage(form, message, bytes);
    TypeParam back;
    readMessage(form, bytes.data(), bytes.size(), back);
    writeMessage(form, back, again);
    EXPECT_EQ(again, bytes);
    writeMessage(form, TypeParam(), again);
    EXPECT_NE(again, bytes);
  }
}

TYPED_TEST(EveryMessage, ThatIsCutOffAnywhereIsAnError) {
  for (const BagForm form : {BagForm::kRos1, BagForm::kRos2}) {
    Bytes bytes;
    writeMessage(form, test::filled<TypeParam>(), bytes);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const Bytes part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      TypeParam back;
      EXPECT_THROW(readMessage(form, part.data(), part.size(), back), std::runtime_error) << size;
    }
  }
}

TEST(MessageReader, DoesNotBelieveACountBeyondTheBytes) {
  const Bytes bytes = {0, 1, 0, 0, 255, 255, 255, 255};
  TFMessageMsg message;
  EXPECT_THROW(readMessage(BagForm::kRos2, bytes.data(), bytes.size(), message),
               std::runtime_error);
}

TEST(MessageReader, RefusesBigEndianCdr) {
  const Bytes bytes = {0, 0, 0, 0, 0, 0, 0, 0};
  TFMessageMsg message;
  EXPECT_THROW(readMessage(BagForm::kRos2, bytes.data(), bytes.size(), message),
               std::runtime_error);
}

TEST(MessageWriter, AlignsNumbersInCdrFromBehindTheEncoding) {
  HeaderMsg header;
  header.stamp.ns = 2000000003;
  header.frame_id = "ab";
  OdometryMsg odometry;
  odometry.header = header;
  odometry.child_frame_id = "c";
  Bytes bytes;
  writeMessage(BagForm::kRos2, odometry, bytes);
  const Bytes begin(bytes.begin(), bytes.begin() + 28);
  // sec, nanosec, length with the end, "ab\0", a byte of padding, length, "c\0" and its padding
  EXPECT_THAT(begin, testing::ElementsAre(0, 1, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 'a', 'b',
                                          0, 0, 2, 0, 0, 0, 'c', 0, 0, 0));
}

TEST(MessageWriter, KeepsTimesBeforeZero) {
  for (const BagForm form : {BagForm::kRos1, BagForm::kRos2}) {
    HeaderMsg header, back;
    header.stamp.ns = -1500000000;
    Bytes bytes;
    writeMessage(form, header, bytes);
    readMessage(form, bytes.data(), bytes.size(), back);
    EXPECT_EQ(back.stamp.ns, -1500000000);
  }
}

}  // namespace
}  // namespace heel
