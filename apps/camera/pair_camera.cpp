// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/camera/pair_camera.hpp>

#include <stdexcept>

namespace heel {
namespace {

bool isOfOpenNi(const std::string& device) {
  return device == "openni" || device.rfind("openni:", 0) == 0 ||
         std::filesystem::path(device).extension() == ".oni";
}

}  // namespace

bool PairCamera::next() {
  while (read()) {
    if (stamp_s_ > last_s_ && stamp_s_ < kLongestVideo_s) {
      last_s_ = stamp_s_;
      return true;
    }
    ++left_out_;
  }
  return false;
}

std::unique_ptr<PairCamera> openPairCamera(const PairCameraParams& params) {
  if (!isOfOpenNi(params.device)) return openSideBySide(params);
#ifdef HEEL_HAS_OPENNI
  return openDepthCamera(params);
#else
  throw std::runtime_error(params.device +
                           ": this build of Heel is without OpenNI2; it needs libopenni2-dev and "
                           "cmake -DHEEL_WITH_OPENNI=ON");
#endif
}

void checkCalibratedSize(const std::filesystem::path& from, int width, int height,
                         cv::Size images) {
  if (cv::Size(width, height) == images) return;
  throw std::runtime_error(from.string() + ": is of images of " + std::to_string(width) + "x" +
                           std::to_string(height) + ", and these are of " +
                           std::to_string(images.width) + "x" + std::to_string(images.height));
}

}  // namespace heel
