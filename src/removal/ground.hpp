// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "near_ground.hpp"
#include "region_map.hpp"
#include "rhmap/removal/removal_config.hpp"
#include "scan_trace.hpp"

namespace rhmap {

/// A cube in its region, counted from the region's lowest.
struct LocalCube {
  int x, y, z;
};

/// R-GPF: the plane of the lower cubes (z <= mean), by principal components; fitted again to what is near it. Nothing
/// if there are too few cubes or the plane is too steep. In cubes, from the region's lowest.
std::optional<Plane> fitGround(std::span<const LocalCube> cubes, const GroundConfig& config, double resolution);

/// R-GPE (Sec. III-C.1): finds the regions that hold ground, fits their planes, and marks their ground cubes.
class GroundEstimation {
 public:
  /// `resolution`: edge of a cube [m].
  GroundEstimation(const GroundConfig& config, double resolution);

  /// After a scan was inserted.
  void update(const RegionMap& map, const ScanTrace& trace) const;

 private:
  void setBase(Column& column, Region* lowest) const;
  bool hasGrown(const Column& column) const;
  bool isCandidate(const Column& column) const;
  bool standsOut(const RegionMap& map, const Column& column, const Plane& plane) const;
  bool isRaised(const RegionMap& map, const Column& column, const Plane& plane) const;
  void fit(const RegionMap& map, Column& column) const;
  void mark(const RegionMap& map, const Column& column, Region& region, bool only_fresh) const;

  GroundConfig config_;
  double resolution_;
  GroundBand band_;
};

}  // namespace rhmap
