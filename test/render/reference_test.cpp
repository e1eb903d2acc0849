// SPDX-License-Identifier: BSD-3-Clause
// A picture of a real map, held against one that was looked at and found right. After a change that is meant to be
// seen, look at what the test leaves in its message's file and put it in the place of the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "rhmap/octree/octree.hpp"
#include "rhmap/render/caption.hpp"
#include "rhmap/render/scene.hpp"

namespace rhmap::render {
namespace {

TEST(Reference, Building079LooksAsItDid) {
  OcTree tree(0.1);
  ASSERT_TRUE(tree.readBinary(RHMAP_DATA_DIR "/maps/geb079.bt"));
  const Range range = heightRange(tree, 2.2);
  const Scene scene{.solids = {occupiedFaces(tree, byHeight(range), 2.2)}};
  const Camera camera = orbitView(boundsOf(scene), 4, 0.7, 1.6);
  Image image = render(scene, camera, {.width = 240, .height = 150});
  drawCaption(image, camera, {.title = "Building 079", .ramps = {{"height", "m", range}}});

  const auto seen = std::filesystem::temp_directory_path() / "rhmap_render_reference.png";
  writePng(seen, image);
  const Image reference = readPng(RHMAP_REFERENCE_DIR "/building_079.png");
  ASSERT_EQ(reference.width, image.width);
  ASSERT_EQ(reference.height, image.height);
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Colour a = image.pixels[i], b = reference.pixels[i];
    sum += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  }
  // Rasterisers of other versions may settle pixels at edges differently.
  EXPECT_LT(sum / (3 * double(image.pixels.size())), 1.5) << "compare " << seen;
  if (!HasFailure()) std::filesystem::remove(seen);
}

}  // namespace
}  // namespace rhmap::render
