// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Recordings that are damaged in part, or of no use.

#include "tests/commands/heel.hpp"
#include "tests/commands/small_model.hpp"
#include "tests/commands/small_recording.hpp"
#include "tests/support/temp_folder.hpp"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

namespace heel::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class BadRecording : public testing::Test {
 protected:
  BadRecording() {
    recording_.write(folder_ / "room");
    writeSmallModel(folder_ / "person.yaml");
  }

  HeelRun track() {
    return heel({"track", folder_ / "room", "--model", folder_ / "person.yaml", "--out",
                 folder_ / "out", "--no-film"});
  }

  /// That one frame is left out, for a reason with `parts` in it, and the run goes on.
  void expectOneSkipped(int number, const std::vector<std::string>& parts) {
    const HeelRun run = track();
    ASSERT_TRUE(succeeds(run));
    EXPECT_THAT(run.out, HasSubstr("1 frame was left out"));
    ASSERT_EQ(run.warnings().size(), 1U) << run.err;
    const auto summary = summaryIn(folder_ / "out");
    EXPECT_EQ(summary["frames"], recording_.frames() - 1);
    ASSERT_EQ(summary["frames_skipped"].size(), 1U);
    EXPECT_EQ(summary["frames_skipped"][0]["frame"], number);
    for (const std::string& part : parts) {
      EXPECT_THAT(run.warnings().front(), HasSubstr(part));
      EXPECT_THAT(summary["frames_skipped"][0]["reason"].get<std::string>(), HasSubstr(part));
    }
  }

  void expectAllFail(const std::vector<std::string>& parts) {
    EXPECT_TRUE(failsWith(track(), parts));
    EXPECT_TRUE(
        failsWith(heel({"learn", folder_ / "room", "--out", folder_ / "out/model.yaml"}), parts));
    EXPECT_THAT(filesBelow(folder_ / "out"), ElementsAre());
  }

  TempFolder folder_;
  const SmallRecording recording_{5, 8};
};

TEST_F(BadRecording, ThatIsNotThereIsNamed) {
  fs::remove_all(folder_ / "room");
  expectAllFail({"room", "does not exist"});
  EXPECT_TRUE(failsWith(heel({"inspect", folder_ / "room"}), {"room", "no such file or folder"}));
}

TEST_F(BadRecording, OfNoKnownLayoutSaysWhichAreKnown) {
  for (const char* name : {"room/rgb.txt", "room/depth.txt"}) fs::remove(folder_ / name);
  expectAllFail({"room", "TUM", "left/ and right/", "PCD"});
}

TEST_F(BadRecording, GoesOnWithoutAnImageThatIsMissing) {
  fs::remove(colorImage(folder_ / "room", 7));
  expectOneSkipped(7, {"rgb/0007.png", "the image is missing"});
}

TEST_F(BadRecording, GoesOnWithoutADepthImageThatIsMissing) {
  fs::remove(depthImage(folder_ / "room", 1));
  expectOneSkipped(1, {"depth/0001.png", "the image is missing"});
}

TEST_F(BadRecording, GoesOnWithoutAnImageThatIsTruncated) {
  truncateBy(colorImage(folder_ / "room", 7), 500);
  expectOneSkipped(7, {"rgb/0007.png", "truncated"});
}

TEST_F(BadRecording, GoesOnWithoutAnImageThatIsNoImage) {
  writeText(depthImage(folder_ / "room", 13), "no image at all");
  expectOneSkipped(13, {"depth/0013.png", "cannot be decoded"});
}

TEST_F(BadRecording, GoesOnWithoutAnImageWhoseBytesEndTooSoon) {
  const auto bitmap = folder_ / "image.bmp";
  cv::imwrite(bitmap.string(), cv::Mat(120, 160, CV_8UC3, cv::Scalar(0)));
  truncateBy(bitmap, 1000);
  fs::rename(bitmap, colorImage(folder_ / "room", 7));
  expectOneSkipped(7, {"rgb/0007.png", "cannot be decoded"});
}

TEST_F(BadRecording, GoesOnWithoutAnImageOfAnotherSize) {
  cv::imwrite(colorImage(folder_ / "room", 7).string(), cv::Mat(60, 80, CV_8UC3, cv::Scalar(0)));
  expectOneSkipped(7, {"rgb/0007.png", "80x60", "160x120"});
}

TEST_F(BadRecording, GoesOnWithoutAFrameWhoseStampRunsBackwards) {
  std::string list = readText(folder_ / "room/rgb.txt");
  const auto line = list.find("1.2 rgb/0007.png");
  ASSERT_NE(line, std::string::npos);
  writeText(folder_ / "room/rgb.txt", list.replace(line, 3, "0.4"));
  expectOneSkipped(7, {"rgb/0007.png", "runs backwards", "from 1.0", "to 0.4"});
}

TEST_F(BadRecording, WithNoFrameThatCanBeReadGivesTheFirstReason) {
  for (int number = 1; number <= recording_.frames(); ++number) {
    truncateBy(depthImage(folder_ / "room", number), 100);
  }
  expectAllFail({"none of the 13 frames of room", "depth/0001.png", "truncated"});
}

TEST_F(BadRecording, WithoutCameraFileSaysWhatToWrite) {
  fs::remove(folder_ / "room/camera.yaml");
  expectAllFail({"camera.yaml", "missing", "depth_scale"});
}

TEST_F(BadRecording, WithoutAFloorOrAPlaceOfTheCameraSaysSo) {
  SmallRecording{1, 0, false}.write(folder_ / "wall");
  cv::imwrite(depthImage(folder_ / "wall", 1).string(),
              cv::Mat(120, 160, CV_16UC1, cv::Scalar(3000)));
  EXPECT_TRUE(failsWith(heel({"learn", folder_ / "wall", "--out", folder_ / "model.yaml"}),
                        {"wall", "no floor was found"}));
}

}  // namespace
}  // namespace heel::test
