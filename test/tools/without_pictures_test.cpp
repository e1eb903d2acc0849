// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "verbs.hpp"

namespace rhmap::tools {
namespace {

TEST(WithoutPictures, TheVerbSaysWhatToInstall) {
  CLI::App app;
  addRender(app);
  try {
    app.parse("render map.bt map.png --size 640x400", false);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    for (const char* package : {"libosmesa6-dev", "libpng-dev", "libfreetype-dev", "fonts-dejavu-core"})
      EXPECT_THAT(error.what(), testing::HasSubstr(package));
  }
}

}  // namespace
}  // namespace rhmap::tools
