// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace rhmap::render {

/// A line of text as coverage of pixels.
struct TextMask {
  int width = 0;
  int height = 0;
  int baseline = 0;                    ///< rows from the top
  std::vector<std::uint8_t> coverage;  ///< row by row, 255 is all of the pixel
};

/// DejaVu Sans, which is part of the library, in sizes of pixels.
class Font {
 public:
  Font();
  ~Font();

  /// Sets one line of UTF-8; bytes that are none show as the font's box.
  TextMask set(std::string_view text, int pixel_size) const;

 private:
  struct Face;
  std::unique_ptr<Face> face_;
};

}  // namespace rhmap::render
