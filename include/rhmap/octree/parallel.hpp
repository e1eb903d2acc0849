// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace rhmap {

/// Does `work(context, part, thread)` for all parts, shared out to this number of threads; `thread` counts from 0. The
/// first exception of any of them comes back to the caller.
void doParts(std::size_t parts, std::size_t threads, void (*work)(void* context, std::size_t part, std::size_t thread),
             void* context);

/// The same with anything that can be called as work(part, thread).
template <class F>
void forEachPart(std::size_t parts, std::size_t threads, F&& work) {
  const auto call = [](void* context, std::size_t part, std::size_t thread) {
    (*static_cast<std::remove_reference_t<F>*>(context))(part, thread);
  };
  doParts(parts, threads, call, std::addressof(work));
}

}  // namespace rhmap
