// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rhmap/render/camera.hpp"
#include "rhmap/render/face_mesh.hpp"

namespace rhmap::render {

/// Draws the faces that are turned towards the camera into the current OpenGL context.
void drawFaces(const FaceMesh& mesh, const Camera& camera);

}  // namespace rhmap::render
