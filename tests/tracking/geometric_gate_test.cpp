// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/geometric_gate.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace heel {
namespace {

Observation seenAt(double x, double y) {
  Observation o;
  o.position_m = {x, y};
  return o;
}

TEST(GeometricGate, TooCloseIsMeasuredFromTheViewpoint) {
  const GeometricGate gate = tooClose(0.5);
  Viewpoint viewpoint;
  viewpoint.position_m = {10.0, 0.0};
  EXPECT_EQ(gate(seenAt(10.4, 0.0), viewpoint), GateVerdict::kTooClose);
  EXPECT_EQ(gate(seenAt(10.5, 0.0), viewpoint), GateVerdict::kAccepted);
  EXPECT_EQ(gate(seenAt(0.0, 0.0), viewpoint), GateVerdict::kAccepted);
}

TEST(GeometricGate, BoundsIncludeTheirEdge) {
  const GeometricGate gate = insideBounds({-1.0, -2.0}, {3.0, 2.0});
  EXPECT_EQ(gate(seenAt(3.0, -2.0), {}), GateVerdict::kAccepted);
  EXPECT_EQ(gate(seenAt(3.001, 0.0), {}), GateVerdict::kOutOfBounds);
  EXPECT_EQ(gate(seenAt(0.0, -2.001), {}), GateVerdict::kOutOfBounds);
}

TEST(GeometricGate, AllOfGivesTheFirstRejection) {
  const GeometricGate gate = allOf({tooClose(1.0), {}, insideBounds({0.0, 0.0}, {5.0, 5.0})});
  EXPECT_EQ(gate(seenAt(-0.5, 0.0), {}), GateVerdict::kTooClose);
  EXPECT_EQ(gate(seenAt(-2.0, 0.0), {}), GateVerdict::kOutOfBounds);
  EXPECT_EQ(gate(seenAt(2.0, 2.0), {}), GateVerdict::kAccepted);
  EXPECT_EQ(allOf({})(seenAt(2.0, 2.0), {}), GateVerdict::kAccepted);
}

TEST(GeometricGate, RejectsWrongParameters) {
  EXPECT_THROW(tooClose(-1.0), std::invalid_argument);
  EXPECT_THROW(tooClose(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_THROW(insideBounds({0.0, 0.0}, {1.0, 0.0}), std::invalid_argument);
}

TEST(GeometricGate, EveryVerdictHasItsOwnText) {
  EXPECT_STREQ(toText(GateVerdict::kBehindWall), "behind a wall");
  EXPECT_STREQ(toText(GateVerdict::kInsideWall), "inside a wall");
  EXPECT_STREQ(toText(GateVerdict::kTooClose), "too close");
  std::set<std::string> texts;
  for (std::size_t i = 0; i < kGateVerdicts; ++i) texts.insert(toText(static_cast<GateVerdict>(i)));
  EXPECT_EQ(texts.size(), kGateVerdicts);
  EXPECT_EQ(texts.count(""), 0U);
}

}  // namespace
}  // namespace heel
