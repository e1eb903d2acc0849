// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace rhmap::tools {

inline double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// 0 of nothing, as the median.
inline double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : total(values) / static_cast<double>(values.size());
}

/// The middle one, or half way between the two in the middle.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The least of the values that this share of them does not exceed; 0 of nothing.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

}  // namespace rhmap::tools
