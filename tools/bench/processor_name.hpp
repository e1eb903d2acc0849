// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>
#include <string_view>

namespace rhmap::bench {

/// What the system calls its processor.
inline std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  constexpr std::string_view kField = "model name";
  for (std::string line; std::getline(info, line);)
    if (line.starts_with(kField)) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace rhmap::bench
