// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/map_collection_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <locale>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <system_error>

#include "rhmap/core/atomic_file.hpp"
#include "rhmap/core/failure.hpp"

namespace rhmap {
namespace {

namespace fs = std::filesystem;

// --- reading ---

/// The lines of a collection file that say something.
class Lines {
 public:
  explicit Lines(const fs::path& file) : file_(file), stream_(file, std::ios::binary) {
    if (!stream_) failOnFile(file, "cannot be opened");
  }

  /// What follows the first blank of the next line; empty at the end of the file.
  std::optional<std::string> next() {
    for (std::string line; std::getline(stream_, line);) {
      ++number_;
      if (line.ends_with('\r')) line.pop_back();
      if (line.starts_with('#') || line.find_first_not_of(" \t") == std::string::npos) continue;
      const std::size_t blank = line.find(' ');
      if (blank == std::string::npos || blank + 1 == line.size()) fail("says nothing after its first word");
      return line.substr(blank + 1);
    }
    if (stream_.bad()) failOnFile(file_, "cannot be read to its end");
    return std::nullopt;
  }

  /// The same where the file must not end.
  std::string need(const std::string& what) {
    if (auto value = next()) return *value;
    failOnFile(file_, "ends before " + what + " of a map");
  }

  [[noreturn]] void fail(const std::string& reason) const {
    failOnFile(file_, "line " + std::to_string(number_) + ": " + reason);
  }

 private:
  fs::path file_;
  std::ifstream stream_;
  std::size_t number_ = 0;
};

pose6d parsePose(const std::string& text, const Lines& lines) {
  std::istringstream s(text);
  s.imbue(std::locale::classic());
  float x, y, z;
  double roll, pitch, yaw;
  if (!(s >> x >> y >> z >> roll >> pitch >> yaw)) lines.fail("not a pose, six numbers: '" + text + "'");
  return {x, y, z, roll, pitch, yaw};
}

// --- writing ---

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string idInFile(const MapCollectionEntry& entry, std::size_t number) {
  std::string id = entry.id.empty() ? std::to_string(number) : entry.id;
  std::replace_if(id.begin(), id.end(), isControl, ' ');
  return id;
}

/// A name that no map has yet.
std::string fileName(const std::string& id, std::set<std::string>& taken) {
  std::string stem = "nodemap_" + id;
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return c == '/' || c == '\\'; }, '_');
  std::string name = stem + ".bt";
  for (int n = 2; !taken.insert(name).second; ++n) name = stem + "_" + std::to_string(n) + ".bt";
  return name;
}

std::string poseText(const pose6d& pose) {
  std::ostringstream s;
  s.imbue(std::locale::classic());
  s.precision(std::numeric_limits<float>::max_digits10);
  s << pose.x() << ' ' << pose.y() << ' ' << pose.z();
  s.precision(std::numeric_limits<double>::max_digits10);
  s << ' ' << pose.roll() << ' ' << pose.pitch() << ' ' << pose.yaw();
  return std::move(s).str();
}

bool isFinite(const pose6d& pose) {
  return std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.z()) && std::isfinite(pose.roll()) &&
         std::isfinite(pose.pitch()) && std::isfinite(pose.yaw());
}

/// A folder beside a file that goes away with all that is still in it.
class StagingFolder {
 public:
  explicit StagingFolder(const fs::path& beside) : path_(beside) {
    path_ += '.' + std::to_string(std::random_device()()) + ".tmp";
    std::error_code error;
    if (!fs::create_directory(path_, error))
      failOnFile(beside, "cannot be written: " + (error ? error.message() : "a temporary folder is in the way"));
  }
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;
  ~StagingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

std::vector<MapCollectionEntry> readMapCollectionFile(const fs::path& file) {
  Lines lines(file);
  std::vector<MapCollectionEntry> entries;
  while (auto id = lines.next()) {
    const std::string map_file = lines.need("the file name");
    const std::string pose = lines.need("the pose");
    entries.push_back({std::move(*id), file.parent_path() / map_file, parsePose(pose, lines)});
  }
  return entries;
}

void writeMapCollection(const fs::path& file, std::vector<MapCollectionEntry> entries,
                        const std::function<bool(std::size_t, const fs::path&)>& write_map) {
  if (!file.has_filename()) failOnFile(file, "names no file");
  std::set<std::string> taken;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].id = idInFile(entries[i], i);
    entries[i].map_file = fileName(entries[i].id, taken);
    if (!isFinite(entries[i].pose)) failOnFile(file, "cannot hold the pose of map '" + entries[i].id + "'");
  }
  // Before anything is replaced: the one reason not to be replaceable that is no accident.
  if (fs::is_directory(file)) failOnFile(file, "is a folder");
  for (const MapCollectionEntry& entry : entries)
    if (fs::is_directory(file.parent_path() / entry.map_file))
      failOnFile(file.parent_path() / entry.map_file, "is a folder");

  const StagingFolder staging(file);
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (!write_map(i, staging.path() / entries[i].map_file))
      failOnFile(file.parent_path() / entries[i].map_file, "cannot be written");
  writeFileWhole(staging.path() / "collection", [&](std::ostream& s) {
    s << "# A collection of maps, each with its pose: x y z [m] roll pitch yaw [rad]\n";
    for (const MapCollectionEntry& entry : entries)
      s << "MAPNODEID " << entry.id << "\nMAPNODEFILENAME " << entry.map_file.string() << "\nMAPNODEPOSE "
        << poseText(entry.pose) << "\n";
  });
  const auto move = [](const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) failOnFile(to, "cannot be replaced: " + error.message());
  };
  for (const MapCollectionEntry& entry : entries)
    move(staging.path() / entry.map_file, file.parent_path() / entry.map_file);
  move(staging.path() / "collection", file);
}

}  // namespace rhmap
