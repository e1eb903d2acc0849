// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rhmap::test {

/// A map on its way to another program, as ROS's octomap_msgs/Octomap carries it.
struct Message {
  bool binary;
  std::string id;
  double resolution;
  std::vector<std::int8_t> data;

  bool operator==(const Message&) const = default;
};

/// What octomap::OcTree answers and sends. world.cpp is compiled twice, where it is OctoMap's own and where it is ours;
/// no octomap::OcTree passes through this interface, so both live in one program.
class World {
 public:
  virtual ~World() = default;

  /// octomap::OcTree is rhmap::OcTree.
  virtual bool isRhmap() const = 0;
  /// Calls many members; their answers as text, and the bytes of the map at each stage.
  virtual std::vector<std::string> answers() const = 0;
  /// Makes a map of a type ("OcTree", "ColorOcTree") and sends it, with all values or as occupied/free.
  virtual Message send(const std::string& type, bool binary) const = 0;
  /// Receives a map: its .ot file, and the map sent on.
  struct Received {
    std::string ot;
    Message sent_on;
  };
  virtual Received receive(const Message& message) const = 0;
};

const World& stockWorld();
const World& compatWorld();

}  // namespace rhmap::test
