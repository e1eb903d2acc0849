// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "rhmap/eval/score.hpp"

namespace rhmap::tools {

/// A table a protocol, the rows below each other; rates in per cent but F1, "-" where undefined.
std::string toTable(std::span<const eval::Score> scores);

/// An array of rows: counts and rates, these as fractions of 1 and null where undefined.
nlohmann::ordered_json toJson(std::span<const eval::Score> scores);

}  // namespace rhmap::tools
