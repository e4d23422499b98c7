// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/mapping/map_files.hpp>
#include <heel/mapping/wall_map_builder.hpp>

#include <gmock/gmock.h>
#include <octomap/OcTree.h>

#include <sstream>

namespace heel {
namespace {

using test::messageOf;
using testing::AllOf;
using testing::HasSubstr;

WallMap room() {
  WallMapBuilder builder;
  builder.addFreeFloor({0.0, 0.0}, {4.0, 3.0});
  builder.add(WallBox{{2.0, 0.0}, 0.0, {4.0, 0.1}, {0.0, 2.5}});
  builder.add(WallBox{{4.0, 1.5}, 1.6, {3.0, 0.12}, {0.0, 2.5}});
  builder.add(WallCylinder{{1.0, 1.0}, 0.3, {0.5, 1.2}});
  return builder.build();
}

class WallMapFile : public testing::Test {
 protected:
  WallMapFile() { saveWallMap(room(), folder_ / "room.bt"); }
  std::string whole() const { return test::readText(folder_ / "room.bt"); }
  std::string whyNot(const std::string& bytes) {
    return messageOf([&] { loadWallMap(folder_.write("bad.bt", bytes)); });
  }
  test::TempFolder folder_;
};

TEST_F(WallMapFile, IsReadBackWithTheSameWallsAndFloor) {
  const WallMap written = room(), read = loadWallMap(folder_ / "room.bt");
  EXPECT_EQ(read.cell_size_m(), written.cell_size_m());
  const OccupancyGrid a = written.floorGrid(), b = read.floorGrid();
  EXPECT_EQ(a.cells(), b.cells());
  EXPECT_TRUE(a.origin_m().isApprox(b.origin_m(), 1e-9));
  for (double x = -0.2; x < 4.3; x += 0.05) {
    for (double z = 0.02; z < 2.7; z += 0.05) {
      for (const double y : {0.0, 0.9, 1.5}) {
        EXPECT_EQ(read.isWall({x, y, z}), written.isWall({x, y, z}));
      }
    }
  }
}

TEST_F(WallMapFile, OctoMapsOwnReaderReadsIt) {
  octomap::OcTree tree(1.0);
  ASSERT_TRUE(tree.readBinary((folder_ / "room.bt").string()));
  EXPECT_EQ(tree.getResolution(), 0.05);
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(2.0, 0.02, 1.0)));
}

// OctoMap's writeBinary turns every probability into a limit and prunes; a map that is being
// queried, or goes on learning, must not change by being saved.
TEST_F(WallMapFile, SavingDoesNotChangeTheMap) {
  octomap::OcTree tree(0.1);
  tree.updateNode(octomap::point3d(0.05F, 0.05F, 0.05F), true);
  const auto own = std::make_shared<octomap::OcTree>(tree);
  const float before = own->search(0.05, 0.05, 0.05)->getLogOdds();
  saveWallMap(WallMap(own), folder_ / "one.bt");
  EXPECT_EQ(own->search(0.05, 0.05, 0.05)->getLogOdds(), before);
  std::ostringstream out;
  tree.writeBinary(out);
  EXPECT_NE(tree.search(0.05, 0.05, 0.05)->getLogOdds(), before) << "the trap itself";
}

TEST_F(WallMapFile, TruncatedAnywhereItGetsASentence) {
  const std::string bytes = whole();
  for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 97) {
    const std::string why = whyNot(bytes.substr(0, size));
    EXPECT_THAT(why, AllOf(HasSubstr("bad.bt: "), testing::Not(HasSubstr("\n")))) << size;
  }
  EXPECT_THAT(whyNot(bytes.substr(0, bytes.size() - 1)), HasSubstr("truncated"));
}

TEST_F(WallMapFile, WhatIsNoWallMapIsNamed) {
  const std::string bytes = whole();
  EXPECT_THAT(whyNot(""), HasSubstr("not a wall map"));
  EXPECT_THAT(whyNot("a letter"), HasSubstr("not a wall map"));
  EXPECT_THAT(whyNot(bytes + "x"), HasSubstr("goes on after the end"));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = bytes;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(whyNot(with("id OcTree", "id ColorOcTree")), HasSubstr("'ColorOcTree'"));
  EXPECT_THAT(whyNot(with("res 0.05", "res -1")), HasSubstr("'res'"));
  EXPECT_THAT(whyNot(with("res 0.05", "res 1e9")), HasSubstr("'res'"));
  EXPECT_THAT(whyNot(with("res 0.05", "res fine")), HasSubstr("'res'"));
  EXPECT_THAT(whyNot(with("\nsize ", "\nsize 1")), HasSubstr("nodes"));
  EXPECT_THAT(whyNot(with("\nsize ", "\nsize many ")), HasSubstr("'size'"));
  // Nothing but inner nodes: OctoMap's reader would go down for ever.
  EXPECT_THAT(whyNot(bytes.substr(0, bytes.find("data\n") + 5) + std::string(100, '\xFF')),
              HasSubstr("deeper"));
  EXPECT_THAT(messageOf([&] { loadWallMap(folder_ / "none.bt"); }), HasSubstr("No such file"));
  EXPECT_THAT(messageOf([&] { loadWallMap(folder_.path()); }), HasSubstr("it is a folder"));
  EXPECT_THAT(messageOf([&] { saveWallMap(room(), folder_ / "no/room.bt"); }),
              HasSubstr("room.bt cannot be written"));
}

TEST_F(WallMapFile, AFewBytesThatSpanTheWorldAreRefused) {
  // One child of the root is a leaf, the others lead to one more: half of all that a tree can be.
  const std::string why =
      whyNot("# Octomap OcTree binary file\nid OcTree\nsize 4\nres 0.05\ndata\n" +
             std::string("\x03\x00\x03\x00\x01\x00", 6));
  EXPECT_THAT(why, AllOf(HasSubstr("bad.bt: the floor that the map spans asks for")));
}

TEST_F(WallMapFile, AnEmptyMapIsReadBackEmpty) {
  saveWallMap(WallMapBuilder(0.1).build(), folder_ / "empty.bt");
  EXPECT_TRUE(loadWallMap(folder_ / "empty.bt").floorGrid().empty());
}

TEST(RealOctomaps, ACorridorAndARoomAreRead) {
  HEEL_NEED_DATA("octomaps");
  for (const char* name : {"fr_079.bt", "fr_078_tidyup.bt", "geb079.bt"}) {
    const WallMap map = loadWallMap(test::dataFolder() / "octomaps" / name);
    const OccupancyGrid floor = map.floorGrid({0.3, 1.5});
    int count[3] = {0, 0, 0};
    for (const Occupancy cell : floor.cells()) ++count[static_cast<int>(cell)];
    EXPECT_GT(count[static_cast<int>(Occupancy::kOccupied)], 1000) << name;
    EXPECT_GT(count[static_cast<int>(Occupancy::kFree)], 1000) << name;
  }
}

TEST(RealMaps, AnOfficeIsTheSameAfterItWasAWallMap) {
  HEEL_NEED_DATA("floor_maps");
  const OccupancyGrid plan =
      loadMapServer(test::dataFolder() / "floor_maps/willow/willow-2010-02-18-0.10.yaml");
  WallMapBuilder builder(plan.cell_size_m());
  builder.add(plan);
  const OccupancyGrid floor = builder.build().floorGrid();
  for (int y = 0; y < plan.height(); ++y) {
    for (int x = 0; x < plan.width(); ++x) {
      ASSERT_EQ(floor.at(plan.center({x, y})), plan.at(GridCell{x, y})) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace heel
