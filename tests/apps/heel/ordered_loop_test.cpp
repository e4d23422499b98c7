// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/ordered_loop.hpp>

#include <gmock/gmock.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

namespace {

using heel::loopInOrder;

TEST(OrderedLoop, GivesResultsInOrderWhateverTheThreads) {
  std::vector<std::size_t> expected(200);
  std::iota(expected.begin(), expected.end(), 0U);
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    std::vector<std::size_t> taken;
    loopInOrder(
        expected.size(), threads,
        [](std::size_t i) {
          if (i % 13 == 0) std::this_thread::yield();
          return i;
        },
        [&](std::size_t i, std::size_t&& result) {
          EXPECT_EQ(i, result);
          taken.push_back(result);
        });
    EXPECT_EQ(taken, expected) << threads;
  }
}

TEST(OrderedLoop, HoldsNoMoreThanTwoResultsAThread) {
  constexpr unsigned kThreads = 3;
  std::atomic<int> alive{0};
  std::atomic<int> most{0};
  struct Result {
    explicit Result(std::atomic<int>& count) : count_(&count) { ++*count_; }
    Result(Result&& other) noexcept : count_(std::exchange(other.count_, nullptr)) {}
    Result& operator=(Result&&) = delete;
    ~Result() {
      if (count_ != nullptr) --*count_;
    }
    std::atomic<int>* count_;
  };
  loopInOrder(
      300, kThreads,
      [&](std::size_t) {
        Result result(alive);
        int seen = most;
        while (seen < alive && !most.compare_exchange_weak(seen, alive)) {
        }
        return result;
      },
      [](std::size_t, Result&&) { std::this_thread::yield(); });
  EXPECT_LE(most, 2 * static_cast<int>(kThreads));
  EXPECT_EQ(alive, 0);
}

TEST(OrderedLoop, EndsWithTheErrorOfEither) {
  const auto fails = [](std::size_t i) {
    if (i == 5) throw std::runtime_error("work");
    return 0;
  };
  EXPECT_THROW(loopInOrder(100, 4, fails, [](std::size_t, int&&) {}), std::runtime_error);
  EXPECT_THROW(loopInOrder(
                   100, 4, [](std::size_t) { return 0; },
                   [](std::size_t i, int&&) {
                     if (i == 3) throw std::invalid_argument("take");
                   }),
               std::invalid_argument);
}

TEST(OrderedLoop, OfNothingEnds) {
  loopInOrder(
      0, 4, [](std::size_t) { return 0; }, [](std::size_t, int&&) { FAIL(); });
}

}  // namespace
