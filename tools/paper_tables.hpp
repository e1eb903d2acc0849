// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate_options.hpp"

namespace rhmap::tools {

/// The paper's Table I (PR, RR, F1 of front end only and of both) and Table II (time of a scan), with the published
/// figures beside, for the sequences of SemanticKITTI that are on disk.
void evaluateTables(const EvaluateOptions& options);

}  // namespace rhmap::tools
