// SPDX-License-Identifier: BSD-3-Clause
// Stock OctoMap's keys, with rhmap's set of keys as octomap::KeySet. No #pragma once: core/key.hpp, on which the set
// stands, reads the first part only.
#pragma GCC system_header

#if defined(OCTOMAP_OCTREE_KEY_H) && !defined(RHMAP_COMPAT_KEYS)
#error "rhmap::compat: OcTreeKey.h of stock OctoMap was included before, so that octomap::KeySet has two meanings."
#endif
#define RHMAP_COMPAT_KEYS

#ifndef OCTOMAP_OCTREE_KEY_H
#include <cstddef>  // stock OcTreeKey.h uses these without including them
#include <cstdint>
#include <vector>

#define KeySet StockKeySet  // a typedef: octomap::StockKeySet is the name that stays
#include_next <octomap/OcTreeKey.h>
#undef KeySet
#endif

#if !defined(RHMAP_KEYS_ONLY) && !defined(RHMAP_COMPAT_KEY_SET)
#define RHMAP_COMPAT_KEY_SET
#include "rhmap/core/key_set.hpp"

namespace octomap {
using rhmap::KeySet;
}
#endif
