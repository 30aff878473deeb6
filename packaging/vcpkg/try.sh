#!/bin/sh
# try.sh: runs the port with stand-ins for vcpkg's functions (release only) for both linkages, and builds the consumer
# projects against what comes. For machines without vcpkg.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/port.cmake" <<'END'
function(vcpkg_cmake_configure)
  cmake_parse_arguments(arg "" "SOURCE_PATH" "OPTIONS" ${ARGN})
  execute_process(COMMAND cmake -S ${arg_SOURCE_PATH} -B ${WORK}/build -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR} -DCMAKE_INSTALL_LIBDIR=lib ${arg_OPTIONS} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(vcpkg_cmake_install)
  execute_process(COMMAND cmake --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND cmake --install ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
endfunction()
# vcpkg moves the package files to share/<port> and corrects the way from there to the prefix.
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(arg "" "CONFIG_PATH" "" ${ARGN})
  file(GLOB files ${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH}/*)
  file(COPY ${files} DESTINATION ${CURRENT_PACKAGES_DIR}/share/footpoint)
  file(READ ${CURRENT_PACKAGES_DIR}/share/footpoint/footpoint-config.cmake text)
  string(REPLACE "/../../../" "/../../" text "${text}")
  file(WRITE ${CURRENT_PACKAGES_DIR}/share/footpoint/footpoint-config.cmake "${text}")
  file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH})
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(arg "" "" "FILE_LIST" ${ARGN})
  file(COPY ${arg_FILE_LIST} DESTINATION ${CURRENT_PACKAGES_DIR}/share/footpoint)
endfunction()
include(${CURRENT_PORT_DIR}/portfile.cmake)
END
for linkage in dynamic static; do
    cmake -DWORK="$work/$linkage" -DCURRENT_PORT_DIR="$here/footpoint" -DCURRENT_PACKAGES_DIR="$work/$linkage/installed" \
        -DVCPKG_LIBRARY_LINKAGE=$linkage -P "$work/port.cmake" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    target=footpoint
    [ $linkage = dynamic ] || target=static
    mkdir "$work/$linkage/consumer"
    cp "$source/ctests/consumer/consumer.c" "$work/$linkage/consumer/"
    printf 'cmake_minimum_required(VERSION 3.18)\nproject(c LANGUAGES C)\nfind_package(footpoint 0.1 CONFIG REQUIRED)\nadd_executable(c consumer.c)\ntarget_link_libraries(c PRIVATE footpoint::%s m)\n' \
        $target >"$work/$linkage/consumer/CMakeLists.txt"
    cmake -S "$work/$linkage/consumer" -B "$work/$linkage/consumer/build" "-DCMAKE_PREFIX_PATH=$work/$linkage/installed" >"$work/log" 2>&1 \
        && cmake --build "$work/$linkage/consumer/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    "$work/$linkage/consumer/build/c"
    echo "$linkage: $(cd "$work/$linkage/installed/lib" && echo *)"
done
