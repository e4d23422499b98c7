// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segmentation/color_table.hpp"

#include <gtest/gtest.h>

namespace heel {
namespace {

TEST(ColorTable, HoldsTheValueAtTheCentreOfEachCell) {
  const ColorTable table([](std::uint8_t b, std::uint8_t, std::uint8_t) { return b; });
  EXPECT_EQ(table(0, 9, 9), 2);
  EXPECT_EQ(table(3, 9, 9), 2);
  EXPECT_EQ(table(4, 9, 9), 6);
}

}  // namespace
}  // namespace heel
