// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "point_grid.hpp"
#include "require.hpp"
#include "rhmap/eval/protocol.hpp"

namespace rhmap::eval {
namespace {

/// Every labelled point is looked for in the map within the tolerance. A point that is itself kept is there; for the
/// others a second pass brings all kept points by. So memory goes with the points that were removed, not with the
/// sequence.
class KthProtocol : public Protocol {
 public:
  KthProtocol(const KthConfig& config, const Labels& labels, std::span<const Estimate> rows)
      : config_(config), labels_(labels), estimates_(rows), rows_(rows.size()) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (!rows[r].keep) rows_[r].grid = std::make_unique<PointGrid>(rows[r].cloud, 2 * config.tolerance);
    }
  }

  int passes() const override { return 2; }

  void add(const LabelledScan& scan, std::span<const KeptMask> masks) override {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (pass_ == 0) {
        judge(scan, masks[r], rows_[r]);
      } else if (estimates_[r].keep && !rows_[r].gone.empty()) {
        findNear(scan, masks[r], rows_[r]);
      }
    }
  }

  void endPass() override {
    if (pass_++ == 0) {
      for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (!estimates_[r].keep) continue;
        rows_[r].grid = std::make_unique<PointGrid>(rows_[r].gone, 2 * config_.tolerance);
        rows_[r].near_kept.assign(rows_[r].gone.size(), false);
      }
      return;
    }
    for (Row& row : rows_) {
      for (std::size_t k = 0; k < row.gone.size(); ++k) row.counts.add(labels_, row.gone_labels[k], row.near_kept[k]);
    }
  }

  std::vector<Score> scores() const override {
    std::vector<Score> scores;
    for (std::size_t r = 0; r < rows_.size(); ++r)
      scores.push_back({.protocol = "kth", .row = estimates_[r].name, .cells = {}, .points = rows_[r].counts});
    return scores;
  }

 private:
  struct Row {
    std::unique_ptr<PointGrid> grid;  // of the cloud, or of the points that are gone
    std::vector<octomap::point3d> gone;
    std::vector<std::uint32_t> gone_labels;
    std::vector<bool> near_kept;
    Counts counts;
  };

  /// The label that counts: none from the maximum range on, and the vehicle itself moves.
  std::uint32_t labelOf(const LabelledScan& scan, std::size_t k) const {
    const double range = scan.in_sensor[k].norm();
    if (range >= config_.max_range) return 0;
    const std::uint32_t label = scan.labels[k] & 0xffffU;
    return range < config_.ego_radius && label <= 1 ? 252 : label;
  }

  void judge(const LabelledScan& scan, const KeptMask& mask, Row& row) const {
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      const std::uint32_t label = labelOf(scan, k);
      if (labels_.kind(label) == Kind::kIgnored) continue;
      if (row.grid) {
        row.counts.add(labels_, label, row.grid->nearest(scan.points[k], config_.tolerance).has_value());
      } else if (mask[k] != 0) {
        row.counts.add(labels_, label, true);
      } else {
        row.gone.push_back(scan.points[k]);
        row.gone_labels.push_back(label);
      }
    }
  }

  void findNear(const LabelledScan& scan, const KeptMask& mask, Row& row) const {
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      if (mask[k] == 0) continue;
      row.grid->forEachWithin(scan.points[k], config_.tolerance,
                              [&row](std::uint32_t index, double) { row.near_kept[index] = true; });
    }
  }

  KthConfig config_;
  Labels labels_;
  std::span<const Estimate> estimates_;
  std::vector<Row> rows_;
  int pass_ = 0;
};

}  // namespace

std::unique_ptr<Protocol> makeKthProtocol(const KthConfig& config, const Labels& labels,
                                          std::span<const Estimate> rows) {
  requireLength(config.tolerance, "KthConfig::tolerance");
  requireLength(config.max_range, "KthConfig::max_range");
  requireLength(config.ego_radius, "KthConfig::ego_radius", true);
  return std::make_unique<KthProtocol>(config, labels, rows);
}

}  // namespace rhmap::eval
