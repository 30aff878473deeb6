"""The command `footpoint`: invert and closest for files of points, plot for a picture.

A shape is a file: an NPZ with degree, knots, poles, weights (curves) or degree_u, degree_v, knots_u, knots_v, poles, weights
(surfaces); JSON with the same names; or the text form of the test cases. `save_shape` writes the first.
"""

from __future__ import annotations

import argparse
import csv
import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from . import Cancelled, Curve, Flag, Surface, version

COLUMNS = ["u", "v", "x", "y", "z", "distance", "lower_bound", "flags"]


class Refused(Exception):
    """What is told on one line, with exit code 2."""


def save_shape(path: str | Path, shape: Curve | Surface) -> None:
    """Writes a shape as NPZ."""
    weights = {"weights": shape.weights} if shape.is_rational else {}
    if isinstance(shape, Curve):
        np.savez(path, degree=shape.degree, knots=shape.knots, poles=shape.poles, **weights)
    else:
        (du, dv), (ku, kv) = shape.degrees, shape.knots
        np.savez(path, degree_u=du, degree_v=dv, knots_u=ku, knots_v=kv, poles=shape.poles, **weights)


def load_shape(path: str | Path) -> Curve | Surface:
    """Reads a shape: NPZ, JSON or the text form."""
    file = Path(path)
    if file.suffix == ".npz":
        with np.load(file) as stored:
            return _from_names({name: stored[name] for name in stored.files}, file)
    if file.suffix == ".json":
        return _from_names(json.loads(file.read_text(encoding="utf-8")), file)
    return _from_text(file)


def _from_names(names: dict[str, Any], file: Path) -> Curve | Surface:
    wanted = ["degree", "knots", "poles"] if "degree" in names else ["degree_u", "degree_v", "knots_u", "knots_v", "poles"]
    missing = [name for name in wanted if name not in names]
    if missing:
        raise Refused(f"{file}: {', '.join(missing)} missing")
    kind = Curve if "degree" in names else Surface
    values = [int(names[name]) if name.startswith("degree") else np.asarray(names[name], float) for name in wanted]
    weights = names.get("weights")
    return kind(*values, None if weights is None else np.asarray(weights, float))


def _from_text(file: Path) -> Curve | Surface:
    words = file.read_text(encoding="utf-8").split()
    try:
        if words[0] == "curve":
            degree, count = int(words[1]), int(words[2])
            numbers = np.array(words[5:], float)
            knots, rest = numbers[: count + degree + 1], numbers[count + degree + 1 :].reshape(count, 4)
            return Curve(degree, knots, rest[:, :3], rest[:, 3] if words[3] == "1" else None)
        if words[0] == "surface":
            du, dv, nu, nv = (int(word) for word in words[1:5])
            numbers = np.array(words[6:], float)
            lengths = nu + du + 1, nv + dv + 1
            ku, kv, rest = np.split(numbers, [lengths[0], sum(lengths)])
            rest = rest.reshape(nu, nv, 4)
            return Surface(du, dv, ku, kv, rest[..., :3], rest[..., 3] if words[5] == "1" else None)
    except (IndexError, ValueError) as error:
        raise Refused(f"{file}: {error}") from error
    raise Refused(f"{file}: a shape is NPZ, JSON, or text that begins with curve or surface")


def load_points(path: str) -> np.ndarray:
    """Reads points: NPY of shape (n, 3), or CSV whose first three columns (or those named x, y, z) are numbers."""
    file = Path(path)
    if file.suffix == ".npy":
        return np.load(file, allow_pickle=False)
    with open(file, newline="", encoding="utf-8") as stream:
        rows = [row for row in csv.reader(stream) if row and not row[0].startswith("#")]
    picked = [0, 1, 2]
    if rows and not _is_number(rows[0][0]):
        head = [name.strip().lower() for name in rows.pop(0)]
        if {"x", "y", "z"} <= set(head):
            picked = [head.index(name) for name in "xyz"]
    try:
        return np.array([[float(row[k]) for k in picked] for row in rows]).reshape(-1, 3)
    except (IndexError, ValueError) as error:
        raise Refused(f"{file}: {error}") from error


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def save_feet(path: str, feet: Any) -> None:
    """Writes feet: NPY with the records, else CSV with the columns of COLUMNS."""
    if path.endswith(".npy"):
        np.save(path, np.asarray(feet))
        return
    table = np.column_stack([feet.u, feet.v, feet.point, feet.distance, feet.lower_bound])
    stream = sys.stdout if path == "-" else open(path, "w", newline="", encoding="utf-8")
    try:
        out = csv.writer(stream, lineterminator="\n")
        out.writerow(COLUMNS)
        out.writerows([*map(repr, row), bits] for row, bits in zip(table.tolist(), feet.flag_bits.tolist()))
    finally:
        if stream is not sys.stdout:
            stream.close()


def summary(feet: Any, seconds: float) -> str:
    """Lines that tell how the answers are."""
    count = feet.size
    lines = [f"points        {count:,} in {seconds:.3f} s" + (f" ({seconds / count * 1e6:.2f} us each)" if count else ""),
             f"proven        {int(feet.proven.sum()):,}"]
    good = feet.distance[np.isfinite(feet.distance)]
    if good.size:
        lines.append(f"distance      {good.min():.6g} to {good.max():.6g}, mean {good.mean():.6g}, 99 % below {np.quantile(good, 0.99):.6g}")
    lines += [f"{flag.name.lower():14}{number:,}" for flag in Flag if (number := int(feet.has(flag).sum()))]
    return "\n".join(lines)


def query(arguments: argparse.Namespace) -> int:
    """invert and closest."""
    shape, points = load_shape(arguments.shape), load_points(arguments.points)
    options: dict[str, Any] = {"tolerance": arguments.tolerance, "accuracy": arguments.accuracy, "threads": arguments.threads}
    if sys.stderr.isatty() and not arguments.quiet:
        options["progress"] = True
    start = time.perf_counter()
    feet = getattr(shape, arguments.command)(points, **options)
    seconds = time.perf_counter() - start
    save_feet(arguments.out, feet)
    if not arguments.quiet:
        print(summary(feet, seconds), file=sys.stderr)
    return 0


def plot(arguments: argparse.Namespace) -> int:
    """A picture of shape, points and feet."""
    from .plot import picture

    points = load_points(arguments.points) if arguments.points else None
    picture(load_shape(arguments.shape), points, arguments.out)
    return 0


def parser() -> argparse.ArgumentParser:
    """The command line."""
    top = argparse.ArgumentParser(prog="footpoint", description="Parameters of points on NURBS curves and surfaces, with a proof.")
    top.add_argument("--version", action="version", version=f"footpoint {version()}")
    commands = top.add_subparsers(dest="command", required=True)
    for name, text in (("invert", "parameters of points that lie on the shape; others are marked"), ("closest", "nearest points")):
        one = commands.add_parser(name, help=text, description=text)
        one.add_argument("shape", help="NPZ, JSON or text file of a curve or surface")
        one.add_argument("points", help="CSV or NPY file with x, y, z")
        one.add_argument("-o", "--out", default="-", help="CSV or NPY file to write; -: CSV to the standard output")
        one.add_argument("--tolerance", type=float, default=0.0, help="how far counts as on the shape; 0: 1e-7 of the diagonal")
        one.add_argument("--accuracy", type=float, default=0.0, help="asked-for distance - lower_bound; 0: 1e-10 of the diagonal")
        one.add_argument("--threads", type=int, default=0, help="0: all cores")
        one.add_argument("-q", "--quiet", action="store_true", help="no progress bar, no summary")
        one.set_defaults(run=query)
    one = commands.add_parser("plot", help="a picture of the shape, points and their feet", description="Needs matplotlib.")
    one.add_argument("shape", help="NPZ, JSON or text file of a curve or surface")
    one.add_argument("points", nargs="?", help="CSV or NPY file with x, y, z")
    one.add_argument("-o", "--out", default="footpoint.png", help="PNG, SVG or PDF file to write")
    one.set_defaults(run=plot)
    return top


def main(arguments: list[str] | None = None) -> int:
    """Runs a command; 0: done, 2: refused with one line, 130: interrupted."""
    parsed = parser().parse_args(arguments)
    try:
        return parsed.run(parsed)
    except (Refused, OSError, ValueError, TypeError, NotImplementedError, ImportError) as error:
        print(f"footpoint: {error}", file=sys.stderr)
        return 2
    except (KeyboardInterrupt, Cancelled):
        print("footpoint: interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
