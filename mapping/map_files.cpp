// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/cloud/image_extent.hpp>
#include <heel/cloud/yaml_map.hpp>
#include <heel/mapping/map_files.hpp>

#include <octomap/OcTree.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace heel {

namespace {

namespace fs = std::filesystem;

// What map_saver writes. An unknown pixel is p = 0.19608: over the free_thresh of ROS 1, under that
// of Nav2.
constexpr std::uint8_t kFreePixel = 254, kOccupiedPixel = 0, kUnknownPixel = 205;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

/// OpenCV fills what is missing of a truncated picture with anything, and takes any white of a PGM
/// for 255 or 65535; find it before.
std::string wrongWith(const std::string& bytes) {
  const std::string truncated = "the image is truncated";
  if (bytes.rfind("\x89PNG", 0) == 0) {
    const bool ends = bytes.size() >= 20 && bytes.compare(bytes.size() - 8, 4, "IEND") == 0;
    return ends ? "" : truncated;
  }
  const bool is_text = bytes.rfind("P2", 0) == 0;
  if (!is_text && bytes.rfind("P5", 0) != 0) return "";
  std::size_t at = 2;
  long numbers[3] = {0, 0, 0};  // Width, height, white.
  for (long& number : numbers) {
    for (; at < bytes.size() &&
           (std::isspace(static_cast<unsigned char>(bytes[at])) != 0 || bytes[at] == '#');
         ++at) {
      if (bytes[at] == '#') at = std::min(bytes.find('\n', at), bytes.size() - 1);
    }
    for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && number < 1000000; ++at) {
      number = 10 * number + (bytes[at] - '0');
    }
  }
  const long white = numbers[2];
  const auto samples = static_cast<std::size_t>(numbers[0]) * static_cast<std::size_t>(numbers[1]);
  const std::size_t bytes_each = is_text ? 0 : white > 255 ? 2 : 1;
  if (white == 0 || bytes.size() < at + 1 + samples * bytes_each) return truncated;
  if (white == 255 || white == 65535) return "";
  return "its white is " + std::to_string(white) + ", and only 255 and 65535 can be read";
}

/// @param bytes_per_pixel  What the picture takes, and what is made of it.
cv::Mat readImage(const fs::path& file, cv::ImreadModes mode, std::size_t bytes_per_pixel) {
  const std::string bytes = readWholeFile(file);
  if (bytes.empty()) fail(file, "the image is empty (0 bytes)");
  if (const std::string wrong = wrongWith(bytes); !wrong.empty()) fail(file, wrong);
  checkImageMemory(file.string() + ": the image",
                   reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                   bytes_per_pixel);
  cv::Mat image;
  try {
    image = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), mode);
  } catch (const cv::Exception&) {
    // The sentence below says all that a reader can use.
  }
  if (image.empty()) fail(file, "the image cannot be decoded");
  return image;
}

/// 0 or 1, as map_saver writes it, or a word.
bool readFlag(YamlMap& map, const std::string& key) {
  const std::string value = map.text(key);
  return value == "1" || (value != "0" && map.flag(key));
}

Eigen::Vector2d readOrigin(YamlMap& map) {
  // A whole turn in six digits is none; it moves the far corner of a 200 m map by 2 mm.
  constexpr double kNoTurn_rad = 1e-5;
  const Eigen::Vector3d origin = map.point3("origin");
  if (std::abs(std::remainder(origin.z(), 2.0 * M_PI)) > kNoTurn_rad) {
    char reason[200];
    std::snprintf(reason, sizeof reason,
                  "is turned by %g rad, and only maps that are not turned can be read: turn the "
                  "picture counter-clockwise by that, and give its new lower left corner and yaw 0",
                  origin.z());
    map.fail("origin", reason);
  }
  return origin.head<2>();
}

/// The picture that a map names. Map savers write where it was, which a copied map takes along.
fs::path findImage(YamlMap& map, const fs::path& folder) {
  const fs::path named = map.text("image");
  const fs::path image = folder / named, beside = folder / named.filename();
  std::error_code ignored;
  if (fs::exists(image, ignored)) return image;
  if (fs::exists(beside, ignored)) return beside;
  map.fail("image", "is '" + named.string() + "', which is not there" +
                        (image == beside ? "" : ", nor is '" + beside.string() + "'"));
}

/// Whether a picture has no greys but what map savers write; white is what it is mended with.
bool isOfMapSaver(const cv::Mat& image) {
  return std::all_of(image.begin<std::uint8_t>(), image.end<std::uint8_t>(), [](auto grey) {
    return grey == kFreePixel || grey == kOccupiedPixel || grey == kUnknownPixel || grey == 255;
  });
}

/// Where a picture is not opaque; empty if it has no alpha channel.
cv::Mat transparentPixels(const fs::path& file) {
  constexpr std::size_t kBytesPerPixel = 14;  // four channels of 16 bits, alpha, mask, grey, cell
  const cv::Mat image = readImage(file, cv::IMREAD_UNCHANGED, kBytesPerPixel);
  if (image.channels() != 4) return {};
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  return alpha < (alpha.depth() == CV_16U ? 65535 : 255);
}

/// Where a picture says nothing, whatever its thresholds; empty: nowhere.
cv::Mat unknownPixels(const fs::path& file, const cv::Mat& image, const MapImageParams& params) {
  constexpr int kMostPercent = 100;
  if (params.mode == MapImageMode::kRaw) return image > kMostPercent;
  if (params.mode == MapImageMode::kScale) return transparentPixels(file);
  return !params.negate && isOfMapSaver(image) ? cv::Mat(image == kUnknownPixel) : cv::Mat();
}

/// How occupied a pixel is: 0 to 1.
double occupancyOf(std::uint8_t grey, const MapImageParams& params) {
  if (params.mode == MapImageMode::kRaw) return grey / 100.0;
  return (params.negate ? grey : 255 - grey) / 255.0;
}

}  // namespace

OccupancyGrid gridFromImage(const fs::path& file, double cell_size_m,
                            const MapImageParams& params) {
  if (!(params.free_thresh >= 0.0 && params.free_thresh <= params.occupied_thresh &&
        params.occupied_thresh <= 1.0)) {
    throw std::invalid_argument("a map's thresholds must be 0 <= free <= occupied <= 1");
  }
  if (!(cell_size_m > 0.0)) throw std::invalid_argument("a pixel's edge must be positive");
  constexpr std::size_t kBytesPerPixel = 3;  // the picture's, the mask's, the cell's
  const cv::Mat image = readImage(file, cv::IMREAD_GRAYSCALE, kBytesPerPixel);
  const cv::Mat unknown = unknownPixels(file, image, params);
  OccupancyGrid grid(params.origin_m, cell_size_m, image.cols, image.rows, Occupancy::kUnknown);
  for (int y = 0; y < grid.height(); ++y) {
    const int v = grid.height() - 1 - y;
    for (int x = 0; x < grid.width(); ++x) {
      if (!unknown.empty() && unknown.at<std::uint8_t>(v, x) != 0) continue;
      const double p = occupancyOf(image.at<std::uint8_t>(v, x), params);
      if (p > params.occupied_thresh) grid.at(GridCell{x, y}) = Occupancy::kOccupied;
      if (p < params.free_thresh) grid.at(GridCell{x, y}) = Occupancy::kFree;
    }
  }
  return grid;
}

OccupancyGrid loadMapServer(const fs::path& yaml) {
  YamlMap map = YamlMap::fromFile(yaml, "map");
  if (!map.has("image")) fail(yaml, "it is not a map_server map: it has no key 'image'");
  MapImageParams params;
  const double cell_size_m = map.number("resolution");
  if (!isCellSize(cell_size_m)) map.fail("resolution", "is not from 0.0001 to 100 m");
  params.origin_m = readOrigin(map);
  if (map.has("negate")) params.negate = readFlag(map, "negate");
  params.occupied_thresh = map.number("occupied_thresh", params.occupied_thresh, kShare);
  params.free_thresh = map.number("free_thresh", params.free_thresh, kShare);
  if (params.free_thresh > params.occupied_thresh) {
    map.fail("free_thresh", "is over 'occupied_thresh'");
  }
  params.mode = static_cast<MapImageMode>(map.choice("mode", {"trinary", "scale", "raw"}, 0));
  return gridFromImage(findImage(map, yaml.parent_path()), cell_size_m, params);
}

bool isMapServerFile(const fs::path& file) {
  try {
    return YamlMap::fromFile(file, "map").has("image");
  } catch (const std::runtime_error&) {
    return false;
  }
}

void saveMapServer(const OccupancyGrid& grid, const fs::path& yaml) {
  if (grid.empty()) throw std::invalid_argument("saveMapServer: the grid is empty");
  std::string image =
      "P5\n" + std::to_string(grid.width()) + " " + std::to_string(grid.height()) + "\n255\n";
  for (int y = grid.height() - 1; y >= 0; --y) {
    for (int x = 0; x < grid.width(); ++x) {
      const Occupancy cell = grid.at(GridCell{x, y});
      image += static_cast<char>(cell == Occupancy::kFree       ? kFreePixel
                                 : cell == Occupancy::kOccupied ? kOccupiedPixel
                                                                : kUnknownPixel);
    }
  }
  fs::path image_file = yaml;
  image_file.replace_extension(".pgm");
  char text[512];
  std::snprintf(text, sizeof text,
                "resolution: %.17g\norigin: [%.17g, %.17g, 0]\nnegate: 0\n"
                "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n",
                grid.cell_size_m(), grid.origin_m().x(), grid.origin_m().y());
  writeWholeFile(image_file, image);
  YAML::Emitter name;
  name << image_file.filename().string();
  writeWholeFile(yaml, std::string("image: ") + name.c_str() + "\n" + text);
}

namespace {

constexpr std::string_view kFirstLine = "# Octomap OcTree binary file";
constexpr int kDepth = 16;

/// Walks the nodes of a tree as they are stored: of each inner node two bytes, two bits for each of
/// its eight children (0 unknown, 1 free, 2 occupied, 3 inner), and then its inner children.
class NodeWalk {
 public:
  explicit NodeWalk(std::string_view bytes) : bytes_(bytes) {}

  /// What is wrong with the nodes below one at `depth`; null if nothing is.
  const char* walk(int depth) {
    if (depth >= kDepth) return "its tree is deeper than a tree can be";
    if (at_ + 2 > bytes_.size()) return "it is truncated";
    const auto low = static_cast<unsigned char>(bytes_[at_]);
    const auto high = static_cast<unsigned char>(bytes_[at_ + 1]);
    const unsigned children = low | static_cast<unsigned>(high) << 8U;
    at_ += 2;
    for (unsigned child = 0; child < 8; ++child) {
      const unsigned kind = (children >> (2U * child)) & 3U;
      if (kind == 0) continue;
      ++nodes_;
      if (kind != 3) continue;
      if (const char* wrong = walk(depth + 1)) return wrong;
    }
    return nullptr;
  }

  std::size_t nodes() const { return nodes_; }
  bool isAtEnd() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t nodes_ = 1;  // The root.
};

struct Header {
  std::size_t nodes = 0;
  double cell_size_m = 0.0;
  std::size_t end = 0;  ///< Where the nodes begin.
};

[[noreturn]] void failMap(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

Header readHeader(const std::filesystem::path& file, const std::string& bytes) {
  if (bytes.compare(0, kFirstLine.size(), kFirstLine) != 0) {
    failMap(file, "it is not a wall map: it does not begin with '" + std::string(kFirstLine) + "'");
  }
  std::istringstream lines(bytes.substr(0, 4096));
  Header header;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, id;
    words >> key;
    if (key == "id" && (!(words >> id) || id != "OcTree")) {
      failMap(file, "it holds a tree of another kind, '" + id + "'");
    }
    if (key == "size" && !(words >> header.nodes)) failMap(file, "its 'size' is not a number");
    if (key == "res") words >> header.cell_size_m;
    if (key != "data") continue;
    if (!isCellSize(header.cell_size_m)) failMap(file, "its 'res' is not from 0.0001 to 100 m");
    if (lines.eof()) break;
    header.end = static_cast<std::size_t>(lines.tellg());
    return header;
  }
  failMap(file, "it is truncated: its header has no end");
}

}  // namespace

// OctoMap's writeBinaryConst and readBinary print to the console; what they call does not.
void saveWallMap(const WallMap& map, const std::filesystem::path& file) {
  const octomap::OcTree& tree = *map.tree();
  std::ostringstream out(std::ios::binary);
  out.precision(15);
  out << kFirstLine << "\nid OcTree\nsize " << tree.size() << "\nres " << tree.getResolution()
      << "\ndata\n";
  if (tree.getRoot() != nullptr) tree.writeBinaryNode(out, tree.getRoot());
  if (!out) throw std::runtime_error(file.string() + " cannot be written: the map is too large");
  writeWholeFile(file, out.str());
}

WallMap loadWallMap(const std::filesystem::path& file) {
  const std::string bytes = readWholeFile(file);
  const Header header = readHeader(file, bytes);
  auto tree = std::make_shared<octomap::OcTree>(header.cell_size_m);
  if (header.nodes == 0) return WallMap(tree);
  const std::string nodes = bytes.substr(header.end);
  NodeWalk walk(nodes);
  if (const char* wrong = walk.walk(0)) failMap(file, wrong);
  if (walk.nodes() != header.nodes) {
    failMap(file, "it says that it has " + std::to_string(header.nodes) + " nodes, but has " +
                      std::to_string(walk.nodes()));
  }
  if (!walk.isAtEnd()) failMap(file, "it goes on after the end of its tree");
  std::istringstream in(nodes, std::ios::binary);
  tree->readBinaryData(in);
  WallMap map(tree);
  checkMemory(file.string() + ": the floor that the map spans", map.floorBytes(), bytes.size());
  return map;
}

}  // namespace heel
