"""What comes back: records of feet as numpy arrays, sets of feet, and the bits and kinds in them."""

from __future__ import annotations

import ctypes
from enum import IntEnum, IntFlag
from typing import Any, Iterator

import numpy as np

from . import _library as lib


class Flag(IntFlag):
    """The bits of a foot's flags; README.md explains each."""

    NOT_PROVEN = 1
    EDGE = 2
    CORNER = 4
    SEAM = 8
    COLLAPSED = 16
    TIE = 32
    CONTINUUM = 64
    NOT_ON_SHAPE = 128
    BAD_QUERY = 256
    HINT_USED = 512
    BUDGET = 1024
    CREASE = 2048


class NormalFlag(IntFlag):
    """The bits that come with normals and tangents."""

    AMBIGUOUS_SIDE = 1
    CREASE = 2
    LIMIT = 4
    UNDEFINED = 8


class PathChange(IntFlag):
    """The bits of what changed on the step to a point of a path."""

    JUMP = 1
    SEAM_CROSSED = 2
    THROUGH_COLLAPSED = 4
    TIE = 8


class Method(IntEnum):
    """The local iteration. Global answers are proven with each."""

    AUTO = 0
    MAF = 1
    NEWTON = 2
    OSCULATING = 3


class Scope(IntEnum):
    """The whole shape with proof, or one local iteration."""

    GLOBAL = 0
    LOCAL = 1


class Kind(IntEnum):
    """What the parameters of a member of a set form."""

    POINT = 0
    ARC_U = 1
    ARC_V = 2
    REGION = 3


class Nature(IntEnum):
    """What the distance does around a member of a set."""

    MINIMUM = 0
    MAXIMUM = 1
    SADDLE = 2
    FLAT = 3


FOOT = np.dtype([("u", "f8"), ("v", "f8"), ("point", "f8", 3), ("distance", "f8"), ("lower_bound", "f8"), ("flags", "u4"),
                 ("iterations", "u4")])
MEMBER = np.dtype([("foot", FOOT), ("u", "f8", 2), ("v", "f8", 2), ("kind", "u4"), ("nature", "u4")])
assert FOOT.itemsize == ctypes.sizeof(lib.FootPoint) and MEMBER.itemsize == ctypes.sizeof(lib.FootMember)


class Feet(np.ndarray):
    """Foot points: a numpy array of the records of the C interface (64 bytes each), with the fields as attributes.

    A call with points of shape (..., 3) gives Feet of shape (...): one point gives a single record. Attributes are views of
    the same memory. The field `flags` is `flag_bits`, since numpy has an attribute of that name; ``feet["flags"]`` works too.

    >>> import footpoint
    >>> segment = footpoint.Curve.from_poles(1, [[0, 0, 0], [4, 0, 0]])
    >>> foot = segment.closest([1, 2, 0])
    >>> round(float(foot.u), 12), float(foot.distance), bool(foot.proven)
    (0.25, 2.0, True)
    """

    def __new__(cls, shape: Any = ()) -> "Feet":
        return np.zeros(shape, FOOT).view(cls)

    def __getitem__(self, key: Any) -> Any:
        item = super().__getitem__(key)
        if isinstance(item, np.void) and item.dtype == FOOT:
            return np.asarray(item, FOOT).view(Feet)
        return item.view(np.ndarray) if isinstance(item, Feet) and item.dtype != FOOT else item

    def _field(self, name: str) -> Any:
        return self.view(np.ndarray)[name]

    @property
    def u(self) -> np.ndarray:
        """First parameter, shape (...), in the unit of the knots."""
        return self._field("u")

    @property
    def v(self) -> np.ndarray:
        """Second parameter, shape (...); 0 on a curve."""
        return self._field("v")

    @property
    def uv(self) -> np.ndarray:
        """Both parameters, shape (..., 2): a view, not a copy."""
        u = np.asarray(self._field("u"))
        return np.lib.stride_tricks.as_strided(u, (*u.shape, 2), (*u.strides, 8))

    @property
    def point(self) -> np.ndarray:
        """The shape at the parameters, shape (..., 3), in the unit of the poles."""
        return self._field("point")

    @property
    def distance(self) -> np.ndarray:
        """From the query to the point, shape (...), in the unit of the poles."""
        return self._field("distance")

    @property
    def lower_bound(self) -> np.ndarray:
        """Proven: nothing on the shape is nearer, shape (...)."""
        return self._field("lower_bound")

    @property
    def flag_bits(self) -> np.ndarray:
        """Sums of `Flag` values, shape (...)."""
        return self._field("flags")

    @property
    def iterations(self) -> np.ndarray:
        """Evaluations of the shape spent, shape (...)."""
        return self._field("iterations")

    def has(self, flag: int) -> np.ndarray:
        """Where all bits of `flag` are set, shape (...)."""
        return (self.flag_bits & np.uint32(flag)) == np.uint32(flag)

    @property
    def proven(self) -> np.ndarray:
        """Where the distance is proven to be the least, shape (...)."""
        return (self.flag_bits & np.uint32(Flag.NOT_PROVEN | Flag.BAD_QUERY)) == 0

    @property
    def on_shape(self) -> np.ndarray:
        """Where `invert` did not mark the point as off the shape, nor as bad, shape (...)."""
        return (self.flag_bits & np.uint32(Flag.NOT_ON_SHAPE | Flag.BAD_QUERY)) == 0


class FootSet:
    """A set of feet that is complete, or says where it is not.

    `members` is an array of records: foot (as in `Feet`), u and v (the interval that belongs to the member), kind, nature.
    """

    def __init__(self, members: np.ndarray, undecided: np.ndarray):
        self.members = members
        #: Boxes u0, u1, v0, v1 in which more members may lie, shape (k, 4).
        self.undecided = undecided

    @property
    def complete(self) -> bool:
        """True when no member can be missing."""
        return len(self.undecided) == 0

    @property
    def feet(self) -> Feet:
        """The representatives, shape (n,): a view of the members."""
        return self.members["foot"].view(Feet)

    @property
    def uv(self) -> np.ndarray:
        """Their parameters, shape (n, 2)."""
        return self.feet.uv

    @property
    def kinds(self) -> list[Kind]:
        """What the parameters of each member form."""
        return [Kind(kind) for kind in self.members["kind"]]

    @property
    def natures(self) -> list[Nature]:
        """What the distance does around each member (extrema)."""
        return [Nature(nature) for nature in self.members["nature"]]

    def __len__(self) -> int:
        return len(self.members)

    def __iter__(self) -> Iterator[np.void]:
        return iter(self.members)

    def __getitem__(self, index: int) -> np.void:
        return self.members[index]

    def __repr__(self) -> str:
        open_ = "" if self.complete else f", {len(self.undecided)} boxes undecided"
        return f"FootSet({len(self)} members{open_})"


def take_set(handle: ctypes.c_void_p) -> FootSet:
    """Copies a set out of its handle and releases that."""
    try:
        count = ctypes.c_size_t()
        lib.call("foot_set_count", handle, ctypes.byref(count))
        members = np.zeros(count.value, MEMBER)
        for index in range(count.value):
            lib.call("foot_set_get", handle, index, members.ctypes.data + index * MEMBER.itemsize)
        lib.call("foot_set_undecided_count", handle, ctypes.byref(count))
        undecided = np.zeros((count.value, 4))
        for index in range(count.value):
            lib.call("foot_set_undecided_get", handle, index, undecided.ctypes.data + index * 32)
    finally:
        lib.functions["foot_set_free"](handle)
    return FootSet(members, undecided)
