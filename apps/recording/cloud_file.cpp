// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/cloud_file.hpp"

#include "apps/recording/ply_header.hpp"
#include "apps/recording/ply_writer.hpp"
#include "apps/recording/quiet_pcl.hpp"

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace heel {

namespace fs = std::filesystem;

namespace {

struct PcdHeader {
  pcl::PCLPointCloud2 layout;
  int data_type = 0;  ///< 0 ascii, 1 binary, 2 compressed.
  unsigned int data_start = 0;
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
  for (const char* axis : {"x", "y", "z"}) {
    const int field = pcl::getFieldIndex(layout, axis);
    if (field < 0) fail(file, "the cloud has no fields x, y and z");
    if (layout.fields[static_cast<std::size_t>(field)].datatype != pcl::PCLPointField::FLOAT32) {
      fail(file, std::string("the field ") + axis + " does not hold 32-bit floats");
    }
  }
  facts.fields.clear();
  facts.color_field.clear();
  for (const auto& field : layout.fields) {
    if (field.name == "_") continue;
    facts.fields += (facts.fields.empty() ? "" : " ") + field.name;
    if (field.name == "rgb" || field.name == "rgba") facts.color_field = field.name;
  }
  facts.width = layout.width;
  facts.height = layout.height;
  if (facts.points() == 0) fail(file, "the cloud is empty (0 points)");
}

/// PCL allocates what a header promises as it reads it: no more than the file can hold.
void checkPromise(const fs::path& file, std::istream& in) {
  constexpr std::size_t kMostOfAByte = 128;  // points, compressed
  std::size_t points = 0;
  std::string encoding;
  for (std::string line; encoding.empty() && std::getline(in, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "POINTS") words >> points;
    if (keyword == "DATA") words >> encoding;
  }
  in.clear();
  in.seekg(0);
  const std::size_t bytes = fs::file_size(file);
  if (points > bytes * (encoding == "binary_compressed" ? kMostOfAByte : 1)) {
    fail(file, "the cloud is truncated (its " + std::to_string(bytes) + " bytes have no room for " +
                   std::to_string(points) + " points)");
  }
}

/// Reads the header, and says what the cloud lacks.
PcdHeader readPcdHeader(const fs::path& file, CloudFacts& facts) {
  if (!fs::exists(file)) fail(file, "the cloud is missing");
  PcdHeader header;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  bool parsed = false;
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) fail(file, "the cloud cannot be read");
  checkPromise(file, in);
  try {
    pcl::PCDReader reader;
    parsed = reader.readHeader(in, header.layout, origin, orientation, version, header.data_type,
                               header.data_start) == 0;
  } catch (const std::exception&) {
    // A number in the header that is none, or more points than memory: the sentence below.
  }
  if (header.layout.fields.empty()) fail(file, "this is not a PCD file");
  facts.format = "PCD";
  facts.encoding = header.data_type == 0   ? CloudEncoding::kAscii
                   : header.data_type == 1 ? CloudEncoding::kBinary
                                           : CloudEncoding::kCompressed;
  takeLayout(file, header.layout, facts);
  if (!parsed) fail(file, "the PCD header is damaged");
  return header;
}

/// PCL maps the file and trusts its sizes; a shorter file would be read beyond its end.
void checkPcdSize(const fs::path& file, const PcdHeader& header) {
  const std::size_t points = std::size_t{header.layout.width} * header.layout.height;
  const std::size_t data_bytes = points * header.layout.point_step;
  const std::size_t file_bytes = fs::file_size(file);
  const auto checkEnd = [&](std::size_t end) {
    if (file_bytes < end) {
      fail(file, "the cloud is truncated (" + std::to_string(file_bytes) + " of " +
                     std::to_string(end) + " bytes)");
    }
  };
  if (header.data_type == 0) {
    // A digit and a blank (or the line's end, but the last) for each value.
    if (points > (file_bytes + 1 - header.data_start) / 2 / header.layout.fields.size()) {
      fail(file, "the cloud is truncated (its " + std::to_string(file_bytes) +
                     " bytes have no room for " + std::to_string(points) + " points)");
    }
  } else if (header.data_type == 1) {
    checkEnd(header.data_start + data_bytes);
  } else {
    checkEnd(header.data_start + 8);
    std::ifstream in(file, std::ios::binary);
    in.seekg(header.data_start);
    std::array<std::uint32_t, 2> sizes{};  // compressed, then uncompressed
    in.read(reinterpret_cast<char*>(sizes.data()), sizeof(sizes));
    checkEnd(header.data_start + 8 + sizes[0]);
    std::size_t named_bytes = 0;  // padding, named "_", is not stored
    for (const auto& field : header.layout.fields) {
      if (field.name == "_") continue;
      named_bytes +=
          points * field.count * static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
    }
    if (!in || sizes[1] < named_bytes) fail(file, "the compressed cloud is damaged");
  }
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
  const PcdHeader header = readPcdHeader(file, cloud.facts);
  checkPcdSize(file, header);
  if (header.data_type == 0) {
    std::size_t values = 0;
    for (const auto& field : header.layout.fields) values += field.count;
    checkAsciiData(file, cloud.facts, header.data_start, values);
  }
  int version = 0;
  bool whole = false;
  try {
    whole = pcl::PCDReader().read(file.string(), cloud.blob, cloud.origin, cloud.orientation,
                                  version) == 0;
  } catch (const std::exception&) {
    // The sentence below.
  }
  if (!whole) fail(file, "the cloud is damaged");
}

void readPlyData(const fs::path& file, CloudFile& cloud) {
  const PlyHeader header = readPlyHeader(file);
  cloud.facts.format = "PLY";
  cloud.facts.encoding = header.is_binary ? CloudEncoding::kBinary : CloudEncoding::kAscii;
  cloud.facts.width = header.vertices;
  cloud.facts.height = 1;
  if (header.vertices == 0) fail(file, "the cloud is empty (0 points)");
  checkPlySize(file, header);
  if (!header.is_binary && header.vertices_first) {
    checkAsciiData(file, cloud.facts, header.bytes, header.columns.size());
  }
  int version = 0;
  bool whole = false;
  try {
    whole = pcl::PLYReader().read(file.string(), cloud.blob, cloud.origin, cloud.orientation,
                                  version) == 0;
  } catch (const std::exception&) {
    // The sentence below.
  }
  const std::size_t points = std::size_t{cloud.blob.width} * cloud.blob.height;
  if (!whole || cloud.blob.data.size() < points * cloud.blob.point_step) {
    fail(file, "the cloud is damaged");
  }
  takeLayout(file, cloud.blob, cloud.facts);
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
  checkPcdSize(file, readPcdHeader(file, facts));
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

}  // namespace heel
