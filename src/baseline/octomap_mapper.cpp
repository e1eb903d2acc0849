// SPDX-License-Identifier: BSD-3-Clause
// OctoMap as it should be measured: its templates compiled here, -O3 -DNDEBUG (see CMakeLists.txt), and silent.
//
// octomap::OcTree would not do. Its insertPointCloud is a weak symbol that exists in every file that uses the tree and
// in liboctomap.so, and which copy runs is settled by the linker and by the file that comes first, not by us. Debian's
// copy is -O2 with asserts. A node type in an anonymous namespace makes an instantiation that nobody else can replace.
#include <octomap/octomap_types.h>

// OctoMap warns of every point outside its key space; a mapper skips it in silence, and leaves the count to the reader.
#undef OCTOMAP_WARNING_STR
#define OCTOMAP_WARNING_STR(args) static_cast<void>(0)

#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <ostream>

#include "mappers.hpp"
#include "tree_mapper.hpp"

namespace rhmap {
namespace {

/// OctoMap's node under a name of our own.
class Node final : public octomap::OcTreeNode {};

/// octomap::OcTree in all but the name of its node.
class Tree final : public octomap::OccupancyOcTreeBase<Node> {
 public:
  explicit Tree(double resolution) : OccupancyOcTreeBase(resolution) {}

  Tree* create() const override { return new Tree(resolution); }
  std::string getTreeType() const override { return "OcTree"; }

  /// OctoMap's function of this name without its message on stderr (liboctomap.so prints " done." where it has
  /// asserts).
  void writeBinaryConst(std::ostream& out) const {
    out << binaryFileHeader << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
        << "id " << getTreeType() << "\nsize " << size() << "\nres " << getResolution() << "\ndata\n";
    writeBinaryData(out);
  }

  void writeBinary(std::ostream& out) {
    toMaxLikelihood();
    prune();
    writeBinaryConst(out);
  }
};

}  // namespace

std::unique_ptr<Mapper> makeOctomapMapper(std::string_view name, const MapperConfig& config) {
  return std::make_unique<TreeMapper<Tree>>(name, config);
}

}  // namespace rhmap
