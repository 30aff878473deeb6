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
CorrectionFunction = CFUNCTYPE(None, c_void_p, c_uint32, ctypes.POINTER(c_double), c_double)
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
    _fields_ = [("deviation", c_double), ("surface_deviation", c_double), ("proven", c_uint32), ("surface_proven", c_uint32)]


class Difference(ctypes.Structure):
    _fields_ = [("bound", c_double), ("reached", c_double), ("u", c_double), ("v", c_double)]


class Estimate(ctypes.Structure):
    _fields_ = [("value", c_double), ("error", c_double)]


class CurveFrame(ctypes.Structure):
    _fields_ = [("point", c_double * 3), ("tangent", c_double * 3), ("normal", c_double * 3), ("binormal", c_double * 3),
                ("speed", c_double), ("curvature", c_double), ("torsion", c_double)]


class Joint(ctypes.Structure):
    _fields_ = [("u", c_double), ("multiplicity", c_uint32), ("order", c_uint32), ("gap", c_double), ("first_jump", c_double),
                ("tangent_angle", c_double), ("curvature_jump", c_double)]


class KnotLine(ctypes.Structure):
    _fields_ = [("value", c_double), ("multiplicity", c_uint32), ("order", c_uint32), ("gap", c_double), ("first_jump", c_double)]


class TrimFinding(ctypes.Structure):
    _fields_ = [("kind", c_uint32), ("reserved", c_uint32), ("loop_index", c_size_t), ("coedge", c_size_t), ("parameter", c_double),
                ("other_loop", c_size_t), ("other_coedge", c_size_t), ("other_parameter", c_double), ("numbers", c_double * 3)]


class TrimSummary(ctypes.Structure):
    _fields_ = [("tolerance", c_double), ("largest_opening", c_double), ("largest_gap", c_double), ("gap_bound", c_double),
                ("segment_error", c_double), ("proven", c_uint32), ("reserved", c_uint32), ("finding_count", c_size_t)]


class FitOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("degree_u", c_uint32), ("degree_v", c_uint32), ("spacing", c_uint32),
                ("condition", c_uint32), ("tangents", c_void_p), ("max_poles", c_size_t), ("keep_parameters", c_uint32),
                ("certify", c_uint32), ("threads", c_uint32), ("reserved", c_uint32), ("should_stop", StopFunction), ("user", c_void_p)]


class FitResult(ctypes.Structure):
    _fields_ = [("worst", c_double), ("at_least", c_double), ("rms", c_double), ("worst_index", c_uint64), ("unproven", c_uint64)]


class SweepOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("twist", c_double), ("degree", c_uint32), ("close", c_uint32),
                ("max_poles", c_size_t)]
class Deviation(ctypes.Structure):
    _fields_ = [("bound", c_double), ("reached", c_double), ("at", c_double), ("flags", c_uint32), ("reserved", c_uint32)]


class PullOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("degree", c_size_t), ("pole_limit", c_size_t), ("hint", c_void_p),
                ("should_stop", StopFunction), ("user", c_void_p)]


class LiftOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("tolerance", c_double), ("exact_degree", c_size_t)]


class FacePlace(ctypes.Structure):
    _fields_ = [("standing", c_uint32), ("loop_index", c_uint32), ("coedge_index", c_uint32), ("flags", c_uint32),
                ("parameter", c_double)]


class FaceData(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("surface", c_void_p), ("loop_count", c_size_t), ("coedge_counts", c_void_p),
                ("pcurves", c_void_p)]


class FaceOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("budget", c_uint64), ("should_stop", StopFunction), ("progress", ProgressFunction),
                ("user", c_void_p)]


class IntersectSurfacesOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("chord", c_double), ("budget", c_uint64), ("should_stop", StopFunction),
                ("progress", ProgressFunction), ("user", c_void_p), ("tolerance", c_double), ("method", c_uint32), ("corrector", c_uint32),
                ("levels", c_uint32), ("reserved", c_uint32), ("trace", CorrectionFunction)]


class IntersectionSummary(ctypes.Structure):
    _fields_ = [("branch_count", c_size_t), ("contact_count", c_size_t), ("overlap_count", c_size_t), ("undecided_count", c_size_t),
                ("pairs", c_uint64), ("is_proven", c_uint32), ("is_exhausted", c_uint32), ("is_stopped", c_uint32), ("reserved", c_uint32)]


class IntersectionBranch(ctypes.Structure):
    _fields_ = [("point_count", c_size_t), ("gap", c_double), ("chord", c_double), ("is_tangential", c_uint32),
                ("bounds_overlap", c_uint32), ("is_closed", c_uint32), ("reserved", c_uint32), ("end_kind", c_uint32 * 2),
                ("end_index", c_uint32 * 2)]


class IntersectionPoint(ctypes.Structure):
    _fields_ = [("point", c_double * 3), ("uv", c_double * 2), ("st", c_double * 2)]


class IntersectionContact(ctypes.Structure):
    _fields_ = [("place", IntersectionPoint), ("gap", c_double), ("radius", c_double), ("kind", c_uint32), ("reserved", c_uint32)]
class FairOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("deviation", c_double), ("strain", c_double), ("jerk", c_double), ("distance", c_double),
                ("method", c_uint32), ("by_length", c_uint32), ("ends", c_uint32 * 2), ("borders", c_uint32 * 4), ("fixed", c_void_p),
                ("fixed_count", c_size_t), ("through", c_void_p), ("through_count", c_size_t), ("knots", c_void_p), ("knot_count", c_size_t),
                ("length", c_double * 2), ("region", c_double * 4), ("steps", c_uint32), ("calm", c_uint32),
                ("should_stop", StopFunction), ("user", c_void_p), ("slope", c_double)]


class FairSummary(ctypes.Structure):
    _fields_ = [("energy_before", c_double), ("energy_after", c_double), ("deviation", c_double), ("steps", c_uint64),
                ("converged", c_uint32), ("reserved", c_uint32)]


class InspectOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("domain", c_double * 4), ("relative", c_double), ("accuracy", c_double), ("budget", c_uint64),
                ("should_stop", StopFunction), ("user", c_void_p), ("side", c_uint32), ("reserved", c_uint32)]


class InspectPictureOptions(ctypes.Structure):
    _fields_ = [("struct_size", c_size_t), ("pattern", c_uint32), ("bands", c_uint32), ("width", c_uint32), ("height", c_uint32),
                ("eye", c_double * 3), ("up", c_double * 3), ("light", c_double * 3), ("range", c_double * 2)]


class InspectRange(ctypes.Structure):
    _fields_ = [("least", c_double * 2), ("greatest", c_double * 2), ("at_least", c_double * 2), ("at_greatest", c_double * 2),
                ("excluded", c_double), ("moved", c_double), ("boxes", c_uint64), ("proven", c_uint32), ("flags", c_uint32)]


class InspectTooth(ctypes.Structure):
    _fields_ = [("u", c_double), ("point", c_double * 3), ("tangent", c_double * 3), ("bend", c_double * 3), ("curvature", c_double),
                ("torsion", c_double)]


class InspectCurvatures(ctypes.Structure):
    _fields_ = [("point", c_double * 3), ("normal", c_double * 3), ("principal", c_double * 2), ("directions", c_double * 6),
                ("mean", c_double), ("gaussian", c_double), ("is_umbilic", c_uint32), ("is_singular", c_uint32)]


class InspectPlace(ctypes.Structure):
    _fields_ = [("u", c_double * 2), ("v", c_double * 2), ("value", c_double * 2), ("kind", c_uint32), ("reserved", c_uint32)]


class InspectMeasured(ctypes.Structure):
    _fields_ = [("lower", c_double), ("upper", c_double), ("at", c_double)]


class InspectContinuity(ctypes.Structure):
    _fields_ = [("gap", InspectMeasured), ("angle", InspectMeasured), ("curvature", InspectMeasured), ("intervals", c_uint64)]


class InspectDistance(ctypes.Structure):
    _fields_ = [("lower", c_double), ("upper", c_double), ("at", c_double * 2), ("boxes", c_uint64), ("proven", c_uint32),
                ("reserved", c_uint32)]


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
    "fpt_fit_options": FitOptions, "fpt_fit_result": FitResult, "fpt_sweep_options": SweepOptions,
    "fpt_relation_callback": RelationCallback, "fpt_elementary_data": ElementaryData, "fpt_coedge_data": CoedgeData,
    "fpt_loop_data": LoopData, "fpt_edge_data": EdgeData, "fpt_trim_data": TrimData, "fpt_change_options": ChangeOptions,
    "fpt_change_summary": ChangeSummary, "fpt_trim_finding": TrimFinding, "fpt_trim_summary": TrimSummary,
    "fpt_difference": Difference, "fpt_estimate": Estimate, "fpt_curve_frame_record": CurveFrame, "fpt_joint": Joint, "fpt_knot_line": KnotLine,
    "fpt_deviation": Deviation, "fpt_pull_options": PullOptions, "fpt_lift_options": LiftOptions, "fpt_face_place": FacePlace,
    "fpt_face_data": FaceData, "fpt_face_options": FaceOptions,
    "fpt_intersect_surfaces_options": IntersectSurfacesOptions, "fpt_intersection_summary": IntersectionSummary,
    "fpt_intersection_branch": IntersectionBranch, "fpt_intersection_point": IntersectionPoint,
    "fpt_intersection_contact": IntersectionContact,
    "fpt_fair_options": FairOptions, "fpt_fair_summary": FairSummary, "fpt_inspect_options": InspectOptions,
    "fpt_inspect_picture_options": InspectPictureOptions, "fpt_inspect_range": InspectRange, "fpt_inspect_tooth": InspectTooth,
    "fpt_inspect_curvature": InspectCurvatures, "fpt_inspect_place": InspectPlace, "fpt_inspect_measured": InspectMeasured,
    "fpt_inspect_continuity": InspectContinuity, "fpt_inspect_distance": InspectDistance,
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
    "fit_parameters": "pzIp", "curve_interpolate": "pzppp", "curve_least_squares": "pzpzpzIpp", "curve_fit": "pzpppp",
    "surface_interpolate": "pzzpp", "surface_fit_grid": "pzzppp", "surface_fit": "pzpppp", "curve_line": "ppp", "curve_arc": "pddddIp",
    "curve_arc_through": "pp", "curve_conic": "pdp", "curve_parabola": "pdddp", "curve_hyperbola": "pddddp", "curve_offset": "pdpp",
    "curve_offset_fit": "pdpzdppp", "surface_quadric": "IppppIp", "surface_saddle": "pddpp", "surface_plane": "ppp",
    "surface_torus": "pddppIp", "surface_ruled": "ppp", "surface_extruded": "ppp", "surface_revolved": "ppppIp",
    "surface_translational": "ppp", "surface_coons": "pp", "surface_coons_bicubic": "ppp", "surface_ferguson": "ppppp",
    "surface_gordon": "ppzppzp", "surface_skinned": "pzzpp", "surface_swept": "pppppp", "surface_offset": "pdp",
    "surface_offset_fit": "pdzzdppp",
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
    "curve_refine": "ppzp", "curve_remove_knot": "pdzpp", "curve_simplify": "pdpp", "curve_part": "pddp", "curve_clamp": "pp",
    "curve_unclamp": "ppp", "curve_periodic": "pdpp", "curve_elevate": "pzp", "curve_reduce": "ppp", "curve_reverse": "pp",
    "curve_with_domain": "pddp", "curve_reparametrise": "pdp", "curve_affine": "ppp", "curve_projective": "ppp",
    "curve_derivative": "pp", "curve_bezier_form": "pp", "curve_split": "pdpp", "curve_join": "pzdpp",
    "curve_make_compatible": "pzp", "curve_difference": "ppp", "surface_refine": "pIpzp", "surface_remove_knot": "pIdzpp",
    "surface_simplify": "pdpp", "surface_part": "ppp", "surface_clamp": "pp", "surface_unclamp": "pIpp",
    "surface_periodic": "pIdpp", "surface_elevate": "pIzp", "surface_reduce": "pIpp", "surface_reverse": "pIp",
    "surface_swap": "pp", "surface_with_domain": "ppp", "surface_reparametrise": "pIdp", "surface_affine": "ppp",
    "surface_projective": "ppp", "surface_derivative": "pIp", "surface_bezier_form": "pp", "surface_split": "pIdpp",
    "surface_isocurve": "pIdp", "surface_join": "pzIdpp", "surface_make_compatible": "pzp", "surface_difference": "ppp",
    "arc_length_new": "pdp", "arc_length_total": "pp", "arc_length_at": "ppzp", "arc_length_parameters": "ppzp",
    "curve_frame": "pdip", "curve_continuity": "pdzpp", "curve_power": "pzpp", "curve_from_power": "zddpp",
    "surface_continuity": "pIdzpp", "surface_power": "pzpp", "surface_from_power": "zzppp",
    "pcurve_pull": "pppp", "pcurve_set_count": "pp", "pcurve_set_get": "pzpp", "pcurve_lift": "ppppp", "pcurve_deviation": "pppp",
    "curve_arc_by_angle": "ppppp", "face_new": "ppp", "face_of_trim": "ppp", "face_classify": "ppzpp", "face_closest": "ppzppp", "face_preimage": "ppdpp",
    "intersect_surfaces": "pppp", "surface_intersection_summary": "pp", "surface_intersection_branch": "pzp",
    "surface_intersection_points": "pzzp", "surface_intersection_contact": "pzp", "surface_intersection_overlap": "pzp",
    "surface_intersection_undecided": "pzp", "surface_intersection_curves": "pppzdzpppp", "intersect_trims": "pppp",
    "surface_intersection_split": "ppIdpzpp", "intersect_correct": "ppppppp", "intersect_march": "pppdpp", "intersect_bisect": "pppzpp",
    "fair_curve": "ppp", "fair_surface": "ppp", "fair_report_summary": "pp", "fair_report_energies": "pzp", "fair_report_curve": "pp",
    "fair_report_surface": "pp", "inspect_curve_range": "ppp", "inspect_surface_range": "pIpp", "inspect_surface_range_places": "pIppp", "inspect_comb": "ppzp",
    "inspect_curvatures": "ppzp", "inspect_monotone_pieces": "pp", "inspect_inflections": "ppp", "inspect_umbilics": "ppp",
    "inspect_set_count": "pp", "inspect_set_get": "pzp", "inspect_hausdorff": "ppppppp", "inspect_border": "pIpIpp",
    "inspect_picture": "ppzpp",
    "intersect_curves": "pppp", "intersect_surface_curve": "pppp", "intersect_curve_quadric": "pppp", "curve_hits_count": "pp",
    "curve_hits_get": "pzp", "curve_hits_undecided_count": "pp", "curve_hits_undecided_get": "pzp",
    "intersect_surface_quadrics": "ppzpp", "sections_counts": "pzp", "sections_branch_get": "pzzp", "sections_branch_points": "pzzzp",
    "sections_point_get": "pzzp", "sections_region_get": "pzzp", "intersect_quadrics": "ppdpp", "caster_new": "ppp",
    "caster_first": "pppzppp", "caster_nearest": "pppzppp", "caster_all": "pppzppp", "ray_hits_count": "pp", "ray_hits_get": "pzp", "ray_hits_starts": "pzp",
    "ray_hits_flags": "pzp",
}
_OTHER = {
    "last_error": ("", c_char_p), "status_name": ("i", c_char_p), "version": ("", c_uint32), "abi_version": ("", c_uint32),
    "query_options_init": ("pz", None), "extrema_options_init": ("pz", None),
    "weights_options_init": ("pz", None), "fit_options_init": ("pz", None), "sweep_options_init": ("pz", None), "weights_report_free": ("p", None), "curve_free": ("p", None),
    "surface_free": ("p", None), "foot_set_free": ("p", None), "scene_free": ("p", None),
    "change_options_init": ("pz", None), "relation_free": ("p", None), "transform_free": ("p", None), "support_free": ("p", None),
    "trim_free": ("p", None), "arc_length_free": ("p", None), "trim_report_free": ("p", None),
    "pull_options_init": ("pz", None), "face_options_init": ("pz", None), "lift_options_init": ("pz", None), "pcurve_set_free": ("p", None), "face_free": ("p", None),
    "intersect_surfaces_options_init": ("pz", None), "surface_intersection_free": ("p", None),
    "fair_options_init": ("pz", None), "fair_report_free": ("p", None), "inspect_options_init": ("pz", None),
    "inspect_picture_options_init": ("pz", None), "inspect_set_free": ("p", None),
    "trim_free": ("p", None), "trim_report_free": ("p", None),
    "hit_options_init": ("pz", None), "curve_hits_free": ("p", None), "sections_free": ("p", None), "caster_free": ("p", None),
    "ray_hits_free": ("p", None),
}
PROTOTYPES = {name: (letters, c_int32) for name, letters in _STATUS.items()} | _OTHER

OK, NULL_ARGUMENT, INVALID_ARGUMENT, BUDGET_EXHAUSTED, CANCELLED, UNSUPPORTED, OUT_OF_MEMORY, INTERNAL = 0, 1, 2, 3, 4, 5, 6, 99


class Cancelled(RuntimeError):
    """A call that `should_stop` ended. `feet` holds the records that were ready; the rest is NaN and marked not proven. `found` holds what an
    intersection would have returned, with what was found by then; what was not looked at is undecided."""

    feet = None
    found = None


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
