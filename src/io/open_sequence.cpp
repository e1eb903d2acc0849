// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>
#include <string>

#include "formats.hpp"
#include "rhmap/core/failure.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::io {

std::unique_ptr<ScanSequence> openSequence(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) failOnFile(path, "no such file or folder");
  if (std::filesystem::is_directory(path)) return openKitti(path);

  std::string kind = path.extension().string();
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (kind == ".graph") return openGraph(path);
  if (kind == ".log") return openLog(path);
  if (kind == ".dat" || kind == ".xyz") return openPointFile(path);
  failOnFile(
      path,
      "not a recording of a known kind; supported are a KITTI or SemanticKITTI folder (velodyne/*.bin, poses.txt) and "
      "files .graph, .log, .dat and .xyz");
}

}  // namespace rhmap::io
