// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_laser_log.hpp>
#include <heel/apps/recording/folders/simulated_laser_log.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/cloud/files.hpp>

#include <zlib.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace heel {

std::unique_ptr<LaserLog> openLaserLog(const std::filesystem::path& path, const BagTopics& topics) {
  if (!std::filesystem::exists(path)) throw std::runtime_error(path.string() + ": does not exist");
  if (isBag(path)) return std::make_unique<BagLaserLog>(path, topics);
  if (!std::filesystem::is_directory(path)) return std::make_unique<CarmenLog>(path);
  if (!std::filesystem::exists(path / "scan.csv")) {
    throw std::runtime_error(path.string() + ": has no laser scans (scan.csv)");
  }
  return std::make_unique<SimulatedLaserLog>(path);
}

namespace {

constexpr double kPi = 3.14159265358979323846;
/// What scanners of that time report when nothing came back is 81.9 m and the like.
constexpr float kNothing_m = 80.0F;
constexpr int kMostBeams = 10000;
/// Of characters; the longest scan has 10000 ranges.
constexpr std::size_t kLongestLine = 1U << 20U;

}  // namespace

struct CarmenLog::State {
  explicit State(const std::filesystem::path& path) : name(path.string()) {
    checkIsFile(path);
    file = gzopen(path.c_str(), "rb");
    if (file == nullptr) throw std::runtime_error(name + ": can't be opened");
  }
  ~State() { gzclose(file); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  [[noreturn]] void fail(const char* what) const {
    throw std::runtime_error(name + ":" + std::to_string(line_number) + ": " + what);
  }

  bool nextLine() {
    line.clear();
    ++line_number;
    std::array<char, 4096> part;
    while (gzgets(file, part.data(), static_cast<int>(part.size())) != nullptr) {
      line += part.data();
      if (part.front() == '\0' || line.size() > kLongestLine) fail("this is no line of a log");
      if (!line.empty() && line.back() == '\n') break;
    }
    int problem = Z_OK;
    gzerror(file, &problem);
    if (problem != Z_OK && problem != Z_STREAM_END) fail("the compressed stream is broken");
    rest = line;
    return !line.empty();
  }

  std::string_view word() {
    const auto begin = rest.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return {};
    rest.remove_prefix(begin);
    const auto end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
    const std::string_view result = rest.substr(0, end);
    rest.remove_prefix(end);
    return result;
  }

  double number() {
    const std::string_view text = word();
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      fail("a number is missing or broken");
    }
    return value;
  }

  FloorPose pose() {
    const double x = number(), y = number(), yaw = number();
    return {{x, y}, wrapped(yaw)};
  }

  void chain(const FloorPose& now) {
    if (anchored) odometry = odometry * (anchor.inverse() * now);
    anchor = now;
    anchored = true;
  }

  std::string name;
  gzFile file = nullptr;
  std::string line;
  std::string_view rest;
  long line_number = 0;
  FloorPose anchor;  // The pose that the next ODOM line is an increment to.
  bool anchored = false;
  FloorPose odometry;
};

CarmenLog::CarmenLog(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {}
CarmenLog::~CarmenLog() = default;

bool CarmenLog::next(LaserReading& reading) {
  State& s = *state_;
  while (s.nextLine()) {
    const std::string_view kind = s.word();
    if (kind == "ODOM") s.chain(s.pose());
    if (kind != "FLASER") continue;
    const double beams = s.number();
    if (!(beams >= 2.0) || beams > kMostBeams) s.fail("a scan must have 2 to 10000 beams");
    const auto count = static_cast<std::size_t>(beams);
    reading.scan.first_rad = -kPi / 2.0;
    // 180 or 360 beams leave out the last of 181 or 361; an odd number has both ends.
    reading.scan.step_rad = kPi / static_cast<double>(count % 2 == 0 ? count : count - 1);
    reading.scan.ranges_m.resize(count);
    for (float& range : reading.scan.ranges_m) {
      range = static_cast<float>(s.number());
      if (range >= kNothing_m) range = std::numeric_limits<float>::infinity();
    }
    const FloorPose at = s.pose();
    s.pose();  // What the odometry thought, which a correction has overwritten.
    reading.stamp_s = s.number();
    reading.odometry = s.odometry;
    reading.reference = at;
    s.anchor = at;
    s.anchored = true;
    return true;
  }
  return false;
}

}  // namespace heel
