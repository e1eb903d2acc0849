// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A source file sees the trees of one world only, OctoMap's own or ours under OctoMap's names. Every tree header of
// ours includes this one first.

#if __cplusplus < 202002L
#error "rhmap::compat: this needs C++20, which targets get that are linked with rhmap::compat (OCTOMAP_LIBRARIES)."
#endif

#if defined(OCTOMAP_ABSTRACT_OCTREE_H) || defined(OCTOMAP_ABSTRACT_OCCUPANCY_OCTREE_H) ||                           \
    defined(OCTOMAP_COLOR_OCTREE_H) || defined(OCTOMAP_COUNTING_OCTREE_HH) || defined(OCTOMAP_MAP_COLLECTION_H) ||  \
    defined(OCTOMAP_MAP_NODE_H) || defined(OCTOMAP_OCCUPANCY_OCTREE_BASE_H) || defined(OCTOMAP_OCTREE_BASE_H) ||    \
    defined(OCTOMAP_OCTREE_BASE_IMPL_H) || defined(OCTOMAP_OCTREE_DATA_NODE_H) || defined(OCTOMAP_OCTREE_NODE_H) || \
    defined(OCTOMAP_OCTREE_H) || defined(OCTOMAP_OCTREE_STAMPED_H)
#error \
    "rhmap::compat: a tree header of stock OctoMap was included before. One source file cannot have both octomap::OcTree."
#endif

/// octomap::OcTree and its kin are rhmap's in this source file.
#define RHMAP_COMPAT_OCTOMAP

// Stock OctoMap's include guards: should one of its tree headers still be found later on, by a path of its own, then it
// is empty, and octomap::OcTree keeps its one meaning.
#define OCTOMAP_ABSTRACT_OCTREE_H
#define OCTOMAP_ABSTRACT_OCCUPANCY_OCTREE_H
#define OCTOMAP_COLOR_OCTREE_H
#define OCTOMAP_COUNTING_OCTREE_HH
#define OCTOMAP_MAP_COLLECTION_H
#define OCTOMAP_MAP_NODE_H
#define OCTOMAP_OCCUPANCY_OCTREE_BASE_H
#define OCTOMAP_OCTREE_BASE_H
#define OCTOMAP_OCTREE_BASE_IMPL_H
#define OCTOMAP_OCTREE_DATA_NODE_H
#define OCTOMAP_OCTREE_NODE_H
#define OCTOMAP_OCTREE_H
#define OCTOMAP_OCTREE_STAMPED_H
