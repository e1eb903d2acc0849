// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace rhmap::tools {

/// Each adds one verb to the program: its options, its help and what it does when it is called.
void addBuild(CLI::App& app);
void addClean(CLI::App& app);
void addInfo(CLI::App& app);
void addCompare(CLI::App& app);
void addConvert(CLI::App& app);
void addEvaluate(CLI::App& app);
void addReport(CLI::App& app);
void addSimulate(CLI::App& app);
void addRender(CLI::App& app);

}  // namespace rhmap::tools
