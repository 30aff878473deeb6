# An overlay port: vcpkg install footpoint --overlay-ports=packaging/vcpkg. It builds the source tree that it lies in, with the
# cargo of the machine; a port outside of the tree sets SOURCE_PATH by vcpkg_from_github or vcpkg_extract_source_archive.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

# Both libraries are built by one call of cargo; the triplet says which one stays.
find_program(CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" "$ENV{USERPROFILE}/.cargo/bin" REQUIRED)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DFOOTPOINT_BUILD_TESTS=OFF -DFOOTPOINT_BUILD_EXAMPLES=OFF "-DFOOTPOINT_CARGO=${CARGO}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/footpoint)
vcpkg_fixup_pkgconfig()

if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
  file(GLOB unwanted "${CURRENT_PACKAGES_DIR}/lib/libfootpoint.so*" "${CURRENT_PACKAGES_DIR}/lib/libfootpoint*.dylib"
    "${CURRENT_PACKAGES_DIR}/lib/*.dll.*" "${CURRENT_PACKAGES_DIR}/debug/lib/libfootpoint.so*"
    "${CURRENT_PACKAGES_DIR}/debug/lib/libfootpoint*.dylib" "${CURRENT_PACKAGES_DIR}/debug/lib/*.dll.*"
    "${CURRENT_PACKAGES_DIR}/bin" "${CURRENT_PACKAGES_DIR}/debug/bin")
else()
  file(GLOB unwanted "${CURRENT_PACKAGES_DIR}/lib/libfootpoint.a" "${CURRENT_PACKAGES_DIR}/lib/footpoint.lib"
    "${CURRENT_PACKAGES_DIR}/debug/lib/libfootpoint.a" "${CURRENT_PACKAGES_DIR}/debug/lib/footpoint.lib")
endif()
if(unwanted)
  file(REMOVE_RECURSE ${unwanted})
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE-MIT" "${SOURCE_PATH}/LICENSE-APACHE")
