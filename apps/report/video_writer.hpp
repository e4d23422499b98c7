// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Annotated frames as a film and as stills.
#pragma once

#include <opencv2/core/mat.hpp>

#include <filesystem>
#include <memory>

namespace cv {
class VideoWriter;
}

namespace heel {

class AtomicFile;

/// What a film in MP4 is for.
enum class FilmUse {
  kArchive,  ///< MPEG-4: the same frames give the same bytes.
  kBrowser,  ///< H.264, which browsers play, where there is an encoder; its bytes may differ.
};

/// Writes a film that gets its name only when it is complete, as AtomicFile does.
///
/// MP4 for a path that ends in .mp4, else Motion JPEG in AVI, which OpenCV can always write. Where
/// MP4 can't be written, `path()` ends in .avi instead.
class FilmWriter {
 public:
  /// @param rate_hz  Frames per second of the film, > 0.
  /// @throws std::runtime_error  if no film can be written there: one sentence.
  FilmWriter(std::filesystem::path path, double rate_hz, cv::Size size,
             FilmUse use = FilmUse::kArchive);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// @param picture  CV_8UC3 of the film's size.
  /// @throws std::invalid_argument  if it is not.
  void write(const cv::Mat& picture);

  /// Ends the film; commit() then only gives it its name.
  /// @throws std::runtime_error  if the film could not be written whole, for instance because the
  ///         disk is full.
  void close();

  /// Ends the film if need be, and gives it its name. A film without a frame is no file.
  /// @throws std::runtime_error  as close().
  void commit();

 private:
  enum class Format { kH264, kMpeg4, kMotionJpeg };

  bool open(const std::filesystem::path& path, Format format);
  void discard();

  /// OpenCV does not tell when a frame could not be written; the finished film's own count does.
  bool isWhole() const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  double rate_hz_;
  cv::Size size_;
  std::size_t frames_ = 0;
  std::unique_ptr<cv::VideoWriter> film_;  ///< Null once closed.
  bool is_pending_ = true;                 ///< The temporary is ours to rename or remove.
};

/// Writes a picture in the format of its name (.png), whole or not at all.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
void writePicture(const std::filesystem::path& file, const cv::Mat& picture);

/// The same into a file that the caller commits.
void writePicture(AtomicFile& file, const cv::Mat& picture);

}  // namespace heel
