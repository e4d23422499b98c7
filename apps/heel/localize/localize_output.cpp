// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/localize/localize_output.hpp>
#include <heel/apps/results/result_files.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace heel {

LocalizeOutput::LocalizeOutput(const std::filesystem::path& folder, const OccupancyGrid& map,
                               const std::vector<std::filesystem::path>& inputs)
    : output_({"localize",
               OutputKind::kFolder,
               folder,
               inputs,
               {"report.html", "poses.csv", "summary.json"}}),
      map_(map),
      poses_(output_ / "poses.csv",
             {"stamp_s", "x_m", "y_m", "yaw_rad", "std_x_m", "std_y_m", "std_yaw_rad", "lost",
              "fit", "particles", "reference_x_m", "reference_y_m", "reference_yaw_rad"}) {
  if (!inputs.empty()) log_.name = inputs.front().filename().string();
}

void LocalizeOutput::add(const LogLocalizationStep& step) {
  const LocalizationEstimate& e = step.estimate;
  const Eigen::Vector3d deviation = e.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double none = std::nan("");
  poses_.number(step.stamp_s, 3)
      .number(e.pose.position.x(), 4)
      .number(e.pose.position.y(), 4)
      .number(e.pose.yaw_rad, 5)
      .number(deviation.x(), 4)
      .number(deviation.y(), 4)
      .number(deviation.z(), 5)
      .flag(e.lost)
      .number(e.fit, 3)
      .integer(static_cast<std::int64_t>(step.particles))
      .number(step.reference ? step.reference->position.x() : none, 4)
      .number(step.reference ? step.reference->position.y() : none, 4)
      .number(step.reference ? step.reference->yaw_rad : none, 5)
      .endRow();
  log_.moments.push_back({step.stamp_s, e.pose, deviation.head<2>().norm(), e.fit,
                          e.lost ? "lost" : "found", step.reference});
}

void LocalizeOutput::commit(const LogLocalizationResult& result, double updates_per_s) {
  poses_.close();
  log_.complete = result.complete;
  log_.way_m = result.way_m;
  log_.lost_share = result.lost_share;
  nlohmann::ordered_json summary{{"complete", result.complete},     {"scans", result.scans},
                                 {"weighed", result.weighed},       {"way_m", result.way_m},
                                 {"lost_share", result.lost_share}, {"compared", result.compared}};
  if (result.compared > 0) {
    log_.rms_m = result.rms_m;
    log_.rms_deg = result.rms_rad * kDegrees;
    log_.median_m = result.median_m;
    log_.worst_m = result.worst_m;
    summary["rms_m"] = result.rms_m;
    summary["rms_deg"] = result.rms_rad * kDegrees;
    summary["median_m"] = result.median_m;
    summary["worst_m"] = result.worst_m;
    summary["odometry_error_m"] = result.odometry_error_m;
    summary["first_right_s"] = result.first_right_s;
  }
  summary["updates_per_s"] = updates_per_s;
  writeJson(output_ / "summary.json", summary);
  writeFile(output_ / "report.html", localizePage(log_, map_));
  output_.commit(result.complete);
}

}  // namespace heel
