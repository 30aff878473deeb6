"""Draws architecture.svg: python3 docs/pictures/architecture.py > docs/pictures/architecture.svg; tests/layering.rs compares its modules with src/lib.rs."""

ROWS = [
    ("#eceff3", "error portable", "what cannot be answered; portable functions"),
    ("#dbe9f6", "simd knots basis curve surface", "vector instructions; checked shapes"),
    ("#dbe9f6", "bezier bounds", "Bezier pieces, boxes"),
    ("#dbe9f6", "coefficients jet tree sparse", "products, derivatives, box tree, equations"),
    ("#d9f0e3", "analytic index", "what is elementary; per shape, built once, shared"),
    ("#fdf0d5", "refine", "fast, may be wrong"),
    ("#f9dcd9", "closest", "what is returned, with its bound"),
    ("#e8e0f3", "set roots", "answers of many feet; all zeros"),
    ("#e8e0f3", "extrema preimage", "all stationary points; all parameters"),
    ("#e8e0f3", "unwrap normal scene callback", "paths, sides, many shapes, functions"),
    ("#e8e0f3", "batch weights", "threads; weights from wished distances"),
    ("#fbe8f1", "operate fit elementary construct", "shapes from shapes, points, numbers"),
    ("#e0f2f1", "transform pcurve trim face", "changed parameters, trimmed faces"),
    ("#e0f2f1", "intersect march", "where shapes meet"),
    ("#fbe8f1", "inspect fair", "how shapes bend; bent evenly, within a bound"),
    ("#eceff3", "ffi", "C functions"),
]

QUERY = ["points in: check, batch, tiles", "into the frame; hint = first foot", "tree: nearest box first", "piece: coefficients of |S - q|² W²",
         "closed by a test, or halved", "best foot: iterate, lower the target", "out: S(u,v), distance, bound, flags"]

STEP, TOP, HEIGHT = 70, 58, 46


def box(x, y, width, fill, text, kind):
    return (f'<rect x="{x:g}" y="{y}" width="{width:g}" height="{HEIGHT}" rx="6" fill="{fill}" class="b"/>'
            f'<text x="{x + width / 2:g}" y="{y + 28}" class="{kind}">{text}</text>')


def arrow(x, y):
    return f'<path d="M{x} {y + HEIGHT + 3} v{STEP - HEIGHT - 7}" class="a"/>'


def main():
    title, height = "Modules of footpoint in dependency order, and the path of a query", TOP + STEP * len(ROWS) + 6
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1160 {height}" width="1160" height="{height}" role="img" aria-label="{title}">',
             f"<title>{title}</title>",
             '<defs><marker id="arrow" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto"><path d="M0 0 L10 5 L0 10 z" fill="#51606f"/></marker></defs>',
             "<style>text{font-family:Helvetica,Arial,sans-serif;fill:#22303c}.t{font-size:16px;font-weight:bold}.m{font-size:15px;text-anchor:middle}.c{font-size:12.5px;fill:#51606f}"
             ".q{font-size:14px;text-anchor:middle}.b{stroke:#8a99a8;stroke-width:1}.a{fill:none;stroke:#51606f;stroke-width:1.5;marker-end:url(#arrow)}</style>",
             f'<rect width="1160" height="{height}" fill="#fbfcfd"/>',
             '<text x="40" y="34" class="t">Modules: a file uses only what stands above it, or to its left</text><text x="850" y="34" class="t">A query</text>']
    for k, (fill, names, comment) in enumerate(ROWS):
        names, y = names.split(), TOP + STEP * k
        width = (430 - 10 * (len(names) - 1)) / len(names)
        parts += [box(40 + n * (width + 10), y, width, fill, name, "m") for n, name in enumerate(names)]
        parts.append(f'<text x="484" y="{y + 28}" class="c">{comment}</text>')
        if k + 1 < len(ROWS):
            parts.append(arrow(255, y))
    for k, text in enumerate(QUERY):
        y = TOP + STEP * k
        parts.append(box(850, y, 280, "#ffffff", text, "q"))
        if k + 1 < len(QUERY):
            parts.append(arrow(990, y))
    low, high = (TOP + STEP * k + HEIGHT // 2 for k in (5, 2))
    parts.append(f'<path d="M1130 {low} h16 V{high} h-11" class="a"/>')
    print("\n".join([*parts, "</svg>"]))


if __name__ == "__main__":
    main()
