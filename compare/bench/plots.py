"""The pictures of the bench."""

import math
import pathlib

import peers
from figures import HINT, PLAIN, WALK, median
from svg import COLOURS, GRID, INK, OURS, PALE, SERIES, Axis, Drawing


def about(drawing, figures):
    a = figures.about
    drawing.text(drawing.width - 12, drawing.height - 8, f"{a['processor']}, one thread unless said; {a['date'][:10]}", size=10,
                 anchor="end", colour=PALE)


def shown(figures):
    """The groups that pictures show: surfaces and curves, real ones if there are any."""
    if figures.ours("real_s"):
        return [("real_s", "Surfaces of public CAD files"), ("real_c", "Curves of public CAD files")]
    return [("syn_s", "Synthetic surfaces"), ("syn_c", "Synthetic curves")]


def entries_of(figures, prefix):
    """(time, share wrong, label, colour, hollow) of every call on a group."""
    duels = [(c, figures.duel(c, prefix)) for c in peers.CALLS if c.hint != peers.WALK]
    duels = [(c, d) for c, d in duels if d]
    plain = [d for c, d in duels if not c.hint]
    hinted = [d for c, d in duels if c.hint]
    entries = []
    for call, duel in duels:
        label = call.short + (" (hint)" if call.hint and "hint" not in call.short else "")
        entries.append((median(duel.medians()), duel.wrong(), label, COLOURS[call.driver], call.hint > 0))
    for label, group, time in (("footpoint", plain, lambda d: d.medians(True)), ("footpoint, batch (mean)", plain, lambda d: d.batches()),
                               ("footpoint (hint)", hinted, lambda d: d.medians(True))):
        if group:
            wrong = max(d.wrong(True) for d in group)
            entries.append((median([median(time(d)) for d in group]), wrong, label, OURS, group is hinted))
    return entries


def time_against_wrong(figures, out):
    picture = Drawing(1040, 500, "Time against wrong answers")
    for k, (prefix, title) in enumerate(shown(figures)):
        entries = entries_of(figures, prefix)
        if not entries:
            continue
        left = 75 + 515 * k
        x = Axis(0.1, 1000, left, left + 425)
        y = Axis(1e-3, 100, 345, 75)
        zero = y.start + 45
        picture.text(left + 212, 56, title, size=13, anchor="middle", weight="bold")
        picture.frame(x, y, "time of a query, us (median over the cases of a case's median)", "wrong answers, % of queries", below=80)
        picture.line(x.start, zero, x.end, zero, PALE)
        picture.taken += [(x.start, at - 2, x.end, at + 2) for at in (zero, y.start)]
        picture.text(x.start - 7, zero + 4, "none", size=11, anchor="end", colour=INK)
        places = [(x.at(t), zero if w == 0 else y.at(100 * w), *rest) for t, w, *rest in entries]
        for px, py, _, colour, hollow in places:
            picture.dot(px, py, colour, hollow, 6.5 if colour == OURS else 5)
        for px, py, label, colour, _ in sorted(places, key=lambda p: p[3] != OURS):
            picture.label(px, py, label, colour, (left + 2, 62, left + 440, zero + 34))
    picture.text(12, picture.height - 8, "Hollow: started from a hint 1 % of the domain away. "
                 "The mesh (1e-3 of the diagonal) is counted by its distance. Wrong: no answer or more than 1e-7 of the diagonal too far.", size=10, colour=PALE)
    picture.text(picture.width - 12, 24, figures.about["date"][:10], size=10, anchor="end", colour=PALE)
    picture.write(out / "time_wrong.svg")


def latency(figures, out):
    picture = Drawing(760, 460, "How long single calls of footpoint take")
    x, y = Axis(0.1, 1e4, 85, 720), Axis(1e-5, 1, 385, 50)
    shares = {1: "all", 0.5: "p50", 0.1: "p90", 1e-2: "p99", 1e-3: "p99.9", 1e-4: "p99.99", 1e-5: "p99.999"}
    picture.frame(x, y, "time, us (least of five repeats)", "share of the queries that take longer", y_ticks=[])
    for share, name in shares.items():
        picture.line(x.start, y.at(share), x.end, y.at(share), GRID)
        picture.text(x.start - 7, y.at(share) + 4, name, size=11, anchor="end", colour=PALE)
    entries = []
    for k, (title, prefix) in enumerate(peers.GROUPS):
        for kind, dash, suffix in ((PLAIN, "", ""), (HINT, "5 4", ", hint 1 %")):
            times = sorted(t for case in figures.ours(prefix) for t in case.times(kind))
            if not times or (kind == HINT and not prefix.startswith("real")):
                continue
            step = max(1, len(times) // 400)
            picked = list(range(0, len(times) - 400, step)) + list(range(max(0, len(times) - 400), len(times)))
            points = [(x.at(times[i]), y.at((len(times) - i) / len(times))) for i in picked]
            picture.curve(points, SERIES[k], dash, 1.8)
            entries.append((title.split(" (")[0] + suffix, SERIES[k], dash))
    picture.legend(525, 62, entries)
    about(picture, figures)
    picture.write(out / "latency.svg")


def by_class(figures, out):
    prefix, title = shown(figures)[0]
    picture = Drawing(910, 460, f"Time by where the query lies: {title[0].lower()}{title[1:]}")
    names = peers.CLASSES
    x = Axis(-0.5, len(names) - 0.5, 80, 640, log=False)
    y = Axis(0.1, 1e4, 385, 50)
    picture.frame(x, y, "class of the query", "time of a query, us", x_ticks=range(len(names)), x_names=dict(enumerate(names)))
    cases = figures.ours(prefix)
    of_class = lambda case, kind, name: [q[1][kind] for q in case.queries if q[0] == name]
    lines = [("footpoint", OURS, "", [median([median(of_class(c, PLAIN, n)) for c in cases]) for n in names]),
             ("footpoint, batch", OURS, "2 3", [median([c.classes.get(n, math.nan) for c in cases]) for n in names]),
             ("footpoint (hint)", OURS, "7 4", [median([median(of_class(c, HINT, n)) for c in cases]) for n in names])]
    dashes = {}
    for call in peers.CALLS:
        duel = figures.duel(call, prefix)
        if duel and call.hint != peers.WALK:
            used = dashes[call.driver] = dashes.get(call.driver, -1) + 1
            hint = " (hint)" if call.hint and "hint" not in call.short else ""
            lines.append((call.short + hint, COLOURS[call.driver], ["", "7 4", "2 3", "10 3 2 3"][used],
                          [duel.class_time(n) for n in names]))
    for _, colour, dash, values in lines:
        points = [(x.at(k), y.at(v)) for k, v in enumerate(values) if not math.isnan(v)]
        picture.curve(points, colour, dash, 1.6)
        for px, py in points:
            picture.dot(px, py, colour, size=2.6)
    picture.legend(665, 70, [line[:3] for line in lines])
    about(picture, figures)
    picture.write(out / "classes.svg")


def growth_picture(figures, out, name, title, x_title, experiment, x_range, y_range, columns, scale, log=True, kinds=("surface", "curve")):
    """Lines of (label, column of the driver's row, dash) for surfaces and curves."""
    picture = Drawing(760, 420, title)
    x, y = Axis(*x_range, 80, 720, log=log), Axis(*y_range, 345, 50)
    picture.frame(x, y, x_title, columns[1])
    entries = []
    for kind, colour in (("surface", SERIES[0]), ("curve", SERIES[1])):
        rows = figures.growth[experiment, kind] if kind in kinds else []
        for label, column, dash in columns[0] if rows else []:
            points = [(x.at(r[0]), y.at(scale(r, column))) for r in rows if scale(r, column) > 0]
            picture.curve(points, colour, dash)
            for px, py in points:
                picture.dot(px, py, colour, size=3)
            entries.append((f"{kind}s, {label}", colour, dash))
    picture.legend(98, 64, entries)
    about(picture, figures)
    picture.write(out / name)


def growth(figures, out):
    per_query = ([("single calls, median", 1, ""), ("one batch", 3, "7 4"), ("single calls, p99", 2, "2 3")], "time of a query, us")
    micro = lambda row, column: row[column] / 1e3
    growth_picture(figures, out, "patches.svg", "Growth with the number of patches (bicubic) or segments (cubic)",
                   "patches, segments", "pieces", (1, 1e5), (0.1, 1000), per_query, micro)
    growth_picture(figures, out, "degree.svg", "Growth with the degree (64 patches or segments)", "degree in each direction", "degree",
                   (1, 9), (0.1, 1000), per_query, micro, log=False)
    set_up = ([("one core", 4, ""), ("all cores", 5, "7 4")], "set-up per patch or segment, us")
    growth_picture(figures, out, "setup.svg", "Set-up: shape and index", "patches, segments", "pieces", (1, 1e5), (0.1, 1000), set_up,
                   lambda row, column: 1e6 * row[column] / row[0])


def batch(figures, out):
    picture = Drawing(760, 420, "Batches: queries per call and threads (100 patches or segments)")
    x, y = Axis(1, 1e5, 80, 720), Axis(0.1, 100, 345, 50)
    picture.frame(x, y, "queries per call", "time of a query, us")
    entries = []
    for kind, colour in (("surface", SERIES[0]), ("curve", SERIES[1])):
        for threads, dash in ((1, ""), (2, "7 4")):
            points = [(x.at(r[0]), y.at(r[2] / 1e3)) for r in figures.growth["batch", kind] if r[1] == threads]
            if points:
                picture.curve(points, colour, dash)
                for px, py in points:
                    picture.dot(px, py, colour, size=3)
                entries.append((f"{kind}s, {threads} thread{'s' if threads > 1 else ''}", colour, dash))
    picture.legend(540, 64, entries)
    about(picture, figures)
    picture.write(out / "batch.svg")


def draw(figures, out):
    out = pathlib.Path(out)
    time_against_wrong(figures, out)
    if figures.latency:
        latency(figures, out)
        by_class(figures, out)
    if figures.growth:
        growth(figures, out)
        batch(figures, out)
