// SPDX-License-Identifier: BSD-3-Clause
#include "report_pictures.hpp"

#include <cmath>

#include "map_picture.hpp"
#include "progress_bar.hpp"

namespace rhmap::tools {
namespace {

constexpr int kWidth = 1200, kHeight = 750;
constexpr double kAspect = double(kWidth) / kHeight;

/// The surroundings of the path [m]: where the map is dense, and what the sensor has driven by.
render::Box aroundPath(const std::vector<Eigen::Vector3d>& path, double aside) {
  render::Box box;
  for (const Eigen::Vector3d& point : path) box.extend(point);
  return {box.min() - Eigen::Vector3d(aside, aside, 2.5), box.max() + Eigen::Vector3d(aside, aside, 2.5)};
}

/// From behind the drive, so that it goes away from the viewer, and above it.
render::Camera slantView(const std::vector<Eigen::Vector3d>& path) {
  const Eigen::Vector3d way = path.back() - path.front();
  const double azimuth = way.norm() > 1 ? std::atan2(-way.y(), -way.x()) : -2.4;
  return render::orbitView(aroundPath(path, 16), azimuth + 0.35, 0.6, kAspect);
}

ReportPicture draw(ColouredMap map, const std::vector<Eigen::Vector3d>& path, const render::Camera& camera,
                   std::string name, std::string title, std::string caption) {
  render::Scene scene;
  scene.solids.push_back(std::move(map.faces));
  scene.trajectories.push_back({.points = path});
  map.entries.push_back({render::kTrajectory, "path of the sensor"});
  render::Image image = render::render(scene, camera, {.width = kWidth, .height = kHeight});
  drawCaption(image, camera, {.title = std::move(title), .entries = map.entries, .ramps = map.ramps});
  return {std::move(name), std::move(caption), encodePng(image)};
}

}  // namespace

std::vector<ReportPicture> drawPictures(const ReportMaps& maps) {
  const auto coloured = [&](const OcTree& map) {
    return maps.has_labels ? colouredByResidue(map, maps.moving) : colouredByHeight(map);
  };
  const render::Camera slant = slantView(maps.path);
  const render::Camera top = render::topView(aroundPath(maps.path, 30), kAspect);
  std::vector<ReportPicture> pictures;
  ProgressBar bar("drawing", 4);
  const auto add = [&](ReportPicture picture) {
    pictures.push_back(std::move(picture));
    bar.advance();
  };
  add(draw(coloured(*maps.everything), maps.path, slant, "before", "Without removal",
           "Before: every cube that a scan has hit"));
  add(draw(coloured(*maps.octomap), maps.path, slant, "octomap", "OctoMap",
           "OctoMap: rays erase what they cross, much of the ground with it"));
  add(draw(coloured(*maps.cleaned), maps.path, slant, "after", "rhmap, what moved removed",
           "After: what the removal keeps"));
  add(draw(colouredByDifference(*maps.everything, *maps.cleaned, maps.has_labels ? &maps.moving : nullptr), maps.path,
           top, "difference", "What the removal changed", "From above: what was removed, and whether that was right"));
  return pictures;
}

}  // namespace rhmap::tools
