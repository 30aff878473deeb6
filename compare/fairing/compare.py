"""Fairing beside OpenMesh's smoother, OpenCASCADE's plate and its battens: compare.py PEERS FOLDER writes tables to stdout and pictures to FOLDER, SVG, of which docs/pictures has PNG (rsvg-convert).

PEERS is the program of peers.cpp, built with
    g++ -O2 -std=c++17 peers.cpp -I/usr/include/opencascade -lOpenMeshCore -lOpenMeshTools -lTKGeomAlgo -lTKGeomBase -lTKBRep -lTKG3d -lTKG2d -lTKMath -lTKernel
The surfaces are known and smooth; noise is added to a grid of their points. Everybody may move a point by the same length.
"""

import base64
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import footpoint
from footpoint import fair, inspect

N = 24


def knots_of(count):
    return np.concatenate([[0.0] * 4, np.arange(1, count - 3) / (count - 3), [1.0] * 4])


def greville(count):
    return np.convolve(knots_of(count)[1:-1], np.ones(3) / 3, "valid")


def interpolated(points):
    """The bicubic surface through a grid of points at Greville's abscissae."""
    at = greville(N)
    basis = np.array([footpoint.Curve(3, knots_of(N), np.column_stack([np.eye(N)[k], np.zeros((N, 2))])).evaluate(at)[:, 0] for k in range(N)]).T
    poles = np.einsum("ij,jkl->ikl", np.linalg.inv(basis), points)
    poles = np.einsum("ij,kjl->kil", np.linalg.inv(basis), poles)
    return footpoint.Surface(3, 3, knots_of(N), knots_of(N), poles)


def energy(surface):
    """Thin plate energy of the height, by sums over a fine grid."""
    u = np.linspace(0.005, 0.995, 150)
    grid = np.stack(np.meshgrid(u, u, indexing="ij"), -1).reshape(-1, 2)
    _, _, suu, suv, svv = np.moveaxis(np.asarray(surface.evaluate(grid, 2))[:, 1:, 2], 1, 0)
    return float((suu**2 + 2 * suv**2 + svv**2).mean())


def bends(points):
    """Integrals of k^2 and of (dk/ds)^2 along a polyline, and its length."""
    ways = np.diff(points[:, :2], axis=0)
    lengths = np.linalg.norm(ways, axis=1)
    angles = np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))
    between = (lengths[1:] + lengths[:-1]) / 2
    curvature = np.diff(angles) / between
    apart = (between[1:] + between[:-1]) / 2
    return float((curvature**2 * between).sum()), float((np.diff(curvature) ** 2 / apart).sum()), float(lengths.sum())


def battens(peers, folder):
    """Curves between two ends with given tangents: OpenCASCADE's FairCurve and the curve of least slope that fairing makes of a cubic."""
    print("\n| angles with the chord | by | integral of k^2 | of (dk/ds)^2 | length | ms |\n|---|---|---|---|---|---|")
    parts = []
    for row, (first, last) in enumerate([(0.6, 0.6), (0.9, 0.3), (0.5, -0.5)]):
        lines = subprocess.run([peers, "0", "0", "1", "0", str(first), str(last)], capture_output=True, text=True, check=True).stdout.split("\n")
        found = {}
        for k in [k for k, line in enumerate(lines) if line and line[0].isalpha()]:
            label, spent = lines[k].split()
            found[f"FairCurve_{label}"] = (np.array([line.split() for line in lines[k + 1 : k + 402]], float), float(spent))
        # The tangents that the batten has; a cubic with them, over twelve spans.
        points = found["FairCurve_Batten"][0]
        ends = [points[1] - points[0], points[-1] - points[-2]]
        ends = [way / np.linalg.norm(way) for way in ends]
        cubic = footpoint.Curve.from_poles(3, np.array([points[0], points[0] + 0.36 * ends[0], points[-1] - 0.36 * ends[1], points[-1]]))
        cubic = footpoint.operate.refine(cubic, np.arange(1, 12) / 12)
        start = time.perf_counter()
        report = fair.curve(cubic, 0.3, strain=0.0, slope=1.0, steps=300)
        spent = 1e3 * (time.perf_counter() - start)
        found["footpoint slope"] = (np.asarray(report.shape.evaluate(np.linspace(0, 1, 401))), spent)
        for column, (label, (points, spent)) in enumerate(found.items()):
            square, slope, length = bends(points)
            # FairCurve leaves the chord where it computes nothing.
            told = f"{slope:.3f}" if square > 1e-9 else "not computed"
            print(f"| {first}, {last} | {label} | " + (f"{square:.4f} | {slope:.4f} | {length:.4f}" if square > 1e-9 else "not computed | |") + f" | {spent:.1f} |")
            ways = np.gradient(points[:, :2], axis=0)
            turns = np.gradient(np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))) / np.linalg.norm(ways, axis=1)
            normals = np.column_stack([-ways[:, 1], ways[:, 0]]) / np.linalg.norm(ways, axis=1)[:, None]
            tips = points[:, :2] - 0.06 * turns[:, None] * normals
            at = lambda rows: " ".join(f"{40 + 380 * column + 300 * x:.1f},{(150, 350, 520)[row] - 300 * y:.1f}" for x, y in rows)
            teeth = "".join(f'<polyline points="{at([a, b])}" stroke="#7aa6d8" stroke-width="0.6"/>' for a, b in zip(points[::6, :2], tips[::6]))
            parts.append(f'{teeth}<polyline points="{at(tips)}" fill="none" stroke="#2468b0"/><polyline points="{at(points[:, :2])}" fill="none" stroke="black" stroke-width="1.6"/>'
                         f'<text x="{40 + 380 * column}" y="{(30, 220, 410)[row]}" font-family="sans-serif" font-size="12">{label}: {told}</text>')
    text = f'<svg xmlns="http://www.w3.org/2000/svg" width="1140" height="600"><rect width="100%" height="100%" fill="white"/>{"".join(parts)}</svg>\n'
    (folder / "fairing_battens.svg").write_text(text, encoding="utf-8")


def main(peers, folder):
    folder = Path(folder)
    at = greville(N)
    u, v = np.meshgrid(at, at, indexing="ij")
    shapes = {"hull": 0.1 * (1 - (2 * u - 1) ** 2) * (1 - v**2),
              "bumper": -0.4 * (u - 0.5) ** 4 - 0.15 * (v - 0.4) ** 2 - 0.1 * (u - 0.5) ** 2}
    print("| shape | by | energy / true energy | greatest motion | rms of the error | ms |\n|---|---|---|---|---|---|")
    cells = []
    for row, (name, height) in enumerate(shapes.items()):
        random = np.random.default_rng(7)
        noise = 1e-3 * random.uniform(-1, 1, (N, N))
        noise[[0, 1, -2, -1]] = noise[:, [0, 1, -2, -1]] = 0
        true, noisy = np.stack([u, v, height], -1), np.stack([u, v, height + noise], -1)
        before, deviation = interpolated(noisy), 2e-3
        ideal = energy(interpolated(true))
        found = {"noisy": (noisy, 0.0)}
        for label, options in (("footpoint plate", {}), ("footpoint jerk", {"strain": 0.0, "jerk": 1.0}),
                               ("footpoint knot lines", {"method": fair.Method.KNOT_REMOVAL})):
            start = time.perf_counter()
            report = fair.surface(before, deviation, **options)
            spent = 1e3 * (time.perf_counter() - start)
            grid = np.stack([u, v], -1).reshape(-1, 2)
            found[label] = (np.asarray(report.shape.evaluate(grid)).reshape(N, N, 3), spent)
        text = "\n".join(" ".join(map(repr, map(float, row))) for row in noisy.reshape(-1, 3))
        lines = subprocess.run([peers, str(N), str(deviation)], input=text, capture_output=True, text=True, check=True).stdout.split("\n")
        heads = [k for k, line in enumerate(lines) if line and line[0].isalpha()]
        for k in heads:
            label, spent = lines[k].split()
            rows = np.array([line.split() for line in lines[k + 1 : k + 1 + N * N]], float)
            found[label] = (rows.reshape(N, N, 3), float(spent))
        for column, (label, (points, spent)) in enumerate(found.items()):
            surface = interpolated(points)
            moved = np.linalg.norm(points - noisy, axis=-1).max()
            error = np.sqrt(((points - true) ** 2).sum(-1).mean())
            print(f"| {name} | {label} | {energy(surface) / ideal:.3f} | {moved:.2e} | {error:.2e} | {spent:.0f} |")
            made = inspect.picture(surface, inspect.Pattern.ZEBRA, size=(300, 240), eye=(0.4, -0.9, 1.3), bands=40)
            data = base64.b64encode(made.png()).decode()
            cells.append(f'<image x="{300 * column}" y="{24 + 260 * row}" width="300" height="240" href="data:image/png;base64,{data}"/>'
                         f'<text x="{8 + 300 * column}" y="{18 + 260 * row}" font-family="sans-serif" font-size="14">{name}: {label}</text>')
    text = f'<svg xmlns="http://www.w3.org/2000/svg" width="1800" height="520"><rect width="100%" height="100%" fill="white"/>{"".join(cells)}</svg>\n'
    (folder / "fairing_peers.svg").write_text(text, encoding="utf-8")
    battens(peers, folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
