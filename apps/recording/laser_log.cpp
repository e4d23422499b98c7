// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/bags/bag_laser_log.hpp>
#include <heel/apps/recording/folders/simulated_laser_log.hpp>
#include <heel/apps/recording/laser_log.hpp>
#include <heel/cloud/files.hpp>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
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

/// What scanners of that time report when nothing came back is 81.9 m and the like.
constexpr double kNothing_m = 80.0;
constexpr int kMostBeams = 10000;
/// Of characters; the longest scan has 10000 ranges.
constexpr std::size_t kLongestLine = 1U << 20U;
/// Two poses that are no further apart are one, written with few digits [m, rad].
constexpr double kSame = 0.01;
/// No robot of these logs is faster [m/s, rad/s].
constexpr double kFastest = 4.0;

double apart(const FloorPose& pose) {
  return std::max(pose.position.norm(), std::abs(wrapped(pose.yaw_rad)));
}

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

  std::string at(const char* what) const {
    return name + ":" + std::to_string(line_number) + ": " + what;
  }
  [[noreturn]] void fail(const char* what) const { throw std::runtime_error(at(what)); }
  void leaveOut(const std::string& why) {
    if (left_out++ == 0) why_left_out = why;
  }

  /// False at the end, or where the file can't be read on.
  bool nextLine() {
    line.clear();
    ++line_number;
    std::array<char, 4096> part;
    while (gzgets(file, part.data(), static_cast<int>(part.size())) != nullptr) {
      line += part.data();
      if (part.front() == '\0' || line.size() > kLongestLine) {
        leaveOut(at("this is no line of a log"));
        return false;
      }
      rest = line;
      if (line.back() == '\n') return true;
    }
    int problem = Z_OK;
    gzerror(file, &problem);
    const bool is_broken = problem != Z_OK && problem != Z_STREAM_END;
    if (is_broken) leaveOut(at("the compressed stream is broken"));
    return !line.empty() && !is_broken;
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

  /// May be infinite, or none.
  double anyNumber() {
    const std::string_view text = word();
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail("a number is missing or broken");
    }
    return value;
  }

  double number() {
    const double value = anyNumber();
    if (!std::isfinite(value)) fail("a number is not finite");
    return value;
  }

  FloorPose pose() {
    const double x = number(), y = number(), yaw = number();
    return {{x, y}, wrapped(yaw)};
  }

  /// A line of a scan, of the kind that came first; false if it is another. The rest of it is read.
  bool scanLine(std::string_view kind) {
    const bool is_new = kind == "ROBOTLASER1";
    if (!is_new && kind != "FLASER") return false;
    if (!scan_kind.empty() && kind != scan_kind) return false;
    double first_rad = -M_PI / 2.0, step_rad = 0.0, most_m = kNothing_m;
    if (is_new) {
      number();  // the laser's type
      first_rad = number();
      number();  // its field of view
      step_rad = number();
      most_m = number();
      number();  // accuracy and
      number();  // remission
    }
    const double beams = number();
    if (!(beams >= 2.0) || beams > kMostBeams) fail("a scan must have 2 to 10000 beams");
    const auto count = static_cast<std::size_t>(beams);
    // 180 or 360 beams leave out the last of 181 or 361; an odd number has both ends.
    if (!is_new) step_rad = M_PI / static_cast<double>(count % 2 == 0 ? count : count - 1);
    if (!(std::abs(step_rad) > 0.0)) fail("a scan's beams have no angle between them");
    scan.first_rad = first_rad;
    scan.step_rad = step_rad;
    scan.ranges_m.resize(count);
    for (float& range : scan.ranges_m) {
      const double range_m = anyNumber();
      range =
          range_m < most_m ? static_cast<float>(range_m) : std::numeric_limits<float>::infinity();
    }
    const double remissions = is_new ? number() : 0.0;
    if (remissions > kMostBeams) fail("a scan must have no more than 10000 remissions");
    for (int left = static_cast<int>(std::max(remissions, 0.0)); left > 0; --left) word();
    laser = pose();
    robot = pose();
    for (int left = is_new ? 5 : 0; left > 0; --left) word();  // speeds and safe distances
    stamp_s = number();
    scan_kind = kind;
    return true;
  }

  /// Takes in a line; true if it is a scan.
  bool takeLine() {
    const std::string_view kind = word();
    if (kind == "ODOM") {
      const FloorPose now = pose();
      for (int left = 3; left > 0; --left) word();  // speeds and acceleration
      const std::string_view time = word();
      double time_s = 0.0;
      std::from_chars(time.data(), time.data() + time.size(), time_s);
      if (anchored) odometry = odometry * (anchor.inverse() * now);
      anchor = now;
      anchor_s = time_s;
      anchored = has_odometry = true;
    } else if (kind == "PARAM" && word() == "robot_frontlaser_offset") {
      laser_ahead_m = number();
    } else if (scanLine(kind)) {
      jump = anchored ? anchor.inverse() * robot : FloorPose{};
      jump_s = stamp_s - anchor_s;
      if (!is_corrected) odometry = odometry * jump;
      anchor = robot;
      anchor_s = stamp_s;
      return anchored = true;
    }
    return false;
  }

  /// Reads on to the next scan, and goes along with the odometry; false at the end. Lines that are
  /// broken are left out.
  bool nextScan() {
    while (nextLine()) {
      try {
        if (takeLine()) return true;
      } catch (const std::runtime_error& error) {
        leaveOut(error.what());
      }
    }
    return false;
  }

  std::string name;
  gzFile file = nullptr;
  std::string line;
  std::string_view rest;
  long line_number = 0;
  bool is_corrected = false;
  std::string scan_kind;  // Of the first scan; in the other form they would come again.
  FloorPose anchor;  // The pose that the next line of odometry is an increment to, and its time.
  double anchor_s = 0.0;
  bool anchored = false, has_odometry = false;
  FloorPose odometry;
  double laser_ahead_m = 0.0;
  // Of the last scan:
  LaserScan scan;
  FloorPose laser, robot, jump;
  double stamp_s = 0.0, jump_s = 0.0;
  long left_out = 0;         // So many lines,
  std::string why_left_out;  // of the first.
};

// What kind of log it is shows in all of it.
CarmenLog::CarmenLog(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {
  State all(file);
  std::optional<FloorPose> first;
  bool differs = false;
  int scans = 0, jumps = 0;
  for (; all.nextScan(); ++scans) {
    jumps += apart(all.jump) > kSame && apart(all.jump) > kFastest * std::abs(all.jump_s);
    const FloorPose T_robot_laser = all.robot.inverse() * all.laser;
    if (!first) first = T_robot_laser;
    differs |= apart(first->inverse() * T_robot_laser) > 2.0 * kSame;
  }
  if (!first && all.left_out > 0) throw std::runtime_error(all.why_left_out);
  if (all.left_out > 0) {
    lost_ = all.why_left_out + " (left out: " + std::to_string(all.left_out) +
            (all.left_out > 1 ? " lines)" : " line)");
  }
  if (differs) {  // What differs from the reference is the raw odometry.
    reference_ = Reference::kLaser;
    T_base_scanner_ = {{all.laser_ahead_m, 0.0}, 0.0};
    return;
  }
  // Wheels slip now and then, and drivers start again.
  state_->is_corrected = jumps > 0 && 2 * jumps >= scans;
  if (first) T_base_scanner_ = *first;
  if (state_->is_corrected || !all.has_odometry) reference_ = Reference::kRobot;
}
CarmenLog::~CarmenLog() = default;

bool CarmenLog::next(LaserReading& reading) {
  State& s = *state_;
  if (!s.nextScan()) return false;
  reading.stamp_s = s.stamp_s;
  reading.scan = s.scan;
  reading.odometry = s.odometry;
  reading.reference.reset();
  if (reference_ == Reference::kRobot) reading.reference = s.robot;
  if (reference_ == Reference::kLaser) reading.reference = s.laser * T_base_scanner_.inverse();
  return true;
}

}  // namespace heel
