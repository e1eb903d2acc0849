// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The target rhmap::compat reads this file in front of every C++ source. A project's own include_directories() come
// before those of what it links, so that a folder which holds stock OctoMap among other things
// (/opt/ros/<distro>/include) can stand before ours. The right trees must not hang on that: ours are then read here,
// which leaves stock's headers empty.
#pragma GCC system_header
#include <octomap/octomap_deprecated.h>  // macros only; ours defines RHMAP_COMPAT_COMES_FIRST

#ifndef RHMAP_COMPAT_COMES_FIRST
#include "octomap/OcTreeKey.h"

#include "octomap/ColorOcTree.h"
#include "octomap/CountingOcTree.h"
#include "octomap/MapCollection.h"
#include "octomap/OcTreeStamped.h"
#include "octomap/octomap.h"
#endif
