// SPDX-License-Identifier: BSD-3-Clause
#include "text_line.hpp"

#include <algorithm>
#include <charconv>
#include <locale>
#include <sstream>
#include <system_error>

namespace rhmap::io {

std::string_view TextLine::word() {
  constexpr std::string_view kBlanks = " \t\r\v\f";
  const std::size_t begin = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
  at_ = std::min(text_.find_first_of(kBlanks, begin), text_.size());
  return text_.substr(begin, at_ - begin);
}

float TextLine::readFloat(const std::string& what) { return readNumber<float>(what); }

double TextLine::readDouble(const std::string& what) { return readNumber<double>(what); }

void TextLine::fail(const std::string& reason) const {
  failOnFile(file_, "line " + std::to_string(number_) + ": " + reason);
}

template <typename T>
T TextLine::readNumber(const std::string& what) {
  const std::string_view given = word();
  if (given.empty()) fail(what + " is missing");
  std::string_view digits = given;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);  // from_chars wants none
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Too large, or merely too close to zero: a stream tells them apart, and it is what OctoMap reads with.
    std::istringstream stream{std::string(digits)};
    stream.imbue(std::locale::classic());
    if (!(stream >> value)) fail(what + " is out of range: '" + std::string(given) + "'");
    return value;
  }
  if (error != std::errc() || end != digits.data() + digits.size()) {
    fail(what + " is not a number: '" + std::string(given) + "'");
  }
  return value;
}

}  // namespace rhmap::io
