// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "comparison.hpp"

namespace rhmap::tools {

/// What the verbs that compare have in common: the sequence, its frames, and how scans become maps.
void addComparisonOptions(CLI::App& verb, ComparisonOptions& options);

}  // namespace rhmap::tools
