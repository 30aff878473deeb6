# The library, built by cargo and copied to <build>/lib under its versioned name.
# Cargo drops link-time optimisation when an rlib is among the crate types of one build,
# so the two shipped types are asked for by name.

find_program(FOOTPOINT_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin")
if(NOT FOOTPOINT_CARGO)
  message(FATAL_ERROR "cargo was not found: install Rust, or pass -DFOOTPOINT_CARGO=/path/to/cargo")
endif()
find_package(Threads REQUIRED)

# The SONAME that build.rs writes: 0.MINOR before 1.0, then MAJOR.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(FOOTPOINT_ABI 0.${PROJECT_VERSION_MINOR})
else()
  set(FOOTPOINT_ABI ${PROJECT_VERSION_MAJOR})
endif()

file(GLOB_RECURSE footpoint_rust_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/*.rs)
foreach(name Cargo.toml Cargo.lock build.rs cbindgen.toml include/footpoint.h)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${name})
    list(APPEND footpoint_rust_sources ${PROJECT_SOURCE_DIR}/${name})
  endif()
endforeach()

# footpoint_cargo(<directory> <features>): a rule that leaves libfootpoint.so.X.Y.Z, its two links
# and libfootpoint.a in <build>/<directory>. Each set of features has a cargo directory of its own,
# because cargo writes all of them under one file name.
function(footpoint_cargo directory features)
  set(out ${PROJECT_BINARY_DIR}/${directory})
  set(cargo_dir ${PROJECT_BINARY_DIR}/cargo-${directory})
  set(so libfootpoint.so.${PROJECT_VERSION})
  add_custom_command(
    OUTPUT ${out}/${so} ${out}/libfootpoint.a
    BYPRODUCTS ${out}/libfootpoint.so.${FOOTPOINT_ABI} ${out}/libfootpoint.so
    COMMAND ${FOOTPOINT_CARGO} rustc --release --locked --lib --crate-type cdylib,staticlib
            --features "${features}" --target-dir ${cargo_dir}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${out}
    COMMAND ${CMAKE_COMMAND} -E copy ${cargo_dir}/release/libfootpoint.so ${out}/${so}
    COMMAND ${CMAKE_COMMAND} -E copy ${cargo_dir}/release/libfootpoint.a ${out}/libfootpoint.a
    COMMAND ${CMAKE_COMMAND} -E create_symlink ${so} ${out}/libfootpoint.so.${FOOTPOINT_ABI}
    COMMAND ${CMAKE_COMMAND} -E create_symlink libfootpoint.so.${FOOTPOINT_ABI} ${out}/libfootpoint.so
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
    IMPORTED_LOCATION ${out}/libfootpoint.so.${PROJECT_VERSION}
    IMPORTED_SONAME libfootpoint.so.${FOOTPOINT_ABI}
    INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/include)
  add_library(${name}_a STATIC IMPORTED GLOBAL)
  set_target_properties(${name}_a PROPERTIES
    IMPORTED_LOCATION ${out}/libfootpoint.a
    INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_SOURCE_DIR}/include
    INTERFACE_LINK_LIBRARIES "Threads::Threads;${CMAKE_DL_LIBS};m;gcc_s;c")
  add_dependencies(${name}_so ${rule})
  add_dependencies(${name}_a ${rule})
endfunction()

footpoint_cargo(lib "")
add_custom_target(footpoint_library ALL DEPENDS ${PROJECT_BINARY_DIR}/lib/libfootpoint.so.${PROJECT_VERSION})
footpoint_imported(footpoint lib footpoint_library)
add_library(footpoint::footpoint ALIAS footpoint_so)
add_library(footpoint::static ALIAS footpoint_a)
