// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/sgm_kernels.hpp>

#include <algorithm>
#include <climits>
#include <cstddef>

// Compiled for the amd64 baseline and for AVX2; the loader takes the one that the machine has.
// Sanitizers can't be combined with it: they are not ready when the loader decides.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HEEL_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define HEEL_VECTOR_CLONES
#endif

// Says that a loop's steps write nothing that another step reads; with this many arrays compilers
// don't find out themselves.
#if defined(__clang__)
#define HEEL_INDEPENDENT_STEPS _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define HEEL_INDEPENDENT_STEPS _Pragma("GCC ivdep")
#else
#define HEEL_INDEPENDENT_STEPS
#endif

namespace heel::sgm {
namespace {

constexpr int kMaxDisparities = 256;

inline std::uint8_t excess(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>(std::max(a, b) - b);
}

inline std::uint8_t distance(std::uint8_t u, std::uint8_t u_low, std::uint8_t u_high,
                             std::uint8_t v, std::uint8_t v_low, std::uint8_t v_high) {
  const std::uint8_t forth = std::max(excess(u, v_high), excess(v_low, u));
  const std::uint8_t back = std::max(excess(v, u_high), excess(u_low, v));
  return std::min(forth, back);
}

inline void halfPixelRange(int width, int begin, int end, const Features& f) {
  const std::uint8_t* value = f.value;
  std::uint8_t* low = f.low;
  std::uint8_t* high = f.high;
  const auto at = [&](int x, int left, int right) {
    const int half_left = (value[x] + value[left]) / 2;
    const int half_right = (value[x] + value[right]) / 2;
    low[x] = static_cast<std::uint8_t>(std::min({half_left, half_right, int{value[x]}}));
    high[x] = static_cast<std::uint8_t>(std::max({half_left, half_right, int{value[x]}}));
  };
  const int inner_begin = std::max(begin, 1);
  const int inner_end = std::min(end, width - 1);
  if (begin < inner_begin) at(0, 0, std::min(1, width - 1));
  for (int x = inner_begin; x < inner_end; ++x) {
    const auto left = static_cast<std::uint8_t>((value[x] + value[x - 1]) / 2);
    const auto right = static_cast<std::uint8_t>((value[x] + value[x + 1]) / 2);
    low[x] = std::min(std::min(left, right), value[x]);
    high[x] = std::max(std::max(left, right), value[x]);
  }
  if (inner_end < end && width > 1) at(width - 1, width - 2, width - 1);
}

}  // namespace

HEEL_VECTOR_CLONES
void rowFeatures(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below,
                 int width, int begin, int end, int cap, int sign, const RowFeatures& out) {
  // One column more than asked on either side, for the half-pixel ranges.
  const int wide_begin = std::max(begin - 1, 0), wide_end = std::min(end + 1, width);
  std::uint8_t* gradient = out.gradient.value;
  const auto limit = static_cast<std::int16_t>(cap);
  const auto sign16 = static_cast<std::int16_t>(sign);
  for (int x = std::max(wide_begin, 1); x < std::min(wide_end, width - 1); ++x) {
    const auto slope = static_cast<std::int16_t>((row[x + 1] - row[x - 1]) * 2 + above[x + 1] -
                                                 above[x - 1] + below[x + 1] - below[x - 1]);
    const auto turned = static_cast<std::int16_t>(slope * sign16);
    const auto cut = std::clamp(turned, static_cast<std::int16_t>(-limit), limit);
    gradient[x] = static_cast<std::uint8_t>(cut + limit);
  }
  std::uint8_t* brightness = out.brightness.value;
  std::copy(row + wide_begin, row + wide_end, brightness + wide_begin);
  // The outermost columns have no gradient; OpenCV gives both features this value there.
  const auto flat = static_cast<std::uint8_t>(cap);
  if (wide_begin == 0) gradient[0] = brightness[0] = flat;
  if (wide_end == width) gradient[width - 1] = brightness[width - 1] = flat;
  halfPixelRange(width, begin, end, out.gradient);
  halfPixelRange(width, begin, end, out.brightness);
}

HEEL_VECTOR_CLONES
void pixelCosts(const RowFeatures& left, const RowFeatures& right, int right_start, int begin,
                int end, int disparities, std::uint8_t* costs) {
  for (int x = begin; x < end; ++x) {
    const std::uint8_t g = left.gradient.value[x], g_low = left.gradient.low[x],
                       g_high = left.gradient.high[x];
    const std::uint8_t b = left.brightness.value[x], b_low = left.brightness.low[x],
                       b_high = left.brightness.high[x];
    const std::ptrdiff_t start = right_start - x;
    const std::uint8_t* gv = right.gradient.value + start;
    const std::uint8_t* gv_low = right.gradient.low + start;
    const std::uint8_t* gv_high = right.gradient.high + start;
    const std::uint8_t* bv = right.brightness.value + start;
    const std::uint8_t* bv_low = right.brightness.low + start;
    const std::uint8_t* bv_high = right.brightness.high + start;
    std::uint8_t* __restrict cost = costs + std::ptrdiff_t{x} * disparities;
    for (int d = 0; d < disparities; ++d) {
      const std::uint8_t in_gradient = distance(g, g_low, g_high, gv[d], gv_low[d], gv_high[d]);
      const std::uint8_t in_brightness = distance(b, b_low, b_high, bv[d], bv_low[d], bv_high[d]);
      cost[d] = static_cast<std::uint8_t>(in_gradient + (in_brightness >> 2));
    }
  }
}

HEEL_VECTOR_CLONES
void sumColumns(const std::uint8_t* costs, int begin, int end, int first_column, int last_column,
                int radius, int disparities, std::int16_t* sums) {
  const auto column = [&](int x) {
    return costs + std::ptrdiff_t{std::clamp(x, first_column, last_column)} * disparities;
  };
  std::int16_t* __restrict first = sums + std::ptrdiff_t{begin} * disparities;
  std::fill(first, first + disparities, std::int16_t{0});
  for (int k = -radius; k <= radius; ++k) {
    const std::uint8_t* added = column(begin + k);
    for (int d = 0; d < disparities; ++d) first[d] = static_cast<std::int16_t>(first[d] + added[d]);
  }
  for (int x = begin + 1; x < end; ++x) {
    const std::uint8_t* enters = column(x + radius);
    const std::uint8_t* leaves = column(x - radius - 1);
    std::int16_t* __restrict sum = sums + std::ptrdiff_t{x} * disparities;
    const std::int16_t* previous = sum - disparities;
    for (int d = 0; d < disparities; ++d) {
      sum[d] = static_cast<std::int16_t>(previous[d] + enters[d] - leaves[d]);
    }
  }
}

HEEL_VECTOR_CLONES
void sumRows(const std::int16_t* const* rows, int row_count, int begin, int end, int disparities,
             std::int16_t* costs) {
  const std::ptrdiff_t first = std::ptrdiff_t{begin} * disparities;
  const std::ptrdiff_t last = std::ptrdiff_t{end} * disparities;
  std::int16_t* __restrict out = costs;
  if (row_count == 5) {
    const std::int16_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for (std::ptrdiff_t i = first; i < last; ++i) {
      out[i] = static_cast<std::int16_t>(a[i] + b[i] + c[i] + d[i] + e[i]);
    }
    return;
  }
  std::copy(rows[0] + first, rows[0] + last, out + first);
  for (int k = 1; k < row_count; ++k) {
    const std::int16_t* added = rows[k];
    for (std::ptrdiff_t i = first; i < last; ++i) {
      out[i] = static_cast<std::int16_t>(out[i] + added[i]);
    }
  }
}

namespace {

/// One step of one path: cost + the cheapest way on from `from`, less the least of `from`.
inline std::int16_t step(const std::int16_t* from, int d, std::int16_t cost, std::int16_t p1,
                         std::int16_t least, std::int16_t least_p2) {
  const auto beside =
      static_cast<std::int16_t>(std::min<std::int16_t>(from[d - 1], from[d + 1]) + p1);
  const auto way = std::min<std::int16_t>(std::min<std::int16_t>(from[d], beside), least_p2);
  return static_cast<std::int16_t>(cost + way - least);
}

/// What a path has before its first pixel: zeros between infinities.
struct Start {
  alignas(32) std::array<std::int16_t, kMaxDisparities + kPadding> vector{};
  explicit Start(int disparities) {
    vector[kLead - 1] = kInfinite;
    vector[static_cast<std::size_t>(kLead + disparities)] = kInfinite;
  }
  const std::int16_t* data() const { return vector.data() + kLead; }
};

}  // namespace

HEEL_VECTOR_CLONES
void forwardPass(const PathRow& row, int begin, int end) {
  const int D = row.disparities;
  const std::ptrdiff_t stride = D + kPadding;
  const std::int16_t p1 = row.p1;
  const Start start(D);
  Start left_now(D), left_next(D);
  std::int16_t* left = left_now.vector.data() + kLead;
  std::int16_t* left_out = left_next.vector.data() + kLead;
  std::int16_t left_least = 0;
  for (int x = begin; x < end; ++x) {
    const std::int16_t* from[kPathsFromAbove];
    std::int16_t least[kPathsFromAbove];
    for (int path = 0; path < kPathsFromAbove; ++path) {
      const int from_x = x - 1 + path;
      const bool goes_on =
          row.above != nullptr && from_x >= 0 && from_x < row.width && row.above[from_x] != 0;
      const std::ptrdiff_t at = std::ptrdiff_t{from_x} * kPathsFromAbove + path;
      from[path] = goes_on ? row.from_above + at * stride + kLead : start.data();
      least[path] = goes_on ? row.minima_above[at] : std::int16_t{0};
    }
    const std::int16_t *a = from[0], *b = from[1], *c = from[2];
    const std::ptrdiff_t out_at = std::ptrdiff_t{x} * kPathsFromAbove;
    std::int16_t* __restrict a_out = row.to_below + out_at * stride + kLead;
    std::int16_t* __restrict b_out = a_out + stride;
    std::int16_t* __restrict c_out = b_out + stride;
    const std::int16_t* __restrict cost = row.costs + std::ptrdiff_t{x} * D;
    std::int16_t* __restrict total = row.totals + std::ptrdiff_t{x} * D;
    std::int16_t* __restrict l_out = left_out;
    const std::int16_t* __restrict l = left;
    const std::int16_t l_min = left_least, a_min = least[0], b_min = least[1], c_min = least[2];
    const auto l_p2 = static_cast<std::int16_t>(l_min + row.p2);
    const auto a_p2 = static_cast<std::int16_t>(a_min + row.p2);
    const auto b_p2 = static_cast<std::int16_t>(b_min + row.p2);
    const auto c_p2 = static_cast<std::int16_t>(c_min + row.p2);
    std::int16_t l_next = kInfinite, a_next = kInfinite, b_next = kInfinite, c_next = kInfinite;
    HEEL_INDEPENDENT_STEPS
    for (int d = 0; d < D; ++d) {
      const std::int16_t on_l = step(l, d, cost[d], p1, l_min, l_p2);
      const std::int16_t on_a = step(a, d, cost[d], p1, a_min, a_p2);
      const std::int16_t on_b = step(b, d, cost[d], p1, b_min, b_p2);
      const std::int16_t on_c = step(c, d, cost[d], p1, c_min, c_p2);
      l_out[d] = on_l;
      a_out[d] = on_a;
      b_out[d] = on_b;
      c_out[d] = on_c;
      l_next = std::min(l_next, on_l);
      a_next = std::min(a_next, on_a);
      b_next = std::min(b_next, on_b);
      c_next = std::min(c_next, on_c);
      total[d] = static_cast<std::int16_t>(on_l + on_a + on_b + on_c);
    }
    for (std::int16_t* out : {a_out, b_out, c_out}) out[-1] = out[D] = kInfinite;
    row.minima_below[out_at] = a_next;
    row.minima_below[out_at + 1] = b_next;
    row.minima_below[out_at + 2] = c_next;
    left_least = l_next;
    std::swap(left, left_out);
  }
}

HEEL_VECTOR_CLONES
void backwardPass(const PathRow& row, int begin, int end, int uniqueness_percent, Winner* winners) {
  const int D = row.disparities;
  Start right_now(D), right_next(D);
  std::int16_t* right = right_now.vector.data() + kLead;
  std::int16_t* right_out = right_next.vector.data() + kLead;
  std::int16_t right_least = 0;
  for (int x = end - 1; x >= begin; --x) {
    const std::int16_t* __restrict cost = row.costs + std::ptrdiff_t{x} * D;
    std::int16_t* __restrict total = row.totals + std::ptrdiff_t{x} * D;
    const std::int16_t* __restrict from = right;
    std::int16_t* __restrict out = right_out;
    const std::int16_t least = right_least, p1 = row.p1;
    const auto least_p2 = static_cast<std::int16_t>(least + row.p2);
    std::int16_t next = kInfinite;
    std::int32_t best = INT_MAX;  // total and index in one number: the first of equals wins
    HEEL_INDEPENDENT_STEPS
    for (int d = 0; d < D; ++d) {
      const std::int16_t on = step(from, d, cost[d], p1, least, least_p2);
      out[d] = on;
      next = std::min(next, on);
      const auto sum = static_cast<std::int16_t>(total[d] + on);
      total[d] = sum;
      best = std::min(best, sum * kMaxDisparities + d);
    }
    right_least = next;
    std::swap(right, right_out);

    const auto d = static_cast<std::int16_t>(best % kMaxDisparities);
    const auto least_total = static_cast<std::int16_t>(best / kMaxDisparities);
    const int rivals_below =
        (least_total * 100 + 99 - uniqueness_percent) / (100 - uniqueness_percent);
    const auto limit = static_cast<std::int16_t>(std::min<int>(rivals_below, INT16_MAX));
    std::int16_t rivals = 0;
    for (int i = 0; i < D; ++i)
      rivals = static_cast<std::int16_t>(rivals + (total[i] < limit ? 1 : 0));
    for (int i = std::max(d - 1, 0); i <= std::min(d + 1, D - 1); ++i) {
      rivals = static_cast<std::int16_t>(rivals - (total[i] < limit ? 1 : 0));
    }
    Winner& winner = winners[x];
    winner.total = least_total;
    winner.index = rivals > 0 ? std::int16_t{-1} : d;
    winner.before = d > 0 ? total[d - 1] : kInfinite;
    winner.after = d + 1 < D ? total[d + 1] : kInfinite;
  }
}

}  // namespace heel::sgm
