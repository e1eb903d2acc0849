// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <GL/osmesa.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace rhmap::render {

/// An OpenGL context of the calling thread that draws into memory.
class OffScreen {
 public:
  OffScreen(int width, int height) : width_(width), height_(height), context_(create(), OSMesaDestroyContext) {
    pixels_.resize(std::size_t(width) * std::size_t(height) * 4);
    if (!context_ || OSMesaMakeCurrent(context_.get(), pixels_.data(), GL_UNSIGNED_BYTE, width, height) != GL_TRUE)
      throw std::runtime_error("OSMesa gives no picture of " + std::to_string(width) + " x " + std::to_string(height));
    OSMesaPixelStore(OSMESA_Y_UP, 0);  // rows from the top, as pictures have them
  }

  /// RGBA, when all that was drawn is there.
  const std::vector<std::uint8_t>& finish() {
    glFinish();
    return pixels_;
  }

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  static OSMesaContext create() { return OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr); }

  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
  std::unique_ptr<osmesa_context, decltype(&OSMesaDestroyContext)> context_;
};

}  // namespace rhmap::render
