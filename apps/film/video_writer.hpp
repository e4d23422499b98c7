// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Annotated frames as a film and as stills.
#pragma once

#include <heel/apps/output/output.hpp>

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <memory>

namespace cv {
class VideoWriter;
}

namespace heel {

/// Writes a film.
///
/// H.264 in MP4, which browsers play, for a path that ends in .mp4; the same frames are shown by
/// the same pictures, but the encoder's bytes may differ. Else Motion JPEG in AVI, which OpenCV can
/// always write, and browsers do not play. Where OpenCV has no H.264, `path()` ends in .avi
/// instead.
class FilmWriter {
 public:
  /// @param rate_hz  Frames per second of the film, > 0.
  /// @throws OutputError  if no film can be written there: one sentence.
  FilmWriter(OutputPath path, double rate_hz, cv::Size size);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// What it is called.
  const std::filesystem::path& path() const { return path_.named; }

  /// @param picture  CV_8UC3 of the film's size.
  /// @throws std::invalid_argument  if it is not.
  void write(const cv::Mat& picture);

  /// Ends the film. One without a frame, and one that was not ended, is no file.
  /// @throws OutputError  if the film could not be written whole, for instance because the disk is
  ///         full.
  void close();

 private:
  bool open(bool as_mp4);
  void discard();

  /// OpenCV does not tell when a frame could not be written; the finished film's own count does.
  bool isWhole() const;

  OutputPath path_;
  double rate_hz_;
  cv::Size size_;
  std::size_t frames_ = 0;
  std::unique_ptr<cv::VideoWriter> film_;  ///< Null once closed.
};

/// Writes a picture in the format of its name (.png).
/// @throws std::invalid_argument  if there is no such format.
/// @throws OutputError  with one sentence that names the file and the reason.
void writePicture(const OutputPath& file, const cv::Mat& picture);

}  // namespace heel
