# SPDX-License-Identifier: BSD-3-Clause
# cmake --install: libraries, headers and the package that find_package(rhmap) finds.
include(CMakePackageConfigHelpers)

set(RHMAP_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/rhmap)
get_property(RHMAP_INSTALLED_LIBRARIES GLOBAL PROPERTY RHMAP_LIBRARIES)

install(TARGETS ${RHMAP_INSTALLED_LIBRARIES} EXPORT rhmapTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/rhmap DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(EXPORT rhmapTargets NAMESPACE rhmap:: DESTINATION ${RHMAP_PACKAGE_DIR})

if(TARGET rhmap::render)
  set(RHMAP_HAS_RENDER ON)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rhmapConfig.cmake.in ${PROJECT_BINARY_DIR}/rhmapConfig.cmake
                              INSTALL_DESTINATION ${RHMAP_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rhmapConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rhmapConfig.cmake ${PROJECT_BINARY_DIR}/rhmapConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/rhmap-octomap.cmake ${CMAKE_CURRENT_LIST_DIR}/rhmap-osmesa.cmake
        DESTINATION ${RHMAP_PACKAGE_DIR})
