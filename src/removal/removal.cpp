// SPDX-License-Identifier: BSD-3-Clause
#include "removal.hpp"

#include <time.h>

#include <algorithm>
#include <array>

#include "leftovers.hpp"
#include "rhmap/octree/scan_marking.hpp"
#include "rhmap/octree/structure.hpp"
#include "standing.hpp"
#include "tree_reader.hpp"

namespace rhmap {
namespace {

constexpr std::uint32_t kScansBetweenForgetting = 16;
constexpr std::size_t kEnoughToMeasure = 1000;  // points of a scan that show what the next ones will look like
constexpr double kSlack = 20;                   // [m] beyond what is needed, so that little is forgotten and read again

double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Charges the time since the last call to a stage.
class StageClock {
 public:
  explicit StageClock(ScanReport& report) : report_(report), last_(processorTime()) {}
  void charge(Stage stage) {
    const double now = processorTime();
    report_.seconds[static_cast<std::size_t>(stage)] += now - last_;
    last_ = now;
  }

 private:
  ScanReport& report_;
  double last_;
};

}  // namespace

RhMap::Removal::Removal(RhMap& tree, const RemovalConfig& config)
    : tree_(tree),
      config_(config),
      resolution_(tree.getResolution()),
      regions_(config.region_size,
               [&tree](key_type x, key_type y, int size) {
                 return readColumn(*tree.store_, tree.getOccupancyThresLog(), x, y, size);
               }),
      ground_(config.ground, resolution_),
      free_space_(config.free_space, resolution_),
      moving_hits_(config, resolution_),
      keyframes_(config.back_end) {}

ScanReport RhMap::Removal::process(const octomap::Pointcloud& points, const octomap::pose6d& pose, bool insert) {
  ScanReport report;
  StageClock clock(report);

  // P^W = T P^B
  locatePoints(tree_.keySpace(), points, pose, config_.min_range, config_.max_range, points_);
  report.points = points_.given;
  report.dropped = points_.dropped;
  OcTreeKey sensor;
  if (!tree_.coordToKeyChecked(pose.trans(), sensor)) report.dropped = report.points;
  if (report.dropped == report.points) return report;
  ++scan_;
  forgetFar(sensor);
  clock.charge(Stage::kTransform);

  // Into the regions: H and the attributes of cubes. Sec. III-B
  octants_.gather(points_, config_.context.max_range);
  traceScan(
      regions_, octants_, sensor, scan_,
      {.reach = config_.context.max_range, .resolution = resolution_, .firm = config_.evidence.firm, .insert = insert},
      trace_);
  clock.charge(Stage::kInsert);

  // R-GPE. Sec. III-C.1
  if (insert) ground_.update(regions_, trace_);
  clock.charge(Stage::kGround);

  // Range image and scan contexts. Sec. III-C.2
  const Projection projection = projection_ ? *projection_ : measureProjection(config_.image, points_);
  if (points_.size() >= kEnoughToMeasure) projection_ = projection;
  const RangeImage image(projection, points_);
  ScanContext context = contextOf(pose, sensor, image);
  clock.charge(Stage::kImage);

  // What moves stays out. Beyond the paper
  RemovalResult result;
  std::span<const OcTreeKey> rejected_from;
  const bool keeps_out = config_.free_space.enabled || config_.look_back.enabled;
  if (insert && keeps_out) free_space_.observe(trace_, context.view.origin());
  if (insert && config_.standing.enabled) noteStanding(trace_, free_space_, config_.standing);
  if (insert && keeps_out) {
    report.rejected = moving_hits_.reject(regions_, trace_, free_space_, result.removed);
    rejected_from = moving_hits_.rejectedFrom();
    moving_hits_.remember(scan_, context);
  }
  clock.charge(Stage::kFreeSpace);

  // S2M-R. Sec. III-C.2
  const LookConfig look{
      .scan = scan_, .protect = config_.protect_hits, .revert_hits = 0, .everywhere = config_.evidence.everywhere};
  removeByScan(regions_, context, config_, resolution_, look, result);
  clearUp(rejected_from, config_.leftovers.interval, look, result);
  clock.charge(Stage::kRemoval);

  if (insert) report.inserted = write(points, pose);
  erase(result, report);
  clock.charge(Stage::kMap);

  // Back end. Sec. III-D
  if (insert && config_.back_end.enabled) {
    const std::array<float, 3> position{pose.trans().x(), pose.trans().y(), pose.trans().z()};
    report.keyframe = keyframes_.wants(position, scan_, informationContent(image, config_.context.max_range));
    if (report.keyframe) keyframes_.push(position, std::move(context));
    if (const auto keyframe = keyframes_.pop(position)) lookAgain(*keyframe, true, report);
  }
  clock.charge(Stage::kBackEnd);
  return report;
}

ScanReport RhMap::Removal::finish() {
  ScanReport report;
  StageClock clock(report);
  while (const auto keyframe = keyframes_.pop()) lookAgain(*keyframe, false, report);
  RemovalResult result;
  clearUp({}, 1, {.scan = scan_, .protect = false}, result);
  erase(result, report);
  clock.charge(Stage::kBackEnd);
  return report;
}

ScanContext RhMap::Removal::contextOf(const octomap::pose6d& pose, const OcTreeKey& sensor, const RangeImage& image) {
  std::vector<Context3d> regions;
  if (config_.context.max_ring || config_.context.three_d) {
    ColumnGrid grid(regions_, sensor, config_.context.max_range, resolution_);
    for (std::size_t i = 0; i < trace_.columns.size(); ++i)
      *grid.at(trace_.columns[i].column->x, trace_.columns[i].column->y) = static_cast<std::int32_t>(i);
    if (config_.context.max_ring) findMaxRing(image, points_, regions_, grid, trace_);
    if (config_.context.three_d) regions = findBulgeDented(image, points_, config_.context, regions_, grid, trace_);
  }
  std::shared_ptr<const Visibility> visibility;
  if (config_.visibility.enabled)
    visibility = std::make_shared<Visibility>(image, points_, config_.visibility, resolution_);
  return {contextsOf(trace_), std::move(regions), SensorView(tree_.keySpace(), pose), std::move(visibility)};
}

void RhMap::Removal::lookAgain(const ScanContext& keyframe, bool protect, ScanReport& report) {
  RemovalResult result;
  const LookConfig look{.scan = scan_,
                        .protect = protect && config_.protect_hits,
                        .revert_hits = config_.back_end.revert_hits,
                        .everywhere = false};
  removeByScan(regions_, keyframe, config_, resolution_, look, result);
  clearUp({}, 0, look, result);
  erase(result, report);
}

/// What is left of that of which much has gone: from these octants and from those of the result, and where it is due.
void RhMap::Removal::clearUp(std::span<const OcTreeKey> octants, int interval, const LookConfig& look,
                             RemovalResult& result) {
  if (!config_.leftovers.enabled) return;
  changed_.assign(octants.begin(), octants.end());
  for (const RemovedCubesOf& removed : result.removed) changed_.push_back(removed.corner);
  removeLeftovers(regions_, changed_, interval, config_.leftovers, resolution_, look, result);
}

/// The hit cubes that are in the map, into the tree: as OctoMap's updateNode for each. Returns how many there are.
std::size_t RhMap::Removal::write(const octomap::Pointcloud& points, const octomap::pose6d& pose) {
  cells_.clear();
  const bool has_free = config_.carve || config_.removed == RemovedCubes::kFree;
  if (config_.carve) markFree(points, pose);
  std::size_t inserted = 0;
  const std::size_t octants = std::min<std::size_t>(8, regions_.octants());
  const bool are_whole = octants == 8 && !config_.carve;  // each of the tree's regions comes once
  trace_.forEachRegion([&](const Region& region) {
    for (std::size_t first = 0; first < regions_.octants(); first += octants) {
      const std::uint64_t word = cell_word::fromKey(regions_.cornerOf(region, first));
      std::array<std::uint64_t, 8> hits{};
      std::size_t cubes = 0;
      forEachBit(region.hit_octants >> first & 0xff, [&](int o) {
        const std::size_t number = first + static_cast<std::size_t>(o);
        const Octant& octant = region.octant(number);
        const std::uint64_t hit = octant.hit & octant.occupied;
        hits[(word >> 6 & 7) + static_cast<std::size_t>(o)] = hit;
        cubes += static_cast<std::size_t>(popcount(hit));
        if (has_free) forgetFree(regions_.cornerOf(region, number), hit & octant.fresh);
      });
      if (cubes == 0) continue;
      if (are_whole) {
        cells_.appendHits(word >> 9, hits);
      } else {
        cells_.mark({.free = {}, .hit = hits, .region = word >> 9});
      }
      inserted += cubes;
    }
  });
  if (tree_.use_change_detection) {
    cells_.forEachCell([this](const OcTreeKey& cell, bool occupied) { tree_.updateNode(cell, occupied); });
  } else {
    ScanApplier<OcTreeNode>(*tree_.store_, tree_.sensorModel(), false).apply(cells_, tree_.getNumThreads());
  }
  return inserted;
}

/// Cubes that are new to the map are as likely as any, however often rays have crossed them or scans seen through them.
void RhMap::Removal::forgetFree(const OcTreeKey& corner, std::uint64_t cubes) {
  forEachBit(cubes, [&](int bit) {
    const OcTreeKey cube = cubeOf(corner, bit);
    if (tree_.search(cube) != nullptr) tree_.setNodeValue(cube, 0);
  });
}

/// What OctoMap's rays cross, except cubes that the map holds for occupied, and ends that were kept out of it.
void RhMap::Removal::markFree(const octomap::Pointcloud& points, const octomap::pose6d& pose) {
  octomap::Pointcloud world(points);
  world.transform(pose);
  ScanCounts counts;
  const ScanMasks crossed =
      markScan(tree_.keySpace(), world, pose.trans(),
               {.max_range = config_.max_range, .box = nullptr, .num_threads = tree_.getNumThreads()}, counts);
  crossed.forEachRegion([&](const RegionMasks& marked) {
    RegionMasks free{};
    free.region = marked.region;
    free.free = marked.free;
    for (std::uint64_t t = 0; t < 8; ++t) {
      const OcTreeKey corner = cell_word::toKey(marked.region << 9 | t << 6);
      const Region* region = regions_.regionOf(corner);
      free.free[t] &= ~marked.hit[t];
      if (region != nullptr) free.free[t] &= ~region->octant(regions_.octantOf(corner)).occupied;
    }
    cells_.mark(free);
  });
}

/// Values above a cube: deleteNode, as OctoMap's, leaves all but the parent's as they were.
void RhMap::Removal::refreshAbove(const OcTreeKey& cube) {
  BlockStore<OcTreeNode>& store = *tree_.store_;
  NodeRef at = store.deepest(cube);
  if (at && store.hasChildren(at)) structure::recompute(store, at, store.children(at));
  while (const NodeRef above = store.parent(at)) {
    structure::recompute(store, above, at);
    at = above;
  }
}

void RhMap::Removal::erase(const RemovalResult& result, ScanReport& report) {
  for (const RemovedCubesOf& removed : result.removed) {
    report.removed += static_cast<std::size_t>(popcount(removed.cubes));
    forEachBit(removed.cubes, [&](int bit) {
      const OcTreeKey cube = cubeOf(removed.corner, bit);
      if (config_.removed == RemovedCubes::kFree && removed.seen_through) {
        tree_.setNodeValue(cube, tree_.clamping_thres_min);
      } else {
        tree_.deleteNode(cube);
      }
    });
    refreshAbove(removed.corner);
  }
  report.is_protected += result.is_protected;
}

/// What is kept beside the tree is kept for the surroundings of the sensor only, so that it does not grow with the way.
void RhMap::Removal::forgetFar(const OcTreeKey& sensor) {
  if (scan_ % kScansBetweenForgetting != 0) return;
  const double reach = config_.context.max_range + (config_.back_end.enabled ? config_.back_end.delay : 0) + kSlack;
  const int cubes = static_cast<int>(std::min(reach / resolution_, 65536.0));
  regions_.forgetBeyond(sensor, cubes);
  free_space_.forgetBeyond(sensor, cubes);
}

bool RhMap::Removal::isGround(const OcTreeKey& cube) const {
  const Region* region = regions_.regionOf(cube);
  return region != nullptr && (region->octant(regions_.octantOf(cube)).ground & maskOf(bitOf(cube))) != 0;
}

std::size_t RhMap::Removal::memoryUsage() const { return regions_.memoryUsage() + free_space_.memoryUsage(); }

}  // namespace rhmap
