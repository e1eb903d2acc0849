// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// OctoMap's own templates without its messages, for the places that hold it against rhmap: the baseline, the benchmarks
// and the tests.
#include <octomap/octomap_types.h>

#undef OCTOMAP_DEBUG
#undef OCTOMAP_WARNING
#undef OCTOMAP_WARNING_STR
#undef OCTOMAP_ERROR
#undef OCTOMAP_ERROR_STR
#define OCTOMAP_DEBUG(...) static_cast<void>(0)
#define OCTOMAP_WARNING(...) static_cast<void>(0)
#define OCTOMAP_WARNING_STR(args) static_cast<void>(0)
#define OCTOMAP_ERROR(...) static_cast<void>(0)
#define OCTOMAP_ERROR_STR(args) static_cast<void>(0)

#include <octomap/OcTreeNode.h>
#include <octomap/OccupancyOcTreeBase.h>

#include <ostream>
#include <string>

namespace rhmap {

/// octomap::OcTree in all but the name of its node.
///
/// octomap::OcTree itself would not do for measuring. Its members are weak symbols that exist in every file that uses
/// the tree and in liboctomap.so, and which copy runs is settled by the linker and by the file that comes first, not by
/// us; Debian's copy is -O2 with asserts. A NODE in an anonymous namespace makes an instantiation that nobody can
/// replace.
template <class NODE>
class QuietOctomap : public octomap::OccupancyOcTreeBase<NODE> {
 public:
  explicit QuietOctomap(double resolution) : octomap::OccupancyOcTreeBase<NODE>(resolution) {}

  QuietOctomap* create() const override { return new QuietOctomap(this->resolution); }
  std::string getTreeType() const override { return "OcTree"; }

  /// OctoMap's function of this name without its message on stderr (liboctomap.so prints " done." where it has
  /// asserts).
  bool writeBinaryConst(std::ostream& out) const {
    out << this->binaryFileHeader << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
        << "id " << this->getTreeType() << "\nsize " << this->size() << "\nres " << this->getResolution() << "\ndata\n";
    this->writeBinaryData(out);
    return out.good();
  }

  bool writeBinary(std::ostream& out) {
    this->toMaxLikelihood();
    this->prune();
    return writeBinaryConst(out);
  }
};

}  // namespace rhmap
