// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/image_extent.hpp>
#include <heel/cloud/whole_file.hpp>
#include <heel/mapping/map_server_file.hpp>

#include <opencv2/core/mat.hpp>
#include <opencv2/imgcodecs.hpp>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {
namespace {

namespace fs = std::filesystem;

// What map_saver writes. An unknown pixel is p = 0.19608, just over free_thresh.
constexpr std::uint8_t kFreePixel = 254, kOccupiedPixel = 0, kUnknownPixel = 205;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

/// OpenCV fills what is missing of a truncated picture with anything; find it before.
bool isTruncated(const std::string& bytes) {
  if (bytes.rfind("\x89PNG", 0) == 0) {
    return bytes.size() < 20 || bytes.compare(bytes.size() - 8, 4, "IEND") != 0;
  }
  if (bytes.rfind("P5", 0) != 0) return false;
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
  const auto samples = static_cast<std::size_t>(numbers[0]) * static_cast<std::size_t>(numbers[1]);
  return bytes.size() < at + 1 + samples * (numbers[2] > 255 ? 2U : 1U);
}

cv::Mat readImage(const fs::path& file) {
  const std::string bytes = readWholeFile(file);
  if (bytes.empty()) fail(file, "the image is empty (0 bytes)");
  if (isTruncated(bytes)) fail(file, "the image is truncated");
  constexpr std::size_t kBytesPerPixel = 2;  // the picture's, and then the cell's
  checkImageMemory(file.string() + ": the image",
                   reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                   kBytesPerPixel);
  cv::Mat image;
  try {
    image = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    // The sentence below says all that a reader can use.
  }
  if (image.empty()) fail(file, "the image cannot be decoded");
  return image;
}

/// Reads the keys of a map_server YAML file, each error one sentence.
class MapYaml {
 public:
  explicit MapYaml(fs::path file) : file_(std::move(file)) {
    try {
      root_ = YAML::Load(readWholeFile(file_));
    } catch (const YAML::Exception& error) {
      fail(file_, "it is not YAML: line " + std::to_string(error.mark.line + 1) + ", " + error.msg);
    }
    if (!root_.IsMap() || !root_["image"]) {
      fail(file_, "it is not a map_server map: it has no key 'image'");
    }
  }

  bool has(const char* key) const { return static_cast<bool>(root_[key]); }
  std::string text(const char* key) const { return as<std::string>(root_[key], key, "a text"); }
  double number(const char* key) const { return finite(root_[key], key); }

  bool flag(const char* key) const {
    const std::string value = text(key);
    if (value == "0" || value == "false") return false;
    if (value == "1" || value == "true") return true;
    fail(file_, std::string("'") + key + "' is not 0 or 1");
  }

  Eigen::Vector2d origin() const {
    const YAML::Node node = root_["origin"];
    if (!node || !node.IsSequence() || node.size() != 3) {
      fail(file_, "'origin' is not a list of x, y and yaw");
    }
    const double yaw_rad = finite(node[2], "origin");
    if (yaw_rad != 0.0) {
      char yaw[32];
      std::snprintf(yaw, sizeof yaw, "%g", yaw_rad);
      fail(file_, std::string("its origin is turned by ") + yaw +
                      " rad, and only maps that are not turned can be read");
    }
    return {finite(node[0], "origin"), finite(node[1], "origin")};
  }

  double share(const char* key) const {
    const double value = number(key);
    if (value < 0.0 || value > 1.0) fail(file_, std::string("'") + key + "' is not within 0 and 1");
    return value;
  }

 private:
  template <typename T>
  T as(const YAML::Node& node, const char* key, const char* what) const {
    if (!node) fail(file_, std::string("it has no key '") + key + "'");
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      fail(file_, std::string("'") + key + "' is not " + what);
    }
  }
  double finite(const YAML::Node& node, const char* key) const {
    const auto value = as<double>(node, key, "a number");
    if (!std::isfinite(value)) fail(file_, std::string("'") + key + "' is not a finite number");
    return value;
  }

  fs::path file_;
  YAML::Node root_;
};

}  // namespace

OccupancyGrid gridFromImage(const fs::path& file, double cell_size_m,
                            const MapImageParams& params) {
  if (!(params.free_thresh >= 0.0 && params.free_thresh <= params.occupied_thresh &&
        params.occupied_thresh <= 1.0)) {
    throw std::invalid_argument("a map's thresholds must be 0 <= free <= occupied <= 1");
  }
  if (!(cell_size_m > 0.0)) throw std::invalid_argument("a pixel's edge must be positive");
  const cv::Mat image = readImage(file);
  OccupancyGrid grid(params.origin_m, cell_size_m, image.cols, image.rows);
  for (int y = 0; y < grid.height(); ++y) {
    const auto* row = image.ptr<std::uint8_t>(grid.height() - 1 - y);
    for (int x = 0; x < grid.width(); ++x) {
      const double p = (params.negate ? row[x] : 255 - row[x]) / 255.0;
      grid.at(GridCell{x, y}) = p > params.occupied_thresh ? Occupancy::kOccupied
                                : p < params.free_thresh   ? Occupancy::kFree
                                                           : Occupancy::kUnknown;
    }
  }
  return grid;
}

OccupancyGrid loadMapServer(const fs::path& yaml) {
  const MapYaml map(yaml);
  MapImageParams params;
  const double cell_size_m = map.number("resolution");
  if (!isCellSize(cell_size_m)) fail(yaml, "'resolution' is not from 0.0001 to 100 m");
  params.origin_m = map.origin();
  constexpr double kFurthest_m = 1e6;
  if (params.origin_m.cwiseAbs().maxCoeff() > kFurthest_m) fail(yaml, "'origin' is too far away");
  if (map.has("negate")) params.negate = map.flag("negate");
  if (map.has("occupied_thresh")) params.occupied_thresh = map.share("occupied_thresh");
  if (map.has("free_thresh")) params.free_thresh = map.share("free_thresh");
  if (params.free_thresh > params.occupied_thresh) {
    fail(yaml, "'free_thresh' is over 'occupied_thresh'");
  }
  if (map.has("mode") && map.text("mode") != "trinary") {
    fail(yaml, "its mode is '" + map.text("mode") + "', and only 'trinary' can be read");
  }
  return gridFromImage(yaml.parent_path() / map.text("image"), cell_size_m, params);
}

bool isMapServerFile(const fs::path& file) {
  try {
    const YAML::Node root = YAML::Load(readWholeFile(file));
    return root.IsMap() && root["image"];
  } catch (const std::exception&) {
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

}  // namespace heel
