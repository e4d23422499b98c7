// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/file_limits.hpp>
#include <heel/cloud/whole_file.hpp>
#include <heel/mapping/wall_map_file.hpp>

#include <octomap/OcTree.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace heel {
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
