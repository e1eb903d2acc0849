// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace rhmap {

/// Physical memory of this process [bytes], from /proc/self/statm; nothing where the system has no such file.
std::optional<std::size_t> residentMemory();

/// The physical memory [bytes] that comes back to the system when `destroy` runs.
///
/// Measures an object by destroying it: what malloc holds in reserve goes back before and after, and the difference of
/// the process's resident memory is the object with malloc's share, page by page, and without what is only scratch.
/// Growth while the object is built could not tell it from the scratch of its neighbours. Call it in the thread that
/// the object was built in; two maps that grew side by side are told apart when each has a Worker. For the end of a
/// measurement: from then on malloc gives back all that is freed, which costs time.
std::optional<std::size_t> releasedMemory(const std::function<void()>& destroy);

}  // namespace rhmap
