// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapper_rows.hpp"
#include "removal_options.hpp"

namespace rhmap::tools {

/// The rows of `rhmap evaluate --ablation`: the paper's own ablations, what brings its profile step by step to ours,
/// and the default profile without one part at a time.
std::vector<MapperRow> ablationRows(const RemovalOptions& options);

}  // namespace rhmap::tools
