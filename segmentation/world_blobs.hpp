// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Connected components of the plan view: the paper's world blobs (section 3.2).
#pragma once

#include <heel/segmentation/plan_view.hpp>

#include <Eigen/Core>

#include <vector>

namespace heel {

/// One connected component of the plan view, or the part of one that is a person of their own.
struct WorldBlob {
  Eigen::Vector2d position_m =
      Eigen::Vector2d::Zero();  ///< On the floor, in the plan view's frame: centre of its surface.
  double score = 0.0;  ///< Sum of the cells' weights (greatest heights) [m], as in the paper.
  double max_height_m = 0.0;  ///< Greatest height in the blob.
  double area_m2 = 0.0;       ///< Surface that the camera saw; does not depend on the range.
  double extent_m = 0.0;      ///< Length on the floor: four standard deviations of the surface.
  int cells = 0;              ///< How many cells it covers.
  int points = 0;             ///< How many points fell on it.
  double appearance = 0.0;    ///< Mean colour score of its points in [0, 1]; 0 without a model.
};

/// Which components count, and when one is taken for two people who touch.
///
/// The defaults let partial bodies through, as behind the colour filter. A component is split at
/// the peaks of its surface map, smoothed to the size of a body, if there is a valley between them.
struct WorldBlobParams {
  int min_points = 10;  ///< A blob with fewer points than this is noise.
  /// A blob with less area than this is noise (a hand has about 0.015).
  double min_area_m2 = 0.01;
  /// Cells that are this far apart, edge to edge, are still one blob; 0: they must touch.
  double max_gap_m = 0.05;
  /// Whether blobs are split into people who touch; without, they are the paper's connected
  /// components.
  bool split = true;
  /// Standard deviation of the Gaussian on the surface map whose peaks are people.
  double smoothing_m = 0.075;
  double min_separation_m = 0.35;  ///< The middles of two people are at least this far apart.
  /// Two peaks are two people if the valley between them is lower than this share of the lower
  /// peak.
  double max_valley = 0.9;
};

/// What a blob must be to be a person without a look at its colours.
struct PersonShape {
  /// A person's highest point is at least this high; lower it for children and people who sit.
  double min_height_m = 1.2;
  double max_height_m = 2.1;  ///< What reaches higher than this is a wall or a door.
  double min_area_m2 = 0.05;  ///< Least area on the floor: that of a head and a shoulder.

  /// For a scene whose background is not known, where furniture passes for half hidden people: half
  /// of a body must be seen.
  static PersonShape inUnknownScene() {
    PersonShape shape;
    shape.min_area_m2 = 0.25;
    return shape;
  }
};

/// Whether a blob has a person's height, surface and extent.
bool hasPersonShape(const WorldBlob& blob, const PersonShape& shape);

/// Finds world blobs. Holds the work memory, so that finding allocates nothing once warm.
class WorldBlobFinder {
 public:
  /// @throws std::invalid_argument  if a parameter is out of its range.
  explicit WorldBlobFinder(const WorldBlobParams& params = {});

  /// The blobs of a plan view, highest score first. `blobs` is overwritten.
  void find(const PlanView& view, std::vector<WorldBlob>& blobs);

  /// The blob (index into the last `blobs`) that owns a cell of the last plan view, or -1.
  int blobOf(int cell) const { return cell < 0 ? -1 : labels_[static_cast<std::size_t>(cell)]; }

 private:
  // A box of cells of the grid, ends included.
  struct Box {
    int first_row, last_row, first_column, last_column;
  };

  struct Peak {
    int row, column;
    float value;
  };

  Box collect(const PlanView& view, int seed);
  void findPeaks(const PlanView& view, const Box& box);
  bool isPeak(int row, int column, int columns) const;
  bool standsApart(const Peak& peak, int columns) const;
  void addParts(const PlanView& view, const Box& box, std::vector<WorldBlob>& blobs);
  void sortByScore(std::vector<WorldBlob>& blobs);

  WorldBlobParams params_;
  double cell_size_m_ = 0.0;  // of the last view; the next three follow from it
  int reach_ = 1;             // cells this near are one component
  double min_separation_cells_ = 0.0;
  std::vector<float> kernel_;  // half of the Gaussian: [0] is the centre

  std::vector<int> labels_;               // per cell: blob, or one of the marks in the source
  std::vector<int> touched_;              // cells whose label has been set
  std::vector<int> component_;            // cells of the component at hand
  std::vector<float> surface_, blurred_;  // the component's box, with a margin
  std::vector<Peak> candidates_, peaks_;
  std::vector<Eigen::Matrix2d> moments_;
  std::vector<int> order_, rank_;
  std::vector<WorldBlob> sorted_;
};

}  // namespace heel
