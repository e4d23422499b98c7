// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How large an image is, without decoding it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace heel {

/// The size of a picture [px].
struct ImageExtent {
  std::size_t width = 0;
  std::size_t height = 0;
};

/// What the header of a PNG, JPEG, BMP, TIFF, PGM, PPM or PBM file says; nothing of other bytes.
std::optional<ImageExtent> imageExtent(const std::uint8_t* data, std::size_t size);

/// Whether an image may be decoded: a small file can hold a huge one.
/// @param what  The image, in the errors: "left.png: the image".
/// @throws std::runtime_error  if it is of no format that we know, or asks for too much memory.
void checkImageMemory(const std::string& what, const std::uint8_t* bytes, std::size_t size,
                      std::size_t bytes_per_pixel);

/// Whether images of a camera may be worked on, of the size that its calibration tells.
/// @throws std::runtime_error  one sentence that begins with `origin`, if they have no size, or ask
/// for
///         too much memory.
void checkCameraMemory(const std::string& origin, double width, double height);

}  // namespace heel
