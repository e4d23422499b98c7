// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/shared/terminal.hpp>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <utility>

namespace heel {
namespace {

ProgressStyle progress_style = ProgressStyle::kForPeople;
std::FILE* unended = nullptr;  // where the line of a progress bar is still open

/// Lets what is written next begin on a line of its own, and not behind a progress bar.
void endBarLine() {
  if (unended == nullptr) return;
  std::fputc('\n', unended);
  std::fflush(unended);
  unended = nullptr;
}

/// A byte that commands the terminal; `before` is the one before it.
bool isControl(unsigned char byte, unsigned char before) {
  if (byte < 0x20) return byte != '\n' && byte != '\t';
  if (byte == 0x7F) return true;
  // 0x80 to 0x9F: controls of their own, or after 0xC2; else a part of a letter in UTF-8.
  return byte >= 0x80 && byte <= 0x9F && (before < 0x80 || before == 0xC2);
}

/// Writes all of it, as stdio wants it: 0 if that fails.
ssize_t writeFiltered(void* filter, const char* bytes, std::size_t size) {
  endBarLine();
  const std::string text = (*static_cast<TerminalText*>(filter))({bytes, size});
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t now = write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (now < 0 && errno != EINTR) return 0;
    done += static_cast<std::size_t>(std::max<ssize_t>(now, 0));
  }
  return static_cast<ssize_t>(size);
}

}  // namespace

std::string TerminalText::operator()(std::string_view text) {
  std::string clean(text);
  for (char& c : clean) {
    const auto byte = static_cast<unsigned char>(c);
    if (isControl(byte, before_)) c = '?';
    before_ = byte;
  }
  return clean;
}

std::string sentenceForTerminal(std::string_view text) {
  std::string clean = TerminalText()(text);
  std::replace(clean.begin(), clean.end(), '\n', ' ');
  return clean;
}

void tell(const std::string& sentence) {
  endBarLine();
  std::fprintf(stderr, "heel: %s\n", sentenceForTerminal(sentence).c_str());
}

TerminalOutput::TerminalOutput() : stdout_(stdout) {
  std::FILE* filtered = fopencookie(&text_, "w", {nullptr, writeFiltered, nullptr, nullptr});
  if (filtered == nullptr) return;  // no memory; the run will say so
  if (isatty(STDOUT_FILENO) == 1) std::setvbuf(filtered, nullptr, _IOLBF, BUFSIZ);
  stdout = filtered;
}

TerminalOutput::~TerminalOutput() {
  if (stdout == stdout_) return;
  std::fclose(stdout);
  stdout = stdout_;
}

void setProgressStyle(ProgressStyle style) { progress_style = style; }

ProgressBar::ProgressBar(std::string title, std::size_t total, std::FILE* out)
    : title_(std::move(title)), total_(total), out_(out), on_terminal_(isatty(fileno(out)) == 1) {
  show(0);
}

ProgressBar::~ProgressBar() {
  if (unended == out_) endBarLine();
}

void ProgressBar::show(std::size_t done) {
  if (total_ == 0) return;
  done = std::min(done, total_);
  const int percent = static_cast<int>(100 * done / total_);
  const int step = on_terminal_ || progress_style == ProgressStyle::kJson ? 1 : 10;
  if (shown_percent_ >= 0 && percent / step == shown_percent_ / step) return;
  shown_percent_ = percent;
  draw(done, percent);
}

void ProgressBar::draw(std::size_t done, int percent) const {
  if (progress_style == ProgressStyle::kJson) {
    const nlohmann::ordered_json line = {{"progress", title_}, {"done", done}, {"of", total_}};
    std::fprintf(out_, "%s\n", line.dump().c_str());
  } else if (on_terminal_) {
    constexpr std::size_t kWidth = 30;
    const std::size_t full = kWidth * done / total_;
    const std::string bar = std::string(full, '#') + std::string(kWidth - full, '.');
    std::fprintf(out_, "\r%s [%s] %3d %% (%zu of %zu)", title_.c_str(), bar.c_str(), percent, done,
                 total_);
    unended = out_;
  } else {
    std::fprintf(out_, "%s: %d %% (%zu of %zu)\n", title_.c_str(), percent, done, total_);
  }
  std::fflush(out_);
}

}  // namespace heel
