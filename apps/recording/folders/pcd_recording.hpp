// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// PCD files: a folder of them, or one.
#pragma once

#include <heel/apps/recording/folders/indexed_recording.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace heel {

/// A sequence of coloured clouds. A file's points are in the camera's optical frame; the file's
/// viewpoint is not used. Organized clouds give an image too.
///
/// Times come from times.txt, or from the file names (see stampOfName), or are nominal. A
/// camera.yaml in the folder may give the rate, the mounting and the intrinsics.
class PcdRecording final : public IndexedRecording {
 public:
  static constexpr const char* kLayout = "PCD files";

  /// Whether `path` is a PCD file or a folder that holds some.
  static bool fits(const std::filesystem::path& path);

  /// @throws std::runtime_error  with one sentence that names the file and the reason.
  static std::unique_ptr<IndexedRecording> open(const std::filesystem::path& path,
                                                const RecordingParams& params);

 private:
  PcdRecording(const std::filesystem::path& path, RecordingInfo info, std::vector<double> stamps_s,
               std::vector<std::filesystem::path> files);

  std::string frameName(std::size_t index) const override;
  void read(std::size_t index, Frame& frame) override;

  std::vector<std::filesystem::path> files_;
};

}  // namespace heel
