// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/planning/plan_guard.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace heel {

/// Reads a guard from left to right.
class GuardParser {
 public:
  GuardParser(PlanGuard& guard, const std::vector<std::string>& known)
      : guard_(guard), known_(known) {}

  void parse() {
    expression();
    if (!peek().empty()) fail("something is left over at '" + peek() + "'");
  }

 private:
  using Op = PlanGuard::Op;

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error("has the guard [" + guard_.text_ + "], in which " + reason);
  }

  /// The next word or parenthesis; empty at the end.
  std::string peek() {
    const std::string& text = guard_.text_;
    while (at_ < text.size() && std::isspace(static_cast<unsigned char>(text[at_])) != 0) ++at_;
    if (at_ == text.size()) return {};
    if (text[at_] == '(' || text[at_] == ')') return text.substr(at_, 1);
    return text.substr(at_, text.find_first_of(" \t\r\n()", at_) - at_);
  }

  std::string take() {
    const std::string word = peek();
    at_ += word.size();
    return word;
  }

  /// An operator with its operands, or an operand.
  void expression() {
    const std::string word = peek();
    if (word == "not") {
      take();
      operand();
      guard_.tokens_.push_back({Op::kNot, 1});
    } else if (word == "and" || word == "or") {
      take();
      int operands = 0;
      for (; !peek().empty() && peek() != ")"; ++operands) operand();
      if (operands < 2) fail("'" + word + "' has fewer than two operands");
      guard_.tokens_.push_back({word == "and" ? Op::kAnd : Op::kOr, operands});
    } else {
      operand();
    }
  }

  /// A fact, or an expression in parentheses.
  void operand() {
    const std::string word = take();
    if (word.empty()) fail("an operand is missing");
    if (word == ")") fail("a parenthesis closes that never opened");
    if (word == "not" || word == "and" || word == "or") fail("'" + word + "' needs parentheses");
    if (word == "(") {
      expression();
      if (take() != ")") fail("a parenthesis does not close");
      return;
    }
    const auto found = std::find(known_.begin(), known_.end(), word);
    if (found == known_.end()) fail("the condition '" + word + "' is unknown");
    const int condition = static_cast<int>(found - known_.begin());
    guard_.tokens_.push_back({Op::kFact, condition});
    auto& used = guard_.conditions_;
    if (std::find(used.begin(), used.end(), condition) == used.end()) used.push_back(condition);
    constexpr std::size_t kMostFacts = 32;  // the bits that holds() works with
    if (guard_.tokens_.size() > kMostFacts) fail("there is too much to read");
  }

  PlanGuard& guard_;
  const std::vector<std::string>& known_;
  std::size_t at_ = 0;
};

PlanGuard::PlanGuard(const std::string& text, const std::vector<std::string>& conditions)
    : text_(text) {
  GuardParser(*this, conditions).parse();
}

bool PlanGuard::holds(const std::vector<char>& facts) const {
  std::uint64_t stack = 1;  // the last operand is the lowest bit; of nothing, true
  for (const Token& token : tokens_) {
    if (token.op == Op::kFact) {
      stack = stack << 1 | (facts[static_cast<std::size_t>(token.value)] != 0 ? 1U : 0U);
    } else if (token.op == Op::kNot) {
      stack ^= 1U;
    } else {
      const std::uint64_t all = (std::uint64_t{1} << token.value) - 1U;
      const std::uint64_t operands = stack & all;
      const bool result = token.op == Op::kAnd ? operands == all : operands != 0;
      stack = stack >> token.value << 1 | (result ? 1U : 0U);
    }
  }
  return (stack & 1U) != 0;
}

}  // namespace heel
