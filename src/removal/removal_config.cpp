// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/removal_config.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace rhmap {
namespace {

constexpr std::array<std::string_view, 3> kProfiles{"paper", "fast", "default"};
constexpr double kAny = std::numeric_limits<double>::max();

void require(bool right, const char* field, double value, const char* what) {
  if (!right)
    throw std::invalid_argument("RemovalConfig::" + std::string(field) + " is " + std::to_string(value) + ", not " +
                                what);
}

void between(double low, double high, const char* field, double value, const char* what) {
  require(value >= low && value <= high, field, value, what);  // not NaN
}

void length(const char* field, double value) { between(1e-6, kAny, field, value, "a length above 0"); }
void atLeast0(const char* field, double value) { between(0, kAny, field, value, "0 or more"); }
void atLeast1(const char* field, double value) { between(1, kAny, field, value, "1 or more"); }
void share(const char* field, double value) { between(0, 1, field, value, "a share between 0 and 1"); }

}  // namespace

RemovalConfig paperProfile() {
  RemovalConfig config;
  config.protect_hits = false;
  config.shrink_heights = false;
  config.ground.across_regions = false;
  config.ground.depth = 0;
  config.ground.max_step = 0;
  config.ground.around = 0;
  config.ground.thin = -1;
  config.context.max_range = 50;
  config.context.three_d = true;
  config.context.min_points = 1;
  config.context.min_height = 0;
  config.visibility.enabled = false;
  config.evidence.everywhere = false;
  config.evidence.share = config.evidence.sure_share = 0;
  config.standing.enabled = false;
  config.free_space.enabled = false;
  config.look_back.enabled = false;
  config.leftovers.enabled = false;
  config.back_end.revert_hits = 0;
  return config;
}

RemovalConfig fastProfile() {
  RemovalConfig config;
  config.ground.around = 0;
  config.evidence.everywhere = false;
  config.evidence.share = config.evidence.sure_share = 0.25;
  config.free_space.enabled = false;
  config.look_back.enabled = false;
  return config;
}

RemovalConfig defaultProfile() { return {}; }

std::span<const std::string_view> removalProfiles() { return kProfiles; }

RemovalConfig removalProfile(std::string_view name) {
  if (name == "paper") return paperProfile();
  if (name == "fast") return fastProfile();
  if (name == "default") return defaultProfile();
  throw std::invalid_argument("there is no profile " + std::string(name) + "; one of: paper, fast, default");
}

void validate(const RemovalConfig& c) {
  require(c.region_size == 4 || c.region_size == 8 || c.region_size == 16, "region_size", c.region_size, "4, 8 or 16");
  atLeast0("min_range", c.min_range);
  require(!std::isnan(c.max_range), "max_range", c.max_range, "a number");
  length("ground.r_gro", c.ground.r_gro);
  share("ground.min_upright", c.ground.min_upright);
  between(3, kAny, "ground.min_cubes", c.ground.min_cubes, "3 or more");
  atLeast1("ground.iterations", c.ground.iterations);
  atLeast0("ground.min_growth", c.ground.min_growth);
  atLeast0("ground.depth", c.ground.depth);
  atLeast0("ground.max_step", c.ground.max_step);
  atLeast0("ground.around", c.ground.around);
  atLeast0("ground.raised", c.ground.raised);
  atLeast0("ground.rise", c.ground.rise);
  require(!std::isnan(c.ground.thin), "ground.thin", c.ground.thin, "a number");
  between(0, 512, "image.rows", c.image.rows, "between 0 and 512");
  between(16, 8192, "image.columns", c.image.columns, "between 16 and 8192");
  between(-90, 90, "image.fov_up", c.image.fov_up, "between -90 and 90");
  between(-90, 90, "image.fov_down", c.image.fov_down, "between -90 and 90");
  between(1e-6, 1000, "context.max_range", c.context.max_range, "above 0 and up to 1000 m");
  atLeast0("context.delta_1", c.context.delta_1);
  atLeast0("context.delta_2", c.context.delta_2);
  length("context.r_1", c.context.r_1);
  length("context.r_2", c.context.r_2);
  atLeast0("context.r_share", c.context.r_share);
  atLeast0("context.min_height", c.context.min_height);
  atLeast0("visibility.behind", c.visibility.behind);
  atLeast0("visibility.before", c.visibility.before);
  length("visibility.aside", c.visibility.aside);
  atLeast0("visibility.aside_share", c.visibility.aside_share);
  atLeast0("visibility.surface", c.visibility.surface);
  atLeast0("visibility.surface_share", c.visibility.surface_share);
  atLeast0("visibility.clearance", c.visibility.clearance);
  atLeast0("visibility.skim", c.visibility.skim);
  atLeast0("visibility.skim_from", c.visibility.skim_from);
  atLeast0("visibility.edge_share", c.visibility.edge_share);
  length("visibility.ball", c.visibility.ball);
  between(0, 16, "visibility.window", c.visibility.window, "between 0 and 16");
  atLeast1("evidence.interval", c.evidence.interval);
  atLeast1("evidence.doubtful_interval", c.evidence.doubtful_interval);
  atLeast1("evidence.ground_interval", c.evidence.ground_interval);
  between(1, 255, "evidence.misses", c.evidence.misses, "between 1 and 255");
  between(1, 255, "evidence.sure_misses", c.evidence.sure_misses, "between 1 and 255");
  between(1, 255, "evidence.firm", c.evidence.firm, "between 1 and 255");
  between(1, 7, "evidence.filled", c.evidence.filled, "between 1 and 7");
  share("evidence.share", c.evidence.share);
  atLeast0("evidence.enough", c.evidence.enough);
  atLeast0("evidence.sure_ratio", c.evidence.sure_ratio);
  length("evidence.sure_reach", c.evidence.sure_reach);
  share("evidence.sure_share", c.evidence.sure_share);
  between(1, 255, "standing.scans", c.standing.scans, "between 1 and 255");
  atLeast0("standing.time", c.standing.time);
  between(0, 100, "standing.crossed", c.standing.crossed, "between 0 and 100");
  length("free_space.cell", c.free_space.cell);
  between(1e-6, 200, "free_space.max_range", c.free_space.max_range, "above 0 and up to 200 m");
  atLeast0("free_space.surface", c.free_space.surface);
  atLeast1("free_space.interval", c.free_space.interval);
  between(1, 7, "free_space.tau_f", c.free_space.tau_f, "between 1 and 7");
  atLeast0("free_space.least_new", c.free_space.least_new);
  between(1, 255, "free_space.tau_r", c.free_space.tau_r, "between 1 and 255");
  between(0, 16, "free_space.growth", c.free_space.growth, "between 0 and 16");
  atLeast0("free_space.known", c.free_space.known);
  between(1, 64, "look_back.scans", c.look_back.scans, "between 1 and 64");
  atLeast1("look_back.stride", c.look_back.stride);
  share("look_back.share", c.look_back.share);
  atLeast0("look_back.least", c.look_back.least);
  atLeast0("look_back.growth", c.look_back.growth);
  atLeast0("look_back.near", c.look_back.near);
  length("leftovers.reach", c.leftovers.reach);
  atLeast0("leftovers.least", c.leftovers.least);
  share("leftovers.share", c.leftovers.share);
  atLeast0("leftovers.others", c.leftovers.others);
  atLeast1("leftovers.interval", c.leftovers.interval);
  length("back_end.distance", c.back_end.distance);
  atLeast1("back_end.scans", c.back_end.scans);
  atLeast0("back_end.information", c.back_end.information);
  atLeast0("back_end.delay", c.back_end.delay);
  atLeast0("back_end.max_queue", c.back_end.max_queue);
  atLeast0("back_end.revert_hits", c.back_end.revert_hits);
}

}  // namespace rhmap
