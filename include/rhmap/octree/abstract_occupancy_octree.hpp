// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/octomap_utils.h>

#include <iosfwd>
#include <string>

#include "rhmap/octree/abstract_octree.hpp"
#include "rhmap/octree/node.hpp"

namespace rhmap {

/// Trees that hold occupancy: the sensor model and the .bt files. Probabilities come in as double and are kept as float
/// log-odds, as OctoMap keeps them.
class AbstractOccupancyOcTree : public AbstractOcTree {
 public:
  /// Writes a .bt file, whole or not at all, after turning this tree into its maximum-likelihood estimate and pruning
  /// it: the probabilities in memory are lost. False if writing failed.
  bool writeBinary(const std::string& filename);
  bool writeBinary(std::ostream& s);
  /// The same without changing the tree, in its present structure.
  bool writeBinaryConst(const std::string& filename) const;
  bool writeBinaryConst(std::ostream& s) const;

  /// Replaces this tree by a .bt file's, resolution included; keeps the sensor model. On failure the tree is empty.
  bool readBinary(const std::string& filename);
  bool readBinary(std::istream& s);

  virtual std::istream& readBinaryData(std::istream& s) = 0;
  virtual std::ostream& writeBinaryData(std::ostream& s) const = 0;

  bool isNodeOccupied(const OcTreeNode* node) const { return node->getLogOdds() >= occ_prob_thres_log; }
  bool isNodeOccupied(const OcTreeNode& node) const { return isNodeOccupied(&node); }
  bool isNodeAtThreshold(const OcTreeNode* node) const {
    return node->getLogOdds() >= clamping_thres_max || node->getLogOdds() <= clamping_thres_min;
  }
  bool isNodeAtThreshold(const OcTreeNode& node) const { return isNodeAtThreshold(&node); }

  virtual OcTreeNode* updateNode(const OcTreeKey& key, float log_odds_update, bool lazy_eval = false) = 0;
  virtual OcTreeNode* updateNode(const point3d& value, float log_odds_update, bool lazy_eval = false) = 0;
  virtual OcTreeNode* updateNode(const OcTreeKey& key, bool occupied, bool lazy_eval = false) = 0;
  virtual OcTreeNode* updateNode(const point3d& value, bool occupied, bool lazy_eval = false) = 0;

  virtual void toMaxLikelihood() = 0;

  // Sensor model. Changing the clamping does not clamp what is already in the map.
  void setOccupancyThres(double p) { occ_prob_thres_log = octomap::logodds(p); }
  void setProbHit(double p) { prob_hit_log = octomap::logodds(p); }
  void setProbMiss(double p) { prob_miss_log = octomap::logodds(p); }
  void setClampingThresMin(double p) { clamping_thres_min = octomap::logodds(p); }
  void setClampingThresMax(double p) { clamping_thres_max = octomap::logodds(p); }

  double getOccupancyThres() const { return octomap::probability(occ_prob_thres_log); }
  float getOccupancyThresLog() const { return occ_prob_thres_log; }
  double getProbHit() const { return octomap::probability(prob_hit_log); }
  float getProbHitLog() const { return prob_hit_log; }
  double getProbMiss() const { return octomap::probability(prob_miss_log); }
  float getProbMissLog() const { return prob_miss_log; }
  double getClampingThresMin() const { return octomap::probability(clamping_thres_min); }
  float getClampingThresMinLog() const { return clamping_thres_min; }
  double getClampingThresMax() const { return octomap::probability(clamping_thres_max); }
  float getClampingThresMaxLog() const { return clamping_thres_max; }

 protected:
  // OctoMap's protected names, which subclasses read. Log-odds.
  float clamping_thres_min = octomap::logodds(0.1192);
  float clamping_thres_max = octomap::logodds(0.971);
  float prob_hit_log = octomap::logodds(0.7);
  float prob_miss_log = octomap::logodds(0.4);
  float occ_prob_thres_log = octomap::logodds(0.5);
};

}  // namespace rhmap
