// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <unordered_map>

#include "cell_map.hpp"
#include "require.hpp"
#include "rhmap/eval/protocol.hpp"

namespace rhmap::eval {
namespace {

/// The points of a cube by Kind: ignored, static, dynamic.
using Census = std::array<std::uint32_t, 3>;

std::uint32_t of(const Census& census, Kind kind) { return census[static_cast<std::size_t>(kind)]; }

/// The cubes of the un-cleaned map are the ground truth, and a cube is looked for in its own place only: among centres
/// of cubes a tolerance of half a diagonal, less than a cube, finds no other. Memory goes with the map, not with the
/// points.
class RhmapProtocol : public Protocol {
 public:
  RhmapProtocol(const RhmapConfig& config, const Labels& labels, std::span<const Estimate> rows)
      : labels_(labels), estimates_(rows), grid_(config.resolution), rows_(rows.size()) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (const octomap::point3d& point : rows[r].cloud) rows_[r].cloud_cubes.findOrAdd(grid_.cellOf(point));
    }
  }

  void add(const LabelledScan& scan, std::span<const KeptMask> masks) override {
    for (std::size_t k = 0; k < scan.points.size(); ++k) {
      const Cell cell = grid_.cellOf(scan.points[k]);
      const std::uint32_t id = cubes_.findOrAdd(cell);
      const std::size_t kind = static_cast<std::size_t>(labels_.kind(scan.labels[k]));
      if (id == truth_.size()) addCube();
      ++truth_[id][kind];
      if (labels_.isDynamic(scan.labels[k])) ++classes_[id][static_cast<std::uint16_t>(scan.labels[k] & 0xffffU)];
      for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (keeps(r, masks, k, cell)) ++rows_[r].kept[id][kind];
      }
    }
  }

  void endPass() override {}

  std::vector<Score> scores() const override {
    std::vector<Score> scores;
    for (std::size_t r = 0; r < rows_.size(); ++r) scores.push_back(scoreOf(r));
    return scores;
  }

 private:
  struct Row {
    CellMap cloud_cubes;
    std::vector<Census> kept;  // one a cube of truth_
  };

  void addCube() {
    truth_.emplace_back();
    for (Row& row : rows_) row.kept.emplace_back();
  }

  bool keeps(std::size_t r, std::span<const KeptMask> masks, std::size_t k, const Cell& cell) const {
    return estimates_[r].keep ? masks[r][k] != 0 : rows_[r].cloud_cubes.find(cell) != CellMap::kNone;
  }

  /// The majority of the labelled points; a tie is static: it takes more than half to call something moving.
  static bool isDynamic(const Census& census) { return of(census, Kind::kDynamic) > of(census, Kind::kStatic); }

  /// The most frequent dynamic class of a cube, the smallest of equals.
  std::uint16_t classOf(std::uint32_t id) const {
    std::uint16_t best = 0;
    std::uint32_t most = 0;
    for (const auto& [label, count] : classes_.at(id)) {
      if (count > most || (count == most && label < best)) best = label, most = count;
    }
    return best;
  }

  Score scoreOf(std::size_t r) const {
    Counts cells, points;
    Score score{.protocol = "rhmap", .row = estimates_[r].name};
    for (std::uint32_t id = 0; id < truth_.size(); ++id) {
      const Census& truth = truth_[id];
      const Census& kept = rows_[r].kept[id];
      const bool survives = kept != Census{};
      const bool carries_dynamic = isDynamic(kept);
      if (survives) ++(carries_dynamic ? score.dynamic_cells : score.static_cells);
      // SA and DA by whole cubes: a point is kept if its cube is.
      const std::uint32_t still = of(truth, Kind::kStatic), moving = of(truth, Kind::kDynamic);
      addPoints(points.still, still, survives);
      addPoints(points.moving, moving, survives);
      if (moving > 0) {
        for (const auto& [label, count] : classes_.at(id)) addPoints(points.classes[label], count, survives);
      }
      // PR and RR: a cube counts as kept if its label is, too.
      if (isDynamic(truth)) {
        addPoints(cells.moving, 1, survives && carries_dynamic);
        addPoints(cells.classes[classOf(id)], 1, survives && carries_dynamic);
      } else if (still > 0) {
        addPoints(cells.still, 1, survives && !carries_dynamic);
      }
    }
    score.cells = cells;
    score.points = points;
    return score;
  }

  static void addPoints(Survivors& survivors, std::uint32_t count, bool kept) {
    survivors.total += count;
    if (kept) survivors.kept += count;
  }

  Labels labels_;
  std::span<const Estimate> estimates_;
  CellGrid grid_;
  CellMap cubes_;
  std::vector<Census> truth_;
  std::unordered_map<std::uint32_t, std::unordered_map<std::uint16_t, std::uint32_t>> classes_;  // dynamic points
  std::vector<Row> rows_;
};

}  // namespace

std::unique_ptr<Protocol> makeRhmapProtocol(const RhmapConfig& config, const Labels& labels,
                                            std::span<const Estimate> rows) {
  requireLength(config.resolution, "RhmapConfig::resolution");
  return std::make_unique<RhmapProtocol>(config, labels, rows);
}

}  // namespace rhmap::eval
