// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/pcd_file.hpp>
#include <heel/cloud/files.hpp>

#include <pcl/common/io.h>
#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {

void checkPcd(const std::filesystem::path& file) { needColors(file, checkPcdFile(file)); }

PcdFile readPcd(const std::filesystem::path& file) {
  checkPcd(file);
  return readCloud(file);
}

void colorsOf(const ColorCloud& cloud, cv::Mat& image_bgr) {
  image_bgr.create(static_cast<int>(cloud.height), static_cast<int>(cloud.width), CV_8UC3);
  std::transform(cloud.begin(), cloud.end(), image_bgr.begin<cv::Vec3b>(),
                 [](const auto& p) { return cv::Vec3b(p.b, p.g, p.r); });
}

namespace fs = std::filesystem;

namespace {

using WordList = std::vector<std::string>;

constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();  // of PCL's numbers

[[noreturn]] void failPcd(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

WordList wordsOf(const std::string& line) {
  std::istringstream in(line);
  WordList words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// The lines of a header, each a keyword and its values.
class HeaderReader {
 public:
  explicit HeaderReader(const fs::path& file) : file_(file) {}

  PcdHeader read() {
    if (!fs::exists(file_)) failPcd(file_, "the cloud is missing");
    checkIsFile(file_);
    std::ifstream in(file_, std::ios::binary);
    if (!in || fs::is_directory(file_)) failPcd(file_, "the cloud cannot be read");
    bool has_data = false, is_known = true;
    for (std::string line; is_known && !has_data && std::getline(in, line);) {
      words_ = wordsOf(line);
      if (words_.empty() || words_.front().front() == '#') continue;
      is_known = take();
      has_data = words_.front() == "DATA";
    }
    if (header_.layout.fields.empty()) failPcd(file_, "this is not a PCD file");
    if (!has_data) damaged(is_known ? "it has no DATA" : "'" + words_.front() + "'");
    header_.data_start = static_cast<std::size_t>(in.tellg());
    layOut();
    return std::move(header_);
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    failPcd(file_, "the PCD header is damaged (" + why + ")");
  }

  /// Takes a line; false if its keyword is none.
  bool take() {
    const std::string& keyword = words_.front();
    auto& layout = header_.layout;
    if (keyword == "FIELDS" || keyword == "COLUMNS") {
      layout.fields.assign(words_.size() - 1, {});
      for (std::size_t i = 1; i < words_.size(); ++i) layout.fields[i - 1].name = words_[i];
      sizes_.assign(layout.fields.size(), 4);  // as files of old have it that say no more
      types_.assign(layout.fields.size(), "F");
      counts_.assign(layout.fields.size(), 1);
    } else if (keyword == "SIZE") {
      for (std::size_t i = 0; i < perField(); ++i) sizes_[i] = number(i + 1);
    } else if (keyword == "TYPE") {
      for (std::size_t i = 0; i < perField(); ++i) types_[i] = words_[i + 1];
    } else if (keyword == "COUNT") {
      for (std::size_t i = 0; i < perField(); ++i) counts_[i] = number(i + 1);
    } else if (keyword == "WIDTH") {
      width_ = number(1);
    } else if (keyword == "HEIGHT") {
      height_ = number(1);
    } else if (keyword == "POINTS") {
      points_ = number(1);
    } else if (keyword == "VIEWPOINT") {
      takeViewpoint();
    } else if (keyword == "DATA") {
      takeEncoding();
    } else {
      return keyword == "VERSION";
    }
    return true;
  }

  std::size_t perField() const {
    if (words_.size() != header_.layout.fields.size() + 1) {
      damaged(words_.front() + " has not as many values as there are fields");
    }
    return header_.layout.fields.size();
  }

  std::size_t number(std::size_t i) const {
    std::uint32_t value = 0;
    if (i < words_.size()) {
      const char* end = words_[i].data() + words_[i].size();
      const auto [stop, error] = std::from_chars(words_[i].data(), end, value);
      if (error == std::errc() && stop == end) return value;
    }
    damaged(words_.front() + " is not a number from 0 on");
  }

  void takeViewpoint() {
    std::array<float, 7> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i + 1 >= words_.size() || !(std::istringstream(words_[i + 1]) >> values[i])) {
        damaged("VIEWPOINT is not seven numbers");
      }
    }
    header_.origin = {values[0], values[1], values[2], 0.0F};
    header_.orientation = {values[3], values[4], values[5], values[6]};
  }

  void takeEncoding() {
    const std::string name = words_.size() > 1 ? words_[1] : "";
    for (const CloudEncoding encoding :
         {CloudEncoding::kAscii, CloudEncoding::kBinary, CloudEncoding::kCompressed}) {
      if (name != toText(encoding)) continue;
      header_.encoding = encoding;
      return;
    }
    damaged("DATA is neither ascii nor binary nor binary_compressed");
  }

  /// What PCL's reader would have to trust.
  void layOut() {
    auto& layout = header_.layout;
    std::size_t step = 0;
    for (std::size_t i = 0; i < layout.fields.size(); ++i) {
      auto& field = layout.fields[i];
      const int type =
          types_[i].size() == 1
              ? pcl::getFieldType(static_cast<int>(std::min<std::size_t>(sizes_[i], 9)),
                                  types_[i].front())
              : -1;
      if (type < 0) damaged("the field " + field.name + " has no type that there is");
      if (counts_[i] < 1) damaged("the field " + field.name + " has no values");
      field.offset = static_cast<std::uint32_t>(step);
      field.datatype = static_cast<std::uint8_t>(type);
      field.count = static_cast<std::uint32_t>(counts_[i]);
      const std::size_t bytes = sizes_[i] * counts_[i];  // at most 8 * 2^32
      step += bytes;
      header_.values += counts_[i];
      if (field.name != "_") header_.stored_bytes += bytes;
      if (step > kLargest) damaged("a point has more than 4 GiB");
    }
    if (width_ == 0 && height_ == 0) width_ = points_.value_or(0);
    if (height_ == 0) height_ = 1;
    header_.points = timesAtMost(width_, height_);
    if (header_.points != points_.value_or(header_.points) || header_.points > kLargest) {
      damaged("WIDTH times HEIGHT is not POINTS");
    }
    layout.width = static_cast<std::uint32_t>(width_);
    layout.height = static_cast<std::uint32_t>(height_);
    layout.point_step = static_cast<std::uint32_t>(step);
  }

  const fs::path& file_;
  WordList words_;
  std::vector<std::size_t> sizes_, counts_;
  WordList types_;
  std::size_t width_ = 0, height_ = 0;
  std::optional<std::size_t> points_;
  PcdHeader header_;
};

/// Of a compressed cloud: how many bytes are there, and how many they make.
using PackedSizes = std::array<std::uint32_t, 2>;

PackedSizes readPackedSizes(std::ifstream& in, const PcdHeader& header) {
  PackedSizes sizes{};
  in.seekg(static_cast<std::streamoff>(header.data_start));
  in.read(reinterpret_cast<char*>(sizes.data()), sizeof sizes);
  return sizes;
}

/// Compressed data have all values of the first field, then all of the second, and so on.
bool readCompressed(std::ifstream& in, const PcdHeader& header, pcl::PCLPointCloud2& cloud) {
  const auto [packed_bytes, unpacked_bytes] = readPackedSizes(in, header);
  std::vector<char> packed(packed_bytes), unpacked(unpacked_bytes);
  in.read(packed.data(), packed_bytes);
  if (!in || pcl::lzfDecompress(packed.data(), packed_bytes, unpacked.data(), unpacked_bytes) !=
                 unpacked_bytes) {
    return false;
  }
  const char* from = unpacked.data();
  for (const auto& field : cloud.fields) {
    if (field.name == "_") continue;
    const std::size_t bytes =
        std::size_t{field.count} * static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
    for (std::size_t i = 0; i < header.points; ++i, from += bytes) {
      std::memcpy(&cloud.data[i * cloud.point_step + field.offset], from, bytes);
    }
  }
  return true;
}

template <class Float>
bool isFiniteAt(const std::uint8_t* at) {
  Float value = 0;
  std::memcpy(&value, at, sizeof value);
  return std::isfinite(value);
}

/// Whether all numbers of all points are finite.
bool isDense(const pcl::PCLPointCloud2& cloud) {
  for (const auto& field : cloud.fields) {
    const bool is_float = field.datatype == pcl::PCLPointField::FLOAT32;
    if (field.name == "_" || (!is_float && field.datatype != pcl::PCLPointField::FLOAT64)) continue;
    for (std::size_t at = field.offset; at < cloud.data.size(); at += cloud.point_step) {
      for (std::size_t k = 0; k < field.count; ++k) {
        const std::uint8_t* value = &cloud.data[at + k * (is_float ? 4 : 8)];
        if (!(is_float ? isFiniteAt<float>(value) : isFiniteAt<double>(value))) return false;
      }
    }
  }
  return true;
}

}  // namespace

PcdHeader readPcdHeader(const fs::path& file) { return HeaderReader(file).read(); }

void checkPcdSize(const fs::path& file, const PcdHeader& header) {
  const std::size_t file_bytes = fs::file_size(file);
  constexpr std::size_t kEnough = std::numeric_limits<std::size_t>::max() / 4;  // sums still fit
  const std::size_t data_bytes =
      std::min(timesAtMost(header.points, header.layout.point_step), kEnough);
  const auto checkEnd = [&](std::size_t end) {
    if (file_bytes < end) {
      failPcd(file, "the cloud is truncated (" + std::to_string(file_bytes) + " of " +
                        std::to_string(end) + " bytes)");
    }
  };
  std::size_t unpacked_bytes = 0;
  if (header.encoding == CloudEncoding::kAscii) {
    // A digit and a blank (or the line's end, but the last) for each value.
    if (timesAtMost(header.points, header.values) > (file_bytes + 1 - header.data_start) / 2) {
      failPcd(file, "the cloud is truncated (its " + std::to_string(file_bytes) +
                        " bytes have no room for " + std::to_string(header.points) + " points)");
    }
  } else if (header.encoding == CloudEncoding::kBinary) {
    checkEnd(header.data_start + data_bytes);
  } else {
    checkEnd(header.data_start + sizeof(PackedSizes));
    std::ifstream in(file, std::ios::binary);
    const PackedSizes sizes = readPackedSizes(in, header);
    checkEnd(header.data_start + sizeof(PackedSizes) + sizes[0]);
    constexpr std::size_t kMostOfAByte = 128;
    unpacked_bytes = sizes[1];
    if (!in || unpacked_bytes < timesAtMost(header.points, header.stored_bytes) ||
        unpacked_bytes > kMostOfAByte * sizes[0]) {
      failPcd(file, "the compressed cloud is damaged");
    }
  }
  if (timesAtMost(header.layout.width, header.layout.point_step) > kLargest) {
    failPcd(file, "a row of the cloud's points has more than 4 GiB");
  }
  checkMemory(file.string() + ": the cloud of " + std::to_string(header.points) + " points",
              data_bytes + unpacked_bytes + header.points * sizeof(ColorCloud::PointType),
              file_bytes);
}

bool readPcdPoints(const fs::path& file, const PcdHeader& header, pcl::PCLPointCloud2& cloud) {
  cloud = header.layout;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(header.points * cloud.point_step);
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(header.data_start));
  if (header.encoding == CloudEncoding::kAscii) {
    return pcl::PCDReader().readBodyASCII(in, cloud, pcl::PCDReader::PCD_V7) == 0;
  }
  if (header.encoding == CloudEncoding::kBinary) {
    in.read(reinterpret_cast<char*>(cloud.data.data()),
            static_cast<std::streamsize>(cloud.data.size()));
    if (!in) return false;
  } else if (!readCompressed(in, header, cloud)) {
    return false;
  }
  cloud.is_dense = isDense(cloud) ? 1 : 0;
  return true;
}

}  // namespace heel
