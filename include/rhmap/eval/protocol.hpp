// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rhmap/eval/estimate.hpp"
#include "rhmap/eval/labelled_scan.hpp"
#include "rhmap/eval/labels.hpp"
#include "rhmap/eval/score.hpp"

namespace rhmap::eval {

/// Scores rows while scans go by. Numbers of different protocols do not belong in one comparison.
class Protocol {
 public:
  Protocol() = default;
  Protocol(const Protocol&) = delete;
  Protocol& operator=(const Protocol&) = delete;
  virtual ~Protocol() = default;

  /// How often the sequence is wanted, always in the same order.
  virtual int passes() const { return 1; }

  /// Takes the next scan; masks[r] are row r's answers, empty for a row that is a cloud.
  virtual void add(const LabelledScan& scan, std::span<const KeptMask> masks) = 0;

  /// After the last scan of each pass.
  virtual void endPass() = 0;

  /// One a row, in their order; after the last pass.
  virtual std::vector<Score> scores() const = 0;
};

/// Protocol `rhmap`, RH-Map's: cubes, labelled by the majority of their points (a tie is static).
struct RhmapConfig {
  double resolution = 0.1;  ///< edge of a cube [m]
};

/// Protocol `erasor`: voxel centroids and the nearest neighbour within half a voxel's diagonal.
struct ErasorConfig {
  double voxel = 0.2;       ///< edge of a voxel [m]
  double ego_radius = 2.7;  ///< points nearer to the sensor's vertical axis are the vehicle's, and dropped [m]
};

/// Protocol `kth`, DynamicMap_Benchmark's: every labelled point; gone if nothing of the map is near.
struct KthConfig {
  double tolerance = 0.05;  ///< a point this near to something that is kept counts as kept [m]
  double max_range = 50;    ///< labels from here on are not trusted [m]
  double ego_radius = 0;    ///< nearer points of classes 0 and 1 count as class 252, moving; the benchmark has 3 [m]
};

/// The scorers. The estimates must live as long as the protocol; std::invalid_argument names a wrong length.
std::unique_ptr<Protocol> makeRhmapProtocol(const RhmapConfig& config, const Labels& labels,
                                            std::span<const Estimate> rows);
std::unique_ptr<Protocol> makeErasorProtocol(const ErasorConfig& config, const Labels& labels,
                                             std::span<const Estimate> rows);
std::unique_ptr<Protocol> makeKthProtocol(const KthConfig& config, const Labels& labels,
                                          std::span<const Estimate> rows);

}  // namespace rhmap::eval
