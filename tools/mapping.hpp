// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "rhmap/baseline/mapper.hpp"
#include "rhmap/baseline/worker.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::tools {

/// How scans become maps.
struct MappingConfig {
  double resolution = 0.1;          ///< edge of the smallest cube [m]
  std::optional<double> max_range;  ///< where rays are cut [m]
  double min_range = 0;             ///< nearer points are dropped [m]
  int threads = 1;
};

/// One mapper on all scans.
struct MapFigures {
  std::string mapper;
  std::vector<double> seconds;  ///< per scan, insertion only
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t memory_usage = 0;                ///< what the tree says of itself [bytes]
  std::optional<std::size_t> resident_memory;  ///< physical memory that its end gives back [bytes]
};

/// Whether two mappers wrote the same bytes.
struct Identity {
  bool ot = false;
  bool bt = false;
};

/// What became of the sequence's points.
struct PointCounts {
  std::size_t inserted = 0;
  std::size_t dropped = 0;  ///< not finite, or nearer than the minimum range
};

/// Maps of the same scans side by side, each in a thread of its own, so that they can be measured.
class MappingRun {
 public:
  /// Empty maps of these kinds.
  MappingRun(const std::vector<std::string>& kinds, const MappingConfig& config);

  /// Called when a scan is in all maps, outside of what is measured.
  using AfterScan = std::function<void()>;

  /// All mappers take scan after scan together, and take turns at going first, so that neither has the warmer caches.
  PointCounts insert(const io::ScanSequence& sequence, const FrameRange& frames, const std::string& label,
                     const AfterScan& after_scan = {});

  std::size_t size() const { return jobs_.size(); }
  const Mapper& map(std::size_t k) const { return *jobs_[k].mapper; }

  /// Whether the first and the last map write the same.
  Identity compareBytes() const;

  /// Destroys the maps, which is how their resident memory is measured. Once, and last.
  std::vector<MapFigures> finish();

 private:
  struct Job {
    std::unique_ptr<Worker> worker = std::make_unique<Worker>();
    std::unique_ptr<Mapper> mapper;
  };

  MappingConfig config_;
  std::vector<Job> jobs_;
  std::vector<MapFigures> figures_;
};

/// The points of a scan from `min_range` [m] on, up to `max_range` [m] if given, in the world frame.
octomap::Pointcloud worldPoints(const io::Scan& scan, double min_range, std::optional<double> max_range = {});

}  // namespace rhmap::tools
