// SPDX-License-Identifier: BSD-3-Clause
#include "moving_hits.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "evidence.hpp"

namespace rhmap {
namespace {

constexpr double kOctantRadius = 2 * 1.7321;  // cubes
constexpr std::size_t kOctantsAtATime = 128;

}  // namespace

MovingHits::MovingHits(const RemovalConfig& config, double cube)
    : config_(config),
      reach_(cubesAround(config.evidence.sure_reach, cube)),
      least_new_(config.free_space.least_new / (cube * cube)),
      least_come_(config.look_back.least / (cube * cube)),
      nearest_(static_cast<float>(config.min_range / cube + kOctantRadius)) {}

std::size_t MovingHits::reject(const RegionMap& map, const ScanTrace& trace, const FreeSpace& free_space,
                               std::vector<RemovedCubesOf>& removed) {
  rejected_from_.clear();
  if (config_.look_back.enabled) lookBack(trace);

  // Seeds: cells with hits in the void, or with cubes that have come.
  const int shift = free_space.shift();
  seeds_.clear();
  const auto askFor = [&](const TracedOctant& at) __attribute__((always_inline)) {
    free_space.prefetch(at.corner[0] >> shift, at.corner[1] >> shift);
  };
  trace.forEachOctant(askFor, [&](const TracedOctant& at) {
    const Octant& octant = *at.octant;
    std::uint64_t come = octant.appeared;
    if (come != 0) {
      const Neighbourhood around = lookAround(map, at.corner, kFarthestAround, [&](const Region& r, std::size_t n) {
        return r.isHitBy(trace.scan, n) ? r.octant(n).appeared : 0;
      });
      if (around.moving < least_come_ || !around.isMoving(config_.look_back.share)) come = 0;
    }
    forEachCell(octant.hit, at.corner, shift, [&](const OcTreeKey& corner, std::uint64_t hit) {
      const Cell cell{corner[0] >> shift, corner[1] >> shift, corner[2] >> shift};
      const auto& [x, y, z] = cell;
      const bool is_void = config_.free_space.enabled && (hit & ~octant.ground) != 0 &&
                           (free_space.isVoid(x, y, z) || (free_space.isOpen(x, y, z) && isNew(map, trace, at.corner)));
      if (is_void) {
        seeds_.push_back({cell, config_.free_space.growth});
      } else if ((come & hit) != 0) {
        seeds_.push_back({cell, stepsFrom(cell, free_space)});
      }
    });
  });
  if (seeds_.empty()) return 0;

  growSeeds(free_space.ends());
  std::size_t rejected = 0;
  trace.forEachOctant([&](const TracedOctant& at) {
    const Octant& octant = *at.octant;
    std::uint64_t out = 0;
    forEachCell(octant.hit & octant.occupied & ~octant.safe, at.corner, shift,
                [&](const OcTreeKey& cell, std::uint64_t hit) {
                  if (moving_.at(cell[0] >> shift, cell[1] >> shift, cell[2] >> shift)) out |= hit;
                });
    if (out == 0) return;
    forEachBit(out, [&](int bit) {
      if (historyOf(octant).hits[static_cast<std::size_t>(bit)] > config_.free_space.known) out &= ~maskOf(bit);
    });
    if (out == 0) return;
    rejected += static_cast<std::size_t>(popcount(out));
    if (const std::uint64_t known = out & ~octant.fresh; known != 0) removed.push_back({at.corner, known, false});
    at.region->remove(at.number, out);
    rejected_from_.push_back(at.corner);
  });
  return rejected;
}

/// Growth of what has come: less of what is far away.
int MovingHits::stepsFrom(const Cell& come, const FreeSpace& free_space) const {
  const bool is_far = free_space.distance(come.x, come.y) > config_.look_back.near;
  return std::max(0, config_.look_back.growth - is_far);
}

/// Growth within the scan: from each seed its steps.
void MovingHits::growSeeds(const CellGrid& ends) {
  moving_.resetTo(ends);
  rim_.clear();
  for (int steps = std::max(config_.free_space.growth, config_.look_back.growth);; --steps) {
    for (const Seed& seed : seeds_)
      if (seed.steps == steps) rim_.push_back(seed.cell);
    for (const Cell& cell : rim_) moving_.set(cell.x, cell.y, cell.z);
    if (steps == 0) return;
    next_rim_.clear();
    for (const Cell& cell : rim_) moving_.growInto(ends, cell, next_rim_);
    std::swap(rim_, next_rim_);
  }
}

/// Whether much in and around an octant is new to the map and little is firm.
bool MovingHits::isNew(const RegionMap& map, const ScanTrace& trace, const OcTreeKey& corner) const {
  const Neighbourhood around = lookAround(map, corner, reach_, [&](const Region& r, std::size_t n) -> std::uint64_t {
    return r.isHitBy(trace.scan, n) ? r.octant(n).fresh & ~r.octant(n).ground : 0;
  });
  return around.moving >= least_new_ && around.isMoving(config_.evidence.share);
}

/// Octant::appeared: what is new, not firm (where something stands), and seen through by more past scans than saw
/// something there.
void MovingHits::lookBack(const ScanTrace& trace) {
  fresh_.clear();
  fresh_octants_.clear();
  trace.forEachOctant([&](const TracedOctant& at) {
    const Octant& octant = *at.octant;
    const std::uint64_t cubes = octant.fresh & ~octant.ground & ~octant.firm;
    if (cubes == 0) return;
    fresh_.push_back({at.corner, cubes});
    fresh_octants_.push_back(at.octant);
  });
  // So many octants at a time that what is said of them stays near.
  for (std::size_t first = 0; first < fresh_.size(); first += kOctantsAtATime) {
    const std::span fresh = std::span(fresh_).subspan(first, std::min(kOctantsAtATime, fresh_.size() - first));
    std::array<Answers, kOctantsAtATime> answers{};
    std::array<CubeLooks, kOctantsAtATime> looks;
    for (const Past& past : past_) {
      past.visibility->look(past.view, fresh, std::span(looks).first(fresh.size()));
      for (std::size_t i = 0; i < fresh.size(); ++i) {
        if (isTooNear(past.view, fresh[i].corner)) continue;
        answers[i].seen.countUp(looks[i].seen_through | looks[i].skimmed);
        answers[i].contrary.countUp(looks[i].filled);
      }
    }
    for (std::size_t i = 0; i < fresh.size(); ++i)
      fresh_octants_[first + i]->appeared = answers[i].seen.moreThan(answers[i].contrary);
  }
}

/// Whether what a scan returned from an octant may have been left out as too near: it looks empty then.
bool MovingHits::isTooNear(const SensorView& view, const OcTreeKey& corner) const {
  float squared = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const float d = static_cast<float>(corner[axis]) + 1.5F - view.origin()[axis];
    squared += d * d;
  }
  return squared < nearest_ * nearest_;
}

void MovingHits::remember(std::uint32_t scan, const ScanContext& context) {
  if (!config_.look_back.enabled || context.visibility == nullptr ||
      scan % static_cast<std::uint32_t>(config_.look_back.stride) != 0)
    return;
  past_.push_back({context.view, context.visibility});
  if (past_.size() > static_cast<std::size_t>(config_.look_back.scans)) past_.pop_front();
}

}  // namespace rhmap
