// SPDX-License-Identifier: BSD-3-Clause
// Trees that derive from OcTree: MoveIt's (a lock, a callback) and one with thresholds and updates of its own.
#include <octomap/octomap.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "dice.hpp"
#include "parts.hpp"

namespace {

using OccMapNode = octomap::OcTreeNode;

class OccMapTree : public octomap::OcTree {
 public:
  OccMapTree(double resolution) : octomap::OcTree(resolution) {}
  OccMapTree(const std::string& filename) : octomap::OcTree(filename) {}

  void lockRead() { tree_mutex_.lock_shared(); }
  void unlockRead() { tree_mutex_.unlock_shared(); }
  bool tryLockRead() { return tree_mutex_.try_lock_shared(); }
  void lockWrite() { tree_mutex_.lock(); }
  void unlockWrite() { tree_mutex_.unlock(); }
  std::shared_lock<std::shared_mutex> reading() { return std::shared_lock<std::shared_mutex>(tree_mutex_); }
  std::unique_lock<std::shared_mutex> writing() { return std::unique_lock<std::shared_mutex>(tree_mutex_); }

  void triggerUpdateCallback() {
    if (update_callback_) update_callback_();
  }
  void setUpdateCallback(const std::function<void()>& callback) { update_callback_ = callback; }

 private:
  std::shared_mutex tree_mutex_;
  std::function<void()> update_callback_;
};

/// Reads the protected thresholds and inserts in its own way.
class PatientTree : public octomap::OcTree {
 public:
  PatientTree(double resolution) : octomap::OcTree(resolution) { prob_miss_log = octomap::logodds(0.45); }

  PatientTree* create() const { return new PatientTree(getResolution()); }
  std::string getTreeType() const { return "PatientTree"; }

  octomap::OcTreeNode* patient(const octomap::OcTreeKey& key, bool occupied) {
    octomap::OcTreeNode* leaf = this->search(key);
    if (leaf && ((occupied && leaf->getLogOdds() >= this->clamping_thres_max) ||
                 (!occupied && leaf->getLogOdds() <= this->clamping_thres_min))) {
      ++skipped;
      return leaf;
    }
    return this->updateNode(key, (occupied ? this->prob_hit_log : this->prob_miss_log) / 2, true);
  }

  unsigned skipped = 0;
};

}  // namespace

void subclass(const std::string& folder) {
  const std::shared_ptr<OccMapTree> tree = std::make_shared<OccMapTree>(0.05);
  unsigned updates = 0;
  tree->setUpdateCallback([&] { ++updates; });
  Dice dice(2);
  octomap::KeyRay key_ray;
  for (int i = 0; i < 3; ++i) {
    const octomap::point3d sensor(0.3F * static_cast<float>(i), 0, 0);
    octomap::KeySet free_cells, occupied_cells, model_cells;
    for (const octomap::point3d& p : roomScan(sensor, 700, dice)) {
      if (tree->computeRayKeys(sensor, p, key_ray)) free_cells.insert(key_ray.begin(), key_ray.end());
      (dice.below(10) == 0 ? model_cells : occupied_cells).insert(tree->coordToKey(p));
    }
    for (const octomap::OcTreeKey& cell : occupied_cells) free_cells.erase(cell);
    for (const octomap::OcTreeKey& cell : model_cells) occupied_cells.erase(cell);
    const auto lock = tree->writing();
    for (const octomap::OcTreeKey& cell : free_cells) tree->updateNode(cell, false);
    for (const octomap::OcTreeKey& cell : occupied_cells) tree->updateNode(cell, true);
    const float lower = tree->getClampingThresMinLog() - tree->getClampingThresMaxLog();
    for (const octomap::OcTreeKey& cell : model_cells) tree->updateNode(cell, lower);
    tree->triggerUpdateCallback();
  }
  {
    const auto lock = tree->reading();
    std::printf("%u updates, %zu nodes\n", updates, tree->size());
    tree->writeBinaryConst(folder + "/moveit.bt");
    tree->write(folder + "/moveit.ot");
  }
  OccMapTree again(folder + "/moveit.bt");
  std::printf("%zu nodes in the copy, %d is an OcTree\n", again.size(),
              dynamic_cast<octomap::OcTree*>(static_cast<octomap::AbstractOcTree*>(&again)) != nullptr);

  PatientTree patient(0.2);
  for (int i = 0; i < 20000; ++i) {
    const octomap::OcTreeKey key = patient.coordToKey(dice.point(0.8F));
    patient.patient(key, key[0] % 3 != 0);
  }
  patient.updateInnerOccupancy();
  std::printf("%u skipped, %zu nodes of type %s\n", patient.skipped, patient.size(), patient.getTreeType().c_str());
  patient.write(folder + "/patient.ot");
  PatientTree copy(patient);
  copy.prune();
  std::printf("copy: %zu nodes, %s\n", copy.size(), copy == patient ? "equal" : "different");
}
