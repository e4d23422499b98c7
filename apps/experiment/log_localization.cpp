// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/experiment/log_localization.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/mapping/scan_map.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

std::size_t countScans(const std::filesystem::path& path, const BagTopics& topics) {
  const auto log = openLaserLog(path, topics);
  LaserReading reading;
  std::size_t count = 0;
  while (log->next(reading)) ++count;
  return count;
}

bool makesMap(MapScans which, std::size_t scan, std::size_t count) {
  switch (which) {
    case MapScans::kEven:
      return scan % 2 == 0;
    case MapScans::kFirstHalf:
      return scan < count / 2;
    case MapScans::kAll:
      break;
  }
  return true;
}

/// Errors against the reference.
class Errors {
 public:
  void add(const FloorPose& estimate, const FloorPose& reference) {
    off_m_.push_back((estimate.position - reference.position).norm());
    const double turn = wrapped(estimate.yaw_rad - reference.yaw_rad);
    square_m_ += off_m_.back() * off_m_.back();
    square_rad_ += turn * turn;
  }

  void into(LogLocalizationResult& result) {
    result.compared = static_cast<int>(off_m_.size());
    if (off_m_.empty()) return;
    const auto count = static_cast<double>(off_m_.size());
    result.rms_m = std::sqrt(square_m_ / count);
    result.rms_rad = std::sqrt(square_rad_ / count);
    std::sort(off_m_.begin(), off_m_.end());
    result.median_m = off_m_[off_m_.size() / 2];
    result.worst_m = off_m_.back();
  }

 private:
  std::vector<double> off_m_;
  double square_m_ = 0.0, square_rad_ = 0.0;
};

}  // namespace

OccupancyGrid mapFromLog(const std::filesystem::path& path, MapScans which, double cell_size_m,
                         const FloorPose& T_base_scanner, const BagTopics& topics) {
  const std::size_t count = countScans(path, topics);
  const auto log = openLaserLog(path, topics);
  ScanMapParams params;
  params.cell_size_m = cell_size_m;
  ScanMap map(params);
  LaserReading reading;
  for (std::size_t i = 0; log->next(reading); ++i) {
    if (!makesMap(which, i, count)) continue;
    if (!reading.reference) {
      throw std::runtime_error(path.string() +
                               ": has no reference poses to make a map with; name a map (--map)");
    }
    try {
      map.add(*reading.reference * T_base_scanner, reading.scan);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path.string() + ": " + error.what());
    }
  }
  if (count == 0) throw std::runtime_error(path.string() + ": has no laser scans");
  OccupancyGrid grid = map.grid();
  const std::vector<Occupancy>& cells = grid.cells();
  if (std::find(cells.begin(), cells.end(), Occupancy::kFree) == cells.end()) {
    throw std::runtime_error(path.string() + ": its scans show no free floor");
  }
  return grid;
}

LogLocalizationResult localizeLog(const std::filesystem::path& path, const OccupancyGrid& map,
                                  const LogLocalizationParams& params,
                                  const std::function<void(const LogLocalizationStep&)>& each,
                                  const std::function<void(const std::function<void()>&)>& work) {
  const bool fair = params.left_out && *params.left_out != MapScans::kAll;
  const std::size_t count = fair ? countScans(path, params.topics) : 0;
  const auto log = openLaserLog(path, params.topics);
  Localization localization(map, params.T_base_scanner, params.localization);
  LogLocalizationResult result;
  Errors errors;
  LaserReading reading;
  FloorPose last_odometry, drift;
  double begin_s = 0.0;
  bool started = false;
  int lost = 0;
  for (std::size_t i = 0; log->next(reading); ++i) {
    if (isStopRequested()) {
      result.complete = false;
      break;
    }
    if (fair && makesMap(*params.left_out, i, count)) continue;
    const FloorPose increment = last_odometry.inverse() * reading.odometry;
    last_odometry = reading.odometry;
    if (!started) {
      if (!params.global) {
        const auto start = params.start ? params.start : reading.reference;
        if (!start) {
          throw std::runtime_error(path.string() +
                                   ": say where the robot starts (--start), or that it may be "
                                   "anywhere (--global)");
        }
        localization.startAt(*start);
      }
      if (reading.reference) drift = *reading.reference * reading.odometry.inverse();
      begin_s = reading.stamp_s;
      started = true;
    } else {
      localization.predict(increment);
      result.way_m += increment.position.norm();
    }
    bool weighed = false;
    work([&] { weighed = localization.update(reading.scan); });
    const LocalizationEstimate& estimate = localization.estimate();
    ++result.scans;
    result.weighed += weighed ? 1 : 0;
    lost += estimate.lost ? 1 : 0;
    if (reading.reference) {
      const auto off_m = (estimate.pose.position - reading.reference->position).norm();
      if (!estimate.lost) errors.add(estimate.pose, *reading.reference);
      if (!estimate.lost && off_m < 0.5 && result.first_right_s < 0.0) {
        result.first_right_s = reading.stamp_s - begin_s;
      }
      result.odometry_error_m =
          ((drift * reading.odometry).position - reading.reference->position).norm();
    }
    each({reading.stamp_s, estimate, reading.reference, localization.particles().size()});
  }
  result.lost_share = static_cast<double>(lost) / std::max(result.scans, 1);
  errors.into(result);
  return result;
}

}  // namespace heel
