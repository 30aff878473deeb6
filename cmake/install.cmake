# cmake --install: headers, shared library with its links, static library, pkg-config file.
include(GNUInstallDirs)

install(FILES
  ${PROJECT_BINARY_DIR}/lib/libfootpoint.so.${PROJECT_VERSION}
  ${PROJECT_BINARY_DIR}/lib/libfootpoint.so.${FOOTPOINT_ABI}
  ${PROJECT_BINARY_DIR}/lib/libfootpoint.so
  ${PROJECT_BINARY_DIR}/lib/libfootpoint.a
  DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "footpoint*")

# The file finds its prefix from its own place, so that an installed tree can be moved.
file(RELATIVE_PATH footpoint_pc_to_prefix
  "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" footpoint_pc_to_prefix "${footpoint_pc_to_prefix}")
configure_file(${PROJECT_SOURCE_DIR}/cmake/footpoint.pc.in ${PROJECT_BINARY_DIR}/footpoint.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/footpoint.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
