// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/data.hpp"
#include "tests/support/temp_folder.hpp"
#include <heel/mapping/map_files.hpp>

#include <gmock/gmock.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <stdexcept>

namespace heel {
namespace {

using test::messageOf;
using testing::AllOf;
using testing::HasSubstr;

const std::string kYaml =
    "image: map.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

class MapServerFile : public testing::Test {
 protected:
  /// Three by two pixels: wall, free, unknown; free, free, wall.
  MapServerFile() {
    folder_.write("map.pgm", std::string("P5\n# a comment\n3 2\n255\n") +
                                 std::string("\x00\xFE\xCD\xFE\xFF\x10", 6));
  }
  OccupancyGrid load(const std::string& yaml) {
    return loadMapServer(folder_.write("map.yaml", yaml));
  }
  std::string whyNot(const std::string& yaml) {
    return messageOf([&] { load(yaml); });
  }
  /// kYaml with one line replaced.
  static std::string with(const std::string& key, const std::string& value) {
    std::string text = kYaml;
    const auto begin = text.find(key + ":");
    if (begin == std::string::npos) return text + key + ": " + value + "\n";
    return text.replace(begin, text.find('\n', begin) - begin, key + ": " + value);
  }

  test::TempFolder folder_;
};

TEST_F(MapServerFile, ItsUpperRowHasTheLargestY) {
  const OccupancyGrid grid = load(kYaml);
  ASSERT_EQ(grid.width(), 3);
  ASSERT_EQ(grid.height(), 2);
  EXPECT_EQ(grid.origin_m(), Eigen::Vector2d(-1.0, 2.0));
  EXPECT_EQ(grid.cells(),
            (std::vector<Occupancy>{Occupancy::kFree, Occupancy::kFree, Occupancy::kOccupied,
                                    Occupancy::kOccupied, Occupancy::kFree, Occupancy::kUnknown}));
}

TEST_F(MapServerFile, NegateTurnsBlackIntoFree) {
  const OccupancyGrid grid = load(with("negate", "1"));
  EXPECT_EQ(grid.at(GridCell{0, 1}), Occupancy::kFree);
  EXPECT_EQ(grid.at(GridCell{0, 0}), Occupancy::kOccupied);
}

TEST_F(MapServerFile, ThresholdsDecide) {
  // 205 is p = 0.196; 254 is 0.004.
  EXPECT_EQ(load(with("free_thresh", "0.25")).at(GridCell{2, 1}), Occupancy::kFree);
  EXPECT_EQ(load(with("occupied_thresh", "0.95")).at(GridCell{2, 0}), Occupancy::kUnknown);
}

TEST_F(MapServerFile, WhatMapSaverWritesForUnknownIsUnknownUnderNav2sThresholds) {
  const auto cellsOf = [&](const std::string& pixels, const std::string& negate) {
    folder_.write("map.pgm", "P5\n3 1\n255\n" + pixels);
    std::string yaml = with("negate", negate);
    return load(yaml.replace(yaml.find("0.196"), 5, "0.25")).cells();
  };
  const auto kWall = Occupancy::kOccupied, kFree = Occupancy::kFree, kNone = Occupancy::kUnknown;
  using Cells = std::vector<Occupancy>;
  EXPECT_EQ(cellsOf(std::string("\x00\xFE\xCD", 3), "0"), (Cells{kWall, kFree, kNone}));
  EXPECT_EQ(cellsOf("\xCD\xFE\xFF", "0"), (Cells{kNone, kFree, kFree})) << "mended with white";
  EXPECT_EQ(cellsOf("\xCD\xFE\xE0", "0"), (Cells{kFree, kFree, kFree})) << "it has other greys";
  EXPECT_EQ(cellsOf("\xCD\xFE\xFE", "1"), (Cells{kWall, kWall, kWall})) << "white is a wall";
}

TEST_F(MapServerFile, IsReadBackAsItWasWritten) {
  OccupancyGrid grid({-3.05, 0.1}, 0.05, 7, 4, Occupancy::kUnknown);
  grid.at(GridCell{2, 3}) = Occupancy::kOccupied;
  grid.at(GridCell{6, 0}) = Occupancy::kFree;
  saveMapServer(grid, folder_ / "saved.yaml");
  const OccupancyGrid read = loadMapServer(folder_ / "saved.yaml");
  EXPECT_EQ(read.cells(), grid.cells());
  EXPECT_EQ(read.origin_m(), grid.origin_m());
  EXPECT_EQ(read.cell_size_m(), grid.cell_size_m());
  EXPECT_EQ(read.width(), 7);
  EXPECT_THROW(saveMapServer(OccupancyGrid(), folder_ / "none.yaml"), std::invalid_argument);
  EXPECT_THAT(messageOf([&] { saveMapServer(grid, folder_ / "no/folder.yaml"); }),
              HasSubstr("folder.pgm cannot be written: No such file"));
}

TEST_F(MapServerFile, ScaleLeavesUnknownWhatIsNotOpaqueOrBetweenTheThresholds) {
  cv::Mat picture(1, 5, CV_8UC4);
  const cv::Vec4b pixels[] = {{0, 0, 0, 255},
                              {254, 254, 254, 255},
                              {128, 128, 128, 255},
                              {0, 0, 0, 254},
                              {254, 254, 254, 0}};
  std::copy(std::begin(pixels), std::end(pixels), picture.begin<cv::Vec4b>());
  cv::Mat in_16_bits;
  picture.convertTo(in_16_bits, CV_16U, 257.0);
  cv::imwrite(folder_ / "scale.png", picture);
  cv::imwrite(folder_ / "scale16.png", in_16_bits);
  const std::vector<Occupancy> truth = {Occupancy::kOccupied, Occupancy::kFree, Occupancy::kUnknown,
                                        Occupancy::kUnknown, Occupancy::kUnknown};
  EXPECT_EQ(load(with("image", "scale.png") + "mode: scale\n").cells(), truth);
  EXPECT_EQ(load(with("image", "scale16.png") + "mode: scale\n").cells(), truth);
  // Without an alpha channel all is opaque; and 205 is a shade like others.
  EXPECT_EQ(load(with("free_thresh", "0.25") + "mode: scale\n").at(GridCell{2, 1}),
            Occupancy::kFree);
}

TEST_F(MapServerFile, RawGreysArePercent) {
  folder_.write("map.pgm", std::string("P5\n6 1\n255\n\x00\x13\x14\x41\x42\x64", 17));
  const std::vector<Occupancy> truth = {Occupancy::kFree,     Occupancy::kFree,
                                        Occupancy::kUnknown,  Occupancy::kUnknown,
                                        Occupancy::kOccupied, Occupancy::kOccupied};
  EXPECT_EQ(load(with("mode", "raw")).cells(), truth) << "0, 19, 20, 65, 66, 100 percent";
  EXPECT_EQ(load(with("negate", "1") + "mode: raw\n").cells(), truth) << "as map_server has it";
  folder_.write("map.pgm", "P5\n2 1\n255\n\x65\xFF");
  EXPECT_EQ(load(with("mode", "raw")).cells(),
            (std::vector<Occupancy>{Occupancy::kUnknown, Occupancy::kUnknown}))
      << "over 100";
}

TEST_F(MapServerFile, AWholeTurnOrNearlyNoneIsNone) {
  for (const char* yaw : {"1e-6", "-1e-6", "6.283185307", "-6.28319", "12.5663706"}) {
    EXPECT_EQ(load(with("origin", std::string("[-1, 2, ") + yaw + "]")).origin_m(),
              Eigen::Vector2d(-1.0, 2.0))
        << yaw;
  }
}

TEST_F(MapServerFile, ATurnedOriginIsRefusedInAClearSentence) {
  EXPECT_THAT(whyNot(with("origin", "[0, 0, 0.3]")),
              AllOf(HasSubstr("map.yaml"), HasSubstr("turned by 0.3 rad"),
                    HasSubstr("turn the picture counter-clockwise")));
  EXPECT_THAT(whyNot(with("origin", "[0, 0, 3.14159265]")), HasSubstr("turned by 3.14159 rad"));
  EXPECT_THAT(whyNot(with("origin", "[0, 0, -0.0001]")), HasSubstr("turned by -0.0001 rad"));
}

TEST_F(MapServerFile, WhatIsWrongGetsASentenceWithTheKey) {
  const std::pair<std::string, std::string> wrong[] = {
      {"resolution", "0"},        {"resolution", "fine"}, {"resolution", ".nan"},
      {"resolution", "1e9"},      {"resolution", "1e-9"}, {"origin", "[1e300, 0, 0]"},
      {"resolution", "[1, 2]"},   {"origin", "[0, 0]"},   {"origin", "[.inf, 0, 0]"},
      {"negate", "perhaps"},      {"free_thresh", "0.9"}, {"occupied_thresh", "65"},
      {"free_thresh", "several"}, {"mode", "grey"}};
  for (const auto& [key, value] : wrong) {
    EXPECT_THAT(whyNot(with(key, value)),
                AllOf(HasSubstr("map.yaml, line "), HasSubstr("'" + key + "' of the map")))
        << value;
  }
  EXPECT_THAT(whyNot("image: map.pgm\n"), HasSubstr("'resolution' of the map is missing"));
  EXPECT_THAT(whyNot("kitchen: [0, 0, 0]\n"), HasSubstr("not a map_server map"));
  EXPECT_THAT(whyNot("image: [}\n"), HasSubstr("map.yaml, line 1: not YAML"));
  EXPECT_THAT(messageOf([&] { loadMapServer(folder_ / "none.yaml"); }),
              AllOf(HasSubstr("none.yaml"), HasSubstr("no such file")));
}

TEST_F(MapServerFile, AnImageThatWasElsewhereIsFoundBesideTheYaml) {
  EXPECT_EQ(load(with("image", "/home/robot/maps/map.pgm")).cells(), load(kYaml).cells());
  const std::string gone = whyNot(with("image", "/home/robot/maps/gone.pgm"));
  EXPECT_THAT(gone, AllOf(HasSubstr("map.yaml, line 1: 'image' of the map"),
                          HasSubstr("'/home/robot/maps/gone.pgm', which is not there, nor is '" +
                                    (folder_ / "gone.pgm").string() + "'")));
  folder_.write("maps/map.pgm", std::string("P5\n1 1\n255\n\x00", 12));
  EXPECT_EQ(load(with("image", "maps/map.pgm")).width(), 1) << "what is named comes first";
}

TEST_F(MapServerFile, ABadImageIsNamed) {
  const auto imageIs = [&](const std::string& name, const std::string& bytes) {
    folder_.write(name, bytes);
    return whyNot(with("image", name));
  };
  EXPECT_THAT(whyNot(with("image", "none.png")), HasSubstr("'none.png', which is not there"));
  EXPECT_THAT(imageIs("cut.pgm", "P5\n3 2\n255\n12345"), HasSubstr("cut.pgm: the image is trunc"));
  EXPECT_THAT(imageIs("head.pgm", "P5\n3"), HasSubstr("head.pgm: the image"));
  EXPECT_THAT(imageIs("white.pgm", "P5\n1 1\n100\n1"), HasSubstr("white.pgm: its white is 100"));
  EXPECT_THAT(imageIs("text.pgm", "P2\n1 1\n1000\n1"), HasSubstr("its white is 1000"));
  EXPECT_THAT(imageIs("huge.pgm", "P5\n99999999 99999999\n255\n1"), HasSubstr("truncated"));
  EXPECT_THAT(imageIs("vast.jpg", std::string("\xFF\xD8\xFF\xC0\0\x0B\x08\xFF\xFF\xFF\xFF", 11)),
              HasSubstr("vast.jpg: the image of 65535x65535 pixels asks for"));
  EXPECT_THAT(imageIs("empty.pgm", ""), HasSubstr("empty.pgm: the image is empty"));
  EXPECT_THAT(imageIs("text.png", "a letter"), HasSubstr("text.png: the image cannot be decoded"));
  cv::imwrite(folder_ / "whole.png", cv::Mat(40, 40, CV_8UC1, cv::Scalar(254)));
  std::string png = test::readText(folder_ / "whole.png");
  EXPECT_THAT(imageIs("cut.png", png.substr(0, png.size() - 5)),
              HasSubstr("cut.png: the image is"));
}

TEST_F(MapServerFile, APlainPictureIsAPlan) {
  cv::Mat picture(4, 5, CV_8UC3, cv::Scalar::all(255));
  picture.at<cv::Vec3b>(0, 0) = {0, 0, 0};
  picture.at<cv::Vec3b>(1, 1) = {128, 128, 128};
  cv::imwrite(folder_ / "plan.png", picture);
  const OccupancyGrid grid = gridFromImage(folder_ / "plan.png", 0.05);
  EXPECT_EQ(grid.at(GridCell{0, 3}), Occupancy::kOccupied);
  EXPECT_EQ(grid.at(GridCell{1, 2}), Occupancy::kUnknown);
  EXPECT_EQ(grid.at(GridCell{4, 0}), Occupancy::kFree);
  EXPECT_THROW(gridFromImage(folder_ / "plan.png", 0.0), std::invalid_argument);
}

TEST(RealMaps, ARoomAndAnOfficeAreRead) {
  HEEL_NEED_DATA("floor_maps");
  const auto folder = test::dataFolder() / "floor_maps";
  const auto wallsOf = [](const OccupancyGrid& grid) {
    return std::count(grid.cells().begin(), grid.cells().end(), Occupancy::kOccupied);
  };
  const OccupancyGrid room = loadMapServer(folder / "brsu-c069/map.yaml");
  EXPECT_EQ(room.width(), 576);
  EXPECT_EQ(room.height(), 544);
  EXPECT_GT(wallsOf(room), 1000);
  EXPECT_EQ(room.at(Eigen::Vector2d(-0.386, -0.149)), Occupancy::kFree) << "a pose to watch from";
  const OccupancyGrid office = loadMapServer(folder / "willow/willow-2010-02-18-0.10.yaml");
  EXPECT_EQ(office.width(), 566);
  EXPECT_GT(wallsOf(office), 500);
  EXPECT_GT(wallsOf(gridFromImage(folder / "lab_a_scan.png", 0.05)), 3000);
}

}  // namespace
}  // namespace heel
