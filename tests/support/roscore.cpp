// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/roscore.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace heel::test {
namespace {

/// Calls bind() or connect() with a socket for a port of this machine; 0 is any that is free.
/// @return  The port; 0 if it failed.
int tryPort(int (*call)(int, const sockaddr*, socklen_t), int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  auto* any = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const bool is_done = call(socket, any, size) == 0 && getsockname(socket, any, &size) == 0;
  close(socket);
  return is_done ? ntohs(address.sin_port) : 0;
}

}  // namespace

bool Roscore::isInstalled() { return std::system("command -v roscore > /dev/null") == 0; }

Roscore::Roscore() : port_(tryPort(bind, 0)) {
  setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + std::to_string(port_)).c_str(), 1);
  setenv("ROS_IP", "127.0.0.1", 1);
  for (const char* folder : {"ROS_HOME", "ROS_LOG_DIR"}) setenv(folder, folder_.path().c_str(), 1);
  start();
}

void Roscore::start() {
  const std::string log = folder_ / "roscore.log", port = std::to_string(port_);
  process_ = fork();
  if (process_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int file = open(log.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execlp("roscore", "roscore", "-p", port.c_str(), nullptr);
    _exit(127);
  }
  for (int i = 0; i < 600; ++i) {
    if (tryPort(connect, port_) != 0) return;
    usleep(100000);
  }
  stop();
  throw std::runtime_error("roscore does not answer: " + readText(log));
}

void Roscore::stop() {
  if (process_ < 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace heel::test
