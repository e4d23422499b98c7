// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/image_filter.hpp>

#include <stdexcept>

#if defined(__x86_64__) && defined(__GNUC__)
#define HEEL_HAS_SSSE3 1
#include <immintrin.h>
#endif

namespace heel {
namespace {

/// Looks up the scores of `n` pixels.
void lookUpPlain(const std::uint8_t* bgr, std::size_t n, const std::uint8_t* table,
                 std::uint8_t* scores) {
  for (std::size_t i = 0; i < n; ++i, bgr += 3) {
    scores[i] = table[ColorTable::cell(bgr[0], bgr[1], bgr[2])];
  }
}

#ifdef HEEL_HAS_SSSE3

/// The same, twice as fast: the cells of 16 pixels at a time, four in a register.
__attribute__((target("ssse3"))) void lookUpSsse3(const std::uint8_t* bgr, std::size_t n,
                                                  const std::uint8_t* table, std::uint8_t* scores) {
  constexpr std::size_t kBlock = 16;
  constexpr int kStep = static_cast<int>(ColorTable::kLevels);
  // bgrbgrbgrbgr.... -> bgr0 bgr0 bgr0 bgr0
  const __m128i spread = _mm_setr_epi8(0, 1, 2, -1, 3, 4, 5, -1, 6, 7, 8, -1, 9, 10, 11, -1);
  // avg(v, 31) = 16 + v / 2 and avg(16 + v / 2, 47) = 32 + v / 4: the least of the three is the
  // level.
  const __m128i to_half = _mm_set1_epi8(31);
  const __m128i to_quarter = _mm_set1_epi8(47);
  const __m128i weigh_bg = _mm_set1_epi32(1 | (kStep << 8) | (1 << 16));  // b + 96 g | r
  const __m128i weigh_r = _mm_set1_epi32(1 | ((kStep * kStep) << 16));    // (b + 96 g) + 96^2 r

  std::size_t i = 0;
  // The last load of a block reads four bytes past its 16 pixels: two more must follow.
  for (; i + kBlock + 2 <= n; i += kBlock) {
    alignas(16) std::array<std::uint32_t, kBlock> cells;
    for (std::size_t j = 0; j < kBlock; j += 4) {
      const auto* source = reinterpret_cast<const __m128i*>(bgr + 3 * (i + j));
      const __m128i v = _mm_shuffle_epi8(_mm_loadu_si128(source), spread);
      const __m128i half = _mm_avg_epu8(v, to_half);
      const __m128i quarter = _mm_avg_epu8(half, to_quarter);
      const __m128i level = _mm_min_epu8(_mm_min_epu8(v, half), quarter);
      const __m128i cell = _mm_madd_epi16(_mm_maddubs_epi16(level, weigh_bg), weigh_r);
      _mm_store_si128(reinterpret_cast<__m128i*>(cells.data() + j), cell);
    }
    for (std::size_t j = 0; j < kBlock; ++j) scores[i + j] = table[cells[j]];
  }
  lookUpPlain(bgr + 3 * i, n - i, table, scores + i);
}

#endif

using LookUp = void (*)(const std::uint8_t*, std::size_t, const std::uint8_t*, std::uint8_t*);

LookUp fastestLookUp() {
#ifdef HEEL_HAS_SSSE3
  if (__builtin_cpu_supports("ssse3")) return lookUpSsse3;
#endif
  return lookUpPlain;
}

}  // namespace

void filterImage(const cv::Mat& image_bgr, const ColorTable& table, cv::Mat& mask) {
  if (image_bgr.type() != CV_8UC3) {
    throw std::invalid_argument("filterImage: the image is not of type CV_8UC3");
  }
  if (table.empty()) throw std::invalid_argument("filterImage: the colour table is empty");
  const cv::Mat image = image_bgr;  // keeps the pixels if `mask` is the same object
  mask.create(image.size(), CV_8UC1);
  if (image.empty()) return;

  const LookUp look_up = fastestLookUp();
  const std::uint8_t threshold = table.threshold();
  const bool one_row = image.isContinuous() && mask.isContinuous();
  const int rows = one_row ? 1 : image.rows;
  const std::size_t n = one_row ? image.total() : static_cast<std::size_t>(image.cols);
  for (int row = 0; row < rows; ++row) {
    // Scores first, then marks: comparing each score as it comes would take twice as long.
    auto* marks = mask.ptr<std::uint8_t>(row);
    look_up(image.ptr<std::uint8_t>(row), n, table.data(), marks);
    for (std::size_t i = 0; i < n; ++i) marks[i] = marks[i] > threshold ? 255 : 0;
  }
}

}  // namespace heel
