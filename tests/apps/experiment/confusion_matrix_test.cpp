// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/confusion_matrix.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

DetectionRun seen(int followed, int blob = 0) {
  DetectionRun run;
  run.frames_in_view = 10;
  run.followed = followed;
  run.blob = blob;
  run.appearance_sum = followed;
  return run;
}

// a and b are always told from c; b's model also takes a, half of the time.
ConfusionMatrix threePeople() {
  ConfusionMatrix matrix({"a", "b", "c"});
  matrix.at(0, 0) = seen(10);
  matrix.at(1, 1) = seen(8);
  matrix.at(2, 2) = seen(2);
  matrix.at(1, 0) = seen(5);
  matrix.at(0, 2) = seen(0, 10);
  return matrix;
}

TEST(ConfusionMatrix, CountsOwnModelsThatMissAndOthersThatFind) {
  const ConfusionCount count = threePeople().count(DetectionRule::kFollowed, 0.5);
  EXPECT_EQ(count.false_negatives.count, 1);  // c
  EXPECT_EQ(count.false_negatives.total, 3);
  EXPECT_EQ(count.false_positives.count, 1);  // b's model on a
  EXPECT_EQ(count.false_positives.total, 6);
}

TEST(ConfusionMatrix, CountsASharePreciselyAtItsLimit) {
  const ConfusionMatrix matrix = threePeople();
  EXPECT_TRUE(matrix.detected(1, 0, DetectionRule::kFollowed, 0.5));
  EXPECT_FALSE(matrix.detected(1, 0, DetectionRule::kFollowed, 0.51));
}

TEST(ConfusionMatrix, NeverDetectsWhoWasNeverFollowed) {
  const ConfusionMatrix matrix = threePeople();
  EXPECT_FALSE(matrix.detected(0, 1, DetectionRule::kFollowed, 0.0));
  EXPECT_FALSE(ConfusionMatrix({"a"}).detected(0, 0, DetectionRule::kFollowed, 0.0));
}

TEST(ConfusionMatrix, LeavesOnePersonOut) {
  const ConfusionCount count = threePeople().count(DetectionRule::kFollowed, 0.5, 1);
  EXPECT_EQ(count.false_negatives.total, 2);
  EXPECT_EQ(count.false_positives.total, 2);
  EXPECT_EQ(count.false_positives.count, 0);
}

TEST(ConfusionMatrix, CountsBlobsByThePapersRule) {
  const ConfusionMatrix matrix = threePeople();
  EXPECT_TRUE(matrix.detected(0, 2, DetectionRule::kBlob, 0.5));
  EXPECT_FALSE(matrix.detected(0, 2, DetectionRule::kFollowed, 0.5));
}

TEST(ConfusionMatrix, IdentifiesWhoLooksMostLikeTheirOwnModel) {
  ConfusionMatrix matrix = threePeople();
  EXPECT_EQ(matrix.identified().count, 3);
  matrix.at(0, 2).appearance_sum = 9.0;
  EXPECT_EQ(matrix.identified().count, 2);
}

TEST(ConfusionPicture, DrawsOnePanelAMatrix) {
  const ConfusionPanel panel{"model", "1 FN", {"a", "b"}, {1.0, 0.0, 0.5, 1.0}};
  const cv::Mat one = drawConfusion("title", {panel});
  const cv::Mat four = drawConfusion("title", {panel, panel, panel, panel});
  const cv::Mat five = drawConfusion("title", {panel, panel, panel, panel, panel});
  EXPECT_GT(four.cols, 3 * one.cols);
  EXPECT_EQ(four.rows, one.rows);
  EXPECT_EQ(five.cols, four.cols);
  EXPECT_GT(five.rows, four.rows);
}

TEST(ConfusionPicture, RefusesAMatrixThatIsNotSquare) {
  EXPECT_THROW(drawConfusion("title", {{"model", "", {"a", "b"}, {1.0}}}), std::invalid_argument);
}

}  // namespace
}  // namespace heel
