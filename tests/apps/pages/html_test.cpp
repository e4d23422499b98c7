// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/map_parts.hpp>
#include <heel/apps/pages/page_parts.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using Eigen::Vector2d;
using testing::ElementsAre;

const Vector2d kNowhere(std::nan(""), 0.0);

TEST(EscapedHtml, LeavesNoMarkup) {
  EXPECT_EQ(heel::escapedHtml("<a href='x'>\"&\n\x02"), "&lt;a href=&#39;x&#39;&gt;&quot;&amp;  ");
  EXPECT_EQ(heel::escapedHtml("caf\u00e9"), "caf\u00e9");
}

TEST(ScriptJson, CanNotEndTheScript) {
  EXPECT_EQ(heel::scriptJson({{"a", "</script>&"}}), "{\"a\":\"\\u003c/script\\u003e\\u0026\"}");
}

TEST(FilledTemplate, PutsEachValueInOnceAndAsItIs) {
  EXPECT_EQ(heel::filledTemplate("<{{a}}|{{b}}|{{a}}>", {{"a", "{{b}}"}, {"b", "2"}}),
            "<{{b}}|2|{{b}}>");
  EXPECT_THROW(heel::filledTemplate("{{a}}", {}), std::logic_error);
  EXPECT_THROW(heel::filledTemplate("a", {{"a", "1"}}), std::logic_error);
  EXPECT_THROW(heel::filledTemplate("{{a", {{"a", "1"}}), std::logic_error);
}

TEST(PictureAddress, IsAJpegOfTheWidth) {
  const cv::Mat picture(100, 300, CV_8UC3, cv::Scalar(1, 2, 3));
  const std::string address = heel::pictureAddress(picture, 30);
  EXPECT_THAT(address, testing::StartsWith("data:image/jpeg;base64,/9j/"));
  EXPECT_EQ((address.size() - std::string("data:image/jpeg;base64,").size()) % 4, 0U);
  EXPECT_LT(address.size(), heel::pictureAddress(picture, 300).size());
  EXPECT_EQ(heel::pictureAddress({}), "");
}

TEST(SvgPath, BreaksWhereNothingIsKnown) {
  EXPECT_EQ(heel::svgPath({{0, 0}, {1, 2}, kNowhere, {3, 3}}, 0), "M0 0L1 2M3 3");
  EXPECT_EQ(heel::svgPath({}), "");
}

TEST(Simplified, KeepsCornersAndEnds) {
  EXPECT_THAT(heel::simplified({{0, 0}, {1, 0.01}, {2, 0}, {2, 2}, {2, 4}}, 0.05),
              ElementsAre(Vector2d(0, 0), Vector2d(2, 0), Vector2d(2, 4)));
  EXPECT_EQ(heel::simplified({{0, 0}, kNowhere, {3, 3}}, 1.0).size(), 3U);
  EXPECT_TRUE(heel::simplified({}, 1.0).empty());
}

TEST(NiceStep, IsOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(heel::niceStep(100.0, 8.0), 20.0);
  EXPECT_DOUBLE_EQ(heel::niceStep(0.4, 4.0), 0.1);
  EXPECT_DOUBLE_EQ(heel::niceStep(3.9, 3.0), 2.0);
  EXPECT_DOUBLE_EQ(heel::niceStep(0.0, 8.0), 1.0);
}

TEST(StateTones, KnownStatesKeepTheirsAndOthersDiffer) {
  heel::StateTones tones;
  EXPECT_EQ(heel::wordsOf("goToLastSeen"), "go to last seen");
  EXPECT_EQ(tones.of("follow"), "--s-follow");
  const std::string dance = tones.of("dance");
  EXPECT_NE(tones.of("sing"), dance);
  EXPECT_EQ(tones.of("dance"), dance);
  EXPECT_THAT(tones.states(), ElementsAre("follow", "dance", "sing"));
}

}  // namespace
