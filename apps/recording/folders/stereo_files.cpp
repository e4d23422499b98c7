// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/folders/indexed_recording.hpp>
#include <heel/apps/recording/folders/stereo_files.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/apps/recording/stamps.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

namespace {

using Paths = std::vector<fs::path>;

/// The images of one side; where none are found, `where` says where they should be.
struct Side {
  Paths images;
  std::string where;
  std::size_t prefix = 0;  ///< Letters of the names that only tell the side.
};

struct Sides {
  Side left, right;
  bool areThere() const { return !left.images.empty() || !right.images.empty(); }
};

Side sideInFolder(const fs::path& folder) {
  Side side;
  side.images = filesIn(folder, isImageName);
  if (side.images.empty()) side.images = filesIn(folder / "data", isImageName);
  side.where = folder.string();
  return side;
}

Side sideNamed(const fs::path& folder, const std::string& prefix) {
  Side side;
  side.images = filesIn(folder, [&](const fs::path& file) {
    return isImageName(file) && file.filename().native().rfind(prefix, 0) == 0;
  });
  side.where = (folder / (prefix + "*.png")).string();
  side.prefix = prefix.size();
  return side;
}

/// The first known layout of which there is anything.
Sides findSides(const fs::path& folder) {
  using Names = std::pair<const char*, const char*>;
  for (const auto& [left, right] : {Names("left", "right"), Names("image_0", "image_1"),
                                    Names("image_2", "image_3"), Names("cam0", "cam1")}) {
    Sides sides{sideInFolder(folder / left), sideInFolder(folder / right)};
    if (sides.areThere()) return sides;
  }
  for (const auto& [left, right] : {Names("left", "right"), Names("im0", "im1")}) {
    Sides sides{sideNamed(folder, left), sideNamed(folder, right)};
    if (sides.areThere()) return sides;
  }
  return {};
}

/// Pairs by what the names have beside the side; in the order of these names.
std::vector<StereoPair> pairByName(const Sides& sides) {
  struct ByNumber {
    bool operator()(const std::string& a, const std::string& b) const {
      return isBeforeByNumber(a, b);
    }
  };
  std::map<std::string, StereoPair, ByNumber> pairs;
  for (const auto& file : sides.left.images) {
    pairs[file.stem().native().substr(sides.left.prefix)].left = file;
  }
  for (const auto& file : sides.right.images) {
    pairs[file.stem().native().substr(sides.right.prefix)].right = file;
  }
  std::vector<StereoPair> list;
  list.reserve(pairs.size());
  for (auto& [name, pair] : pairs) list.push_back(std::move(pair));
  return list;
}

/// Pairs each left image with the right one that is nearest in time.
std::vector<StereoPair> pairByTime(const std::vector<StampedFile>& left,
                                   const std::vector<StampedFile>& right, double limit_s) {
  const auto nearest = nearestInTime(left, right, limit_s);
  std::vector<StereoPair> pairs;
  for (std::size_t i = 0; i < left.size(); ++i) {
    pairs.push_back({left[i].path, nearest[i] ? right[*nearest[i]].path : fs::path()});
  }
  return pairs;
}

/// The files with the times in their names; none if a name tells no time.
std::vector<StampedFile> stampedByName(const Paths& files) {
  std::vector<StampedFile> stamped;
  for (const auto& file : files) {
    const auto stamp_s = stampOfName(file);
    if (!stamp_s) return {};
    stamped.push_back({*stamp_s, file});
  }
  return stamped;
}

std::vector<StereoPair> pairUp(const Sides& sides, const fs::path& folder, double limit_s) {
  auto pairs = pairByName(sides);
  const bool have_common = std::any_of(pairs.begin(), pairs.end(), [](const StereoPair& pair) {
    return !pair.left.empty() && !pair.right.empty();
  });
  if (have_common) return pairs;

  const auto left = stampedByName(sides.left.images), right = stampedByName(sides.right.images);
  if (!left.empty() && !right.empty()) return pairByTime(left, right, limit_s);

  const std::size_t n_left = sides.left.images.size(), n_right = sides.right.images.size();
  if (n_left != n_right) {
    throw std::runtime_error(folder.string() + ": the left and right images (" +
                             std::to_string(n_left) + " and " + std::to_string(n_right) +
                             ") can't be paired, neither by name nor by number");
  }
  pairs.clear();
  for (std::size_t i = 0; i < n_left; ++i) {
    pairs.push_back({sides.left.images[i], sides.right.images[i]});
  }
  return pairs;
}

}  // namespace

bool hasStereoImages(const fs::path& folder) { return findSides(folder).areThere(); }

StereoFiles findStereoFiles(const fs::path& folder, double rate_hz, double max_stamp_difference_s) {
  StereoFiles files;
  if (fs::exists(folder / "left.txt") && fs::exists(folder / "right.txt")) {
    const auto left = readStampedFiles(folder / "left.txt");
    files.pairs = pairByTime(left, readStampedFiles(folder / "right.txt"), max_stamp_difference_s);
    for (const auto& file : left) files.stamps_s.push_back(file.stamp_s);
    return files;
  }
  const Sides sides = findSides(folder);
  for (const Side& side : {sides.left, sides.right}) {
    if (side.images.empty()) throw std::runtime_error(side.where + ": there are no images");
  }
  files.pairs = pairUp(sides, folder, max_stamp_difference_s);
  Paths names;
  for (const auto& pair : files.pairs) names.push_back(pair.left.empty() ? pair.right : pair.left);
  files.stamps_s = stampsOfFiles(folder / "times.txt", names, rate_hz, files.nominal_stamps);
  return files;
}

}  // namespace heel
