// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "comparison.hpp"

namespace rhmap::tools {

// Parts of the report's page, as HTML.

/// A table a protocol and unit; a sentence where there is nothing to score against.
std::string scoreTables(const Comparison& comparison);

/// Times and memory, a row a mapper.
std::string measurementTable(const Comparison& comparison);

/// What was asked for, and every threshold of the removal that a user can give on the command line.
std::string settingsTable(const Comparison& comparison);

/// The commands that make the report and its figures again, as text.
std::string commandsOf(const Comparison& comparison);

}  // namespace rhmap::tools
