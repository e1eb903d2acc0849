# SPDX-License-Identifier: BSD-3-Clause
# Builds project/ as a user would (WAY is package or subdirectory), runs it, and looks for flags of ours in its
# commands.
set(work ${BUILD_DIR}/consumer-${WAY})
file(REMOVE_RECURSE ${work})

include(${CMAKE_CURRENT_LIST_DIR}/../run_command.cmake)

if(WAY STREQUAL "package")
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG} --prefix ${work}/prefix)
  set(way_options -D CMAKE_PREFIX_PATH=${work}/prefix -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
else()
  # Debug: rhmap is compiled once more, so it had better be quick.
  set(way_options -D RHMAP_SOURCE_DIR=${SOURCE_DIR} -D CMAKE_BUILD_TYPE=Debug)
endif()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${work}/build -G ${GENERATOR} ${way_options}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -D CMAKE_CXX_FLAGS=
    -D CMAKE_EXPORT_COMPILE_COMMANDS=ON)
run(${CMAKE_COMMAND} --build ${work}/build --target consumer --parallel 2)
run(${work}/build/consumer ${work}/wall.bt)

# What rhmap is built with is its own affair: no warning, machine, floating-point, OpenMP or sanitizer flag gets out.
file(READ ${work}/build/compile_commands.json commands)
string(JSON count LENGTH "${commands}")
math(EXPR last "${count} - 1")
set(checked 0)
foreach(i RANGE ${last})
  string(JSON file GET "${commands}" ${i} file)
  if(file MATCHES "/project/main\\.cpp$")
    string(JSON command GET "${commands}" ${i} command)
    if(command MATCHES " (-W[^ ]*|-m[^ ]*|-f[^ ]*|-O[^ ]*|-DNDEBUG)( |$)")
      message(FATAL_ERROR "the flag ${CMAKE_MATCH_1} of rhmap reaches its user:\n${command}")
    endif()
    math(EXPR checked "${checked} + 1")
  endif()
endforeach()
if(NOT checked EQUAL 1)
  message(FATAL_ERROR "found ${checked} commands for main.cpp instead of one")
endif()

if(WAY STREQUAL "package" AND EXISTS ${work}/prefix/bin/rhmap)
  run(${work}/prefix/bin/rhmap info ${work}/wall.bt)
endif()
