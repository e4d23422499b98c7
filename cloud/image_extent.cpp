// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/cloud/image_extent.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace heel {
namespace {

/// The bytes of a file; what is asked for beyond their end is 0, which no extent is.
class Bytes {
 public:
  Bytes(const std::uint8_t* bytes, std::size_t size)
      : text_(reinterpret_cast<const char*>(bytes), size) {}

  std::size_t size() const { return text_.size(); }
  bool beginsWith(std::string_view text) const { return text_.substr(0, text.size()) == text; }

  std::size_t at(std::size_t place) const {
    return place < text_.size() ? static_cast<std::uint8_t>(text_[place]) : 0;
  }
  std::size_t big(std::size_t place, std::size_t count) const {
    std::size_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8U | at(place + i);
    return value;
  }
  std::size_t little(std::size_t place, std::size_t count) const {
    std::size_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8U | at(place + i);
    return value;
  }

 private:
  std::string_view text_;
};

ImageExtent extentOfJpeg(const Bytes& bytes) {
  std::size_t place = 2;
  while (place + 4 <= bytes.size()) {
    if (bytes.at(place) != 0xFF) return {};
    const std::size_t marker = bytes.at(place + 1);
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) return {bytes.big(place + 7, 2), bytes.big(place + 5, 2)};
    const bool is_alone = marker == 0xFF || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    place += marker == 0xFF ? 1 : is_alone ? 2 : 2 + bytes.big(place + 2, 2);
  }
  return {};
}

ImageExtent extentOfBmp(const Bytes& bytes) {
  if (bytes.little(14, 4) == 12) return {bytes.little(18, 2), bytes.little(20, 2)};
  const auto height = static_cast<std::int32_t>(bytes.little(22, 4));  // negative: top row first
  return {bytes.little(18, 4),
          static_cast<std::size_t>(height < 0 ? -std::int64_t{height} : std::int64_t{height})};
}

ImageExtent extentOfTiff(const Bytes& bytes, bool is_big) {
  const auto number = [&](std::size_t place, std::size_t count) {
    return is_big ? bytes.big(place, count) : bytes.little(place, count);
  };
  const std::size_t directory = number(4, 4), entries = number(directory, 2);
  ImageExtent extent;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i, tag = number(entry, 2);
    const std::size_t value = number(entry + 8, number(entry + 2, 2) == 3 ? 2 : 4);
    if (tag == 256) extent.width = value;
    if (tag == 257) extent.height = value;
  }
  return extent;
}

ImageExtent extentOfPnm(const Bytes& bytes) {
  std::size_t place = 2;
  std::size_t numbers[2] = {0, 0};
  for (std::size_t& number : numbers) {
    while (std::isspace(static_cast<int>(bytes.at(place))) != 0 || bytes.at(place) == '#') {
      const bool is_comment = bytes.at(place) == '#';
      while (is_comment && place < bytes.size() && bytes.at(place) != '\n') ++place;
      ++place;
    }
    for (; std::isdigit(static_cast<int>(bytes.at(place))) != 0 && number < (1U << 30U); ++place) {
      number = 10 * number + (bytes.at(place) - '0');
    }
  }
  return {numbers[0], numbers[1]};
}

}  // namespace

std::optional<ImageExtent> imageExtent(const std::uint8_t* data, std::size_t size) {
  const Bytes bytes(data, size);
  ImageExtent extent;
  if (bytes.beginsWith("\x89PNG\r\n\x1a\n")) {
    extent = {bytes.big(16, 4), bytes.big(20, 4)};
  } else if (bytes.beginsWith("\xFF\xD8")) {
    extent = extentOfJpeg(bytes);
  } else if (bytes.beginsWith("BM")) {
    extent = extentOfBmp(bytes);
  } else if (bytes.beginsWith(std::string_view("II*\0", 4))) {
    extent = extentOfTiff(bytes, false);
  } else if (bytes.beginsWith(std::string_view("MM\0*", 4))) {
    extent = extentOfTiff(bytes, true);
  } else if (bytes.at(0) == 'P' && bytes.at(1) >= '1' && bytes.at(1) <= '6') {
    extent = extentOfPnm(bytes);
  }
  if (extent.width == 0 || extent.height == 0) return std::nullopt;
  return extent;
}

void checkImageMemory(const std::string& what, const std::uint8_t* bytes, std::size_t size,
                      std::size_t bytes_per_pixel) {
  const auto extent = imageExtent(bytes, size);
  if (!extent) throw std::runtime_error(what + " cannot be decoded");
  checkMemory(what + " of " + std::to_string(extent->width) + "x" + std::to_string(extent->height) +
                  " pixels",
              timesAtMost(timesAtMost(extent->width, extent->height), bytes_per_pixel), size);
}

void checkCameraMemory(const std::string& origin, double width, double height) {
  constexpr std::size_t kBytesPerPixel = 16;  // of the images and of what is made of them
  if (!(width >= 1.0 && height >= 1.0)) {
    throw std::runtime_error(origin + ": the size of the images is not given");
  }
  const auto w = static_cast<std::size_t>(std::min(width, 1e9));
  const auto h = static_cast<std::size_t>(std::min(height, 1e9));
  checkMemory(origin + ": a camera of " + std::to_string(w) + "x" + std::to_string(h) + " pixels",
              timesAtMost(timesAtMost(w, h), kBytesPerPixel));
}

}  // namespace heel
