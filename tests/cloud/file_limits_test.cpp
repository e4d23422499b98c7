// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/cloud/files.hpp>
#include <heel/cloud/image_extent.hpp>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/stat.h>

#include <limits>
#include <vector>

namespace heel::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();

TEST(FileLimits, AProductIsNeverTooSmall) {
  EXPECT_EQ(timesAtMost(6, 7), 42U);
  EXPECT_EQ(timesAtMost(std::size_t{1} << 40U, std::size_t{1} << 40U), kMost);
  EXPECT_EQ(timesAtMost(kMost, 0), 0U);
}

TEST(FileLimits, AFileMayAskForAsMuchAsItsBytesMakeLikely) {
  const std::size_t small = memoryLimit(100), large = memoryLimit(std::size_t{1} << 34U);
  EXPECT_NO_THROW(checkMemory("it", small, 100));
  EXPECT_THAT(messageOf([&] { checkMemory("it", small + 1, 100); }), HasSubstr("it asks for"));
  EXPECT_GE(large, small);
  EXPECT_LT(large, kMost);
}

TEST(FileLimits, APipeAndADeviceAreNoFiles) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(messageOf([&] { checkIsFile(folder / "pipe"); }), HasSubstr("pipe: it is a pipe"));
  EXPECT_THROW(checkIsFile("/dev/zero"), std::runtime_error);
  EXPECT_NO_THROW(checkIsFile(folder.write("text", "")));
  EXPECT_NO_THROW(checkIsFile(folder / "none")) << "whoever opens it says so";
}

TEST(ImageExtent, IsWhatTheDecoderFinds) {
  const cv::Mat image(37, 53, CV_8UC3, cv::Scalar(1, 2, 3));
  for (const char* format : {".png", ".jpg", ".bmp", ".ppm", ".tif"}) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(cv::imencode(format, image, bytes));
    const auto extent = imageExtent(bytes.data(), bytes.size());
    ASSERT_TRUE(extent) << format;
    EXPECT_EQ(extent->width, 53U) << format;
    EXPECT_EQ(extent->height, 37U) << format;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const std::vector<std::uint8_t> part(bytes.data(), bytes.data() + size);
      imageExtent(part.data(), part.size());  // a sanitizer sees what is read beyond
    }
  }
}

TEST(ImageExtent, OfAHugeImageRefusesItBeforeItIsDecoded) {
  const std::string pgm = "P5 # wide\n 2000000 3000000\n255\n";
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(pgm.data());
  EXPECT_THAT(messageOf([&] { checkImageMemory("a.pgm: the image", bytes, pgm.size(), 1); }),
              HasSubstr("a.pgm: the image of 2000000x3000000 pixels asks for"));
  EXPECT_THAT(messageOf([&] { checkImageMemory("the image", bytes + 1, pgm.size() - 1, 1); }),
              HasSubstr("the image cannot be decoded"));
}

}  // namespace
}  // namespace heel::test
