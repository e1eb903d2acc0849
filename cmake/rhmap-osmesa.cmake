# SPDX-License-Identifier: BSD-3-Clause
# OSMesa has no package file of CMake's; this target gives it a name. Used by our build and by our package file.
if(NOT TARGET rhmap::osmesa)
  find_path(RHMAP_OSMESA_INCLUDE_DIR GL/osmesa.h)
  find_library(RHMAP_OSMESA_LIBRARY OSMesa)
  mark_as_advanced(RHMAP_OSMESA_INCLUDE_DIR RHMAP_OSMESA_LIBRARY)
  if(RHMAP_OSMESA_INCLUDE_DIR AND RHMAP_OSMESA_LIBRARY)
    add_library(rhmap::osmesa INTERFACE IMPORTED)
    set_target_properties(rhmap::osmesa PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${RHMAP_OSMESA_INCLUDE_DIR}"
                                                   INTERFACE_LINK_LIBRARIES "${RHMAP_OSMESA_LIBRARY}")
  endif()
endif()
