// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/clouds/ply_file.hpp>
#include <heel/cloud/files.hpp>

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failHeader(const fs::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

/// 0 if there is no such type.
std::uint8_t typeOf(const std::string& name) {
  using Field = pcl::PCLPointField;
  static const std::map<std::string, std::uint8_t> kTypes = {
      {"char", Field::INT8},      {"int8", Field::INT8},       {"uchar", Field::UINT8},
      {"uint8", Field::UINT8},    {"short", Field::INT16},     {"int16", Field::INT16},
      {"ushort", Field::UINT16},  {"uint16", Field::UINT16},   {"int", Field::INT32},
      {"int32", Field::INT32},    {"uint", Field::UINT32},     {"uint32", Field::UINT32},
      {"float", Field::FLOAT32},  {"float32", Field::FLOAT32}, {"double", Field::FLOAT64},
      {"float64", Field::FLOAT64}};
  const auto known = kTypes.find(name);
  return known == kTypes.end() ? std::uint8_t{0} : known->second;
}

/// A whole number from 0 on; nothing else is taken.
bool takeNumber(const std::string& word, std::size_t& number) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end;
}

/// False if the words after "property" are none.
bool takeProperty(std::istringstream& words, PlyProperty& property) {
  std::string type, count_type;
  words >> type;
  if (type == "list") {
    words >> count_type >> type;
    property.count_type = typeOf(count_type);
    const bool is_whole = property.count_type != pcl::PCLPointField::FLOAT32 &&
                          property.count_type != pcl::PCLPointField::FLOAT64;
    if (!property.isList() || !is_whole) return false;
  }
  property.type = typeOf(type);
  return property.type != 0 && words >> property.name;
}

/// False if the words of a line are none of a header's.
bool takeLine(const std::string& line, PlyHeader& header) {
  std::istringstream words(line);
  std::string keyword, name, number;
  words >> keyword;
  if (keyword == "property") {
    if (header.elements.empty()) return false;
    return takeProperty(words, header.elements.back().properties.emplace_back());
  }
  words >> name >> number;
  if (keyword == "element") {
    header.elements.push_back({name, 0, {}});
    return takeNumber(number, header.elements.back().count);
  }
  if (keyword == "format") {
    header.is_binary = name != "ascii";
    header.is_big_endian = name == "binary_big_endian";
    return !header.is_binary || header.is_big_endian || name == "binary_little_endian";
  }
  if (keyword == "obj_info" && name == "num_cols") return takeNumber(number, header.columns);
  if (keyword == "obj_info" && name == "num_rows") return takeNumber(number, header.rows);
  return true;  // a comment
}

}  // namespace

const PlyElement* PlyHeader::find(const std::string& name) const {
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&](const PlyElement& element) { return element.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader readPlyHeader(const fs::path& file) {
  if (!fs::exists(file)) failHeader(file, "the cloud is missing");
  checkIsFile(file);
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) failHeader(file, "the cloud cannot be read");
  std::string line;
  const auto next = [&] {
    if (!std::getline(in, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  };
  if (!next() || line != "ply") failHeader(file, "this is not a PLY file");
  PlyHeader header;
  bool has_format = false;
  while (next()) {
    if (line.rfind("end_header", 0) == 0) {
      if (!has_format) failHeader(file, "the PLY header is damaged");
      header.bytes = static_cast<std::size_t>(in.tellg());
      return header;
    }
    if (!takeLine(line, header))
      failHeader(file, "the PLY header is damaged ('" + line.substr(0, 60) + "')");
    has_format = has_format || line.rfind("format", 0) == 0;
  }
  failHeader(file, "the PLY header is damaged (it has no end)");
}

}  // namespace heel
