// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace rhmap::tools {

/// Text as it may stand in HTML, in attributes too.
std::string escapeHtml(std::string_view text);

/// Binary data as text.
std::string base64(std::string_view bytes);

/// The text with each {{name}} replaced by its value; std::logic_error for a name without one.
std::string fillIn(std::string_view text, const std::map<std::string, std::string>& values);

}  // namespace rhmap::tools
