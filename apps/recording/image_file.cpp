// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/image_file.hpp>
#include <heel/cloud/files.hpp>
#include <heel/cloud/image_extent.hpp>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace heel {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngStart = {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};

/// A PNG is a list of chunks: length, type, data, check sum; the last is of type IEND.
bool isCompletePng(const Bytes& bytes) {
  std::size_t at = kPngStart.size();
  while (at + 12 <= bytes.size()) {
    const std::size_t length = (std::size_t{bytes[at]} << 24U) |
                               (std::size_t{bytes[at + 1]} << 16U) |
                               (std::size_t{bytes[at + 2]} << 8U) | bytes[at + 3];
    const bool is_end = std::memcmp(&bytes[at + 4], "IEND", 4) == 0;
    at += 12 + length;
    if (is_end) return at <= bytes.size();
  }
  return false;
}

/// A JPEG is a list of segments FF xx length data; after a "start of scan" (DA) come coded bytes,
/// in which FF is followed by 00 or a restart marker (D0 to D7). The last marker is D9. Walking
/// the segments, we do not take the end of an embedded thumbnail for the end of the image.
bool isCompleteJpeg(const Bytes& bytes) {
  std::size_t at = 2;
  while (at + 2 <= bytes.size()) {
    if (bytes[at] != 0xFF) {  // coded bytes, or padding
      const auto* next =
          static_cast<const std::uint8_t*>(std::memchr(&bytes[at], 0xFF, bytes.size() - at));
      if (next == nullptr) return false;
      at = static_cast<std::size_t>(next - bytes.data());
      continue;
    }
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xD9) return true;
    if (marker == 0xFF) {
      ++at;
    } else if (marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {
      at += 2;
    } else {
      if (at + 4 > bytes.size()) return false;
      at += 2 + ((std::size_t{bytes[at + 2]} << 8U) | bytes[at + 3]);
    }
  }
  return false;
}

void readBytes(const std::filesystem::path& file, Bytes& bytes) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file.string() + ": " + why);
  };
  checkIsFile(file);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                           &std::fclose);
  if (in == nullptr) fail(errno == ENOENT ? "the image is missing" : std::strerror(errno));
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) fail(error.message());
  bytes.resize(size);
  if (std::fread(bytes.data(), 1, bytes.size(), in.get()) != bytes.size()) {
    fail("the image cannot be read to its end");
  }
}

}  // namespace

bool isCompleteImage(const Bytes& bytes) {
  if (bytes.size() >= kPngStart.size() &&
      std::equal(kPngStart.begin(), kPngStart.end(), bytes.begin())) {
    return isCompletePng(bytes);
  }
  if (bytes.size() >= 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) return isCompleteJpeg(bytes);
  return true;
}

bool isImageName(const std::filesystem::path& file) {
  std::string end = file.extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::array known = {".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".tif", ".tiff"};
  return std::find(known.begin(), known.end(), end) != known.end();
}

void checkImageSize(const std::filesystem::path& file, const cv::Mat& image, int width, int height,
                    const std::string& wanted_by) {
  if (image.cols == width && image.rows == height) return;
  throw std::runtime_error(file.string() + ": the image is " + std::to_string(image.cols) + "x" +
                           std::to_string(image.rows) + ", but " + wanted_by + " says " +
                           std::to_string(width) + "x" + std::to_string(height));
}

void decodeImage(const std::string& what, const Bytes& bytes, int flags, cv::Mat& image) {
  constexpr std::size_t kBytesPerPixel = 4;  // of any that we make of it
  if (bytes.empty()) throw std::runtime_error(what + " is empty (0 bytes)");
  if (!isCompleteImage(bytes)) throw std::runtime_error(what + " is truncated");
  checkImageMemory(what, bytes.data(), bytes.size(), kBytesPerPixel);
  image.release();  // OpenCV leaves it as it was, the last frame, where it knows no such format
  bool decoded = false;
  try {
    decoded = !cv::imdecode(bytes, flags, &image).empty();
  } catch (const cv::Exception&) {
    // The sentence below says all that a reader can use.
  }
  if (!decoded) throw std::runtime_error(what + " cannot be decoded");
}

void ImageReader::decode(const std::filesystem::path& file, int flags, cv::Mat& image) {
  readBytes(file, bytes_);
  decodeImage(file.string() + ": the image", bytes_, flags, image);
}

void ImageReader::readColor(const std::filesystem::path& file, cv::Mat& image_bgr) {
  // A camera's picture is never turned: its calibration is for the sensor's own rows and columns.
  decode(file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION, image_bgr);
}

void ImageReader::readDepth(const std::filesystem::path& file, double depth_scale,
                            cv::Mat& depth_m) {
  decode(file, cv::IMREAD_UNCHANGED, raw_depth_);
  if (raw_depth_.type() != CV_16UC1) {
    throw std::runtime_error(file.string() + ": a depth image has one 16-bit channel, this has " +
                             std::to_string(raw_depth_.channels()) + " of " +
                             std::to_string(8 * raw_depth_.elemSize1()) + " bits");
  }
  depthInMetres(raw_depth_, depth_scale, depth_m);
}

void depthInMetres(const cv::Mat& depth, double depth_scale, cv::Mat& depth_m) {
  depth_m.create(depth.size(), CV_32FC1);
  const auto metres = static_cast<float>(1.0 / depth_scale);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto* raw = depth.ptr<std::uint16_t>(v);
    auto* out = depth_m.ptr<float>(v);
    for (int u = 0; u < depth_m.cols; ++u) {
      out[u] = raw[u] == 0 ? kNaN : static_cast<float>(raw[u]) * metres;
    }
  }
}

}  // namespace heel
