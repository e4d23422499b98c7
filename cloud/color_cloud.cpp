// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/cloud/color_cloud.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace heel {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

void requireFit(const cv::Mat& depth_m, const cv::Mat& image_bgr, const PinholeCamera& camera) {
  require(depth_m.type() == CV_32FC1 && image_bgr.type() == CV_8UC3 &&
              depth_m.size() == image_bgr.size(),
          "makeColorCloud: depth and colour images do not fit");
  require(camera.fx > 0.0 && camera.fy > 0.0, "makeColorCloud: a focal length is not positive");
}

void requireMask(const cv::Mat& mask, const cv::Mat& image_bgr) {
  require(mask.type() == CV_8UC1 && mask.size() == image_bgr.size(),
          "makeColorCloud: the mask must be 8-bit and of the image's size");
}

bool shape(const cv::Size& size, ColorCloud& cloud) {
  const auto width = static_cast<std::uint32_t>(size.width);
  const auto height = static_cast<std::uint32_t>(size.height);
  const bool same =
      cloud.width == width && cloud.height == height && cloud.size() == std::size_t{width} * height;
  cloud.resize(std::size_t{width} * height);
  cloud.width = width;
  cloud.height = height;
  cloud.is_dense = false;
  return same;
}

/// The inverse projection: pixel and depth -> point of the cloud's frame.
class Rays {
 public:
  Rays(const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera)
      : inv_fx_(static_cast<float>(1.0 / camera.fx)),
        inv_fy_(static_cast<float>(1.0 / camera.fy)),
        cx_(static_cast<float>(camera.cx)),
        cy_(static_cast<float>(camera.cy)),
        R_(T_base_camera.linear().cast<float>()),
        t_(T_base_camera.translation().cast<float>()) {}

  Eigen::Vector3f point(int u, int v, float depth_m) const {
    const Eigen::Vector3f ray((static_cast<float>(u) - cx_) * inv_fx_,
                              (static_cast<float>(v) - cy_) * inv_fy_, 1.0F);
    return R_ * (ray * depth_m) + t_;
  }

 private:
  float inv_fx_, inv_fy_, cx_, cy_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f t_;
};

void paint(const cv::Vec3b& bgr, pcl::PointXYZRGB& p) {
  p.b = bgr[0];
  p.g = bgr[1];
  p.r = bgr[2];
  p.a = 255;
}

void blank(pcl::PointXYZRGB& p) {
  p.x = p.y = p.z = kNan;
  paint({0, 0, 0}, p);
}

/// Adds the masked points to a cloud that is blank.
void fill(const cv::Mat& depth_m, const cv::Mat& image_bgr, const RowSpans& spans, const Rays& rays,
          ColorCloud& cloud, pcl::Indices& indices) {
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto* depth = depth_m.ptr<float>(v);
    const auto* bgr = image_bgr.ptr<cv::Vec3b>(v);
    for (const Span& span : spans.row(v)) {
      for (int u = span.begin; u < span.end; ++u) {
        if (!(depth[u] > 0.0F)) continue;
        const int index = v * depth_m.cols + u;
        auto& p = cloud[static_cast<std::size_t>(index)];
        p.getVector3fMap() = rays.point(u, v, depth[u]);
        paint(bgr[u], p);
        indices.push_back(index);
      }
    }
  }
}

}  // namespace

void disparityToDepth(const cv::Mat& disparity, const StereoCamera& camera, cv::Mat& depth_m) {
  require(disparity.type() == CV_32FC1, "disparityToDepth: disparities must be 32-bit float");
  require(camera.left.fx > 0.0 && camera.baseline_m > 0.0, "disparityToDepth: no baseline");
  depth_m.create(disparity.size(), CV_32FC1);
  const auto scale = static_cast<float>(camera.left.fx * camera.baseline_m);
  const auto offset = static_cast<float>(camera.disparity_offset);
  for (int v = 0; v < disparity.rows; ++v) {
    const auto* from = disparity.ptr<float>(v);
    auto* to = depth_m.ptr<float>(v);
    for (int u = 0; u < disparity.cols; ++u) {
      const float d = from[u] + offset;
      to[u] = d > 0.0F ? scale / d : kNan;
    }
  }
}

void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const PinholeCamera& camera,
                    const Eigen::Isometry3d& T_base_camera, ColorCloud& cloud) {
  requireFit(depth_m, image_bgr, camera);
  shape(depth_m.size(), cloud);
  const Rays rays(camera, T_base_camera);
  std::size_t i = 0;
  for (int v = 0; v < depth_m.rows; ++v) {
    const auto* depth = depth_m.ptr<float>(v);
    const auto* bgr = image_bgr.ptr<cv::Vec3b>(v);
    for (int u = 0; u < depth_m.cols; ++u, ++i) {
      const float z = depth[u] > 0.0F ? depth[u] : kNan;
      cloud[i].getVector3fMap() = rays.point(u, v, z);
      paint(bgr[u], cloud[i]);
    }
  }
}

void makeColorCloud(const cv::Mat& depth_m, const cv::Mat& image_bgr, const cv::Mat& mask,
                    const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera,
                    ColorCloud& cloud, pcl::Indices& indices) {
  requireFit(depth_m, image_bgr, camera);
  requireMask(mask, image_bgr);
  shape(depth_m.size(), cloud);
  for (auto& p : cloud) blank(p);
  indices.clear();
  RowSpans spans;
  spans.find(mask);
  fill(depth_m, image_bgr, spans, Rays(camera, T_base_camera), cloud, indices);
}

MaskedCloud::MaskedCloud() : cloud_(pcl::make_shared<ColorCloud>()) {}

void MaskedCloud::update(const cv::Mat& depth_m, const cv::Mat& image_bgr, const cv::Mat& mask,
                         const PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera) {
  requireFit(depth_m, image_bgr, camera);
  requireMask(mask, image_bgr);
  if (shape(depth_m.size(), *cloud_)) {
    for (const auto i : indices_) blank((*cloud_)[static_cast<std::size_t>(i)]);
  } else {
    for (auto& p : *cloud_) blank(p);
  }
  indices_.clear();
  spans_.find(mask);
  fill(depth_m, image_bgr, spans_, Rays(camera, T_base_camera), *cloud_, indices_);
}

namespace {

constexpr double kMaxResidual_px = 0.5;

/// Fits y = slope * x + offset.
class LineFit {
 public:
  void add(double x, double y) {
    ++n_;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
    yy_ += y * y;
    least_y_ = std::min(least_y_, y);
    most_y_ = std::max(most_y_, y);
  }
  /// Two points are on a line whatever they are of, and so are any of one row or column.
  bool isDetermined() const { return n_ > 2 && least_y_ < most_y_; }
  double slope() const { return (n_ * xy_ - x_ * y_) / (n_ * xx_ - x_ * x_); }
  double offset() const { return (y_ - slope() * x_) / n_; }
  /// Root mean square of what the line leaves unexplained; NaN if there is no line.
  double residual() const {
    const double covariance = xy_ / n_ - x_ / n_ * (y_ / n_);
    const double spread = yy_ / n_ - y_ / n_ * (y_ / n_);
    return std::sqrt(std::max(0.0, spread - slope() * covariance));
  }

 private:
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
  double least_y_ = std::numeric_limits<double>::infinity(), most_y_ = -least_y_;
};

}  // namespace

std::optional<PinholeCamera> fitPinhole(const ColorCloud& cloud) {
  if (cloud.height < 2) {
    return std::nullopt;
  }
  LineFit across, down;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto& p = cloud[i];
    if (!(p.z > 0.0F) || !std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    const auto column = i % cloud.width, row = i / cloud.width;
    across.add(static_cast<double>(p.x) / static_cast<double>(p.z), static_cast<double>(column));
    down.add(static_cast<double>(p.y) / static_cast<double>(p.z), static_cast<double>(row));
  }
  if (!across.isDetermined() || !down.isDetermined()) return std::nullopt;
  PinholeCamera camera;
  camera.width = static_cast<int>(cloud.width);
  camera.height = static_cast<int>(cloud.height);
  camera.fx = across.slope();
  camera.fy = down.slope();
  camera.cx = across.offset();
  camera.cy = down.offset();
  const bool fits = across.residual() < kMaxResidual_px && down.residual() < kMaxResidual_px &&
                    isCalibrated(camera);
  return fits ? std::optional(camera) : std::nullopt;
}

}  // namespace heel
