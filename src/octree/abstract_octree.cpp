// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/abstract_octree.hpp"

#include <fstream>
#include <map>
#include <memory>
#include <mutex>

#include "rhmap/core/atomic_file.hpp"
#include "rhmap/octree/abstract_occupancy_octree.hpp"
#include "rhmap/octree/color_octree.hpp"
#include "rhmap/octree/counting_octree.hpp"
#include "rhmap/octree/map_file.hpp"
#include "rhmap/octree/octree.hpp"
#include "rhmap/octree/stamped_octree.hpp"

namespace rhmap {
namespace {

/// Prototypes by id. Our own types are in it from the start, so that nothing hangs on the order of static objects.
class TreeTypes {
 public:
  TreeTypes() {
    add(std::make_unique<OcTree>(0.1));
    add(std::make_unique<ColorOcTree>(0.1));
    add(std::make_unique<OcTreeStamped>(0.1));
    add(std::make_unique<CountingOcTree>(0.1));
  }

  void add(std::unique_ptr<AbstractOcTree> prototype) {
    const std::lock_guard lock(mutex_);
    const std::string id = prototype->getTreeType();
    prototypes_[id] = std::move(prototype);
  }

  std::unique_ptr<AbstractOcTree> create(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto it = prototypes_.find(id);
    return std::unique_ptr<AbstractOcTree>(it == prototypes_.end() ? nullptr : it->second->create());
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<AbstractOcTree>> prototypes_;
};

TreeTypes& treeTypes() {
  static TreeTypes types;
  return types;
}

MapHeader headerOf(const AbstractOcTree& tree) {
  return {.id = tree.getTreeType(), .size = static_cast<unsigned>(tree.size()), .resolution = tree.getResolution()};
}

/// Runs `write` on a file; the facade's `bool` instead of the reason.
template <class F>
bool toFile(const std::string& filename, F&& write) try {
  writeFileWhole(filename, [&](std::ostream& s) { write(s); });
  return true;
} catch (const std::runtime_error&) {
  return false;
}

}  // namespace

bool AbstractOcTree::write(const std::string& filename) const {
  return toFile(filename, [this](std::ostream& s) { write(s); });
}

bool AbstractOcTree::write(std::ostream& s) const {
  writeMapHeader(s, MapFormat::kFull, headerOf(*this));
  writeData(s);
  return s.good();
}

AbstractOcTree* AbstractOcTree::read(const std::string& filename) {
  std::ifstream s(filename, std::ios::binary);
  return s ? read(s) : nullptr;
}

AbstractOcTree* AbstractOcTree::read(std::istream& s) try {
  return readFullMap(s).release();
} catch (const std::runtime_error&) {
  return nullptr;
}

AbstractOcTree* AbstractOcTree::createTree(const std::string& id, double resolution) {
  std::unique_ptr<AbstractOcTree> tree = treeTypes().create(id);
  if (tree) tree->setResolution(resolution);
  return tree.release();
}

void AbstractOcTree::registerTreeType(AbstractOcTree* prototype) {
  treeTypes().add(std::unique_ptr<AbstractOcTree>(prototype));
}

bool AbstractOccupancyOcTree::writeBinary(const std::string& filename) {
  toMaxLikelihood();
  prune();
  return writeBinaryConst(filename);
}

bool AbstractOccupancyOcTree::writeBinary(std::ostream& s) {
  toMaxLikelihood();
  prune();
  return writeBinaryConst(s);
}

bool AbstractOccupancyOcTree::writeBinaryConst(const std::string& filename) const {
  return toFile(filename, [this](std::ostream& s) { writeBinaryConst(s); });
}

bool AbstractOccupancyOcTree::writeBinaryConst(std::ostream& s) const {
  writeMapHeader(s, MapFormat::kBinary, headerOf(*this));
  writeBinaryData(s);
  return s.good();
}

bool AbstractOccupancyOcTree::readBinary(const std::string& filename) {
  std::ifstream s(filename, std::ios::binary);
  return s && readBinary(s);
}

bool AbstractOccupancyOcTree::readBinary(std::istream& s) try {
  readBinaryMap(s, *this);
  return true;
} catch (const std::runtime_error&) {
  return false;
}

}  // namespace rhmap
