// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/ply_header.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

PlyProperty propertyOf(const std::string& type, const std::string& name) {
  static const std::map<std::string, PlyProperty> kTypes = {
      {"char", {{}, "int8", 1}},       {"uchar", {{}, "uint8", 1}},
      {"short", {{}, "int16", 2}},     {"ushort", {{}, "uint16", 2}},
      {"int", {{}, "int32", 4}},       {"uint", {{}, "uint32", 4}},
      {"float", {{}, "float32", 4}},   {"double", {{}, "float64", 8}},
      {"int8", {{}, "int8", 1}},       {"uint8", {{}, "uint8", 1}},
      {"int16", {{}, "int16", 2}},     {"uint16", {{}, "uint16", 2}},
      {"int32", {{}, "int32", 4}},     {"uint32", {{}, "uint32", 4}},
      {"float32", {{}, "float32", 4}}, {"float64", {{}, "float64", 8}}};
  const auto known = kTypes.find(type);
  PlyProperty property = known == kTypes.end() ? PlyProperty{} : known->second;
  property.name = name;
  return property;
}

}  // namespace

PlyHeader readPlyHeader(const fs::path& file) {
  if (!fs::exists(file)) fail(file, "the cloud is missing");
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) fail(file, "the cloud cannot be read");
  std::string line;
  const auto next = [&] {
    if (!std::getline(in, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  };
  if (!next() || line != "ply") fail(file, "this is not a PLY file");
  PlyHeader header;
  bool has_format = false, in_vertices = false;
  int elements = 0;
  while (next()) {
    std::istringstream words(line);
    std::string keyword, first, second;
    words >> keyword >> first;
    if (keyword == "end_header") {
      if (!has_format) fail(file, "the PLY header is damaged");
      header.bytes = static_cast<std::size_t>(in.tellg());
      return header;
    }
    if (keyword == "format") {
      has_format =
          first == "ascii" || first == "binary_little_endian" || first == "binary_big_endian";
      header.is_binary = first != "ascii";
    } else if (keyword == "element") {
      in_vertices = first == "vertex";
      if (in_vertices && !(words >> header.vertices)) fail(file, "the PLY header is damaged");
      if (in_vertices) header.vertices_first = elements == 0;
      ++elements;
    } else if (keyword == "property" && in_vertices) {
      if (!(words >> second)) fail(file, "the PLY header is damaged");
      header.columns.push_back(propertyOf(first, second));
    }
  }
  fail(file, "the PLY header is damaged (it has no end)");
}

void checkPlySize(const fs::path& file, const PlyHeader& header) {
  if (!header.vertices_first) return;
  std::size_t bytes = 0;  // of a vertex, at least
  for (const PlyProperty& column : header.columns) {
    bytes += header.is_binary ? column.bytes : 2;  // a digit and a blank or the line's end
  }
  const std::size_t room = fs::file_size(file) - header.bytes + (header.is_binary ? 0 : 1);
  if (bytes > 0 && header.vertices > room / bytes) {
    fail(file, "the cloud is truncated (" + std::to_string(room) + " bytes for " +
                   std::to_string(header.vertices) + " points)");
  }
}

}  // namespace heel
