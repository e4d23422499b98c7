// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The filter on a point type that is not PCL's, with the bodies included as PCL's users do.
#define PCL_NO_PRECOMPILE

#include "segmentation/appearance_filter.hpp"
#include "tests/support/pcl_filter_contract.hpp"

#include <pcl/register_point_struct.h>

#include <cstdint>

namespace heel::test {

/// Plain members, no padding, no packed `rgb`.
struct PaintedPoint {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t coats = 3;
};

}  // namespace heel::test

// clang-format off
POINT_CLOUD_REGISTER_POINT_STRUCT(heel::test::PaintedPoint,
    (float, x, x)(float, y, y)(float, z, z)
    (std::uint8_t, r, r)(std::uint8_t, g, g)(std::uint8_t, b, b)(std::uint8_t, coats, coats))
// clang-format on

namespace heel::test {
namespace {

struct OwnPointCase {
  using Point = PaintedPoint;
  using Filter = AppearanceFilter<PaintedPoint>;
  static void setUp(Filter& filter) {
    filter.setTable(ColorTable([](std::uint8_t, std::uint8_t, std::uint8_t r) { return r; }));
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(AppearanceFilterOnAPointOfOnesOwn, PclFilterContract, OwnPointCase);

}  // namespace
}  // namespace heel::test
