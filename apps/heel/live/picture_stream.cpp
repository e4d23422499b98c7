// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/live/picture_stream.hpp>

#include <httplib.h>
#include <opencv2/imgcodecs.hpp>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace heel {
namespace {

constexpr const char* kPage =
    "<!doctype html><meta charset=\"utf-8\"><title>heel</title>"
    "<body style=\"margin:0;background:#111\">"
    "<img src=\"/stream\" alt=\"what the camera sees\" style=\"width:100%\">";

}  // namespace

struct PictureStream::Server {
  /// Sends pictures as they come, until there are no more or the browser has gone.
  auto provider() {
    return [this, sent = std::size_t{0}](std::size_t, httplib::DataSink& sink) mutable {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return ends || shown != sent; });
      if (ends) return false;
      sent = shown;
      const auto picture = jpeg;
      lock.unlock();
      const std::string head = "--picture\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                               std::to_string(picture->size()) + "\r\n\r\n";
      return sink.write(head.data(), head.size()) &&
             sink.write(reinterpret_cast<const char*>(picture->data()), picture->size()) &&
             sink.write("\r\n", 2);
    };
  }

  httplib::Server http;
  std::thread thread;
  mutable std::mutex mutex;  // for what follows
  std::condition_variable changed;
  std::shared_ptr<const std::vector<unsigned char>> jpeg;
  std::size_t shown = 0;
  int watching = 0;
  bool ends = false;
};

PictureStream::PictureStream(int port) : server_(std::make_unique<Server>()) {
  constexpr const char* kHost = "127.0.0.1";
  Server& server = *server_;
  // By default two programs could share a port.
  server.http.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.http.set_keep_alive_max_count(1);
  server.http.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(kPage, "text/html");
  });
  server.http.Get("/stream", [&server](const httplib::Request&, httplib::Response& response) {
    const std::lock_guard lock(server.mutex);
    ++server.watching;
    response.set_content_provider("multipart/x-mixed-replace; boundary=picture", server.provider(),
                                  [&server](bool) {
                                    const std::lock_guard gone(server.mutex);
                                    --server.watching;
                                  });
  });
  if (port == 0) {
    port = server.http.bind_to_any_port(kHost);
  } else if (!server.http.bind_to_port(kHost, port)) {
    throw std::runtime_error("the port " + std::to_string(port) +
                             " is not free; choose another by --port");
  }
  if (port < 0) throw std::runtime_error("no port is free");
  url_ = std::string("http://") + kHost + ':' + std::to_string(port);
  server.thread = std::thread([&server] { server.http.listen_after_bind(); });
  while (!server.http.is_running()) std::this_thread::yield();  // stop() would not be heard
}

PictureStream::~PictureStream() {
  {
    const std::lock_guard lock(server_->mutex);
    server_->ends = true;
  }
  server_->changed.notify_all();
  server_->http.stop();
  server_->thread.join();
}

bool PictureStream::isWatched() const {
  const std::lock_guard lock(server_->mutex);
  return server_->watching > 0;
}

void PictureStream::show(const cv::Mat& picture_bgr) {
  auto jpeg = std::make_shared<std::vector<unsigned char>>();
  cv::imencode(".jpg", picture_bgr, *jpeg);
  {
    const std::lock_guard lock(server_->mutex);
    server_->jpeg = std::move(jpeg);
    ++server_->shown;
  }
  server_->changed.notify_all();
}

}  // namespace heel
