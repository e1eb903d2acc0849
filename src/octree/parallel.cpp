// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/parallel.hpp"

#include <omp.h>

#include <exception>

namespace rhmap {

void doParts(std::size_t parts, std::size_t threads, void (*work)(void* context, std::size_t part, std::size_t thread),
             void* context) {
  if (threads <= 1) {
    for (std::size_t part = 0; part < parts; ++part) work(context, part, 0);
    return;
  }
  std::exception_ptr error;
#pragma omp parallel for num_threads(static_cast <int>(threads)) schedule(dynamic, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    try {
      work(context, part, static_cast<std::size_t>(omp_get_thread_num()));
    } catch (...) {
#pragma omp critical(rhmap_parts)
      error = std::current_exception();
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace rhmap
