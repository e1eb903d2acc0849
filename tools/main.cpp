// SPDX-License-Identifier: BSD-3-Clause
// rhmap VERB ...: the verbs are in the files of their names. Exit codes: 0 done, 1 failed, 2 called wrongly.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "verbs.hpp"

namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  rhmap build data/maps/spherical_scan.graph map.bt\n"
    "  rhmap info data/maps/geb079.bt\n"
    "  rhmap convert data/maps/geb079.bt cells.ply\n"
    "  rhmap simulate crowd people --beams 16 --frames 3";

enum ExitCode { kDone = 0, kFailed = 1, kWrongUsage = 2 };

/// One line on stderr, whatever the message was made of.
int fail(ExitCode code, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  fmt::print(stderr, "rhmap: {}\n", message);
  return code;
}

/// CLI11 would call a verb that does not exist an argument that was not expected.
void checkVerb(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands(nullptr)) names.push_back(verb->get_name());
  const auto one_of = fmt::format("one of: {}", fmt::join(names, ", "));
  if (argc < 2) throw rhmap::tools::UsageError("a verb is missing; " + one_of);
  const std::string word = argv[1];
  if (!word.starts_with('-') && std::find(names.begin(), names.end(), word) == names.end())
    throw rhmap::tools::UsageError(word + " is not a verb; " + one_of);
}

/// A pipe or a disk that takes no more is a failure, too.
void flushStdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw std::runtime_error("standard output cannot be written");
}

int run(int argc, char** argv) {
  CLI::App app("Maps of occupied and free space from LiDAR scans, bit for bit like OctoMap's.", "rhmap");
  app.set_version_flag("--version", "rhmap " RHMAP_VERSION);
  app.require_subcommand(1);
  app.footer(kExamples);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  rhmap::tools::addBuild(app);
  rhmap::tools::addClean(app);
  rhmap::tools::addInfo(app);
  rhmap::tools::addCompare(app);
  rhmap::tools::addConvert(app);
  rhmap::tools::addEvaluate(app);
  rhmap::tools::addSimulate(app);
  rhmap::tools::addRender(app);
  rhmap::tools::addReport(app);
  try {
    checkVerb(app, argc, argv);
    app.parse(argc, argv);
    flushStdout();
    return kDone;
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    const auto verbs = app.get_subcommands();
    return fail(kWrongUsage, fmt::format("{}; see rhmap {}--help", error.what(),
                                         verbs.empty() ? "" : verbs.front()->get_name() + " "));
  } catch (const rhmap::tools::UsageError& error) {
    return fail(kWrongUsage, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return fail(kFailed, "out of memory");
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}
