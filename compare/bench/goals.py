"""What the bench must show (issue 4), each with what was measured."""

import math

import peers
from figures import HINT, PLAIN, median, share_below
from tables import ratio, show, table


def call(name, hint=0.0):
    return next(c for c in peers.CALLS if c.name == name and c.hint == hint)


def most_cases(duel, batch):
    ratios = duel.ratios(batch)
    return sum(r > 1 for r in ratios) / len(ratios) if ratios else math.nan


def at_least(name, value, goal):
    return [name, f">= {goal:g} x", ratio(value), value >= goal]


def at_most(name, value, goal):
    return [name, f"<= {goal:g} us", show(value), value <= goal]


def comparisons(figures):
    rows = []
    for name, label, prefix, goal in (("occt_value", "ValueOfUV", "real_s", 70), ("occt_edges", "OCCT Tree + edges", "real_s", 20),
                                      ("sisl", "SISL s1954", "real_s", 30), ("occt_extpc", "Extrema_ExtPC + ends, curves", "real_c", 15)):
        duel = figures.duel(call(name), prefix)
        for batch, how in ((False, "single calls"), (True, "batches")):
            rows.append(at_least(f"faster than {label}, {how}", median(duel.ratios(batch)), goal))
    for name, label in (("mesh_newton", "AABB + Newton"), ("mesh", "the mesh lookup")):
        for batch, how in ((False, "single calls"), (True, "batches")):
            share = most_cases(figures.duel(call(name), "real_s"), batch)
            rows.append([f"faster than {label}, {how}", "most real surfaces", "-" if math.isnan(share) else f"{100 * share:.0f} % of them", share > 0.5])
    return rows


def times(figures):
    surfaces, curves = figures.ours("real_s"), figures.ours("real_c")
    of = lambda cases, kind=PLAIN: median([median(c.times(kind)) for c in cases])
    pooled = lambda prefix: [t for c in figures.ours(prefix) for t in c.times()] or [math.nan]
    real, synthetic = pooled("real"), pooled("syn")
    return [
        at_most("real surfaces, batch of all queries, mean", median([c.batch for c in surfaces]), 1.4),
        at_most("real surfaces, batches of one class, median of the classes", median([median(c.classes.values()) for c in surfaces]), 1.4),
        at_most("real surfaces, single calls", of(surfaces), 2.0),
        at_most("real curves, batch of all queries, mean", median([c.batch for c in curves]), 0.4),
        at_most("real curves, batches of one class, median of the classes", median([median(c.classes.values()) for c in curves]), 0.4),
        at_most("real surfaces, hint 1 % away, single calls", of(surfaces, HINT), 0.5),
        at_most("real surfaces, hint 1 % away, batch", median([c.batch_hinted for c in surfaces]), 0.5),
        at_most("p99.9 of all real queries", share_below(real, 0.999), 40.0),
        at_most("slowest real query", max(real), 1000.0),
        at_most("slowest synthetic query", max(synthetic), 5000.0),
    ]


def growth(figures):
    pieces = {row[0]: row for row in figures.growth["pieces", "surface"]}
    threads = {row[0]: row[1:] for row in figures.growth["threads", "surface"]}
    if 1e4 not in pieces or 2 not in threads:
        return []
    large, small = pieces[1e4], pieces[1e2]
    rows = [[f"10,000 patches against 100, {how}", "<= 2 x", ratio(large[k] / small[k]), large[k] <= 2 * small[k]]
            for k, how in ((1, "single calls"), (3, "batch"))]
    rows.append(at_least("two threads against one, as it was", threads[1][0] / threads[2][0], 1.8))
    rows.append(at_least("two threads against one, by processor time", 2 * threads[1][1] / threads[2][1], 1.8))
    rows.append(at_most("set-up per bicubic patch (100 patches, one core)", 1e6 * small[4] / 100, 20.0))
    rows.append(["100,000 patches set up (all cores)", "<= 1 s", f"{pieces[1e5][5]:.2f} s", pieces[1e5][5] <= 1.0])
    return rows


def scenes(figures):
    ratios = {name: scene / alone for name, scene, alone, *_ in figures.scenes}
    return [[f"scene of 1,000 real surfaces against one, {name}", "<= 3 x", ratio(value), value <= 3] for name, value in ratios.items()]


def goals(figures):
    rows = times(figures) + comparisons(figures) + growth(figures) + scenes(figures)
    marked = [[name, goal, value, "-" if value == "-" else "yes" if met else "**no**"] for name, goal, value, met in rows]
    return ["## Goals", ""] + table(["what", "goal", "measured", "met"], marked)
