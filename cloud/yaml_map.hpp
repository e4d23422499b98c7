// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A strict reader of YAML maps: whatever is wrong gets one sentence with file, line and key.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace YAML {
class Node;
}

namespace heel {

/// The numbers that a key may have.
struct NumberRange {
  double low = -1e6;      ///< The lowest.
  double high = 1e6;      ///< The highest.
  bool open_low = false;  ///< `low` itself is not allowed.
};
constexpr NumberRange kPositive{0.0, 1e6, true};      ///< More than 0.
constexpr NumberRange kNotNegative{0.0, 1e6, false};  ///< 0 or more.
constexpr NumberRange kShare{0.0, 1.0, false};        ///< 0 to 1.

/// One map of a YAML file. Every key that is asked for counts as known; `done()` refuses the rest.
///
/// All errors are std::runtime_error: "FILE, line N: KEY of the WHAT REASON". A getter without a
/// `fallback` refuses a map without the key.
class YamlMap {
 public:
  /// Reads a file whose top is a map.
  /// @param what  Names the map in messages, e.g. "scene".
  static YamlMap fromFile(const std::filesystem::path& file, const std::string& what);

  /// Whether the key is there; its value may not be empty.
  bool has(const std::string& key);

  /// A finite number within a range.
  double number(const std::string& key, NumberRange range = {});
  /// The same, or `fallback`.
  double number(const std::string& key, double fallback, NumberRange range = {});
  /// A whole number from `low` to `high`.
  int integer(const std::string& key, int low, int high);
  /// The same, or `fallback`.
  int integer(const std::string& key, int fallback, int low, int high);
  /// true or false.
  bool flag(const std::string& key);
  /// The same, or `fallback`.
  bool flag(const std::string& key, bool fallback);
  /// A text.
  std::string text(const std::string& key);
  /// The same, or `fallback`.
  std::string text(const std::string& key, const std::string& fallback);
  /// A list of so many texts.
  std::vector<std::string> texts(const std::string& key, std::size_t count);
  /// A list of so many numbers, within the usual range.
  std::vector<double> numbers(const std::string& key, std::size_t count);
  /// A list of x and y.
  Eigen::Vector2d point2(const std::string& key);
  /// A list of these, or, as in ROS's files, a text that is one.
  std::vector<Eigen::Vector2d> points2(const std::string& key);
  /// A list of x, y and z.
  Eigen::Vector3d point3(const std::string& key);
  /// The same, or `fallback`.
  Eigen::Vector3d point3(const std::string& key, const Eigen::Vector3d& fallback);

  /// The place of `key`'s value in `names`, e.g. of an enum; `fallback` where the key is absent.
  int choice(const std::string& key, std::initializer_list<const char*> names, int fallback);

  /// The map under `key`; nothing if it is absent.
  std::optional<YamlMap> map(const std::string& key, const std::string& what);
  /// The list of maps under `key`; empty if it is absent.
  std::vector<YamlMap> list(const std::string& key, const std::string& what);
  /// The keys of this map, all counted as known.
  std::vector<std::string> keys();

  /// Throws the sentence for a key whose value the caller can't take.
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const;
  /// @throws std::runtime_error  naming the first key that nothing asked for.
  void done() const;

  /// The file's name.
  const std::string& file() const { return file_; }

 private:
  YamlMap(const YAML::Node& node, std::string file, std::string what);
  /// The list under `key`, of `count` entries that are called so.
  YAML::Node listOf(const std::string& key, std::size_t count, const char* entries);
  YAML::Node value(const std::string& key);
  double numberOf(const YAML::Node& node, const std::string& key, NumberRange range) const;

  std::shared_ptr<const YAML::Node> node_;  // yaml-cpp stays out of the header
  std::string file_;
  std::string what_;
  std::set<std::string> known_;
};

}  // namespace heel
