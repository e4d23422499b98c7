// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/files.hpp>
#include <heel/cloud/typos.hpp>
#include <heel/cloud/yaml_map.hpp>

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

std::string show(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

[[noreturn]] void failAt(const std::string& file, const YAML::Mark& mark, const std::string& text) {
  const std::string line = mark.is_null() ? "" : ", line " + std::to_string(mark.line + 1);
  throw std::runtime_error(file + line + ": " + text);
}

}  // namespace

YamlMap::YamlMap(const YAML::Node& node, std::string file, std::string what)
    : node_(std::make_shared<const YAML::Node>(node)),
      file_(std::move(file)),
      what_(std::move(what)) {
  if (!node_->IsMap()) failAt(file_, node_->Mark(), "the " + what_ + " must be a map of keys");
  std::set<std::string> keys;
  for (const auto& entry : *node_) {
    if (!entry.first.IsScalar() || keys.insert(entry.first.Scalar()).second) continue;
    failAt(file_, entry.first.Mark(),
           "'" + entry.first.Scalar() + "' of the " + what_ + " is there twice");
  }
}

YamlMap YamlMap::fromFile(const std::filesystem::path& file, const std::string& what) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file)) throw std::runtime_error(name + ": there is no such file");
  try {
    return {YAML::Load(readWholeFile(file)), name, what};
  } catch (const YAML::Exception& error) {
    failAt(name, error.mark, "not YAML: " + error.msg);
  }
}

YAML::Node YamlMap::value(const std::string& key) {
  known_.insert(key);
  const YAML::Node found = (*node_)[key];
  if (found.IsDefined() && found.IsNull()) fail(key, "has no value");
  return found;
}

bool YamlMap::has(const std::string& key) { return value(key).IsDefined(); }

void YamlMap::fail(const std::string& key, const std::string& reason) const {
  const YAML::Node found = (*node_)[key];
  failAt(file_, found.IsDefined() ? found.Mark() : node_->Mark(),
         "'" + key + "' of the " + what_ + " " + reason);
}

double YamlMap::numberOf(const YAML::Node& node, const std::string& key, NumberRange range) const {
  double number = std::numeric_limits<double>::quiet_NaN();
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, number) || !std::isfinite(number)) {
    fail(key, "must be a number" + (node.IsScalar() ? ", not '" + node.Scalar() + "'" : ""));
  }
  if (number < range.low || (range.open_low && number <= range.low)) {
    fail(key, "is " + show(number) + ", but must be " +
                  (range.open_low ? "more than " : "at least ") + show(range.low));
  }
  if (number > range.high) {
    fail(key, "is " + show(number) + ", but must be at most " + show(range.high));
  }
  return number;
}

double YamlMap::number(const std::string& key, NumberRange range) {
  const YAML::Node found = value(key);
  if (!found.IsDefined()) fail(key, "is missing");
  return numberOf(found, key, range);
}

double YamlMap::number(const std::string& key, double fallback, NumberRange range) {
  return has(key) ? number(key, range) : fallback;
}

int YamlMap::integer(const std::string& key, int low, int high) {
  const double found = number(key, {double(low), double(high)});
  if (found != std::floor(found)) fail(key, "must be a whole number");
  return static_cast<int>(found);
}

int YamlMap::integer(const std::string& key, int fallback, int low, int high) {
  return has(key) ? integer(key, low, high) : fallback;
}

bool YamlMap::flag(const std::string& key) {
  const YAML::Node found = value(key);
  if (!found.IsDefined()) fail(key, "is missing");
  bool flag = false;
  if (!YAML::convert<bool>::decode(found, flag)) fail(key, "must be true or false");
  return flag;
}

bool YamlMap::flag(const std::string& key, bool fallback) {
  return has(key) ? flag(key) : fallback;
}

std::string YamlMap::text(const std::string& key) {
  const YAML::Node found = value(key);
  if (!found.IsDefined()) fail(key, "is missing");
  if (!found.IsScalar()) fail(key, "must be a text");
  return found.Scalar();
}

std::string YamlMap::text(const std::string& key, const std::string& fallback) {
  return has(key) ? text(key) : fallback;
}

YAML::Node YamlMap::listOf(const std::string& key, std::size_t count, const char* entries) {
  const YAML::Node found = value(key);
  if (!found.IsDefined()) fail(key, "is missing");
  if (!found.IsSequence() || found.size() != count) {
    fail(key, "must be a list of " + std::to_string(count) + " " + entries);
  }
  return found;
}

std::vector<std::string> YamlMap::texts(const std::string& key, std::size_t count) {
  std::vector<std::string> out;
  for (const YAML::Node& entry : listOf(key, count, "texts")) {
    if (!entry.IsScalar()) fail(key, "must be a list of texts");
    out.push_back(entry.Scalar());
  }
  return out;
}

std::vector<double> YamlMap::numbers(const std::string& key, std::size_t count) {
  std::vector<double> out;
  for (const YAML::Node& entry : listOf(key, count, "numbers")) {
    out.push_back(numberOf(entry, key, {}));
  }
  return out;
}

Eigen::Vector2d YamlMap::point2(const std::string& key) {
  return Eigen::Vector2d(numbers(key, 2).data());
}

std::vector<Eigen::Vector2d> YamlMap::points2(const std::string& key) {
  YAML::Node found = value(key);
  try {
    if (found.IsDefined() && found.IsScalar()) found.reset(YAML::Load(found.Scalar()));
  } catch (const YAML::Exception&) {
    found.reset();
  }
  if (!found.IsDefined() || !found.IsSequence()) fail(key, "must be a list of points");
  std::vector<Eigen::Vector2d> points;
  for (const YAML::Node& point : found) {
    if (!point.IsSequence() || point.size() != 2) fail(key, "must be a list of points, of x and y");
    points.emplace_back(numberOf(point[0], key, {}), numberOf(point[1], key, {}));
  }
  return points;
}

Eigen::Vector3d YamlMap::point3(const std::string& key) {
  return Eigen::Vector3d(numbers(key, 3).data());
}

Eigen::Vector3d YamlMap::point3(const std::string& key, const Eigen::Vector3d& fallback) {
  return has(key) ? point3(key) : fallback;
}

int YamlMap::choice(const std::string& key, std::initializer_list<const char*> names,
                    int fallback) {
  if (!has(key)) return fallback;
  const std::string wanted = text(key);
  std::string all;
  int place = 0;
  for (const char* name : names) {
    if (wanted == name) return place;
    all += (place++ == 0 ? "" : ", ") + std::string(name);
  }
  fail(key, "is '" + wanted + "', but must be one of " + all);
}

std::optional<YamlMap> YamlMap::map(const std::string& key, const std::string& what) {
  const YAML::Node found = value(key);
  if (!found.IsDefined()) return std::nullopt;
  return YamlMap(found, file_, what);
}

std::vector<YamlMap> YamlMap::list(const std::string& key, const std::string& what) {
  std::vector<YamlMap> out;
  const YAML::Node found = value(key);
  if (!found.IsDefined()) return out;
  if (!found.IsSequence()) fail(key, "must be a list");
  for (const YAML::Node& entry : found) out.push_back(YamlMap(entry, file_, what));
  return out;
}

std::vector<std::string> YamlMap::keys() {
  std::vector<std::string> out;
  for (const auto& entry : *node_) {
    if (!entry.first.IsScalar()) failAt(file_, entry.first.Mark(), "a key is no word");
    out.push_back(entry.first.Scalar());
  }
  known_.insert(out.begin(), out.end());
  return out;
}

void YamlMap::done() const {
  for (const auto& entry : *node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (known_.count(key) != 0) continue;
    std::string all, nearest;
    for (const std::string& name : known_) {
      all += (all.empty() ? "" : ", ") + name;
      if (nearest.empty() || typosBetween(key, name) < typosBetween(key, nearest)) nearest = name;
    }
    failAt(file_, entry.first.Mark(),
           "'" + key + "' is not a key of the " + what_ +
               (nearest.empty() ? "" : ", and '" + nearest + "' is nearest") + "; it can have " +
               all);
  }
}

}  // namespace heel
