// SPDX-License-Identifier: BSD-3-Clause
#include "font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <stdexcept>

#include "embedded.hpp"

namespace rhmap::render {
namespace {

void check(FT_Error error, const char* what) {
  if (error != 0) throw std::runtime_error("FreeType: " + std::string(what) + " failed");
}

/// The next character, taken from the front of the text.
FT_ULong takeCharacter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  FT_ULong character = length == 1 ? first : first & (0x7fU >> length);
  bool valid = length > 0 && length <= text.size();
  for (std::size_t i = 1; valid && i < length; ++i) {
    valid = byte(i) >> 6 == 2;
    character = character << 6 | (byte(i) & 0x3fU);
  }
  text.remove_prefix(valid ? length : 1);
  return valid ? character : 0xfffd;
}

}  // namespace

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
};

Font::Font() : face_(std::make_unique<Face>()) {
  const std::string_view bytes = embedded::font();
  check(FT_Init_FreeType(&face_->library), "starting");
  const auto* data = reinterpret_cast<const FT_Byte*>(bytes.data());
  if (const FT_Error error =
          FT_New_Memory_Face(face_->library, data, static_cast<FT_Long>(bytes.size()), 0, &face_->face)) {
    FT_Done_FreeType(face_->library);
    check(error, "reading the font");
  }
}

Font::~Font() {
  FT_Done_Face(face_->face);
  FT_Done_FreeType(face_->library);
}

TextMask Font::set(std::string_view text, int pixel_size) const {
  const FT_Face face = face_->face;
  check(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(pixel_size)), "setting a size");
  TextMask mask;
  mask.baseline = static_cast<int>(face->size->metrics.ascender >> 6);
  mask.height = mask.baseline - static_cast<int>(face->size->metrics.descender >> 6);

  std::vector<FT_ULong> characters;
  while (!text.empty()) characters.push_back(takeCharacter(text));
  const auto load = [face](FT_ULong character) {
    check(FT_Load_Char(face, character, FT_LOAD_RENDER | FT_LOAD_NO_HINTING), "drawing a character");
  };
  for (const FT_ULong character : characters) {
    load(character);
    mask.width += static_cast<int>(face->glyph->advance.x >> 6);
  }
  mask.coverage.assign(std::size_t(mask.width) * std::size_t(mask.height), 0);
  int pen = 0;
  for (const FT_ULong character : characters) {
    load(character);
    const FT_GlyphSlot glyph = face->glyph;
    for (int row = 0; row < static_cast<int>(glyph->bitmap.rows); ++row)
      for (int column = 0; column < static_cast<int>(glyph->bitmap.width); ++column) {
        const int x = pen + glyph->bitmap_left + column, y = mask.baseline - glyph->bitmap_top + row;
        if (x < 0 || x >= mask.width || y < 0 || y >= mask.height) continue;
        std::uint8_t& pixel = mask.coverage[std::size_t(y) * std::size_t(mask.width) + std::size_t(x)];
        pixel = std::max(pixel, glyph->bitmap.buffer[row * glyph->bitmap.pitch + column]);
      }
    pen += static_cast<int>(glyph->advance.x >> 6);
  }
  return mask;
}

}  // namespace rhmap::render
