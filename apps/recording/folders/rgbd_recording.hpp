// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// RGB-D folders in the layout of the TUM benchmark.
#pragma once

#include <heel/apps/recording/folders/indexed_recording.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/apps/recording/stamps.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heel {

/// Colour and depth images listed in rgb.txt and depth.txt, joined by their nearest stamps, with a
/// camera.yaml (see camera_file.hpp). Depth is registered to the colour camera.
class RgbdRecording final : public IndexedRecording {
 public:
  static constexpr const char* kLayout = "RGB-D folder, TUM layout";

  /// Whether the folder looks like one.
  static bool fits(const std::filesystem::path& folder);

  /// @throws std::runtime_error  with one sentence that names the file and the reason.
  static std::unique_ptr<IndexedRecording> open(const std::filesystem::path& folder,
                                                const RecordingParams& params);

 private:
  /// One colour image and the depth image of the same moment, if there is one.
  struct Pair {
    std::filesystem::path color;
    std::optional<std::filesystem::path> depth;
  };

  RgbdRecording(const std::filesystem::path& path, RecordingInfo info, std::vector<double> stamps_s,
                std::vector<Pair> pairs, double depth_scale, double max_stamp_difference_s);

  std::string frameName(std::size_t index) const override;
  void read(std::size_t index, Frame& frame) override;

  std::vector<Pair> pairs_;
  double depth_scale_;
  double max_stamp_difference_s_;
  ImageReader reader_;
};

}  // namespace heel
