"""A contact sheet of the surfaces that footpoint.construct makes: python3 examples/constructions.py [out.png]. Needs matplotlib."""

import sys

import numpy as np

import footpoint
from footpoint import construct as c, operate

TURN = 2 * np.pi
COLOURS = {"surface": "#9fb8cc", "lines": "#30506b", "given": "#c03028"}


def wave(a, b, bulge, knots=5):
    """A cubic from a to b that swings by `bulge`."""
    t = np.linspace(0, 1, knots)[:, None]
    points = (1 - t) * np.asarray(a, float) + t * np.asarray(b, float)
    return c.interpolate(points + np.sin(np.pi * t) * np.asarray(bulge, float), parameters=t[:, 0])


def borders():
    """Four curves with common corners: u = 0, u = 1, v = 0, v = 1."""
    corner = {(0, 0): [0, 0, 0], (0, 1): [0, 4, 1], (1, 0): [5, 0, 1], (1, 1): [5, 4, 0]}
    return [wave(corner[0, 0], corner[0, 1], [-0.6, 0, 0.8]), wave(corner[1, 0], corner[1, 1], [0.6, 0, -0.8]),
            wave(corner[0, 0], corner[1, 0], [0, -0.5, 1.2]), wave(corner[0, 1], corner[1, 1], [0, 0.5, 0.9])]


def network():
    """Curves of one sheet, in u and in v, and where they are."""
    sheet = footpoint.Surface.from_poles(3, 3, [[[1.3 * i, 1.1 * j, 0.9 * ((2 * i + 3 * j) % 4)] for j in range(5)] for i in range(5)])
    u, v = [0, 0.3, 0.7, 1], [0, 0.4, 1]
    return [operate.isocurve(sheet, y, "v") for y in v], v, [operate.isocurve(sheet, x, "u") for x in u], u


def helix():
    t = np.linspace(0, 1, 60)
    return c.interpolate(np.stack([2 * np.cos(TURN * t), 2 * np.sin(TURN * t), 3 * t], 1), 5, parameters=t)


def shapes():
    """Name, surface, curves it was made from."""
    sides = borders()
    profile = wave([1, 0, 0], [1.6, 0, 3], [0.8, 0, 0])
    sections = [c.arc(1 + 0.5 * np.sin(z), axes=[[0.3 * z, 0, z], [0, 0, 1], [1, 0, 0]]) for z in (0, 1, 2, 3.2)]
    in_u, v, in_v, u = network()
    network_of_slopes = bicubic()
    spine = helix()
    start, tangent = spine.evaluate(0.0, 1)
    tube = c.arc(0.5, axes=[start, tangent, [1, 0, 0]])
    net = np.array([[[0, 0, 0], [0, 4, 1]], [[5, 0, 1], [5, 4, 0]]], float)
    along_u, along_v = np.broadcast_to([6.0, 0, 5], (2, 2, 3)), np.broadcast_to([0, 5.0, -4], (2, 2, 3))
    hill = footpoint.Surface.from_poles(3, 3, [[[i, j, 0.4 * ((i * j) % 3)] for j in range(5)] for i in range(5)])
    lifted, _, proven = c.fit_offset(hill, 0.5, 1e-3)
    cuff = c.swept(tube, spine, 1e-4)
    return [
        ("ellipsoid", c.quadric(c.QuadricKind.ELLIPSOID, [2, 1.5, 1], [0, 5], [-1.2, 1.2]), []),
        ("one sheet", c.quadric(c.QuadricKind.ONE_SHEET, [1, 0.8, 1], [0, TURN], [-1.2, 1.2]), []),
        ("two sheets", c.quadric(c.QuadricKind.TWO_SHEETS, [1, 1, 1], [0, TURN], [0, 1.5]), []),
        ("paraboloid", c.quadric(c.QuadricKind.PARABOLOID, [1, 1, 0.7], [0, TURN], [0, 1.6]), []),
        ("cone", c.quadric(c.QuadricKind.CONE, [1, 0.7, 1], [0, 5], [0.2, 2]), []),
        ("saddle", c.saddle(1, 1, [-1.5, 1.5, -1.5, 1.5]), []),
        ("torus", c.torus(2, 0.7, [0, 5], [0, TURN]), []),
        ("ruled", c.ruled(sides[2], sides[3]), sides[2:]),
        ("extruded", c.extruded(sides[2], [0, 3, 0.5]), [sides[2]]),
        ("revolved", c.revolved(profile, [0, 0, 0], [0, 0, 1], [0, 5]), [profile]),
        ("translational", c.translational(sides[2], sides[0]), [sides[2], sides[0]]),
        ("Coons", c.coons(sides), sides),
        ("bicubic Coons", c.coons(*network_of_slopes), network_of_slopes[0]),
        ("Ferguson", c.ferguson(net, along_u, along_v), []),
        ("Gordon", c.gordon(in_u, v, in_v, u), in_u + in_v),
        ("skinned", c.skinned(sections), sections),
        (f"swept, error below {cuff.error:.0e}", cuff.surface, [spine]),
        (f"offset, error below {proven:.0e}", lifted, [hill]),
    ]


def bicubic():
    """Borders of a bicubic sheet, and the slopes across them."""
    sheet = footpoint.Surface.from_poles(3, 3, [[[1.7 * i, 1.3 * j, 1.5 * ((i + 2 * j) % 3)] for j in range(4)] for i in range(4)])
    edges = [operate.isocurve(sheet, at, along) for along in "uv" for at in (0.0, 1.0)]
    return edges, [operate.isocurve(operate.derivative(sheet, along), at, along) for along in "uv" for at in (0.0, 1.0)]


def draw(axes, shape, given):
    (u0, u1), (v0, v1) = shape.domain
    grid = np.stack(np.meshgrid(np.linspace(u0, u1, 41), np.linspace(v0, v1, 41), indexing="ij"), -1)
    drawn = np.moveaxis(shape.evaluate(grid), -1, 0)
    axes.plot_surface(*drawn, color=COLOURS["surface"], linewidth=0, rcount=40, ccount=40, alpha=0.9)
    axes.plot_wireframe(*drawn, color=COLOURS["lines"], linewidth=0.35, rcount=10, ccount=10)
    for each in given:
        if isinstance(each, footpoint.Surface):
            base = np.moveaxis(each.evaluate(grid), -1, 0)
            axes.plot_surface(*base, color="#b0b0b0", linewidth=0, alpha=0.5)
        else:
            axes.plot(*each.evaluate(np.linspace(*each.domain, 121)).T, color=COLOURS["given"], linewidth=1.4)
    low, high = (f(f(drawn, axis=1), axis=1) for f in (np.min, np.max))
    axes.set_box_aspect(np.maximum(high - low, 0.2 * (high - low).max()))
    axes.set_axis_off()


def main(path: str) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(15, 8.2), layout="constrained")
    FigureCanvasAgg(figure)
    for k, (name, surface, given) in enumerate(shapes()):
        axes = figure.add_subplot(3, 6, k + 1, projection="3d")
        draw(axes, surface, given)
        axes.set_title(name, fontsize=10)
    figure.savefig(path, dpi=90)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "constructions.png")
