// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/cloud_file.hpp>
#include <heel/apps/recording/clouds/cloud_places.hpp>
#include <heel/apps/recording/clouds/pcd_file.hpp>
#include <heel/apps/recording/clouds/ply_file.hpp>
#include <heel/apps/recording/folders/indexed_recording.hpp>

#include <glob.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

namespace heel {

namespace fs = std::filesystem;

namespace {

/// PCL's readers tell their reasons to the console; ours go to the caller instead. Where PCL is
/// silent already, nothing is changed, so that threads can share the silence.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) { set(pcl::console::L_ALWAYS); }
  ~QuietPcl() { set(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  void set(pcl::console::VERBOSITY_LEVEL level) const {
    if (before_ != pcl::console::L_ALWAYS) pcl::console::setVerbosityLevel(level);
  }

  pcl::console::VERBOSITY_LEVEL before_;
};

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

bool endsIn(const fs::path& file, const std::string& ending) {
  std::string own = file.extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return own == ending;
}

/// What layout a cloud's fields have; fails if it lacks places or points.
void takeLayout(const fs::path& file, const pcl::PCLPointCloud2& layout, CloudFacts& facts) {
  const std::string wrong = wrongWithPlaces(layout);
  if (!wrong.empty()) fail(file, wrong);
  facts.fields.clear();
  facts.color_field.clear();
  for (const auto& field : layout.fields) {
    if (field.name == "_") continue;
    facts.fields += (facts.fields.empty() ? "" : " ") + field.name;
    const bool is_color = field.name == "rgb" || field.name == "rgba";
    if (is_color && pcl::getFieldSize(field.datatype) == 4) facts.color_field = field.name;
  }
  facts.width = layout.width;
  facts.height = layout.height;
  if (facts.points() == 0) fail(file, "the cloud is empty (0 points)");
}

/// Reads the header, and says what the cloud lacks.
PcdHeader readPcdFacts(const fs::path& file, CloudFacts& facts) {
  PcdHeader header = readPcdHeader(file);
  facts.format = "PCD";
  facts.encoding = header.encoding;
  takeLayout(file, header.layout, facts);
  checkPcdSize(file, header);
  return header;
}

/// Looks for lines of ascii data with too few values: PCL would make up the missing.
void checkAsciiData(const fs::path& file, const CloudFacts& facts, std::size_t data_start,
                    std::size_t values) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(data_start));
  std::size_t points = 0;
  for (std::string line; points < facts.points() && std::getline(in, line);) {
    std::size_t found = 0;
    bool in_value = false;
    for (const char c : line) {
      const bool is_blank = c == ' ' || c == '\t' || c == '\r';
      if (!is_blank && !in_value) ++found;
      in_value = !is_blank;
    }
    if (found == 0) continue;
    if (found < values && !in.eof()) {
      fail(file, "point " + std::to_string(points + 1) + " of the cloud has " +
                     std::to_string(found) + " values for " + std::to_string(values) + " fields");
    }
    if (found >= values) ++points;
  }
  if (points < facts.points()) {
    fail(file, "the cloud is truncated (" + std::to_string(points) + " of " +
                   std::to_string(facts.points()) + " points)");
  }
}

void readPcdData(const fs::path& file, CloudFile& cloud) {
  const PcdHeader header = readPcdFacts(file, cloud.facts);
  cloud.origin = header.origin;
  cloud.orientation = header.orientation;
  if (header.encoding == CloudEncoding::kAscii) {
    checkAsciiData(file, cloud.facts, header.data_start, header.values);
  }
  if (!readPcdPoints(file, header, cloud.blob)) fail(file, "the cloud is damaged");
  makePlacesShort(cloud.blob);
}

void readPlyData(const fs::path& file, CloudFile& cloud) {
  const PlyHeader header = readPlyHeader(file);
  cloud.facts.format = "PLY";
  cloud.facts.encoding = header.is_binary ? CloudEncoding::kBinary : CloudEncoding::kAscii;
  cloud.blob = plyLayout(file, header);
  takeLayout(file, cloud.blob, cloud.facts);
  readPlyPoints(file, header, cloud);
  cloud.facts.width = cloud.blob.width;
  cloud.facts.height = cloud.blob.height;
}

}  // namespace

const char* toText(CloudEncoding encoding) {
  switch (encoding) {
    case CloudEncoding::kAscii:
      return "ascii";
    case CloudEncoding::kBinary:
      return "binary";
    case CloudEncoding::kCompressed:
      return "binary_compressed";
  }
  return "unknown";
}

bool isCloudName(const fs::path& file) { return endsIn(file, ".pcd") || endsIn(file, ".ply"); }

CloudFile readCloud(const fs::path& file) {
  const QuietPcl quiet;
  CloudFile cloud;
  if (endsIn(file, ".ply")) {
    readPlyData(file, cloud);
  } else {
    readPcdData(file, cloud);
  }
  pcl::fromPCLPointCloud2(cloud.blob, cloud.cloud);
  cloud.facts.finite_points = static_cast<std::size_t>(std::count_if(
      cloud.cloud.begin(), cloud.cloud.end(), [](const auto& p) { return pcl::isFinite(p); }));
  if (cloud.facts.finite_points == 0) {
    fail(file, "all " + std::to_string(cloud.cloud.size()) + " points of the cloud are NaN");
  }
  return cloud;
}

void needColors(const fs::path& file, const CloudFacts& facts) {
  if (facts.color_field.empty()) fail(file, "the cloud has no colour (no field rgb or rgba)");
}

CloudFacts checkPcdFile(const fs::path& file) {
  const QuietPcl quiet;
  CloudFacts facts;
  readPcdFacts(file, facts);
  return facts;
}

void writeCloud(const fs::path& file, const CloudFile& cloud) {
  if (endsIn(file, ".ply")) return writePly(file, cloud.blob);
  const QuietPcl quiet;
  int result = -1;
  // To a stream: PCL maps a file into memory, and a full disk would then be a SIGBUS.
  std::ofstream out(file, std::ios::binary);
  try {
    result =
        pcl::PCDWriter().writeBinaryCompressed(out, cloud.blob, cloud.origin, cloud.orientation);
  } catch (const std::exception&) {
    // The sentence below.
  }
  out.close();
  if (result != 0 || !out) fail(file, "the cloud cannot be written");
}

namespace {

std::vector<fs::path> matching(const std::string& pattern) {
  glob_t found{};
  const int error = glob(pattern.c_str(), 0, nullptr, &found);
  const std::unique_ptr<glob_t, void (*)(glob_t*)> freed(&found, globfree);
  std::vector<fs::path> files;
  if (error == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  files.erase(std::remove_if(files.begin(), files.end(),
                             [](const fs::path& file) {
                               return !isCloudName(file) || fs::is_directory(file);
                             }),
              files.end());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return isBeforeByNumber(a.native(), b.native());
  });
  if (files.empty()) throw std::runtime_error(pattern + ": no PCD or PLY file fits this pattern");
  return files;
}

std::vector<fs::path> cloudsOf(const std::string& name) {
  if (isPattern(name)) return matching(name);
  if (fs::is_directory(name)) {
    auto files = filesIn(name, isCloudName);
    if (files.empty()) throw std::runtime_error(name + ": the folder holds no PCD or PLY file");
    return files;
  }
  if (!isCloudName(name)) {
    throw std::runtime_error(name + ": the name of a cloud ends in .pcd or .ply");
  }
  return {name};
}

}  // namespace

bool isPattern(const std::string& name) {
  return name.find_first_of("*?[") != std::string::npos && !fs::exists(name);
}

std::vector<fs::path> findClouds(const std::vector<std::string>& names) {
  std::vector<fs::path> clouds;
  std::set<fs::path> known;
  for (const std::string& name : names) {
    for (fs::path& file : cloudsOf(name)) {
      if (known.insert(fs::absolute(file).lexically_normal()).second)
        clouds.push_back(std::move(file));
    }
  }
  return clouds;
}

}  // namespace heel
