// SPDX-License-Identifier: BSD-3-Clause
#include "draw_faces.hpp"

#include <GL/gl.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rhmap::render {
namespace {

/// Light that falls on each side, x-, x+, y-, y+, z-, z+: from above, a little from the left, so that edges show.
constexpr std::array<double, 6> kSideLight{0.86, 0.74, 0.80, 0.68, 0.5, 1.0};

/// What is left of it in corners, from nooks to open ones.
constexpr std::array<double, 4> kCornerLight{0.58, 0.74, 0.88, 1.0};

struct Vertex {
  std::array<float, 3> position;
  Colour colour;
};

constexpr std::size_t kBatch = 4 * 16384;  ///< vertices that are handed over at once

/// Whether the eye is in front of the plane in which the face lies.
bool facesCamera(const Face& face, const FaceMesh& mesh, const Camera& camera) {
  const unsigned axis = face.side / 2;
  const bool larger = face.side % 2 == 1;
  if (camera.view_height) {  // parallel rays
    const double back = camera.eye[axis] - camera.target[axis];
    return larger ? back > 0 : back < 0;
  }
  const int cell = int(face.corner[axis]) + (larger ? 1 << face.edge_log2 : 0) - int(kTreeMaxVal);
  const double plane = mesh.resolution * cell;
  return larger ? camera.eye[axis] > plane : camera.eye[axis] < plane;
}

Colour lit(Colour colour, double light) {
  const auto shade = [light](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(light * c)); };
  return {shade(colour.r), shade(colour.g), shade(colour.b), colour.a};
}

void appendVertices(const Face& face, double resolution, std::vector<Vertex>& vertices) {
  const unsigned axis = face.side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int width = 1 << face.edge_log2;
  const auto light = [&](unsigned corner) { return unsigned{face.corner_light} >> 2 * corner & 3U; };
  // A quad is drawn as two triangles; the dark corners have to lie across from each other for it to look smooth.
  const unsigned start = light(0) + light(2) < light(1) + light(3) ? 1 : 0;
  for (unsigned i = start; i < start + 4; ++i) {
    std::array<int, 3> cell{face.corner[0], face.corner[1], face.corner[2]};
    cell[axis] += face.side % 2 == 1 ? width : 0;
    cell[u] += kCornerSteps[i % 4][0] * width;
    cell[v] += kCornerSteps[i % 4][1] * width;
    Vertex& vertex = vertices.emplace_back();
    for (unsigned a = 0; a < 3; ++a) vertex.position[a] = static_cast<float>(resolution * (cell[a] - int(kTreeMaxVal)));
    vertex.colour = lit(face.colour, kSideLight[face.side] * kCornerLight[light(i % 4)]);
  }
}

void handOver(std::vector<Vertex>& vertices) {
  if (vertices.empty()) return;
  glVertexPointer(3, GL_FLOAT, sizeof(Vertex), vertices.front().position.data());
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), &vertices.front().colour);
  glDrawArrays(GL_QUADS, 0, static_cast<GLsizei>(vertices.size()));
  vertices.clear();
}

}  // namespace

void drawFaces(const FaceMesh& mesh, const Camera& camera) {
  std::vector<Vertex> vertices;
  vertices.reserve(kBatch + 4);
  for (const Face& face : mesh.faces) {
    if (!facesCamera(face, mesh, camera)) continue;
    appendVertices(face, mesh.resolution, vertices);
    if (vertices.size() >= kBatch) handOver(vertices);
  }
  handOver(vertices);
}

}  // namespace rhmap::render
