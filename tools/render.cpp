// SPDX-License-Identifier: BSD-3-Clause
// rhmap render: pictures of maps and clouds, without display or GPU.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <numbers>

#include "arguments.hpp"
#include "ground_cells.hpp"
#include "map_picture.hpp"
#include "progress_bar.hpp"
#include "rhmap/io/cloud_reader.hpp"
#include "sensor_path.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

struct RenderOptions {
  std::string input;
  std::string output;
  std::string colour;  ///< empty: the map's own colours if it has any, else height
  std::string after;
  std::string labels;
  std::string ground;
  std::string path;
  std::string frames;
  std::string view = "isometric";
  std::string title;
  std::string size = "1600x1000";
  std::vector<double> eye, target, box;  ///< empty, or 3, 3 and 6 numbers [m]
  double at = 0.5;
  double ceiling = kNoCeiling;  ///< [m]
  int turntable = 0;
  int drive = 0;
  bool free = false;
  bool bare = false;
};

constexpr std::array<std::string_view, 1> kPictures{".png"};
constexpr std::array<std::string_view, 5> kClouds{".pcd", ".ply", ".xyz", ".txt", ".dat"};
constexpr std::array<std::string_view, 3> kColours{"height", "occupancy", "own"};
constexpr std::array<std::string_view, 4> kViews{"isometric", "top", "orbit", "path"};

constexpr const char* kFooter =
    "IN is a map (.bt, .ot), drawn as lit cubes, or points (.pcd, .ply, .xyz, .txt, .dat). A turntable or a drive is "
    "a\n"
    "sequence of pictures, OUT-0000.png, OUT-0001.png ... With --after, cells that this other map does not have are\n"
    "`removed`; with --labels, which tell what moved, cells are `missed` and `lost` as well.\n"
    "Needs neither display nor GPU; the same input gives the same picture. The last examples want data/unpack.sh to\n"
    "have run.\n\n"
    "Examples:\n"
    "  rhmap render data/maps/geb079.bt map.png --size 640x400\n"
    "  rhmap render data/maps/geb079.bt top.png --view top --size 640x320 --ceiling 2.2 --title \"Building 079\"\n"
    "  rhmap render data/maps/geb079.bt near.png --eye 2,2,2 --target 10,0,0 --size 640x400\n"
    "  rhmap render data/maps/geb079.bt turn.png --turntable 3 --size 320x200\n"
    "  rhmap build build/data/kitti_raw_0005 street.bt --resolution 0.2 --max-range 50 --frames 0-4\n"
    "  rhmap render street.bt moved.png --labels build/data/kitti_raw_0005 --frames 0-4 --size 640x400\n"
    "  rhmap render street.bt drive.png --path build/data/kitti_raw_0005 --drive 3 --size 320x200";

/// Width and height of "1600x1000", or nothing.
std::optional<std::array<int, 2>> parseSize(const std::string& text) {
  const auto cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const auto parse = [&](std::size_t begin, std::size_t end) {
    int value = 0;
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    return error == std::errc() && stop == text.data() + end && value >= 1 && value <= render::kMaxPictureSide ? value
                                                                                                               : 0;
  };
  const std::array<int, 2> size{parse(0, cross), parse(cross + 1, text.size())};
  if (size[0] == 0 || size[1] == 0) return std::nullopt;
  return size;
}

CLI::Validator pictureSize() {
  return CLI::Validator(
      [](std::string& text) {
        return parseSize(text) ? std::string()
                               : fmt::format("{} is not a size; WIDTHxHEIGHT, each 1 to {}, e.g. 1600x1000", text,
                                             render::kMaxPictureSide);
      },
      "");
}

Eigen::Vector3d vectorOf(std::span<const double> numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// What is drawn and what is written beside it.
struct Subject {
  render::Scene scene;
  render::Caption caption;
};

void addCloud(const RenderOptions& options, Subject& subject) {
  render::PointSet cloud{.points = io::readCloud(options.input), .colours = {}};
  render::Box box;
  for (const octomap::point3d& p : cloud.points) box.extend(Eigen::Vector3d(p.x(), p.y(), p.z()));
  const render::Range range = box.isEmpty() ? render::Range{} : render::Range{box.min().z(), box.max().z()};
  for (const octomap::point3d& p : cloud.points) cloud.colours.push_back(render::rampColour(range.place(p.z())));
  subject.caption.ramps.push_back({"height", "m", range});
  subject.scene.clouds.push_back(std::move(cloud));
}

/// The cells that the labels say have moved.
KeySet readMovingCells(const RenderOptions& options, double resolution) {
  requireExists(options.labels);
  const auto sequence = io::openSequence(options.labels);
  const FrameRange frames = chooseFrames(options.frames, options.labels, sequence->size());
  ProgressBar bar("labels", frames.last - frames.first + 1);
  return movingCells(*sequence, {.first = frames.first, .last = frames.last}, resolution, [&bar] { bar.advance(); });
}

/// The cells that the scans of a sequence show to be ground.
KeySet readGround(const RenderOptions& options, double resolution) {
  requireExists(options.ground);
  const auto sequence = io::openSequence(options.ground);
  return groundCells(*sequence, chooseFrames(options.frames, options.ground, sequence->size()), resolution);
}

ColouredMap coloured(const RenderOptions& options, const AbstractOccupancyOcTree& map) {
  std::optional<KeySet> moving;
  if (!options.labels.empty()) moving = readMovingCells(options, map.getResolution());
  if (!options.after.empty()) {
    const LoadedMap after = loadMap(options.after);
    return colouredByDifference(map, *after.tree, moving ? &*moving : nullptr, options.ceiling);
  }
  if (!options.ground.empty()) return colouredByGround(map, readGround(options, map.getResolution()), options.ceiling);
  if (moving) return colouredByResidue(map, *moving, options.ceiling);
  if (options.colour == "occupancy") return colouredByOccupancy(map, options.ceiling);
  if (options.colour != "height")
    if (auto own = colouredByItself(map, options.ceiling)) return *std::move(own);
  if (options.colour == "own") throw std::runtime_error(options.input + ": a map without colours of its own");
  return colouredByHeight(map, options.ceiling);
}

void addMap(const RenderOptions& options, Subject& subject) {
  const LoadedMap map = loadMap(options.input);
  ColouredMap drawn = coloured(options, *map.tree);
  if (options.free) {
    subject.scene.glass.push_back(freeSpace(*map.tree));
    drawn.entries.push_back({render::kFreeSpace, "free space"});
  }
  subject.scene.solids.push_back(std::move(drawn.faces));
  subject.caption.entries = std::move(drawn.entries);
  subject.caption.ramps = std::move(drawn.ramps);
}

void addPath(const RenderOptions& options, Subject& subject) {
  requireExists(options.path);
  const auto sequence = io::openSequence(options.path);
  const FrameRange frames = chooseFrames(options.frames, options.path, sequence->size());
  subject.scene.trajectories.push_back({.points = sensorPath(*sequence, frames)});
  subject.caption.entries.push_back({render::kTrajectory, "path of the sensor"});
}

/// One camera a picture.
std::vector<render::Camera> camerasOf(const RenderOptions& options, const render::Scene& scene, double aspect) {
  const render::Box box = options.box.empty() ? boundsOf(scene)
                                              : render::Box(vectorOf(options.box),
                                                            vectorOf(std::span<const double>(options.box).subspan(3)));
  constexpr double kDegree = std::numbers::pi / 180;
  const auto orbit = [&](double turn) {
    return render::orbitView(box, (215 + 360 * turn) * kDegree, 32 * kDegree, aspect);
  };
  const auto along = [&](double t) { return render::alongPath(scene.trajectories.front().points, t); };
  std::vector<render::Camera> cameras;
  for (int i = 0; i < options.turntable; ++i) cameras.push_back(orbit(double(i) / options.turntable));
  for (int i = 0; i < options.drive; ++i) cameras.push_back(along(double(i) / std::max(options.drive - 1, 1)));
  if (!cameras.empty()) return cameras;
  if (!options.eye.empty()) return {render::lookAt(vectorOf(options.eye), vectorOf(options.target))};
  if (options.view == "path") return {along(options.at)};
  if (options.view == "top") return {render::topView(box, aspect)};
  if (options.view == "orbit") return {orbit(options.at)};
  return {render::isometricView(box, aspect)};
}

/// OUT-0007.png for OUT.png.
std::string frameName(const std::string& output, std::size_t i) {
  const std::filesystem::path path(output);
  return (path.parent_path() / fmt::format("{}-{:04}{}", path.stem().string(), i, path.extension().string())).string();
}

void checkTogether(const RenderOptions& options) {
  if (options.eye.empty() != options.target.empty()) throw UsageError("--eye and --target go together");
  if (options.turntable > 0 && options.drive > 0) throw UsageError("--turntable or --drive, not both");
  if ((options.drive > 0 || options.view == "path") && options.path.empty())
    throw UsageError("--path SEQUENCE is missing; it is what is driven along");
  if (!options.colour.empty() && !(options.after.empty() && options.labels.empty() && options.ground.empty()))
    throw UsageError("--colour does not go with --after, --labels and --ground, which have colours of their own");
  if (!options.box.empty() &&
      !(options.box[0] < options.box[3] && options.box[1] < options.box[4] && options.box[2] < options.box[5]))
    throw UsageError("--box: the first corner must be below the second in x, y and z");
}

void renderInput(const RenderOptions& options) {
  checkTogether(options);
  requireExists(options.input);
  const std::string extension = extensionOf(options.input);
  const bool is_cloud = std::find(kClouds.begin(), kClouds.end(), extension) != kClouds.end();
  if (is_cloud && (!options.after.empty() || !options.labels.empty() || !options.ground.empty() ||
                   !options.colour.empty() || options.free))
    throw UsageError("--after, --labels, --ground, --colour and --free are for maps; " + options.input + " is a cloud");

  Subject subject;
  subject.caption.title = options.title;
  is_cloud ? addCloud(options, subject) : addMap(options, subject);
  if (!options.path.empty()) addPath(options, subject);

  const auto [width, height] = *parseSize(options.size);
  const auto cameras = camerasOf(options, subject.scene, double(width) / height);
  const bool is_sequence = options.turntable > 0 || options.drive > 0;
  ProgressBar bar("drawing", cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    render::Image image = render::render(subject.scene, cameras[i], {.width = width, .height = height});
    if (!options.bare) drawCaption(image, cameras[i], subject.caption);
    writePng(is_sequence ? frameName(options.output, i) : options.output, image);
    bar.advance();
  }
}

CLI::Option* addNumbers(CLI::App& verb, const char* name, std::vector<double>& numbers, int count, const char* help) {
  return verb.add_option(name, numbers, help)->type_name("M,M,M")->delimiter(',')->expected(count);
}

}  // namespace

void addRender(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* verb = app.add_subcommand("render", "Draw a map or points as a PNG picture");
  verb->add_option("IN", options->input, "Map or cloud to draw")->required()->type_name("");
  verb->add_option("OUT", options->output, "File to write, .png")
      ->required()
      ->type_name("")
      ->check(outputFile(kPictures));
  verb->add_option("--colour", options->colour,
                   fmt::format("One of: {} (default: own, else height)", fmt::join(kColours, ", ")))
      ->type_name("NAME")
      ->check(oneOf("colouring", kColours));
  verb->add_option("--after", options->after, "Show what this cleaned map kept and removed")->type_name("MAP");
  verb->add_option("--labels", options->labels, "Show what is left of what moved, by this sequence's labels")
      ->type_name("SEQUENCE");
  verb->add_option("--ground", options->ground, "Tell the ground from the rest, by this sequence's scans")
      ->type_name("SEQUENCE")
      ->excludes("--labels", "--after");
  verb->add_option("--path", options->path, "Draw the path of this sequence's sensor")->type_name("SEQUENCE");
  addFrames(*verb, options->frames);
  verb->add_option("--ceiling", options->ceiling, "Leave out what is above this height (default: nothing)")
      ->type_name("M");
  verb->add_flag("--free", options->free, "Draw the free space, translucent");
  verb->add_option("--view", options->view, fmt::format("One of: {}", fmt::join(kViews, ", ")))
      ->type_name("NAME")
      ->capture_default_str()
      ->check(oneOf("view", kViews));
  verb->add_option("--at", options->at, "Where on the path or the orbit, 0 to 1")
      ->type_name("T")
      ->capture_default_str()
      ->check(CLI::Range(0., 1.));
  addNumbers(*verb, "--eye", options->eye, 3, "Look from here (with --target)");
  addNumbers(*verb, "--target", options->target, 3, "Look there (with --eye)");
  addNumbers(*verb, "--box", options->box, 6, "Fit this box, lower and upper corner, into the picture")
      ->type_name("M,M,M,M,M,M");
  verb->add_option("--turntable", options->turntable, "So many pictures around the map")
      ->type_name("N")
      ->check(countFrom1("pictures"));
  verb->add_option("--drive", options->drive, "So many pictures along the path")
      ->type_name("N")
      ->check(countFrom1("pictures"));
  verb->add_option("--size", options->size, "Pixels")->type_name("WxH")->capture_default_str()->check(pictureSize());
  verb->add_option("--title", options->title, "Line above the legend")->type_name("TEXT");
  verb->add_flag("--bare", options->bare, "No title, legend, scale bar or axes");
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { renderInput(*options); });
}

}  // namespace rhmap::tools
