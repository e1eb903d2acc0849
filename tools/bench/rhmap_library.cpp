// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/octomap_mirror.hpp"
#include "rhmap/core/key_set.hpp"
#include "rhmap/octree/octree.hpp"
#include "tree_library.hpp"

namespace rhmap::bench {

/// A map of OctoMap's that is brought up to date.
template <>
class maps::Follower<OcTree> {
 public:
  explicit Follower(const OcTree& map) : mirror_(map) {}
  void update() { mirror_.sync(); }
  std::size_t size() const { return mirror_.size(); }

 private:
  OctomapMirror mirror_;
};

namespace {

constexpr auto kMapTitles = [] {
  std::array<Title, maps::kBenchmarks<OcTree>.size()> titles;
  for (std::size_t i = 0; i < titles.size(); ++i) titles[i] = maps::kBenchmarks<OcTree>[i].title;
  return titles;
}();

}  // namespace

std::span<const Title> scanTitles() { return scans::kTitles; }
std::span<const Title> mapTitles() { return kMapTitles; }

std::unique_ptr<Library> makeRhmap(double resolution) {
  return std::make_unique<TreeLibrary<OcTree, KeySet>>(resolution);
}

}  // namespace rhmap::bench
