// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#pragma GCC system_header

/// <octomap/...> finds the headers of rhmap::compat before those of stock OctoMap: see include_order.h.
#define RHMAP_COMPAT_COMES_FIRST

#include_next <octomap/octomap_deprecated.h>
