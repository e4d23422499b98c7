// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/simulation/color.hpp>

#include <cmath>
#include <cstdint>
#include <map>

namespace heel {
namespace {

const std::map<std::string, std::uint32_t>& namedColors() {
  static const std::map<std::string, std::uint32_t> kColors = {
      {"amber", 0xD9901A},    {"aqua", 0x5FB8B8},       {"beige", 0xD8C8A8},
      {"black", 0x1C1C1E},    {"blue", 0x2A55B0},       {"brown", 0x5A3A22},
      {"burgundy", 0x6A1B2D}, {"charcoal", 0x35383C},   {"chestnut", 0x6B3A24},
      {"cream", 0xEFE6D0},    {"crimson", 0xA8202E},    {"denim", 0x3C4F73},
      {"forest", 0x24502E},   {"ginger", 0xA85A24},     {"gold", 0xB88A2C},
      {"green", 0x3C8A46},    {"grey", 0x808488},       {"khaki", 0x8E8460},
      {"lavender", 0x9C8EC0}, {"lime", 0x8CB840},       {"mint", 0xA8D8C0},
      {"mustard", 0xC0982C},  {"navy", 0x1E2848},       {"oak", 0xA87C4C},
      {"olive", 0x5E6030},    {"orange", 0xD86A20},     {"pink", 0xD88CA0},
      {"plum", 0x5C2A50},     {"purple", 0x66388C},     {"red", 0xB81E24},
      {"rust", 0x94482A},     {"sand", 0xC4AE88},       {"silver", 0xB0B4B8},
      {"sky", 0x84B0D8},      {"slate", 0x586470},      {"tan", 0xB08C64},
      {"teal", 0x1E7078},     {"terracotta", 0xB0603C}, {"turquoise", 0x36A8A0},
      {"violet", 0x7850A8},   {"walnut", 0x5C4030},     {"white", 0xEAEAE8},
      {"yellow", 0xE0C030},   {"skin_light", 0xE0B090}, {"skin_tan", 0xB88058},
      {"skin_dark", 0x6E4830}};
  return kColors;
}

Rgb fromHex(std::uint32_t rgb) {
  const auto channel = [rgb](unsigned shift) {
    return toLinear(static_cast<float>((rgb >> shift) & 0xFFU) / 255.0F);
  };
  return {channel(16), channel(8), channel(0)};
}

}  // namespace

std::optional<Rgb> parseColor(const std::string& text) {
  if (text.size() == 7 && text[0] == '#' &&
      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
    return fromHex(static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16)));
  }
  const auto found = namedColors().find(text);
  if (found == namedColors().end()) return std::nullopt;
  return fromHex(found->second);
}

std::string colorNames() {
  std::string names;
  for (const auto& [name, value] : namedColors()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

float toDisplay(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

float toLinear(float display) {
  return display <= 0.04045F ? display / 12.92F : std::pow((display + 0.055F) / 1.055F, 2.4F);
}

}  // namespace heel
