// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/octomap_types.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

#include "rhmap/octree/octree.hpp"
#include "rhmap/removal/removal_config.hpp"

namespace rhmap {

/// The stages of a scan's way into the map, in their order.
enum class Stage { kTransform, kInsert, kGround, kImage, kFreeSpace, kRemoval, kMap, kBackEnd };
inline constexpr std::size_t kStages = 8;
std::string_view nameOf(Stage stage);

/// What became of a scan.
struct ScanReport {
  std::size_t points = 0;        ///< given
  std::size_t dropped = 0;       ///< of these left out: not finite, outside of the tree, too near or too far
  std::size_t inserted = 0;      ///< cubes that were hit and are in the map
  std::size_t rejected = 0;      ///< cubes that were hit and kept out, because what is there moves
  std::size_t removed = 0;       ///< cubes that were taken out of the map
  std::size_t is_protected = 0;  ///< cubes that would have been, but are ground, hit by this scan, or not seen through
  bool keyframe = false;         ///< the scan waits in the back end's queue
  std::array<double, kStages> seconds{};  ///< processor time of each stage [s]

  double totalSeconds() const;
};

/// RH-Map: an occupancy map that keeps moving objects out while it grows. It is an rhmap::OcTree after each call, to be
/// searched, iterated, written and planned in.
///
///     rhmap::RhMap map(0.1);
///     for (...) map.insertScan(points, pose);   // points in the sensor's frame [m], pose sensor to map
///     map.finish();
///     map.writeBinary("clean.bt");
class RhMap : public OcTree {
 public:
  /// An empty map with cubes of this edge length [m]; std::invalid_argument that names the wrong field.
  explicit RhMap(double resolution, const RemovalConfig& config = {});
  /// A copy of the map and the configuration; what waits in the back end's queue stays behind.
  RhMap(const RhMap& other);
  ~RhMap() override;

  RhMap* create() const override;

  const RemovalConfig& config() const;

  /// These forget what scans have shown, too; so does reading a file.
  void clear() override;
  void setResolution(double resolution) override;

  /// Inserts a scan and removes what it shows to have moved away. Points in the sensor's frame [m], in any order; the
  /// pose takes them to the map.
  ScanReport insertScan(const octomap::Pointcloud& points, const octomap::pose6d& pose);

  /// Removes what the scan shows to have moved away, and inserts nothing.
  ScanReport removeDynamic(const octomap::Pointcloud& points, const octomap::pose6d& pose);

  /// Lets all keyframes that still wait do their work; at the end of a drive.
  ScanReport finish();

  /// Whether the cube is taken for ground (by what has been seen around it lately).
  bool isGround(const OcTreeKey& cube) const;

  /// What the removal keeps beside the tree, keyframes aside [bytes]: it goes with the surroundings, not with the way.
  std::size_t removalMemoryUsage() const;

 private:
  class Removal;
  std::unique_ptr<Removal> removal_;
};

}  // namespace rhmap
