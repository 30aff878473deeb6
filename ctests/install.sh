#!/bin/sh
# install.sh CMAKE CTEST CC CXX BUILD LIBRARY_DIRECTORY SOURCE
# Installs into an empty folder, moves that, and builds and runs the projects in ctests/consumer against what is there:
# C99 and C++17, shared and static, by pkg-config, by find_package, and by add_subdirectory from the source.
set -eu
cmake=$1 ctest=$2 cc=$3 cxx=$4 build=$5 libdir=$6 source=$7
consumer=$source/ctests/consumer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# quiet COMMAND...: its output only when it fails.
quiet() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

quiet "$cmake" --install "$build" --prefix "$work/first"
mv "$work/first" "$work/moved"
prefix=$work/moved
for header in "$source"/include/*; do ls "$prefix/include/${header##*/}" >/dev/null; done
# No file of the installed tree may name the tree that it came from.
if grep -rIl -e "$build" -e "$source" -e "$work/first" "$prefix"; then echo "the files above name the build's folders"; exit 1; fi

export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig"
if pkg-config --version >/dev/null 2>&1; then
    for language in c cpp; do
        compile="$cc -std=c99"
        [ $language = c ] || compile="$cxx -std=c++17"
        quiet $compile "$consumer/consumer.$language" -o "$work/shared" $(pkg-config --cflags --libs footpoint) -lm \
            "-Wl,-rpath,$prefix/$libdir"
        "$work/shared"
        quiet $compile "$consumer/consumer.$language" -o "$work/static" $(pkg-config --cflags footpoint) \
            $(pkg-config --static --libs footpoint | sed "s|-lfootpoint|$prefix/$libdir/libfootpoint.a|")
        env -u LD_LIBRARY_PATH "$work/static"
    done
    echo "pkg-config: C99 and C++17, shared and static"
else
    echo "left out: the consumers by pkg-config (apt-get install pkg-config)"
fi

# project NAME ARGUMENTS...: configures, builds and runs ctests/consumer.
project() {
    name=$1
    shift
    quiet "$cmake" -S "$consumer" -B "$work/$name" "-DCMAKE_C_COMPILER=$cc" "-DCMAKE_CXX_COMPILER=$cxx" "$@"
    quiet "$cmake" --build "$work/$name"
    (cd "$work/$name" && quiet "$ctest" --output-on-failure)
    echo "$name: C99 and C++17, shared and static"
}
project find_package "-DCMAKE_PREFIX_PATH=$prefix"
# Cargo has compiled these sources already: with its folder at hand the second build only copies.
mkdir -p "$work/add_subdirectory/footpoint"
ln -s "$build/cargo-lib" "$work/add_subdirectory/footpoint/cargo-lib"
project add_subdirectory "-DFOOTPOINT_SOURCE=$source" "-DFOOTPOINT_CARGO=$(command -v cargo || sed -n 's/^FOOTPOINT_CARGO:.*=//p' "$build/CMakeCache.txt")"
