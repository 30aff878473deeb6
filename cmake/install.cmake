# cmake --install: headers, shared library with its links, static library, pkg-config file, and the package that
# find_package(footpoint CONFIG) reads. Both files find the library from their own place: an installed tree can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(footpoint_files ${FOOTPOINT_STATIC} ${FOOTPOINT_IMPORT} ${FOOTPOINT_LINKS})
if(WIN32)
  install(FILES ${PROJECT_BINARY_DIR}/lib/${FOOTPOINT_SHARED} DESTINATION ${CMAKE_INSTALL_BINDIR})
  set(footpoint_shared_directory ${CMAKE_INSTALL_BINDIR})
else()
  list(PREPEND footpoint_files ${FOOTPOINT_SHARED})
  set(footpoint_shared_directory ${CMAKE_INSTALL_LIBDIR})
endif()
list(TRANSFORM footpoint_files PREPEND ${PROJECT_BINARY_DIR}/lib/)
install(FILES ${footpoint_files} DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "footpoint*")

file(RELATIVE_PATH footpoint_pc_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" footpoint_pc_to_prefix "${footpoint_pc_to_prefix}")
set(footpoint_private_libraries "-lpthread ${FOOTPOINT_STATIC_NEEDS}")
string(REGEX REPLACE ";+| +" " -l" footpoint_private_libraries "${footpoint_private_libraries}")
configure_file(${PROJECT_SOURCE_DIR}/cmake/footpoint.pc.in ${PROJECT_BINARY_DIR}/footpoint.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/footpoint.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(footpoint_package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/footpoint)
set(footpoint_library_directory ${CMAKE_INSTALL_LIBDIR})
set(footpoint_include_directory ${CMAKE_INSTALL_INCLUDEDIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/footpoint-config.cmake.in
  ${PROJECT_BINARY_DIR}/footpoint-config.cmake INSTALL_DESTINATION ${footpoint_package_directory}
  PATH_VARS footpoint_library_directory footpoint_shared_directory footpoint_include_directory)
# While the major version is 0 a new minor version may break callers.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(footpoint_compatible SameMinorVersion)
else()
  set(footpoint_compatible SameMajorVersion)
endif()
write_basic_package_version_file(${PROJECT_BINARY_DIR}/footpoint-config-version.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY ${footpoint_compatible})
install(FILES ${PROJECT_BINARY_DIR}/footpoint-config.cmake ${PROJECT_BINARY_DIR}/footpoint-config-version.cmake
  DESTINATION ${footpoint_package_directory})
