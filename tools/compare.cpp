// SPDX-License-Identifier: BSD-3-Clause
// rhmap compare: rhmap and OctoMap on the same scans, and what the removal makes of them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "compare_options.hpp"
#include "removal_options.hpp"
#include "rhmap/core/atomic_file.hpp"
#include "text.hpp"
#include "verbs.hpp"

namespace rhmap::tools {
namespace {

struct CompareOptions {
  ComparisonOptions comparison;
  std::string json;
  std::string csv;
};

constexpr const char* kFooter =
    "rhmap and OctoMap take scan after scan in turns, each in a thread of its own; rays are cut at --max-range. "
    "Memory\n"
    "is what a map says of itself, resident memory what its end gives back. Where what they write is not the same to\n"
    "the byte, the cells that differ are counted.\n"
    "With --profile the removal of what moves is measured as well (processor time; points beyond --max-range are\n"
    "dropped), and on a sequence with labels what each map keeps of the static and of the moving cells and points:\n"
    "`octomap`, whose rays erase what they cross, `octomap, ground kept`, whose rays cannot erase the ground, and the\n"
    "profiles. The last example wants data/unpack.sh to have run.\n\n"
    "Examples:\n"
    "  rhmap compare data/maps/spherical_scan.graph --min-range 0\n"
    "  rhmap compare build/data/kitti_raw_0005 --frames 0-2 --resolution 0.2 --max-range 50 --profile default --csv "
    "scans.csv";

void compare(const CompareOptions& options) {
  eval::EvaluationConfig protocols;
  protocols.erasor.reset();
  protocols.kth.reset();
  const Comparison comparison = compareMappers(options.comparison, protocols);
  if (options.json != "-" && options.csv != "-") fmt::print("{}", toText(comparison));
  if (!options.json.empty()) writeJson(options.json, toJson(comparison));
  if (!options.csv.empty()) writeText(options.csv, toCsv(comparison));
}

}  // namespace

void addCompare(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* verb = app.add_subcommand("compare", "Measure rhmap and OctoMap on the same scans");
  addComparisonOptions(*verb, options->comparison);
  verb->add_option("--profile", options->comparison.profiles,
                   fmt::format("Removal to measure as well, any of: {}", profileNames()))
      ->type_name("NAMES")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(profileName());
  addJson(*verb, options->json, "all figures");
  verb->add_option("--csv", options->csv, "Write time and memory of each scan, - for stdout")
      ->type_name("FILE")
      ->check(outputFileOrStdout());
  verb->group("Verbs");
  verb->footer(kFooter);
  verb->callback([options] { compare(*options); });
}

}  // namespace rhmap::tools
