// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "add_point.hpp"
#include "binary_file.hpp"
#include "formats.hpp"
#include "rhmap/core/failure.hpp"

namespace rhmap::io {

namespace {

// A vector is its dimension (int32 3), then three float64; a quaternion the same with 4; a pose one of each.
constexpr std::uint64_t kVectorBytes = 4 + 3 * 8;
constexpr std::uint64_t kPoseBytes = kVectorBytes + 4 + 4 * 8;
constexpr std::uint64_t kEmptyNodeBytes = 4 + kPoseBytes + 4;
constexpr std::uint64_t kEdgeBytes = 4 + 4 + kPoseBytes + 8;

struct Node {
  std::uint64_t points_begin = 0;  // byte position in the file
  std::uint32_t num_points = 0;
  octomap::pose6d pose;
  std::uint32_t id = 0;
};

/// Reads the dimension in front of N numbers, which OctoMap always writes, then the numbers.
template <std::size_t N>
void readTuple(BinaryFile& file, double (&numbers)[N], const std::string& what) {
  const std::uint64_t begin = file.position();
  const auto dimension = file.read<std::int32_t>(what);
  if (dimension != static_cast<std::int32_t>(N)) {
    failOnFile(file.path(), "byte " + std::to_string(begin) + ": " + what + " has dimension " +
                                std::to_string(dimension) + " instead of " + std::to_string(N));
  }
  for (double& number : numbers) number = file.read<double>(what);
}

octomap::pose6d readPose(BinaryFile& file) {
  const std::uint64_t begin = file.position();
  double t[3];
  double q[4];
  readTuple(file, t, "translation of a pose");
  readTuple(file, q, "rotation of a pose");
  const octomath::Vector3 translation(static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2]));
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!isFinite(translation.x(), translation.y(), translation.z()) || !(std::abs(norm - 1.0) < 1e-2)) {
    failOnFile(file.path(), "byte " + std::to_string(begin) + ": not a pose: translation (" + std::to_string(t[0]) +
                                ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) + "), quaternion of length " +
                                std::to_string(norm));
  }
  return {translation, octomath::Quaternion(static_cast<float>(q[0]), static_cast<float>(q[1]),
                                            static_cast<float>(q[2]), static_cast<float>(q[3]))};
}

/// Checks the whole structure once, so that scans can be read one by one later; edges are not kept.
std::vector<Node> readIndex(BinaryFile& file) {
  const auto num_nodes = file.read<std::uint32_t>("number of scans");
  if (num_nodes == 0) failOnFile(file.path(), "holds no scans");
  file.require(num_nodes, kEmptyNodeBytes, "scan");
  std::vector<Node> nodes(num_nodes);
  for (Node& node : nodes) {
    node.num_points = file.read<std::uint32_t>("number of points");
    node.points_begin = file.position();
    file.skip(node.num_points, kVectorBytes, "point");
    node.pose = readPose(file);
    node.id = file.read<std::uint32_t>("id of a scan");
  }
  file.skip(file.read<std::uint32_t>("number of edges"), kEdgeBytes, "edge");
  // The format has no magic: only its counts say that this is a graph, so they have to add up.
  if (file.remaining() != 0) {
    failOnFile(file.path(), "byte " + std::to_string(file.position()) + ": " + std::to_string(file.remaining()) +
                                " bytes follow the end of the graph");
  }
  return nodes;
}

class GraphSequence : public ScanSequence {
 public:
  explicit GraphSequence(const std::filesystem::path& file) : file_(file) {
    BinaryFile binary(file_);
    nodes_ = readIndex(binary);
  }

  std::size_t size() const override { return nodes_.size(); }

  Scan scan(std::size_t i) const override {
    const Node& node = at(i);
    BinaryFile binary(file_);
    binary.seek(node.points_begin);
    binary.require(node.num_points, kVectorBytes, "point");
    const auto bytes = binary.readArray<char>(node.num_points * kVectorBytes, "bytes of points");

    Scan scan;
    scan.pose = node.pose;
    scan.points.reserve(node.num_points);
    for (std::size_t k = 0; k < node.num_points; ++k) {
      std::int32_t dimension;
      double p[3];
      std::memcpy(&dimension, &bytes[k * kVectorBytes], sizeof(dimension));
      std::memcpy(p, &bytes[k * kVectorBytes + sizeof(dimension)], sizeof(p));
      if (dimension != 3) {
        failOnFile(file_, "byte " + std::to_string(node.points_begin + k * kVectorBytes) + ": point has dimension " +
                              std::to_string(dimension) + " instead of 3");
      }
      addPoint(scan, static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
    }
    return scan;
  }

  std::string name(std::size_t i) const override { return std::to_string(at(i).id); }

 private:
  const Node& at(std::size_t i) const {
    checkIndex(file_, i, nodes_.size());
    return nodes_[i];
  }

  std::filesystem::path file_;
  std::vector<Node> nodes_;
};

}  // namespace

std::unique_ptr<ScanSequence> openGraph(const std::filesystem::path& file) {
  return std::make_unique<GraphSequence>(file);
}

}  // namespace rhmap::io
