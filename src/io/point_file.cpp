// SPDX-License-Identifier: BSD-3-Clause
#include "add_point.hpp"
#include "memory_sequence.hpp"
#include "rhmap/core/failure.hpp"
#include "text_line.hpp"

namespace rhmap::io {

/// Lines `x y z` (further columns are ignored, as are empty lines and comments with #): one scan at the origin.
std::unique_ptr<ScanSequence> openPointFile(const std::filesystem::path& file) {
  MemorySequence::NamedScan only{.name = file.stem().string(), .scan = {}};
  forEachLine(file, [&only](TextLine& line) {
    const std::size_t first = line.text().find_first_not_of(" \t");
    if (first == std::string_view::npos || line.text()[first] == '#') return;
    const float x = line.readFloat("x of a point");
    const float y = line.readFloat("y of a point");
    const float z = line.readFloat("z of a point");
    addPoint(only.scan, x, y, z);
  });
  if (only.scan.points.size() + only.scan.dropped == 0) failOnFile(file, "holds no points");
  return std::make_unique<MemorySequence>(file, std::vector{std::move(only)});
}

}  // namespace rhmap::io
