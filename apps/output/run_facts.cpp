// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/run_facts.hpp>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <system_error>

namespace heel {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The process's own, so that nobody has to hand them on.
std::vector<std::string> wordsOfTheCall() {
  const std::string text = textOf("/proc/self/cmdline");
  std::vector<std::string> words;
  for (auto begin = text.begin(); begin != text.end();) {
    const auto end = std::find(begin, text.end(), '\0');
    words.emplace_back(begin, end);
    begin = end == text.end() ? end : end + 1;
  }
  if (!words.empty()) words.front() = fs::path(words.front()).filename().string();
  return words;
}

/// The call without what changes no result.
ordered_json asked(const ordered_json& call) {
  static const std::array<std::string, 3> with_value = {"--threads", "--progress", "--max-memory"};
  ordered_json words = ordered_json::array();
  for (std::size_t i = 0; i < call.size(); ++i) {
    const std::string word = call[i].is_string() ? call[i].get<std::string>() : "";
    const std::string name = word.substr(0, word.find('='));
    const bool takes_value =
        std::find(with_value.begin(), with_value.end(), name) != with_value.end();
    if (takes_value && name == word) ++i;
    if (!takes_value && word != "--resume") words.push_back(word);
  }
  return words;
}

void add(const fs::path& file, std::uintmax_t& bytes, std::int64_t& changed_ns) {
  std::error_code gone;
  const auto written = fs::last_write_time(file, gone).time_since_epoch();
  if (gone) return;
  changed_ns = std::max<std::int64_t>(
      changed_ns, std::chrono::duration_cast<std::chrono::nanoseconds>(written).count());
  if (fs::is_regular_file(file, gone)) bytes += fs::file_size(file, gone);
}

ordered_json stateOf(const fs::path& input) {
  std::uintmax_t bytes = 0;
  std::int64_t changed_ns = std::numeric_limits<std::int64_t>::min();
  add(input, bytes, changed_ns);
  std::error_code error;
  if (fs::is_directory(input, error)) {
    using Options = fs::directory_options;
    for (fs::recursive_directory_iterator at(input, Options::skip_permission_denied, error), end;
         !error && at != end; at.increment(error)) {
      add(at->path(), bytes, changed_ns);
    }
  }
  return {{"path", input.string()}, {"bytes", bytes}, {"changed_ns", changed_ns}};
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double secondsSinceBegin() {
  // Field 22 of /proc/self/stat: ticks from the machine's start to the process's. The second, its
  // name, may hold spaces.
  const std::string stat = textOf("/proc/self/stat");
  std::size_t at = stat.rfind(')');
  for (int field = 2; field < 22 && at != std::string::npos; ++field) at = stat.find(' ', at + 1);
  if (at == std::string::npos) return 0.0;
  const double begin_s =
      std::strtod(stat.c_str() + at, nullptr) / static_cast<double>(sysconf(_SC_CLK_TCK));
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return std::max(
      0.0, static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - begin_s);
}

double rounded(double value) { return std::round(100.0 * value) / 100.0; }

}  // namespace

std::string stateOfInputs(const std::vector<fs::path>& inputs) {
  ordered_json states = ordered_json::array();
  for (const fs::path& input : inputs) {
    if (!input.empty()) states.push_back(stateOf(input));
  }
  return states.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::string factsOfThisRun(const std::string& inputs) {
  ordered_json facts;
  facts["heel"] = HEEL_VERSION;
  facts["call"] = wordsOfTheCall();
  facts["inputs"] = ordered_json::parse(inputs, nullptr, false);
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  facts["host"] = host.data();
  facts["cores"] = sysconf(_SC_NPROCESSORS_ONLN);
  const double wall_s = secondsSinceBegin();
  const std::time_t began = std::time(nullptr) - static_cast<std::time_t>(wall_s);
  std::tm utc{};
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&began, &utc));
  facts["began"] = text.data();
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  facts["wall_s"] = rounded(wall_s);
  facts["cpu_s"] = rounded(seconds(used.ru_utime) + seconds(used.ru_stime));
  facts["peak_memory_mib"] = rounded(static_cast<double>(used.ru_maxrss) / 1024.0);
  return facts.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

bool wouldRepeat(const std::string& text) {
  const ordered_json facts = ordered_json::parse(text, nullptr, false);
  const auto is = [&facts](const char* key, const ordered_json& value) {
    return facts.is_object() && facts.contains(key) && facts[key] == value;
  };
  if (!is("heel", HEEL_VERSION) || !facts.contains("call") || !facts["call"].is_array() ||
      !facts.contains("inputs") || !facts["inputs"].is_array() ||
      asked(facts["call"]) != asked(wordsOfTheCall())) {
    return false;
  }
  return std::all_of(facts["inputs"].begin(), facts["inputs"].end(), [](const ordered_json& input) {
    return input.is_object() && input.contains("path") && input["path"].is_string() &&
           stateOf(input["path"].get<std::string>()) == input;
  });
}

}  // namespace heel
