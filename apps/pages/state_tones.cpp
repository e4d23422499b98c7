// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/pages/state_tones.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

namespace heel {
namespace {

const std::map<std::string, std::string> kTones = {
    {"learn", "learn"},         {"follow", "follow"},
    {"face", "face"},           {"goToLastSeen", "return"},
    {"turnToLastSeen", "seek"}, {"seek", "seek"},
    {"search", "search"},       {"look", "search"},
    {"stop", "stop"},           {"wait", "stop"}};
constexpr std::array<const char*, 4> kFurtherTones = {"a", "b", "c", "d"};

}  // namespace

std::string wordsOf(const std::string& state) {
  std::string words;
  for (const char c : state) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isupper(byte) != 0 && !words.empty()) words += ' ';
    words += c == '_' ? ' ' : static_cast<char>(std::tolower(byte));
  }
  return words.empty() ? "no state" : words;
}

std::string StateTones::of(const std::string& state) {
  const auto known = std::find(states_.begin(), states_.end(), state);
  if (known != states_.end()) return tones_[static_cast<std::size_t>(known - states_.begin())];
  const auto own = kTones.find(state);
  const std::string tone =
      own != kTones.end() ? own->second : kFurtherTones[others_++ % kFurtherTones.size()];
  states_.push_back(state);
  tones_.push_back("--s-" + tone);
  return tones_.back();
}

}  // namespace heel
