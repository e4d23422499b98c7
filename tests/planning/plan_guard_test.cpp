// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/planning/plan_guard.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

const std::vector<std::string> kNames = {"a", "b", "c"};

bool holds(const std::string& text, bool a, bool b, bool c) {
  return PlanGuard(text, kNames)
      .holds({static_cast<char>(a), static_cast<char>(b), static_cast<char>(c)});
}

TEST(PlanGuard, AnEmptyOneAlwaysHolds) { EXPECT_TRUE(PlanGuard().holds({0, 0, 0})); }

TEST(PlanGuard, SaysWhatItsOperatorsSay) {
  for (int bits = 0; bits < 8; ++bits) {
    const bool a = (bits & 1) != 0, b = (bits & 2) != 0, c = (bits & 4) != 0;
    EXPECT_EQ(holds("b", a, b, c), b);
    EXPECT_EQ(holds("not a", a, b, c), !a);
    EXPECT_EQ(holds("not (not a)", a, b, c), a);
    EXPECT_EQ(holds("and a b c", a, b, c), a && b && c);
    EXPECT_EQ(holds("or a b c", a, b, c), a || b || c);
    EXPECT_EQ(holds("and a (not b)", a, b, c), a && !b);
    EXPECT_EQ(holds("or (and a b) (and (not a) c)", a, b, c), (a && b) || (!a && c));
    EXPECT_EQ(holds("(not (or a (and b c)))", a, b, c), !(a || (b && c)));
  }
}

TEST(PlanGuard, NamesTheConditionsItReadsOnce) {
  EXPECT_EQ(PlanGuard("or (and c a) (not c)", kNames).conditions(), (std::vector<int>{2, 0}));
}

TEST(PlanGuard, SaysWhatIsWrong) {
  const auto error = [](const std::string& text) {
    return test::messageOf([&] { PlanGuard(text, kNames); });
  };
  EXPECT_EQ(error("lunch"), "has the guard [lunch], in which the condition 'lunch' is unknown");
  EXPECT_EQ(error(""), "has the guard [], in which an operand is missing");
  EXPECT_EQ(error("not"), "has the guard [not], in which an operand is missing");
  EXPECT_EQ(error("and a"), "has the guard [and a], in which 'and' has fewer than two operands");
  EXPECT_EQ(error("and a not b"), "has the guard [and a not b], in which 'not' needs parentheses");
  EXPECT_EQ(error("(a"), "has the guard [(a], in which a parenthesis does not close");
  EXPECT_EQ(error("a)"), "has the guard [a)], in which something is left over at ')'");
  EXPECT_EQ(error("a and b"), "has the guard [a and b], in which something is left over at 'and'");
}

}  // namespace
}  // namespace heel
