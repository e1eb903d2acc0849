// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/rh_map.hpp"

#include <time.h>

#include <algorithm>
#include <optional>

#include "free_space.hpp"
#include "ground.hpp"
#include "keyframes.hpp"
#include "range_image.hpp"
#include "region_map.hpp"
#include "rhmap/octree/scan_marking.hpp"
#include "scan_insertion.hpp"
#include "scan_points.hpp"
#include "scan_to_map.hpp"
#include "visibility.hpp"
#include "void_rejection.hpp"

namespace rhmap {
namespace {

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

void collect(const OcTree& tree, const OcTreeNode* node, const OcTreeKey& corner, unsigned depth, key_type x, key_type y,
             int size, std::vector<RegionMap::Cubes>& cubes);

/// The occupied cells below a node at depth 14, as bits.
std::uint64_t bitsBelow(const OcTree& tree, const OcTreeNode* node, unsigned depth) {
  const unsigned width = depth == 14 ? 64 : depth == 15 ? 8 : 1;
  if (!tree.nodeHasChildren(node)) {
    const std::uint64_t all = width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
    return tree.isNodeOccupied(node) ? all : 0;
  }
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 8; ++i)
    if (tree.nodeChildExists(node, i)) bits |= bitsBelow(tree, tree.getNodeChild(node, i), depth + 1) << (i * width / 8);
  return bits;
}

void collect(const OcTree& tree, const OcTreeNode* node, const OcTreeKey& corner, unsigned depth, key_type x, key_type y,
             int size, std::vector<RegionMap::Cubes>& cubes) {
  if (!tree.isNodeOccupied(node)) return;  // the largest value below
  if (depth == 14) {
    if (const std::uint64_t bits = bitsBelow(tree, node, 14)) cubes.push_back({corner, bits});
    return;
  }
  const bool leaf = !tree.nodeHasChildren(node);
  const unsigned half = 1U << (kTreeDepth - 1 - depth);
  for (unsigned i = 0; i < 8; ++i) {
    const OcTreeKey below(static_cast<key_type>(corner[0] + (i & 1 ? half : 0)),
                          static_cast<key_type>(corner[1] + (i & 2 ? half : 0)),
                          static_cast<key_type>(corner[2] + (i & 4 ? half : 0)));
    if (below[0] + half <= x || below[0] >= x + size || below[1] + half <= y || below[1] >= y + size) continue;
    if (leaf) {
      collect(tree, node, below, depth + 1, x, y, size, cubes);
    } else if (tree.nodeChildExists(node, i)) {
      collect(tree, tree.getNodeChild(node, i), below, depth + 1, x, y, size, cubes);
    }
  }
}

}  // namespace

/// The state beside the tree, and the pipeline.
class RhMap::Removal {
 public:
  Removal(RhMap& tree, const RemovalConfig& config)
      : tree_(tree),
        config_(config),
        regions_(config.region_size,
                 [&tree](key_type x, key_type y, int size) {
                   std::vector<RegionMap::Cubes> cubes;
                   if (const OcTreeNode* root = tree.getRoot())
                     collect(tree, root, {0, 0, 0}, 0, x, y, size, cubes);
                   return cubes;
                 }),
        ground_(config.ground, tree.getResolution()),
        free_space_(config.free_space, tree.getResolution()),
        keyframes_(config.back_end, config.context.max_range) {}

  const RemovalConfig& config() const { return config_; }
  std::array<int, 6> debugCube(const OcTreeKey& cube) const {
    const Octant* octant = regions_.findOctant(cube);
    if (octant == nullptr) return {-1};
    int t = 0, s = 0;
    const Region* region = regions_.find(cube[0] >> regions_.bits(), cube[1] >> regions_.bits(), cube[2] >> regions_.bits());
    for (int o = 0; o < regions_.octants(); ++o) forEachBit(region->octants[o].occupied & ~region->octants[o].ground, [&](int bit) { (region->octants[o].missed[bit] > 0 ? t : s)++; });
    return {octant->hits[bitOf(cube)], octant->missed[bitOf(cube)], t, s, free_space_.voids().at(cube[0]>>free_space_.shift(),cube[1]>>free_space_.shift(),cube[2]>>free_space_.shift()),0};
  }
  bool isGround(const OcTreeKey& cube) const {
    const Octant* octant = regions_.findOctant(cube);
    return octant != nullptr && (octant->ground >> bitOf(cube) & 1) != 0;
  }

  ScanReport insert(const octomap::Pointcloud& points, const octomap::pose6d& pose, bool insertion) {
    ScanReport report;
    StageClock clock(report);
    locatePoints(tree_.keySpace(), points, pose, config_.min_range, config_.max_range, points_);
    report.points = points_.given;
    report.dropped = points_.dropped;
    clock.charge(Stage::kTransform);
    OcTreeKey sensor;
    if (!tree_.coordToKeyChecked(pose.trans(), sensor) || points_.size() == 0) return report;
    ++scan_; g_scan = scan_; g_reason = 3;
    const SensorView view(tree_.keySpace(), pose);
    const std::array<float, 3> position{pose.trans().x(), pose.trans().y(), pose.trans().z()};
    forgetFar(sensor);

    const ScanTrace trace = rhmap::insertScan(regions_, points_, sensor, config_.context.max_range, tree_.getResolution(),
                                              scan_, insertion, config_.look_back.firm);
    clock.charge(Stage::kInsert);

    if (insertion) ground_.update(regions_, trace);
    clock.charge(Stage::kGround);

    if (!projection_) projection_ = measureProjection(config_.image, points_);
    RangeImage image(*projection_, points_);
    const auto shared = std::make_shared<ScanContext>(ScanContext{contextsOf(trace), view, Visibility(image, points_, config_.visibility, tree_.getResolution())});
    const ScanContext& context = *shared;
    clock.charge(Stage::kImage);

    RemovalResult result;
    if (insertion && config_.free_space.enabled) {
      free_space_.observe(regions_, trace, view.origin());
      report.rejected = rejectInVoid(regions_, ground_, trace, free_space_.voids(), free_space_.shift(), past_, config_.look_back, config_.free_space,
                                     tree_.getResolution(), result.removed);
    }
    if (scan_ % config_.look_back.stride == 0) past_.push_back(shared);
    if (past_.size() > (size_t)config_.look_back.scans) past_.pop_front();
    clock.charge(Stage::kFreeSpace);

    removeByScan(regions_, context, config_, tree_.getResolution(), scan_, 0, false, ground_, result);
    clock.charge(Stage::kRemoval);

    if (insertion) report.inserted = write(trace);
    erase(result, report);
    clock.charge(Stage::kMap);

    if (insertion && config_.back_end.enabled) {
      if (keyframes_.wants(position, scan_, informationContent(image, keyframes_.rMax()))) {
        keyframes_.push(position, context);
        report.keyframe = true;
      }
      if (const auto keyframe = keyframes_.pop(position)) lookAgain(*keyframe, scan_, report);
    }
    clock.charge(Stage::kBackEnd);
    return report;
  }

  ScanReport finish() {
    ScanReport report;
    StageClock clock(report);
    while (const auto keyframe = keyframes_.pop()) lookAgain(*keyframe, 0, report);
    clock.charge(Stage::kBackEnd);
    return report;
  }

 private:
  static std::vector<ColumnContext> contextsOf(const ScanTrace& trace) {
    std::vector<ColumnContext> contexts;
    contexts.reserve(trace.columns.size());
    for (const ScanColumn& c : trace.columns)
      contexts.push_back({c.column->x, c.column->y, c.z_min, c.z_max, c.points, c.max_ring});
    return contexts;
  }

  void lookAgain(const ScanContext& keyframe, std::uint32_t protect_scan, ScanReport& report) {
    RemovalResult result; g_reason = 5;
    removeByScan(regions_, keyframe, config_, tree_.getResolution(), protect_scan, config_.back_end.revert_hits, true, ground_, result);
    erase(result, report);
  }

  /// The hit cubes that are in the map, into the tree.
  std::size_t write(const ScanTrace& trace) {
    std::size_t inserted = 0;
    ScanApplier<OcTreeNode> applier(*tree_.store_, tree_.sensorModel(), false);
    const int blocks = std::max(1, regions_.octants() / 8);
    const int octants = std::min(8, regions_.octants());
    for (const Region* region : trace.regions) {
      for (int b = 0; b < blocks; ++b) {
        const OcTreeKey corner = regions_.cornerOf(*region, b * octants);
        RegionMasks masks{cell_word::fromKey(corner) >> 9, {}, {}};
        const auto first = static_cast<std::size_t>(cell_word::fromKey(corner) >> 6 & 7);
        bool any = false;
        for (int o = 0; o < octants; ++o) {
          const Octant& octant = region->octants[static_cast<std::size_t>(b * octants + o)];
          const std::uint64_t hit = octant.hit & octant.occupied;
          masks.hit[first + static_cast<std::size_t>(o)] = hit;
          inserted += static_cast<std::size_t>(std::popcount(hit));
          any = any || hit != 0;
        }
        if (any) applier.apply(masks);
      }
    }
    return inserted;
  }

  void erase(const RemovalResult& result, ScanReport& report) {
    for (const RemovedOctant& removed : result.removed) {
      report.removed += static_cast<std::size_t>(std::popcount(removed.cubes));
      forEachBit(removed.cubes, [&](int bit) {
        const OcTreeKey cube = cubeOf(removed.corner, bit);
        if (config_.removed == RemovedCubes::kFree && removed.seen_through) {
          tree_.setNodeValue(cube, tree_.clamping_thres_min);
        } else if (tree_.search(cube) != nullptr) {
          tree_.deleteNode(cube);
        }
      });
    }
    report.is_protected += result.is_protected;
  }

  /// Keeps what is remembered beside the tree to the surroundings of the sensor.
  void forgetFar(const OcTreeKey& sensor) {
    if (scan_ % 16 != 0) return;
    const double reach = std::max(config_.context.max_range, config_.free_space.max_range) + config_.back_end.delay + 20;
    const int cubes = static_cast<int>(std::min(2 * reach / tree_.getResolution(), 65536.0));
    regions_.forgetBeyond(sensor, cubes);
    free_space_.forgetBeyond(sensor, cubes);
  }

  RhMap& tree_;
  RemovalConfig config_;
  RegionMap regions_;
  GroundEstimation ground_;
  FreeSpace free_space_;
  Keyframes keyframes_;
  std::deque<std::shared_ptr<const ScanContext>> past_;
  std::optional<Projection> projection_;
  std::uint32_t scan_ = 0;
  ScanPoints points_;
};

std::string_view nameOf(Stage stage) {
  constexpr std::array<std::string_view, kStages> kNames{"transform", "insert", "ground",  "image",
                                                         "void",      "removal", "map", "back end"};
  return kNames[static_cast<std::size_t>(stage)];
}

double ScanReport::totalSeconds() const {
  double sum = 0;
  for (const double s : seconds) sum += s;
  return sum;
}

RhMap::RhMap(double resolution, const RemovalConfig& config) : OcTree(resolution) {
  validate(config);
  removal_ = std::make_unique<Removal>(*this, config);
}

RhMap::RhMap(const RhMap& other)
    : OcTree(other), removal_(std::make_unique<Removal>(*this, other.removal_->config())) {}

RhMap::~RhMap() = default;

RhMap* RhMap::create() const { return new RhMap(getResolution(), config()); }

const RemovalConfig& RhMap::config() const { return removal_->config(); }

ScanReport RhMap::insertScan(const octomap::Pointcloud& points, const octomap::pose6d& pose) {
  return removal_->insert(points, pose, true);
}

ScanReport RhMap::removeDynamic(const octomap::Pointcloud& points, const octomap::pose6d& pose) {
  return removal_->insert(points, pose, false);
}

ScanReport RhMap::finish() { return removal_->finish(); }

std::array<int, 6> RhMap::debugCube(const OcTreeKey& cube) const { return removal_->debugCube(cube); }

bool RhMap::isGround(const OcTreeKey& cube) const { return removal_->isGround(cube); }

}  // namespace rhmap
