// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/pcd_file.hpp"

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string>

namespace heel {

namespace fs = std::filesystem;

namespace {

/// PCL's reader tells its reasons to the console; ours go to the caller instead.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_;
};

struct PcdHeader {
  pcl::PCLPointCloud2 layout;
  int data_type = 0;  ///< 0 ascii, 1 binary, 2 compressed.
  unsigned int data_start = 0;
};

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

/// Reads the header, and says what the cloud lacks.
PcdHeader readHeader(const fs::path& file) {
  if (!fs::exists(file)) fail(file, "the cloud is missing");
  PcdHeader header;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  bool parsed = false;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "the cloud cannot be read");
  try {
    pcl::PCDReader reader;
    parsed = reader.readHeader(in, header.layout, origin, orientation, version, header.data_type,
                               header.data_start) == 0;
  } catch (const std::exception&) {
    // A number in the header that is none, or more points than memory: the sentence below.
  }
  const auto has = [&](const char* field) { return pcl::getFieldIndex(header.layout, field) >= 0; };
  if (header.layout.fields.empty()) fail(file, "this is not a PCD file");
  if (!has("x") || !has("y") || !has("z")) fail(file, "the cloud has no fields x, y and z");
  for (const char* axis : {"x", "y", "z"}) {
    const auto field = static_cast<std::size_t>(pcl::getFieldIndex(header.layout, axis));
    if (header.layout.fields[field].datatype != pcl::PCLPointField::FLOAT32) {
      fail(file, std::string("the field ") + axis + " does not hold 32-bit floats");
    }
  }
  if (!has("rgb") && !has("rgba")) {
    fail(file, "the cloud has no colour (no field rgb or rgba)");
  }
  if (std::size_t{header.layout.width} * header.layout.height == 0) {
    fail(file, "the cloud is empty (0 points)");
  }
  if (!parsed) fail(file, "the PCD header is damaged");
  return header;
}

/// PCL maps the file and trusts its sizes; a shorter file would be read beyond its end.
void checkSize(const fs::path& file, const PcdHeader& header) {
  const std::size_t points = std::size_t{header.layout.width} * header.layout.height;
  const std::size_t data_bytes = points * header.layout.point_step;
  const std::size_t file_bytes = fs::file_size(file);
  const auto checkEnd = [&](std::size_t end) {
    if (file_bytes < end) {
      fail(file, "the cloud is truncated (" + std::to_string(file_bytes) + " of " +
                     std::to_string(end) + " bytes)");
    }
  };
  if (header.data_type == 1) {
    checkEnd(header.data_start + data_bytes);
  } else if (header.data_type == 2) {
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

}  // namespace

void checkPcd(const fs::path& file) {
  const QuietPcl quiet;
  checkSize(file, readHeader(file));
}

PcdFile readPcd(const fs::path& file) {
  const QuietPcl quiet;
  checkSize(file, readHeader(file));
  PcdFile pcd;
  bool whole = false;
  try {
    int version = 0;
    whole =
        pcl::PCDReader().read(file.string(), pcd.blob, pcd.origin, pcd.orientation, version) == 0;
    if (whole) pcl::fromPCLPointCloud2(pcd.blob, pcd.cloud);
  } catch (const std::exception&) {
    whole = false;
  }
  if (!whole) fail(file, "the cloud is damaged");
  if (std::none_of(pcd.cloud.begin(), pcd.cloud.end(),
                   [](const auto& p) { return pcl::isFinite(p); })) {
    fail(file, "all " + std::to_string(pcd.cloud.size()) + " points of the cloud are NaN");
  }
  return pcd;
}

void colorsOf(const ColorCloud& cloud, cv::Mat& image_bgr) {
  image_bgr.create(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_8UC3);
  std::transform(cloud.begin(), cloud.end(), image_bgr.begin<cv::Vec3b>(),
                 [](const auto& p) { return cv::Vec3b(p.b, p.g, p.r); });
}

void writePcd(const fs::path& file, const PcdFile& pcd) {
  const QuietPcl quiet;
  int result = -1;
  try {
    result = pcl::PCDWriter().writeBinaryCompressed(file.string(), pcd.blob, pcd.origin,
                                                    pcd.orientation);
  } catch (const std::exception&) {
    // The sentence below.
  }
  if (result != 0) fail(file, "the cloud cannot be written");
  checkSize(file, readHeader(file));
}

}  // namespace heel
