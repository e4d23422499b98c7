// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Person or thing, by the outline in the picture.
#pragma once

#include <heel/segmentation/body_description.hpp>

#include <Eigen/Core>
#include <opencv2/objdetect.hpp>

#include <optional>
#include <vector>

namespace heel {

/// Asks OpenCV's classifier of people whether one stands at a place: histograms of oriented
/// gradients, Dalal and Triggs, "Histograms of oriented gradients for human detection", CVPR 2005,
/// trained on the people of INRIA. The place is known, so nothing is searched: the picture of an
/// upright board there is looked at. OpenCV allocates inside at each look.
class PersonOutline {
 public:
  PersonOutline();

  /// The classifier's value; nothing where a person would not be in the picture from side to side,
  /// and with head or feet, or where something stands before one half of them.
  ///
  /// @param view     Its depth may be empty: then nothing is known to stand before them.
  /// @param place_m  In the base frame.
  std::optional<double> classify(const BodyView& view, const Eigen::Vector2d& place_m);

  /// Logarithm of the likelihood of that value if a person stands there, over if they do not, as
  /// one of many looks at the same body; 0 without a value.
  double logPerson(const BodyView& view, const Eigen::Vector2d& place_m);

 private:
  cv::HOGDescriptor hog_;
  Eigen::VectorXf weights_;
  float bias_ = 0.0F;
  cv::Mat board_, grey_;
  std::vector<float> gradients_;
};

}  // namespace heel
