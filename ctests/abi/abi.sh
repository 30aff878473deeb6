#!/bin/sh
# abi.sh CC HEADER BASELINE [write]
# Compares the binary interface of the header with the committed baseline: libabigail reads the debug information of a
# probe that holds the address of each function, so that structs, enums and parameters count as well as names. New
# functions, new numbers of enums, and option structs that grow at the end are allowed; all else fails. Then headers with
# one forbidden change each must be refused. With `write` the header becomes the baseline (without its comments).
set -eu
cc=$1 header=$2 baseline=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# without_comments HEADER
without_comments() { "$cc" -w -fpreprocessed -dD -E -P "$1"; }

if [ "${4:-}" = write ]; then
    without_comments "$header" >"$baseline"
    exit 0
fi
if ! command -v abidiff >/dev/null 2>&1; then
    echo "left out: the ABI check (apt-get install abigail-tools)"
    exit 77
fi

# probe HEADER NAME: <work>/NAME/probe.so, which refers to every function of the header.
probe() {
    mkdir -p "$work/$2"
    cp "$1" "$work/$2/footpoint.h"
    {
        echo '#include "footpoint.h"'
        without_comments "$1" | grep -o '\bfpt_[a-z0-9_]*(' | sed 's/(//' | sort -u | sed 's/.*/__typeof__(\&&) probe_& = \&&;/'
        # Enums and callback structs that no parameter mentions by type.
        for kind in enum struct; do
            grep -o "typedef $kind fpt_[a-z_]* {" "$1" | awk '{print $3}' |
                sed "s/.*/unsigned char size_of_&[sizeof($kind &)]; $kind & *value_of_&;/"
        done
    } >"$work/$2/probe.c"
    (cd "$work/$2" && "$cc" -std=c99 -g -shared -fPIC -Wl,--unresolved-symbols=ignore-all probe.c -o probe.so)
}

# compare NAME: what abidiff says about the baseline's probe and that one.
compare() {
    abidiff --no-added-syms --suppressions "$work/growth.ini" "$work/baseline/probe.so" "$work/$1/probe.so"
}

# Structs that begin with struct_size may grow at their end (see the head of footpoint.h), and with them what the probe tells of
# their size.
growing=$(without_comments "$baseline" | awk '/^typedef struct fpt_/ { name = $3 } /^ *size_t struct_size;/ { print name }' | paste -s -d '|')
cat >"$work/growth.ini" <<END
[suppress_type]
  name_regexp = ^($growing)\$
  type_kind = struct
  has_data_member_inserted_at = end
[suppress_variable]
  name_regexp = ^size_of_($growing)\$
END

probe "$baseline" baseline
probe "$header" header
functions=$(grep -c '^__typeof__' "$work/header/probe.c")
exported=$(grep -c '@since [0-9]' "$header")
[ "$functions" = "$exported" ] || { echo "the probe knows $functions functions, the header has $exported"; exit 1; }
compare header || { echo "the binary interface changed; after a deliberate change: make abi-baseline"; exit 1; }

# change NAME SED: one change; `refused` and `allowed` say what must come out.
change() {
    sed "$2" "$baseline" >"$work/$1.h"
    if cmp -s "$baseline" "$work/$1.h"; then echo "$1 changes nothing"; exit 1; fi
    probe "$work/$1.h" "$1"
}
refused() {
    change "$1" "$2"
    if compare "$1" >"$work/log" 2>&1; then echo "not seen: $1"; exit 1; fi
}
allowed() {
    change "$1" "$2"
    compare "$1" >"$work/log" 2>&1 || { cat "$work/log"; echo "refused: $1"; exit 1; }
}
refused renumbered_status 's/FPT_UNSUPPORTED = 5,/FPT_UNSUPPORTED = 50,/'
refused removed_function '/fpt_curve_is_closed(/d'
refused narrower_parameter 's/uint32_t derivatives,/uint16_t derivatives,/'
refused record_grew 's/^\( *\)uint32_t iterations;/\1uint32_t iterations; double more;/'
refused record_turned 's/^\( *\)double distance;/\1float distance;/'
refused option_in_the_middle 's/^\( *\)uint32_t method;/\1double more; uint32_t method;/'
allowed option_at_the_end '/^typedef struct fpt_query_options {/,/^}/ s/^\( *\)void \*user;/\1void *user; double more;/'
allowed new_flag 's/FPT_FOOT_CREASE = 2048,/FPT_FOOT_CREASE = 2048, FPT_FOOT_NEW = 4096,/'
echo "binary interface as in the baseline: $functions functions"
