"""Operations and constructions of footpoint on edges and faces, for macros and the console."""

from __future__ import annotations

from typing import Any

from . import fairing
from .settings import library


def call(name: str, *arguments: Any, **options: Any) -> Any:
    """Calls `footpoint.NAME`, as in "operate.simplify" or "construct.ruled". Edges, faces and curves or surfaces of Part among the arguments, also
    in lists, become footpoint's; curves and surfaces in the result become those of Part. All else stays: errors, lengths, records."""
    found = library()
    for part in name.split("."):
        found = getattr(found, part)
    return _out(found(*map(_in, arguments), **{key: _in(value) for key, value in options.items()}))


def _in(value: Any) -> Any:
    import Part

    if isinstance(value, Part.Shape):
        return fairing.of(value)
    if getattr(value, "TypeId", "").startswith("Part::Geom"):
        return library().from_freecad(value)
    return type(value)(map(_in, value)) if type(value) in (list, tuple) else value


def _out(value: Any) -> Any:
    if isinstance(value, (library().Curve, library().Surface)):
        return fairing.to_freecad(value)
    if isinstance(value, list):
        return [_out(one) for one in value]
    if isinstance(value, tuple):
        parts = [_out(one) for one in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value
