// SPDX-License-Identifier: BSD-3-Clause
#include "compare_options.hpp"

#include "arguments.hpp"

namespace rhmap::tools {

void addComparisonOptions(CLI::App& verb, ComparisonOptions& options) {
  verb.add_option("SEQUENCE", options.sequence, "Scans with poses")->required()->type_name("");
  addResolution(verb, options.mapping.resolution, "Edge of the smallest cube");
  addMaxRange(verb, options.mapping.max_range, "Length at which rays are cut");
  addMinRange(verb, options.mapping.min_range);
  addFrames(verb, options.frames);
  verb.add_option("--threads", options.mapping.threads, "Threads of one insertion (rhmap; OctoMap has one)")
      ->type_name("N")
      ->capture_default_str()
      ->check(countFrom1("threads"));
}

}  // namespace rhmap::tools
