"""bench.md: what the drivers measured, as tables."""

import math
import statistics

import peers
from figures import HINT, PLAIN, WALK, WRONG, median, share_below


def show(value, digits=2):
    """A time, in microseconds."""
    if math.isnan(value) or math.isinf(value):
        return "-"
    if value >= 1000:
        return f"{value / 1000:.{digits}g} ms" if value < 1e5 else f"{value / 1000:,.0f} ms"
    return f"{value:.{digits}f}" if value < 10 else f"{value:.3g}"


def ratio(value):
    return "-" if math.isnan(value) else f"{value:.1f}" if value < 10 else f"{value:.0f}"


def percent(share):
    return "0" if share == 0 else f"{100 * share:.2g}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows] + [""]


def header(figures):
    a = figures.about
    versions = ", ".join(f"{name} {version}" for name, version in a["versions"].items())
    counts = ", ".join(f"{len(figures.ours(prefix))} {title}" for title, prefix in peers.GROUPS)
    lines = [
        "# Bench", "",
        f"{a['date']}; {a['processor']}, {a['cores']} cores ({', '.join(a['features'])}); load before {a['load_before']:.1f}, "
        f"after {a['load_after']:.1f}; {sum(r['seconds'] for r in a['runs']):.0f} s in all.",
        "", f"{versions}.", "",
        f"Cases: {counts}, from `{a['cases']}`; at most {a['queries']} queries a case for other libraries, each class in "
        "proportion; all of them where footpoint runs alone.", "",
        "Times are microseconds on one thread: of single calls the time that passes (of those beyond 50 us the processor time, "
        "because a busy machine interrupts them), of batches the processor time; with two threads the time that passes. "
        f"*Wrong*: no answer, or farther than the proven distance by more than {WRONG:g} of the box diagonal. footpoint runs in turns "
        "of 32 queries with the other library in one process; each query is asked up to four times and the least time counts. *Median*: median over the cases of a case's median; *mean*: median over the cases of a case's mean, which is what "
        "a batch can be compared with. *Times slower*: median over the cases of their median over ours, and of their mean over "
        "our batch.", "",
    ]
    unproven, answers = sum(c.unproven for c in figures.latency), sum(len(c.queries) for c in figures.latency)
    lines += [f"Not proven: {unproven:,} of the {answers:,} answers of footpoint.", ""]
    if a["left_out"]:
        lines += ["**Left out, because it is not there:** " + ", ".join(a["left_out"]) + ".", ""]
    failed = [f"{r['label']} ({r['code']})" for r in a["runs"] if r["code"] != 0]
    return lines + (["**Ended early:** " + ", ".join(failed) + ".", ""] if failed else [])


def ours_rows(figures, prefix):
    cases = figures.ours(prefix)
    wrong = [q[2] for case in cases for q in case.queries]
    share = sum(not e <= WRONG for e in wrong) / max(len(wrong), 1)
    rows = []
    for label, kind in (("single calls", PLAIN), ("single calls, hint 1 % away", HINT), ("single calls, hint 0.1 % away", WALK)):
        worst = max(t for case in cases for t in case.times(kind))
        rows.append([f"**footpoint, {label}**", percent(share), "0", show(median([median(c.times(kind)) for c in cases])),
                     show(median([statistics.fmean(c.times(kind)) for c in cases])), show(worst),
                     show(median([c.set_up for c in cases])), "", "", ""])
    for label, name in (("one batch", "batch"), ("one batch, 2 threads", "batch_of_two"), ("one batch, hint 1 % away", "batch_hinted")):
        rows.append([f"**footpoint, {label}**", percent(share), "0", "", show(median([getattr(c, name) for c in cases])), "",
                     "", "", "", ""])
    return rows


def their_row(call, duel):
    faster, in_batch = duel.ratios(), duel.ratios(batch=True)
    hint = f", hint {100 * call.hint:g} % away" if call.hint else ""
    lost = duel.state("nothing", "crashed", "hung")
    stopped = duel.state("crashed", "hung")
    none = percent(lost / len(duel.queries())) + (f" ({duel.state('crashed')} crashes, {duel.state('hung')} hangs)" if stopped else "")
    wrong = percent(duel.wrong()) + ("" if call.gives_place else " (a mesh)")
    return [call.label + hint, wrong, none, show(median(duel.medians())), show(median(duel.means())), show(duel.worst()),
            show(median([c.set_up for c in duel.cases])), ratio(median(faster)), ratio(median(in_batch)),
            f"{sum(r > 1 for r in faster)} / {sum(r > 1 for r in in_batch)} of {len(faster)}"]


def comparison(figures):
    head = ["library and call", "wrong %", "no answer %", "median", "mean", "worst query", "set-up", "times slower than ours, single",
            "than our batch", "ours faster (single / batch) on cases"]
    lines = []
    for title, prefix in peers.GROUPS:
        if not figures.ours(prefix):
            continue
        rows = ours_rows(figures, prefix)
        for call in peers.CALLS:
            duel = figures.duel(call, prefix)
            if duel:
                rows.append(their_row(call, duel))
        lines += [f"## {title[0].upper()}{title[1:]}", ""] + table(head, rows)
    return lines + ["The error of the mesh lookup is that of its triangles: " + mesh_error(figures), ""]


def mesh_error(figures):
    call = next(c for c in peers.CALLS if not c.gives_place)
    texts = []
    for title, prefix in peers.GROUPS:
        duel = figures.duel(call, prefix)
        if duel:
            errors = [q[3] for q in duel.queries()]
            texts.append(f"{title.split(' (')[0]}: median {median(errors):.1e}, 99 % below {share_below(errors, 0.99):.1e} of the diagonal")
    return "; ".join(texts) + "."


def classes(figures):
    lines = ["## Time per class", "", "Median over the cases of the class's median (single calls) or mean (one batch of "
             "the class).", ""]
    for prefix in ("real_s", "real_c", "syn_s", "syn_c"):
        cases = figures.ours(prefix)
        if not cases:
            continue
        head = [dict((p, t) for t, p in peers.GROUPS)[prefix].split(" (")[0]] + peers.CLASSES
        of_class = lambda case, kind, name: [q[1][kind] for q in case.queries if q[0] == name]
        rows = [["footpoint, " + label] + [show(median([median(of_class(c, kind, name)) for c in cases])) for name in peers.CLASSES]
                for label, kind in (("single", PLAIN), ("hint 1 %", HINT))]
        rows.append(["footpoint, batch"] + [show(median([c.classes.get(name, math.nan) for c in cases])) for name in peers.CLASSES])
        for call in peers.CALLS:
            duel = figures.duel(call, prefix)
            if duel and call.hint in (0, peers.NEAR):
                rows.append([call.short + (" 1 %" if call.hint else "")] + [show(duel.class_time(name)) for name in peers.CLASSES])
        lines += table(head, rows)
    return lines


def latency(figures):
    lines = ["## Latency of single calls", "", "All queries of all cases together, the least of five repeats of each.", ""]
    rows = []
    for title, prefix in peers.GROUPS:
        for label, kind in (("", PLAIN), (", hint 1 %", HINT), (", hint 0.1 %", WALK)):
            times = [t for case in figures.ours(prefix) for t in case.times(kind)]
            if times:
                shares = [show(share_below(times, s)) for s in (0.5, 0.9, 0.99, 0.999, 0.9999)]
                rows.append([title.split(" (")[0] + label, f"{len(times):,}", *shares, show(max(times))])
    return lines + table(["shapes", "queries", "p50", "p90", "p99", "p99.9", "p99.99", "max"], rows)


def growth(figures):
    lines = ["## Growth", "", "Sheets and curves of random heights, bicubic unless said; queries at most a quarter of a patch away, each at another place.", ""]
    for experiment, x in (("pieces", "patches or segments"), ("creased", "patches or segments of degree 1, all lines between them creases"),
                          ("degree", "degree (64 pieces)")):
        rows = []
        for kind in ("surface", "curve"):
            for row in figures.growth[experiment, kind]:
                pieces = 64 if experiment == "degree" else row[0]
                rows.append([kind, f"{row[0]:,.0f}", show(row[1] / 1e3), show(row[2] / 1e3), show(row[3] / 1e3),
                             show(1e6 * row[4] / pieces), show(1e6 * row[5] / pieces), f"{row[6] / pieces:,.0f}"])
        lines += table(["shape", x, "single, median", "single, p99", "batch", "set-up per piece, one core", "set-up, all cores",
                        "memory per piece, bytes"], rows)
    rows = []
    for kind in ("surface", "curve"):
        by_size = {(r[0], r[1]): r[2] for r in figures.growth["batch", kind]}
        for size in sorted({size for size, _ in by_size}):
            rows.append([kind, f"{size:,.0f}", show(by_size[size, 1] / 1e3), show(by_size[size, 2] / 1e3)])
    lines += table(["100 pieces", "queries per call", "1 thread", "2 threads"], rows)
    rows = []
    for kind in ("surface", "curve"):
        threads = figures.growth["threads", kind]
        rows += [[kind, f"{r[0]:.0f}", show(r[1] / 1e3), ratio(threads[0][1] / r[1]), show(r[2] / 1e3), ratio(r[0] * threads[0][2] / r[2])]
                 for r in threads]
    lines += ["Threads of a busy machine wait for cores; the last column is what the processor time would allow on an idle one.", ""]
    return lines + table(["100 pieces, one large batch", "threads", "per query", "times faster than one", "processor time of all threads per query",
                          "at most, were all cores free"], rows)


def scenes(figures):
    if not figures.scenes:
        return []
    lines = ["## Scenes", "", "1,000 placed real surfaces of diagonal 1, turned at random, on grids of 1.3 (apart), 0.7 (a part), 0.4 (overlapping) and "
             "0.25 (a heap) diagonals; medians of single calls beside the nearest member asked alone.", ""]
    rows = [[name, show(scene), show(alone), ratio(scene / alone), show(hinted), show(worst), f"{wrong:.0f}", f"{unproven:.0f}"]
            for name, scene, alone, hinted, worst, wrong, unproven in figures.scenes]
    return lines + table(["arrangement", "scene", "member alone", "ratio", "with a hint", "worst", "wrong (of 200 checked)", "not proven"], rows)
