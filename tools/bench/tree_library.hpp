// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <memory>

#include "library.hpp"
#include "map_benchmarks.hpp"
#include "rhmap/baseline/resident_memory.hpp"
#include "scan_benchmarks.hpp"

namespace rhmap::bench {

/// Any tree with OctoMap's names, and the set of keys that goes with it, as a Library.
template <class Tree, class KeySet>
class TreeLibrary final : public Library {
 public:
  explicit TreeLibrary(double resolution) : resolution_(resolution) {}

  Sample insert(std::size_t benchmark, const WorldScan& scan, double max_range) override {
    Tree& tree = treeOf(benchmark);
    const double seconds = timed([&] { scans::kFunctions<Tree, KeySet>[benchmark](tree, scan, max_range); });
    return {seconds, 1, tree.size()};
  }

  std::uint64_t finish(std::size_t benchmark) override {
    const Tree& tree = treeOf(benchmark);
    std::uint64_t hash = tree.size();
    const auto add = [&hash](std::uint64_t bits) { hash = (std::rotl(hash, 23) ^ bits) * 0x9e3779b97f4a7c15U; };
    for (auto it = tree.begin_tree(), last = tree.end_tree(); it != last; ++it) {
      const octomap::OcTreeKey key = it.getKey();
      add(std::uint64_t{key[0]} | std::uint64_t{key[1]} << 16 | std::uint64_t{key[2]} << 32 |
          std::uint64_t{it.getDepth()} << 48);
      add(std::bit_cast<std::uint32_t>(it->getLogOdds()));
    }
    if (benchmark != 0) variant_.reset();
    return hash;
  }

  bool readBinary(std::istream& stream) override {
    state_.map = std::make_unique<Tree>(resolution_);
    return state_.map->readBinary(stream);
  }

  std::size_t nodeCount() const override { return state_.map->size(); }

  std::vector<octomap::OcTreeKey> leafKeys() const override {
    std::vector<octomap::OcTreeKey> keys;
    for (auto it = state_.map->begin_leafs(), last = state_.map->end_leafs(); it != last; ++it)
      keys.push_back(it.getKey());
    return keys;
  }

  std::vector<bool> known(std::span<const octomap::OcTreeKey> keys) const override {
    std::vector<bool> known;
    for (const octomap::OcTreeKey& key : keys) known.push_back(state_.map->search(key) != nullptr);
    return known;
  }

  Sample run(std::size_t benchmark, const MapWorkload& work, std::size_t round) override {
    return maps::kBenchmarks<Tree>[benchmark].run(state_, work, round);
  }

  std::optional<std::size_t> destroyForMemory() override {
    return releasedMemory([this] { state_.map.reset(); });
  }

 private:
  Tree& treeOf(std::size_t scan_benchmark) {
    std::unique_ptr<Tree>& tree = scan_benchmark == 0 ? state_.map : variant_;
    if (!tree) tree = std::make_unique<Tree>(resolution_);
    return *tree;
  }

  double resolution_;
  maps::State<Tree> state_;
  std::unique_ptr<Tree> variant_;  ///< of a scan benchmark other than number 0
};

}  // namespace rhmap::bench
