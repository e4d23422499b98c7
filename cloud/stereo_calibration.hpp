// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Calibration files of stereo pairs, in the formats that people have.
///
/// Every reader throws std::runtime_error with one sentence that names the file and the reason; and
/// std::invalid_argument if it is given no file.
#pragma once

#include <heel/cloud/stereo_rig.hpp>

#include <opencv2/core/types.hpp>

#include <filesystem>
#include <vector>

namespace heel {

/// What cv::stereoCalibrate gives, as YAML, XML or JSON of cv::FileStorage; in metres.
///
/// Needed: both camera matrices and distortions, R and T. Known names: M1 D1 M2 D2 (OpenCV's
/// sample), K1, cameraMatrix1, camera_matrix_1, camera_matrix_left, left_camera_matrix and their
/// like. R1 R2 P1 P2 are taken where they are all there, and computed otherwise. A file with P1
/// and P2 alone describes images that are rectified already.
/// @param files           One file, or several that complete each other (the sample writes
///                        intrinsics.yml and extrinsics.yml).
/// @param image_size      Used where the files give no size (OpenCV's sample does not).
StereoRig readOpenCvCalibration(const std::vector<std::filesystem::path>& files,
                                cv::Size image_size = {});

/// A pair of ROS camera_info files; baseline = -P_right[3] / P_right[0], in metres.
StereoRig readCameraInfo(const std::filesystem::path& left, const std::filesystem::path& right);

/// Middlebury's calib.txt (version 3, millimetres); its images are rectified.
StereoRig readMiddleburyCalibration(const std::filesystem::path& file);

/// The files of the calibration that `path` is: a file, or a folder that holds left.yaml and
/// right.yaml, intrinsics.yml and extrinsics.yml, one of
/// calib/stereo/calibration.{yaml,yml,xml,json}, or calib.txt.
std::vector<std::filesystem::path> stereoRigFiles(const std::filesystem::path& path);

/// Reads them, whichever they are.
StereoRig readStereoRig(const std::filesystem::path& path, cv::Size image_size = {});

}  // namespace heel
