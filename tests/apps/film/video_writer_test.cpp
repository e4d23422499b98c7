// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/apps/output/full_disk.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/apps/film/video_writer.hpp>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace {

using heel::FilmWriter;
using heel::test::isThere;
using heel::test::messageOf;
using heel::test::TempFolder;
using testing::HasSubstr;

const cv::Size kSize(320, 240);

cv::Mat pictureOf(int frame) {
  cv::Mat picture(kSize, CV_8UC3, cv::Scalar(40, 60, 80));
  cv::circle(picture, {20 + 5 * frame, 120}, 15, {0, 200, 255}, cv::FILLED);
  return picture;
}

void writeFilm(FilmWriter& film, int frames) {
  for (int frame = 0; frame < frames; ++frame) film.write(pictureOf(frame));
  film.close();
}

class Film : public testing::TestWithParam<std::string> {};

TEST_P(Film, HoldsItsFramesAtItsRate) {
  const TempFolder folder;
  FilmWriter film(folder / ("film" + GetParam()), 5.0, kSize);
  EXPECT_EQ(film.path(), folder / ("film" + GetParam()));
  writeFilm(film, 30);
  cv::VideoCapture read(film.path().string());
  ASSERT_TRUE(read.isOpened());
  EXPECT_EQ(read.get(cv::CAP_PROP_FRAME_COUNT), 30.0);
  EXPECT_NEAR(read.get(cv::CAP_PROP_FPS), 5.0, 0.01);
  cv::Mat first;
  ASSERT_TRUE(read.read(first));
  ASSERT_EQ(first.size(), kSize);
  EXPECT_LT(cv::norm(first, pictureOf(0), cv::NORM_L1) / (3.0 * kSize.area()), 5.0);
}

TEST_P(Film, ShowsTheSameOnEveryRun) {
  const TempFolder folder;
  for (const char* run : {"a", "b"}) {
    FilmWriter film(folder / (run + GetParam()), 10.0, kSize);
    writeFilm(film, 40);
  }
  cv::VideoCapture a((folder / ("a" + GetParam())).string());
  cv::VideoCapture b((folder / ("b" + GetParam())).string());
  cv::Mat in_a, in_b;
  for (int frame = 0; frame < 40; ++frame) {
    ASSERT_TRUE(a.read(in_a) && b.read(in_b)) << frame;
    EXPECT_EQ(cv::norm(in_a, in_b, cv::NORM_INF), 0.0) << frame;
  }
}

TEST_P(Film, IsNotLeftHalfWritten) {
  const TempFolder folder;
  {
    FilmWriter film(folder / ("film" + GetParam()), 5.0, kSize);
    film.write(pictureOf(0));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  {
    FilmWriter film(folder / ("film" + GetParam()), 5.0, kSize);
    film.close();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "a film without a frame is no file";
}

TEST_P(Film, FullDiskIsAnErrorThatLeavesNothing) {
  const TempFolder folder;
  heel::test::makeDiskFullFor(folder / "film.mp4");
  heel::test::makeDiskFullFor(folder / "film.avi");  // what is tried where MP4 fails
  EXPECT_THAT(messageOf([&] {
                FilmWriter film(folder / ("film" + GetParam()), 5.0, kSize);
                writeFilm(film, 200);
              }),
              HasSubstr("cannot be written: No space left on device"));
  EXPECT_FALSE(isThere(folder / ("film" + GetParam())));
}

TEST_P(Film, DiskThatFillsUpIsAnErrorThatLeavesNothing) {
  const TempFolder folder;
  const auto path = folder / ("film" + GetParam());
  const heel::test::FileSizeLimit limit(4000);
  EXPECT_EQ(messageOf([&] {
              FilmWriter film(path, 5.0, kSize);
              writeFilm(film, 400);
            }),
            path.string() + " cannot be written: the film is not whole; is the disk full?");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_P(Film, FolderThatIsMissingIsNamed) {
  const TempFolder folder;
  EXPECT_THAT(messageOf([&] { FilmWriter(folder / ("no/film" + GetParam()), 5.0, kSize); }),
              HasSubstr("cannot be written: No such file or directory"));
}

INSTANTIATE_TEST_SUITE_P(Formats, Film, testing::Values(".mp4", ".avi"));

TEST(FilmWriter, RefusesPicturesOfAnotherSizeAndRatesOfNothing) {
  const TempFolder folder;
  FilmWriter film(folder / "film.mp4", 5.0, kSize);
  EXPECT_THROW(film.write(cv::Mat(10, 10, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(film.write(cv::Mat(kSize, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(FilmWriter(folder / "a.mp4", 0.0, kSize), std::invalid_argument);
  EXPECT_THROW(FilmWriter(folder / "a.mp4", 5.0, {}), std::invalid_argument);
}

TEST(Picture, IsWrittenWholeOrNotAtAll) {
  const TempFolder folder;
  heel::writePicture(folder / "a.png", pictureOf(3));
  EXPECT_EQ(cv::norm(cv::imread((folder / "a.png").string()), pictureOf(3), cv::NORM_INF), 0.0);
  EXPECT_THAT(messageOf<std::invalid_argument>(
                  [&] { heel::writePicture(folder / "a.what", pictureOf(3)); }),
              HasSubstr("a.what cannot be written: no picture format of this name"));
  heel::test::makeDiskFullFor(folder / "b.png");
  EXPECT_EQ(messageOf([&] { heel::writePicture(folder / "b.png", pictureOf(3)); }),
            (folder / "b.png").string() + " cannot be written: No space left on device");
  EXPECT_FALSE(isThere(folder / "b.png"));
}

}  // namespace
