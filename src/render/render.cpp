// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>

#include "draw_faces.hpp"
#include "off_screen.hpp"
#include "rhmap/render/scene.hpp"

namespace rhmap::render {
namespace {

void validate(const PictureConfig& config) {
  const auto check = [](const char* field, int value, int max) {
    if (value < 1 || value > max)
      throw std::invalid_argument("PictureConfig::" + std::string(field) + " is " + std::to_string(value) +
                                  "; it must be 1 to " + std::to_string(max));
  };
  check("width", config.width, kMaxPictureSide);
  check("height", config.height, kMaxPictureSide);
  check("supersampling", config.supersampling, 4);
}

/// Distances along the line of sight [m].
struct DepthRange {
  double near = std::numeric_limits<double>::max();
  double far = std::numeric_limits<double>::lowest();
};

/// What holds all of the scene that is in front of the eye.
DepthRange depthRange(const Scene& scene, const Camera& camera) {
  const Box box = boundsOf(scene);
  const Eigen::Isometry3d view = viewOf(camera);
  DepthRange range;
  for (int i = 0; i < 8; ++i) {
    const double distance = -(view * box.corner(static_cast<Box::CornerType>(i))).z();
    range.near = std::min(range.near, distance);
    range.far = std::max(range.far, distance);
  }
  const double room = 1e-3 * (range.far - range.near) + 1e-3;
  range.far += room;
  if (camera.view_height) return {range.near - room, range.far};
  range.far = std::max(range.far, 1.);
  return {std::max(range.near - room, 5e-4 * range.far), range.far};
}

void setUp(const Scene& scene, const Camera& camera, const PictureConfig& config, const OffScreen& target) {
  glViewport(0, 0, target.width(), target.height());
  const Colour& back = config.background;
  glClearColor(float(back.r) / 255, float(back.g) / 255, float(back.b) / 255, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  const DepthRange depth = depthRange(scene, camera);
  const Eigen::Matrix4d clip = Projection(camera, config.width, config.height).clipMatrix(depth.near, depth.far);
  const Eigen::Matrix4d view = viewOf(camera).matrix();
  glMatrixMode(GL_PROJECTION);
  glLoadMatrixd(clip.data());
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixd(view.data());
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
}

void drawCloud(const PointSet& cloud, int supersampling) {
  if (cloud.points.empty()) return;
  if (cloud.colours.size() != 1 && cloud.colours.size() != cloud.points.size())
    throw std::invalid_argument("PointSet::colours has " + std::to_string(cloud.colours.size()) + " colours for " +
                                std::to_string(cloud.points.size()) + " points; one for all, or one a point");
  glPointSize(cloud.size * static_cast<float>(supersampling));
  glBegin(GL_POINTS);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Colour& colour = cloud.colours[cloud.colours.size() == 1 ? 0 : i];
    glColor4ub(colour.r, colour.g, colour.b, colour.a);
    glVertex3f(cloud.points[i].x(), cloud.points[i].y(), cloud.points[i].z());
  }
  glEnd();
}

void drawTrajectory(const Trajectory& trajectory, int supersampling) {
  glLineWidth(trajectory.width * static_cast<float>(supersampling));
  glColor4ub(trajectory.colour.r, trajectory.colour.g, trajectory.colour.b, trajectory.colour.a);
  glBegin(GL_LINE_STRIP);
  for (const Eigen::Vector3d& point : trajectory.points) glVertex3dv(point.data());
  glEnd();
}

/// Translucent faces change the colour of what is behind them and hide nothing.
void drawGlass(const std::vector<FaceMesh>& glass, const Camera& camera) {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (const FaceMesh& mesh : glass) drawFaces(mesh, camera);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

Image shrink(const std::vector<std::uint8_t>& rgba, const PictureConfig& config) {
  const int n = config.supersampling;
  const std::size_t row = std::size_t(config.width) * std::size_t(n) * 4;
  Image image(config.width, config.height, {});
  for (int y = 0; y < config.height; ++y)
    for (int x = 0; x < config.width; ++x) {
      std::array<int, 3> sum{};
      for (int dy = 0; dy < n; ++dy)
        for (int dx = 0; dx < n; ++dx)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += rgba[std::size_t(y * n + dy) * row + std::size_t(x * n + dx) * 4 + c];
      const auto mean = [n](int s) { return static_cast<std::uint8_t>((s + n * n / 2) / (n * n)); };
      image.at(x, y) = {mean(sum[0]), mean(sum[1]), mean(sum[2])};
    }
  return image;
}

}  // namespace

Box boundsOf(const Scene& scene) {
  Box box;
  for (const auto* meshes : {&scene.solids, &scene.glass})
    for (const FaceMesh& mesh : *meshes) box.extend(boundsOf(mesh));
  for (const PointSet& cloud : scene.clouds)
    for (const octomap::point3d& p : cloud.points) box.extend(Eigen::Vector3d(p.x(), p.y(), p.z()));
  for (const Trajectory& trajectory : scene.trajectories)
    for (const Eigen::Vector3d& point : trajectory.points) box.extend(point);
  return box.isEmpty() ? Box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()) : box;
}

Image render(const Scene& scene, const Camera& camera, const PictureConfig& config) {
  validate(config);
  OffScreen target(config.width * config.supersampling, config.height * config.supersampling);
  setUp(scene, camera, config, target);
  for (const FaceMesh& mesh : scene.solids) drawFaces(mesh, camera);
  glDisableClientState(GL_COLOR_ARRAY);  // what follows comes point by point
  for (const PointSet& cloud : scene.clouds) drawCloud(cloud, config.supersampling);
  for (const Trajectory& trajectory : scene.trajectories) drawTrajectory(trajectory, config.supersampling);
  glEnableClientState(GL_COLOR_ARRAY);
  drawGlass(scene.glass, camera);
  return shrink(target.finish(), config);
}

}  // namespace rhmap::render
