"""Which parameters of a face lie inside its wires: even-odd on dense polygons in (u, v), for many points at once."""

from __future__ import annotations

from typing import Any

import numpy as np

ROWS = 1024
PER_EDGE = 512


class Trims:
    """The wires of a face as polygons.

    A foot nearer to a wire than the error of the polygon (that of 512 chords an edge) may fall on the wrong side; the edge is then as near
    within that error.
    """

    def __init__(self, face: Any):
        self._face = face
        u0, u1, v0, v1 = face.ParameterRange
        self._low, self._size = np.array([u0, v0]), np.array([u1 - u0, v1 - v0])
        surface = face.Surface
        turns = [surface.UPeriod() if surface.isUPeriodic() else 0.0, surface.VPeriod() if surface.isVPeriodic() else 0.0]
        self._turns = np.array(turns) / self._size
        loops = [self._loop(wire) for wire in face.Wires]
        #: FreeCAD is asked for each point when the wires do not close in (u, v).
        self._closed = all(loop is not None for loop in loops)
        self.everything = self._closed and all(self._on_border(loop) for loop in loops) and len(loops) == 1
        if self._closed and not self.everything:
            self._segments = np.concatenate([np.concatenate([loop, np.roll(loop, -1, 0)], 1) for loop in loops])

    def _loop(self, wire: Any) -> Any:
        pieces = []
        for edge in wire.OrderedEdges:
            found = self._face.curveOnSurface(edge)
            if found is None:
                return None
            curve, first, last = found[:3]
            at = np.linspace(first, last, 2 if "Line" in type(curve).__name__ else PER_EDGE)
            points = np.array([(p.x, p.y) for p in map(curve.value, at)])
            pieces.append(((points[::-1] if edge.Orientation == "Reversed" else points) - self._low) / self._size)
        for before, after in zip(pieces, pieces[1:] + pieces[:1]):
            if np.abs(before[-1] - after[0]).max() > 1e-3:
                return None
        return np.concatenate(pieces) if pieces else None

    @staticmethod
    def _on_border(loop: np.ndarray) -> bool:
        return bool((np.minimum(np.abs(loop), np.abs(loop - 1)).min(1) < 1e-9).all())

    def inside(self, uv: np.ndarray) -> np.ndarray:
        """Whether FreeCAD's parameters (n, 2) belong to the face, (n,) bool."""
        at = (uv - self._low) / self._size
        for k, turn in enumerate(self._turns):
            if turn:
                at[:, k] = np.where((at[:, k] < -1e-9) | (at[:, k] > 1 + 1e-9), np.mod(at[:, k], turn), at[:, k])
        if self.everything:
            return ((at >= -1e-9) & (at <= 1 + 1e-9)).all(1)
        if not self._closed:
            return np.array([self._face.isPartOfDomain(float(u), float(v)) for u, v in uv], bool)
        inside = np.zeros(len(at), bool)
        row = np.clip((at[:, 1] * ROWS).astype(int), 0, ROWS - 1)
        order = np.argsort(row, kind="stable")
        ends = np.searchsorted(row[order], np.arange(ROWS + 1))
        ua, va, ub, vb = self._segments.T
        low, high = np.minimum(va, vb), np.maximum(va, vb)
        for k in np.flatnonzero(np.diff(ends)):
            mine = order[ends[k] : ends[k + 1]]
            near = (high >= k / ROWS) & (low <= (k + 1) / ROWS) if 0 < k < ROWS - 1 else slice(None)
            a, b, c, d = ua[near], va[near], ub[near], vb[near]
            for part in np.array_split(mine, max(1, len(mine) * len(a) // 2_000_000)):
                u, v = at[part, 0][:, None], at[part, 1][:, None]
                crossed = (b <= v) != (d <= v)
                with np.errstate(divide="ignore", invalid="ignore"):
                    right = a + (v - b) * (c - a) / (d - b) > u
                inside[part] = np.count_nonzero(crossed & right, 1) % 2 == 1
        return inside
