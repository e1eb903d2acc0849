// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "add_point.hpp"
#include "memory_sequence.hpp"
#include "rhmap/core/failure.hpp"
#include "text_line.hpp"

namespace rhmap::io {

namespace {

octomap::pose6d readNodePose(TextLine& line) {
  const float x = line.readFloat("x of a NODE");
  const float y = line.readFloat("y of a NODE");
  const float z = line.readFloat("z of a NODE");
  const float roll = line.readFloat("roll of a NODE");
  const float pitch = line.readFloat("pitch of a NODE");
  const float yaw = line.readFloat("yaw of a NODE");
  if (!isFinite(x, y, z) || !isFinite(roll, pitch, yaw)) line.fail("pose of a NODE is not finite");
  return {x, y, z, roll, pitch, yaw};
}

}  // namespace

/// The text that ScanGraph::readPlainASCII reads, with its rules: lines that are empty or start with # or a blank are
/// skipped, as are further columns. Unlike there, a last line without a line end is not lost, and a malformed line is
/// an error instead of a made-up point.
std::unique_ptr<ScanSequence> openLog(const std::filesystem::path& file) {
  std::vector<MemorySequence::NamedScan> scans;
  forEachLine(file, [&scans](TextLine& line) {
    if (line.text().empty() || line.text().front() == '#' || line.text().front() == ' ') return;
    if (line.text().starts_with("NODE")) {
      if (line.word() != "NODE") line.fail("starts with NODE, but no blank follows");
      scans.push_back({.name = std::to_string(scans.size()), .scan = {}});
      scans.back().scan.pose = readNodePose(line);
      return;
    }
    if (scans.empty()) line.fail("a point before the first NODE");
    const float x = line.readFloat("x of a point");
    const float y = line.readFloat("y of a point");
    const float z = line.readFloat("z of a point");
    addPoint(scans.back().scan, x, y, z);
  });
  if (scans.empty()) failOnFile(file, "holds no scans (no line starts with NODE)");
  return std::make_unique<MemorySequence>(file, std::move(scans));
}

}  // namespace rhmap::io
