"""The shared library: where it is found, the C declarations, and C statuses as Python exceptions.

ctypes releases the GIL during every call. `tests/test_header.py` compares all that stands here with include/footpoint.h.
"""

from __future__ import annotations

import ctypes
import os
import sys
from ctypes import CFUNCTYPE, POINTER, c_char_p, c_double, c_int, c_int32, c_size_t, c_uint32, c_uint64, c_void_p
from pathlib import Path

ABI_VERSION = 1

StopFunction = CFUNCTYPE(c_int, c_void_p)
ProgressFunction = CFUNCTYPE(None, c_void_p, c_size_t, c_size_t)
TraceFunction = CFUNCTYPE(None, c_void_p, c_size_t, c_uint32, c_double, c_double, c_double)
CurveFunction = CFUNCTYPE(c_int32, c_void_p, c_double, c_uint32, POINTER(c_double))
SurfaceFunction = CFUNCTYPE(c_int32, c_void_p, c_double, c_double, c_uint32, POINTER(c_double))
ReleaseFunction = CFUNCTYPE(None, c_void_p)
RelationFunction = CFUNCTYPE(c_double, c_void_p, c_double)


class CurveData(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("degree", c_size_t), ("pole_count", c_size_t), ("knots", c_void_p),
                ("poles", c_void_p), ("weights", c_void_p)]


class SurfaceData(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("degree_u", c_size_t), ("degree_v", c_size_t), ("pole_count_u", c_size_t),
                ("pole_count_v", c_size_t), ("knots_u", c_void_p), ("knots_v", c_void_p), ("poles", c_void_p),
                ("weights", c_void_p)]


class CurveCallback(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("evaluate", CurveFunction), ("user", c_void_p), ("release", ReleaseFunction),
                ("domain", c_double * 2), ("speed_bound", c_double), ("second_bound", c_double)]


class SurfaceCallback(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("evaluate", SurfaceFunction), ("user", c_void_p), ("release", ReleaseFunction),
                ("domain", c_double * 4), ("speed_bounds", c_double * 2), ("second_bounds", c_double * 3)]


class QueryOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("accuracy", c_double), ("method", c_uint32),
                ("scope", c_uint32), ("hints", c_void_p), ("point_stride", c_size_t), ("hint_stride", c_size_t),
                ("domain", c_double * 4), ("threads", c_uint32), ("reserved", c_uint32), ("budget", c_uint64),
                ("should_stop", StopFunction), ("progress", ProgressFunction), ("trace", TraceFunction), ("user", c_void_p)]


class ExtremaOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("accuracy", c_double), ("radius", c_double), ("nearest", c_size_t),
                ("minima_only", c_uint32), ("reserved", c_uint32), ("domain", c_double * 4), ("budget", c_uint64),
                ("should_stop", StopFunction), ("user", c_void_p)]


class FootPoint(ctypes.Structure):
    _fields_ = [("u", c_double), ("v", c_double), ("point", c_double * 3), ("distance", c_double),
                ("lower_bound", c_double), ("flags", c_uint32), ("iterations", c_uint32)]


class FootMember(ctypes.Structure):
    _fields_ = [("foot", FootPoint), ("u", c_double * 2), ("v", c_double * 2), ("kind", c_uint32), ("nature", c_uint32)]


class SceneMember(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("curve", c_void_p), ("surface", c_void_p), ("placement", c_void_p)]


class SceneData(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("member_count", c_size_t), ("members", c_void_p)]


class WeightsOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("weight_min", c_double), ("weight_max", c_double), ("ratio_limit", c_double),
                ("tolerance", c_double), ("symmetric", c_uint32), ("steps", c_uint32), ("starts", c_uint32), ("reserved", c_uint32),
                ("seed", c_uint64), ("should_stop", StopFunction), ("user", c_void_p)]


class WeightsConstraint(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("reserved", c_uint32), ("u", c_double), ("v", c_double), ("vector", c_double * 3)]


class WeightsPole(ctypes.Structure):
    _fields_ = [("wish", c_double), ("chord_distance", c_double), ("first_guess", c_double), ("weight", c_double),
                ("distance", c_double), ("lower_bound", c_double), ("u", c_double), ("v", c_double), ("state", c_uint32),
                ("flags", c_uint32)]


class WeightsOutcome(ctypes.Structure):
    _fields_ = [("error", c_double), ("u", c_double), ("v", c_double), ("met", c_uint32), ("reserved", c_uint32)]


class WeightsSummary(ctypes.Structure):
    _fields_ = [("tolerance", c_double), ("iterations", c_uint64), ("starts", c_uint32), ("is_met", c_uint32), ("met", c_uint64),
                ("not_met", c_uint64), ("impossible", c_uint64)]


class WeightsConicShape(ctypes.Structure):
    _fields_ = [("weight", c_double), ("rho", c_double), ("eccentricity", c_double)]


class RelationCallback(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("forward", RelationFunction), ("backward", RelationFunction), ("user", c_void_p),
                ("release", ReleaseFunction), ("domain", c_double * 2)]


class ElementaryData(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("kind", c_uint32), ("reserved", c_uint32), ("domain", c_double * 4), ("origin", c_double * 3),
                ("x", c_double * 3), ("y", c_double * 3), ("z", c_double * 3), ("first", c_double), ("second", c_double),
                ("curve", c_void_p)]


class CoedgeData(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("flags", c_uint32), ("edge", c_size_t), ("values", c_double * 8), ("points", c_void_p),
                ("parameters", c_void_p), ("point_count", c_size_t), ("curve", c_void_p)]


class LoopData(ctypes.Structure):
    _fields_ = [("is_inner", c_uint32), ("reserved", c_uint32), ("coedges", c_void_p), ("coedge_count", c_size_t)]


class EdgeData(ctypes.Structure):
    _fields_ = [("curve", c_void_p), ("point", c_double * 3), ("reversed", c_uint32), ("reserved", c_uint32)]


class TrimData(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("support", c_void_p), ("edges", c_void_p), ("edge_count", c_size_t), ("loops", c_void_p),
                ("loop_count", c_size_t), ("flipped", c_uint32), ("reserved", c_uint32)]


class ChangeOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("replacement", c_uint32), ("reserved", c_uint32)]


class ChangeSummary(ctypes.Structure):
    _fields_ = [("deviation", c_double), ("surface_deviation", c_double), ("proven", c_uint32), ("reserved", c_uint32)]


class TrimFinding(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("reserved", c_uint32), ("loop_index", c_size_t), ("coedge", c_size_t), ("parameter", c_double),
                ("other_loop", c_size_t), ("other_coedge", c_size_t), ("other_parameter", c_double), ("numbers", c_double * 3)]


class TrimSummary(ctypes.Structure):
    _fields_ = [("tolerance", c_double), ("largest_opening", c_double), ("largest_gap", c_double), ("segment_error", c_double),
                ("proven", c_uint32), ("reserved", c_uint32), ("finding_count", c_size_t)]


class HitOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("chord", c_double), ("budget", c_uint64), ("threads", c_uint32),
                ("reserved", c_uint32), ("should_stop", StopFunction), ("progress", ProgressFunction), ("user", c_void_p)]


class Quadric(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("reserved", c_uint32), ("origin", c_double * 3), ("axis", c_double * 3), ("size", c_double),
                ("matrix", c_double * 6), ("linear", c_double * 3), ("constant", c_double)]


class CurveHit(ctypes.Structure):
    _fields_ = [("u", c_double), ("v", c_double), ("w", c_double), ("point", c_double * 3), ("distance", c_double),
                ("u_range", c_double * 2), ("v_range", c_double * 2), ("w_range", c_double * 2), ("nature", c_uint32),
                ("multiplicity", c_uint32)]


class RayHit(ctypes.Structure):
    _fields_ = [("t", c_double), ("u", c_double), ("v", c_double), ("point", c_double * 3), ("flags", c_uint32), ("count", c_uint32)]


class Branch(ctypes.Structure):
    _fields_ = [("point_count", c_size_t), ("ends", c_uint32 * 2), ("tangential", c_uint32), ("reserved", c_uint32)]


class SectionPoint(ctypes.Structure):
    _fields_ = [("u", c_double), ("v", c_double), ("point", c_double * 3), ("distance", c_double), ("arms", c_uint32),
                ("reserved", c_uint32)]


class SectionRegion(ctypes.Structure):
    _fields_ = [("domain", c_double * 4), ("overlaps", c_uint32), ("reserved", c_uint32)]


class Conic(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("reserved", c_uint32), ("center", c_double * 3), ("axes", c_double * 6), ("lengths", c_double * 2)]


STRUCTS: dict[str, type[ctypes.Structure]] = {
    "fpt_curve_data": CurveData, "fpt_surface_data": SurfaceData, "fpt_curve_callback": CurveCallback,
    "fpt_surface_callback": SurfaceCallback, "fpt_query_options": QueryOptions, "fpt_extrema_options": ExtremaOptions,
    "fpt_foot_point": FootPoint, "fpt_foot_member": FootMember, "fpt_scene_member": SceneMember, "fpt_scene_data": SceneData,
    "fpt_weights_options": WeightsOptions, "fpt_weights_constraint": WeightsConstraint, "fpt_weights_pole": WeightsPole,
    "fpt_weights_outcome": WeightsOutcome, "fpt_weights_summary": WeightsSummary, "fpt_weights_conic_shape": WeightsConicShape,
    "fpt_relation_callback": RelationCallback, "fpt_elementary_data": ElementaryData, "fpt_coedge_data": CoedgeData,
    "fpt_loop_data": LoopData, "fpt_edge_data": EdgeData, "fpt_trim_data": TrimData, "fpt_change_options": ChangeOptions,
    "fpt_change_summary": ChangeSummary, "fpt_trim_finding": TrimFinding, "fpt_trim_summary": TrimSummary,
    "fpt_hit_options": HitOptions, "fpt_quadric": Quadric, "fpt_curve_hit": CurveHit, "fpt_ray_hit": RayHit, "fpt_branch": Branch,
    "fpt_section_point": SectionPoint, "fpt_section_region": SectionRegion, "fpt_conic": Conic,
}

# One letter an argument: p pointer (arrays, handles, structs), z size_t, d double, I uint32_t, i int32_t.
_LETTERS = {"p": c_void_p, "z": c_size_t, "d": c_double, "I": c_uint32, "i": c_int32}
_STATUS = {
    "curve_new": "pp", "curve_domain": "pp", "curve_evaluate": "pdIp", "curve_evaluate_many": "ppzIp", "curve_degree": "pp",
    "curve_pole_count": "pp", "curve_knots": "pzp", "curve_poles": "pzp", "curve_weights": "pzp", "curve_box": "pp",
    "curve_is_rational": "pp", "curve_is_closed": "pp", "curve_prepare": "p", "curve_memory": "pp",
    "surface_new": "pp", "surface_domain": "pp", "surface_evaluate": "pddIp", "surface_evaluate_many": "ppzIp",
    "surface_degree_u": "pp", "surface_degree_v": "pp", "surface_pole_count_u": "pp", "surface_pole_count_v": "pp",
    "surface_knots_u": "pzp", "surface_knots_v": "pzp", "surface_poles": "pzp", "surface_weights": "pzp", "surface_box": "pp",
    "surface_is_rational": "pp", "surface_is_closed_u": "pp", "surface_is_closed_v": "pp", "surface_collapsed_edges": "pp",
    "surface_prepare": "p", "surface_memory": "pp", "curve_from_callback": "pp", "surface_from_callback": "pp",
    "curve_closest": "ppzpp", "curve_invert": "ppzpp", "surface_closest": "ppzpp", "surface_invert": "ppzpp",
    "curve_closest_f32": "ppzpp", "curve_invert_f32": "ppzpp", "surface_closest_f32": "ppzpp", "surface_invert_f32": "ppzpp",
    "curve_preimage": "ppdpp", "surface_preimage": "ppdpp", "curve_extrema": "pppp", "surface_extrema": "pppp",
    "foot_set_count": "pp", "foot_set_get": "pzp", "foot_set_undecided_count": "pp", "foot_set_undecided_get": "pzp",
    "curve_on_line": "ppppdpp", "surface_on_line": "ppppdpp", "curve_project": "ppzppp", "surface_project": "ppzppp",
    "surface_normals": "pppzppp", "curve_tangents": "ppzpp", "curve_evaluate_sided": "pdiIp",
    "surface_evaluate_sided": "pddiiIp", "curve_uncertainty": "ppzdp", "surface_uncertainty": "ppzdp",
    "curve_unwrap": "pddp", "surface_unwrap": "pppp", "curve_path": "ppzpppp", "surface_path": "ppzpppp",
    "scene_new": "pp", "scene_count": "pp", "scene_shape": "pIpp", "scene_placement": "pIp", "scene_box": "pp",
    "scene_memory": "pp", "scene_prepare": "p", "scene_evaluate": "pIddIp", "scene_closest": "ppzpppp",
    "scene_invert": "ppzpppp", "scene_closest_f32": "ppzpppp", "scene_invert_f32": "ppzpppp", "scene_normals": "ppppzppp",
    "weights_general": "ppzpp", "weights_interpolated": "pddpp", "weights_network": "pppzddpp", "weights_refine_curve": "pppzpzpp",
    "weights_refine_surface": "pppzpzpp", "weights_report_pole_count": "pp", "weights_report_pole": "pzp",
    "weights_report_weights": "pzp", "weights_report_constraint": "pzp", "weights_report_summary": "pp", "weights_report_curve": "pp",
    "weights_report_surface": "pp", "weights_move_point": "pdzdp", "weights_through_point": "pzpdpp", "weights_conic": "ppp",
    "weights_of_rho": "dp", "weights_of_eccentricity": "pdpp", "weights_normalise": "pzIp", "weights_bound": "pzdp",
    "weights_standard_form": "pp", "weights_positive_form": "zzppp",
    "relation_linear": "ppp", "relation_circle": "Idppp", "relation_through": "ppzp", "relation_piecewise": "pzp",
    "relation_from_callback": "pp", "relation_inverse": "pp", "relation_then": "ppp", "relation_domain": "ppp",
    "relation_apply": "ppzp", "transform_new": "ppIp", "transform_inverse": "pp", "transform_then": "ppp",
    "transform_domain": "pppp", "transform_apply": "ppzp", "support_new": "pp", "support_elementary": "pp", "support_domain": "pp",
    "support_evaluate": "ppzp", "support_spline": "ppp", "support_spline_transform": "ppp", "support_match": "ppdp",
    "support_match_many": "ppdpzIp", "trim_new": "pp", "trim_whole": "pp", "trim_support": "pp", "trim_counts": "pppp",
    "trim_loop": "pzpp", "trim_coedge": "pzzpp", "trim_coedge_points": "pzzzpp", "trim_coedge_curve": "pzzp",
    "trim_coedge_evaluate": "pzzpzppp", "trim_edge": "pzppp", "trim_change": "pppppp", "trim_reparametrise": "ppppp",
    "trim_to_nurbs": "ppppp", "trim_to_elementary": "pppppp", "trim_follow": "ppppp", "trim_merge": "ppIppp",
    "trim_report_new": "pdp", "trim_report_summary": "pp", "trim_report_get": "pzp", "trim_to_json": "pzpp",
    "trim_from_json": "pzp", "trim_picture": "ppzpzpp",
    "intersect_curves": "pppp", "intersect_surface_curve": "pppp", "intersect_curve_quadric": "pppp", "curve_hits_count": "pp",
    "curve_hits_get": "pzp", "curve_hits_undecided_count": "pp", "curve_hits_undecided_get": "pzp",
    "intersect_surface_quadrics": "ppzpp", "sections_counts": "pzp", "sections_branch_get": "pzzp", "sections_branch_points": "pzzzp",
    "sections_point_get": "pzzp", "sections_region_get": "pzzp", "intersect_quadrics": "ppdpp", "caster_new": "ppp",
    "caster_first": "pppzppp", "caster_all": "pppzppp", "ray_hits_count": "pp", "ray_hits_get": "pzp", "ray_hits_starts": "pzp",
    "ray_hits_flags": "pzp",
}
_OTHER = {
    "last_error": ("", c_char_p), "status_name": ("i", c_char_p), "version": ("", c_uint32), "abi_version": ("", c_uint32),
    "query_options_init": ("pz", None), "extrema_options_init": ("pz", None),
    "weights_options_init": ("pz", None), "weights_report_free": ("p", None), "curve_free": ("p", None),
    "surface_free": ("p", None), "foot_set_free": ("p", None), "scene_free": ("p", None),
    "change_options_init": ("pz", None), "relation_free": ("p", None), "transform_free": ("p", None), "support_free": ("p", None),
    "trim_free": ("p", None), "trim_report_free": ("p", None),
    "hit_options_init": ("pz", None), "curve_hits_free": ("p", None), "sections_free": ("p", None), "caster_free": ("p", None),
    "ray_hits_free": ("p", None),
}
PROTOTYPES = {name: (letters, c_int32) for name, letters in _STATUS.items()} | _OTHER

OK, NULL_ARGUMENT, INVALID_ARGUMENT, BUDGET_EXHAUSTED, CANCELLED, UNSUPPORTED, OUT_OF_MEMORY, INTERNAL = 0, 1, 2, 3, 4, 5, 6, 99


class Cancelled(RuntimeError):
    """A call that `should_stop` ended. `feet` holds the records that were ready; the rest is NaN and marked not proven."""

    feet = None


def _candidates() -> list[Path]:
    """The files to try: the one that FOOTPOINT_LIBRARY names, else the one that the package carries."""
    named = os.environ.get("FOOTPOINT_LIBRARY")
    if named:
        return [Path(named)]
    name = {"win32": "footpoint.dll", "darwin": "libfootpoint.dylib"}.get(sys.platform, "libfootpoint.so")
    return [Path(__file__).with_name(name)]


def load(path: Path) -> dict[str, "ctypes._FuncPointer"]:
    """The functions of the library, by their name without fpt_."""
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise ImportError(
            f"the footpoint library cannot be loaded from {path}: {error}. Install the wheel (pip install ./python), or let the "
            "environment variable FOOTPOINT_LIBRARY name the library file") from error
    functions = {}
    for name, (letters, result) in PROTOTYPES.items():
        try:
            function = getattr(library, f"fpt_{name}")
        except AttributeError as error:
            raise ImportError(f"{path} has no fpt_{name}: it is another version of the library") from error
        function.argtypes = [_LETTERS[letter] for letter in letters]
        function.restype = result
        functions[name] = function
    if functions["abi_version"]() != ABI_VERSION:
        raise ImportError(f"{path} has binary interface {functions['abi_version']()}, this package needs {ABI_VERSION}")
    return functions


PATH = _candidates()[0]
functions = load(PATH)


def call(name: str, *arguments) -> int:
    """Calls a function that returns a status; FPT_OK, FPT_BUDGET_EXHAUSTED and FPT_CANCELLED are returned, others raised."""
    status = functions[name](*arguments)
    if status not in (OK, BUDGET_EXHAUSTED, CANCELLED):
        raise failure(status)
    return status


def failure(status: int) -> Exception:
    """The exception that says what the calling thread's last failure says."""
    text = functions["last_error"]().decode()
    if status in (NULL_ARGUMENT, INVALID_ARGUMENT):
        return ValueError(text)
    if status == UNSUPPORTED:
        return NotImplementedError(text)
    if status == OUT_OF_MEMORY:
        return MemoryError(text)
    if status == CANCELLED:
        return Cancelled(text)
    return RuntimeError(f"{functions['status_name'](status).decode()}: {text}")


def version() -> str:
    """The version of the library in use.

    >>> version()
    '0.1.0'
    """
    number = functions["version"]()
    return f"{number // 1_000_000}.{number // 1000 % 1000}.{number % 1000}"


def abi_version() -> int:
    """The binary interface of the library in use."""
    return functions["abi_version"]()
