// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/ply_file.hpp>

#include <pcl/PCLPointField.h>
#include <pcl/common/io.h>

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace heel {

namespace {

/// Bytes of a point that go to the file, in order.
struct Piece {
  std::size_t offset;
  std::size_t bytes;
};

struct WrittenLayout {
  std::string properties;
  std::vector<Piece> pieces;

  void add(const std::string& type, const std::string& name, std::size_t offset,
           std::size_t bytes) {
    properties += "property " + type + " " + name + "\n";
    pieces.push_back({offset, bytes});
  }
};

const char* typeName(std::uint8_t datatype) {
  static const std::map<int, const char*> kNames = {
      {pcl::PCLPointField::INT8, "char"},     {pcl::PCLPointField::UINT8, "uchar"},
      {pcl::PCLPointField::INT16, "short"},   {pcl::PCLPointField::UINT16, "ushort"},
      {pcl::PCLPointField::INT32, "int"},     {pcl::PCLPointField::UINT32, "uint"},
      {pcl::PCLPointField::FLOAT32, "float"}, {pcl::PCLPointField::FLOAT64, "double"}};
  const auto found = kNames.find(datatype);
  return found == kNames.end() ? nullptr : found->second;
}

WrittenLayout layoutOf(const std::filesystem::path& file, const pcl::PCLPointCloud2& blob) {
  WrittenLayout layout;
  for (const auto& field : blob.fields) {
    if (field.name == "_") continue;
    if (field.name == "rgb" || field.name == "rgba") {  // the bytes b, g, r, a
      layout.add("uchar", "red", field.offset + 2, 1);
      layout.add("uchar", "green", field.offset + 1, 1);
      layout.add("uchar", "blue", field.offset, 1);
      if (field.name == "rgba") layout.add("uchar", "alpha", field.offset + 3, 1);
      continue;
    }
    const char* type = typeName(field.datatype);
    if (type == nullptr) {
      throw std::runtime_error(file.string() + ": PLY has no type for the field " + field.name);
    }
    const auto bytes = static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
    const std::size_t count = std::max<std::size_t>(1, field.count);
    for (std::size_t i = 0; i < count; ++i) {
      layout.add(type, count == 1 ? field.name : field.name + "_" + std::to_string(i),
                 field.offset + i * bytes, bytes);
    }
  }
  return layout;
}

}  // namespace

void writePly(const std::filesystem::path& file, const pcl::PCLPointCloud2& blob) {
  const WrittenLayout layout = layoutOf(file, blob);
  const std::size_t points = std::size_t{blob.width} * blob.height;
  std::ofstream out(file, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\n";
  if (blob.height > 1) {
    out << "obj_info num_cols " << blob.width << "\nobj_info num_rows " << blob.height << "\n";
  }
  out << "element vertex " << points << "\n" << layout.properties << "end_header\n";
  std::string row;
  for (std::size_t i = 0; i < points && out; ++i) {
    const char* point = reinterpret_cast<const char*>(&blob.data[i * blob.point_step]);
    row.clear();
    for (const Piece& piece : layout.pieces) row.append(point + piece.offset, piece.bytes);
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": the cloud cannot be written");
}

}  // namespace heel
