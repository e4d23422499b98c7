// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/apps/recording/bags/bag_map.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

namespace heel {
namespace {

using testing::HasSubstr;

OccupancyGrid someMap() {
  OccupancyGrid map({-1.5, 2.25}, 0.05, 3, 2);
  map.at({2, 0}) = Occupancy::kOccupied;
  map.at({0, 1}) = Occupancy::kUnknown;
  return map;
}

TEST(BagMap, IsTheSameThereAndBack) {
  const OccupancyGrid map = someMap(), back = toGrid(toMessage(map));
  EXPECT_EQ(back.cells(), map.cells());
  EXPECT_EQ(back.width(), 3);
  EXPECT_EQ(back.cell_size_m(), 0.05);
  EXPECT_EQ(back.origin_m(), map.origin_m());
}

TEST(BagMap, CellsAreWhatMapServerTakesThemFor) {
  OccupancyGridMsg message = toMessage(OccupancyGrid({0.0, 0.0}, 0.1, 6, 1));
  message.data = {0, 19, 20, 64, 65, -128};
  const std::vector<Occupancy> truth = {Occupancy::kFree,     Occupancy::kFree,
                                        Occupancy::kUnknown,  Occupancy::kUnknown,
                                        Occupancy::kOccupied, Occupancy::kUnknown};
  EXPECT_EQ(toGrid(message).cells(), truth);
}

TEST(BagMap, SaysWhatCanNotBe) {
  const auto refused = [](const std::function<void(OccupancyGridMsg&)>& spoil) {
    OccupancyGridMsg message = toMessage(someMap());
    spoil(message);
    return test::messageOf([&] { toGrid(message); });
  };
  EXPECT_THAT(refused([](auto& m) { m.data.pop_back(); }), HasSubstr("3x2 cells has 5 values"));
  EXPECT_THAT(refused([](auto& m) { m.info.width = m.info.height = 0x80000000U; }),
              HasSubstr("has 6 values"));
  EXPECT_THAT(refused([](auto& m) { m.data.clear(), m.info.width = 0; }), HasSubstr("0 values"));
  EXPECT_THAT(refused([](auto& m) { m.info.resolution = std::nanf(""); }), HasSubstr("resolution"));
  EXPECT_THAT(refused([](auto& m) { m.info.resolution = 0.0F; }), HasSubstr("resolution"));
  EXPECT_THAT(
      refused([](auto& m) { m.info.origin.position.x = std::numeric_limits<double>::infinity(); }),
      HasSubstr("origin"));
  EXPECT_THAT(refused([](auto& m) {
                m.info.origin.orientation = {0.0, 0.0, 1.0, 1.0};
              }),
              HasSubstr("turned"));
}

}  // namespace
}  // namespace heel
