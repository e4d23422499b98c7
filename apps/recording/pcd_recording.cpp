// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/pcd_recording.hpp"

#include "apps/recording/camera_file.hpp"
#include "apps/recording/cloud_camera.hpp"
#include "apps/recording/folder_files.hpp"
#include "apps/recording/stamps.hpp"

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <utility>

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

/// The organized cloud's colours as an image.
void toImage(const ColorCloud& cloud, cv::Mat& image_bgr) {
  image_bgr.create(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_8UC3);
  std::transform(cloud.begin(), cloud.end(), image_bgr.begin<cv::Vec3b>(),
                 [](const auto& p) { return cv::Vec3b(p.b, p.g, p.r); });
}

bool isPcdName(const fs::path& file) { return file.extension() == ".pcd"; }

}  // namespace

void readColorCloud(const fs::path& file, ColorCloud& cloud) {
  const QuietPcl quiet;
  checkSize(file, readHeader(file));
  bool whole = false;
  try {
    pcl::PCLPointCloud2 blob;
    whole = pcl::PCDReader().read(file.string(), blob) == 0;
    if (whole) pcl::fromPCLPointCloud2(blob, cloud);
  } catch (const std::exception&) {
    whole = false;
  }
  if (!whole) fail(file, "the cloud is damaged");
  if (std::none_of(cloud.begin(), cloud.end(), [](const auto& p) { return pcl::isFinite(p); })) {
    fail(file, "all " + std::to_string(cloud.size()) + " points of the cloud are NaN");
  }
}

bool PcdRecording::fits(const fs::path& path) {
  return fs::is_directory(path) ? !filesIn(path, isPcdName).empty() : isPcdName(path);
}

std::unique_ptr<Recording> PcdRecording::open(const fs::path& path, const RecordingParams& params) {
  RecordingInfo info;
  info.layout = kLayout;
  info.sensor = SensorKind::kCloud;
  if (!fs::is_directory(path)) {
    const QuietPcl quiet;
    readHeader(path);  // one file that is of no use is an error at once
    info.nominal_stamps = true;
    return std::unique_ptr<Recording>(new PcdRecording(path, std::move(info), {0.0}, {path}));
  }

  double rate_hz = params.nominal_rate_hz;
  if (fs::exists(path / "camera.yaml")) {
    const CameraFile camera = readCameraFile(path / "camera.yaml");
    if (camera.camera) info.camera.left = *camera.camera;
    if (camera.rate_hz) rate_hz = *camera.rate_hz;
    info.T_base_camera = camera.T_ground_camera;
  }
  auto files = filesIn(path, isPcdName);
  auto stamps_s = stampsOfFiles(path / "times.txt", files, rate_hz, info.nominal_stamps);
  return std::unique_ptr<Recording>(
      new PcdRecording(path, std::move(info), std::move(stamps_s), std::move(files)));
}

PcdRecording::PcdRecording(const std::filesystem::path& path, RecordingInfo info,
                           std::vector<double> stamps_s, std::vector<fs::path> files)
    : IndexedRecording(path, std::move(info), std::move(stamps_s)), files_(std::move(files)) {
  if (info_.camera.left.width == 0) findCamera();
}

void PcdRecording::findCamera() {
  ColorCloud cloud;
  for (const auto& file : files_) {
    try {
      readColorCloud(file, cloud);
    } catch (const std::runtime_error&) {
      continue;  // the frame is left out later, with its reason
    }
    info_.camera.left = cameraOfCloud(cloud).value_or(PinholeCamera{});
    return;
  }
}

std::string PcdRecording::frameName(std::size_t index) const { return files_[index].string(); }

void PcdRecording::read(std::size_t index, Frame& frame) {
  frame.right_bgr.release();
  frame.depth_m.release();
  frame.cloud.reset();
  // The memory of the last frame's cloud is used again, unless the caller has kept that cloud.
  if (cloud_.use_count() != 1) cloud_ = pcl::make_shared<ColorCloud>();
  readColorCloud(files_[index], *cloud_);
  if (cloud_->isOrganized()) {
    toImage(*cloud_, frame.image_bgr);
  } else {
    frame.image_bgr.release();
  }
  frame.cloud = cloud_;
}

}  // namespace heel
