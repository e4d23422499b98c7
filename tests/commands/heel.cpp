// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/commands/heel.hpp"

#include "tests/support/temp_folder.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace heel::test {

namespace {

const std::string kError = "heel: ";
const std::string kWarning = "heel: warning: ";

bool startsWith(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// A file without a name that takes a stream of the command.
class Capture {
 public:
  Capture() : file_(std::tmpfile()) {
    if (file_ == nullptr) throw std::runtime_error("no temporary file");
  }
  ~Capture() { std::fclose(file_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int descriptor() const { return fileno(file_); }

  /// Read at its place, so that whoever writes it goes on at its end.
  std::string text() const {
    std::string all;
    std::array<char, 4096> part{};
    for (ssize_t got = 1; got > 0;) {
      got = pread(descriptor(), part.data(), part.size(), static_cast<off_t>(all.size()));
      if (got > 0) all.append(part.data(), static_cast<std::size_t>(got));
    }
    return all;
  }

 private:
  std::FILE* file_;
};

template <typename Takes>
std::vector<std::string> linesOf(const std::string& text, const Takes& takes) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (takes(line)) lines.push_back(line);
  }
  return lines;
}

std::string described(const HeelRun& run) {
  return "exit code " + std::to_string(run.exit_code) + ", signal " + std::to_string(run.signal) +
         "\n--- stdout\n" + run.out + "--- stderr\n" + run.err;
}

/// @param meanwhile  Called with the process and what it says on stderr, as soon as it runs.
template <typename Meanwhile>
HeelRun run(const std::vector<std::string>& arguments, std::optional<std::size_t> largest_file,
            const Meanwhile& meanwhile) {
  std::vector<char*> argv = {const_cast<char*>(HEEL_COMMAND)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const Capture out, err;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child == 0) {
    dup2(out.descriptor(), STDOUT_FILENO);
    dup2(err.descriptor(), STDERR_FILENO);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    if (largest_file) {
      const rlimit limit{*largest_file, *largest_file};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    execv(HEEL_COMMAND, argv.data());
    _exit(127);
  }
  meanwhile(child, err);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  HeelRun result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.out = out.text();
  result.err = err.text();
  result.peak_kB = usage.ru_maxrss;
  return result;
}

}  // namespace

std::vector<std::string> HeelRun::errors() const {
  static const std::regex kProgress(
      "[a-z]+: [0-9]+ % \\([0-9]+ of [0-9]+\\)|\\{\"progress\":.*\\}");
  return linesOf(err, [](const std::string& line) {
    return !startsWith(line, kWarning) && !std::regex_match(line, kProgress);
  });
}

std::vector<std::string> HeelRun::warnings() const {
  auto lines = linesOf(err, [](const std::string& line) { return startsWith(line, kWarning); });
  for (std::string& line : lines) line.erase(0, kWarning.size());
  return lines;
}

HeelRun heel(const std::vector<std::string>& arguments, std::optional<std::size_t> largest_file) {
  return run(arguments, largest_file, [](pid_t, const Capture&) {});
}

std::vector<std::string> joined(std::vector<std::string> call,
                                const std::vector<std::string>& more) {
  call.insert(call.end(), more.begin(), more.end());
  return call;
}

HeelRun heel(const std::vector<std::string>& arguments, const std::vector<std::string>& more) {
  return heel(joined(arguments, more));
}

HeelRun heelUntil(const std::vector<std::string>& arguments, const std::string& text,
                  const std::function<void(pid_t)>& then) {
  return run(arguments, std::nullopt, [&](pid_t child, const Capture& err) {
    siginfo_t ended{};
    while (err.text().find(text) == std::string::npos) {
      waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
      if (ended.si_pid != 0) return;  // too early: the test will see
      usleep(200);
    }
    then(child);
  });
}

HeelRun heelSignalled(const std::vector<std::string>& arguments, const std::string& text,
                      const std::vector<int>& signals) {
  return heelUntil(arguments, text, [&](pid_t child) {
    for (const int signal : signals) kill(child, signal);
  });
}

testing::AssertionResult succeeds(const HeelRun& run) {
  if (run.succeeded() && run.errors().empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << described(run);
}

testing::AssertionResult findsNothing(const HeelRun& run) {
  if (run.signal == 0 && run.exit_code == 4 && run.errors().size() == 1) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << described(run);
}

testing::AssertionResult endsWell(const HeelRun& run) {
  return run.exit_code == 4 ? findsNothing(run) : succeeds(run);
}

testing::AssertionResult failsWith(const HeelRun& run, const std::vector<std::string>& parts) {
  const auto errors = run.errors();
  bool is_right = run.signal == 0 && run.exit_code != 0 && run.out.empty() && errors.size() == 1 &&
                  startsWith(errors.front(), kError);
  for (const std::string& part : parts) {
    is_right = is_right && errors.front().find(part) != std::string::npos;
  }
  if (is_right) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "expected one error with " << testing::PrintToString(parts) << "\n"
         << described(run);
}

nlohmann::json summaryIn(const std::filesystem::path& folder) {
  return nlohmann::json::parse(readText(folder / "summary.json"));
}

std::vector<std::string> filesBelow(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  if (!std::filesystem::exists(folder)) return names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_directory() && entry.path().extension() != ".heel" &&
        entry.path().filename() != ".heel") {
      names.push_back(std::filesystem::relative(entry.path(), folder).string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::map<std::string, std::size_t> contentOf(const std::filesystem::path& folder) {
  std::map<std::string, std::size_t> content;
  for (const std::string& name : filesBelow(folder)) {
    content[name] = std::hash<std::string>{}(readText(folder / name));
  }
  return content;
}

}  // namespace heel::test
