# SPDX-License-Identifier: BSD-3-Clause
# Builds project/ against stock OctoMap (WORLD is stock) or against rhmap in its place (package, subdirectory) and runs
# it. rhmap's output, printed and written, must be stock's.
set(work ${BUILD_DIR}/compat/${NAME})
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/out)

include(${CMAKE_CURRENT_LIST_DIR}/../run_command.cmake)

set(options -D WORLD=${WORLD})
if(WORLD STREQUAL "package")
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG} --prefix ${work}/prefix)
  list(APPEND options -D CMAKE_PREFIX_PATH=${work}/prefix -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
elseif(WORLD STREQUAL "subdirectory")
  # Debug: rhmap is compiled once more, so it had better be quick.
  list(APPEND options -D RHMAP_SOURCE_DIR=${SOURCE_DIR} -D CMAKE_BUILD_TYPE=Debug)
endif()
if(NOT WORLD STREQUAL "subdirectory")
  list(APPEND options -D CMAKE_BUILD_TYPE=Release)
endif()
if(STOCK_FIRST)
  file(COPY ${OCTOMAP_INCLUDE_DIR}/octomap DESTINATION ${work}/stock)
  list(APPEND options -D STOCK_FIRST=${work}/stock)
endif()

if(WORLD STREQUAL "package")
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${work}/no_component -G ${GENERATOR}
                          ${options} -D COMPONENT=colour -D CMAKE_CXX_COMPILER=${COMPILER}
                  RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
  if(status EQUAL 0 OR NOT errors MATCHES "rhmap has no component colour")
    message(FATAL_ERROR "asked for the component colour, which there is not (${status}):\n${errors}")
  endif()
endif()

set(warnings "-Wall -Wextra -Wpedantic")
if(WORLD STREQUAL "package" AND NOT STOCK_FIRST)
  string(APPEND warnings " -Werror")  # our headers give no cause for any
endif()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${work}/build -G ${GENERATOR} ${options}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} "-D CMAKE_CXX_FLAGS=${warnings}")
run(${CMAKE_COMMAND} --build ${work}/build --parallel 2)

set(compat)
if(NOT WORLD STREQUAL "stock")
  set(compat compat)
endif()
execute_process(COMMAND ${work}/build/user ${work}/out ${compat} RESULT_VARIABLE status
                OUTPUT_FILE ${work}/out/printed.txt ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "user failed (${status}):\n${errors}")
endif()
if(WORLD STREQUAL "stock")
  return()
endif()

file(GLOB expected RELATIVE ${BUILD_DIR}/compat/stock/out ${BUILD_DIR}/compat/stock/out/*)
list(LENGTH expected count)
if(count LESS 15)
  message(FATAL_ERROR "stock OctoMap wrote ${count} files only")
endif()
foreach(file IN LISTS expected)
  run(${CMAKE_COMMAND} -E compare_files ${BUILD_DIR}/compat/stock/out/${file} ${work}/out/${file})
endforeach()
