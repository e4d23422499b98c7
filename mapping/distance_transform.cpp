// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/distance_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

/// Further than any cell, and small enough that its square is still an int.
constexpr int kNone = 1 << 15;

int floorDiv(int a, int b) { return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0); }

}  // namespace

void DistanceTransform::compute(const std::vector<std::uint8_t>& occupied, int width, int height,
                                double cell_size_m, std::vector<float>& distance_m) {
  if (width <= 0 || height <= 0 || width >= kNone / 2 || height >= kNone / 2 ||
      occupied.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw std::invalid_argument("a distance transform needs width x height cells");
  }
  if (!(cell_size_m > 0.0)) throw std::invalid_argument("a cell's size must be positive");
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  along_column_.resize(occupied.size());
  distance_m.resize(occupied.size());
  site_.resize(columns);
  from_.resize(columns);

  int* const down = along_column_.data();
  for (std::size_t i = 0; i < columns; ++i) down[i] = occupied[i] != 0 ? 0 : kNone;
  for (std::size_t i = columns; i < occupied.size(); ++i) {
    down[i] = occupied[i] != 0 ? 0 : std::min(down[i - columns] + 1, kNone);
  }
  for (std::size_t i = occupied.size() - columns; i-- > 0;) {
    down[i] = std::min(down[i], down[i + columns] + 1);
  }

  const auto cell = static_cast<float>(cell_size_m);
  for (std::size_t row = 0; row < rows; ++row) {
    const int* const g = down + row * columns;
    float* const out = distance_m.data() + row * columns;
    int last = -1;  // of the columns that are nearest somewhere in this row
    for (int x = 0; x < width; ++x) {
      if (g[x] >= kNone) continue;
      const auto squared = [&](int at, int site) {
        return (at - site) * (at - site) + g[site] * g[site];
      };
      const auto top = [&] { return static_cast<std::size_t>(last); };
      while (last >= 0 && squared(from_[top()], site_[top()]) > squared(from_[top()], x)) --last;
      int from = 0;
      if (last >= 0) {
        const int other = site_[top()];
        from = 1 +
               floorDiv(x * x - other * other + g[x] * g[x] - g[other] * g[other], 2 * (x - other));
        if (from >= width) continue;
      }
      ++last;
      site_[top()] = x;
      from_[top()] = from;
    }
    if (last < 0) {
      std::fill(out, out + columns, std::numeric_limits<float>::infinity());
      continue;
    }
    for (int x = width - 1; x >= 0; --x) {
      const auto nearest = static_cast<std::size_t>(last);
      const int site = site_[nearest];
      const int squared = (x - site) * (x - site) + g[site] * g[site];
      out[x] = cell * std::sqrt(static_cast<float>(squared));
      if (x == from_[nearest]) --last;
    }
  }
}

}  // namespace heel
