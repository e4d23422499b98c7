// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/assignment.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

using ::testing::ElementsAre;

CostMatrix table(const std::vector<std::vector<double>>& rows) {
  CostMatrix costs(static_cast<int>(rows.size()), static_cast<int>(rows.front().size()));
  for (int r = 0; r < costs.rows(); ++r) {
    for (int c = 0; c < costs.columns(); ++c) {
      costs(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    }
  }
  return costs;
}

/// Random costs, also negative ones and ties; about `forbidden` of the pairs are forbidden.
CostMatrix randomTable(int rows, int columns, double forbidden, std::mt19937& random) {
  std::uniform_int_distribution<int> cost(-5, 10);
  std::bernoulli_distribution is_forbidden(forbidden);
  CostMatrix costs(rows, columns);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      costs(r, c) = is_forbidden(random) ? kForbiddenPair : cost(random);
    }
  }
  return costs;
}

struct Best {
  double total = std::numeric_limits<double>::infinity();  ///< Pairs and rows without a partner.
  int most_pairs = 0;
  double most_pairs_cost = 0.0;
};

/// Tries every way to give the rows columns, or none.
Best tryAll(const CostMatrix& costs, double cost_of_none) {
  Best best;
  std::vector<char> used(static_cast<std::size_t>(costs.columns()), 0);
  const std::function<void(int, double, double, int)> place = [&](int row, double total,
                                                                  double pairs_cost, int pairs) {
    if (row == costs.rows()) {
      best.total = std::min(best.total, total);
      if (pairs > best.most_pairs ||
          (pairs == best.most_pairs && pairs_cost < best.most_pairs_cost)) {
        best.most_pairs = pairs;
        best.most_pairs_cost = pairs_cost;
      }
      return;
    }
    place(row + 1, total + cost_of_none, pairs_cost, pairs);
    for (int c = 0; c < costs.columns(); ++c) {
      auto& taken = used[static_cast<std::size_t>(c)];
      if (taken == 0 && std::isfinite(costs(row, c))) {
        taken = 1;
        place(row + 1, total + costs(row, c), pairs_cost + costs(row, c), pairs + 1);
        taken = 0;
      }
    }
  };
  place(0, 0.0, 0.0, 0);
  return best;
}

void expectLawful(const CostMatrix& costs, const Assignment& result) {
  std::vector<int> taken;
  double sum = 0.0;
  for (int r = 0; r < costs.rows(); ++r) {
    const int c = result.column_of_row[static_cast<std::size_t>(r)];
    if (c != Assignment::kNone) {
      ASSERT_TRUE(std::isfinite(costs(r, c)));
      taken.push_back(c);
      sum += costs(r, c);
    }
  }
  EXPECT_EQ(static_cast<int>(taken.size()), result.pairs);
  EXPECT_NEAR(sum, result.cost, 1e-9);
  std::sort(taken.begin(), taken.end());
  EXPECT_EQ(std::adjacent_find(taken.begin(), taken.end()), taken.end());
}

TEST(Assignment, TakesTheWholeBestOverTheGreedyBest) {
  AssignmentSolver solver;
  Assignment result;
  solver.solveMostPairs(table({{1.0, 2.0}, {2.0, 9.0}}), result);
  EXPECT_THAT(result.column_of_row, ElementsAre(1, 0));
  EXPECT_DOUBLE_EQ(result.cost, 4.0);
}

TEST(Assignment, NeverMakesAForbiddenPair) {
  AssignmentSolver solver;
  Assignment result;
  solver.solveMostPairs(table({{kForbiddenPair, 5.0}, {kForbiddenPair, 1.0}}), result);
  EXPECT_THAT(result.column_of_row, ElementsAre(Assignment::kNone, 1));
  EXPECT_EQ(result.pairs, 1);
}

TEST(Assignment, LeavesAPairThatCostsMoreThanNone) {
  AssignmentSolver solver;
  Assignment result;
  solver.solve(table({{3.0, 8.0}, {9.0, 8.0}}), 5.0, result);
  EXPECT_THAT(result.column_of_row, ElementsAre(0, Assignment::kNone));
  EXPECT_DOUBLE_EQ(result.cost, 3.0);
}

TEST(Assignment, AcceptsEmptyTables) {
  AssignmentSolver solver;
  Assignment result;
  solver.solve(CostMatrix(), 0.0, result);
  EXPECT_TRUE(result.column_of_row.empty());
  solver.solve(CostMatrix(3, 0), 0.0, result);
  EXPECT_THAT(result.column_of_row, ElementsAre(-1, -1, -1));
  solver.solveMostPairs(CostMatrix(0, 3), result);
  EXPECT_EQ(result.pairs, 0);
}

TEST(Assignment, MatchesTheBestOfAllPossibilities) {
  std::mt19937 random(11);
  AssignmentSolver solver;  // One for all, so that reused memory is tested too.
  Assignment result;
  for (int rows = 1; rows <= 6; ++rows) {
    for (int columns = 1; columns <= 6; ++columns) {
      for (const double forbidden : {0.0, 0.3, 0.8}) {
        for (int trial = 0; trial < 3; ++trial) {
          const CostMatrix costs = randomTable(rows, columns, forbidden, random);
          const double none = 2.0;
          const Best best = tryAll(costs, none);
          solver.solve(costs, none, result);
          expectLawful(costs, result);
          EXPECT_NEAR(result.cost + none * (rows - result.pairs), best.total, 1e-9);
          solver.solveMostPairs(costs, result);
          expectLawful(costs, result);
          EXPECT_EQ(result.pairs, best.most_pairs);
          EXPECT_NEAR(result.cost, best.most_pairs_cost, 1e-9);
        }
      }
    }
  }
}

TEST(Assignment, CostDoesNotDependOnTheOrderOfRows) {
  std::mt19937 random(3);
  AssignmentSolver solver;
  Assignment result, shuffled_result;
  for (int trial = 0; trial < 50; ++trial) {
    const CostMatrix costs = randomTable(20, 25, 0.4, random);
    std::vector<int> order(20);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    CostMatrix shuffled(20, 25);
    for (int r = 0; r < 20; ++r) {
      for (int c = 0; c < 25; ++c) {
        shuffled(r, c) = costs(order[static_cast<std::size_t>(r)], c);
      }
    }
    solver.solve(costs, 1.0, result);
    solver.solve(shuffled, 1.0, shuffled_result);
    EXPECT_NEAR(result.cost - result.pairs, shuffled_result.cost - shuffled_result.pairs, 1e-9);
  }
}

TEST(Assignment, RejectsCostsThatAreNoNumbers) {
  AssignmentSolver solver;
  Assignment result;
  EXPECT_THROW(solver.solve(table({{std::nan("")}}), 0.0, result), std::invalid_argument);
  EXPECT_THROW(solver.solve(table({{-kForbiddenPair}}), 0.0, result), std::invalid_argument);
  EXPECT_THROW(solver.solve(table({{1.0}}), kForbiddenPair, result), std::invalid_argument);
  EXPECT_THROW(CostMatrix(-1, 2), std::invalid_argument);
}

}  // namespace
}  // namespace heel
