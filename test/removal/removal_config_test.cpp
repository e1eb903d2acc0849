// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/removal_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace rhmap {
namespace {

using testing::HasSubstr;

TEST(RemovalConfig, AllProfilesAreValid) {
  for (const std::string_view name : removalProfiles()) EXPECT_NO_THROW(validate(removalProfile(name))) << name;
}

TEST(RemovalConfig, AnUnknownProfileIsAnsweredWithTheRightOnes) {
  try {
    removalProfile("best");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("best"));
    for (const std::string_view name : removalProfiles()) EXPECT_THAT(error.what(), HasSubstr(std::string(name)));
  }
}

TEST(RemovalConfig, AWrongValueIsNamed) {
  struct Wrong {
    std::function<void(RemovalConfig&)> change;
    const char* field;
    const char* value;
  };
  const Wrong all[] = {
      {[](RemovalConfig& c) { c.region_size = 5; }, "region_size", "5"},
      {[](RemovalConfig& c) { c.min_range = -1; }, "min_range", "-1"},
      {[](RemovalConfig& c) { c.min_range = NAN; }, "min_range", "nan"},
      {[](RemovalConfig& c) { c.ground.iterations = 0; }, "ground.iterations", "0"},
      {[](RemovalConfig& c) { c.image.columns = 2; }, "image.columns", "2"},
      {[](RemovalConfig& c) { c.evidence.share = 1.5; }, "evidence.share", "1.5"},
      {[](RemovalConfig& c) { c.ground.depth = -1; }, "ground.depth", "-1"},
      {[](RemovalConfig& c) { c.ground.around = -1; }, "ground.around", "-1"},
      {[](RemovalConfig& c) { c.ground.raised = NAN; }, "ground.raised", "nan"},
      {[](RemovalConfig& c) { c.ground.rise = -2; }, "ground.rise", "-2"},
      {[](RemovalConfig& c) { c.visibility.aside = 0; }, "visibility.aside", "0"},
      {[](RemovalConfig& c) { c.visibility.aside_share = -1; }, "visibility.aside_share", "-1"},
      {[](RemovalConfig& c) { c.visibility.clearance = NAN; }, "visibility.clearance", "nan"},
      {[](RemovalConfig& c) { c.visibility.skim = -1; }, "visibility.skim", "-1"},
      {[](RemovalConfig& c) { c.visibility.skim_from = NAN; }, "visibility.skim_from", "nan"},
      {[](RemovalConfig& c) { c.evidence.filled = 8; }, "evidence.filled", "8"},
      {[](RemovalConfig& c) { c.leftovers.reach = 0; }, "leftovers.reach", "0"},
      {[](RemovalConfig& c) { c.leftovers.least = -1; }, "leftovers.least", "-1"},
      {[](RemovalConfig& c) { c.leftovers.share = 2; }, "leftovers.share", "2"},
      {[](RemovalConfig& c) { c.leftovers.others = -1; }, "leftovers.others", "-1"},
      {[](RemovalConfig& c) { c.leftovers.interval = 0; }, "leftovers.interval", "0"},
      {[](RemovalConfig& c) { c.standing.scans = 256; }, "standing.scans", "256"},
      {[](RemovalConfig& c) { c.standing.time = -1; }, "standing.time", "-1"},
      {[](RemovalConfig& c) { c.standing.crossed = 1e9; }, "standing.crossed", "1000000000"},
      {[](RemovalConfig& c) { c.look_back.near = -1; }, "look_back.near", "-1"},
      {[](RemovalConfig& c) { c.evidence.enough = -3; }, "evidence.enough", "-3"},
      {[](RemovalConfig& c) { c.visibility.edge_share = -0.5; }, "visibility.edge_share", "-0.5"},
      {[](RemovalConfig& c) { c.visibility.ball = 0; }, "visibility.ball", "0"},
      {[](RemovalConfig& c) { c.evidence.sure_ratio = -2; }, "evidence.sure_ratio", "-2"},
      {[](RemovalConfig& c) { c.evidence.sure_reach = 0; }, "evidence.sure_reach", "0"},
      {[](RemovalConfig& c) { c.free_space.least_new = NAN; }, "free_space.least_new", "nan"},
      {[](RemovalConfig& c) { c.evidence.doubtful_interval = 0; }, "evidence.doubtful_interval", "0"},
      {[](RemovalConfig& c) { c.evidence.ground_interval = 0; }, "evidence.ground_interval", "0"},
      {[](RemovalConfig& c) { c.free_space.interval = 0; }, "free_space.interval", "0"},
      {[](RemovalConfig& c) { c.free_space.tau_f = 9; }, "free_space.tau_f", "9"},
      {[](RemovalConfig& c) { c.look_back.stride = 0; }, "look_back.stride", "0"},
      {[](RemovalConfig& c) { c.back_end.distance = 0; }, "back_end.distance", "0"},
  };
  for (const Wrong& wrong : all) {
    RemovalConfig config;
    wrong.change(config);
    try {
      validate(config);
      ADD_FAILURE() << wrong.field;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(wrong.field));
      EXPECT_THAT(error.what(), HasSubstr(wrong.value));
    }
  }
}

}  // namespace
}  // namespace rhmap
