// SPDX-License-Identifier: BSD-3-Clause
// rhmap info: what a map file holds.
#include <fmt/format.h>
#include <octomap/OcTree.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "load_map.hpp"
#include "text.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

constexpr unsigned kTreeDepth = 16;

constexpr const char* kFooter =
    "MAP is a .bt file, whatever the type of its tree, or the .ot file of an OcTree, ColorOcTree or OcTreeStamped.\n"
    "Bounds are those of all known space, free space included. OctoMap's memory is its own estimate of its tree for\n"
    "this map; what it occupies in truth is some times as much.\n\n"
    "Examples:\n"
    "  rhmap info data/maps/geb079.bt\n"
    "  rhmap info data/maps/geb079.bt --json -";

struct InfoOptions {
  std::string map;
  std::string json;
};

/// Leaves of one kind.
struct LeafCount {
  std::size_t leaves = 0;
  double volume = 0;  ///< [m^3]
};

/// What `rhmap info` tells.
struct MapInfo {
  std::string path;
  MapFormat format = MapFormat::kBinary;
  MapHeader header;
  std::uintmax_t file_bytes = 0;
  std::size_t nodes = 0;
  LeafCount occupied;
  LeafCount free;
  std::array<LeafCount, kTreeDepth + 1> occupied_at{};  ///< by depth of the leaf
  std::array<LeafCount, kTreeDepth + 1> free_at{};
  std::array<double, 3> min{};  ///< of all known space [m]
  std::array<double, 3> max{};
  std::size_t memory = 0;          ///< of rhmap's tree [bytes]
  std::size_t octomap_memory = 0;  ///< what OctoMap's memoryUsage() would say [bytes]
};

void count(LeafCount& leaves, double edge) {
  ++leaves.leaves;
  leaves.volume += edge * edge * edge;
}

/// OctoMap's memoryUsage(): 16 bytes a node, and 64 bytes more for each that has children.
std::size_t octomapMemory(std::size_t nodes, std::size_t leaves) {
  using Base = octomap::OcTreeBaseImpl<octomap::OcTreeNode, octomap::AbstractOccupancyOcTree>;
  return sizeof(Base) + nodes * sizeof(octomap::OcTreeNode) + (nodes - leaves) * 8 * sizeof(void*);
}

/// Counts the leaves, by what they are and how large.
template <class TREE>
void gatherLeaves(const TREE& tree, MapInfo& info) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const bool is_occupied = tree.isNodeOccupied(*leaf);
    count(is_occupied ? info.occupied : info.free, leaf.getSize());
    count((is_occupied ? info.occupied_at : info.free_at)[leaf.getDepth()], leaf.getSize());
  }
}

MapInfo gather(const std::string& path) {
  const LoadedMap map = loadMap(path);
  const AbstractOccupancyOcTree& tree = *map.tree;
  MapInfo info;
  info.path = path;
  info.format = map.format;
  info.header = map.header;
  info.file_bytes = std::filesystem::file_size(path);
  info.nodes = tree.size();
  visitTree(tree, [&](const auto& typed) { gatherLeaves(typed, info); });
  tree.getMetricMin(info.min[0], info.min[1], info.min[2]);
  tree.getMetricMax(info.max[0], info.max[1], info.max[2]);
  info.memory = tree.memoryUsage();
  info.octomap_memory = octomapMemory(info.nodes, info.occupied.leaves + info.free.leaves);
  return info;
}

std::string toText(const MapInfo& info) {
  const auto point = [](const std::array<double, 3>& p) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", p[0], p[1], p[2]);
  };
  std::string text;
  text += fmt::format("file        {} ({})\n", info.path, byteSize(info.file_bytes));
  text += fmt::format("format      {}\n",
                      info.format == MapFormat::kBinary ? ".bt, most likely states" : ".ot, all log-odds");
  text += fmt::format("id          {}\n", info.header.id);
  text += fmt::format("resolution  {} m\n", info.header.resolution);
  text += fmt::format("nodes       {}, the header says {}\n", grouped(info.nodes), grouped(info.header.size));
  text += fmt::format("leaves      {}\n", grouped(info.occupied.leaves + info.free.leaves));
  text += fmt::format("occupied    {} leaves, {:.6g} m^3\n", grouped(info.occupied.leaves), info.occupied.volume);
  text += fmt::format("free        {} leaves, {:.6g} m^3\n", grouped(info.free.leaves), info.free.volume);
  text += fmt::format("bounds      {} to {} m\n", point(info.min), point(info.max));
  text += fmt::format("memory      {} in rhmap, {} in OctoMap by its own estimate\n", byteSize(info.memory),
                      byteSize(info.octomap_memory));
  text += fmt::format("\n{:>5} {:>12} {:>14} {:>14}\n", "depth", "edge [m]", "occupied", "free");
  for (unsigned depth = 0; depth <= kTreeDepth; ++depth) {
    const LeafCount& occupied = info.occupied_at[depth];
    const LeafCount& free = info.free_at[depth];
    if (occupied.leaves + free.leaves == 0) continue;
    text += fmt::format("{:>5} {:>12.6g} {:>14} {:>14}\n", depth, info.header.resolution * (1U << (kTreeDepth - depth)),
                        grouped(occupied.leaves), grouped(free.leaves));
  }
  return text;
}

nlohmann::ordered_json toJson(const MapInfo& info) {
  nlohmann::ordered_json json{{"file", info.path},
                              {"file_bytes", info.file_bytes},
                              {"format", info.format == MapFormat::kBinary ? "bt" : "ot"},
                              {"id", info.header.id},
                              {"resolution_m", info.header.resolution},
                              {"header_size", info.header.size},
                              {"nodes", info.nodes},
                              {"leaves", info.occupied.leaves + info.free.leaves},
                              {"occupied_leaves", info.occupied.leaves},
                              {"free_leaves", info.free.leaves},
                              {"occupied_volume_m3", info.occupied.volume},
                              {"free_volume_m3", info.free.volume},
                              {"min_m", info.min},
                              {"max_m", info.max},
                              {"memory_bytes", info.memory},
                              {"octomap_memory_estimate_bytes", info.octomap_memory}};
  json["leaves_by_depth"] = nlohmann::ordered_json::array();
  for (unsigned depth = 0; depth <= kTreeDepth; ++depth) {
    const std::size_t occupied = info.occupied_at[depth].leaves;
    const std::size_t free = info.free_at[depth].leaves;
    if (occupied + free > 0)
      json["leaves_by_depth"].push_back({{"depth", depth}, {"occupied", occupied}, {"free", free}});
  }
  return json;
}

void printInfo(const InfoOptions& options) {
  const MapInfo info = gather(options.map);
  if (options.json != "-") fmt::print("{}", toText(info));
  if (!options.json.empty()) writeJson(options.json, toJson(info));
}

}  // namespace

void addInfo(CLI::App& app) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* verb = app.add_subcommand("info", "Show what a map holds");
  verb->add_option("MAP", options->map, "Map to read, .bt or .ot")->required()->type_name("");
  verb->add_option("--json", options->json, "Write the figures as JSON, - for stdout")
      ->type_name("FILE")
      ->check(outputFileOrStdout());
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { printInfo(*options); });
}

}  // namespace rhmap::tools
