"""Many placed curves and surfaces, searched together."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

from . import _library as lib
from ._feet import Feet
from ._handle import Handle
from ._query import Call, Points, address, array, integer
from ._shapes import Curve, Surface, asked_of, records_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._query import QueryOptions

NO_MEMBER = 2**32 - 1


class Scene(Handle):
    """Many curves and surfaces, each where a rigid motion puts it. Members are numbered from 0 as they come.

    shapes      Curve or Surface each, not from functions; the same shape may come several times, its index is built once
    placements  one per shape, or None: shape (3, 4) or (4, 4), rotation and translation; None: the shape stands where it is

    >>> import footpoint
    >>> square = footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 2, 0]], [[2, 0, 0], [2, 2, 0]]])
    >>> lifted = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5]]
    >>> scene = footpoint.Scene([square, square], [None, lifted])
    >>> feet, members = scene.closest([[1, 1, 1], [1, 1, 4.5]])
    >>> members.tolist(), feet.distance.tolist()
    ([0, 1], [1.0, 0.5])
    """

    _kind = "scene"

    def __init__(self, shapes: Iterable[Curve | Surface], placements: Iterable[ArrayLike | None] | None = None):
        members = list(shapes)
        for index, shape in enumerate(members):
            if not isinstance(shape, (Curve, Surface)):
                raise TypeError(f"shapes: member {index} is a {type(shape).__name__}, not a Curve or Surface")
        places = [None] * len(members) if placements is None else list(placements)
        if len(places) != len(members):
            raise ValueError(f"placements: there are {len(places)} for {len(members)} shapes")
        self._new(members, [_rows(index, place) for index, place in enumerate(places)])

    def _new(self, shapes: list, rows: list[np.ndarray | None]) -> None:
        data = (lib.SceneMember * max(len(shapes), 1))()
        for member, shape, place in zip(data, shapes, rows):
            member.struct_size = ctypes.sizeof(lib.SceneMember)
            setattr(member, shape._kind, shape._handle)
            member.placement = address(place)
        head = lib.SceneData(ctypes.sizeof(lib.SceneData), len(shapes), ctypes.addressof(data))
        out = ctypes.c_void_p()
        lib.call("scene_new", ctypes.addressof(head), ctypes.byref(out))
        self._shapes, self._rows = shapes, rows
        self._own(out.value)

    def _renew(self) -> None:
        self._new(self._shapes, self._rows)

    def __reduce__(self) -> tuple:
        return Scene, (self._shapes, self._rows)

    def __len__(self) -> int:
        return self._number("count", ctypes.c_size_t)

    def __repr__(self) -> str:
        return f"Scene({len(self)} members)"

    def shape(self, member: int) -> Curve | Surface:
        """A member's shape, not placed; it shares everything with the member."""
        curve, surface = ctypes.c_void_p(), ctypes.c_void_p()
        self._call("shape", integer("member", member), ctypes.byref(curve), ctypes.byref(surface))
        kind, pointer = (Curve, curve) if curve.value else (Surface, surface)
        shape = kind.__new__(kind)
        shape._own(pointer.value)
        shape._indexed = self._indexed
        return shape

    def placement(self, member: int) -> np.ndarray:
        """Where a member stands, as it is used: shape (3, 4), rotation and translation."""
        out = np.zeros((3, 4))
        self._call("placement", integer("member", member), address(out))
        return out

    def evaluate(self, member: int, uv: ArrayLike, derivatives: int = 0) -> np.ndarray:
        """A member's point and derivatives where it stands.

        uv       shape (2,), of a curve u alone or shape (1,)
        returns  as `Curve.evaluate` or `Surface.evaluate` for one pair
        """
        number, order = integer("member", member), integer("derivatives", derivatives, 0, 31)
        at = array("uv", uv).reshape(-1)
        width = 1 if number < len(self._shapes) and isinstance(self._shapes[number], Curve) else 2
        if at.size != width:
            raise ValueError(f"uv: {at.size} numbers, and must be {width}")
        terms = order + 1 if width == 1 else (order + 1) * (order + 2) // 2
        out = np.zeros((terms, 3))
        self._call("evaluate", number, float(at[0]), float(at[-1]), order, address(out))
        return out[0] if order == 0 else out

    def _query(self, name: str, points: ArrayLike, hint_members: ArrayLike | None, options: dict) -> tuple[Feet, np.ndarray]:
        asked = Points(points)
        call = Call(options, "scene", asked)
        hinted = None if hint_members is None else array("hint_members", hint_members, dtype=np.uint32)
        if hinted is not None and hinted.size != asked.count:
            raise ValueError(f"hint_members: {hinted.size} numbers, and there are {asked.count} queries")
        feet, members = Feet(asked.count), np.zeros(asked.count, np.uint32)
        status = self._call(name + asked.suffix, address(asked.rows), asked.count, call.pointer, address(hinted), address(feet), address(members))
        call.finish(status, feet.reshape(asked.shape))
        self._indexed = True
        return feet.reshape(asked.shape), members.reshape(asked.shape)

    def closest(self, points: ArrayLike, hint_members: ArrayLike | None = None, **options: Unpack[QueryOptions]) -> tuple[Feet, np.ndarray]:
        """The nearest point of all members for each query point, with a lower bound that holds for all.

        points        shape (..., 3), float64 or float32, as for `Surface.closest`
        hint_members  the member to begin with, shape (...); `NO_MEMBER`: no hint. `hints` are then (u, v) of that member
        options       see `QueryOptions`; domain and trace are not supported
        returns       Feet (...) with parameters of the member and the point where it stands; numbers of the members (...), uint32,
                      `NO_MEMBER` where there is no foot
        """
        return self._query("closest", points, hint_members, options)

    def invert(self, points: ArrayLike, hint_members: ArrayLike | None = None, **options: Unpack[QueryOptions]) -> tuple[Feet, np.ndarray]:
        """Members and parameters of points in the scene: as `closest`, with `Flag.NOT_ON_SHAPE` beyond the tolerance."""
        return self._query("invert", points, hint_members, options)

    def normals(self, feet: Feet, members: ArrayLike, points: ArrayLike | None = None) -> tuple[np.ndarray, np.ndarray | None, np.ndarray]:
        """The unit normal of the member at each foot, and on which side of it the query lies: as `Surface.normals`."""
        records = records_of(feet)
        numbers = array("members", members, dtype=np.uint32)
        if numbers.shape != records.shape:
            raise ValueError(f"members: the shape is {numbers.shape} and must be {records.shape}")
        asked = asked_of(records, points)
        normals, flags = np.zeros((*records.shape, 3)), np.zeros(records.shape, np.uint32)
        signed = None if asked is None else np.zeros(records.shape)
        self._call("normals", address(asked), address(records), address(numbers), records.size, address(normals), address(signed), address(flags))
        return normals, signed, flags


def _rows(index: int, place: Any) -> np.ndarray | None:
    if place is None:
        return None
    matrix = array(f"placements: member {index}", place)
    if matrix.shape == (4, 4):
        if not np.array_equal(matrix[3], [0, 0, 0, 1]):
            raise ValueError(f"placements: member {index}: the last row is not 0, 0, 0, 1")
        matrix = np.ascontiguousarray(matrix[:3])
    if matrix.shape != (3, 4):
        raise ValueError(f"placements: member {index}: the shape is {matrix.shape} and must be (3, 4) or (4, 4)")
    return matrix
