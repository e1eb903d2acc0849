# SPDX-License-Identifier: BSD-3-Clause
# OctoMap's package exports plain variables; this target gives them a name. Used by our build and by our package file.
if(NOT TARGET rhmap::octomap)
  add_library(rhmap::octomap INTERFACE IMPORTED)
  set_target_properties(rhmap::octomap PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${OCTOMAP_INCLUDE_DIRS}"
                                                  INTERFACE_LINK_LIBRARIES "${OCTOMAP_LIBRARIES}")
endif()
