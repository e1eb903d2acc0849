// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <limits>

#include "add_point.hpp"
#include "binary_file.hpp"
#include "formats.hpp"
#include "kitti_poses.hpp"
#include "rhmap/core/failure.hpp"

namespace rhmap::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNoNumber = std::numeric_limits<std::size_t>::max();

struct Entry {
  std::string name;                // file name without .bin
  std::size_t number = kNoNumber;  // the name as a number, if it is one
};

std::size_t toNumber(const std::string& name) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : kNoNumber;
}

/// Scans by number (names need no leading zeros), or by name where a name is no number.
std::vector<Entry> listScans(const fs::path& velodyne) {
  if (!fs::is_directory(velodyne)) failOnFile(velodyne, "no such folder; KITTI's scans are expected in velodyne/*.bin");
  std::vector<Entry> entries;
  for (const fs::directory_entry& file : fs::directory_iterator(velodyne)) {
    if (file.path().extension() != ".bin") continue;
    const std::string name = file.path().stem().string();
    entries.push_back({name, toNumber(name)});
  }
  if (entries.empty()) failOnFile(velodyne, "holds no scans (*.bin)");
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.number != b.number ? a.number < b.number : a.name < b.name;
  });
  return entries;
}

/// Scan NNNNNN takes line NNNNNN of poses.txt; failing that, scan and pose i belong together if there are as many.
std::vector<octomap::pose6d> assignPoses(const fs::path& folder, const std::vector<Entry>& entries) {
  if (!fs::exists(folder / "poses.txt")) failOnFile(folder / "poses.txt", "no such file; one pose a scan is needed");
  const std::vector<octomap::pose6d> lines = readKittiPoses(folder);
  const Entry& last = entries.back();
  if (last.number >= lines.size()) {
    if (lines.size() == entries.size()) return lines;
    failOnFile(folder / "poses.txt",
               "holds " + std::to_string(lines.size()) + " poses, too few for scan " + last.name +
                   (last.number == kNoNumber ? " (its name is not a number)" : " (counted from 0)") +
                   " and not one for each of the " + std::to_string(entries.size()) + " scans");
  }
  std::vector<octomap::pose6d> poses;
  poses.reserve(entries.size());
  for (const Entry& entry : entries) poses.push_back(lines[entry.number]);
  return poses;
}

class KittiSequence : public ScanSequence {
 public:
  explicit KittiSequence(const fs::path& folder)
      : folder_(folder), entries_(listScans(folder / "velodyne")), poses_(assignPoses(folder, entries_)) {
    has_labels_ = fs::is_directory(folder_ / "labels");
    if (!has_labels_) return;
    for (const Entry& entry : entries_) {
      if (!fs::exists(labelFile(entry))) failOnFile(labelFile(entry), "no such file, but there is a folder of labels");
    }
  }

  std::size_t size() const override { return entries_.size(); }

  Scan scan(std::size_t i) const override {
    const Entry& entry = at(i);
    BinaryFile points(folder_ / "velodyne" / (entry.name + ".bin"));
    constexpr std::uint64_t kPointBytes = 4 * sizeof(float);  // x y z intensity
    const std::size_t num_points = countItems(points, kPointBytes, "points");
    const auto values = points.readArray<float>(4 * num_points, "number");
    const auto labels = has_labels_ ? readLabels(entry, num_points) : std::vector<std::uint32_t>();

    Scan scan;
    scan.pose = poses_[i];
    scan.points.reserve(num_points);
    scan.labels.reserve(labels.size());
    for (std::size_t k = 0; k < num_points; ++k) {
      const float x = values[4 * k];
      const float y = values[4 * k + 1];
      const float z = values[4 * k + 2];
      // The sensor marks "no return" by its own origin, which would become an obstacle in the sensor.
      if (!isFinite(x, y, z) || (x == 0 && y == 0 && z == 0)) {
        ++scan.dropped;
        continue;
      }
      scan.points.push_back(x, y, z);
      if (has_labels_) scan.labels.push_back(labels[k]);
    }
    return scan;
  }

  std::string name(std::size_t i) const override { return at(i).name; }

  bool hasLabels() const override { return has_labels_; }

 private:
  const Entry& at(std::size_t i) const {
    checkIndex(folder_, i, entries_.size());
    return entries_[i];
  }

  fs::path labelFile(const Entry& entry) const { return folder_ / "labels" / (entry.name + ".label"); }

  static std::size_t countItems(const BinaryFile& file, std::uint64_t bytes, const std::string& what) {
    if (file.size() % bytes != 0) {
      failOnFile(file.path(), std::to_string(file.size()) + " bytes are not a whole number of " + what + " of " +
                                  std::to_string(bytes) + " bytes");
    }
    return static_cast<std::size_t>(file.size() / bytes);
  }

  std::vector<std::uint32_t> readLabels(const Entry& entry, std::size_t num_points) const {
    BinaryFile file(labelFile(entry));
    const std::size_t num_labels = countItems(file, sizeof(std::uint32_t), "labels");
    if (num_labels != num_points) {
      failOnFile(file.path(), std::to_string(num_labels) + " labels for " + std::to_string(num_points) + " points");
    }
    return file.readArray<std::uint32_t>(num_labels, "label");
  }

  fs::path folder_;
  std::vector<Entry> entries_;
  std::vector<octomap::pose6d> poses_;
  bool has_labels_ = false;
};

}  // namespace

std::unique_ptr<ScanSequence> openKitti(const std::filesystem::path& folder) {
  return std::make_unique<KittiSequence>(folder);
}

}  // namespace rhmap::io
