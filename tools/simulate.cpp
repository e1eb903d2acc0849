// SPDX-License-Identifier: BSD-3-Clause
// rhmap simulate: a labelled recording of a made-up scene.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <set>

#include "arguments.hpp"
#include "progress_bar.hpp"
#include "rhmap/io/kitti_writer.hpp"
#include "rhmap/sim/scenes.hpp"
#include "rhmap/sim/simulation.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

struct SimulateOptions {
  sim::SimulationConfig config;
  std::string output;
  std::string beams = "64";
  std::string no_returns = "skip";
};

constexpr std::array<std::string_view, 4> kBeams{"16", "32", "64", "128"};
constexpr std::array<std::string_view, 2> kNoReturns{"skip", "zero"};

constexpr const char* kExplanation =
    "OUT becomes a folder in SemanticKITTI's layout: velodyne/*.bin, labels/*.label, poses.txt, times.txt, calib.txt; "
    "it\n"
    "has to be new or empty. Every point has the label of what its beam hit. A thing that moves at any time of the\n"
    "sequence has its moving class (252 car, 253 bicyclist, 254 person, 257 bus, 258 truck, 259 other) all the time, "
    "as\n"
    "in SemanticKITTI; one that could but does not, that of a thing at rest. --pose-noise shifts the poses that are\n"
    "written, not the points. The sensor stands still during a scan: there is no motion distortion. The same options\n"
    "give the same bytes.\n\n"
    "Examples:\n"
    "  rhmap simulate street street --beams 16 --frames 5\n"
    "  rhmap simulate parking lot --beams 32 --frames 3 --rate 2 --seed 7 --no-returns zero\n"
    "  rhmap simulate crowd noisy --beams 16 --frames 3 --range-noise 0.03 --drop-out 0.1 --pose-noise 0.05";

std::string footer() {
  std::string text = "SCENE is one of:\n";
  for (const sim::SceneInfo& scene : sim::scenes()) text += fmt::format("  {:<9}{}\n", scene.name, scene.what);
  return text + kExplanation;
}

std::vector<std::string_view> sceneNames() {
  std::vector<std::string_view> names;
  for (const sim::SceneInfo& scene : sim::scenes()) names.push_back(scene.name);
  return names;
}

/// What the configuration is checked for is known before anything is written.
sim::Simulation makeSimulation(const sim::SimulationConfig& config) {
  try {
    return sim::Simulation(config);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void simulate(const SimulateOptions& options) {
  sim::SimulationConfig config = options.config;
  config.lidar.beams = std::stoi(options.beams);
  config.lidar.no_returns = options.no_returns == "zero" ? sim::NoReturns::kZero : sim::NoReturns::kSkip;
  const sim::Simulation simulation = makeSimulation(config);
  io::KittiWriter writer(options.output);
  std::size_t points = 0, moving = 0;
  std::set<std::uint32_t> movers;
  ProgressBar bar("simulating", simulation.size());
  for (std::size_t k = 0; k < simulation.size(); ++k) {
    const sim::LidarScan scan = simulation.scan(k);
    writer.add(scan.points, scan.labels, simulation.toldPose(k), simulation.time(k));
    points += scan.points.size();
    for (const std::uint32_t label : scan.labels) {
      if (!sim::isMoving(label)) continue;
      ++moving;
      movers.insert(label);
    }
    bar.advance();
  }
  writer.finish();
  fmt::print("{} scans, {} points, {} of them on {} moving things\n", simulation.size(), points, moving, movers.size());
}

}  // namespace

void addSimulate(CLI::App& app) {
  static const std::vector<std::string_view> names = sceneNames();  // the validator keeps a view of them
  const auto options = std::make_shared<SimulateOptions>();
  sim::SimulationConfig& config = options->config;
  CLI::App* verb = app.add_subcommand("simulate", "Make a labelled LiDAR sequence of a made-up scene");
  verb->add_option("SCENE", config.scene, "What to scan")->required()->type_name("")->check(oneOf("scene", names));
  verb->add_option("OUT", options->output, "Folder to make")->required()->type_name("");
  verb->add_option("--beams", options->beams, "One of: 16, 32, 64, 128; 0.2 degrees from column to column")
      ->type_name("N")
      ->capture_default_str()
      ->check(oneOf("number of beams", kBeams));
  verb->add_option("--frames", config.frames, "Scans; the scene's duration is their limit")
      ->type_name("N")
      ->capture_default_str()
      ->check(countFrom1("frames"));
  verb->add_option("--rate", config.rate, "Scans a second")
      ->type_name("HZ")
      ->capture_default_str()
      ->check(rateAbove0());
  verb->add_option("--seed", config.seed, "Number that the scene's making and all noise hang on")
      ->type_name("S")
      ->capture_default_str()
      ->check(countFrom0("seed"));
  verb->add_option("--max-range", config.lidar.max_range, "Distance beyond which nothing returns")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthAbove0());
  verb->add_option("--range-noise", config.lidar.range_noise, "Standard deviation of a range")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthFrom0());
  verb->add_option("--drop-out", config.lidar.drop_out, "Probability that a return is lost")
      ->type_name("P")
      ->capture_default_str()
      ->check(probability());
  verb->add_option("--no-returns", options->no_returns, "Beams without a return: skip them, or write zero points")
      ->type_name("skip|zero")
      ->capture_default_str()
      ->check(oneOf("way with no-returns", kNoReturns));
  verb->add_option("--pose-noise", config.pose_noise, "Standard deviation of each coordinate of a written pose")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthFrom0());
  verb->group("Verbs");
  verb->footer(footer());
  verb->callback([options] { simulate(*options); });
}

}  // namespace rhmap::tools
