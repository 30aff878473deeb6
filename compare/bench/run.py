#!/usr/bin/env python3
"""Runs the drivers of the bench and leaves their figures in OUT/raw; report.py makes tables and pictures of them.

  run.py --build build/bench --cases ../shared/cases --out bench-out [--quick] [--queries 400] [--only PART]
"""

import argparse
import datetime
import json
import os
import pathlib
import subprocess
import sys
import time

import peers

# For one call on one case, without set-up, seconds.
SECONDS_PER_CASE = 4.0
# For one driver as a whole, should its own limits fail.
SECONDS_PER_DRIVER = 1200


def output_of(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def machine():
    fields = dict(line.split(":", 1) for line in output_of("lscpu").splitlines() if ":" in line)
    version = lambda package: output_of("dpkg-query", "-W", "-f", "${Version}", package) or "not there"
    # Of the library under test, where that is a checkout.
    commit = output_of("git", "describe", "--always", "--dirty", "--abbrev=10")
    return {
        "date": datetime.datetime.now().strftime("%Y-%m-%d %H:%M"),
        "processor": fields.get("Model name", "unknown").strip(),
        "cores": os.cpu_count(),
        "features": [f for f in ("avx2", "fma", "avx512f") if f in fields.get("Flags", "").split()],
        "load_before": os.getloadavg()[0],
        "versions": {
            "footpoint": commit or "unknown commit",
            "OCCT": version(peers.PACKAGES["occt"]),
            "SISL": version(peers.PACKAGES["sisl"]),
            "CGAL": version(peers.PACKAGES["cgal"]),
            "rustc": output_of("rustc", "--version").removeprefix("rustc "),
            "g++": output_of("g++", "-dumpfullversion"),
        },
    }


def case_folders(root, quick):
    folders = sorted(p for p in pathlib.Path(root).iterdir() if (p / "geometry.txt").exists())
    if not quick:
        return folders
    # Every fifth of each group.
    chosen = []
    for _, prefix in peers.GROUPS:
        chosen += [p for p in folders if p.name.startswith(prefix)][::5]
    return chosen


def run(label, command):
    start = time.time()
    try:
        code = subprocess.run([str(c) for c in command], timeout=SECONDS_PER_DRIVER, check=False).returncode
    except subprocess.TimeoutExpired:
        code = "too long"
    print(f"{time.time() - start:7.1f} s  {label}" + (f"  ended with {code}" if code else ""), flush=True)
    return {"label": label, "seconds": round(time.time() - start, 1), "code": code}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", default="build/bench")
    parser.add_argument("--cases", default="../shared/cases")
    parser.add_argument("--out", default="bench-out")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--queries", type=int, default=0, help="per case and call of another library")
    parser.add_argument("--only", default="", help="only drivers whose key contains this")
    settings = parser.parse_args()
    queries = settings.queries or (150 if settings.quick else 400)
    build, raw = pathlib.Path(settings.build), pathlib.Path(settings.out) / "raw"
    raw.mkdir(parents=True, exist_ok=True)
    folders = case_folders(settings.cases, settings.quick)
    if not folders:
        sys.exit(f"no cases in {settings.cases}")
    about = machine() | {"cases": settings.cases, "queries": queries, "quick": settings.quick, "left_out": [], "runs": []}
    quick = ["quick"] if settings.quick else []
    own = [("latency", [build / "bench_latency", raw / "latency.csv", *folders]),
           ("growth", [build / "bench_growth", raw / "growth.csv", *quick]),
           ("scene", ["cargo", "bench", "--quiet", "--locked", "--bench", "scene", "--", f"csv={(raw / 'scene.csv').resolve()}",
                      *(["queries=500"] if settings.quick else [])])]
    for key, command in own:
        if settings.only in key:
            about["runs"].append(run(key, command))
    for call in peers.CALLS:
        driver = build / f"bench_{call.driver}"
        if not driver.exists():
            about["left_out"].append(call.label)
        elif settings.only in call.key:
            options = ["--queries", queries, "--seconds", SECONDS_PER_CASE, "--hint", call.hint]
            about["runs"].append(run(call.key, [driver, call.name, raw / f"{call.key}.csv", *options, *folders]))
    about["load_after"] = os.getloadavg()[0]
    (raw / "run.json").write_text(json.dumps(about, indent=1))


main()
