// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/image_file.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cmath>

namespace {

using heel::test::messageOf;
using heel::test::TempFolder;
using heel::test::writeText;

/// An image that no codec can shorten to nothing.
cv::Mat noise(int width, int height, int type = CV_8UC3) {
  cv::Mat image(height, width, type);
  cv::RNG(7).fill(image, cv::RNG::UNIFORM, 1, 200);
  return image;
}

std::string colorMessage(const std::filesystem::path& file) {
  cv::Mat image;
  return messageOf([&] { heel::ImageReader().readColor(file, image); });
}

TEST(ImageReader, ReadsColourExactly) {
  const TempFolder folder;
  const cv::Mat written = noise(40, 30);
  cv::imwrite((folder / "a.png").string(), written);
  cv::Mat read;
  heel::ImageReader reader;
  reader.readColor(folder / "a.png", read);
  ASSERT_EQ(read.type(), CV_8UC3);
  EXPECT_EQ(cv::norm(read, written, cv::NORM_INF), 0.0);
}

TEST(ImageReader, ReadsGreyAsColour) {
  const TempFolder folder;
  cv::imwrite((folder / "a.png").string(), noise(40, 30, CV_8UC1));
  cv::Mat read;
  heel::ImageReader().readColor(folder / "a.png", read);
  EXPECT_EQ(read.type(), CV_8UC3);
}

TEST(ImageReader, DepthIsInMetresAndNaNWhereThereIsNone) {
  const TempFolder folder;
  const cv::Mat raw = (cv::Mat_<std::uint16_t>(1, 3) << 0, 2500, 65535);
  cv::imwrite((folder / "d.png").string(), raw);
  cv::Mat depth_m;
  heel::ImageReader().readDepth(folder / "d.png", 5000.0, depth_m);
  ASSERT_EQ(depth_m.type(), CV_32FC1);
  EXPECT_TRUE(std::isnan(depth_m.at<float>(0)));
  EXPECT_FLOAT_EQ(depth_m.at<float>(1), 0.5F);
  EXPECT_FLOAT_EQ(depth_m.at<float>(2), 13.107F);
}

TEST(ImageReader, DepthOfEightBitsIsAnError) {
  const TempFolder folder;
  cv::imwrite((folder / "d.png").string(), noise(8, 8));
  cv::Mat depth_m;
  EXPECT_EQ(
      messageOf([&] { heel::ImageReader().readDepth(folder / "d.png", 1000.0, depth_m); }),
      (folder / "d.png").string() + ": a depth image has one 16-bit channel, this has 3 of 8 bits");
}

class Truncated : public testing::TestWithParam<std::string> {};

TEST_P(Truncated, IsFoundAtEveryLength) {
  const TempFolder folder;
  const auto file = folder / ("a" + GetParam());
  cv::imwrite(file.string(), noise(32, 32));
  const std::string whole = heel::test::readText(file);
  ASSERT_EQ(colorMessage(file), "");
  for (std::size_t length = 9; length < whole.size(); length += 1 + length / 7) {
    writeText(file, whole.substr(0, length));
    EXPECT_EQ(colorMessage(file), file.string() + ": the image is truncated") << length;
  }
  writeText(file, whole.substr(0, whole.size() - 1));
  EXPECT_EQ(colorMessage(file), file.string() + ": the image is truncated");
}

INSTANTIATE_TEST_SUITE_P(Formats, Truncated, testing::Values(".png", ".jpg"));

TEST(ImageReader, ThumbnailsEndIsNotTheImagesEnd) {
  const TempFolder folder;
  cv::imwrite((folder / "a.jpg").string(), noise(32, 32));
  const std::string image = heel::test::readText(folder / "a.jpg");
  // An application segment that holds a whole small JPEG, as cameras write it.
  const std::string thumbnail = "Exif\0\0" + image;
  std::string with = image.substr(0, 2) + "\xFF\xE1";
  const std::size_t length = thumbnail.size() + 2;
  with += static_cast<char>(length >> 8U);
  with += static_cast<char>(length & 0xFFU);
  with += thumbnail + image.substr(2);
  writeText(folder / "b.jpg", with);
  EXPECT_EQ(colorMessage(folder / "b.jpg"), "");
  writeText(folder / "b.jpg", with.substr(0, with.size() - image.size() / 2));
  EXPECT_EQ(colorMessage(folder / "b.jpg"),
            (folder / "b.jpg").string() + ": the image is truncated");
}

TEST(ImageReader, BytesAfterTheEndDoNoHarm) {
  const TempFolder folder;
  for (const std::string name : {"a.png", "a.jpg"}) {
    cv::imwrite((folder / name).string(), noise(32, 32));
    writeText(folder / name, heel::test::readText(folder / name) + std::string(100, '\0'));
    EXPECT_EQ(colorMessage(folder / name), "");
  }
}

TEST(ImageReader, OtherFormatsAreReadToTheirEndOrNotAtAll) {
  const TempFolder folder;
  for (const std::string name : {"a.ppm", "a.bmp", "a.tif"}) {
    cv::imwrite((folder / name).string(), noise(32, 32));
    EXPECT_EQ(colorMessage(folder / name), "");
    heel::test::truncateBy(folder / name, 1500);
    EXPECT_EQ(colorMessage(folder / name),
              (folder / name).string() + ": the image cannot be decoded");
  }
}

TEST(ImageReader, DoesNotTakeTheImageBeforeForOneThatIsNone) {
  const TempFolder folder;
  cv::imwrite((folder / "a.png").string(), noise(32, 32));
  writeText(folder / "b.png", "hello");
  heel::ImageReader reader;
  cv::Mat image;
  reader.readColor(folder / "a.png", image);
  EXPECT_EQ(heel::test::messageOf([&] { reader.readColor(folder / "b.png", image); }),
            (folder / "b.png").string() + ": the image cannot be decoded");
}

TEST(ImageReader, SaysWhyAFileIsNoImage) {
  const TempFolder folder;
  EXPECT_EQ(colorMessage(folder / "none.png"),
            (folder / "none.png").string() + ": the image is missing");
  writeText(folder / "empty.png", "");
  EXPECT_EQ(colorMessage(folder / "empty.png"),
            (folder / "empty.png").string() + ": the image is empty (0 bytes)");
  writeText(folder / "text.png", "hello");
  EXPECT_EQ(colorMessage(folder / "text.png"),
            (folder / "text.png").string() + ": the image cannot be decoded");
  std::filesystem::create_directory(folder / "dir.png");
  EXPECT_NE(colorMessage(folder / "dir.png"), "");
}

TEST(ImageName, IsKnownByItsEnd) {
  EXPECT_TRUE(heel::isImageName("a/b.PNG"));
  EXPECT_TRUE(heel::isImageName("b.jpeg"));
  EXPECT_FALSE(heel::isImageName("calib.txt"));
  EXPECT_FALSE(heel::isImageName("png"));
}

}  // namespace
