// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "clock.hpp"
#include "library.hpp"

/// What is done with a map; over any tree with OctoMap's names.
namespace rhmap::bench::maps {

/// What a planner keeps beside a map that grows, to look at in peace: OctoMap has nothing but copies.
template <class Tree>
class Follower {
 public:
  explicit Follower(const Tree& map) : map_(map) {}
  void update() { copy_ = std::make_unique<Tree>(map_); }
  std::size_t size() const { return copy_->size(); }

 private:
  const Tree& map_;
  std::unique_ptr<Tree> copy_;
};

/// A map and what the benchmarks put aside in the untimed parts.
template <class Tree>
struct State {
  std::unique_ptr<Tree> map;
  std::unique_ptr<Tree> copy;                ///< of the map as it was before the first benchmark that changes it
  std::unique_ptr<Follower<Tree>> follower;  ///< of the map
};

/// An answer as cheap as a sum: it must not be what is measured.
class Tally {
 public:
  void add(std::uint64_t bits) {
    sum_ += bits;
    ++count_;
  }
  void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  template <class Node>
  void addNode(const Node* node) {
    if (node != nullptr) add(node->getLogOdds());
  }

  std::uint64_t sum() const { return sum_ * 31 + count_; }
  std::size_t count() const { return count_; }

 private:
  std::uint64_t sum_ = 0;
  std::size_t count_ = 0;
};

/// The time of work that answers to a tally and returns its number of operations. The tally is a local variable, so
/// that it stays in registers.
template <class F>
Sample tallied(F&& work) {
  Sample sample;
  sample.seconds = timed([&] {
    Tally tally;
    sample.operations = work(tally);
    sample.answer = tally.sum();
  });
  return sample;
}

// --- search
// -----------------------------------------------------------------------------------------------------------

template <class Tree, class Places>
Sample searchAll(const Tree& map, const Places& places, unsigned depth) {
  return tallied([&](Tally& tally) {
    for (const auto& place : places) tally.addNode(map.search(place, depth));
    return places.size();
  });
}

template <class Tree>
Sample searchLeaves(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return searchAll(*s.map, work.leaves, 0);
}
template <class Tree>
Sample searchPoints(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return searchAll(*s.map, work.points, 0);
}
template <class Tree>
Sample searchAlongRays(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return searchAll(*s.map, work.ray_cells, 0);
}
template <class Tree>
Sample searchAtDepth12(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return searchAll(*s.map, work.leaves, 12);
}

template <class Tree>
Sample castAll(const Tree& map, const MapWorkload& work, bool ignore_unknown) {
  constexpr double kRange = 30;  // [m]
  return tallied([&](Tally& tally) {
    for (const Cast& cast : work.casts) {
      octomap::point3d end;
      tally.add(std::uint64_t{map.castRay(cast.origin, cast.direction, end, ignore_unknown, kRange)});
      tally.add(end.x());
      tally.add(end.y());
      tally.add(end.z());
    }
    return work.casts.size();
  });
}

template <class Tree>
Sample castThroughUnknown(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return castAll(*s.map, work, true);
}
template <class Tree>
Sample castUpToUnknown(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return castAll(*s.map, work, false);
}

// --- iteration
// ----------------------------------------------------------------------------------------------------------

template <class Begin, class End>
Sample iterate(Begin&& begin, End&& end) {
  return tallied([&](Tally& tally) {
    for (auto it = begin(), last = end(); it != last; ++it) tally.add(it->getLogOdds());
    return tally.count();
  });
}

template <class Tree>
Sample iterateLeaves(State<Tree>& s, const MapWorkload&, std::size_t) {
  return iterate([&] { return s.map->begin_leafs(); }, [&] { return s.map->end_leafs(); });
}
template <class Tree>
Sample iterateNodes(State<Tree>& s, const MapWorkload&, std::size_t) {
  return iterate([&] { return s.map->begin_tree(); }, [&] { return s.map->end_tree(); });
}
template <class Tree>
Sample iterateBox(State<Tree>& s, const MapWorkload& work, std::size_t) {
  return iterate([&] { return s.map->begin_leafs_bbx(work.box_min, work.box_max); },
                 [&] { return s.map->end_leafs_bbx(); });
}

template <class Tree>
Sample iterateWithCoordinates(State<Tree>& s, const MapWorkload&, std::size_t) {
  return tallied([&](Tally& tally) {
    std::size_t leaves = 0;
    for (auto it = s.map->begin_leafs(), last = s.map->end_leafs(); it != last; ++it, ++leaves) {
      const octomap::point3d centre = it.getCoordinate();
      tally.add(centre.x() + centre.y() + centre.z());
      tally.add(it.getSize());
    }
    return leaves;
  });
}

/// Through a const tree: the other getters remember the answer.
template <class Tree>
Sample metricBounds(State<Tree>& s, const MapWorkload&, std::size_t) {
  return tallied([&](Tally& tally) {
    double x = 0, y = 0, z = 0;
    const auto add = [&] {
      for (const double v : {x, y, z}) tally.add(v);
    };
    std::as_const(*s.map).getMetricMin(x, y, z);
    add();
    std::as_const(*s.map).getMetricMax(x, y, z);
    add();
    return std::size_t{1};
  });
}

// --- files: the part after the text header
// --------------------------------------------------------------------------------

template <class Tree>
std::string fullBytes(const Tree& map) {
  std::ostringstream out;
  map.writeData(out);
  return std::move(out).str();
}
template <class Tree>
std::string binaryBytes(const Tree& map) {
  std::ostringstream out;
  map.writeBinaryData(out);
  return std::move(out).str();
}

/// Into a stream that has been written to before: the memory that a stream takes for its bytes is not what is measured.
template <class F>
Sample writeBy(F&& write) {
  std::ostringstream out;
  write(out);
  out.seekp(0);
  const double seconds = timed([&] { write(out); });
  return {seconds, 1, std::hash<std::string>()(std::move(out).str())};
}

template <class Tree>
Sample writeFull(State<Tree>& s, const MapWorkload&, std::size_t) {
  return writeBy([&](std::ostream& out) { s.map->writeData(out); });
}
template <class Tree>
Sample writeBinary(State<Tree>& s, const MapWorkload&, std::size_t) {
  return writeBy([&](std::ostream& out) { s.map->writeBinaryData(out); });
}

template <class Tree>
Sample readFull(State<Tree>& s, const MapWorkload&, std::size_t) {
  std::istringstream in(fullBytes(*s.map));
  Tree read(s.map->getResolution());
  const double seconds = timed([&] { read.readData(in); });
  return {seconds, 1, std::hash<std::string>()(fullBytes(read))};
}
template <class Tree>
Sample readBinary(State<Tree>& s, const MapWorkload&, std::size_t) {
  std::istringstream in(binaryBytes(*s.map));
  Tree read(s.map->getResolution());
  const double seconds = timed([&] { read.readBinaryData(in); });
  return {seconds, 1, std::hash<std::string>()(binaryBytes(read))};
}

// --- the whole map
// ----------------------------------------------------------------------------------------------------

template <class Tree>
Tree& copyOf(State<Tree>& s) {
  if (!s.copy) s.copy = std::make_unique<Tree>(*s.map);
  return *s.copy;
}

template <class Tree>
Sample copyMap(State<Tree>& s, const MapWorkload&, std::size_t) {
  std::unique_ptr<Tree> copy;
  const double seconds = timed([&] { copy = std::make_unique<Tree>(*s.map); });
  return {seconds, 1, copy->size()};
}

template <class Tree>
Sample destroyMap(State<Tree>& s, const MapWorkload&, std::size_t) {
  auto copy = std::make_unique<Tree>(*s.map);
  return {timed([&] { copy.reset(); }), 1, 0};
}

template <class Tree>
Sample compareMaps(State<Tree>& s, const MapWorkload&, std::size_t) {
  const Tree& copy = copyOf(s);
  bool equal = false;
  const double seconds = timed([&] { equal = *s.map == copy; });
  return {seconds, 1, equal};
}

template <class Tree>
Sample updateInner(State<Tree>& s, const MapWorkload&, std::size_t) {
  Tree& copy = copyOf(s);
  const double seconds = timed([&] { copy.updateInnerOccupancy(); });
  return {seconds, 1, std::bit_cast<std::uint32_t>(copy.getRoot()->getLogOdds())};
}

template <class Tree>
Sample expandAll(State<Tree>& s, const MapWorkload&, std::size_t) {
  Tree& copy = copyOf(s);
  copy.prune();
  const double seconds = timed([&] { copy.expand(); });
  return {seconds, 1, copy.size()};
}
template <class Tree>
Sample pruneAll(State<Tree>& s, const MapWorkload&, std::size_t) {
  Tree& copy = copyOf(s);
  copy.expand();
  const double seconds = timed([&] { copy.prune(); });
  return {seconds, 1, copy.size()};
}

// --- changes
// -------------------------------------------------------------------------------------------------------------

template <class Cells, class F>
Sample changeAll(const Cells& cells, F&& change) {
  return tallied([&](Tally& tally) {
    for (const CellUpdate& cell : cells) tally.addNode(change(cell));
    return cells.size();
  });
}

template <class Tree>
Sample updateAll(Tree& map, const std::vector<CellUpdate>& cells) {
  return changeAll(cells, [&](const CellUpdate& cell) { return map.updateNode(cell.key, cell.occupied); });
}

template <class Tree>
Sample updateKnown(State<Tree>& s, const MapWorkload& work, std::size_t round) {
  return updateAll(*s.map, work.known_cells[round]);
}
template <class Tree>
Sample updateScattered(State<Tree>& s, const MapWorkload& work, std::size_t round) {
  return updateAll(*s.map, work.scattered_cells[round]);
}
template <class Tree>
Sample updateBox(State<Tree>& s, const MapWorkload& work, std::size_t round) {
  return updateAll(*s.map, work.box_cells[round]);
}
template <class Tree>
Sample setValues(State<Tree>& s, const MapWorkload& work, std::size_t round) {
  return changeAll(work.known_cells[round],
                   [&](const CellUpdate& cell) { return s.map->setNodeValue(cell.key, cell.occupied ? 1.5F : -0.5F); });
}
template <class Tree>
Sample deleteCells(State<Tree>& s, const MapWorkload& work, std::size_t round) {
  const double seconds = timed([&] {
    for (const CellUpdate& cell : work.known_cells[round]) s.map->deleteNode(cell.key);
  });
  return {seconds, work.known_cells[round].size(), s.map->size()};
}

template <class Tree>
Sample follow(State<Tree>& s, const MapWorkload& work, std::size_t round) {
  constexpr std::size_t kCells = 1000;
  if (!s.follower) {
    s.follower = std::make_unique<Follower<Tree>>(*s.map);
    s.follower->update();
  }
  for (std::size_t i = 0; i < std::min(kCells, work.known_cells[round].size()); ++i)
    s.map->updateNode(work.known_cells[round][i].key, work.known_cells[round][i].occupied);
  const double seconds = timed([&] { s.follower->update(); });
  const std::size_t size = s.follower->size();
  if (round + 1 == work.known_cells.size()) s.follower.reset();  // what comes next need not be followed
  return {seconds, 1, size};
}

template <class Tree>
struct Benchmark {
  Title title;
  Sample (*run)(State<Tree>& state, const MapWorkload& work, std::size_t round);
};

/// In this order: the last ones change the map.
template <class Tree>
inline constexpr std::array kBenchmarks{
    Benchmark<Tree>{{"search, random leaves", "call"}, searchLeaves<Tree>},
    Benchmark<Tree>{{"search, random points in the bounds", "call"}, searchPoints<Tree>},
    Benchmark<Tree>{{"search, along rays", "call"}, searchAlongRays<Tree>},
    Benchmark<Tree>{{"search, random leaves, depth 12", "call"}, searchAtDepth12<Tree>},
    Benchmark<Tree>{{"castRay, 30 m, through unknown space", "call"}, castThroughUnknown<Tree>},
    Benchmark<Tree>{{"castRay, 30 m, up to unknown space", "call"}, castUpToUnknown<Tree>},
    Benchmark<Tree>{{"leaf iteration, values", "leaf"}, iterateLeaves<Tree>},
    Benchmark<Tree>{{"leaf iteration, coordinates and sizes", "leaf"}, iterateWithCoordinates<Tree>},
    Benchmark<Tree>{{"tree iteration, values", "node"}, iterateNodes<Tree>},
    Benchmark<Tree>{{"begin_leafs_bbx, 20 x 20 x 6 m, values", "leaf"}, iterateBox<Tree>},
    Benchmark<Tree>{{"getMetricMin and getMetricMax, const", "map"}, metricBounds<Tree>},
    Benchmark<Tree>{{"write .ot", "map"}, writeFull<Tree>},
    Benchmark<Tree>{{"read .ot", "map"}, readFull<Tree>},
    Benchmark<Tree>{{"write .bt", "map"}, writeBinary<Tree>},
    Benchmark<Tree>{{"read .bt", "map"}, readBinary<Tree>},
    Benchmark<Tree>{{"copy", "map"}, copyMap<Tree>},
    Benchmark<Tree>{{"destructor", "map"}, destroyMap<Tree>},
    Benchmark<Tree>{{"operator==", "map"}, compareMaps<Tree>},
    Benchmark<Tree>{{"updateInnerOccupancy", "map"}, updateInner<Tree>},
    Benchmark<Tree>{{"expand", "map"}, expandAll<Tree>},
    Benchmark<Tree>{{"prune, after expand", "map"}, pruneAll<Tree>},
    Benchmark<Tree>{{"a copy to plan on, 1000 cells later: new, or mirror.sync()", "map"}, follow<Tree>},
    Benchmark<Tree>{{"updateNode, random leaves", "call"}, updateKnown<Tree>},
    Benchmark<Tree>{{"setNodeValue, random leaves", "call"}, setValues<Tree>},
    Benchmark<Tree>{{"updateNode, new cells, a solid box", "call"}, updateBox<Tree>},
    Benchmark<Tree>{{"updateNode, new cells, scattered", "call"}, updateScattered<Tree>},
    Benchmark<Tree>{{"deleteNode, random leaves", "call"}, deleteCells<Tree>},
};

}  // namespace rhmap::bench::maps
