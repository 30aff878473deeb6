#!/usr/bin/env python3
"""Tables and pictures of what run.py measured: OUT/bench.md and OUT/*.svg.    report.py OUT"""

import pathlib
import sys

import goals
import plots
import tables
from figures import Figures


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "bench-out")
    figures = Figures(out)
    lines = tables.header(figures) + goals.goals(figures) + tables.comparison(figures) + tables.classes(figures)
    lines += tables.latency(figures) + tables.growth(figures) + tables.scenes(figures)
    (out / "bench.md").write_text("\n".join(lines))
    plots.draw(figures, out)
    print("\n".join(lines))
    print(f"written to {out}/: bench.md, " + ", ".join(sorted(p.name for p in out.glob("*.svg"))))


main()
