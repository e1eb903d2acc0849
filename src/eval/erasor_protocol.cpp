// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "point_grid.hpp"
#include "require.hpp"
#include "rhmap/eval/protocol.hpp"
#include "voxelize.hpp"

namespace rhmap::eval {
namespace {

/// Ground truth as ERASOR's mapgen makes it: each scan voxelised, the scans' voxels put together, voxelised again. The
/// estimate is voxelised once, from its points. Memory goes with the scans' voxels.
class ErasorProtocol : public Protocol {
 public:
  ErasorProtocol(const ErasorConfig& config, const Labels& labels, std::span<const Estimate> rows)
      : config_(config), labels_(labels), estimates_(rows) {
    for (const Estimate& estimate : rows) {
      Row& row = rows_.emplace_back(config.voxel);
      for (const octomap::point3d& point : estimate.cloud) row.centroids.add(point);
    }
  }

  void add(const LabelledScan& scan, std::span<const KeptMask> masks) override {
    dense_.append(voxelizePreservingLabels(part(scan, nullptr), config_.voxel));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (!estimates_[r].keep) continue;
      const LabelledCloud kept = part(scan, &masks[r]);
      for (const octomap::point3d& point : kept.points) rows_[r].centroids.add(point);
      rows_[r].carried.append(voxelizePreservingLabels(kept, config_.voxel));
    }
  }

  void endPass() override {
    const LabelledCloud truth = voxelizePreservingLabels(dense_, config_.voxel);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      // A cloud has no labels to carry: its voxels take those of the un-cleaned map around them.
      LabelledCloud estimate{.points = rows_[r].centroids.points(), .labels = {}};
      estimate.labels = nearestLabels(estimate.points, estimates_[r].keep ? rows_[r].carried : dense_, config_.voxel);
      scores_.push_back(scoreOf(estimates_[r].name, truth, estimate));
    }
  }

  std::vector<Score> scores() const override { return scores_; }

 private:
  struct Row {
    explicit Row(double voxel) : centroids(voxel) {}
    Centroids centroids;
    LabelledCloud carried;  // the kept points' labels, a voxel a scan
  };

  /// The points of a scan outside of the vehicle, all of them or those of the mask.
  LabelledCloud part(const LabelledScan& scan, const KeptMask* mask) const {
    LabelledCloud cloud;
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      if (mask != nullptr && (*mask)[k] == 0) continue;
      if (std::hypot(scan.in_sensor[k].x(), scan.in_sensor[k].y()) < config_.ego_radius) continue;
      cloud.points.push_back(scan.points[k]);
      cloud.labels.push_back(scan.labels[k]);
    }
    return cloud;
  }

  /// A voxel counts as kept if the nearest of the estimate's within half a diagonal is of its own kind.
  Score scoreOf(const std::string& name, const LabelledCloud& truth, const LabelledCloud& estimate) const {
    const PointGrid grid(estimate.points, config_.voxel);
    const double tau = config_.voxel * std::sqrt(3) / 2;
    Counts cells;
    for (std::size_t g = 0; g < truth.points.size(); ++g) {
      const auto nearest = grid.nearest(truth.points[g], tau);
      const bool kept = nearest && nearest->squared_distance < tau * tau &&
                        labels_.isDynamic(estimate.labels[nearest->index]) == labels_.isDynamic(truth.labels[g]);
      cells.add(labels_, truth.labels[g], kept);
    }
    Score score{.protocol = "erasor", .row = name, .cells = cells};
    for (const std::uint32_t label : estimate.labels)
      ++(labels_.isDynamic(label) ? score.dynamic_cells : score.static_cells);
    return score;
  }

  ErasorConfig config_;
  Labels labels_;
  std::span<const Estimate> estimates_;
  LabelledCloud dense_;  // a voxel a scan
  std::vector<Row> rows_;
  std::vector<Score> scores_;
};

}  // namespace

std::unique_ptr<Protocol> makeErasorProtocol(const ErasorConfig& config, const Labels& labels,
                                             std::span<const Estimate> rows) {
  requireLength(config.voxel, "ErasorConfig::voxel");
  requireLength(config.ego_radius, "ErasorConfig::ego_radius", true);
  return std::make_unique<ErasorProtocol>(config, labels, rows);
}

}  // namespace rhmap::eval
