// SPDX-License-Identifier: BSD-3-Clause
#include "mapping.hpp"

#include <chrono>
#include <sstream>

#include "progress_bar.hpp"
#include "rhmap/baseline/resident_memory.hpp"

namespace rhmap::tools {
namespace {

double secondsOf(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Whether two maps write the same bytes.
bool sameBytes(const Mapper& a, const Mapper& b, void (Mapper::*write)(std::ostream&) const) {
  std::ostringstream bytes_a, bytes_b;
  (a.*write)(bytes_a);
  (b.*write)(bytes_b);
  return bytes_a.view() == bytes_b.view();
}

}  // namespace

MappingRun::MappingRun(const std::vector<std::string>& kinds, const MappingConfig& config)
    : config_(config), jobs_(kinds.size()) {
  for (std::size_t k = 0; k < jobs_.size(); ++k) {
    const MapperConfig mapper{.resolution = config.resolution, .num_threads = config.threads};
    jobs_[k].worker->run([&] { jobs_[k].mapper = makeMapper(kinds[k], mapper); });
    figures_.emplace_back().mapper = kinds[k];
  }
}

PointCounts MappingRun::insert(const io::ScanSequence& sequence, const FrameRange& frames, const std::string& label,
                               const AfterScan& after_scan) {
  PointCounts counts;
  ProgressBar bar(label, frames.last - frames.first + 1);
  for (std::size_t i = frames.first; i <= frames.last; ++i) {
    const io::Scan scan = sequence.scan(i);
    const octomap::Pointcloud points = worldPoints(scan, config_.min_range);
    counts.inserted += points.size();
    counts.dropped += scan.dropped + scan.points.size() - points.size();
    for (std::size_t k = 0; k < jobs_.size(); ++k) {
      const std::size_t turn = (i + k) % jobs_.size();
      Mapper& mapper = *jobs_[turn].mapper;
      jobs_[turn].worker->run([&] {
        figures_[turn].seconds.push_back(
            secondsOf([&] { mapper.insert(points, scan.pose.trans(), config_.max_range.value_or(-1)); }));
      });
    }
    if (after_scan) after_scan();
    bar.advance();
  }
  return counts;
}

Identity MappingRun::compareBytes() const {
  const Mapper &first = *jobs_.front().mapper, &last = *jobs_.back().mapper;
  return {.ot = sameBytes(first, last, &Mapper::write), .bt = sameBytes(first, last, &Mapper::writeBinary)};
}

std::vector<MapFigures> MappingRun::finish() {
  for (std::size_t k = 0; k < jobs_.size(); ++k) {
    figures_[k].nodes = jobs_[k].mapper->nodeCount();
    figures_[k].leaves = jobs_[k].mapper->leafCount();
    figures_[k].memory_usage = jobs_[k].mapper->memoryUsage();
  }
  // From the first measurement on malloc gives back all that is freed, so nothing else is left to do by then.
  for (std::size_t k = 0; k < jobs_.size(); ++k)
    jobs_[k].worker->run([&] { figures_[k].resident_memory = releasedMemory([&] { jobs_[k].mapper.reset(); }); });
  return figures_;
}

octomap::Pointcloud worldPoints(const io::Scan& scan, double min_range, std::optional<double> max_range) {
  octomap::Pointcloud points;
  points.reserve(scan.points.size());
  for (const octomap::point3d& point : scan.points) {
    const double range = point.norm();
    if (range >= min_range && (!max_range || range <= *max_range)) points.push_back(point);
  }
  points.transform(scan.pose);
  return points;
}

}  // namespace rhmap::tools
