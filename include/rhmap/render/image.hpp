// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rhmap/render/colour.hpp"

namespace rhmap::render {

/// A picture in memory: rows from the top, pixels from the left.
struct Image {
  Image() = default;
  Image(int w, int h, Colour fill) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), fill) {}

  Colour& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  const Colour& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }

  int width = 0;   ///< [pixels]
  int height = 0;  ///< [pixels]
  std::vector<Colour> pixels;
};

/// The bytes of a PNG file (8 bits a channel, RGB: pictures are opaque). The same for the same picture.
std::string encodePng(const Image& image);

/// Writes it as a PNG file, whole or not at all. Throws std::runtime_error that names file and reason.
void writePng(const std::filesystem::path& file, const Image& image);

/// Reads a PNG file. Throws std::runtime_error that names file and reason.
Image readPng(const std::filesystem::path& file);

}  // namespace rhmap::render
