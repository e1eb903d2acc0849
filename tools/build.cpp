// SPDX-License-Identifier: BSD-3-Clause
// rhmap build: the scans of a sequence become a map.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "arguments.hpp"
#include "build_summary.hpp"
#include "progress_bar.hpp"
#include "rhmap/baseline/mapper.hpp"
#include "rhmap/baseline/resident_memory.hpp"
#include "rhmap/baseline/worker.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "rhmap/io/scan_sequence.hpp"
#include "text.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

/// A map and the thread that it lives in, so that several can be measured side by side.
struct Job {
  std::unique_ptr<Worker> worker = std::make_unique<Worker>();
  std::unique_ptr<Mapper> mapper;
};

constexpr std::array<std::string_view, 2> kMapExtensions{".bt", ".ot"};

constexpr const char* kFooter =
    "SEQUENCE is a folder in KITTI's or SemanticKITTI's layout (velodyne/*.bin, poses.txt), a .graph or .log file of\n"
    "OctoMap, or one scan as .dat or .xyz. Points nearer than --min-range are dropped (2.7 drops the car under a "
    "KITTI\n"
    "LiDAR), rays are cut at --max-range.\n"
    "A .bt file holds the most likely state of every cell, pruned, like OctoMap's writeBinary(); an .ot file holds "
    "all\n"
    "log-odds. Resident memory is the physical memory that the process gives back when the map is destroyed;\n"
    "memoryUsage() is what the tree says of itself.\n\n"
    "Examples:\n"
    "  rhmap build data/maps/spherical_scan.graph map.bt\n"
    "  rhmap build data/maps/spherical_scan.graph map.bt map.ot --resolution 0.05 --json summary.json\n"
    "  rhmap build data/maps/spherical_scan.graph map.ot --max-range 20 --compare";

/// The points of a scan from `min_range` [m] on, in the world frame.
octomap::Pointcloud worldPoints(const io::Scan& scan, double min_range) {
  octomap::Pointcloud points;
  points.reserve(scan.points.size());
  for (const octomap::point3d& point : scan.points) {
    if (point.norm() >= min_range) points.push_back(point);
  }
  points.transform(scan.pose);
  return points;
}

double secondsOf(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// All mappers take scan after scan together, and take turns at going first, so that neither has the warmer caches.
void insertScans(const io::ScanSequence& sequence, std::vector<Job>& jobs, BuildSummary& summary) {
  const auto [first, last] = summary.frames;
  const double max_range = summary.options.max_range.value_or(-1);
  ProgressBar bar("building", last - first + 1);
  for (std::size_t i = first; i <= last; ++i) {
    const io::Scan scan = sequence.scan(i);
    const octomap::Pointcloud points = worldPoints(scan, summary.options.min_range);
    summary.points += points.size();
    summary.dropped += scan.dropped + scan.points.size() - points.size();
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      const std::size_t turn = (i + k) % jobs.size();
      Mapper& mapper = *jobs[turn].mapper;
      jobs[turn].worker->run([&] {
        summary.maps[turn].seconds.push_back(secondsOf([&] { mapper.insert(points, scan.pose.trans(), max_range); }));
      });
    }
    bar.advance();
  }
}

/// Whether two maps write the same bytes.
bool sameBytes(const Mapper& a, const Mapper& b, void (Mapper::*write)(std::ostream&) const) {
  std::ostringstream bytes_a, bytes_b;
  (a.*write)(bytes_a);
  (b.*write)(bytes_b);
  return bytes_a.view() == bytes_b.view();
}

WrittenFile writeMap(const std::string& path, const Mapper& mapper) {
  const auto write = extensionOf(path) == ".bt" ? &Mapper::writeBinary : &Mapper::write;
  writeFileWhole(path, [&](std::ostream& out) { (mapper.*write)(out); });
  return writtenFile(path);
}

void build(const BuildOptions& options) {
  if (options.compare && options.mapper == "octomap")
    throw UsageError("--compare measures rhmap against OctoMap; leave --mapper octomap out");
  requireExists(options.sequence);
  const auto sequence = io::openSequence(options.sequence);
  BuildSummary summary;
  summary.options = options;
  summary.frames = chooseFrames(options.frames, options.sequence, sequence->size());

  std::vector<std::string> kinds{options.mapper};
  if (options.compare) kinds.push_back("octomap");
  std::vector<Job> jobs(kinds.size());
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const MapperConfig config{.resolution = options.resolution, .num_threads = options.threads};
    jobs[k].worker->run([&] { jobs[k].mapper = makeMapper(kinds[k], config); });
    summary.maps.emplace_back().mapper = kinds[k];
  }
  insertScans(*sequence, jobs, summary);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    summary.maps[k].nodes = jobs[k].mapper->nodeCount();
    summary.maps[k].leaves = jobs[k].mapper->leafCount();
    summary.maps[k].memory_usage = jobs[k].mapper->memoryUsage();
  }
  const Mapper& map = *jobs.front().mapper;
  if (options.compare)
    summary.identity = Identity{.ot = sameBytes(map, *jobs.back().mapper, &Mapper::write),
                                .bt = sameBytes(map, *jobs.back().mapper, &Mapper::writeBinary)};
  for (const std::string& path : options.maps) summary.files.push_back(writeMap(path, map));
  for (std::size_t k = 0; k < jobs.size(); ++k)
    jobs[k].worker->run([&] { summary.maps[k].resident_memory = releasedMemory([&] { jobs[k].mapper.reset(); }); });

  if (options.json != "-") fmt::print("{}", toText(summary));
  if (!options.json.empty()) writeJson(options.json, toJson(summary));
}

}  // namespace

void addBuild(CLI::App& app) {
  const auto options = std::make_shared<BuildOptions>();
  CLI::App* verb = app.add_subcommand("build", "Build a map from the scans of a sequence");
  verb->add_option("SEQUENCE", options->sequence, "Scans with poses")->required()->type_name("");
  verb->add_option("MAP", options->maps, "Files to write, .bt or .ot")
      ->required()
      ->type_name("")
      ->check(outputFile(kMapExtensions));
  addResolution(*verb, options->resolution, "Edge of the smallest cube");
  addMaxRange(*verb, options->max_range, "Length at which rays are cut");
  addMinRange(*verb, options->min_range);
  verb->add_option("--mapper", options->mapper, fmt::format("One of: {}", fmt::join(mapperKinds(), ", ")))
      ->type_name("NAME")
      ->capture_default_str()
      ->check(oneOf("mapper", mapperKinds()));
  addFrames(*verb, options->frames);
  verb->add_option("--threads", options->threads, "Threads of one insertion (rhmap; OctoMap has one)")
      ->type_name("N")
      ->capture_default_str()
      ->check(countFrom1("threads"));
  verb->add_flag("--compare", options->compare, "Build with OctoMap as well and compare time, memory and bytes");
  addJson(*verb, options->json, "the summary");
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { build(*options); });
}

}  // namespace rhmap::tools
