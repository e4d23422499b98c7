// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The images of messages.
#pragma once

#include <heel/apps/bag/messages.hpp>

#include <opencv2/core/mat.hpp>

namespace heel {

/// Turns the images of messages into ours, in memory that is used again. Errors are
/// std::runtime_error with half a sentence, for the caller to say which message it was.
class BagImageReader {
 public:
  /// bgr8, rgb8, bgra8, rgba8, mono8, mono16, Bayer patterns, yuv422.
  /// @param image_bgr  Out: CV_8UC3.
  void readColor(const ImageMsg& message, cv::Mat& image_bgr);
  /// JPEG, PNG and whatever else OpenCV reads; of a Bayer pattern, too.
  void readColor(const CompressedImageMsg& message, cv::Mat& image_bgr);

  /// 16UC1 and mono16 in millimetres, 32FC1 in metres.
  /// @param depth_m  Out: CV_32FC1, NaN where there is none.
  void readDepth(const ImageMsg& message, cv::Mat& depth_m);
  /// A PNG of 16 bits in millimetres; "compressedDepth" with PNG: 12 bytes about the quantization,
  /// then the picture.
  void readDepth(const CompressedImageMsg& message, cv::Mat& depth_m);

 private:
  cv::Mat scratch_;
};

/// Whether images of this encoding, or of this format of compressed ones, are depth.
bool isDepthEncoding(const std::string& encoding);

}  // namespace heel
