// SPDX-License-Identifier: BSD-3-Clause
// Stock OctoMap and rhmap under the same names, in one program.
#include <gtest/gtest.h>

#include "world.hpp"

namespace rhmap::test {
namespace {

TEST(TwoWorlds, ShareAProgram) {
  EXPECT_FALSE(stockWorld().isRhmap());
  EXPECT_TRUE(compatWorld().isRhmap());
}

TEST(TwoWorlds, GiveTheSameAnswersAndBytes) {
  const std::vector<std::string> expected = stockWorld().answers(), ours = compatWorld().answers();
  ASSERT_EQ(ours.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_TRUE(ours[i] == expected[i]) << "at step " << i;
}

/// Type of the tree, and whether it travels in binary form.
class Messages : public ::testing::TestWithParam<std::tuple<const char*, bool>> {
 protected:
  Message sentBy(const World& world) const { return world.send(std::get<0>(GetParam()), std::get<1>(GetParam())); }
};

TEST_P(Messages, AreTheSameBytesFromBothSenders) {
  const Message message = sentBy(compatWorld());
  EXPECT_GT(message.data.size(), 1000U);
  EXPECT_TRUE(message == sentBy(stockWorld()));
}

TEST_P(Messages, ArriveAlikeInBothDirections) {
  const World::Received among_stock = stockWorld().receive(sentBy(stockWorld()));
  const World::Received from_us = stockWorld().receive(sentBy(compatWorld()));
  const World::Received to_us = compatWorld().receive(sentBy(stockWorld()));
  EXPECT_TRUE(from_us.ot == among_stock.ot);
  EXPECT_TRUE(to_us.ot == among_stock.ot);
  EXPECT_TRUE(to_us.sent_on == sentBy(stockWorld()));
  EXPECT_TRUE(from_us.sent_on == sentBy(stockWorld()));
}

INSTANTIATE_TEST_SUITE_P(Sent, Messages,
                         ::testing::Combine(::testing::Values("OcTree", "ColorOcTree"), ::testing::Bool()),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) + (std::get<1>(info.param) ? "Binary" : "Full");
                         });

}  // namespace
}  // namespace rhmap::test
