// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace rhmap {

/// What all trees have in common, under OctoMap's names. The file functions keep OctoMap's `bool` and null; the forms
/// that say why something failed are in map_file.hpp.
class AbstractOcTree {
 public:
  virtual ~AbstractOcTree() = default;

  /// An empty tree of the same type and resolution; the caller owns it.
  virtual AbstractOcTree* create() const = 0;
  /// The id that files carry, e.g. "OcTree".
  virtual std::string getTreeType() const = 0;

  virtual double getResolution() const = 0;
  virtual void setResolution(double resolution) = 0;
  virtual std::size_t size() const = 0;
  virtual std::size_t memoryUsage() const = 0;
  virtual std::size_t memoryUsageNode() const = 0;
  virtual void getMetricMin(double& x, double& y, double& z) = 0;
  virtual void getMetricMin(double& x, double& y, double& z) const = 0;
  virtual void getMetricMax(double& x, double& y, double& z) = 0;
  virtual void getMetricMax(double& x, double& y, double& z) const = 0;
  virtual void getMetricSize(double& x, double& y, double& z) = 0;
  virtual void prune() = 0;
  virtual void expand() = 0;
  virtual void clear() = 0;

  /// Writes a .ot file, whole or not at all. False if that failed.
  bool write(const std::string& filename) const;
  /// Writes a .ot stream: text header and all values.
  bool write(std::ostream& s) const;

  /// Reads a .ot file or stream into a tree of the type that its header names. Null if it is not one; the caller owns
  /// it.
  static AbstractOcTree* read(const std::string& filename);
  static AbstractOcTree* read(std::istream& s);

  /// An empty tree of the type with this id; null if no such type is registered. The caller owns it.
  static AbstractOcTree* createTree(const std::string& id, double resolution);

  /// The nodes only, without a header. Reading needs an empty tree; on bad data the stream fails and the tree is empty.
  virtual std::istream& readData(std::istream& s) = 0;
  virtual std::ostream& writeData(std::ostream& s) const = 0;

 protected:
  AbstractOcTree() = default;
  AbstractOcTree(const AbstractOcTree&) = default;
  AbstractOcTree& operator=(const AbstractOcTree&) = default;

  /// Makes `read` and `createTree` know the prototype's type. The registry owns the prototype.
  static void registerTreeType(AbstractOcTree* prototype);
};

}  // namespace rhmap
