// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/planning/small_net.hpp"
#include <heel/planning/petri_plan.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace heel {
namespace {

using test::SmallNet;

TEST(PetriNet, FiringMovesTokensAlongTheArcs) {
  const PetriNet net = SmallNet().place("a", 3).place("b").place("c", 1).transition(
      "t", {"a", "a", "c"}, {"b", "c"});
  Marking marking = initialMarking(net);
  EXPECT_EQ(marking, (Marking{3, 0, 1}));
  fire(net.transitions[0], marking);
  EXPECT_EQ(marking, (Marking{1, 1, 1}));
}

TEST(PetriNet, ATransitionNeedsAllItsTokens) {
  const PetriNet net =
      SmallNet().place("a", 1).place("b", 1).place("c").transition("t", {"a", "a", "b"}, {"c"});
  EXPECT_FALSE(isEnabled(net.transitions[0], {1, 1, 0}));
  EXPECT_FALSE(isEnabled(net.transitions[0], {2, 0, 0}));
  EXPECT_TRUE(isEnabled(net.transitions[0], {2, 1, 0}));
}

TEST(PetriNet, ATransitionWithoutInputsIsAlwaysEnabled) {
  const PetriNet net = SmallNet().place("a").transition("t", {}, {"a"});
  EXPECT_TRUE(isEnabled(net.transitions[0], {0}));
}

TEST(PetriNet, FiringWithoutTokensIsAnErrorAndChangesNothing) {
  const PetriNet net = SmallNet().place("a").place("b").transition("t", {"a"}, {"b"});
  Marking marking = initialMarking(net);
  EXPECT_THROW(fire(net.transitions[0], marking), std::invalid_argument);
  EXPECT_EQ(marking, (Marking{0, 0}));
}

// Two philosophers and two forks, by hand: who eats holds both forks, so never both eat.
TEST(PetriNet, TwoPhilosophersShareTheirForks) {
  const PetriNet net = SmallNet()
                           .place("thinks1", 1)
                           .place("eats1")
                           .place("thinks2", 1)
                           .place("eats2")
                           .place("forks", 2)
                           .transition("takes1", {"thinks1", "forks", "forks"}, {"eats1"})
                           .transition("takes2", {"thinks2", "forks", "forks"}, {"eats2"})
                           .transition("leaves1", {"eats1"}, {"thinks1", "forks", "forks"});
  Marking marking = initialMarking(net);
  fire(net.transitions[0], marking);
  EXPECT_EQ(marking, (Marking{0, 1, 1, 0, 0}));
  EXPECT_FALSE(isEnabled(net.transitions[1], marking));
  fire(net.transitions[2], marking);
  EXPECT_TRUE(isEnabled(net.transitions[1], marking));
}

}  // namespace
}  // namespace heel
