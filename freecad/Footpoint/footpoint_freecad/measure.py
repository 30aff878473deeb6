"""The computations of the commands, without a window."""

from __future__ import annotations

import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any, Callable

import numpy as np

from .settings import library, tolerance
from .trims import Trims

# Surfaces on which the distance from a point has one minimum inside, or none: where that lies outside the wires, an edge is nearest.
_ONE_MINIMUM = {"Plane", "Cylinder", "Sphere", "Toroid"}


@dataclass
class Nearest:
    """Nearest points of a part, one row a query.

    point (n, 3); distance (n,); lower_bound (n,): nothing of the part is nearer; face (n,): its number, -1 on an edge or where there is none
    """

    point: np.ndarray
    distance: np.ndarray
    lower_bound: np.ndarray
    face: np.ndarray
    signed: np.ndarray
    proven: np.ndarray


class PartTarget:
    """The faces of a shape, trimmed by their wires, and its edges; a shape without faces: its edges.

    The bounds are those of footpoint for surfaces and edges. Which side of a wire a foot lies on is decided in double precision with the
    edges' curves in (u, v) (see `Trims`) and is no proof.
    """

    def __init__(self, shape: Any):
        footpoint = library()
        self.faces, self.edges = list(shape.Faces), [edge for edge in shape.Edges if not edge.Degenerated]
        if not self.faces and not self.edges:
            raise ValueError("the selected shape has no faces and no edges")
        self.natives = [native_of_face(face) for face in self.faces]
        for number, native in enumerate(self.natives):
            if "function" in repr(native.shape):
                raise NotImplementedError(f"Face{number + 1} is a {type(self.faces[number].Surface).__name__}: no NURBS, and not in maps yet")
        self.trims = [Trims(face) for face in self.faces]
        self.surfaces = footpoint.Scene([native.shape for native in self.natives]) if self.faces else None
        curves = [native_of_edge(edge).shape for edge in self.edges]
        self.curves = footpoint.Scene(curves) if curves else None
        self.turned = np.array([face.Orientation == "Reversed" for face in self.faces], bool)
        self.solids = list(shape.Solids)
        numbers: dict[int, list[int]] = {}
        for number, face in enumerate(self.faces):
            for edge in face.Edges:
                numbers.setdefault(edge.hashCode(), []).append(number)
        #: Numbers of the faces that meet in each edge.
        self.beside = [sorted(set(numbers.get(edge.hashCode(), []))) for edge in self.edges]

    def nearest(self, points: np.ndarray, progress: Callable | None = None, should_stop: Callable | None = None) -> Nearest:
        """The nearest points of the part."""
        watch = {"should_stop": should_stop}
        if self.surfaces is None:
            feet, _ = self.curves.closest(points, progress=progress, **watch)
            none = np.full(len(points), -1)
            return Nearest(feet.point.copy(), feet.distance.copy(), feet.lower_bound.copy(), none, feet.distance.copy(), feet.proven)
        feet, members = self.surfaces.closest(points, progress=progress, **watch)
        signed, sides = self._sides(feet, members, points)
        face = np.where(members == library().NO_MEMBER, -1, members.astype(np.int64))
        found = Nearest(feet.point.copy(), feet.distance.copy(), feet.lower_bound.copy(), face, np.where(self.turned[face], -signed, signed), feet.proven)
        outside = ~self._inside(feet.uv, face)
        outside |= (sides & library().NormalFlag.AMBIGUOUS_SIDE) != 0  # a foot on a border: the faces that meet there tell the side
        outside &= face >= 0
        if outside.any() and self.curves is not None:
            self._beyond(points, np.flatnonzero(outside), found, watch)
        return found

    def _sides(self, feet: Any, members: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distances and flags, on all cores: a call of normals takes one, and lets Python go on meanwhile."""
        cores = os.cpu_count() or 1
        parts = [slice(len(feet) * k // cores, len(feet) * (k + 1) // cores) for k in range(cores)]
        with ThreadPoolExecutor(cores) as pool:
            found = list(pool.map(lambda part: self.surfaces.normals(feet[part], members[part], points[part])[1:], parts))
        return np.concatenate([one[0] for one in found]), np.concatenate([one[1] for one in found])

    def _inside(self, uv: np.ndarray, face: np.ndarray) -> np.ndarray:
        inside = np.zeros(len(face), bool)
        for number, (native, trim) in enumerate(zip(self.natives, self.trims)):
            mine = np.flatnonzero(face == number)
            if len(mine):
                inside[mine] = trim.inside(native.to_native(uv[mine]))
        return inside

    def _beyond(self, points: np.ndarray, rows: np.ndarray, found: Nearest, watch: dict) -> None:
        """Queries whose nearest surface point is cut away: edges, then every face that may still be nearer."""
        asked = points[rows]
        feet, edges = self.curves.closest(asked, **watch)
        best, bound, proven = feet.distance.copy(), feet.lower_bound.copy(), feet.proven.copy()
        place, face, signed = feet.point.copy(), np.full(len(rows), -1), feet.distance.copy()
        for number, (native, trim) in enumerate(zip(self.natives, self.trims)):
            low, high = native.shape.box
            may = np.flatnonzero(np.linalg.norm(np.maximum(0, np.maximum(low - asked, asked - high)), axis=1) < best)
            if not len(may):
                continue
            local = native.shape.closest(asked[may], **watch)
            inside = trim.inside(native.to_native(local.uv))
            _, sides, _ = native.shape.normals(local, asked[may])
            better = inside & (local.distance < best[may] * (1 - 1e-12))
            at = may[better]
            best[at], place[at], face[at] = local.distance[better], local.point[better], number
            signed[at] = -sides[better] if self.turned[number] else sides[better]
            # Below: the least of what was found on edges and inside wires, and of the bounds of what is not decided.
            bound[may[inside]] = np.minimum(bound[may[inside]], local.lower_bound[inside])
            proven[may] &= local.proven
            if type(self.faces[number].Surface).__name__ in _ONE_MINIMUM:
                continue
            for k in np.flatnonzero(~inside & (local.lower_bound < best[may])):
                row = may[k]
                others = native.shape.extrema(asked[row], radius=best[row], minima_only=True)
                proven[row] &= others.complete
                if not others.complete:
                    bound[row] = min(bound[row], local.lower_bound[k])
                for foot in others.feet[trim.inside(native.to_native(others.uv))]:
                    if foot.distance < best[row]:
                        best[row], place[row], face[row] = foot.distance, foot.point, number
                        _, side, _ = native.shape.normals(foot, asked[row])
                        signed[row] = -side if self.turned[number] else side
                        bound[row] = min(bound[row], float(foot.distance))
        on_edge = np.flatnonzero(face < 0)
        signed[on_edge] = np.where(self._beside_edges(asked[on_edge], feet[on_edge], edges[on_edge]), -best[on_edge], best[on_edge])
        found.distance[rows], found.point[rows], found.face[rows], found.signed[rows] = best, place, face, signed
        found.lower_bound[rows] = np.maximum(found.lower_bound[rows], np.minimum(bound, best))
        found.proven[rows] = proven


    def _beside_edges(self, asked: np.ndarray, feet: Any, edges: np.ndarray) -> np.ndarray:
        """Whether queries nearest to an edge are on the inner side, (n,) bool: by the sum of the normals of the faces that meet there;
        at corners, and where that does not tell, by FreeCAD's classification of the solid."""
        away = asked - feet.point
        normal = np.zeros_like(away)
        for edge in np.unique(edges):
            mine = np.flatnonzero(edges == edge)
            for number in self.beside[edge]:
                shape = self.natives[number].shape
                normals, _, _ = shape.normals(shape.closest(feet.point[mine]))
                normal[mine] += -normals if self.turned[number] else normals
        along = np.einsum("ij,ij->i", away, normal)
        length = np.linalg.norm(away, axis=1) * np.linalg.norm(normal, axis=1)
        inner = along < 0
        if len(self.solids) == 1:
            unclear = feet.has(library().Flag.EDGE) | ~(np.abs(along) > 1e-6 * length)
            for k in np.flatnonzero(unclear):
                inner[k] = self.solids[0].isInside(_vector(asked[k]), 1e-12, False)
        return inner


def _vector(point: Any) -> Any:
    import FreeCAD

    return FreeCAD.Vector(*(float(t) for t in point))


def native_of_face(face: Any) -> Any:
    """The NURBS form of the surface of a face, cut to the face's range of parameters."""
    footpoint = library()
    surface = face.Surface
    if type(surface).__name__ == "BSplineSurface" and not surface.isUPeriodic() and not surface.isVPeriodic():
        own, whole = face.ParameterRange, surface.bounds()
        ends = tuple(np.clip(own, (whole[0], whole[0], whole[2], whole[2]), (whole[1], whole[1], whole[3], whole[3])))
        if ends != whole:
            surface = surface.copy()
            surface.segment(*(float(end) for end in ends))
            return footpoint.convert.native_freecad(surface)
    return footpoint.convert.native_freecad(face)


def native_of_edge(edge: Any) -> Any:
    """The NURBS form of an edge: of its curve the part that it uses."""
    footpoint = library()
    curve = edge.Curve
    ends = edge.ParameterRange
    if type(curve).__name__ in ("BSplineCurve", "BezierCurve") and tuple(ends) != (curve.FirstParameter, curve.LastParameter):
        curve = curve.copy()
        curve.segment(*ends)
        return footpoint.convert.native_freecad(curve)
    return footpoint.convert.native_freecad(edge)


@dataclass
class Inversion:
    """What *Invert point* finds: parameters in FreeCAD's terms."""

    parameters: list[float]
    distance: float
    lower_bound: float
    proven: bool
    on_shape: bool
    point: tuple[float, ...]
    preimages: list[tuple[float, ...]] = field(default_factory=list)
    complete: bool = True


def invert(shape: Any, point: Any) -> Inversion:
    """Parameters of a point on a face or edge (its whole surface or curve), and all preimages."""
    footpoint = library()
    native = footpoint.convert.native_freecad(shape)
    at = tuple(point)
    foot = native.shape.invert(at, tolerance=tolerance())
    width = len(native.directions)
    uv = np.atleast_1d(native.to_native(foot.uv if width == 2 else foot.u))
    found = Inversion([float(t) for t in uv], float(foot.distance), float(foot.lower_bound), bool(foot.proven), bool(foot.on_shape), tuple(foot.point.tolist()))
    # What is off the shape has preimages of its foot.
    asked = at if found.on_shape else found.point
    others = native.shape.preimage(asked, tolerance() if found.on_shape else 0.0)
    values = native.to_native(others.uv if width == 2 else others.feet.u)
    found.preimages = [tuple(float(t) for t in np.atleast_1d(value)) for value in values]
    found.complete = others.complete
    return found


def closest(shape: Any, point: Any) -> Nearest:
    """The nearest point of a face, an edge or a whole part."""
    return PartTarget(shape).nearest(np.array([tuple(point)], float))


@dataclass
class Seams:
    """What *Check seams and poles* finds: lines of text; curves of the seams and points of the poles for drawing."""

    closed_u: bool
    closed_v: bool
    collapsed: list[str]
    text: list[str]
    seams: list[np.ndarray]
    poles: list[tuple[float, ...]]


def seams_and_poles(face: Any) -> Seams:
    """Closed directions and collapsed edges of the surface of a face, by geometry, and whether FreeCAD knows them."""
    footpoint = library()
    surface = face.Surface
    native = footpoint.convert.native_freecad(face)
    shape = native.shape
    (u0, u1), (v0, v1) = shape.domain
    closed_u, closed_v = shape.is_closed
    text, seams, poles = [], [], []
    for name, closed, known in (("u", closed_u, surface.isUPeriodic() or surface.isUClosed()), ("v", closed_v, surface.isVPeriodic() or surface.isVClosed())):
        if closed or known:
            text.append(f"{name}: {'closed' if closed else 'open in the range of the face'}; FreeCAD: {'closed' if known else 'open'}")
    steps = np.linspace(0, 1, 65)
    if closed_u:
        seams.append(shape.evaluate(np.stack([np.full(65, u0), v0 + (v1 - v0) * steps], 1)))
    if closed_v:
        seams.append(shape.evaluate(np.stack([u0 + (u1 - u0) * steps, np.full(65, v0)], 1)))
    names = ["start of u", "end of u", "start of v", "end of v"]
    corners = [(u0, v0), (u1, v0), (u0, v0), (u0, v1)]
    collapsed = [name for name, one in zip(names, shape.collapsed_edges) if one]
    for name, corner, one in zip(names, corners, shape.collapsed_edges):
        if one:
            poles.append(tuple(shape.evaluate(corner).tolist()))
            text.append(f"pole: the edge at the {name} is one point; parameters along it are free")
    return Seams(closed_u, closed_v, collapsed, text or ["no seams and no poles"], seams, poles)


@dataclass
class Deviation:
    """What *Deviation map* finds."""

    points: np.ndarray
    nearest: Nearest
    seconds: float

    def statistics(self) -> dict[str, float]:
        """Count, proven, least, greatest, mean, root of the mean square, 95 % (of the magnitude); in mm."""
        values = self.nearest.signed[np.isfinite(self.nearest.signed)]
        if not len(values):
            return {"count": 0}
        return {"count": len(values), "proven": int(self.nearest.proven.sum()), "least": float(values.min()), "greatest": float(values.max()),
                "mean": float(values.mean()), "rms": float(np.sqrt(np.mean(values**2))), "p95": float(np.quantile(np.abs(values), 0.95))}

    def limit(self) -> float:
        """The magnitude at which colours end."""
        return max(self.statistics().get("p95", 0.0), 1e-12)

    def colours(self) -> np.ndarray:
        """Red, green, blue of each point, (n, 3) in 0..1: blue inside, white at 0, red outside."""
        return colours(np.nan_to_num(self.nearest.signed / self.limit()))

    def save_csv(self, path: str) -> None:
        """One row a point: query, foot, signed distance, bound, face (from 1; 0: an edge)."""
        found = self.nearest
        table = np.column_stack([self.points, found.point, found.signed, found.lower_bound, found.face + 1])
        np.savetxt(path, table, delimiter=",", header="x,y,z,foot_x,foot_y,foot_z,deviation,lower_bound,face", comments="", fmt=["%.9g"] * 8 + ["%d"])


def colours(values: np.ndarray) -> np.ndarray:
    """Colours of numbers in -1..1."""
    stops = np.array([[0.12, 0.25, 0.69], [0.45, 0.66, 0.86], [0.93, 0.93, 0.90], [0.95, 0.62, 0.38], [0.72, 0.09, 0.13]])
    at = np.linspace(-1, 1, len(stops))
    return np.stack([np.interp(np.clip(values, -1, 1), at, stops[:, k]) for k in range(3)], -1)


def deviation(shape: Any, points: Any, progress: Callable | None = None, should_stop: Callable | None = None) -> Deviation:
    """Signed distances of points from a face or part: positive on the outer side of its faces."""
    asked = np.ascontiguousarray(points, float).reshape(-1, 3)
    start = time.perf_counter()
    found = PartTarget(shape).nearest(asked, progress, should_stop)
    return Deviation(asked, found, time.perf_counter() - start)


def points_of(thing: Any) -> np.ndarray:
    """Points of a document object (points, mesh), or of a file: CSV, XYZ, ASC, NPY, PLY, STL."""
    if isinstance(thing, str):
        if thing.endswith(".npy"):
            return np.load(thing, allow_pickle=False)
        if thing.lower().endswith((".csv", ".xyz", ".asc", ".txt")):
            with open(thing, encoding="utf-8") as stream:
                first = stream.readline()
            comma = "," if "," in first else None
            head = 0 if first[:1] in "-+.0123456789 " else 1
            return np.loadtxt(thing, delimiter=comma, skiprows=head, usecols=(0, 1, 2), ndmin=2)
        import Mesh

        return np.array([(p.x, p.y, p.z) for p in Mesh.Mesh(thing).Points])
    if hasattr(thing, "Points"):
        return np.array([(p.x, p.y, p.z) for p in thing.Points.Points]).reshape(-1, 3)
    if hasattr(thing, "Mesh"):
        return np.array([(p.x, p.y, p.z) for p in thing.Mesh.Points])
    raise TypeError("points: a point cloud, a mesh or a file is needed")
