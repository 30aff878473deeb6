#!/usr/bin/env python3
"""Instructions per query, counted by callgrind on the cases of tests/data, beside the last record.

  instructions.py --build build/bench --record docs/instructions.csv [--write]

The regression measure: hardly any noise, whatever else the machine does. valgrind shows programs no AVX-512, so the
path that is counted is the one for AVX2. --write appends what was counted to the record.
"""

import argparse
import csv
import datetime
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

# The mean is over all queries, a few hard cases make most of it; the other is the median over the cases of their means.
FIELDS = ["date", "commit", "processor", "rustc", "kind", "queries", "mean", "median case"]
CASES = "tests/data"


def output_of(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True).stdout.strip()


def counted(program, kind, folders):
    """(queries, instructions) of each case for one kind of calls; cases with instructions that valgrind does not know are left out."""
    try:
        return counted_at_once(program, kind, folders)
    except subprocess.CalledProcessError as error:
        if "unhandled instruction" not in error.stderr:
            raise
    found = []
    for folder in folders:
        try:
            found += counted_at_once(program, kind, [folder])
        except subprocess.CalledProcessError as error:
            if "unhandled instruction" not in error.stderr:
                raise
            print(f"left out, valgrind does not know an instruction of it: {kind}, {folder}")
    return found


def counted_at_once(program, kind, folders):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        queries = output_of("valgrind", "--tool=callgrind", "--collect-atstart=no", "--toggle-collect=counted",
                            "--dump-after=counted", f"--callgrind-out-file={out}", program, kind, *folders)
        dumps = [pathlib.Path(f"{out}.{k + 1}").read_text() for k in range(len(queries.split()))]
    sums = [re.search(r"^summary: (\d+)", dump, re.MULTILINE) for dump in dumps]
    if not all(sums):
        sys.exit("callgrind counted nothing")
    return [(int(count), int(found[1])) for count, found in zip(queries.split(), sums)]


def row_of(cases):
    queries = sum(count for count, _ in cases)
    return {
        "queries": queries,
        "mean": round(sum(instructions for _, instructions in cases) / queries),
        "median case": round(statistics.median(instructions / count for count, instructions in cases)),
    }


def last_record(path):
    if not path.exists():
        return {}
    with path.open(newline="") as file:
        return {row["kind"]: row for row in csv.DictReader(file)}


def append(path, rows):
    is_new = not path.exists()
    with path.open("a", newline="") as file:
        writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
        if is_new:
            writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default="build/bench")
    parser.add_argument("--record", default="docs/instructions.csv")
    parser.add_argument("--write", action="store_true")
    settings = parser.parse_args()
    program = pathlib.Path(settings.build) / "bench_instructions"
    record = pathlib.Path(settings.record)
    folders = sorted(p.parent for p in pathlib.Path(CASES).glob("*/geometry.txt"))
    model = re.search(r"Model name:\s*(.*)", output_of("lscpu"))
    common = {
        "date": datetime.date.today().isoformat(),
        "commit": output_of("git", "rev-parse", "--short=10", "HEAD"),
        "processor": model[1] if model else "unknown",
        "rustc": output_of("rustc", "--version").split()[1],
    }
    before, rows = last_record(record), []
    print(f"{'instructions per query':<24}{'mean':>9}{'change':>9}{'median case':>14}{'change':>9}   beside the record of")
    for kind in output_of(program).splitlines():
        row, old = row_of(counted(program, kind, folders)), before.get(kind)
        rows.append(common | {"kind": kind} | row)
        change = lambda name: f"{100 * (row[name] / int(old[name]) - 1):+.1f} %" if old else ""
        beside = f"   {old['date']} {old['commit']}, rustc {old['rustc']}" if old else ""
        print(f"{kind:<24}{row['mean']:>9,}{change('mean'):>9}{row['median case']:>14,}{change('median case'):>9}{beside}", flush=True)
    if settings.write:
        append(record, rows)
        print(f"appended to {record}")


main()
