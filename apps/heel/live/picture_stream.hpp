// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Pictures for a browser.
#pragma once

#include <opencv2/core/mat.hpp>

#include <memory>
#include <string>

namespace heel {

/// Serves a page with the last picture on a port of this machine, which others cannot reach: "/",
/// and "/stream", Motion JPEG. Nothing waits for who watches.
class PictureStream {
 public:
  /// @param port  0: any that is free.
  /// @throws std::runtime_error  if the port is taken.
  explicit PictureStream(int port);
  ~PictureStream();

  const std::string& url() const { return url_; }

  /// Whether show() is of use.
  bool isWatched() const;

  /// @param picture_bgr  CV_8UC3.
  void show(const cv::Mat& picture_bgr);

 private:
  struct Server;
  std::unique_ptr<Server> server_;
  std::string url_;
};

}  // namespace heel
