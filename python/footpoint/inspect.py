"""Inspection: how curves and surfaces bend, with proven ranges; how far shapes are apart; how they meet; pictures.

>>> import footpoint
>>> parabola = footpoint.Curve.from_poles(2, [[-1, 1], [0, -1], [1, 1]])
>>> found = footpoint.inspect.curvature_range(parabola)
>>> found.proven, bool(found.greatest[0] <= 2.0 <= found.greatest[1])
(True, True)
"""

from __future__ import annotations

import ctypes
import struct
import zlib
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _library as lib
from ._query import Call, address, array, integer, vector
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from os import PathLike

    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._query import InspectOptions

__all__ = ["Continuity", "Distance", "Kind", "Measured", "Pattern", "Picture", "Quantity", "Range", "Side", "border", "comb", "comb_svg", "curvature_range",
           "curvature_range_places", "curvatures", "hausdorff", "inflections", "monotone_pieces", "picture", "umbilics"]


class Quantity(IntEnum):
    """What of the curvature of a surface: greater and less principal one, their mean, their product, the greatest absolute one."""

    GREATER = 0
    LESS = 1
    MEAN = 2
    GAUSSIAN = 3
    SHARPEST = 4


class Side(IntEnum):
    """Which extremes of a range are looked for: both, the least or the greatest; what is known of the other one is true, but loose."""

    BOTH = 0
    LEAST = 1
    GREATEST = 2


class Pattern(IntEnum):
    """What a picture shows."""

    SHADED = 0
    ZEBRA = 1
    ISOPHOTES = 2
    REFLECTION_LINES = 3
    HIGHLIGHT_LINES = 4
    GREATER = 5
    LESS = 6
    MEAN = 7
    GAUSSIAN = 8


class Kind(IntEnum):
    """What a place is: a monotone piece (first four), an inflection, straight, a small or a large box of umbilics, a box that a range
    excludes (curvature has no bound there, proven; or nothing is proven)."""

    RISING = 0
    FALLING = 1
    CONSTANT = 2
    UNKNOWN = 3
    INFLECTION = 4
    STRAIGHT = 5
    UMBILIC = 6
    UMBILIC_AREA = 7
    UNBOUNDED = 8
    EXCLUDED = 9


TOOTH = np.dtype([("u", "f8"), ("point", "f8", 3), ("tangent", "f8", 3), ("bend", "f8", 3), ("curvature", "f8"), ("torsion", "f8")])
CURVATURES = np.dtype([("point", "f8", 3), ("normal", "f8", 3), ("principal", "f8", 2), ("directions", "f8", 6), ("mean", "f8"),
                       ("gaussian", "f8"), ("is_umbilic", "u4"), ("is_singular", "u4")])
PLACE = np.dtype([("u", "f8", 2), ("v", "f8", 2), ("value", "f8", 2), ("kind", "u4"), ("reserved", "u4")])


@dataclass(frozen=True)
class Range:
    """The least and the greatest value of a curvature, each between two bounds.

    least        nothing is less than least[0]; something is not greater than least[1]
    greatest     something is not less than greatest[0]; nothing is greater than greatest[1]
    at_least, at_greatest
                 parameters where the inner bounds are attained
    excluded     share of the domain that is left out (beside tips and cusps); the bounds hold for the rest
    moved        0: the bounds are those of the shape; otherwise those of a shape from which no point of this one is farther than this
                 length, which is rounding (beside a pole the rounding of coordinates alone makes curvatures infinite)
    boxes        boxes looked at
    proven       whether both gaps are the allowed ones and nothing is excluded
    unbounded    whether the least value falls below every number, and whether the greatest exceeds every number, in what is excluded:
                 proven where true; of SHARPEST the second one means that the least radius is 0
    rest_proven  whether both gaps are the allowed ones outside of what is excluded
    """

    least: tuple[float, float]
    greatest: tuple[float, float]
    at_least: tuple[float, float]
    at_greatest: tuple[float, float]
    excluded: float
    moved: float
    boxes: int
    proven: bool
    unbounded: tuple[bool, bool] = (False, False)
    rest_proven: bool = False

    @property
    def radius(self) -> tuple[float, float]:
        """Of SHARPEST, and of curves: no radius of curvature outside of what is excluded is less than the first; one is not greater
        than the second."""
        return tuple(1 / value if value > 0 else float("inf") for value in reversed(self.greatest))


@dataclass(frozen=True)
class Distance:
    """The greatest distance of a point of one shape from another: at least `lower`, at most `upper`, both proven."""

    lower: float
    upper: float
    at: tuple[float, float]
    boxes: int
    proven: bool


@dataclass(frozen=True)
class Measured:
    """A greatest value along a border: found somewhere (`lower`, at the parameter `at`), nowhere more (`upper`, proven)."""

    lower: float
    upper: float
    at: float


@dataclass(frozen=True)
class Continuity:
    """How two borders meet: gap (length), angle of the normals (radians), jump of the normal curvature across (1 / length)."""

    gap: Measured
    angle: Measured
    curvature: Measured
    intervals: int


@dataclass(frozen=True, eq=False)
class Picture:
    """Pixels, shape (height, width, 3), uint8, and the values of the ends of the colours of curvature."""

    pixels: np.ndarray
    range: tuple[float, float]

    def png(self) -> bytes:
        """The picture as the bytes of a PNG file."""
        height, width, _ = self.pixels.shape
        rows = np.zeros((height, 3 * width + 1), np.uint8)
        rows[:, 1:] = self.pixels.reshape(height, -1)

        def chunk(kind: bytes, data: bytes) -> bytes:
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b"")

    def save(self, path: str | PathLike[str]) -> None:
        """Writes a PNG file."""
        with open(path, "wb") as stream:
            stream.write(self.png())


def curvature_range(shape: Curve | Surface, quantity: int = Quantity.SHARPEST, **options: Unpack[InspectOptions]) -> Range:
    """The range of a curvature over a shape or a part of it, proven: no sampling.

    quantity  surfaces: a `Quantity`; of curves the curvature is meant
    options   see `InspectOptions`; domain, relative, budget, side, should_stop count
    """
    call, out = _call(shape, options), lib.InspectRange()
    if isinstance(shape, Curve):
        status = lib.call("inspect_curve_range", shape._handle, call.pointer, ctypes.addressof(out))
    else:
        kind = integer("quantity", quantity)
        status = lib.call("inspect_surface_range", _is(Surface, shape)._handle, kind, call.pointer, ctypes.addressof(out))
    call.finish(status)
    return _range(out)


def _range(out: lib.InspectRange) -> Range:
    return Range(tuple(out.least), tuple(out.greatest), tuple(out.at_least), tuple(out.at_greatest), out.excluded, out.moved, out.boxes, bool(out.proven),
                 (bool(out.flags & 1), bool(out.flags & 2)), bool(out.flags & 4))


def curvature_range_places(surface: Surface, quantity: int = Quantity.SHARPEST, **options: Unpack[InspectOptions]) -> tuple[Range, np.ndarray]:
    """As `curvature_range`, and the boxes that the range excludes: records u, v (the box), value, kind. UNBOUNDED: near the parameters
    `value` the quantity passes every bound, proven; EXCLUDED: nothing is proven there.

    options  see `InspectOptions`; domain, relative, budget, side, should_stop count
    """
    call, out = _call(_is(Surface, surface), options), lib.InspectRange()
    kind = integer("quantity", quantity)
    places = _set("inspect_surface_range_places", surface._handle, kind, call.pointer, ctypes.addressof(out), call=call)
    return _range(out), places


def comb(curve: Curve, parameters: ArrayLike | None = None) -> np.ndarray:
    """The teeth of a curvature comb: records u, point, tangent, bend (curvature times the unit normal), curvature, torsion.

    parameters  shape (n,) in the domain; None: 16 a span of knots
    """
    places = _places(curve) if parameters is None else array("parameters", parameters, (None,))
    out = np.zeros(len(places), TOOTH)
    lib.call("inspect_comb", _is(Curve, curve)._handle, address(places), len(places), address(out))
    return out


def curvatures(surface: Surface, parameters: ArrayLike) -> np.ndarray:
    """Records point, normal, principal (greater, less), directions (6 numbers), mean, gaussian, is_umbilic, is_singular.

    parameters  shape (n, 2)
    """
    places = array("parameters", parameters, (None, 2))
    out = np.zeros(len(places), CURVATURES)
    lib.call("inspect_curvatures", _is(Surface, surface)._handle, address(places), len(places), address(out))
    return out


def monotone_pieces(curve: Curve) -> np.ndarray:
    """The pieces on which the curvature of a curve is monotone: records u (both ends), value (curvature there), kind. Complete."""
    return _set("inspect_monotone_pieces", _is(Curve, curve)._handle)


def inflections(curve: Curve, normal: ArrayLike | None = None) -> np.ndarray:
    """Where a curve, seen along `normal`, changes the side to which it bends (kind INFLECTION) or is straight (STRAIGHT): records u
    (an interval), value (the parameter, 0), kind.

    normal  shape (3,); None: across the plane of the poles
    """
    along = None if normal is None else vector("normal", normal)
    return _set("inspect_inflections", _is(Curve, curve)._handle, address(along))


def umbilics(surface: Surface, **options: Unpack[InspectOptions]) -> np.ndarray:
    """Boxes outside of which the principal curvatures are proven to differ: records u, v (the box), value (their difference at the best
    place, 0), kind.

    options  see `InspectOptions`; domain, budget, should_stop count
    """
    call = _call(_is(Surface, surface), options)
    return _set("inspect_umbilics", surface._handle, call.pointer, call=call)


def hausdorff(first: Curve | Surface, second: Curve | Surface, **options: Unpack[InspectOptions]) -> tuple[Distance, Distance]:
    """The Hausdorff distance in both directions, between proven bounds; the distance itself is the greater of both.

    options  see `InspectOptions`; accuracy, budget, should_stop count
    """
    handles: list[Any] = []
    for name, shape in (("first", first), ("second", second)):
        if not isinstance(shape, (Curve, Surface)):
            raise TypeError(f"{name}: a Curve or Surface is needed, not {type(shape).__name__}")
        handles += [shape._handle, None] if isinstance(shape, Curve) else [None, shape._handle]
    call, out = _call(first, options), (lib.InspectDistance * 2)()
    status = lib.call("inspect_hausdorff", *handles, call.pointer, ctypes.addressof(out[0]), ctypes.addressof(out[1]))
    call.finish(status)
    one, two = (Distance(found.lower, found.upper, tuple(found.at), found.boxes, bool(found.proven)) for found in out)
    return one, two


def border(first: Surface, first_side: int, second: Surface, second_side: int, **options: Unpack[InspectOptions]) -> Continuity:
    """How a border of one surface meets a border of another; sides are 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1.

    options  see `InspectOptions`; should_stop counts
    """
    call, out = _call(_is(Surface, first), options), lib.InspectContinuity()
    sides = integer("first_side", first_side), integer("second_side", second_side)
    status = lib.call("inspect_border", first._handle, sides[0], _is(Surface, second)._handle, sides[1], call.pointer, ctypes.addressof(out))
    call.finish(status)
    parts = (Measured(part.lower, part.upper, part.at) for part in (out.gap, out.angle, out.curvature))
    return Continuity(*parts, out.intervals)


def picture(surface: Surface, pattern: int = Pattern.ZEBRA, *, size: tuple[int, int] = (640, 480), eye: ArrayLike | None = None,
            up: ArrayLike | None = None, light: ArrayLike | None = None, bands: int = 16, range: ArrayLike = (0, 0)) -> Picture:
    """A picture of a surface, seen from `eye` (a direction), the whole of it.

    pattern  a `Pattern`
    size     width and height in pixels
    light    direction towards the light and the plane of the lamps
    bands    stripes over the range of what they show
    range    values of the ends of the colours of curvature; (0, 0): what is seen
    """
    given = lib.InspectPictureOptions()
    lib.functions["inspect_picture_options_init"](ctypes.addressof(given), ctypes.sizeof(given))
    given.pattern, given.bands = integer("pattern", pattern), integer("bands", bands)
    given.width, given.height = (integer("size", part) for part in size)
    for name, value in (("eye", eye), ("up", up), ("light", light)):
        if value is not None:
            getattr(given, name)[:] = vector(name, value).tolist()
    given.range[:] = vector("range", range, 2).tolist()
    if max(given.width, given.height) > 8192:
        raise ValueError("size: 1 to 8192 pixels each accepted")
    pixels, ends = np.zeros((given.height, given.width, 3), np.uint8), np.zeros(2)
    lib.call("inspect_picture", _is(Surface, surface)._handle, ctypes.addressof(given), pixels.size, address(pixels), address(ends))
    return Picture(pixels, tuple(ends.tolist()))


def comb_svg(curve: Curve, *, scale: float = 0.0, size: int = 800) -> str:
    """The curve in the plane of x and y with its comb, as the text of an SVG file: inflections are dots on the curve, extrema of the curvature squares at the
    tips of their teeth.

    scale  length of a tooth for curvature 1; 0: the longest tooth is a fifth of the picture
    size   width in pixels
    """
    teeth = comb(curve)
    points = teeth["point"][:, :2]
    low, high = points.min(0), points.max(0)
    extent = max(float((high - low).max()), 1e-300)
    longest = float(teeth["curvature"].max())
    scale = scale or (0.2 * extent / longest if longest > 0 else 0.0)
    tips = points - scale * teeth["bend"][:, :2]
    low, high = np.minimum(low, tips.min(0)), np.maximum(high, tips.max(0))
    margin = 0.03 * float((high - low).max() or 1.0)
    low, high = low - margin, high + margin
    per = size / float((high - low)[0])
    height = max(1, round(per * float((high - low)[1])))

    def place(rows: np.ndarray) -> list[str]:
        return [f"{(x - low[0]) * per:.2f},{(high[1] - y) * per:.2f}" for x, y in np.atleast_2d(rows)[:, :2]]

    spines = "".join(f"M{a}L{b}" for a, b in zip(place(points), place(tips)))
    fine = curve.evaluate(np.linspace(*curve.domain, 800))
    dots = [found for found in inflections(curve, (0, 0, 1)) if found["kind"] == Kind.INFLECTION]
    circles = "".join('<circle cx="{}" cy="{}" r="4" fill="#c0392b"/>'.format(*place(curve.evaluate(dot["value"][0]))[0].split(",")) for dot in dots)
    squares = "".join('<rect class="extremum" x="{:.2f}" y="{:.2f}" width="6" height="6" fill="white" stroke="#2468b0"/>'.format(*(float(part) - 3 for part in at.split(",")))
                      for at in place(_extreme_tips(curve, scale)))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{height}" viewBox="0 0 {size} {height}">'
            f'<rect width="100%" height="100%" fill="white"/><path d="{spines}" stroke="#7aa6d8" stroke-width="0.7" fill="none"/>'
            f'<polyline points="{" ".join(place(tips))}" stroke="#2468b0" fill="none"/>'
            f'<polyline points="{" ".join(place(fine))}" stroke="black" stroke-width="1.6" fill="none"/>{circles}{squares}</svg>\n')


def _extreme_tips(curve: Curve, scale: float) -> np.ndarray:
    """The tips of the teeth where the curvature is greatest or least, and not 0: it rises on one side and falls on the other."""
    pieces = monotone_pieces(curve)
    pieces = pieces[pieces["kind"] != Kind.CONSTANT]
    is_turn = np.isin(pieces["kind"], (Kind.RISING, Kind.FALLING))
    turns = is_turn[:-1] & is_turn[1:] & (pieces["kind"][:-1] != pieces["kind"][1:])
    turns &= pieces["value"][1:, 0] > 1e-6 * pieces["value"].max(initial=0.0)
    teeth = comb(curve, pieces["u"][1:, 0][turns])
    return teeth["point"] - scale * teeth["bend"]


def _is(kind: type, shape: Any) -> Any:
    if not isinstance(shape, kind):
        raise TypeError(f"{kind.__name__.lower()}: a {kind.__name__} is needed, not {type(shape).__name__}")
    return shape


def _call(shape: Any, options: dict[str, Any]) -> Call:
    return Call(options, "curve" if isinstance(shape, Curve) else "surface", struct_type=lib.InspectOptions)


def _places(curve: Curve) -> np.ndarray:
    """Sixteen parameters a span of knots."""
    start, end = curve.domain
    knots = np.unique(curve.knots)
    knots = knots[(knots >= start) & (knots <= end)]
    return np.concatenate([np.linspace(a, b, 16, endpoint=False) for a, b in zip(knots, knots[1:])] + [[end]])


def _set(name: str, *arguments: Any, call: Call | None = None) -> np.ndarray:
    """The places of a set, copied out of its handle."""
    out, count = ctypes.c_void_p(), ctypes.c_size_t()
    status = lib.call(name, *arguments, ctypes.byref(out))
    try:
        if call is not None:
            call.finish(status)
        lib.call("inspect_set_count", out, ctypes.byref(count))
        rows = np.zeros(count.value, PLACE)
        for index in range(len(rows)):
            lib.call("inspect_set_get", out, index, address(rows) + index * rows.itemsize)
        return rows
    finally:
        lib.functions["inspect_set_free"](out)
