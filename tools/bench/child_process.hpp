// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <optional>

namespace rhmap::bench {

/// What `measure` returns, computed in a forked copy of this process: what it destroys stays as it was here. Nothing if
/// the copy fails. Not for a process with threads.
template <class F>
auto inChildProcess(F&& measure) -> std::optional<decltype(measure())> {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    const auto value = measure();
    _exit(write(ends[1], &value, sizeof value) == static_cast<ssize_t>(sizeof value) ? 0 : 1);
  }
  close(ends[1]);
  decltype(measure()) value{};
  const bool complete = child > 0 && read(ends[0], &value, sizeof value) == static_cast<ssize_t>(sizeof value);
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return complete ? std::optional(value) : std::nullopt;
}

}  // namespace rhmap::bench
