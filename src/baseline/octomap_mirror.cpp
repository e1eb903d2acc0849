// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/baseline/octomap_mirror.hpp"

namespace rhmap {

template class BasicOctomapMirror<OcTreeNode>;

}  // namespace rhmap
