// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/background_model.hpp>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const cv::Rect kSomewhere(10, 8, 6, 5);

// A grey wall, 3 m away, 64 x 48 pixels.
struct Scene {
  cv::Mat image = cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(120));
  cv::Mat depth = cv::Mat(48, 64, CV_32FC1, cv::Scalar::all(3.0));

  Scene& paint(const cv::Rect& where, int gray) {
    image(where).setTo(cv::Scalar::all(gray));
    return *this;
  }
  Scene& place(const cv::Rect& where, float metres) {
    depth(where).setTo(metres);
    return *this;
  }
};

BackgroundModel learn(const Scene& empty, int frames = 5) {
  BackgroundLearner learner;
  for (int i = 0; i < frames; ++i) learner.add(empty.image, empty.depth);
  return learner.model();
}

Foreground extract(const BackgroundModel& model, const Scene& scene) {
  Foreground out;
  model.extract(scene.image, scene.depth, out);
  return out;
}

// All of the rectangle has the value, and nothing else is foreground.
void expectForeground(const Foreground& out, const cv::Rect& where, int value) {
  cv::Mat expected = cv::Mat::zeros(out.mask.size(), CV_8UC1);
  expected(where).setTo(value);
  EXPECT_EQ(cv::countNonZero(out.mask != expected), 0);
  EXPECT_EQ(out.pixels, value == 0 ? 0 : where.area());
}

TEST(BackgroundModel, SeesNothingInTheEmptyScene) {
  const auto out = extract(learn(Scene()), Scene());
  expectForeground(out, kSomewhere, 0);
  EXPECT_NEAR(out.gain, 1.0, 1e-6);
  EXPECT_EQ(out.compared, 64 * 48 / 16);
}

TEST(BackgroundModel, SeesWhatDiffersInBoth) {
  const auto out = extract(learn(Scene()), Scene().paint(kSomewhere, 30).place(kSomewhere, 2.0F));
  expectForeground(out, kSomewhere, Foreground::kInFront | Foreground::kOtherIntensity);
}

TEST(BackgroundModel, RejectsShadowsAndReflections) {
  for (const int gray : {60, 200}) {
    const auto out = extract(learn(Scene()), Scene().paint(kSomewhere, gray));
    expectForeground(out, kSomewhere, 0);
    EXPECT_EQ(cv::countNonZero(out.changed), kSomewhere.area());  // but it says that it saw them
  }
}

TEST(BackgroundModel, KeepsAPersonInTheWallsColor) {
  const auto out = extract(learn(Scene()), Scene().place(kSomewhere, 2.0F));
  expectForeground(out, kSomewhere, Foreground::kInFront);
}

TEST(BackgroundModel, RejectsTheGhostOfWhatWasCarriedAway) {
  const BackgroundModel model = learn(Scene().paint(kSomewhere, 30).place(kSomewhere, 2.0F));
  expectForeground(extract(model, Scene()), kSomewhere, 0);
}

TEST(BackgroundModel, LetsIntensityDecideWhereDepthIsMissing) {
  for (const float none : {kNan, 0.0F, -1.0F}) {
    // None in the empty scene, as on a black screen.
    const BackgroundModel model = learn(Scene().place(kSomewhere, none));
    expectForeground(extract(model, Scene().place(kSomewhere, 2.0F).paint(kSomewhere, 30)),
                     kSomewhere, Foreground::kOtherIntensity);
    expectForeground(extract(model, Scene().place(kSomewhere, 2.0F)), kSomewhere, 0);
    // None now, as on black hair.
    expectForeground(extract(learn(Scene()), Scene().place(kSomewhere, none).paint(kSomewhere, 30)),
                     kSomewhere, Foreground::kOtherIntensity);
    expectForeground(extract(learn(Scene()), Scene().place(kSomewhere, none)), kSomewhere, 0);
  }
}

TEST(BackgroundModel, DividesOutAChangeOfExposure) {
  for (const double gain : {0.7, 1.4}) {
    Scene scene;
    scene.image *= gain;
    scene.paint(kSomewhere, 120).place(kSomewhere, kNan);  // as bright as the wall was before
    const auto out = extract(learn(Scene()), scene);
    EXPECT_NEAR(out.gain, gain, 0.01);
    expectForeground(out, kSomewhere, Foreground::kOtherIntensity);
  }
}

TEST(BackgroundModel, GuessesNoGainFromTooFewPixels) {
  Scene scene;
  scene.image *= 0.5;
  scene.depth.setTo(kNan);
  const auto out = extract(learn(Scene()), scene);
  EXPECT_EQ(out.compared, 0);
  EXPECT_EQ(out.gain, 1.0);
}

TEST(BackgroundModel, ToleratesEachPixelsOwnSpread) {
  // Disparity of this spot swings by 0.1 around 0.4 [1/m]: its spread is 0.1, tolerance 0.4.
  BackgroundLearner learner;
  for (int i = 0; i < 20; ++i) {
    const Scene scene = Scene().place(kSomewhere, i % 2 == 0 ? 1.0F / 0.3F : 1.0F / 0.5F);
    learner.add(scene.image, scene.depth);
  }
  EXPECT_EQ(learner.frames(), 20);
  const BackgroundModel model = learner.model();
  expectForeground(extract(model, Scene().place(kSomewhere, 1.0F / 0.79F)), kSomewhere, 0);
  expectForeground(extract(model, Scene().place(kSomewhere, 1.0F / 0.81F)), kSomewhere,
                   Foreground::kInFront);
}

TEST(BackgroundModel, KnowsDepthOnlyWhereItWasValidOftenEnough) {
  for (const int valid : {2, 4}) {  // of 10; the limit is 0.3
    BackgroundLearner learner;
    for (int i = 0; i < 10; ++i) {
      const Scene scene = Scene().place(kSomewhere, i < valid ? 3.0F : kNan);
      learner.add(scene.image, scene.depth);
    }
    const auto out = extract(learner.model(), Scene().place(kSomewhere, 2.0F));
    expectForeground(out, kSomewhere, valid == 4 ? Foreground::kInFront : 0);
  }
}

TEST(BackgroundModel, TellsInHowMuchOfThePictureDepthDidNotStay) {
  BackgroundLearner empty, walked, edge;
  for (int i = 0; i < 10; ++i) {
    empty.add(Scene().image, Scene().depth);
    const Scene somebody = Scene().place({4 * i, 4, 10, 40}, 2.0F);
    walked.add(somebody.image, somebody.depth);
    const Scene rim = Scene().place({30, 0, 1, 48}, i % 2 == 0 ? 2.0F : 3.0F);
    edge.add(rim.image, rim.depth);
  }
  EXPECT_EQ(empty.model().restlessShare(), 0.0);
  const double swept = 46.0 * 40.0 / (64.0 * 48.0);
  EXPECT_NEAR(walked.model().restlessShare(), swept, 0.2 * swept);
  EXPECT_LT(edge.model().restlessShare(), 0.02);
}

TEST(BackgroundModel, RefusesWhatDoesNotFit) {
  const Scene scene;
  const BackgroundModel model = learn(scene);
  Foreground out;
  EXPECT_TRUE(BackgroundModel().empty());
  EXPECT_FALSE(model.empty());
  EXPECT_THROW(BackgroundModel().extract(scene.image, scene.depth, out), std::invalid_argument);
  EXPECT_THROW(model.extract(cv::Mat(), cv::Mat(), out), std::invalid_argument);
  EXPECT_THROW(model.extract(scene.depth, scene.depth, out), std::invalid_argument);
  EXPECT_THROW(model.extract(scene.image, scene.image, out), std::invalid_argument);
  EXPECT_THROW(model.extract(scene.image, scene.depth.rowRange(0, 40), out), std::invalid_argument);
  EXPECT_THROW(model.extract(scene.image.rowRange(0, 40), scene.depth.rowRange(0, 40), out),
               std::invalid_argument);
  EXPECT_THROW(BackgroundLearner().model(), std::invalid_argument);
  BackgroundParams params;
  params.min_valid_share = 0.0;
  EXPECT_THROW(BackgroundLearner{params}, std::invalid_argument);
  params = {};
  params.min_disparity_step = -0.1;
  EXPECT_THROW(BackgroundLearner{params}, std::invalid_argument);
}

}  // namespace
}  // namespace heel
