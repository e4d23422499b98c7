// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Folders of stereo images.
#pragma once

#include <heel/apps/recording/folders/indexed_recording.hpp>
#include <heel/apps/recording/folders/stereo_files.hpp>
#include <heel/apps/recording/image_file.hpp>
#include <heel/cloud/stereo_rig.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace heel {

/// Stereo images in one of the layouts of stereo_files.hpp, with a calibration (see
/// stereo_calibration.hpp). Raw images are rectified.
///
/// A camera.yaml in the folder may give the rate, and the mounting of the rectified left camera.
class StereoRecording final : public IndexedRecording {
 public:
  static constexpr const char* kLayout = "stereo images";

  /// Whether the folder looks like one.
  static bool fits(const std::filesystem::path& folder) { return hasStereoImages(folder); }

  /// @throws std::runtime_error  with one sentence that names the file and the reason.
  static std::unique_ptr<IndexedRecording> open(const std::filesystem::path& folder,
                                                const RecordingParams& params);

 private:
  StereoRecording(const std::filesystem::path& path, RecordingInfo info, StereoFiles files,
                  StereoRig rig);

  std::string frameName(std::size_t index) const override;
  void read(std::size_t index, Frame& frame) override;

  /// Reads an image of the rig's size.
  void readImage(const std::filesystem::path& file, cv::Mat& image_bgr);

  std::vector<StereoPair> pairs_;
  StereoRig rig_;
  ImageReader reader_;
  cv::Mat raw_left_, raw_right_;
};

}  // namespace heel
