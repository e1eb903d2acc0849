// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/map_collection.hpp"

#include <limits>
#include <ostream>

#include "rhmap/core/atomic_file.hpp"

namespace rhmap {

namespace map_frame {

point3d pointInMap(const pose6d& map_pose, const point3d& p) { return map_pose.inv().transform(p); }

point3d directionInMap(const pose6d& map_pose, const point3d& direction) {
  return map_pose.inv().rot().rotate(direction);
}

double distance(const point3d& a, const point3d& b) { return a.distance(b); }

}  // namespace map_frame

void writeVrml(const std::filesystem::path& file, const Pointcloud& points) {
  writeFileWhole(file, [&](std::ostream& s) {
    s.precision(std::numeric_limits<float>::max_digits10);
    s << "#VRML V2.0 utf8\nShape {\n  geometry PointSet {\n    coord Coordinate {\n      point [\n";
    for (const point3d& p : points) s << "        " << p.x() << ' ' << p.y() << ' ' << p.z() << ",\n";
    s << "      ]\n    }\n  }\n}\n";
  });
}

}  // namespace rhmap
