#!/bin/sh
# deb.sh SOURCE OUT: builds the Debian packages from the committed and changed files of SOURCE into OUT, unpacks them there,
# and builds a program against what they hold. Needs dpkg-dev, debhelper, cmake and cargo; no root.
set -eu
source=$1 out=$2
for tool in dpkg-buildpackage dh; do
    command -v $tool >/dev/null 2>&1 || { echo "left out: the Debian packages (apt-get install dpkg-dev debhelper)"; exit 77; }
done
rm -rf "$out"
mkdir -p "$out/footpoint"
out=$(cd "$out" && pwd)
(cd "$source" && tar -cf - Cargo.toml Cargo.lock build.rs cbindgen.toml CMakeLists.txt README.md CHANGELOG.md LICENSE-* \
    benches cmake include src) | tar -xf - -C "$out/footpoint"
cp -r "$source/packaging/debian" "$out/footpoint/debian"
# Rust comes from rustup or from Debian: dpkg need not know it (-d).
(cd "$out/footpoint" && dpkg-buildpackage -b -us -uc -d >"$out/log" 2>&1) || { tail -40 "$out/log"; exit 1; }
mkdir "$out/root"
for package in "$out"/*.deb; do
    case $package in *-dbgsym_*) ;; *) dpkg-deb -x "$package" "$out/root" ;; esac
done
libdir=$(dirname "$(find "$out/root/usr/lib" -name libfootpoint.so)")
cc -std=c99 "$source/ctests/consumer/consumer.c" -o "$out/consumer" \
    $(PKG_CONFIG_PATH="$libdir/pkgconfig" pkg-config --cflags --libs footpoint) -lm "-Wl,-rpath,$libdir"
"$out/consumer"
ls "$out"/*.deb
