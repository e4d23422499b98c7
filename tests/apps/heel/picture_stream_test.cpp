// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/live/picture_stream.hpp>

#include <gmock/gmock.h>
#include <httplib.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <future>
#include <thread>
#include <vector>

namespace heel {
namespace {

const std::string kBoundary = "--picture\r\n";

/// What comes at /stream until there are so many pictures, or no more.
std::future<std::string> watch(const PictureStream& stream, std::size_t pictures) {
  return std::async(std::launch::async, [url = stream.url(), pictures] {
    std::string bytes;
    std::size_t begun = 0;
    httplib::Client(url).Get("/stream", [&](const char* data, std::size_t size) {
      bytes.append(data, size);
      begun = 0;
      for (std::size_t at = 0; (at = bytes.find(kBoundary, at)) != std::string::npos; ++at) ++begun;
      return begun <= pictures;
    });
    return bytes;
  });
}

void awaitWatcher(const PictureStream& stream) {
  while (!stream.isWatched()) std::this_thread::yield();
}

cv::Mat firstPicture(const std::string& bytes) {
  const std::size_t begin = bytes.find("\r\n\r\n") + 4;
  return cv::imdecode(std::vector<char>(bytes.begin() + static_cast<long>(begin), bytes.end()),
                      cv::IMREAD_COLOR);
}

TEST(PictureStream, SendsEachPictureToWhoWatches) {
  PictureStream stream(0);
  EXPECT_FALSE(stream.isWatched());
  std::future<std::string> watched = watch(stream, 1);
  awaitWatcher(stream);
  const cv::Mat red(48, 64, CV_8UC3, cv::Scalar(0, 0, 250));
  while (watched.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    stream.show(red);
  }
  const cv::Mat seen = firstPicture(watched.get());
  ASSERT_EQ(seen.size(), red.size());
  EXPECT_NEAR(cv::mean(seen)[2], 250, 3);
  EXPECT_NEAR(cv::mean(seen)[0], 0, 3);
}

TEST(PictureStream, HasAPageThatShowsThem) {
  const PictureStream stream(0);
  const auto page = httplib::Client(stream.url()).Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, testing::HasSubstr("<img src=\"/stream\""));
}

TEST(PictureStream, EndsWhileItIsWatched) {
  std::future<std::string> watched;
  {
    PictureStream stream(0);
    watched = watch(stream, 1);
    awaitWatcher(stream);
  }
  EXPECT_THAT(watched.get(), testing::Not(testing::HasSubstr(kBoundary)));
}

TEST(PictureStream, RefusesAPortThatIsTaken) {
  const PictureStream stream(0);
  const std::string& url = stream.url();
  EXPECT_THROW(PictureStream(std::stoi(url.substr(url.rfind(':') + 1))), std::runtime_error);
}

}  // namespace
}  // namespace heel
