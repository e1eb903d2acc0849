// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Stock OctoMap as the oracle, with OctoMap 1.10's answers where the installed 1.9.7 gives others (the box limit of
// insertPointCloud, issue OctoMap/octomap#358).
#undef _OPENMP  // with it OctoMap's insertPointCloudRays updates in an order that differs from run to run
#include "../../src/baseline/quiet_octomap.hpp"

#include <sstream>
#include <string>

namespace rhmap::test {

/// OctoMap's node. Frees its emptied child array, which OctoMap's deleteNode leaves behind: Debian's library asserts
/// that there is none.
class OracleNode : public octomap::OcTreeNode {
 public:
  OracleNode() = default;
  OracleNode(const OracleNode&) = default;
  ~OracleNode() {
    delete[] children;
    children = nullptr;
  }
};

class OctomapOracle : public QuietOctomap<OracleNode> {
  using Base = QuietOctomap<OracleNode>;

 public:
  explicit OctomapOracle(double resolution) : Base(resolution) {}

  OctomapOracle* create() const override { return new OctomapOracle(resolution); }

  using Base::insertPointCloud;
  void insertPointCloud(const octomap::Pointcloud& scan, const octomap::point3d& origin, double maxrange = -1.,
                        bool lazy_eval = false, bool discretize = false) override {
    octomap::KeySet free, occupied;
    if (discretize) {
      computeDiscreteUpdate(scan, origin, free, occupied, maxrange);
    } else {
      computeUpdate(scan, origin, free, occupied, maxrange);
    }
    for (const auto& key : free) updateNode(key, false, lazy_eval);
    for (const auto& key : occupied) updateNode(key, true, lazy_eval);
  }

  void computeUpdate(const octomap::Pointcloud& scan, const octomap::point3d& origin, octomap::KeySet& free,
                     octomap::KeySet& occupied, double maxrange) {
    if (!use_bbx_limit) return Base::computeUpdate(scan, origin, free, occupied, maxrange);
    for (const octomap::point3d& p : scan) {
      const bool in_range = maxrange < 0.0 || (p - origin).norm() <= maxrange;
      octomap::OcTreeKey end_key;
      if (in_range && inBBX(p) && coordToKeyChecked(p, end_key)) occupied.insert(end_key);
      const octomap::point3d end = in_range ? p : origin + (p - origin).normalized() * static_cast<float>(maxrange);
      octomap::KeyRay ray;
      if (!computeRayKeys(origin, end, ray)) continue;
      for (auto it = ray.begin(); it != ray.end() && inBBX(*it); ++it) free.insert(*it);
    }
    for (const auto& key : occupied) free.erase(key);
  }

  void computeDiscreteUpdate(const octomap::Pointcloud& scan, const octomap::point3d& origin, octomap::KeySet& free,
                             octomap::KeySet& occupied, double maxrange) {
    octomap::Pointcloud centres;
    octomap::KeySet seen;
    for (const octomap::point3d& p : scan)
      if (seen.insert(coordToKey(p)).second) centres.push_back(keyToCoord(coordToKey(p)));
    computeUpdate(centres, origin, free, occupied, maxrange);
  }

  // 1.9.7 takes these by non-const reference.
  void setBBXMin(octomap::point3d min) { Base::setBBXMin(min); }
  void setBBXMax(octomap::point3d max) { Base::setBBXMax(max); }
};

/// The map as a .ot file.
template <class Tree>
std::string otBytes(const Tree& tree) {
  std::ostringstream s;
  tree.write(s);
  return std::move(s).str();
}

/// The map as a .bt file, in its present structure.
template <class Tree>
std::string btBytes(const Tree& tree) {
  std::ostringstream s;
  tree.writeBinaryConst(s);
  return std::move(s).str();
}

}  // namespace rhmap::test
