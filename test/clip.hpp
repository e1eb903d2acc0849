// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace rhmap::test {

/// Where the build has put what data/unpack.sh unpacks.
inline std::filesystem::path unpackedData() { return RHMAP_UNPACKED_DIR; }
inline std::filesystem::path clipFolder() { return unpackedData() / "kitti_raw_0005"; }

}  // namespace rhmap::test
