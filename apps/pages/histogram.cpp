// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/output/csv_file.hpp>
#include <heel/apps/pages/histogram.hpp>
#include <heel/apps/pages/html.hpp>
#include <heel/apps/pages/time_scale.hpp>

#include <algorithm>
#include <cmath>

namespace heel {

std::vector<int> binned(const std::vector<double>& values, double first, double step, int bins) {
  std::vector<int> counts(static_cast<std::size_t>(std::max(0, bins)), 0);
  for (const double value : values) {
    const double at = (value - first) / step;
    if (!(at >= 0.0 && at <= bins) || counts.empty()) continue;
    ++counts[std::min(static_cast<std::size_t>(at), counts.size() - 1)];
  }
  return counts;
}

std::string histogram(const std::string& title, const std::string& unit,
                      const std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  const std::string head =
      "<figure class=\"histogram\"><figcaption><b>" + title + "</b> [" + unit + "]</figcaption>";
  if (known.empty()) return head + "<p class=\"note\">no values</p></figure>\n";
  std::sort(known.begin(), known.end());
  const double range = known.back() - known.front();
  const double step = niceStep(range > 0.0 ? range : std::max(std::abs(known.back()), 1e-3), 14);
  const double first = std::floor(known.front() / step) * step;
  const int bins = std::max(1, static_cast<int>(std::ceil((known.back() - first) / step + 1e-9)));
  const std::vector<int> counts = binned(known, first, step, bins);
  const int most = *std::max_element(counts.begin(), counts.end());
  const int decimals = step >= 1.0 ? 0 : static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  const double width = 300.0 / bins;

  std::string bars;
  for (int i = 0; i < bins; ++i) {
    const int count = counts[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    const double height = 96.0 * count / std::max(1, most);
    bars += "<rect x=\"" + fixedText(i * width + 1.0, 1) + "\" y=\"" +
            fixedText(100.0 - height, 1) + "\" width=\"" +
            fixedText(std::max(1.0, width - 2.0), 1) + "\" height=\"" + fixedText(height, 1) +
            "\"><title>" + fixedText(first + i * step, decimals) + " to " +
            fixedText(first + (i + 1) * step, decimals) + " " + unit + ": " +
            std::to_string(count) + "</title></rect>";
  }
  const double middle = known[known.size() / 2];
  return head + "<svg viewBox=\"0 0 300 100\" role=\"img\" aria-label=\"Histogram: " + title +
         "\">" + bars + "<path d=\"M0 100H300\"/></svg><div class=\"ends\"><span>" +
         fixedText(first, decimals) + "</span><span>median " + fixedText(middle, decimals + 1) +
         "</span><span>" + fixedText(first + bins * step, decimals) + "</span></div></figure>\n";
}

}  // namespace heel
