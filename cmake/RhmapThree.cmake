# SPDX-License-Identifier: BSD-3-Clause
# rhmap_find_three(): three.js, its controls and its licence for the 3D view of the report, in RHMAP_THREE,
# RHMAP_ORBIT_CONTROLS and RHMAP_THREE_LICENCE; an empty file in the place of each where they are not installed. The page
# then says what to install.
function(rhmap_find_three)
  find_path(RHMAP_THREE_DIR three.min.js PATH_SUFFIXES share/javascript/three PATHS /usr /usr/local)
  mark_as_advanced(RHMAP_THREE_DIR)
  set(three ${RHMAP_THREE_DIR}/three.min.js)
  set(controls ${RHMAP_THREE_DIR}/examples/js/controls/OrbitControls.js)
  set(licence ${RHMAP_THREE_DIR}/../../doc/libjs-three/copyright)
  if(NOT EXISTS ${three} OR NOT EXISTS ${controls} OR NOT EXISTS ${licence})
    message(STATUS "rhmap: no 3D view in reports; it needs libjs-three")
    set(none ${CMAKE_CURRENT_BINARY_DIR}/no_three.js)
    file(TOUCH ${none})
    set(three ${none})
    set(controls ${none})
    set(licence ${none})
  endif()
  set(RHMAP_THREE ${three} PARENT_SCOPE)
  set(RHMAP_ORBIT_CONTROLS ${controls} PARENT_SCOPE)
  set(RHMAP_THREE_LICENCE ${licence} PARENT_SCOPE)
endfunction()
