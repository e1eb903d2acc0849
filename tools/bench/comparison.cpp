// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "child_process.hpp"

namespace rhmap::bench {
namespace {

struct Pair {
  explicit Pair(double resolution) : octomap(makeOctomap(resolution)), rhmap(makeRhmap(resolution)) {}
  std::unique_ptr<Library> octomap, rhmap;
};

/// Millions of small nodes were freed, of OctoMap's tree or of key sets. glibc puts off joining and sorting them until
/// the next large allocations, whoever makes them: outside of the measurement it is nobody's.
void tidyHeap() {
  malloc_trim(0);  // joins
  for (int i = 0; i < 1000; ++i) {
    void* volatile large = std::malloc(1 << 16);  // sorts the next ten thousand
    std::free(large);
  }
}

/// Measures both libraries, in turns with a different one first, so that neither always finds the caches as the other
/// left them.
template <class F>
void measure(Pair& pair, Row& row, std::size_t turn, F&& run) {
  std::array<Sample, 2> samples;  // octomap, rhmap
  for (const std::size_t which : {turn % 2, 1 - turn % 2}) {
    samples[which] = run(which == 0 ? *pair.octomap : *pair.rhmap);
    tidyHeap();
  }
  row.octomap.push_back(samples[0].seconds / static_cast<double>(samples[0].operations));
  row.rhmap.push_back(samples[1].seconds / static_cast<double>(samples[1].operations));
  row.operations = samples[1].operations;
  row.same_answers =
      row.same_answers && samples[0].answer == samples[1].answer && samples[0].operations == samples[1].operations;
}

MemoryRow memoryOf(Pair& pair, std::string map) {
  const auto bytes = [](Library& library) {
    const auto released = inChildProcess([&] { return library.destroyForMemory().value_or(0); });
    if (released.value_or(0) == 0) throw std::runtime_error("the memory of a map cannot be measured on this system");
    return *released;
  };
  return {std::move(map), pair.rhmap->nodeCount(), bytes(*pair.octomap), bytes(*pair.rhmap),
          pair.octomap->nodeCount() == pair.rhmap->nodeCount()};
}

void readMap(Library& library, const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !library.readBinary(stream)) throw std::runtime_error(file.string() + " cannot be read as a .bt map");
}

}  // namespace

void compare(std::span<const WorldScan> scans, double resolution, const ComparisonConfig& config,
             const std::function<void(const Row&)>& done, const std::function<void(const MemoryRow&)>& memory_done) {
  const auto wanted = [&](const Title& title) { return config.wants(title.name); };
  if (std::ranges::none_of(scanTitles(), wanted) && std::ranges::none_of(mapTitles(), wanted)) return;
  Pair pair(resolution);

  for (std::size_t b = 0; b < scanTitles().size(); ++b) {
    const Title& title = scanTitles()[b];
    if (b != 0 && !wanted(title)) continue;
    Row row{.resolution = resolution, .title = title};
    const std::size_t count = b == 0 ? scans.size() : std::min(scans.size(), config.variant_scans);
    for (std::size_t i = 0; i < count; ++i)
      measure(pair, row, i, [&](Library& library) { return library.insert(b, scans[i], config.max_range); });
    row.same_answers = row.same_answers && pair.octomap->finish(b) == pair.rhmap->finish(b);
    malloc_trim(0);
    if (wanted(title)) done(row);
    if (b == 0 && config.only.empty()) memory_done(memoryOf(pair, fmt::format("the scans, {} m", resolution)));
  }

  const MapWorkload work = drawWorkload(*pair.rhmap, resolution, scans, config.rounds);
  for (std::size_t b = 0; b < mapTitles().size(); ++b) {
    if (!wanted(mapTitles()[b])) continue;
    Row row{.resolution = resolution, .title = mapTitles()[b]};
    for (std::size_t round = 0; round < config.rounds; ++round)
      measure(pair, row, round, [&](Library& library) { return library.run(b, work, round); });
    done(row);
  }
}

MemoryRow compareMemory(const std::filesystem::path& bt_file) {
  Pair pair(0.1);
  readMap(*pair.octomap, bt_file);
  readMap(*pair.rhmap, bt_file);
  return memoryOf(pair, bt_file.filename().string());
}

}  // namespace rhmap::bench
