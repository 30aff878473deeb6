"""Fairing beside OpenMesh's smoother and OpenCASCADE's plate: compare.py PEERS FOLDER writes a table to stdout and pictures to FOLDER.

PEERS is the program of peers.cpp, built with
    g++ -O2 -std=c++17 peers.cpp -I/usr/include/opencascade -lOpenMeshCore -lOpenMeshTools -lTKGeomAlgo -lTKGeomBase -lTKBRep -lTKG3d -lTKMath -lTKernel
The surfaces are known and smooth; noise is added to a grid of their points. Everybody may move a point by the same length.
"""

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


def main(peers, folder):
    folder = Path(folder)
    at = greville(N)
    u, v = np.meshgrid(at, at, indexing="ij")
    shapes = {"hull": 0.1 * (1 - (2 * u - 1) ** 2) * (1 - v**2),
              "bumper": -0.4 * (u - 0.5) ** 4 - 0.15 * (v - 0.4) ** 2 - 0.1 * (u - 0.5) ** 2}
    print("| shape | by | energy / true energy | greatest motion | rms of the error | ms |\n|---|---|---|---|---|---|")
    for name, height in shapes.items():
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
        pictures = []
        for label, (points, spent) in found.items():
            surface = interpolated(points)
            moved = np.linalg.norm(points - noisy, axis=-1).max()
            error = np.sqrt(((points - true) ** 2).sum(-1).mean())
            print(f"| {name} | {label} | {energy(surface) / ideal:.3f} | {moved:.2e} | {error:.2e} | {spent:.0f} |")
            pictures.append(inspect.picture(surface, inspect.Pattern.ZEBRA, size=(300, 240), eye=(0.4, -0.9, 1.3), bands=40).pixels)
        inspect.Picture(np.concatenate(pictures, 1), (0, 0)).save(folder / f"fairing_{name}.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
