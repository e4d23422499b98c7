// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/recording/camera_file.hpp>
#include <heel/apps/recording/folders/stereo_recording.hpp>
#include <heel/cloud/stereo_calibration.hpp>

#include <stdexcept>
#include <utility>

namespace heel {

namespace fs = std::filesystem;

namespace {

/// The size of the first image that can be read: some calibration files give none.
cv::Size imageSize(const std::vector<StereoPair>& pairs) {
  ImageReader reader;
  cv::Mat image;
  for (const auto& pair : pairs) {
    try {
      reader.readColor(pair.left, image);
      return image.size();
    } catch (const std::runtime_error&) {
      // The frame is left out later, with its reason.
    }
  }
  return {};
}

}  // namespace

std::unique_ptr<IndexedRecording> StereoRecording::open(const fs::path& folder,
                                                        const RecordingParams& params) {
  RecordingInfo info;
  info.layout = kLayout;
  info.sensor = SensorKind::kStereo;
  double rate_hz = params.nominal_rate_hz;
  if (fs::exists(folder / "camera.yaml")) {
    const CameraFile camera = readCameraFile(folder / "camera.yaml");
    if (camera.rate_hz) rate_hz = *camera.rate_hz;
    info.T_base_camera = camera.T_ground_camera;
  }
  StereoFiles files = findStereoFiles(folder, rate_hz, params.max_stamp_difference_s);
  info.nominal_stamps = files.nominal_stamps;
  StereoRig rig = readStereoRig(folder, imageSize(files.pairs));
  info.camera = rig.camera();
  return std::unique_ptr<IndexedRecording>(
      new StereoRecording(folder, std::move(info), std::move(files), std::move(rig)));
}

StereoRecording::StereoRecording(const fs::path& path, RecordingInfo info, StereoFiles files,
                                 StereoRig rig)
    : IndexedRecording(path, std::move(info), std::move(files.stamps_s)),
      pairs_(std::move(files.pairs)),
      rig_(std::move(rig)) {}

std::string StereoRecording::frameName(std::size_t index) const {
  const StereoPair& pair = pairs_[index];
  return (pair.left.empty() ? pair.right : pair.left).string();
}

void StereoRecording::readImage(const fs::path& file, cv::Mat& image_bgr) {
  const PinholeCamera& camera = info_.camera.left;
  reader_.readColor(file, image_bgr);
  checkImageSize(file, image_bgr, camera.width, camera.height, "the calibration");
}

void StereoRecording::read(std::size_t index, Frame& frame) {
  const StereoPair& pair = pairs_[index];
  if (pair.left.empty() || pair.right.empty()) {
    throw std::runtime_error(frameName(index) + ": the " + (pair.left.empty() ? "left" : "right") +
                             " image of this pair is missing");
  }
  frame.depth_m.release();
  frame.cloud.reset();
  if (rig_.isRectified()) {
    readImage(pair.left, frame.image_bgr);
    readImage(pair.right, frame.right_bgr);
    return;
  }
  readImage(pair.left, raw_left_);
  readImage(pair.right, raw_right_);
  rig_.rectify(raw_left_, raw_right_, frame.image_bgr, frame.right_bgr);
}

}  // namespace heel
