// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/terminal/progress_bar.hpp>

#include <unistd.h>

#include <algorithm>
#include <utility>

namespace heel {

ProgressBar::ProgressBar(std::string title, std::size_t total, std::FILE* out)
    : title_(std::move(title)), total_(total), out_(out), on_terminal_(isatty(fileno(out)) == 1) {
  show(0);
}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && shown_percent_ >= 0) std::fputc('\n', out_);
}

void ProgressBar::show(std::size_t done) {
  if (total_ == 0) return;
  done = std::min(done, total_);
  const int percent = static_cast<int>(100 * done / total_);
  const int step = on_terminal_ ? 1 : 10;
  if (shown_percent_ >= 0 && percent / step == shown_percent_ / step) return;
  shown_percent_ = percent;
  draw(done, percent);
}

void ProgressBar::draw(std::size_t done, int percent) const {
  if (on_terminal_) {
    constexpr std::size_t kWidth = 30;
    const std::size_t full = kWidth * done / total_;
    const std::string bar = std::string(full, '#') + std::string(kWidth - full, '.');
    std::fprintf(out_, "\r%s [%s] %3d %% (%zu of %zu)", title_.c_str(), bar.c_str(), percent, done,
                 total_);
  } else {
    std::fprintf(out_, "%s: %d %% (%zu of %zu)\n", title_.c_str(), percent, done, total_);
  }
  std::fflush(out_);
}

}  // namespace heel
