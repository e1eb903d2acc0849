// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/score.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace rhmap::eval {
namespace {

TEST(Labels, MovingAre251To259AndNothingElse) {
  const Labels labels;
  for (std::uint32_t label = 0; label < 0x10000; ++label) {
    const Kind kind = label == 0 ? Kind::kIgnored : label >= 251 && label <= 259 ? Kind::kDynamic : Kind::kStatic;
    ASSERT_EQ(labels.kind(label), kind) << label;
  }
}

TEST(Labels, LooksAtTheClassAndNotAtTheInstance) {
  const Labels labels;
  EXPECT_EQ(labels.kind(259U | 0xffff0000U), Kind::kDynamic);  // 2^24 and more: a float would have rounded it
  EXPECT_EQ(labels.kind(0U | 252U << 16), Kind::kIgnored);
}

TEST(Labels, TakesOtherClassesAndRefusesContradictions) {
  const std::array<std::uint16_t, 1> one{9};
  const Labels labels(one, {});
  EXPECT_TRUE(labels.isDynamic(9));
  EXPECT_EQ(labels.kind(0), Kind::kStatic);
  EXPECT_THROW(Labels(one, one), std::invalid_argument);
}

TEST(Counts, GiveTheRatesOfThePapers) {
  Counts counts{.still = {200, 150}, .moving = {10, 1}, .classes = {}};
  EXPECT_DOUBLE_EQ(*counts.staticKept(), 0.75);
  EXPECT_DOUBLE_EQ(*counts.dynamicRemoved(), 0.9);
  EXPECT_DOUBLE_EQ(*counts.harmonicMean(), 2 * 0.75 * 0.9 / 1.65);
  EXPECT_DOUBLE_EQ(*counts.geometricMean(), std::sqrt(0.75 * 0.9));
}

TEST(Counts, RatesWithoutAnythingBelowTheLineAreAbsent) {
  const Counts nothing;
  EXPECT_FALSE(nothing.staticKept() || nothing.dynamicRemoved() || nothing.harmonicMean() || nothing.geometricMean());
  const Counts no_movers{.still = {4, 4}, .moving = {}, .classes = {}};
  EXPECT_EQ(no_movers.staticKept(), 1.0);
  EXPECT_FALSE(no_movers.dynamicRemoved() || no_movers.harmonicMean() || no_movers.geometricMean());
  EXPECT_FALSE(removed({}));
}

TEST(Counts, TwoRatesOf0HaveMeansOf0) {
  const Counts counts{.still = {4, 0}, .moving = {3, 3}, .classes = {}};
  EXPECT_EQ(counts.harmonicMean(), 0.0);
  EXPECT_EQ(counts.geometricMean(), 0.0);
}

TEST(Counts, AddByKindAndClass) {
  const Labels labels;
  Counts counts;
  counts.add(labels, 0, true);
  counts.add(labels, 9, true);
  counts.add(labels, 40, false);
  counts.add(labels, 252 | 7U << 16, true);
  counts.add(labels, 252, false);
  counts.add(labels, 254, false);
  EXPECT_EQ(counts, (Counts{.still = {2, 1}, .moving = {3, 1}, .classes = {{252, {2, 1}}, {254, {1, 0}}}}));
}

TEST(Counts, ClassesAreSummedBetweenTwoThatCount) {
  const Counts counts{.still = {}, .moving = {}, .classes = {{251, {5, 4}}, {252, {2, 1}}, {254, {1, 0}}}};
  EXPECT_EQ(counts.movingOf(252, 254), (Survivors{3, 1}));
  EXPECT_EQ(counts.movingOf(251, 251), (Survivors{5, 4}));
  EXPECT_EQ(counts.movingOf(255, 259), Survivors{});
}

}  // namespace
}  // namespace rhmap::eval
