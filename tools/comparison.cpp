// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.hpp"

#include <sstream>

#include "ground_cells.hpp"
#include "octomap_rows.hpp"
#include "progress_bar.hpp"
#include "rhmap/octree/map_file.hpp"

namespace rhmap::tools {
namespace {

/// What a mapper writes, as a tree.
std::unique_ptr<OcTree> copyOf(const Mapper& mapper) {
  std::stringstream bytes;
  mapper.write(bytes);
  std::unique_ptr<AbstractOcTree> tree = readFullMap(bytes);
  return std::unique_ptr<OcTree>(dynamic_cast<OcTree*>(tree.release()));
}

void mapWithBoth(const io::ScanSequence& sequence, Comparison& comparison) {
  const std::vector<std::string> kinds{"rhmap", "octomap"};
  MappingRun run(kinds, comparison.options.mapping);
  for (const std::string& kind : kinds) comparison.series.push_back({.name = kind, .seconds = {}, .memory = {}});
  comparison.points = run.insert(sequence, comparison.frames, "mapping", [&] {
    for (std::size_t k = 0; k < run.size(); ++k) comparison.series[k].memory.push_back(run.map(k).memoryUsage());
  });
  comparison.identity = run.compareBytes();
  if (!comparison.identity.ot || !comparison.options.profiles.empty()) comparison.octomap = copyOf(run.map(1));
  if (!comparison.identity.ot) comparison.difference = differenceOf(*copyOf(run.map(0)), *comparison.octomap);
  comparison.maps = run.finish();
  for (std::size_t k = 0; k < kinds.size(); ++k) comparison.series[k].seconds = comparison.maps[k].seconds;
}

/// The cells that the points of a scan lie in, those outside of the map's ranges left out.
void addHits(const io::Scan& scan, const RhMap& map, KeySet& hits) {
  const RemovalConfig& config = map.config();
  OcTreeKey key;
  for (const octomap::point3d& point : scan.points) {
    const double range = point.norm();
    if (range < config.min_range || (config.max_range >= 0 && range > config.max_range)) continue;
    if (map.coordToKeyChecked(scan.pose.transform(point), key)) hits.insert(key);
  }
}

void clean(const io::ScanSequence& sequence, const std::string& profile, Comparison& comparison) {
  RemovalConfig config = removalProfile(profile);
  config.min_range = comparison.options.mapping.min_range;
  config.max_range = comparison.options.mapping.max_range.value_or(-1);
  RhMap map(comparison.options.mapping.resolution, config);
  MapperSeries series{.name = "rhmap " + profile, .seconds = {}, .memory = {}};
  RemovalFigures figures =
      runRemoval(sequence, comparison.frames, map, profile, [&](const io::Scan& scan, const RhMap& now) {
        series.memory.push_back(now.memoryUsage() + now.removalMemoryUsage());
        if (!comparison.cleaned.empty()) return;  // the first profile's will do
        addGround(scan, now, comparison.ground);
        addHits(scan, now, comparison.hits);
      });
  series.seconds = figures.seconds;
  comparison.series.push_back(std::move(series));
  comparison.cleaned.push_back({profile, std::make_unique<OcTree>(map), std::move(figures)});
}

void score(const io::ScanSequence& sequence, eval::EvaluationConfig config, Comparison& comparison) {
  config.window = windowOf(comparison);
  if (config.rhmap) config.rhmap->resolution = comparison.options.mapping.resolution;
  std::vector<eval::Estimate> rows = octomapRows(*comparison.octomap, comparison.ground);
  for (const CleanedMap& cleaned : comparison.cleaned)
    rows.push_back(eval::keptInMap("rhmap " + cleaned.profile, *cleaned.map));
  ProgressBar bar("evaluating", eval::numReads(sequence, config));
  comparison.scores = eval::evaluate(sequence, config, rows, [&bar] { bar.advance(); });
}

}  // namespace

Comparison compareMappers(const ComparisonOptions& options, const eval::EvaluationConfig& protocols) {
  requireExists(options.sequence);
  const auto sequence = io::openSequence(options.sequence);
  Comparison comparison;
  comparison.options = options;
  comparison.frames = chooseFrames(options.frames, options.sequence, sequence->size());
  mapWithBoth(*sequence, comparison);
  for (const std::string& profile : options.profiles) clean(*sequence, profile, comparison);
  if (!options.profiles.empty() && sequence->hasLabels()) score(*sequence, protocols, comparison);
  return comparison;
}

eval::SequenceWindow windowOf(const Comparison& comparison) {
  return {.first = comparison.frames.first,
          .last = comparison.frames.last,
          .min_range = comparison.options.mapping.min_range,
          .max_range = comparison.options.mapping.max_range};
}

}  // namespace rhmap::tools
