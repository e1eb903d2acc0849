// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/score.hpp"

#include <cmath>

namespace rhmap::eval {
namespace {

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

void count(Survivors& survivors, bool kept) {
  ++survivors.total;
  if (kept) ++survivors.kept;
}

}  // namespace

std::optional<double> removed(const Survivors& survivors) {
  return share(survivors.total - survivors.kept, survivors.total);
}

void Counts::add(const Labels& labels, std::uint32_t label, bool kept) {
  switch (labels.kind(label)) {
    case Kind::kIgnored:
      return;
    case Kind::kStatic:
      return count(still, kept);
    case Kind::kDynamic:
      count(moving, kept);
      return count(classes[static_cast<std::uint16_t>(label & 0xffffU)], kept);
  }
}

Survivors Counts::movingOf(std::uint16_t first, std::uint16_t last) const {
  Survivors sum;
  for (auto found = classes.lower_bound(first); found != classes.end() && found->first <= last; ++found) {
    sum.total += found->second.total;
    sum.kept += found->second.kept;
  }
  return sum;
}

std::optional<double> Counts::staticKept() const { return share(still.kept, still.total); }

std::optional<double> Counts::dynamicRemoved() const { return removed(moving); }

std::optional<double> Counts::harmonicMean() const {
  const auto a = staticKept(), b = dynamicRemoved();
  if (!a || !b) return std::nullopt;
  return *a + *b > 0 ? 2 * *a * *b / (*a + *b) : 0;
}

std::optional<double> Counts::geometricMean() const {
  const auto a = staticKept(), b = dynamicRemoved();
  if (!a || !b) return std::nullopt;
  return std::sqrt(*a * *b);
}

}  // namespace rhmap::eval
