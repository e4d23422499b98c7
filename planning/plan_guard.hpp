// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Conditions on a plan's transitions, in the syntax of Petri Net Plans.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace heel {

/// A condition over named facts: `near`, `not near`, `and targetSeen (not near)`, `or a b c`.
/// Operators stand in front, as in Petri Net Plans; what has operands of its own is in parentheses.
/// A guard without a text always holds; an empty text is an error.
class PlanGuard {
 public:
  PlanGuard() = default;
  /// @param conditions  Every known condition; a name stands for its index.
  /// @throws std::runtime_error  with a sentence without its subject, as "has the guard ...".
  PlanGuard(const std::string& text, const std::vector<std::string>& conditions);

  const std::string& text() const { return text_; }
  /// The conditions that it reads, each once, in order.
  const std::vector<int>& conditions() const { return conditions_; }

  /// Whether it holds, given for each condition whether that does.
  bool holds(const std::vector<char>& facts) const;

 private:
  friend class GuardParser;
  enum class Op : std::uint8_t { kFact, kNot, kAnd, kOr };
  /// In Polish notation reversed: operands first.
  struct Token {
    Op op = Op::kFact;
    int value = 0;  ///< The condition of a fact; the number of operands of an operator.
  };

  std::string text_;
  std::vector<Token> tokens_;
  std::vector<int> conditions_;
};

}  // namespace heel
