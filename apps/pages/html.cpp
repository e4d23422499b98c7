// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/html.hpp>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>

namespace heel {
namespace {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= n ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

double distanceToLine(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * along).norm();
}

/// Marks which points between `first` and `last` (both kept) are kept.
void markKept(const std::vector<Eigen::Vector2d>& points, std::size_t first, std::size_t last,
              double tolerance, std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = distanceToLine(points[i], points[from], points[to]);
      if (d > worst) {
        worst = d;
        at = i;
      }
    }
    if (at == from) continue;
    kept[at] = true;
    open.emplace_back(from, at);
    open.emplace_back(at, to);
  }
}

}  // namespace

std::string escapedHtml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string scriptJson(const nlohmann::ordered_json& value) {
  std::string out;
  // Bytes that are no UTF-8 are replaced, not refused: a name must not cost us the page.
  for (const char c : value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) {
    if (c == '<') {
      out += "\\u003c";
    } else if (c == '>') {
      out += "\\u003e";
    } else if (c == '&') {
      out += "\\u0026";
    } else {
      out += c;
    }
  }
  return out;
}

std::string pictureAddress(const cv::Mat& picture_bgr, int max_width_px) {
  if (picture_bgr.empty()) return {};
  cv::Mat fitted = picture_bgr;
  if (picture_bgr.cols > max_width_px) {
    const double scale = static_cast<double>(max_width_px) / picture_bgr.cols;
    const int height = std::max(1, cvRound(picture_bgr.rows * scale));
    cv::resize(picture_bgr, fitted, {max_width_px, height}, 0, 0, cv::INTER_AREA);
  }
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", fitted, bytes, {cv::IMWRITE_JPEG_QUALITY, 84});
  return "data:image/jpeg;base64," + base64(bytes);
}

std::string filledTemplate(std::string_view page,
                           const std::map<std::string, std::string>& values) {
  std::string out;
  std::set<std::string> used;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t open = std::min(page.find("{{", at), page.size());
    out += page.substr(at, open - at);
    if (open == page.size()) break;
    const std::size_t close = page.find("}}", open);
    if (close == std::string_view::npos) throw std::logic_error("page: a {{ without its }}");
    const std::string name(page.substr(open + 2, close - open - 2));
    const auto value = values.find(name);
    if (value == values.end()) throw std::logic_error("page: nothing to put in for " + name);
    out += value->second;
    used.insert(name);
    at = close + 2;
  }
  for (const auto& [name, value] : values) {
    if (used.count(name) == 0) throw std::logic_error("page: no place for " + name);
  }
  return out;
}

std::string shownNumber(double value, int decimals, std::string_view unit) {
  const std::string number = fixedText(value, decimals);
  if (number.empty()) return "\u2013";
  return unit.empty() ? number : number + "\u00a0" + std::string(unit);
}

std::string svgPath(const std::vector<Eigen::Vector2d>& points, int decimals) {
  std::string path;
  bool is_down = false;
  for (const auto& p : points) {
    if (!p.allFinite()) {
      is_down = false;
      continue;
    }
    path += is_down ? 'L' : 'M';
    path += fixedText(p.x(), decimals) + ' ' + fixedText(p.y(), decimals);
    is_down = true;
  }
  return path;
}

std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& points,
                                        double tolerance) {
  std::vector<bool> kept(points.size(), false);
  for (std::size_t first = 0; first < points.size();) {
    kept[first] = true;
    if (!points[first].allFinite()) {
      ++first;
      continue;
    }
    std::size_t last = first;
    while (last + 1 < points.size() && points[last + 1].allFinite()) ++last;
    kept[last] = true;
    markKept(points, first, last, tolerance, kept);
    first = last + 1;
  }
  std::vector<Eigen::Vector2d> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) out.push_back(points[i]);
  }
  return out;
}

}  // namespace heel
