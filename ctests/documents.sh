#!/bin/sh
# documents.sh SOURCE DOCUMENT...
# Each program in a document is a file in examples/, character for character: a line `examples/NAME`: is followed by its text.
set -eu
source=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
count=0
for document in "$@"; do
    for name in $(sed -n 's|^`\(examples/[A-Za-z0-9_./]*\)`:$|\1|p' "$document"); do
        awk -v "mark=\`$name\`:" '$0 == mark { near = 1; next } near && /^```/ { if (inside) exit; inside = 1; next } inside { print }' \
            "$document" >"$work/block"
        diff -u "$source/$name" "$work/block" || { echo "$document does not show $name as it is"; exit 1; }
        count=$((count + 1))
    done
done
[ $count -gt 0 ] || { echo "no program found"; exit 1; }
echo "$count programs in documents are those in examples/"
