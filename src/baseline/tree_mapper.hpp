// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rhmap/baseline/mapper.hpp"

namespace rhmap {

/// Any tree with OctoMap's names as a Mapper.
template <class Tree>
class TreeMapper final : public Mapper {
 public:
  TreeMapper(std::string_view name, const MapperConfig& config) : name_(name), tree_(config.resolution) {
    if constexpr (requires { tree_.setNumThreads(1); }) tree_.setNumThreads(config.num_threads);
  }

  std::string_view name() const override { return name_; }

  void insert(const octomap::Pointcloud& world_points, const octomap::point3d& sensor_origin,
              double max_range) override {
    tree_.insertPointCloud(world_points, sensor_origin, max_range);
  }

  std::size_t nodeCount() const override { return tree_.size(); }
  std::size_t leafCount() const override { return tree_.getNumLeafNodes(); }
  std::size_t memoryUsage() const override { return tree_.memoryUsage(); }

  void write(std::ostream& out) const override { tree_.write(out); }
  void writeBinaryConst(std::ostream& out) const override { tree_.writeBinaryConst(out); }

  void writeBinary(std::ostream& out) const override {
    Tree most_likely(tree_);
    most_likely.writeBinary(out);
  }

 private:
  std::string_view name_;  ///< of a constant
  Tree tree_;
};

}  // namespace rhmap
