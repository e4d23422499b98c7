// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/segmentation/color_score.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

void check(const ColorRatioParams& params) {
  if (!(params.dark_offset > 0.0 && params.chroma_limit > 0.0 && params.other_weight > 0.0)) {
    throw std::invalid_argument("dark offset, chroma limit and other weight must be positive");
  }
  if (!isBinCount(params.chroma_bins) || !isBinCount(params.brightness_bins)) {
    throw std::invalid_argument("chroma and brightness need 1 to 256 bins");
  }
  if (!(params.smoothing_bins >= 0.0 && params.smoothing_bins <= 256.0)) {
    throw std::invalid_argument("the smoothing must be 0 to 256 bins");
  }
}

/// Where colours lie in the joint histogram of two log-chromaticities and the log-brightness.
class LogChromaGrid {
 public:
  explicit LogChromaGrid(const ColorRatioParams& params)
      : offset_(params.dark_offset),
        chroma_limit_(params.chroma_limit),
        darkest_(std::log(params.dark_offset)),
        brightest_(std::log(255.0 + params.dark_offset)),
        bins_{params.chroma_bins, params.chroma_bins, params.brightness_bins} {}

  /// Bins along each axis, slowest first.
  const std::array<int, 3>& bins() const { return bins_; }

  std::size_t size() const {
    return static_cast<std::size_t>(bins_[0]) * static_cast<std::size_t>(bins_[1]) *
           static_cast<std::size_t>(bins_[2]);
  }

  std::size_t binOf(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    const double green = std::log(g + offset_);
    const double light = std::log((r + g + b) / 3.0 + offset_);
    const int i = bin(chromaShare(std::log(r + offset_) - green), bins_[0]);
    const int j = bin(chromaShare(std::log(b + offset_) - green), bins_[1]);
    const int k = bin((light - darkest_) / (brightest_ - darkest_), bins_[2]);
    return static_cast<std::size_t>((i * bins_[1] + j) * bins_[2] + k);
  }

 private:
  double chromaShare(double chroma) const { return 0.5 + 0.5 * chroma / chroma_limit_; }

  static int bin(double share, int bins) {
    return std::clamp(static_cast<int>(std::floor(share * bins)), 0, bins - 1);
  }

  double offset_;
  double chroma_limit_;
  double darkest_;
  double brightest_;
  std::array<int, 3> bins_;
};

/// Half of a Gaussian: [0] is its centre. Both sides together sum to 1.
std::vector<double> halfGaussian(double sigma) {
  if (sigma <= 0.0) return {1.0};
  std::vector<double> kernel(static_cast<std::size_t>(std::ceil(4.0 * sigma)) + 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double x = static_cast<double>(i) / sigma;
    kernel[i] = std::exp(-0.5 * x * x);
    sum += (i == 0 ? 1.0 : 2.0) * kernel[i];
  }
  for (double& k : kernel) k /= sum;
  return kernel;
}

/// Blurs along one axis of the grid; bins beyond an end have the end's value.
void smoothAlong(std::size_t axis, const std::array<int, 3>& bins,
                 const std::vector<double>& kernel, std::vector<double>& shares) {
  std::size_t stride = 1;
  for (std::size_t a = axis + 1; a < 3; ++a) stride *= static_cast<std::size_t>(bins[a]);
  const auto length = static_cast<std::ptrdiff_t>(bins[axis]);
  std::vector<double> line(static_cast<std::size_t>(length));
  for (std::size_t start = 0; start < shares.size(); ++start) {
    if (start / stride % static_cast<std::size_t>(length) != 0) continue;  // not a line's first bin
    for (std::ptrdiff_t i = 0; i < length; ++i) {
      const auto at = [&](std::ptrdiff_t j) {
        const auto inside = std::clamp<std::ptrdiff_t>(j, 0, length - 1);
        return shares[start + static_cast<std::size_t>(inside) * stride];
      };
      double sum = kernel[0] * at(i);
      for (std::size_t k = 1; k < kernel.size(); ++k) {
        const auto step = static_cast<std::ptrdiff_t>(k);
        sum += kernel[k] * (at(i - step) + at(i + step));
      }
      line[static_cast<std::size_t>(i)] = sum;
    }
    for (std::size_t i = 0; i < line.size(); ++i) shares[start + i * stride] = line[i];
  }
}

std::vector<double> smoothShares(const ColorHistogram& colors, const LogChromaGrid& grid,
                                 double smoothing_bins) {
  std::vector<double> shares(grid.size(), 0.0);
  colors.forEach([&](Bgr c, std::uint64_t count) {
    shares[grid.binOf(c.b, c.g, c.r)] += static_cast<double>(count);
  });
  const auto kernel = halfGaussian(smoothing_bins);
  for (std::size_t axis = 0; axis < 3; ++axis) smoothAlong(axis, grid.bins(), kernel, shares);
  double sum = 0.0;
  for (const double share : shares) sum += share;
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

ColorScore colorRatioScore(const ColorHistogram& person, const ColorHistogram& room,
                           const ColorRatioParams& params) {
  check(params);
  if (person.empty()) throw std::invalid_argument("there are no colours of the person");
  if (room.empty()) throw std::invalid_argument("there are no colours of the room");
  const LogChromaGrid grid(params);
  const auto p = smoothShares(person, grid, params.smoothing_bins);
  const auto q = smoothShares(room, grid, params.smoothing_bins);
  auto ratio = std::make_shared<std::vector<double>>(grid.size());
  const double other = params.other_weight / static_cast<double>(grid.size());
  for (std::size_t i = 0; i < ratio->size(); ++i) {
    (*ratio)[i] = p[i] / (p[i] + q[i] + other);
  }
  return [grid, ratio](std::uint8_t b, std::uint8_t g, std::uint8_t r) {
    return (*ratio)[grid.binOf(b, g, r)];
  };
}

}  // namespace heel
