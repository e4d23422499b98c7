// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A strict reader of YAML maps: whatever is wrong gets one sentence with file, line and key.
#pragma once

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace heel {

/// The numbers that a key may have.
struct NumberRange {
  double low = -1e6;
  double high = 1e6;
  bool open_low = false;  ///< `low` itself is not allowed.
};
constexpr NumberRange kPositive{0.0, 1e6, true};
constexpr NumberRange kNotNegative{0.0, 1e6, false};
constexpr NumberRange kShare{0.0, 1.0, false};

/// One map of a YAML file. Every key that is asked for counts as known; `done()` refuses the rest.
///
/// All errors are std::runtime_error: "FILE, line N: KEY of WHAT REASON".
class YamlMap {
 public:
  /// @param what  Names the map in messages, e.g. "wall".
  YamlMap(const YAML::Node& node, std::string file, std::string what);

  /// Reads a file whose top is a map.
  static YamlMap fromFile(const std::string& file, const std::string& what);

  bool has(const std::string& key);

  double number(const std::string& key, NumberRange range = {});
  double number(const std::string& key, double fallback, NumberRange range = {});
  int integer(const std::string& key, int fallback, int low, int high);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key);
  std::string text(const std::string& key, const std::string& fallback);
  Eigen::Vector2d point2(const std::string& key);
  Eigen::Vector3d point3(const std::string& key);
  Eigen::Vector3d point3(const std::string& key, const Eigen::Vector3d& fallback);

  /// The place of `key`'s value in `names`, e.g. of an enum; `fallback` where the key is absent.
  int choice(const std::string& key, std::initializer_list<const char*> names, int fallback);

  /// The map under `key`; nothing if it is absent.
  std::optional<YamlMap> map(const std::string& key, const std::string& what);
  /// The list of maps under `key`; empty if it is absent.
  std::vector<YamlMap> list(const std::string& key, const std::string& what);
  /// The keys of this map, all counted as known.
  std::vector<std::string> keys();

  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;
  /// @throws std::runtime_error  naming the first key that nothing asked for.
  void done() const;

  const std::string& file() const { return file_; }

 private:
  YAML::Node value(const std::string& key);
  double numberOf(const YAML::Node& node, const std::string& key, NumberRange range) const;
  std::vector<double> numbers(const std::string& key, std::size_t count);

  YAML::Node node_;
  std::string file_;
  std::string what_;
  std::set<std::string> known_;
};

}  // namespace heel
