// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/cloud_places.hpp>
#include <heel/apps/recording/clouds/ply_file.hpp>
#include <heel/cloud/files.hpp>

#include <pcl/common/io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace heel {

namespace fs = std::filesystem;

namespace {

using Field = pcl::PCLPointField;

constexpr std::size_t kLeft = std::numeric_limits<std::size_t>::max();  // out, as an offset

[[noreturn]] void failPly(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

std::size_t bytesOf(std::uint8_t type) { return static_cast<std::size_t>(pcl::getFieldSize(type)); }

/// Where in the four bytes of a colour a property goes; 4 if it is none.
std::size_t colorByte(const PlyProperty& property) {
  if (property.type != Field::UINT8 || property.isList()) return 4;
  static const std::array kColors = {"blue", "green", "red", "alpha"};
  const bool is_diffuse = property.name.rfind("diffuse_", 0) == 0;
  const std::string name = is_diffuse ? property.name.substr(8) : property.name;
  return static_cast<std::size_t>(std::find(kColors.begin(), kColors.end(), name) -
                                  kColors.begin());
}

bool hasColor(const PlyElement& vertex, std::size_t least, std::size_t most) {
  return std::any_of(vertex.properties.begin(), vertex.properties.end(), [&](const auto& property) {
    return colorByte(property) >= least && colorByte(property) <= most;
  });
}

/// A cloud's fields, and where each property goes in a point.
struct Layout {
  explicit Layout(const PlyElement& vertex) {
    const bool has_color = hasColor(vertex, 0, 2);
    std::size_t color = kLeft;
    for (const PlyProperty& property : vertex.properties) {
      const std::size_t byte = has_color ? colorByte(property) : 4;
      if (byte < 4 && color == kLeft) {
        const bool has_alpha = hasColor(vertex, 3, 3);
        color = add(has_alpha ? "rgba" : "rgb", has_alpha ? Field::UINT32 : Field::FLOAT32);
      }
      const bool is_normal =
          property.name == "nx" || property.name == "ny" || property.name == "nz";
      offsets.push_back(byte < 4            ? color + byte
                        : property.isList() ? kLeft
                        : is_normal ? add("normal_" + property.name.substr(1), property.type)
                                    : add(property.name, property.type));
    }
  }

  std::size_t add(const std::string& name, std::uint8_t type) {
    Field field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(step);
    field.datatype = type;
    field.count = 1;
    fields.push_back(field);
    step += bytesOf(type);
    return field.offset;
  }

  std::vector<Field> fields;
  std::vector<std::size_t> offsets;  ///< kLeft: it is left out.
  std::size_t step = 0;
};

/// Reads value by value, whatever the encoding; each comes as bytes in this machine's order.
class ValueReader {
 public:
  ValueReader(const fs::path& file, const PlyHeader& header)
      : file_(file), header_(header), in_(file, std::ios::binary) {
    in_.seekg(static_cast<std::streamoff>(header.bytes));
  }

  /// Before the properties of the i-th of some elements.
  void beginRow(const std::string& element, std::size_t i) {
    element_ = &element;
    row_ = i;
    if (header_.is_binary) return;
    do {
      if (!std::getline(in_, line_)) truncated();
    } while (line_.find_first_not_of(" \t\r") == std::string::npos);
    at_ = line_.c_str();
  }

  /// Takes a value of up to 8 bytes.
  void take(std::uint8_t type, std::uint8_t* value) {
    const std::size_t bytes = bytesOf(type);
    if (!header_.is_binary) return takeText(type, value);
    if (in_.rdbuf()->sgetn(reinterpret_cast<char*>(value), static_cast<std::streamsize>(bytes)) !=
        static_cast<std::streamsize>(bytes)) {
      truncated();
    }
    if (header_.is_big_endian) std::reverse(value, value + bytes);
  }

  double number(std::uint8_t type) {
    std::uint8_t bytes[8];
    take(type, bytes);
    return visit(type, [&](auto example) {
      std::memcpy(&example, bytes, sizeof example);
      return static_cast<double>(example);
    });
  }

  /// The number of items of a list, which are then to be taken.
  std::size_t listSize(const PlyProperty& list) {
    const double count = number(list.count_type);
    if (count < 0.0) damaged("has a list with less than no items");
    return static_cast<std::size_t>(count);
  }

  void skip(const PlyProperty& property) {
    std::uint8_t ignored[8];
    const std::size_t count = property.isList() ? listSize(property) : 1;
    for (std::size_t i = 0; i < count; ++i) take(property.type, ignored);
  }

 private:
  /// Does the work on an example of the type.
  template <class Work>
  static double visit(std::uint8_t type, const Work& work) {
    double result = 0.0;
    const auto ifIs = [&](auto example) {
      if (type == pcl::traits::asEnum_v<decltype(example)>) result = work(example);
    };
    const auto ifIsOneOf = [&](auto... examples) { (ifIs(examples), ...); };
    ifIsOneOf(std::int8_t{}, std::uint8_t{}, std::int16_t{}, std::uint16_t{}, std::int32_t{},
              std::uint32_t{}, float{}, double{});
    return result;
  }

  void takeText(std::uint8_t type, std::uint8_t* bytes) {
    char* end = nullptr;
    const double value = std::strtod(at_, &end);
    if (end == at_) {
      if (in_.eof()) truncated();
      damaged(std::string(*at_ == '\0' ? "has too few values" : "has what is no number"));
    }
    at_ = end;
    visit(type, [&](auto example) {
      using T = decltype(example);
      if constexpr (std::is_integral_v<T>) {
        if (!(value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max())) {
          damaged("has a number that is too large for its type");
        }
      }
      example = static_cast<T>(value);
      std::memcpy(bytes, &example, sizeof example);
      return 0.0;
    });
  }

  [[noreturn]] void truncated() const {
    failPly(file_,
            "the cloud is truncated (at its " + *element_ + " " + std::to_string(row_ + 1) + ")");
  }
  [[noreturn]] void damaged(const std::string& why) const {
    failPly(file_, "the " + *element_ + " " + std::to_string(row_ + 1) + " of the cloud " + why);
  }

  const fs::path& file_;
  const PlyHeader& header_;
  std::ifstream in_;
  std::string line_;
  const char* at_ = nullptr;
  const std::string* element_ = nullptr;
  std::size_t row_ = 0;
};

/// How many bytes of the file one of an element takes at least.
std::size_t leastBytes(const PlyHeader& header, const PlyElement& element) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    // In ascii a digit, and a blank or the line's end.
    bytes += !header.is_binary   ? 2
             : property.isList() ? bytesOf(property.count_type)
                                 : bytesOf(property.type);
  }
  return bytes;
}

void checkSize(const fs::path& file, const PlyHeader& header, std::size_t step) {
  const std::size_t file_bytes = fs::file_size(file);
  const std::size_t room = file_bytes - header.bytes + (header.is_binary ? 0 : 1);
  std::size_t points = 0;
  for (const PlyElement& element : header.elements) {
    const std::size_t bytes = leastBytes(header, element);
    if (bytes == 0) continue;  // and none of it will be read
    if (element.count > room / bytes) {
      failPly(file, "the cloud is truncated (" + std::to_string(room) + " bytes for " +
                        std::to_string(element.count) + " of " + element.name + ")");
    }
    if (element.name == "vertex" || element.name == "range_grid") points += element.count;
  }
  checkMemory(file.string() + ": the cloud of " + std::to_string(points) + " points",
              points * (step + sizeof(ColorCloud::PointType)), file_bytes);
}

void readVertices(const PlyElement& element, ValueReader& in, pcl::PCLPointCloud2& blob) {
  const Layout layout(element);
  blob.data.assign(element.count * layout.step, 0);
  for (std::size_t i = 0; i < element.count; ++i) {
    in.beginRow(element.name, i);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (layout.offsets[k] == kLeft) {
        in.skip(property);
      } else {
        in.take(property.type, &blob.data[i * layout.step + layout.offsets[k]]);
      }
    }
  }
}

/// Where the camera was, and how large its picture is.
void readCamera(const PlyElement& element, ValueReader& in, CloudFile& cloud, std::size_t& columns,
                std::size_t& rows) {
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();
  for (std::size_t i = 0; i < element.count; ++i) {
    in.beginRow(element.name, i);
    for (const PlyProperty& property : element.properties) {
      if (property.isList()) {
        in.skip(property);
        continue;
      }
      const double value = in.number(property.type);
      const std::string& name = property.name;
      const auto axis = [&](char letter) { return static_cast<Eigen::Index>(letter - 'x'); };
      const bool ends_in_axis = !name.empty() && name.back() >= 'x' && name.back() <= 'z';
      const bool is_size = value >= 0.0 && value < 4294967296.0;
      if (name == "viewportx" && is_size) columns = static_cast<std::size_t>(value);
      if (name == "viewporty" && is_size) rows = static_cast<std::size_t>(value);
      if (ends_in_axis && name.rfind("view_p", 0) == 0 && name.size() == 7) {
        cloud.origin[axis(name.back())] = static_cast<float>(value);
      }
      if (ends_in_axis && name.size() == 7 && name.compare(1, 5, "_axis") == 0 && name[0] >= 'x' &&
          name[0] <= 'z') {
        axes(axis(name[0]), axis(name.back())) = static_cast<float>(value);
      }
    }
  }
  cloud.orientation = Eigen::Quaternionf(axes);
}

/// For each pixel of a picture its vertex, or none (kLeft).
std::vector<std::size_t> readGrid(const PlyElement& element, ValueReader& in) {
  std::vector<std::size_t> vertices(element.count, kLeft);
  for (std::size_t i = 0; i < element.count; ++i) {
    in.beginRow(element.name, i);
    for (const PlyProperty& property : element.properties) {
      const std::size_t count = property.isList() ? in.listSize(property) : 1;
      for (std::size_t k = 0; k < count; ++k) {
        const double vertex = in.number(property.type);
        if (property.isList() && k == 0 && vertex >= 0.0) {
          vertices[i] = static_cast<std::size_t>(vertex);
        }
      }
    }
  }
  return vertices;
}

/// Puts the points where they are in the picture; NaN where there is none.
void arrange(const fs::path& file, const std::vector<std::size_t>& grid,
             pcl::PCLPointCloud2& blob) {
  const std::size_t step = blob.point_step,
                    points = blob.data.size() / std::max<std::size_t>(step, 1);
  std::vector<std::uint8_t> data(grid.size() * step, 0);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid[i] == kLeft) {
      for (const char* name : {"x", "y", "z"}) {
        const auto field = static_cast<std::size_t>(pcl::getFieldIndex(blob, name));
        std::memcpy(&data[i * step + blob.fields[field].offset], &kNaN, sizeof kNaN);
      }
      continue;
    }
    if (grid[i] >= points) {
      failPly(file, "the range_grid " + std::to_string(i + 1) + " of the cloud has no such point");
    }
    std::memcpy(&data[i * step], &blob.data[grid[i] * step], step);
  }
  blob.data.assign(data.begin(), data.end());
}

}  // namespace

pcl::PCLPointCloud2 plyLayout(const fs::path& file, const PlyHeader& header) {
  const PlyElement* vertex = header.find("vertex");
  pcl::PCLPointCloud2 blob;
  if (vertex == nullptr || vertex->count == 0) failPly(file, "the cloud is empty (0 points)");
  Layout layout(*vertex);
  constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max();
  checkSize(file, header, layout.step);
  if (timesAtMost(vertex->count, std::max<std::size_t>(layout.step, 1)) > kLargest) {
    failPly(file, "the points of the cloud are more than 4 GiB");
  }
  blob.fields = std::move(layout.fields);
  blob.point_step = static_cast<std::uint32_t>(layout.step);
  blob.width = static_cast<std::uint32_t>(vertex->count);
  blob.height = 1;
  return blob;
}

void readPlyPoints(const fs::path& file, const PlyHeader& header, CloudFile& cloud) {
  pcl::PCLPointCloud2& blob = cloud.blob;
  ValueReader in(file, header);
  std::size_t columns = header.columns, rows = header.rows;
  std::vector<std::size_t> grid;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // it has no data
    if (&element == header.find("vertex")) {
      readVertices(element, in, blob);
      makePlacesShort(blob);
    } else if (element.name == "camera") {
      readCamera(element, in, cloud, columns, rows);
    } else if (element.name == "range_grid") {
      grid = readGrid(element, in);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        in.beginRow(element.name, i);
        for (const PlyProperty& property : element.properties) in.skip(property);
      }
    }
  }
  if (!grid.empty()) arrange(file, grid, blob);
  const std::size_t points = grid.empty() ? blob.width : grid.size();
  const bool is_picture = timesAtMost(columns, rows) == points;
  blob.width = static_cast<std::uint32_t>(is_picture ? columns : points);
  blob.height = static_cast<std::uint32_t>(is_picture ? rows : 1);
  blob.row_step = blob.width * blob.point_step;
  blob.is_dense = 0;
}

}  // namespace heel
