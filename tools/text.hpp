// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rhmap::tools {

/// 1234567 as 1,234,567, whatever the locale.
std::string grouped(std::uint64_t number);

/// Bytes in the decimal unit that fits, e.g. 5.6 MB.
std::string byteSize(std::uint64_t bytes);

/// Writes text to a file, whole or not at all, or to stdout ("-").
void writeText(const std::string& path, const std::string& text);

/// Writes JSON to a file, whole or not at all, or to stdout ("-").
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

}  // namespace rhmap::tools
