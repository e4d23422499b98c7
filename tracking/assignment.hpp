// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Optimal assignment of rows to columns.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace heel {

/// The cost of a pair that may not be made.
inline constexpr double kForbiddenPair = std::numeric_limits<double>::infinity();

/// A table of costs in flat memory that is reused.
class CostMatrix {
 public:
  CostMatrix() = default;
  CostMatrix(int rows, int columns, double cost = kForbiddenPair) { reset(rows, columns, cost); }

  /// Makes the table `rows` x `columns`, every cost `cost`.
  /// @throws std::invalid_argument  if a size is negative.
  void reset(int rows, int columns, double cost = kForbiddenPair);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double& operator()(int row, int column) { return costs_[index(row, column)]; }
  double operator()(int row, int column) const { return costs_[index(row, column)]; }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int rows_ = 0;
  int columns_ = 0;
  std::vector<double> costs_;
};

/// Which column each row got.
struct Assignment {
  static constexpr int kNone = -1;

  std::vector<int> column_of_row;  ///< `kNone` for a row that got none.
  double cost = 0.0;               ///< Sum over the pairs made.
  int pairs = 0;
};

/// Solves assignment problems by shortest augmenting paths (Jonker and Volgenant 1987; the form
/// with row and column potentials), O(rows^2 (rows + columns)). Keeps its memory between calls.
///
/// Costs may be negative, or `kForbiddenPair`. Rows and columns may go without a partner.
/// Both functions throw std::invalid_argument if a cost is NaN or minus infinity.
class AssignmentSolver {
 public:
  /// The pairs with the least sum of costs, where each row without a partner costs `cost_of_none`
  /// (finite): a pair that costs more is never made.
  void solve(const CostMatrix& costs, double cost_of_none, Assignment& result);

  /// As many pairs as can be made, and of all such choices the one with the least cost.
  void solveMostPairs(const CostMatrix& costs, Assignment& result);

 private:
  /// Column `columns + row` stands for "row has no partner".
  double costOf(const CostMatrix& costs, int row, int column) const;
  void addRow(const CostMatrix& costs, int row);

  double cost_of_none_ = 0.0;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  std::vector<double> distance_;
  std::vector<int> row_of_column_;
  std::vector<int> previous_column_;
  std::vector<char> done_;
};

}  // namespace heel
