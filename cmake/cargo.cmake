# The library, built by cargo and copied to <build>/lib under its versioned name.
# Cargo drops link-time optimisation when an rlib is among the crate types of one build,
# so the two shipped types are asked for by name.

find_program(FOOTPOINT_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" "$ENV{USERPROFILE}/.cargo/bin")
if(NOT FOOTPOINT_CARGO)
  message(FATAL_ERROR "cargo was not found: install Rust, or pass -DFOOTPOINT_CARGO=/path/to/cargo")
endif()
set(FOOTPOINT_CARGO_ARGUMENTS "" CACHE STRING "More arguments for cargo, for example --offline")
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)

# The SONAME that build.rs writes: 0.MINOR before 1.0, then MAJOR.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(FOOTPOINT_ABI 0.${PROJECT_VERSION_MINOR})
else()
  set(FOOTPOINT_ABI ${PROJECT_VERSION_MAJOR})
endif()

# What cargo calls the files (built), what they are called here (shared, its links, import library, static), and the
# system libraries that a program with the static library needs (cargo rustc -- --print native-static-libs).
set(FOOTPOINT_IMPORT "")
set(FOOTPOINT_LINKS "")
if(WIN32)
  set(FOOTPOINT_SHARED footpoint.dll)
  set(footpoint_built_shared footpoint.dll)
  if(MSVC)
    set(FOOTPOINT_IMPORT footpoint.dll.lib)
    set(FOOTPOINT_STATIC footpoint.lib)
  else()
    set(FOOTPOINT_IMPORT libfootpoint.dll.a)
    set(FOOTPOINT_STATIC libfootpoint.a)
  endif()
  set(FOOTPOINT_STATIC_NEEDS "kernel32;ntdll;userenv;ws2_32;dbghelp")
elseif(APPLE)
  set(FOOTPOINT_SHARED libfootpoint.${PROJECT_VERSION}.dylib)
  set(footpoint_built_shared libfootpoint.dylib)
  set(FOOTPOINT_LINKS libfootpoint.${FOOTPOINT_ABI}.dylib libfootpoint.dylib)
  set(FOOTPOINT_SONAME @rpath/libfootpoint.${FOOTPOINT_ABI}.dylib)
  set(FOOTPOINT_STATIC libfootpoint.a)
  set(FOOTPOINT_STATIC_NEEDS "m")
else()
  set(FOOTPOINT_SHARED libfootpoint.so.${PROJECT_VERSION})
  set(footpoint_built_shared libfootpoint.so)
  set(FOOTPOINT_LINKS libfootpoint.so.${FOOTPOINT_ABI} libfootpoint.so)
  set(FOOTPOINT_SONAME libfootpoint.so.${FOOTPOINT_ABI})
  set(FOOTPOINT_STATIC libfootpoint.a)
  set(FOOTPOINT_STATIC_NEEDS "gcc_s;m;c;${CMAKE_DL_LIBS}")
endif()

file(GLOB_RECURSE footpoint_rust_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/*.rs)
foreach(name Cargo.toml Cargo.lock build.rs cbindgen.toml include/footpoint.h)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${name})
    list(APPEND footpoint_rust_sources ${PROJECT_SOURCE_DIR}/${name})
  endif()
endforeach()

# footpoint_cargo(<directory> <features>): a rule that leaves the shared library, its links and the static library in
# <build>/<directory>. Each set of features has a cargo directory of its own, because cargo writes all of them under
# one file name. What follows the two are settings of cargo, for a library that is not shipped.
function(footpoint_cargo directory features)
  set(out ${PROJECT_BINARY_DIR}/${directory})
  set(built ${PROJECT_BINARY_DIR}/cargo-${directory}/release)
  set(commands "")
  set(files ${FOOTPOINT_STATIC} ${FOOTPOINT_IMPORT})
  foreach(name ${files})
    list(APPEND commands COMMAND ${CMAKE_COMMAND} -E copy ${built}/${name} ${out}/${name})
  endforeach()
  list(TRANSFORM files PREPEND ${out}/)
  set(target ${FOOTPOINT_SHARED})
  foreach(link ${FOOTPOINT_LINKS})
    list(APPEND commands COMMAND ${CMAKE_COMMAND} -E create_symlink ${target} ${out}/${link})
    set(target ${link})
  endforeach()
  set(links ${FOOTPOINT_LINKS})
  list(TRANSFORM links PREPEND ${out}/)
  separate_arguments(more NATIVE_COMMAND "${FOOTPOINT_CARGO_ARGUMENTS}")
  add_custom_command(
    OUTPUT ${out}/${FOOTPOINT_SHARED} ${files}
    BYPRODUCTS ${links}
    COMMAND ${FOOTPOINT_CARGO} rustc --release --locked ${more} --lib --crate-type cdylib,staticlib
            --features "${features}" --target-dir ${PROJECT_BINARY_DIR}/cargo-${directory} ${ARGN}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${out}
    COMMAND ${CMAKE_COMMAND} -E copy ${built}/${footpoint_built_shared} ${out}/${FOOTPOINT_SHARED}
    ${commands}
    DEPENDS ${footpoint_rust_sources}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    COMMENT "cargo: libfootpoint ${PROJECT_VERSION} in ${directory}/"
    USES_TERMINAL VERBATIM)
endfunction()

# footpoint_imported(<name> <directory> <rule>): <name>_so and <name>_a for the files of one rule.
function(footpoint_imported name directory rule)
  set(out ${PROJECT_BINARY_DIR}/${directory})
  add_library(${name}_so SHARED IMPORTED GLOBAL)
  set_target_properties(${name}_so PROPERTIES
    IMPORTED_LOCATION ${out}/${FOOTPOINT_SHARED}
    INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/include)
  if(FOOTPOINT_IMPORT)
    set_target_properties(${name}_so PROPERTIES IMPORTED_IMPLIB ${out}/${FOOTPOINT_IMPORT})
  else()
    set_target_properties(${name}_so PROPERTIES IMPORTED_SONAME ${FOOTPOINT_SONAME})
  endif()
  add_library(${name}_a STATIC IMPORTED GLOBAL)
  set_target_properties(${name}_a PROPERTIES
    IMPORTED_LOCATION ${out}/${FOOTPOINT_STATIC}
    INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/include
    INTERFACE_LINK_LIBRARIES "Threads::Threads;${FOOTPOINT_STATIC_NEEDS}")
  add_dependencies(${name}_so ${rule})
  add_dependencies(${name}_a ${rule})
endfunction()

footpoint_cargo(lib "")
add_custom_target(footpoint_library ALL DEPENDS ${PROJECT_BINARY_DIR}/lib/${FOOTPOINT_SHARED})
footpoint_imported(footpoint lib footpoint_library)
add_library(footpoint::footpoint ALIAS footpoint_so)
add_library(footpoint::static ALIAS footpoint_a)
