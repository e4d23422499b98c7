// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What a body looks like: the colours of all of it, by height.
#pragma once

#include <heel/cloud/color_cloud.hpp>
#include <heel/segmentation/color_histogram.hpp>
#include <heel/segmentation/stature.hpp>
#include <heel/segmentation/world_blobs.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace heel {

/// An image whose pixels may have a depth.
struct BodyView {
  cv::Mat image_bgr;  ///< CV_8UC3.
  cv::Mat depth_m;    ///< CV_32FC1 of the same size, NaN or <= 0 where there is none.
  PinholeCamera camera;
  Eigen::Isometry3d T_base_camera;
  /// Depth is of stereo, in a range of so many disparities; 0: it is not. Stereo finds none on much
  /// of plain clothes: pixels without one are then taken from an upright board about the place, see
  /// BodyDescriber::boardOf(), as far aside as the body has any. Not in the first `disparities`
  /// columns: what is near has none there, for it is outside the right image.
  int disparities = 0;
};

/// One look at a body, or the mean of many.
struct BodyDescription {
  /// Row: a bin of colour. Column: a stripe of height. A column sums to 1, or to 0 where too little
  /// of the stripe was seen to say anything.
  Eigen::ArrayXXf colors;
  std::optional<double> stature_m;  ///< If the head was seen.
};

/// How the colours of a body are counted, stripe by stripe of its height.
struct BodyDescriberParams {
  double radius_m = 0.25;  ///< Radius of the upright cylinder that holds the body.
};

/// Describes bodies by the joint distribution of log(r / g), log(b / g) and log brightness in
/// stripes of metric height. Logarithms are of the channel + 12, for below that the camera's noise
/// is all there is; so a light of another brightness shifts the last only.
///
/// Whoever compares descriptions needs to know nothing of bins and stripes: a describer with others
/// can take its place. Holds the memory that it works in; allocates nothing once warm.
class BodyDescriber {
 public:
  static constexpr double kChromaLimit = 1.5;  ///< Both log-ratios are clipped at +- this.
  static constexpr int kChromaBins = 18;
  static constexpr int kBrightnessBins = 6;
  static constexpr int kBins = kChromaBins * kChromaBins * kBrightnessBins;
  static constexpr int kStripes = 10;

  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit BodyDescriber(const BodyDescriberParams& params = {});

  /// Describes the body at a blob's place (in the base frame). `out` is overwritten.
  void describe(const BodyView& view, const WorldBlob& blob, BodyDescription& out);

  /// Where the board of a body lies in the image: pixels without depth count there, so depth should
  /// be looked for in all of it. What has a depth in front of the body hides it.
  cv::Rect boardOf(const BodyView& view, const WorldBlob& blob) const;

  /// Where a body's head may be, and what is behind it beside and above: depth should be looked for
  /// there, too.
  cv::Rect headOf(const BodyView& view, const WorldBlob& blob) const;

  /// The same over the points of a cloud in the base frame: of those named, if any are.
  void describe(const ColorCloud& cloud, const Eigen::Vector2d& position_m, BodyDescription& out,
                const pcl::Indices* indices = nullptr);

  static double middleOf_m(int stripe);  ///< Height of a stripe's middle over the floor.
  /// What of somebody this tall a stripe shows most of: 0: trousers, 1: a top, 2: hair and face.
  static int garmentOf(int stripe, double stature_m);

  /// How counted colours spread over the bins: a stripe that has them all.
  static Eigen::ArrayXf binsOf(const ColorHistogram& colors);

  /// Where the pixels of each bin go if the light makes red and blue stronger or weaker against
  /// green by so many bins, each by kLightStep (a natural logarithm), and all brighter by so many,
  /// each by kBrightnessStep.
  static Eigen::ArrayXi inLight(int red_steps, int blue_steps, int brightness_steps);
  static constexpr double kLightStep = 2.0 * kChromaLimit / kChromaBins;
  static constexpr double kBrightnessStep = 3.1 / kBrightnessBins;  ///< ln(267 / 12) in all.

  /// What clothes look like before anybody is known: most are grey, more or less, and the rest may
  /// have any colour, in any light.
  static Eigen::ArrayXf clothes();

 private:
  void begin(BodyDescription& out);
  void add(int stripe, const cv::Vec3b& bgr, BodyDescription& out);
  void finish(BodyDescription& out, double full_above = 0.0);

  BodyDescriberParams params_;
  std::vector<int> seen_;  // pixels a stripe
  StatureSample heights_;
  struct BoardPixel {
    int column, stripe;
    cv::Vec3b bgr;
  };
  std::vector<BoardPixel> without_depth_;
  Eigen::ArrayXf smoothed_;
};

/// The mean of many looks, stripe by stripe.
class BodyPortrait {
 public:
  void add(const BodyDescription& look);
  bool empty() const { return looks_ == 0; }
  /// Without stature.
  BodyDescription mean() const;

 private:
  Eigen::ArrayXXf sum_;
  Eigen::ArrayXf seen_;  // looks that showed a stripe
  int looks_ = 0;
};

}  // namespace heel
