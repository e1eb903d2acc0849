# SPDX-License-Identifier: BSD-3-Clause
# How every target of rhmap is built: flags are private to ours, nothing leaks to consumers.

function(rhmap_private_flags target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # OctoMap's answers to the last bit: a fused multiply-add would round once where OctoMap rounds twice.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(PROJECT_IS_TOP_LEVEL)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion)
  endif()
  if(RHMAP_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${RHMAP_SANITIZE} -fno-omit-frame-pointer -g)
    target_link_options(${target} PUBLIC -fsanitize=${RHMAP_SANITIZE})
  endif()
endfunction()

# rhmap_library(<name> <source>...): library rhmap_<name> with the alias rhmap::<name>, installed as rhmap::<name>.
function(rhmap_library name)
  set(target rhmap_${name})
  if(name STREQUAL "rhmap")
    set(target rhmap)
  endif()
  add_library(${target} ${ARGN})
  add_library(rhmap::${name} ALIAS ${target})
  rhmap_private_flags(${target})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
                                             SOVERSION ${PROJECT_VERSION_MAJOR})
  set_property(GLOBAL APPEND PROPERTY RHMAP_LIBRARIES ${target})
endfunction()
