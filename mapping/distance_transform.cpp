// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/mapping/distance_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr int kNone = 1 << 30;  ///< Further than any cell.

std::int64_t squared(std::int64_t x) { return x * x; }

std::int64_t floorDiv(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

}  // namespace

void DistanceTransform::compute(const std::vector<std::uint8_t>& occupied, int width, int height,
                                double cell_size_m, std::vector<float>& distance_m) {
  if (width <= 0 || height <= 0 || width >= kNone || height >= kNone ||
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
      const auto apart = [g](int at, int site) { return squared(at - site) + squared(g[site]); };
      const auto top = [&] { return static_cast<std::size_t>(last); };
      while (last >= 0 && apart(from_[top()], site_[top()]) > apart(from_[top()], x)) --last;
      int from = 0;
      if (last >= 0) {
        const int other = site_[top()];
        const std::int64_t begins = 1 + floorDiv(apart(0, x) - apart(0, other), 2 * (x - other));
        if (begins >= width) continue;
        from = static_cast<int>(begins);
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
      out[x] = cell * std::sqrt(static_cast<float>(squared(x - site) + squared(g[site])));
      if (x == from_[nearest]) --last;
    }
  }
}

}  // namespace heel
