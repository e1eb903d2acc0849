// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/render/image.hpp"

#include <png.h>

#include <ostream>
#include <stdexcept>

#include "rhmap/core/atomic_file.hpp"
#include "rhmap/core/failure.hpp"

namespace rhmap::render {
namespace {

png_image describe(const Image& image, png_uint_32 format) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(image.width);
  description.height = static_cast<png_uint_32>(image.height);
  description.format = format;
  return description;
}

}  // namespace

std::string encodePng(const Image& image) {
  std::string rgb;
  rgb.reserve(3 * image.pixels.size());
  for (const Colour& pixel : image.pixels)
    for (const std::uint8_t channel : {pixel.r, pixel.g, pixel.b}) rgb.push_back(static_cast<char>(channel));

  png_image description = describe(image, PNG_FORMAT_RGB);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&description, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("PNG: ") + description.message);
  bytes.resize(size);
  return bytes;
}

void writePng(const std::filesystem::path& file, const Image& image) {
  const std::string bytes = encodePng(image);
  writeFileWhole(file, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

Image readPng(const std::filesystem::path& file) {
  png_image description{};
  description.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&description, file.c_str()) == 0) failOnFile(file, description.message);
  description.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(description.width), static_cast<int>(description.height), {});
  if (png_image_finish_read(&description, nullptr, image.pixels.data(), 0, nullptr) == 0)
    failOnFile(file, description.message);
  return image;
}

}  // namespace rhmap::render
