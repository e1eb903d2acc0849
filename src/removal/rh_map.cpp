// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/removal/rh_map.hpp"

#include "removal.hpp"

namespace rhmap {

std::string_view nameOf(Stage stage) {
  constexpr std::array<std::string_view, kStages> kNames{"transform", "regions", "ground", "image",
                                                         "void",      "removal", "map",    "back end"};
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

RhMap::RhMap(const RhMap& other) : OcTree(other), removal_(std::make_unique<Removal>(*this, other.config())) {}

RhMap::~RhMap() = default;

RhMap* RhMap::create() const { return new RhMap(getResolution(), config()); }

const RemovalConfig& RhMap::config() const { return removal_->config(); }

void RhMap::clear() {
  OcTree::clear();
  removal_ = std::make_unique<Removal>(*this, RemovalConfig(config()));
}

void RhMap::setResolution(double resolution) {
  OcTree::setResolution(resolution);
  removal_ = std::make_unique<Removal>(*this, RemovalConfig(config()));
}

ScanReport RhMap::insertScan(const octomap::Pointcloud& points, const octomap::pose6d& pose) {
  return removal_->process(points, pose, true);
}

ScanReport RhMap::removeDynamic(const octomap::Pointcloud& points, const octomap::pose6d& pose) {
  return removal_->process(points, pose, false);
}

ScanReport RhMap::finish() { return removal_->finish(); }

bool RhMap::isGround(const OcTreeKey& cube) const { return removal_->isGround(cube); }

std::size_t RhMap::removalMemoryUsage() const { return removal_->memoryUsage(); }

}  // namespace rhmap
