// SPDX-License-Identifier: BSD-3-Clause
#include "html.hpp"

#include <cstdint>
#include <stdexcept>

namespace rhmap::tools {

std::string escapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (int k = 0; k < 4; ++k) text += kDigits[word >> (18 - 6 * k) & 63U];
  }
  for (std::size_t k = bytes.size() % 3; k != 0 && k < 3; ++k) text[text.size() - (3 - k)] = '=';
  return text;
}

std::string fillIn(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string filled;
  for (;;) {
    const auto begin = text.find("{{"), end = text.find("}}", begin);
    if (end == std::string_view::npos) return filled.append(text);
    const std::string name(text.substr(begin + 2, end - begin - 2));
    const auto value = values.find(name);
    if (value == values.end()) throw std::logic_error("nothing to fill in for " + name);
    filled.append(text.substr(0, begin)).append(value->second);
    text.remove_prefix(end + 2);
  }
}

}  // namespace rhmap::tools
