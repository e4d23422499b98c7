// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/film/video_writer.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include <stdexcept>
#include <utility>
#include <vector>

namespace heel {

namespace fs = std::filesystem;

FilmWriter::FilmWriter(OutputPath path, double rate_hz, cv::Size size)
    : path_(std::move(path)), rate_hz_(rate_hz), size_(size) {
  if (!(rate_hz > 0.0) || size.empty()) {
    throw std::invalid_argument("FilmWriter: the rate and the size must be above 0");
  }
  writeFile(path_, "film");  // OpenCV does not tell why it can't write; the system does
  if (path_.named.extension() == ".mp4" && open(true)) return;
  if (open(false)) return;
  throw OutputError(path_.named.string() + " cannot be written: OpenCV has no film format here");
}

FilmWriter::~FilmWriter() {
  if (film_ != nullptr) discard();
}

void FilmWriter::discard() {
  film_.reset();
  std::error_code ignored;
  fs::remove(path_.written, ignored);
}

bool FilmWriter::open(bool as_mp4) {
  path_.written.replace_extension(as_mp4 ? ".mp4" : ".avi");
  path_.named.replace_extension(as_mp4 ? ".mp4" : ".avi");
  film_ = std::make_unique<cv::VideoWriter>();
  const int codec = as_mp4 ? cv::VideoWriter::fourcc('a', 'v', 'c', '1')
                           : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  if (film_->open(path_.written.string(), as_mp4 ? cv::CAP_FFMPEG : cv::CAP_OPENCV_MJPEG, codec,
                  rate_hz_, size_)) {
    return true;
  }
  discard();
  return false;
}

bool FilmWriter::isWhole() const {
  cv::VideoCapture film(path_.written.string(), cv::CAP_FFMPEG);
  return film.isOpened() && film.get(cv::CAP_PROP_FRAME_COUNT) == static_cast<double>(frames_);
}

void FilmWriter::write(const cv::Mat& picture) {
  if (film_ == nullptr) throw std::logic_error("FilmWriter: written to after its end");
  if (picture.type() != CV_8UC3 || picture.size() != size_) {
    throw std::invalid_argument("FilmWriter: a picture of another type or size");
  }
  film_->write(picture);
  ++frames_;
}

void FilmWriter::close() {
  if (film_ == nullptr) return;
  film_.reset();  // writes the film's end
  if (frames_ > 0 && isWhole()) return;
  discard();
  if (frames_ == 0) return;
  throw OutputError(path_.named.string() +
                    " cannot be written: the film is not whole; is the disk full?");
}

void writePicture(const OutputPath& file, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(file.named.extension().string(), picture, bytes);
  } catch (const cv::Exception&) {
    // The sentence below says all that a reader can use.
  }
  if (!encoded) {
    throw std::invalid_argument(file.named.string() +
                                " cannot be written: no picture format of this name");
  }
  writeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace heel
