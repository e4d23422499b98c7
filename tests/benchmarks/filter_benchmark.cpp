// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The appearance filter beside its peers in OpenCV and PCL, on one 640x480 frame and one thread.
/// The frame is generated, or read from the file that the environment's HEEL_BENCHMARK_IMAGE names.

#include <heel/segmentation/appearance_filter.hpp>
#include <heel/segmentation/image_filter.hpp>

#include <benchmark/benchmark.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <pcl/filters/conditional_removal.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

namespace heel {
namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;

/// The paper's formula on made-up histograms: reddish hues, dark values.
std::uint8_t score(std::uint8_t b, std::uint8_t g, std::uint8_t r) {
  const float v = std::max({b, g, r});
  const float chroma = v - static_cast<float>(std::min({b, g, r}));
  const float s = v > 0.0F ? chroma / v : 0.0F;
  float hue = 0.0F;  // in [0, 6)
  if (chroma > 0.0F) {
    const auto diff = [&](int a, int c) { return static_cast<float>(a - c) / chroma; };
    hue = v == r ? diff(g, b) : v == g ? 2.0F + diff(b, r) : 4.0F + diff(r, g);
    if (hue < 0.0F) hue += 6.0F;
  }
  static const std::array<float, 6> by_hue = {1.0F, 0.1F, 0.0F, 0.0F, 0.2F, 0.8F};
  static const std::array<float, 8> by_value = {1.0F, 0.9F, 0.2F, 0.1F, 0.0F, 0.0F, 0.1F, 0.0F};
  const float d_h = by_hue[std::min(5U, static_cast<unsigned>(hue))];
  const float d_v = by_value[static_cast<unsigned>(v) / 32];
  return static_cast<std::uint8_t>(255.0F * (s * d_h + (1.0F - s) * d_v));
}

const ColorTable& table() {
  static const ColorTable scores(score, 60);
  return scores;
}

/// A room: 20 x 15 patches, each of its own colour, with a camera's noise.
cv::Mat makeImage() {
  if (const char* path = std::getenv("HEEL_BENCHMARK_IMAGE")) {
    cv::Mat image = cv::imread(path);
    if (image.size() != cv::Size(640, 480)) throw std::runtime_error("not a 640x480 image");
    return image;
  }
  cv::RNG random(1);
  cv::Mat patches(15, 20, CV_8UC3);
  random.fill(patches, cv::RNG::NORMAL, 100, 50);
  cv::Mat image;
  cv::resize(patches, image, {640, 480}, 0, 0, cv::INTER_CUBIC);
  cv::Mat noise(image.size(), CV_16SC3);
  random.fill(noise, cv::RNG::NORMAL, 0, 4);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  return image;
}

const cv::Mat& image() {
  cv::setNumThreads(1);
  static const cv::Mat frame = makeImage();
  return frame;
}

/// The image's cloud; about one point in ten, in patches, has no depth.
Cloud::ConstPtr cloud() {
  static const Cloud::ConstPtr frame = [] {
    auto out = pcl::make_shared<Cloud>(640, 480);
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 640; ++x) {
        const auto& p = image().at<cv::Vec3b>(y, x);
        const bool hole = (x / 32 + y / 32) % 10 == 0;
        const float z = hole ? std::numeric_limits<float>::quiet_NaN() : 3.0F;
        out->at(x, y) = Point(hole ? z : static_cast<float>(x - 320) / 200.0F,
                              hole ? z : static_cast<float>(y - 240) / 200.0F, z, p[2], p[1], p[0]);
      }
    }
    out->is_dense = false;
    return out;
  }();
  return frame;
}

void HeelBuildsATable(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ColorTable(score).data());
}

void HeelFiltersAnImage(benchmark::State& state) {
  const cv::Mat frame = image();
  cv::Mat mask;
  table();
  for (auto _ : state) filterImage(frame, table(), mask);
  state.counters["passed"] = cv::countNonZero(mask);
}

/// cv::cvtColor and cv::calcBackProject of a histogram of hue, or of hue and saturation.
void OpenCvBackProjects(benchmark::State& state) {
  const bool with_saturation = state.range(0) == 2;
  const cv::Mat frame = image();
  cv::Mat histogram(36, with_saturation ? 32 : 1, CV_32F);
  cv::RNG(3).fill(histogram, cv::RNG::UNIFORM, 0, 255);
  const float hues[] = {0, 180};
  const float saturations[] = {0, 256};
  const float* ranges[] = {hues, saturations};
  const int channels[] = {0, 1};
  cv::Mat hsv, back_projection;
  for (auto _ : state) {
    cv::cvtColor(frame, hsv, cv::COLOR_BGR2HSV);
    cv::calcBackProject(&hsv, 1, channels, histogram, back_projection, ranges);
  }
}

void HeelFiltersACloudToIndices(benchmark::State& state) {
  AppearanceFilter<Point> filter;
  filter.setTable(table());
  filter.setInputCloud(cloud());
  pcl::Indices kept;
  for (auto _ : state) filter.filter(kept);
  state.counters["passed"] = static_cast<double>(kept.size());
}

void HeelFiltersACloud(benchmark::State& state) {
  const bool organized = state.range(0) != 0;
  AppearanceFilter<Point> filter(organized);  // PCL asks for the removed points only when organized
  filter.setKeepOrganized(organized);
  filter.setTable(table());
  filter.setInputCloud(cloud());
  Cloud out;
  for (auto _ : state) filter.filter(out);
  state.counters["passed"] = static_cast<double>(out.size());
}

/// pcl::ConditionalRemoval: a range of hues (-128 to 127 is the whole circle), and enough
/// saturation.
void PclFiltersACloud(benchmark::State& state) {
  const auto condition = pcl::make_shared<pcl::ConditionAnd<Point>>();
  const auto demand = [&](const char* what, pcl::ComparisonOps::CompareOp op, double value) {
    condition->addComparison(pcl::make_shared<pcl::PackedHSIComparison<Point>>(what, op, value));
  };
  demand("h", pcl::ComparisonOps::GT, -100.0);
  demand("h", pcl::ComparisonOps::LT, 100.0);
  demand("s", pcl::ComparisonOps::GT, 20.0);
  demand("i", pcl::ComparisonOps::GT, 10.0);
  demand("i", pcl::ComparisonOps::LT, 120.0);
  pcl::ConditionalRemoval<Point> filter;
  filter.setKeepOrganized(state.range(0) != 0);
  filter.setCondition(condition);
  filter.setInputCloud(cloud());
  Cloud out;
  for (auto _ : state) filter.filter(out);
  state.counters["passed"] = static_cast<double>(out.size());
}

/// The least of ten runs: what the machine's other work does not blur.
void leastOfTen(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMicrosecond)->MinTime(0.05)->Repetitions(10)->ReportAggregatesOnly();
  b->ComputeStatistics("least", [](const std::vector<double>& runs) {
    return *std::min_element(runs.begin(), runs.end());
  });
}

BENCHMARK(HeelFiltersAnImage)->Apply(leastOfTen);
BENCHMARK(OpenCvBackProjects)->ArgName("channels")->Arg(1)->Arg(2)->Apply(leastOfTen);
BENCHMARK(HeelFiltersACloudToIndices)->Apply(leastOfTen);
BENCHMARK(HeelFiltersACloud)->ArgName("organized")->Arg(0)->Arg(1)->Apply(leastOfTen);
BENCHMARK(PclFiltersACloud)->ArgName("organized")->Arg(0)->Arg(1)->Apply(leastOfTen);
BENCHMARK(HeelBuildsATable)->Apply(leastOfTen);

}  // namespace
}  // namespace heel

BENCHMARK_MAIN();
