// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Image files, read whole or not at all.
#pragma once

#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// Reads image files into memory that is used again from one file to the next.
///
/// OpenCV returns what it could decode of a truncated JPEG, grey where the data ends. Such a file
/// is found here before it is decoded, by its end marker, and is an error. All of the errors are
/// std::runtime_error with one sentence that names the file.
class ImageReader {
 public:
  /// @param image_bgr  Out: CV_8UC3; grey and 16-bit images are converted.
  void readColor(const std::filesystem::path& file, cv::Mat& image_bgr);

  /// @param depth_scale  Value of one metre in the 16-bit image.
  /// @param depth_m      Out: CV_32FC1, NaN where the image has 0.
  void readDepth(const std::filesystem::path& file, double depth_scale, cv::Mat& depth_m);

 private:
  void decode(const std::filesystem::path& file, int flags, cv::Mat& image);

  std::vector<std::uint8_t> bytes_;
  cv::Mat raw_depth_;
};

/// @param depth        CV_16UC1.
/// @param depth_scale  Value of one metre in it.
/// @param depth_m      Out: CV_32FC1, NaN where it is 0.
void depthInMetres(const cv::Mat& depth, double depth_scale, cv::Mat& depth_m);

/// Whether the bytes of a PNG or JPEG file go on to its end marker; true for other formats, which
/// can't be told.
bool isCompleteImage(const std::vector<std::uint8_t>& bytes);

/// Decodes the bytes of an image file.
/// @param what   The image, in the errors: "left.png: the image".
/// @param flags  OpenCV's IMREAD_...
/// @throws std::runtime_error  that begins with `what`, if it is truncated, damaged or too large.
void decodeImage(const std::string& what, const std::vector<std::uint8_t>& bytes, int flags,
                 cv::Mat& image);

/// Whether the name ends like an image that we read (.png, .jpg, .jpeg, .bmp, .pgm, .ppm, .tif,
/// .tiff).
bool isImageName(const std::filesystem::path& file);

/// @throws std::runtime_error  if the image is not of this size; `wanted_by` says whose size it is.
void checkImageSize(const std::filesystem::path& file, const cv::Mat& image, int width, int height,
                    const std::string& wanted_by);

}  // namespace heel
