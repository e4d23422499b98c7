// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_image_reader.hpp>
#include <heel/apps/recording/image_file.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr int kAsItIs = -1;

/// What an encoding is in OpenCV, and how it becomes BGR.
struct Encoding {
  const char* name;
  int type;
  int conversion;
};
// OpenCV names a Bayer pattern by its second row, ROS by its first.
constexpr Encoding kEncodings[] = {
    {"bgr8", CV_8UC3, kAsItIs},
    {"8UC3", CV_8UC3, kAsItIs},
    {"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
    {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
    {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
    {"mono8", CV_8UC1, cv::COLOR_GRAY2BGR},
    {"8UC1", CV_8UC1, cv::COLOR_GRAY2BGR},
    {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
    {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
    {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
    {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
    {"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    {"uyvy", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
    {"yuyv", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
};

/// Null if it is not read.
const Encoding* findEncoding(const std::string& name) {
  const auto* known = std::find_if(std::begin(kEncodings), std::end(kEncodings),
                                   [&](const Encoding& e) { return name == e.name; });
  return known == std::end(kEncodings) ? nullptr : known;
}

/// The message's own bytes as an image.
cv::Mat viewOf(const ImageMsg& message, int type) {
  const std::size_t row = std::size_t{message.width} * static_cast<std::size_t>(CV_ELEM_SIZE(type));
  constexpr std::uint32_t kLargest = 1U << 16U;
  if (message.width == 0 || message.height == 0) throw std::runtime_error("the image is empty");
  if (message.width > kLargest || message.height > kLargest || message.step < row ||
      message.data.size() < std::size_t{message.step} * message.height) {
    throw std::runtime_error("the image has fewer bytes than its size needs");
  }
  if (message.is_bigendian != 0 && CV_ELEM_SIZE1(type) > 1) {
    throw std::runtime_error("the image is big-endian, which is not read");
  }
  return cv::Mat(static_cast<int>(message.height), static_cast<int>(message.width), type,
                 const_cast<std::uint8_t*>(message.data.data()), message.step);
}

template <class Value, class Convert>
void convertDepth(const cv::Mat& raw, cv::Mat& depth_m, const Convert& metres) {
  depth_m.create(raw.size(), CV_32FC1);
  for (int v = 0; v < raw.rows; ++v) {
    const auto* from = raw.ptr<Value>(v);
    std::transform(from, from + raw.cols, depth_m.ptr<float>(v), metres);
  }
}

void fromMillimetres(const cv::Mat& raw, cv::Mat& depth_m) {
  convertDepth<std::uint16_t>(raw, depth_m, [](std::uint16_t mm) {
    return mm == 0 ? kNone : static_cast<float>(mm) * 0.001F;
  });
}

}  // namespace

bool isDepthEncoding(const std::string& encoding) {
  // A compressed image's format begins with the encoding that it had: "16UC1; png compressed ".
  return encoding == "16UC1" || encoding == "32FC1" || encoding.rfind("16UC1; png", 0) == 0 ||
         encoding.find("compressedDepth") != std::string::npos;
}

void BagImageReader::readColor(const ImageMsg& message, cv::Mat& image_bgr) {
  if (message.encoding == "mono16") {
    viewOf(message, CV_16UC1).convertTo(scratch_, CV_8UC1, 1.0 / 256.0);
    cv::cvtColor(scratch_, image_bgr, cv::COLOR_GRAY2BGR);
    return;
  }
  const Encoding* known = findEncoding(message.encoding);
  if (known == nullptr) {
    throw std::runtime_error("the encoding '" + message.encoding + "' is not read");
  }
  const cv::Mat raw = viewOf(message, known->type);
  if (known->conversion == kAsItIs) {
    raw.copyTo(image_bgr);
  } else {
    cv::cvtColor(raw, image_bgr, known->conversion);
  }
}

void BagImageReader::readColor(const CompressedImageMsg& message, cv::Mat& image_bgr) {
  // image_transport compresses a Bayer pattern as the grey picture that it is.
  const bool may_be_raw = message.format.rfind("bayer_", 0) == 0;
  const int flags = may_be_raw ? cv::IMREAD_ANYCOLOR : cv::IMREAD_COLOR;
  decodeImage("the image", message.data, flags | cv::IMREAD_IGNORE_ORIENTATION, image_bgr);
  if (image_bgr.channels() != 1) return;
  const Encoding* raw = findEncoding(message.format.substr(0, message.format.find(';')));
  if (raw == nullptr) throw std::runtime_error("the format '" + message.format + "' is not read");
  cv::swap(image_bgr, scratch_);
  cv::cvtColor(scratch_, image_bgr, raw->conversion);
}

void BagImageReader::readDepth(const ImageMsg& message, cv::Mat& depth_m) {
  if (message.encoding == "32FC1") {
    convertDepth<float>(viewOf(message, CV_32FC1), depth_m,
                        [](float z) { return z > 0.0F && z < 1e6F ? z : kNone; });
  } else if (message.encoding == "16UC1" || message.encoding == "mono16") {
    fromMillimetres(viewOf(message, CV_16UC1), depth_m);
  } else {
    throw std::runtime_error("the encoding '" + message.encoding + "' is not depth");
  }
}

void BagImageReader::readDepth(const CompressedImageMsg& message, cv::Mat& depth_m) {
  constexpr std::size_t kHead = 12;  // an enum and two floats: the quantization of 32FC1
  const bool has_head = message.format.find("compressedDepth") != std::string::npos;
  if (message.format.find("rvl") != std::string::npos) {
    throw std::runtime_error("the format '" + message.format + "' is not read");
  }
  if (has_head && message.data.size() < kHead) throw std::runtime_error("the image is truncated");
  const std::vector<std::uint8_t> png(message.data.begin() + (has_head ? kHead : 0),
                                      message.data.end());
  decodeImage("the image", png, cv::IMREAD_UNCHANGED, scratch_);
  if (scratch_.type() != CV_16UC1) throw std::runtime_error("the image is no 16-bit depth");
  if (message.format.rfind("32FC1", 0) != 0) return fromMillimetres(scratch_, depth_m);
  float a = 0.0F, b = 0.0F;
  std::memcpy(&a, &message.data[4], sizeof a);
  std::memcpy(&b, &message.data[8], sizeof b);
  convertDepth<std::uint16_t>(scratch_, depth_m, [&](std::uint16_t inverse) {
    return inverse == 0 ? kNone : a / (static_cast<float>(inverse) - b);
  });
}

}  // namespace heel
