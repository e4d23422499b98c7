// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/body_description.hpp>

#include <opencv2/core/types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr double kBoardHalfWidth_m = 0.12;  // Of BodyView::disparities: that of a trunk.
constexpr int kBodyPixels = 1800;     // About so many are looked at: 200 of a quarter of a metre.
constexpr int kMinStripePixels = 20;  // A stripe with fewer pixels than this counts as not seen.

using Describer = BodyDescriber;

constexpr double kDarkOffset = 12.0;

/// Ends of the stripes over the floor [m]: four of the legs, two of the trunk, and finer ones where
/// people end at different heights.
constexpr std::array<float, Describer::kStripes + 1> kEnds_m = {
    0.10F, 0.35F, 0.60F, 0.85F, 1.05F, 1.25F, 1.45F, 1.55F, 1.65F, 1.75F, 2.00F};
constexpr int kTrunk = 4;  // The first stripe of it.
/// A head is what is above this share of a stature: the chin's height, from R. Drillis and R.
/// Contini, Body segment parameters, New York University, 1966.
constexpr double kChin = 0.87;

int stripeOf(float height_m) {
  const auto above = std::upper_bound(kEnds_m.begin(), kEnds_m.end(), height_m);
  return above == kEnds_m.end() ? -1 : static_cast<int>(above - kEnds_m.begin()) - 1;
}

const std::array<float, 256>& logLevels() {
  static const std::array<float, 256> levels = [] {
    std::array<float, 256> logs{};
    for (std::size_t v = 0; v < logs.size(); ++v) {
      logs[v] = static_cast<float>(std::log(static_cast<double>(v) + kDarkOffset));
    }
    return logs;
  }();
  return levels;
}

int binOf(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  const auto& logs = logLevels();
  const auto chroma = [](float ratio) {
    const float share = (ratio / static_cast<float>(Describer::kChromaLimit) + 1.0F) * 0.5F;
    return std::clamp(static_cast<int>(share * Describer::kChromaBins), 0,
                      Describer::kChromaBins - 1);
  };
  const float light = (logs[b] + logs[g] + logs[r]) / 3.0F;
  const float share = (light - logs[0]) / (logs[255] - logs[0]);
  const int brightness = std::clamp(static_cast<int>(share * Describer::kBrightnessBins), 0,
                                    Describer::kBrightnessBins - 1);
  return (chroma(logs[r] - logs[g]) * Describer::kChromaBins + chroma(logs[b] - logs[g])) *
             Describer::kBrightnessBins +
         brightness;
}

/// Spreads a bin's share over its neighbours along one axis: 1/4, 1/2, 1/4, so that folds, noise
/// and the ends of the bins change little. What would fall off the end stays.
template <typename Column>
void smoothAxis(Column&& column, Eigen::ArrayXf& work, int bins, int stride) {
  work = column;
  for (int i = 0; i < Describer::kBins; ++i) {
    if (work[i] == 0.0F) continue;
    const int place = (i / stride) % bins;
    const float quarter = 0.25F * work[i];
    column[i] -= 2.0F * quarter;
    column[place > 0 ? i - stride : i] += quarter;
    column[place + 1 < bins ? i + stride : i] += quarter;
  }
}

template <typename Column>
void smooth(Column&& column, Eigen::ArrayXf& work) {
  smoothAxis(column, work, Describer::kBrightnessBins, 1);
  smoothAxis(column, work, Describer::kChromaBins, Describer::kBrightnessBins);
  smoothAxis(column, work, Describer::kChromaBins,
             Describer::kBrightnessBins * Describer::kChromaBins);
}

/// Where an upright board that faces the camera lies in the image. Nothing if it crosses the
/// camera's plane.
cv::Rect boardIn(const BodyView& view, const Eigen::Vector2d& place_m, double half_width_m,
                 double min_height_m, double max_height_m) {
  const Eigen::Isometry3d T_camera_base = view.T_base_camera.inverse();
  const Eigen::Vector2d towards = place_m - view.T_base_camera.translation().head<2>();
  const Eigen::Vector2d side =
      Eigen::Vector2d(-towards.y(), towards.x()) * (half_width_m / std::max(towards.norm(), 1e-6));
  Eigen::Array2d least(1e6, 1e6), most(-1e6, -1e6);
  for (const Eigen::Vector2d& foot :
       {Eigen::Vector2d(place_m + side), Eigen::Vector2d(place_m - side)}) {
    for (const double height_m : {min_height_m, max_height_m}) {
      const Eigen::Vector3d p = T_camera_base * Eigen::Vector3d(foot.x(), foot.y(), height_m);
      if (p.z() <= 0.1) return {};
      const Eigen::Array2d pixel = project(view.camera, p);
      least = least.min(pixel);
      most = most.max(pixel);
    }
  }
  const Eigen::Array2i first = least.max(-1.0).min(1e6).floor().cast<int>();
  const Eigen::Array2i last = most.max(-1.0).min(1e6).ceil().cast<int>();
  return cv::Rect(first.x(), first.y(), last.x() - first.x() + 1, last.y() - first.y() + 1) &
         cv::Rect(0, 0, view.image_bgr.cols, view.image_bgr.rows);
}

/// The picture without its upper edge and the sides of what has depth: who reaches beyond it may be
/// cut off. @param step  Only one of so many pixels is looked at.
cv::Rect withoutEdge(int first_column, int columns, int rows, int step = 1) {
  const int edge_px = StatureSample::kEdge_px + step - 1;
  return {first_column + edge_px, edge_px, columns - first_column - 2 * edge_px, rows};
}

}  // namespace

BodyDescriber::BodyDescriber(const BodyDescriberParams& params) : params_(params) {
  if (!(params.radius_m > 0.0)) {
    throw std::invalid_argument("BodyDescriberParams: the radius is not positive");
  }
}

void BodyDescriber::begin(BodyDescription& out) {
  out.colors.setZero(kBins, kStripes);
  out.stature_m.reset();
  seen_.assign(kStripes, 0);
  heights_.clear();
}

void BodyDescriber::add(int stripe, const cv::Vec3b& bgr, BodyDescription& out) {
  if (stripe < 0) return;
  out.colors(binOf(bgr[0], bgr[1], bgr[2]), stripe) += 1.0F;
  ++seen_[static_cast<std::size_t>(stripe)];
}

void BodyDescriber::finish(BodyDescription& out, double full_above) {
  for (int stripe = 0; stripe < kStripes; ++stripe) {
    const int seen = seen_[static_cast<std::size_t>(stripe)];
    auto column = out.colors.col(stripe);
    if (seen < kMinStripePixels) {
      column.setZero();
      continue;
    }
    column /= static_cast<float>(seen);
    smooth(column, smoothed_);
  }
  out.stature_m = heights_.height_m(full_above);
}

cv::Rect BodyDescriber::headOf(const BodyView& view, const WorldBlob& blob) const {
  return boardIn(view, blob.position_m, params_.radius_m, StatureSample::kLeastHeight_m,
                 StatureSample::kMostHeight_m);
}

cv::Rect BodyDescriber::boardOf(const BodyView& view, const WorldBlob& blob) const {
  return boardIn(view, blob.position_m, kBoardHalfWidth_m, static_cast<double>(kEnds_m.front()),
                 std::max(blob.max_height_m, 1.6));
}

void BodyDescriber::describe(const BodyView& view, const WorldBlob& blob, BodyDescription& out) {
  begin(out);
  const cv::Rect body = boardIn(view, blob.position_m, params_.radius_m,
                                static_cast<double>(kEnds_m.front()), StatureSample::kMostHeight_m);
  cv::Rect board;
  if (view.disparities > 0) {
    const int columns = view.image_bgr.cols - view.disparities;
    board = boardOf(view, blob) & cv::Rect(view.disparities, 0, columns, view.image_bgr.rows);
  }
  const int step = std::max(1, static_cast<int>(std::sqrt(body.area() / kBodyPixels)));
  const cv::Rect inside =
      withoutEdge(view.disparities, view.image_bgr.cols, view.image_bgr.rows, step);
  const Eigen::Matrix3f R = view.T_base_camera.linear().cast<float>();
  const Eigen::Vector3f eye = view.T_base_camera.translation().cast<float>();
  const Eigen::Vector2f place = blob.position_m.cast<float>();
  const auto radius2 = static_cast<float>(params_.radius_m * params_.radius_m);
  // Of a pixel without depth: where its ray meets the board's plane.
  const Eigen::Vector2f towards = place - eye.head<2>();
  int first = body.x + body.width, last = -1;  // column of what has a depth
  without_depth_.clear();
  for (int v = body.y; v < body.y + body.height; v += step) {
    const auto* bgr = view.image_bgr.ptr<cv::Vec3b>(v);
    const auto* depth = view.depth_m.ptr<float>(v);
    for (int u = body.x; u < body.x + body.width; u += step) {
      const Eigen::Vector3f ray =
          R * Eigen::Vector3f((static_cast<float>(u) - static_cast<float>(view.camera.cx)) /
                                  static_cast<float>(view.camera.fx),
                              (static_cast<float>(v) - static_cast<float>(view.camera.cy)) /
                                  static_cast<float>(view.camera.fy),
                              1.0F);
      const float along = ray.head<2>().dot(towards);
      const float on_board_m = eye.z() + towards.squaredNorm() / along * ray.z();
      const bool has_depth = depth[u] > 0.0F;
      const Eigen::Vector3f p = eye + depth[u] * ray;
      float height_m = on_board_m;
      if (has_depth && (p.head<2>() - place).squaredNorm() <= radius2) {
        height_m = p.z();
        heights_.add(static_cast<double>(height_m), !inside.contains(cv::Point(u, v)));
        first = std::min(first, u);
        last = std::max(last, u);
      } else {
        // What is near has a depth.
        const bool may_be_near =
            has_depth ? depth[u] * along < towards.squaredNorm() : u < view.disparities;
        if (!may_be_near) heights_.addBehind(static_cast<double>(on_board_m));
        if (!has_depth && along > 0.0F && board.contains(cv::Point(u, v))) {
          without_depth_.push_back({u, stripeOf(height_m), bgr[u]});
        }
        continue;
      }
      add(stripeOf(height_m), bgr[u], out);
    }
  }
  for (const BoardPixel& pixel : without_depth_) {
    if (pixel.column > first && pixel.column < last) add(pixel.stripe, pixel.bgr, out);
  }
  // Pixels that are looked at, to a square metre of the board.
  const double per_m2 =
      view.camera.fx * view.camera.fy /
      ((view.T_base_camera.translation().head<2>() - blob.position_m).squaredNorm() * step * step);
  finish(out, 2.0 * params_.radius_m * StatureSample::kAbove_m * per_m2);
}

void BodyDescriber::describe(const ColorCloud& cloud, const Eigen::Vector2d& position_m,
                             BodyDescription& out, const pcl::Indices* indices) {
  begin(out);
  const Eigen::Vector2f place = position_m.cast<float>();
  const auto radius2 = static_cast<float>(params_.radius_m * params_.radius_m);
  const cv::Rect inside =
      withoutEdge(0, static_cast<int>(cloud.width), static_cast<int>(cloud.height));
  const auto visit = [&](std::size_t i) {
    const pcl::PointXYZRGB& p = cloud[i];
    if (!((Eigen::Vector2f(p.x, p.y) - place).squaredNorm() <= radius2)) return;  // or NaN
    const auto pixelOf = [&] {
      return cv::Point(static_cast<int>(i % cloud.width), static_cast<int>(i / cloud.width));
    };
    heights_.add(static_cast<double>(p.z), cloud.height > 1 && !inside.contains(pixelOf()));
    add(stripeOf(p.z), {p.b, p.g, p.r}, out);
  };
  if (indices != nullptr) {
    for (const auto i : *indices) visit(static_cast<std::size_t>(i));
  } else {
    for (std::size_t i = 0; i < cloud.size(); ++i) visit(i);
  }
  finish(out);
}

double BodyDescriber::middleOf_m(int stripe) {
  const auto i = static_cast<std::size_t>(stripe);
  return 0.5 * static_cast<double>(kEnds_m[i] + kEnds_m[i + 1]);
}

int BodyDescriber::garmentOf(int stripe, double stature_m) {
  return stripe < kTrunk ? 0 : middleOf_m(stripe) < kChin * stature_m ? 1 : 2;
}

Eigen::ArrayXf BodyDescriber::binsOf(const ColorHistogram& colors) {
  Eigen::ArrayXf bins = Eigen::ArrayXf::Zero(kBins);
  const auto total = static_cast<double>(std::max<std::uint64_t>(colors.total(), 1));
  colors.forEach([&](Bgr c, std::uint64_t count) {
    bins[binOf(c.b, c.g, c.r)] += static_cast<float>(static_cast<double>(count) / total);
  });
  Eigen::ArrayXf work;
  smooth(bins, work);
  return bins;
}

Eigen::ArrayXi BodyDescriber::inLight(int red_steps, int blue_steps, int brightness_steps) {
  Eigen::ArrayXi to(kBins);
  for (int i = 0; i < kBins; ++i) {
    const int brightness =
        std::clamp(i % kBrightnessBins + brightness_steps, 0, kBrightnessBins - 1);
    const int blue = i / kBrightnessBins % kChromaBins + blue_steps;
    const int red = i / kBrightnessBins / kChromaBins + red_steps;
    to[i] =
        (std::clamp(red, 0, kChromaBins - 1) * kChromaBins + std::clamp(blue, 0, kChromaBins - 1)) *
            kBrightnessBins +
        brightness;
  }
  return to;
}

Eigen::ArrayXf BodyDescriber::clothes() {
  constexpr float kGreyShare = 0.7F;
  constexpr float kGreySpread = 0.25F;
  const Eigen::ArrayXf chroma = Eigen::ArrayXf::LinSpaced(
      kChromaBins, static_cast<float>(kChromaLimit) * (1.0F / kChromaBins - 1.0F),
      static_cast<float>(kChromaLimit) * (1.0F - 1.0F / kChromaBins));
  Eigen::ArrayXf grey = (-0.5F * (chroma / kGreySpread).square()).exp();
  grey /= grey.sum();
  Eigen::ArrayXf bins(kBins);
  for (int i = 0; i < kBins; ++i) {
    const int blue = i / kBrightnessBins % kChromaBins;
    const int red = i / kBrightnessBins / kChromaBins;
    bins[i] =
        (kGreyShare * grey[red] * grey[blue] + (1.0F - kGreyShare) / (kChromaBins * kChromaBins)) /
        kBrightnessBins;
  }
  return bins;
}

void BodyPortrait::add(const BodyDescription& look) {
  if (look.colors.size() == 0) return;
  if (looks_++ == 0) {
    sum_.setZero(look.colors.rows(), look.colors.cols());
    seen_.setZero(look.colors.cols());
  }
  sum_ += look.colors;
  seen_ += look.colors.colwise().sum().transpose();
}

BodyDescription BodyPortrait::mean() const {
  BodyDescription mean;
  mean.colors = sum_;
  for (int part = 0; part < seen_.size(); ++part) {
    if (seen_[part] > 0.0F) mean.colors.col(part) /= seen_[part];
  }
  return mean;
}

}  // namespace heel
