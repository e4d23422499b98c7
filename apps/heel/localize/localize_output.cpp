// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>
#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/localize/localize_output.hpp>
#include <heel/apps/pictures/drawing.hpp>
#include <heel/apps/results/result_files.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace heel {
namespace {}  // namespace

LocalizeOutput::LocalizeOutput(const std::filesystem::path& folder, const OccupancyGrid& map,
                               const std::vector<std::filesystem::path>& inputs)
    : output_({"localize",
               OutputKind::kFolder,
               folder,
               inputs,
               {"poses.csv", "path.png", "summary.json"}}),
      map_(map),
      poses_(output_ / "poses.csv",
             {"stamp_s", "x_m", "y_m", "yaw_rad", "std_x_m", "std_y_m", "std_yaw_rad", "lost",
              "fit", "particles", "reference_x_m", "reference_y_m", "reference_yaw_rad"}) {}

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
  Place place{e.pose.position, e.lost, {}};
  if (step.reference) place.reference = step.reference->position;
  places_.push_back(place);
}

void LocalizeOutput::drawWays() const {
  // Only the part of the map that holds something.
  GridCell low{map_.width(), map_.height()}, high{-1, -1};
  for (GridCell c; c.y < map_.height(); ++c.y) {
    for (c.x = 0; c.x < map_.width(); ++c.x) {
      if (map_.at(c) == Occupancy::kUnknown) continue;
      low = {std::min(low.x, c.x), std::min(low.y, c.y)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y)};
    }
  }
  if (high.x < 0) return;
  constexpr int kBorder = 12;
  const int cells = std::max(high.x - low.x, high.y - low.y) + 1;
  const double scale = std::clamp(1400.0 / cells, 0.5, 6.0);
  const auto pixels = [&](int from, int to) {
    return static_cast<int>(std::ceil((to - from + 1) * scale)) + 2 * kBorder;
  };
  cv::Mat picture(pixels(low.y, high.y), pixels(low.x, high.x), CV_8UC3, palette::kPaper);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const GridCell c{low.x + static_cast<int>(std::floor((u - kBorder) / scale)),
                       high.y - static_cast<int>(std::floor((v - kBorder) / scale))};
      if (!map_.contains(c) || map_.at(c) == Occupancy::kUnknown) continue;
      const cv::Scalar& color = map_.at(c) == Occupancy::kFree ? palette::kPanelLit : palette::kInk;
      for (int k = 0; k < 3; ++k) {
        picture.at<cv::Vec3b>(v, u)[k] = static_cast<std::uint8_t>(color[k]);
      }
    }
  }
  const auto at = [&](const Eigen::Vector2d& place) {
    const Eigen::Vector2d cell = (place - map_.origin_m()) / map_.cell_size_m();
    return cv::Point2d(kBorder + (cell.x() - low.x) * scale,
                       kBorder + (high.y + 1 - cell.y()) * scale);
  };
  constexpr double kJump_m = 1.5;  // The estimate found itself elsewhere: no way was gone.
  for (std::size_t i = 1; i < places_.size(); ++i) {
    const Place &a = places_[i - 1], &b = places_[i];
    if (a.reference && b.reference) {
      drawLine(picture, at(*a.reference), at(*b.reference), palette::kGood, 2);
    }
  }
  for (std::size_t i = 1; i < places_.size(); ++i) {
    const Place &a = places_[i - 1], &b = places_[i];
    if ((a.estimate - b.estimate).norm() > kJump_m) continue;
    drawLine(picture, at(a.estimate), at(b.estimate), b.lost ? palette::kBad : palette::kTrack);
  }
  drawText(picture, "reference", {kBorder, picture.rows - 52}, palette::kGood);
  drawText(picture, "estimate", {kBorder, picture.rows - 34}, palette::kTrack);
  drawText(picture, "lost", {kBorder, picture.rows - 16}, palette::kBad);
  writePicture(output_ / "path.png", picture);
}

void LocalizeOutput::commit(const LogLocalizationResult& result, double updates_per_s) {
  poses_.close();
  drawWays();
  nlohmann::ordered_json summary{{"complete", result.complete},     {"scans", result.scans},
                                 {"weighed", result.weighed},       {"way_m", result.way_m},
                                 {"lost_share", result.lost_share}, {"compared", result.compared}};
  if (result.compared > 0) {
    summary["rms_m"] = result.rms_m;
    summary["rms_deg"] = result.rms_rad * kDegrees;
    summary["median_m"] = result.median_m;
    summary["worst_m"] = result.worst_m;
    summary["odometry_error_m"] = result.odometry_error_m;
    summary["first_right_s"] = result.first_right_s;
  }
  summary["updates_per_s"] = updates_per_s;
  writeJson(output_ / "summary.json", summary);
  output_.commit(result.complete);
}

}  // namespace heel
