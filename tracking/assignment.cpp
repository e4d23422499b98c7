// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/tracking/assignment.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heel {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

void CostMatrix::reset(int rows, int columns, double cost) {
  if (rows < 0 || columns < 0) {
    throw std::invalid_argument("CostMatrix: a size is negative");
  }
  rows_ = rows;
  columns_ = columns;
  costs_.assign(at(rows) * at(columns), cost);
}

double AssignmentSolver::costOf(const CostMatrix& costs, int row, int column) const {
  if (column < costs.columns()) {
    return costs(row, column);
  }
  return column - costs.columns() == row ? cost_of_none_ : kForbiddenPair;
}

void AssignmentSolver::solve(const CostMatrix& costs, double cost_of_none, Assignment& result) {
  if (!std::isfinite(cost_of_none)) {
    throw std::invalid_argument("AssignmentSolver: the cost of having no partner is not finite");
  }
  for (int row = 0; row < costs.rows(); ++row) {
    for (int column = 0; column < costs.columns(); ++column) {
      if (!(costs(row, column) > -kForbiddenPair)) {
        throw std::invalid_argument("AssignmentSolver: a cost is NaN or minus infinity");
      }
    }
  }
  cost_of_none_ = cost_of_none;
  const int all_columns = costs.columns() + costs.rows();
  row_potential_.assign(at(costs.rows()), 0.0);
  column_potential_.assign(at(all_columns), 0.0);
  row_of_column_.assign(at(all_columns), Assignment::kNone);
  for (int row = 0; row < costs.rows(); ++row) {
    addRow(costs, row);
  }

  result.column_of_row.assign(at(costs.rows()), Assignment::kNone);
  result.cost = 0.0;
  result.pairs = 0;
  for (int column = 0; column < costs.columns(); ++column) {
    const int row = row_of_column_[at(column)];
    if (row != Assignment::kNone) {
      result.column_of_row[at(row)] = column;
      result.cost += costs(row, column);
      ++result.pairs;
    }
  }
}

void AssignmentSolver::solveMostPairs(const CostMatrix& costs, Assignment& result) {
  // One pair more must outweigh any change of the others' costs.
  double largest = 0.0;
  for (int row = 0; row < costs.rows(); ++row) {
    for (int column = 0; column < costs.columns(); ++column) {
      if (std::isfinite(costs(row, column))) {
        largest = std::max(largest, std::abs(costs(row, column)));
      }
    }
  }
  solve(costs, 1.0 + 2.0 * largest * (1.0 + std::min(costs.rows(), costs.columns())), result);
}

/// Finds the cheapest chain of reassignments that gives `row` a column (Dijkstra over reduced
/// costs), and carries it out.
void AssignmentSolver::addRow(const CostMatrix& costs, int row) {
  const std::size_t columns = row_of_column_.size();
  distance_.assign(columns, kForbiddenPair);
  previous_column_.assign(columns, Assignment::kNone);
  done_.assign(columns, 0);
  int current_row = row;
  int current_column = Assignment::kNone;
  double travelled = 0.0;
  while (true) {
    int next_column = Assignment::kNone;
    for (std::size_t c = 0; c < columns; ++c) {
      if (done_[c] != 0) {
        continue;
      }
      const double through = travelled + costOf(costs, current_row, static_cast<int>(c)) -
                             row_potential_[at(current_row)] - column_potential_[c];
      if (through < distance_[c]) {
        distance_[c] = through;
        previous_column_[c] = current_column;
      }
      if (next_column == Assignment::kNone || distance_[c] < distance_[at(next_column)]) {
        next_column = static_cast<int>(c);
      }
    }
    // The row's own "no partner" column is always within reach, so there is a next one.
    travelled = distance_[at(next_column)];
    done_[at(next_column)] = 1;
    current_column = next_column;
    if (row_of_column_[at(current_column)] == Assignment::kNone) {
      break;
    }
    current_row = row_of_column_[at(current_column)];
  }

  row_potential_[at(row)] += travelled;
  for (std::size_t c = 0; c < columns; ++c) {
    if (done_[c] != 0 && row_of_column_[c] != Assignment::kNone) {
      row_potential_[at(row_of_column_[c])] += travelled - distance_[c];
      column_potential_[c] -= travelled - distance_[c];
    }
  }
  while (current_column != Assignment::kNone) {
    const int before = previous_column_[at(current_column)];
    row_of_column_[at(current_column)] =
        before == Assignment::kNone ? row : row_of_column_[at(before)];
    current_column = before;
  }
}

}  // namespace heel
