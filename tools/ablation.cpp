// SPDX-License-Identifier: BSD-3-Clause
#include "ablation.hpp"

#include <array>

namespace rhmap::tools {
namespace {

/// A profile and what is changed in it.
struct Row {
  const char* name;
  const char* profile;
  void (*change)(RemovalConfig& config);
};

constexpr std::array kRows{
    Row{"paper", "paper", [](RemovalConfig&) {}},
    Row{"paper, front end only", "paper", [](RemovalConfig& config) { config.back_end.enabled = false; }},
    Row{"paper, regions of 4", "paper", [](RemovalConfig& config) { config.region_size = 4; }},
    Row{"paper, regions of 16", "paper", [](RemovalConfig& config) { config.region_size = 16; }},
    Row{"paper, R-GPE off", "paper", [](RemovalConfig& config) { config.ground.enabled = false; }},
    Row{"paper, 2D only", "paper", [](RemovalConfig& config) { config.context.three_d = false; }},
    Row{"paper + protect", "paper", [](RemovalConfig& config) { config.protect_hits = true; }},
    Row{"paper + protect + hshrink", "paper",
        [](RemovalConfig& config) { config.protect_hits = config.shrink_heights = true; }},
    Row{"paper + visibility", "paper", [](RemovalConfig& config) { config.visibility.enabled = true; }},
    Row{"paper, 2D only + visibility", "paper",
        [](RemovalConfig& config) {
          config.context.three_d = false;
          config.visibility.enabled = true;
        }},
    Row{"fast, front end only", "fast", [](RemovalConfig& config) { config.back_end.enabled = false; }},
    Row{"fast", "fast", [](RemovalConfig&) {}},
    Row{"default", "default", [](RemovalConfig&) {}},
    Row{"default, front end only", "default", [](RemovalConfig& config) { config.back_end.enabled = false; }},
    Row{"default, regions of 4", "default", [](RemovalConfig& config) { config.region_size = 4; }},
    Row{"default, regions of 16", "default", [](RemovalConfig& config) { config.region_size = 16; }},
    Row{"default, R-GPE off", "default", [](RemovalConfig& config) { config.ground.enabled = false; }},
    Row{"default, 3D context", "default", [](RemovalConfig& config) { config.context.three_d = true; }},
    Row{"default - protect", "default", [](RemovalConfig& config) { config.protect_hits = false; }},
    Row{"default - hshrink", "default", [](RemovalConfig& config) { config.shrink_heights = false; }},
    Row{"default - visibility", "default", [](RemovalConfig& config) { config.visibility.enabled = false; }},
    Row{"default - looking everywhere", "default", [](RemovalConfig& config) { config.evidence.everywhere = false; }},
    Row{"default - neighbourhood", "default",
        [](RemovalConfig& config) { config.evidence.share = config.evidence.sure_share = 0; }},
    Row{"default - what stands", "default", [](RemovalConfig& config) { config.standing.enabled = false; }},
    Row{"default - leftovers", "default", [](RemovalConfig& config) { config.leftovers.enabled = false; }},
    Row{"default - looking back", "default", [](RemovalConfig& config) { config.look_back.enabled = false; }},
    Row{"default - void", "default", [](RemovalConfig& config) { config.free_space.enabled = false; }},
};

}  // namespace

std::vector<MapperRow> ablationRows(const RemovalOptions& options) {
  std::vector<MapperRow> rows;
  for (const Row& row : kRows) {
    rows.push_back({row.name, removalConfig(row.profile, options)});
    row.change(rows.back().config);
  }
  return rows;
}

}  // namespace rhmap::tools
