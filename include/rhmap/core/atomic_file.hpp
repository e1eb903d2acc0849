// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace rhmap {

/// Calls `write` with a binary stream (classic locale) and puts what it wrote in place of `file`, whole or not at all.
///
/// The bytes go to a temporary file beside the target that is renamed over it at the end, so readers, a full disk or an
/// exception never see or leave half a file, and an old file survives a failure. Throws std::runtime_error that names
/// file and reason; exceptions of `write` pass through.
void writeFileWhole(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace rhmap
