// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/face_mesh.hpp"

#include <algorithm>

namespace rhmap::render {

Box boundsOf(const FaceMesh& mesh) {
  std::array<int, 3> min{0x10000, 0x10000, 0x10000}, max{-1, -1, -1};  // keys, the upper ones not included
  for (const Face& face : mesh.faces)
    for (unsigned axis = 0; axis < 3; ++axis) {
      const int corner = face.corner[axis];
      min[axis] = std::min(min[axis], corner);
      max[axis] = std::max(max[axis], corner + (1 << face.edge_log2));
    }
  if (mesh.faces.empty()) return {};
  const auto metres = [&](const std::array<int, 3>& keys) {
    Eigen::Vector3d point(keys[0], keys[1], keys[2]);
    return Eigen::Vector3d(mesh.resolution * (point.array() - double(kTreeMaxVal)).matrix());
  };
  return {metres(min), metres(max)};
}

}  // namespace rhmap::render
