#!/bin/sh
# install.sh CMAKE CC BUILD LIBRARY_DIRECTORY SOURCE
# Installs into an empty folder, moves that, and builds and runs one C program against what is there, shared and
# static, with the flags of the pkg-config file.
set -eu
cmake=$1 cc=$2 build=$3 libdir=$4 source=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/first" >"$work/log" || { cat "$work/log"; exit 1; }
mv "$work/first" "$work/moved"
prefix=$work/moved
ls "$prefix/include/footpoint.h" "$prefix/include/footpoint.hpp" >/dev/null

# field NAME: a line of the pkg-config file with its variables replaced.
field() {
    sed -n "s|^$1: ||p" "$prefix/$libdir/pkgconfig/footpoint.pc" |
        sed "s|\${libdir}|$prefix/$libdir|g; s|\${includedir}|$prefix/include|g"
}
"$cc" -std=c99 $(field Cflags) "$source" -o "$work/shared" $(field Libs) -lpthread -lm "-Wl,-rpath,$prefix/$libdir"
"$work/shared"
"$cc" -std=c99 $(field Cflags) "$source" -o "$work/static" "$prefix/$libdir/libfootpoint.a" $(field Libs.private)
"$work/static"
