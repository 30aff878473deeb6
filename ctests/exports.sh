#!/bin/sh
# exports.sh CC NM HEADER LIBRARY SONAME TEST_SOURCE...
# The library exports the functions of the header and nothing else, has the expected SONAME, and each of
# its functions is used in at least one of the test sources.
set -eu
cc=$1 nm=$2 header=$3 library=$4 soname=$5
shift 5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

"$cc" -E -P -x c "$header" | grep -oE '\bfpt_[a-z0-9_]+ *\(' | tr -d ' (' | sort -u >"$work/declared"
"$nm" -D --defined-only "$library" | awk '{ sub(/@.*/, "", $NF); print $NF }' | sort -u >"$work/exported"
if ! diff "$work/declared" "$work/exported" >"$work/difference"; then
    echo "the header (<) and the exports of the library (>) differ:"
    cat "$work/difference"
    failed=1
fi

found=$(readelf -d "$library" | sed -n 's/.*SONAME.*\[\(.*\)\].*/\1/p')
if [ "$found" != "$soname" ]; then
    echo "the SONAME is $found, not $soname"
    failed=1
fi

while read -r name; do
    if ! grep -qw -- "$name" "$@"; then
        echo "no test calls $name"
        failed=1
    fi
done <"$work/declared"

echo "exports: $(wc -l <"$work/declared") functions declared, $(wc -l <"$work/exported") symbols exported, SONAME $found"
exit $failed
