// SPDX-License-Identifier: BSD-3-Clause
// The verbs that draw, in a program that was built where there was nothing to draw with.
#include <CLI/CLI.hpp>
#include <stdexcept>

#include "verbs.hpp"

namespace rhmap::tools {
namespace {

void addMissing(CLI::App& app, const char* name, const char* what) {
  CLI::App* verb = app.add_subcommand(name, what);
  verb->allow_extras();
  verb->group("Verbs");
  verb->footer("This program was built without pictures.");
  verb->callback([] {
    throw std::runtime_error(
        "this program was built without pictures; install libosmesa6-dev, libpng-dev, libfreetype-dev and "
        "fonts-dejavu-core, then configure and build it again");
  });
}

}  // namespace

void addReport(CLI::App& app) {
  addMissing(app, "report", "Make a page that shows maps, scores and times (not built)");
}

void addRender(CLI::App& app) { addMissing(app, "render", "Draw a map or points as a PNG picture (not built)"); }

}  // namespace rhmap::tools
