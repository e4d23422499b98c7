// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/bag.hpp>
#include <heel/apps/bag/ros1_folder.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace heel {

namespace fs = std::filesystem;

namespace {

/// When the messages of a file were recorded; behind all others if nothing in it can be read.
struct RecordedSpan {
  fs::path file;
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_ns = first_ns;
};

RecordedSpan spanOf(const fs::path& file) {
  RecordedSpan span{file};
  try {
    const auto bag = openBag(file);
    BagMessage first;
    if (!bag->next(first)) return span;
    const BagIndex* index = bag->index();
    span.first_ns = index != nullptr ? index->first_ns : first.stamp_ns;
    span.last_ns = index != nullptr ? index->last_ns : first.stamp_ns;
  } catch (const std::runtime_error&) {
    // Whoever reads the pieces says so.
  }
  return span;
}

}  // namespace

bool isRos1File(const fs::path& path) {
  return path.extension() == ".bag" ||
         (path.extension() == ".active" && path.stem().extension() == ".bag");
}

bool isRos1Folder(const fs::path& path) {
  bool has_bags = false;
  for (const auto& entry : fs::directory_iterator(path)) {
    const fs::path name = entry.path().filename();
    const fs::path kind = name.extension();
    const bool is_bag = isRos1File(name) && entry.is_regular_file();
    const bool is_text = kind == ".txt" || kind == ".md" || kind == ".yaml";
    if (!is_bag && !is_text && name.native().front() != '.') return false;
    has_bags = has_bags || is_bag;
  }
  return has_bags;
}

std::vector<fs::path> ros1Files(const fs::path& folder) {
  constexpr std::int64_t kTogether_ns = 1'000'000'000;  // a recorder may write out a late message
  std::vector<RecordedSpan> spans;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (isRos1File(entry.path())) spans.push_back(spanOf(entry.path()));
  }
  std::sort(spans.begin(), spans.end(), [](const auto& a, const auto& b) {
    return a.first_ns != b.first_ns ? a.first_ns < b.first_ns : a.file < b.file;
  });
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (i > 0 && spans[i].first_ns < spans[i - 1].last_ns - kTogether_ns) {
      throw std::runtime_error(folder.string() + ": " + spans[i - 1].file.filename().string() +
                               " and " + spans[i].file.filename().string() +
                               " were recorded at the same time, so they are no pieces of one bag; "
                               "name one of them");
    }
    files.push_back(spans[i].file);
  }
  return files;
}

}  // namespace heel
