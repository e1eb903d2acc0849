# SPDX-License-Identifier: BSD-3-Clause
# rhmap_find_three(): three.js and its controls for the 3D view of the report, in RHMAP_THREE and RHMAP_ORBIT_CONTROLS;
# an empty file in the place of both where they are not installed. The page then says what to install.
function(rhmap_find_three)
  find_path(RHMAP_THREE_DIR three.min.js PATH_SUFFIXES share/javascript/three share/nodejs/three/build
            PATHS /usr /usr/local)
  mark_as_advanced(RHMAP_THREE_DIR)
  set(controls ${RHMAP_THREE_DIR}/examples/js/controls/OrbitControls.js)
  if(RHMAP_THREE_DIR AND EXISTS ${controls})
    set(RHMAP_THREE ${RHMAP_THREE_DIR}/three.min.js PARENT_SCOPE)
    set(RHMAP_ORBIT_CONTROLS ${controls} PARENT_SCOPE)
  else()
    message(STATUS "rhmap: no 3D view in reports; it needs libjs-three")
    file(TOUCH ${CMAKE_CURRENT_BINARY_DIR}/no_three.js)
    set(RHMAP_THREE ${CMAKE_CURRENT_BINARY_DIR}/no_three.js PARENT_SCOPE)
    set(RHMAP_ORBIT_CONTROLS ${CMAKE_CURRENT_BINARY_DIR}/no_three.js PARENT_SCOPE)
  endif()
endfunction()
