// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "rhmap/core/failure.hpp"

namespace rhmap::io {

/// One line of a text file, read word by word; messages name file and line. Numbers do not depend on the locale.
class TextLine {
 public:
  /// `number` counts from 1; `file` and `text` must outlive the line.
  TextLine(const std::filesystem::path& file, std::size_t number, std::string_view text)
      : file_(file), number_(number), text_(text) {}

  std::size_t number() const { return number_; }
  std::string_view text() const { return text_; }

  /// The next word between blanks or tabs; empty at the end of the line.
  std::string_view word();

  /// The next word as a float, rounded once from its decimals; `what` names it in the message.
  float readFloat(const std::string& what);

  /// The next word as a double.
  double readDouble(const std::string& what);

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  template <typename T>
  T readNumber(const std::string& what);

  const std::filesystem::path& file_;
  std::size_t number_;
  std::string_view text_;
  std::size_t at_ = 0;
};

/// Calls visit(TextLine&) for each line, without its \n or \r\n; a last line without a line end counts.
template <typename Visit>
void forEachLine(const std::filesystem::path& file, Visit visit) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) failOnFile(file, "cannot be opened");
  std::string text;
  for (std::size_t number = 1; std::getline(stream, text); ++number) {
    if (text.ends_with('\r')) text.pop_back();
    TextLine line(file, number, text);
    visit(line);
  }
  if (stream.bad()) failOnFile(file, "cannot be read to its end");
}

}  // namespace rhmap::io
