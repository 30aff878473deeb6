/*
 * footpoint: from a point back to the parameters of a NURBS curve or surface, with a proof.
 * Generated from src/ffi by build.rs; change that instead. SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * Said once, for every function:
 *
 * Units     Lengths, tolerances and distances are in the unit of the poles. Parameters are in the unit of
 *           the knots. Angles are in radians.
 * Failure   A function that can fail returns an fpt_status: FPT_OK (0) or a number of fpt_status_code.
 *           fpt_last_error() has the text of the calling thread's last failure; it names the parameter
 *           and the index. Outputs are written only when FPT_OK is returned (exceptions: FPT_CANCELLED
 *           and FPT_INTERNAL in _closest, _invert and _path; sets that FPT_BUDGET_EXHAUSTED leaves incomplete
 *           are handed over too). Arguments are checked before work begins. The
 *           library never prints, exits, throws or aborts over bad input; a defect of the library itself
 *           returns FPT_INTERNAL, and handles stay valid.
 * Pointers  A pointer must not be NULL unless its description says so: NULL is FPT_NULL_ARGUMENT. Arrays
 *           are packed and aligned for their element (8 bytes for double), query points and hints need
 *           no alignment. An array of no elements may be NULL. Outputs must not overlap inputs.
 *           FPT_INVALID_ARGUMENT is returned for counts whose product overflows.
 * Numbers   NaN, infinity and (for knots, poles and weights) anything beyond 1e100 are refused in every
 *           array but query points (the record is marked), hints (NaN: no hint) and feet (NaN: no foot).
 * Ownership Inputs are copied. Handles belong to the caller and are released by the matching _free, in
 *           any order; _free(NULL) does nothing.
 * Threads   Handles never change after _new. A function that takes a handle as const may run on any
 *           number of threads at a time. There is no global state and nothing to initialise. Callbacks
 *           in options run on the calling thread only; the evaluate of a shape from a callback runs on any
 *           thread. Both may call fpt_ functions, and must not throw or longjmp.
 * Versions  Structs that begin with struct_size grow at the end only. A struct that is longer than this
 *           library knows is accepted when the rest is zero and FPT_UNSUPPORTED otherwise. A shorter
 *           fpt_query_options that ends between two fields has defaults in the rest; shape data must
 *           be complete. Records that come out are frozen. @since names the first version with a
 *           function.
 */


#ifndef FOOTPOINT_H
#define FOOTPOINT_H

#include <stddef.h>
#include <stdint.h>

/** The version of this header, as fpt_version() returns that of the library. */
#define FPT_VERSION_MAJOR 0
#define FPT_VERSION_MINOR 1
#define FPT_VERSION_PATCH 0
#define FPT_VERSION (FPT_VERSION_MAJOR * 1000000 + FPT_VERSION_MINOR * 1000 + FPT_VERSION_PATCH)
/** The binary interface of this header, as fpt_abi_version() returns that of the library. */
#define FPT_ABI_VERSION 1

/** A status that is not looked at is a warning. */
#if defined(__GNUC__) || defined(__clang__)
#define FPT_MUST_USE __attribute__((warn_unused_result))
#elif defined(_MSC_VER)
#define FPT_MUST_USE _Check_return_
#else
#define FPT_MUST_USE
#endif


/**
 * The values of fpt_status.
 */
typedef enum fpt_status_code {
    /**
     * The outputs are written.
     */
    FPT_OK = 0,
    /**
     * A pointer that must not be NULL is; the text names the parameter.
     */
    FPT_NULL_ARGUMENT = 1,
    /**
     * A value that the documentation excludes; the text names the parameter and the index.
     */
    FPT_INVALID_ARGUMENT = 2,
    /**
     * The budget ran out before a set was complete. Foot points carry FPT_FOOT_BUDGET instead.
     */
    FPT_BUDGET_EXHAUSTED = 3,
    /**
     * should_stop returned non-zero. Records not reached are marked, see fpt_foot_point.
     */
    FPT_CANCELLED = 4,
    /**
     * A request of a newer version, or one that this version cannot answer.
     */
    FPT_UNSUPPORTED = 5,
    /**
     * Memory that could not be had.
     */
    FPT_OUT_OF_MEMORY = 6,
    /**
     * A defect of the library. Handles stay valid; please report the text of fpt_last_error.
     */
    FPT_INTERNAL = 99,
} fpt_status_code;

/**
 * The bits of fpt_foot_point.flags.
 */
typedef enum fpt_foot_flag {
    /**
     * distance - lower_bound is more than the accuracy and the rounding floor of this shape and query; the grain of
     * the parameters (at most 1e-9 of the box diagonal) counts as rounding too.
     */
    FPT_FOOT_NOT_PROVEN = 1,
    /**
     * One parameter is bit-equal to an end of the domain; on a curve: the foot is an end.
     */
    FPT_FOOT_EDGE = 2,
    /**
     * Both parameters are bit-equal to ends of the domain.
     */
    FPT_FOOT_CORNER = 4,
    /**
     * The foot lies on the seam of a closed direction.
     */
    FPT_FOOT_SEAM = 8,
    /**
     * The foot lies on an edge that is a single point.
     */
    FPT_FOOT_COLLAPSED = 16,
    /**
     * Another foot point lies within the accuracy of the least distance, or could not be excluded within the budget. One
     * point with several parameters is one foot (see fpt_surface_preimage); places nearer to one another than
     * 8 x sqrt(distance x accuracy) are one foot. Where the answer itself is not proven, its absence proves nothing.
     */
    FPT_FOOT_TIE = 32,
    /**
     * The feet form an arc or region, equally near up to rounding; comes with FPT_FOOT_TIE. In a set: all parameters of
     * the member's intervals; an arc that is a collapsed edge has FPT_FOOT_COLLAPSED instead.
     */
    FPT_FOOT_CONTINUUM = 64,
    /**
     * invert: lower_bound is more than the tolerance. With FPT_FOOT_NOT_PROVEN as well the distance is
     * more than the tolerance but the bound is not.
     */
    FPT_FOOT_NOT_ON_SHAPE = 128,
    /**
     * The query point has a NaN, an infinity or a coordinate beyond 1e100.
     */
    FPT_FOOT_BAD_QUERY = 256,
    /**
     * A hint was given and the search began there.
     */
    FPT_FOOT_HINT_USED = 512,
    /**
     * The budget ran out before the proof was complete.
     */
    FPT_FOOT_BUDGET = 1024,
    /**
     * The foot lies on a geometric break of the tangent.
     */
    FPT_FOOT_CREASE = 2048,
} fpt_foot_flag;

/**
 * Local iteration, for fpt_query_options.method. Global answers are certified with each.
 */
typedef enum fpt_method {
    /**
     * The best of the others, chosen by the library.
     */
    FPT_METHOD_AUTO = 0,
    /**
     * Moving affine frame: steps to the foot on the tangent line or plane.
     */
    FPT_METHOD_MAF = 1,
    /**
     * Newton's method for the stationary point of the squared distance.
     */
    FPT_METHOD_NEWTON = 2,
    /**
     * A second-order step along the osculating circle, on surfaces along those of both principal directions.
     */
    FPT_METHOD_OSCULATING = 3,
} fpt_method;

/**
 * What an answer is about, for fpt_query_options.scope.
 */
typedef enum fpt_scope {
    /**
     * The whole shape (or the restricted domain), with proof.
     */
    FPT_SCOPE_GLOBAL = 0,
    /**
     * One local iteration from the hint, or without a hint from the published decomposition start.
     * Answers carry FPT_FOOT_NOT_PROVEN and lower_bound 0.
     */
    FPT_SCOPE_LOCAL = 1,
} fpt_scope;

/**
 * What the parameters of a member form, for fpt_foot_member.kind.
 */
typedef enum fpt_member_kind {
    /**
     * One place. The intervals enclose what the tolerance leaves open.
     */
    FPT_MEMBER_POINT = 0,
    /**
     * An interval of u with v fixed: every u in it gives the point (preimage) or the distance (extrema).
     */
    FPT_MEMBER_ARC_U = 1,
    /**
     * An interval of v with u fixed.
     */
    FPT_MEMBER_ARC_V = 2,
    /**
     * Both parameters vary.
     */
    FPT_MEMBER_REGION = 3,
} fpt_member_kind;

/**
 * What the distance does around a member, for fpt_foot_member.nature. On a border of the domain only points of
 * the domain count.
 */
typedef enum fpt_member_nature {
    /**
     * Nothing around is nearer.
     */
    FPT_NATURE_MINIMUM = 0,
    /**
     * Nothing around is farther.
     */
    FPT_NATURE_MAXIMUM = 1,
    /**
     * Nearer in some directions, farther in others.
     */
    FPT_NATURE_SADDLE = 2,
    /**
     * It does not change to second order, and samples around do not tell.
     */
    FPT_NATURE_FLAT = 3,
} fpt_member_nature;

/**
 * The bits that go with normals and tangents.
 */
typedef enum fpt_normal_flag {
    /**
     * The side of the query cannot be told, or not from this foot alone: the query lies on the surface, beyond
     * an open border, in the tangent plane, or at a fold; or the foot is a tie (FPT_FOOT_TIE) of a
     * surface with borders, and another foot may tell another side. The sign is a guess.
     */
    FPT_NORMAL_AMBIGUOUS_SIDE = 1,
    /**
     * Several normals meet at a crease, a corner of patches or the tip of a cone: the one given is their mean,
     * weighted by the angles between the tangents of each patch. Tangents: the tangent breaks.
     */
    FPT_NORMAL_CREASE = 2,
    /**
     * Taken as a limit from inside the domain, because the derivatives do not give it.
     */
    FPT_NORMAL_LIMIT = 4,
    /**
     * There is none, not even as a limit; its three numbers are NaN.
     */
    FPT_NORMAL_UNDEFINED = 8,
} fpt_normal_flag;

/**
 * The bits of the changes along a path.
 */
typedef enum fpt_path_change {
    /**
     * The foot is on another branch of the shape: it does not follow from the one before while the query moves
     * straight from point to point, or it rushes ahead more than 16 times as far as the query on the way.
     */
    FPT_PATH_JUMP = 1,
    /**
     * The number of turns changed in a closed direction.
     */
    FPT_PATH_SEAM_CROSSED = 2,
    /**
     * The foot is on a collapsed edge, or the step leads over one.
     */
    FPT_PATH_THROUGH_COLLAPSED = 4,
    /**
     * Another foot is as near within the accuracy; the one that continues the path was taken.
     */
    FPT_PATH_TIE = 8,
} fpt_path_change;

/**
 * What came of a wish, for fpt_weights_pole.state.
 */
typedef enum fpt_weights_state {
    /**
     * There was none.
     */
    FPT_WISH_NONE = 0,
    /**
     * Proven: the distance is the wished one within the tolerance.
     */
    FPT_WISH_MET = 1,
    /**
     * It is not met, or that could not be proven. The weights are the best found.
     */
    FPT_WISH_NOT_MET = 2,
    /**
     * Proven: no weights in the range meet it, or not together with another wish, from which it differs by more than their poles are
     * apart.
     */
    FPT_WISH_IMPOSSIBLE = 3,
} fpt_weights_state;

/**
 * Bits of fpt_weights_pole.flags.
 */
typedef enum fpt_weights_flag {
    /**
     * The pole lies on its chord (an end of a clamped curve does): formula (3) says nothing, its weight is 1.
     */
    FPT_WEIGHT_ON_CHORD = 1,
    /**
     * Formula (3) gave a weight outside the range, or a wish beyond the chord none: the nearest end of the range was taken.
     */
    FPT_WEIGHT_LIMITED = 2,
    /**
     * The weight is an end of the range.
     */
    FPT_WEIGHT_AT_LIMIT = 4,
    /**
     * The steps of a network ran out before this pole was as wished; the nearest weight that is was taken.
     */
    FPT_WEIGHT_UNTRAINED = 8,
} fpt_weights_flag;

/**
 * What a constraint asks, for fpt_weights_constraint.kind.
 */
typedef enum fpt_weights_constraint_kind {
    /**
     * The point at (u,v) is `vector`.
     */
    FPT_CONSTRAINT_POINT_AT = 0,
    /**
     * Some point is `vector`.
     */
    FPT_CONSTRAINT_POINT = 1,
    /**
     * The tangent of the curve at u has the direction `vector`, of any length but 0.
     */
    FPT_CONSTRAINT_TANGENT_AT = 2,
    /**
     * The tangent of the curve at u has the direction that it has with the given weights.
     */
    FPT_CONSTRAINT_TANGENT_KEPT = 3,
} fpt_weights_constraint_kind;

/**
 * What is 1 after fpt_weights_normalise.
 */
typedef enum fpt_weights_unit {
    /**
     * The first weight.
     */
    FPT_UNIT_FIRST = 0,
    /**
     * The greatest weight.
     */
    FPT_UNIT_GREATEST = 1,
    /**
     * The product of least and greatest weight.
     */
    FPT_UNIT_MIDDLE = 2,
} fpt_weights_unit;

/**
 * The kinds of elementary surfaces, for fpt_elementary_data.kind. Angles in radians.
 */
typedef enum fpt_elementary_kind {
    /**
     * origin + u x + v y.
     */
    FPT_ELEMENTARY_PLANE = 0,
    /**
     * Radius first; u the angle, v the height.
     */
    FPT_ELEMENTARY_CYLINDER = 1,
    /**
     * Radius first at v = 0, half angle second (with sign); u the angle, v the length along a generatrix.
     */
    FPT_ELEMENTARY_CONE = 2,
    /**
     * Radius first; u the longitude, v the latitude, -pi/2 to pi/2.
     */
    FPT_ELEMENTARY_SPHERE = 3,
    /**
     * Major radius first, minor radius second; u the angle about the axis, v that of the tube.
     */
    FPT_ELEMENTARY_TORUS = 4,
    /**
     * The curve turned about the axis z through the origin by the angle u (right-handed); v is the curve's parameter.
     */
    FPT_ELEMENTARY_REVOLUTION = 5,
    /**
     * The curve moved along the vector z (of any length): curve(u) + v z.
     */
    FPT_ELEMENTARY_EXTRUSION = 6,
} fpt_elementary_kind;

/**
 * The kinds of curves in the domain, for fpt_coedge_data.kind.
 */
typedef enum fpt_pcurve_kind {
    /**
     * values: 0 when u is fixed, 1 when v is; its value; where the other parameter begins and ends.
     */
    FPT_PCURVE_ISOLINE = 0,
    /**
     * points joined by lines, at parameters.
     */
    FPT_PCURVE_POLYLINE = 1,
    /**
     * A spline curve with z = 0.
     */
    FPT_PCURVE_SPLINE = 2,
    /**
     * values: centre; half diameter of t = 0; half diameter of a quarter turn, conjugate to it; first and last t, at most a
     * full turn: centre + cos t first + sin t second.
     */
    FPT_PCURVE_ARC = 3,
} fpt_pcurve_kind;

/**
 * Bits of fpt_coedge_data.flags.
 */
typedef enum fpt_coedge_flag {
    /**
     * The coedge runs against its edge.
     */
    FPT_COEDGE_REVERSED = 1,
    /**
     * The place at a share s of the pcurve's domain lies on the edge at the share s of its domain (1 - s when reversed).
     */
    FPT_COEDGE_SAME_PARAMETER = 2,
} fpt_coedge_flag;

/**
 * What becomes of splines and arcs in the domain under transforms that are not linear, for fpt_change_options.replacement.
 */
typedef enum fpt_replacement {
    /**
     * Polylines.
     */
    FPT_REPLACEMENT_POLYLINE = 0,
    /**
     * Cubic splines.
     */
    FPT_REPLACEMENT_SPLINE = 1,
    /**
     * Polylines; of polylines the vertices are mapped and none is added: they stand for themselves.
     */
    FPT_REPLACEMENT_VERTICES = 2,
} fpt_replacement;

/**
 * What can be wrong with a face, for fpt_trim_finding.kind.
 */
typedef enum fpt_finding_kind {
    /**
     * A coedge ends away from the beginning of the next one: numbers are the gap in space (0 across a seam or along a collapsed
     * edge that is missing), and in u and v.
     */
    FPT_FINDING_OPEN = 0,
    /**
     * A loop runs the wrong way: numbers[0] is its area in the domain.
     */
    FPT_FINDING_DIRECTION = 1,
    /**
     * The area of a loop is so small that its direction cannot be told.
     */
    FPT_FINDING_NO_DIRECTION = 2,
    /**
     * Two coedges cross, proven; or one crosses itself.
     */
    FPT_FINDING_CROSSING = 3,
    /**
     * Two coedges come nearer than the tolerance away from common ends: numbers[0] bounds their distance in space.
     */
    FPT_FINDING_TOUCHING = 4,
    /**
     * The image of a pcurve is away from its edge: numbers[0] is the distance.
     */
    FPT_FINDING_EDGE_GAP = 5,
    /**
     * A pcurve leaves the domain: numbers are by how much in u and v.
     */
    FPT_FINDING_OUTSIDE = 6,
    /**
     * A loop is not where its kind says: numbers[0] counts the outer loops around it less the holes around it, 1 for a hole
     * and 0 for an outer loop that are right.
     */
    FPT_FINDING_CONTAINMENT = 7,
    /**
     * Both coedges of an edge run along it the same way; `loop_index` is the number of the edge.
     */
    FPT_FINDING_SENSE = 8,
    /**
     * The surface's function fails on a coedge.
     */
    FPT_FINDING_FAILING = 9,
    /**
     * Whether two coedges touch could not be decided: they are too long for the tolerance, or lie on each other.
     */
    FPT_FINDING_UNDECIDED = 10,
} fpt_finding_kind;

/**
 * Parameters for points in order, for fpt_fit_options.spacing.
 */
typedef enum fpt_spacing {
    /**
     * Steps as the distances of the points.
     */
    FPT_SPACING_CHORDAL = 0,
    /**
     * Steps as the square roots of the distances.
     */
    FPT_SPACING_CENTRIPETAL = 1,
    /**
     * Equal steps.
     */
    FPT_SPACING_UNIFORM = 2,
} fpt_spacing;

/**
 * What the ends of an interpolating curve do, for fpt_fit_options.condition.
 */
typedef enum fpt_fit_condition {
    /**
     * Nothing: as many poles as points.
     */
    FPT_FIT_FREE = 0,
    /**
     * First derivatives are fpt_fit_options.tangents. Degree 2 or more.
     */
    FPT_FIT_TANGENTS = 1,
    /**
     * The natural spline of an odd degree p: derivatives of order (p+1)/2 to p-1 vanish.
     */
    FPT_FIT_NATURAL = 2,
    /**
     * The curve is closed, smoothly; the first point is not repeated at the end.
     */
    FPT_FIT_PERIODIC = 3,
} fpt_fit_condition;

/**
 * How an arc of a circle or ellipse is written as a spline over [0, 1], for the functions that take a form.
 */
typedef enum fpt_arc_form {
    /**
     * Degree 2: equal arcs of 3 poles that share their ends, of at most a quarter turn (a full turn has 9 poles).
     */
    FPT_ARC_QUARTERS = 0,
    /**
     * Degree 2: half turns of 4 poles (a full turn has 7); only for sweeps of one or two half turns.
     */
    FPT_ARC_HALVES = 1,
    /**
     * Degree 2: arcs of at most a third of a turn (a full turn has 7 poles).
     */
    FPT_ARC_THIRDS = 2,
    /**
     * Degree 3: one piece of 4 poles, for sweeps up to 4 radians.
     */
    FPT_ARC_CUBIC = 3,
    /**
     * Degree 5: one piece of 6 poles, for full turns.
     */
    FPT_ARC_QUINTIC = 4,
} fpt_arc_form;

/**
 * Quadrics with an axis, for fpt_surface_quadric: distance from the axis and height along the profile's parameter t.
 */
typedef enum fpt_quadric_patch {
    /**
     * cos t, sin t: t is a latitude.
     */
    FPT_PATCH_ELLIPSOID = 0,
    /**
     * cosh t, sinh t: hyperboloid of one sheet.
     */
    FPT_PATCH_ONE_SHEET = 1,
    /**
     * sinh t, cosh t: half a hyperboloid of two sheets, t >= 0.
     */
    FPT_PATCH_TWO_SHEETS = 2,
    /**
     * t, t^2: elliptic paraboloid, t >= 0.
     */
    FPT_PATCH_PARABOLOID = 3,
    /**
     * t, t: elliptic cone, t >= 0.
     */
    FPT_PATCH_CONE = 4,
    /**
     * 1, t: elliptic cylinder.
     */
    FPT_PATCH_CYLINDER = 5,
} fpt_quadric_patch;

/**
 * Bits of fpt_deviation.flags.
 */
typedef enum fpt_deviation_flag {
    /**
     * The proven bound exceeds the tolerance.
     */
    FPT_DEVIATION_NOT_PROVEN = 1,
    /**
     * Pull: the edge is proven to leave the surface by more than the tolerance.
     */
    FPT_DEVIATION_NOT_ON_SURFACE = 2,
    /**
     * Pull: the piece runs along the seam of u; the other end of u is as good.
     */
    FPT_DEVIATION_ALONG_SEAM_U = 4,
    /**
     * Pull: the piece runs along the seam of v.
     */
    FPT_DEVIATION_ALONG_SEAM_V = 8,
    /**
     * Pull: the edge crosses a seam where the piece begins.
     */
    FPT_DEVIATION_FROM_SEAM = 16,
    /**
     * Pull: the edge crosses a seam where the piece ends.
     */
    FPT_DEVIATION_TO_SEAM = 32,
    /**
     * Pull: the piece begins on a collapsed edge of the surface.
     */
    FPT_DEVIATION_FROM_COLLAPSED = 64,
    /**
     * Pull: the piece ends on a collapsed edge of the surface.
     */
    FPT_DEVIATION_TO_COLLAPSED = 128,
    /**
     * Lift: the curve is the image up to rounding, not fitted.
     */
    FPT_DEVIATION_EXACT = 256,
} fpt_deviation_flag;

/**
 * Where a place lies, for fpt_face_place.standing.
 */
typedef enum fpt_face_standing {
    /**
     * In the face, farther from its edges than the tolerance.
     */
    FPT_FACE_INSIDE = 0,
    /**
     * Not in the face, farther from its edges than the tolerance.
     */
    FPT_FACE_OUTSIDE = 1,
    /**
     * Within the tolerance of an edge, in space.
     */
    FPT_FACE_ON_EDGE = 2,
    /**
     * It could not be decided whether an edge is within the tolerance; or the query was none.
     */
    FPT_FACE_UNKNOWN = 3,
} fpt_face_standing;

/**
 * Bits of fpt_face_place.flags.
 */
typedef enum fpt_standing_flag {
    /**
     * Whether an edge is within the tolerance is not proven: the surface is a function without a bound of its speed. Sides in the domain
     * are exact all the same.
     */
    FPT_STANDING_NOT_PROVEN = 1,
} fpt_standing_flag;

/**
 * What an end of a branch is, for fpt_intersection_branch.end_kind.
 */
typedef enum fpt_branch_end {
    /**
     * The branch is closed.
     */
    FPT_BRANCH_END_CLOSED = 0,
    /**
     * A border: end_index is the side, 0 to 7 for u low, u high, v low, v high of A, then of B.
     */
    FPT_BRANCH_END_BORDER = 1,
    /**
     * A contact (a branch point, a cusp, a collapsed edge): end_index is its number.
     */
    FPT_BRANCH_END_CONTACT = 2,
    /**
     * An undecided box is there.
     */
    FPT_BRANCH_END_UNDECIDED = 3,
    /**
     * A trim: end_index is 0 for one of A, 1 for one of B.
     */
    FPT_BRANCH_END_TRIM = 4,
} fpt_branch_end;

/**
 * How an intersection is found, for fpt_intersect_surfaces_options.method.
 */
typedef enum fpt_intersect_method {
    /**
     * The search that proves: subdivision for the topology, Newton for points.
     */
    FPT_INTERSECT_AUTO = 0,
    /**
     * Subdivision by hulls to a depth or until flat, triangle pairs, segments joined: polylines of which nothing is proven.
     */
    FPT_INTERSECT_SUBDIVISION = 1,
    /**
     * Two tessellations: polylines of which nothing is proven. Of surfaces given by functions too.
     */
    FPT_INTERSECT_MESH = 2,
} fpt_intersect_method;

/**
 * How a place near both surfaces becomes one on both, for fpt_intersect_surfaces_options.corrector.
 */
typedef enum fpt_corrector {
    /**
     * Newton with four parameters, and with three where one is held at a border.
     */
    FPT_CORRECTOR_AUTO = 0,
    /**
     * Newton with three parameters: u of A is held.
     */
    FPT_CORRECTOR_NEWTON_HOLDS_U = 1,
    /**
     * v of A is held.
     */
    FPT_CORRECTOR_NEWTON_HOLDS_V = 2,
    /**
     * u of B is held.
     */
    FPT_CORRECTOR_NEWTON_HOLDS_S = 3,
    /**
     * v of B is held.
     */
    FPT_CORRECTOR_NEWTON_HOLDS_T = 4,
    /**
     * Newton with four parameters: the step that moves both surface points least.
     */
    FPT_CORRECTOR_NEWTON_FOUR = 5,
    /**
     * Moving affine frame: ball and midpoint transforms, the middle of both feet where the tangent planes are parallel.
     */
    FPT_CORRECTOR_MAF = 6,
} fpt_corrector;

/**
 * What an end of a branch is.
 */
typedef enum fpt_section_end {
    /**
     * The branch is a loop: both ends are the same point of space.
     */
    FPT_SECTION_END_CLOSED = 0,
    /**
     * A border of the domain.
     */
    FPT_SECTION_END_BORDER = 1,
    /**
     * A point where branches meet.
     */
    FPT_SECTION_END_SINGULAR = 2,
    /**
     * A collapsed edge.
     */
    FPT_SECTION_END_COLLAPSED = 3,
    /**
     * A box that was not decided.
     */
    FPT_SECTION_END_UNDECIDED = 4,
} fpt_section_end;

/**
 * What a contact is, for fpt_intersection_contact.kind.
 */
typedef enum fpt_contact_kind {
    /**
     * The surfaces touch from one side.
     */
    FPT_CONTACT_TOUCHING = 0,
    /**
     * Two curves cross.
     */
    FPT_CONTACT_CROSSING = 1,
    /**
     * The surfaces agree beyond the second order, or have no tangent plane.
     */
    FPT_CONTACT_DEGENERATE = 2,
    /**
     * A border of one surface just meets the other.
     */
    FPT_CONTACT_BORDER = 3,
    /**
     * A collapsed edge of one surface lies on the other.
     */
    FPT_CONTACT_TIP = 4,
} fpt_contact_kind;

/**
 * How poles are moved, for fpt_fair_options.method.
 */
typedef enum fpt_fair_method {
    /**
     * All poles at once, to the least energy that the constraints allow.
     */
    FPT_FAIR_ENERGY = 0,
    /**
     * One pole at a time, where the energy falls most (Eck, Hadenfeld).
     */
    FPT_FAIR_LOCAL = 1,
    /**
     * One knot (line) at a time: what removing it would do to the poles (Farin, Sapidis). The energy is the sum of the squared jumps of
     * the first derivative that is not continuous. Polynomial surfaces only, curves of any kind.
     */
    FPT_FAIR_KNOT_REMOVAL = 2,
} fpt_fair_method;

/**
 * A quantity of curvature, for fpt_inspect_surface_range.
 */
typedef enum fpt_inspect_quantity {
    /**
     * The greater principal curvature, 1 / length. Positive: the surface bends towards S_u x S_v.
     */
    FPT_QUANTITY_GREATER = 0,
    /**
     * The less principal curvature, 1 / length.
     */
    FPT_QUANTITY_LESS = 1,
    /**
     * Half their sum, 1 / length.
     */
    FPT_QUANTITY_MEAN = 2,
    /**
     * Their product, 1 / area.
     */
    FPT_QUANTITY_GAUSSIAN = 3,
    /**
     * The greatest absolute normal curvature, 1 / length: its reciprocal is the least radius of curvature.
     */
    FPT_QUANTITY_SHARPEST = 4,
} fpt_inspect_quantity;

/**
 * What a picture shows, for fpt_inspect_picture_options.pattern.
 */
typedef enum fpt_inspect_pattern {
    /**
     * Plain shading.
     */
    FPT_PATTERN_SHADED = 0,
    /**
     * Stripes of a surrounding striped room, seen in the surface.
     */
    FPT_PATTERN_ZEBRA = 1,
    /**
     * Bands of equal angle between normal and light.
     */
    FPT_PATTERN_ISOPHOTES = 2,
    /**
     * Bands where the reflection of the view meets parallel lamps.
     */
    FPT_PATTERN_REFLECTION_LINES = 3,
    /**
     * Bands where the normal line passes parallel lamps.
     */
    FPT_PATTERN_HIGHLIGHT_LINES = 4,
    /**
     * Colours of the greater principal curvature.
     */
    FPT_PATTERN_GREATER = 5,
    /**
     * Colours of the less principal curvature.
     */
    FPT_PATTERN_LESS = 6,
    /**
     * Colours of the mean curvature.
     */
    FPT_PATTERN_MEAN = 7,
    /**
     * Colours of the Gaussian curvature.
     */
    FPT_PATTERN_GAUSSIAN = 8,
} fpt_inspect_pattern;

/**
 * What a place of a set is, for fpt_inspect_place.kind.
 */
typedef enum fpt_inspect_kind {
    /**
     * The curvature grows along the piece.
     */
    FPT_PLACE_RISING = 0,
    /**
     * It falls.
     */
    FPT_PLACE_FALLING = 1,
    /**
     * It is the same up to rounding.
     */
    FPT_PLACE_CONSTANT = 2,
    /**
     * Neither could be shown.
     */
    FPT_PLACE_UNKNOWN = 3,
    /**
     * The curve changes the side to which it bends.
     */
    FPT_PLACE_INFLECTION = 4,
    /**
     * The curve is straight there, and whether it changes sides is not shown.
     */
    FPT_PLACE_STRAIGHT = 5,
    /**
     * A small box outside of which, and of the others, principal curvatures differ.
     */
    FPT_PLACE_UMBILIC = 6,
    /**
     * A large such box: a line or an area of umbilics, or the budget ran out.
     */
    FPT_PLACE_UMBILIC_AREA = 7,
    /**
     * A box that a range excludes and in which the quantity has no bound, proven: a tip, a cusp, a cross-cap (partials that are parallel).
     */
    FPT_PLACE_UNBOUNDED = 8,
    /**
     * A box that a range excludes and of which nothing is proven.
     */
    FPT_PLACE_EXCLUDED = 9,
} fpt_inspect_kind;

/**
 * Which extremes of a range are looked for, for fpt_inspect_options.side.
 */
typedef enum fpt_inspect_side {
    /**
     * The least value and the greatest.
     */
    FPT_SIDE_BOTH = 0,
    /**
     * The least one.
     */
    FPT_SIDE_LEAST = 1,
    /**
     * The greatest one: of FPT_QUANTITY_SHARPEST that is the least radius, in half the time or less.
     */
    FPT_SIDE_GREATEST = 2,
} fpt_inspect_side;

/**
 * What is proven of a range that excludes a part of the domain: bits of fpt_inspect_range.flags.
 */
typedef enum fpt_inspect_range_flag {
    /**
     * In an excluded box the quantity falls below every number.
     */
    FPT_RANGE_LEAST_UNBOUNDED = 1,
    /**
     * In an excluded box the quantity exceeds every number: of FPT_QUANTITY_SHARPEST, the least radius is 0.
     */
    FPT_RANGE_GREATEST_UNBOUNDED = 2,
    /**
     * Outside of the excluded boxes both gaps are the allowed ones.
     */
    FPT_RANGE_REST_PROVEN = 4,
} fpt_inspect_range_flag;

/**
 * A parameter direction of a surface.
 */
typedef enum fpt_direction {
    /**
     * The first parameter.
     */
    FPT_DIRECTION_U = 0,
    /**
     * The second parameter.
     */
    FPT_DIRECTION_V = 1,
} fpt_direction;

/**
 * What a fpt_quadric is.
 */
typedef enum fpt_quadric_kind {
    /**
     * Through `origin`, across `axis`.
     */
    FPT_QUADRIC_PLANE = 0,
    /**
     * About `origin`, with radius `size`.
     */
    FPT_QUADRIC_SPHERE = 1,
    /**
     * Infinite, about the line through `origin` along `axis`, with radius `size`.
     */
    FPT_QUADRIC_CYLINDER = 2,
    /**
     * Infinite on both sides of its apex `origin`, about `axis`; `size` is the radius per unit of height.
     */
    FPT_QUADRIC_CONE = 3,
    /**
     * y.A y + 2 b.y + c = 0 with y = x - origin, from `matrix`, `linear` and `constant`.
     */
    FPT_QUADRIC_GENERAL = 4,
} fpt_quadric_kind;

/**
 * How two shapes meet, for fpt_curve_hit.nature.
 */
typedef enum fpt_hit_nature {
    /**
     * At an angle.
     */
    FPT_HIT_TRANSVERSAL = 0,
    /**
     * They touch.
     */
    FPT_HIT_TANGENTIAL = 1,
    /**
     * They run together.
     */
    FPT_HIT_OVERLAP = 2,
} fpt_hit_nature;

/**
 * The bits of fpt_ray_hit.flags.
 */
typedef enum fpt_ray_flag {
    /**
     * The ray touches the surface, or the angle is too small to tell.
     */
    FPT_RAY_TANGENTIAL = 1,
    /**
     * The hit is on a border of the domain.
     */
    FPT_RAY_EDGE = 2,
    /**
     * The ray runs in the surface: a point of that piece.
     */
    FPT_RAY_OVERLAP = 4,
    /**
     * Hits may be missing.
     */
    FPT_RAY_NOT_PROVEN = 8,
    /**
     * Origin, direction or reach are not numbers, too large, or the direction is 0.
     */
    FPT_RAY_BAD_RAY = 16,
} fpt_ray_flag;

/**
 * What a fpt_conic is.
 */
typedef enum fpt_conic_kind {
    /**
     * center + t axes[0].
     */
    FPT_CONIC_LINE = 0,
    /**
     * center + lengths[0] cos t axes[0] + lengths[1] sin t axes[1]; a circle when both lengths are the same.
     */
    FPT_CONIC_ELLIPSE = 1,
    /**
     * center +- lengths[0] cosh t axes[0] + lengths[1] sinh t axes[1].
     */
    FPT_CONIC_HYPERBOLA = 2,
    /**
     * center + t^2 / (4 lengths[0]) axes[0] + t axes[1].
     */
    FPT_CONIC_PARABOLA = 3,
    /**
     * The point center.
     */
    FPT_CONIC_POINT = 4,
} fpt_conic_kind;

/**
 * All numbers from `low` to `high`.
 */
typedef struct Interval Interval;

/**
 * The arc length of a curve as a function of its parameter. Immutable: any number of threads may use one at a time. Owned by the caller,
 * released by fpt_arc_length_free; the curve may be released before.
 */
typedef struct fpt_arc_length fpt_arc_length;

/**
 * A surface prepared for rays. Immutable; keeps what it needs of the surface. Owned by the caller, released by fpt_caster_free.
 */
typedef struct fpt_caster fpt_caster;

/**
 * A curve. Immutable: any number of threads may use one at a time. The search index is built on first
 * use, by one thread while the others wait. Made by fpt_curve_new or fpt_curve_from_callback, owned by the
 * caller, released by fpt_curve_free. A curve from a callback has no degree, knots, poles and weights:
 * functions that need them return FPT_UNSUPPORTED.
 */
typedef struct fpt_curve fpt_curve;

/**
 * Where a curve meets another shape. Immutable; owned by the caller, released by fpt_curve_hits_free.
 */
typedef struct fpt_curve_hits fpt_curve_hits;

/**
 * A face prepared for queries: a surface and loops of pcurves. Immutable: any number of threads may use one at a time. Owned by the
 * caller, released by fpt_face_free; the handles that it was made from may be freed before or after it.
 */
typedef struct fpt_face fpt_face;

/**
 * A faired shape and what is known of it. Immutable, owned by the caller, released by fpt_fair_report_free; it does not refer to the
 * shape that it came from.
 */
typedef struct fpt_fair_report fpt_fair_report;

/**
 * A set of feet. Immutable: any number of threads may read one at a time. Owned by the caller, released by
 * fpt_foot_set_free; it does not refer to the shape that it came from.
 */
typedef struct fpt_foot_set fpt_foot_set;

/**
 * Places of one kind, in order. Immutable, owned by the caller, released by fpt_inspect_set_free.
 */
typedef struct fpt_inspect_set fpt_inspect_set;

/**
 * The pcurves of an edge, in its order. Immutable. Owned by the caller, released by fpt_pcurve_set_free; it does not refer to
 * the handles that it came from.
 */
typedef struct fpt_pcurve_set fpt_pcurve_set;

/**
 * The hits of many rays. Immutable; owned by the caller, released by fpt_ray_hits_free.
 */
typedef struct fpt_ray_hits fpt_ray_hits;

/**
 * A monotone function of one parameter on an interval, with its inverse. Immutable: any number of threads may use one at a time.
 * Owned by the caller, released by fpt_relation_free.
 */
typedef struct fpt_relation fpt_relation;

/**
 * Many curves and surfaces that are searched together. Immutable, as they are: any number of threads may use one at a time.
 * Made by fpt_scene_new, owned by the caller, released by fpt_scene_free. It shares the shapes of the handles it was
 * made from: these may be freed before or after it.
 */
typedef struct fpt_scene fpt_scene;

/**
 * Sections of a surface, one per plane or quadric. Immutable; owned by the caller, released by fpt_sections_free.
 */
typedef struct fpt_sections fpt_sections;

/**
 * The surface under a face. Immutable: any number of threads may use one at a time. Owned by the caller, released by
 * fpt_support_free; what it was made from may be freed before or after it.
 */
typedef struct fpt_support fpt_support;

/**
 * A surface. Immutable: any number of threads may use one at a time. The search index is built on first
 * use, by one thread while the others wait. Made by fpt_surface_new or fpt_surface_from_callback, owned by
 * the caller, released by fpt_surface_free. A surface from a callback has no degrees, knots, poles and
 * weights: functions that need them return FPT_UNSUPPORTED.
 */
typedef struct fpt_surface fpt_surface;

/**
 * All that two surfaces have in common. Immutable: any number of threads may read one at a time. Owned by the caller,
 * released by fpt_surface_intersection_free; it does not refer to the surfaces that it came from.
 */
typedef struct fpt_surface_intersection fpt_surface_intersection;

/**
 * A change of both parameters: (u, v) to (f(u), g(v)), or to (g(v), f(u)). Immutable: any number of threads may use one at a time.
 * Owned by the caller, released by fpt_transform_free.
 */
typedef struct fpt_transform fpt_transform;

/**
 * A trimmed surface: a surface, loops of curves in its domain, and their edges in space; the structure of IGES entities 142 and 144
 * and of faces in STEP. Immutable: any number of threads may use one at a time. Owned by the caller, released by fpt_trim_free.
 */
typedef struct fpt_trim fpt_trim;

/**
 * What was found wrong with a face. Immutable. Owned by the caller, released by fpt_trim_report_free.
 */
typedef struct fpt_trim_report fpt_trim_report;

/**
 * What a method found: weights, and for each pole what was wished and what was achieved. Immutable, owned by the caller, released
 * by fpt_weights_report_free; it does not refer to the shape that it came from.
 */
typedef struct fpt_weights_report fpt_weights_report;

/**
 * What a call returns: FPT_OK (0) or one of the other numbers of fpt_status_code. Never renumbered.
 */
typedef int32_t fpt_status;

/**
 * How to answer queries. Fill it with fpt_query_options_init, then change what matters. All zero after
 * struct_size is the default of everything. Grows at the end only.
 */
typedef struct fpt_query_options {
    /**
     * sizeof(fpt_query_options), set by fpt_query_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0. invert: points farther away are not on the shape. 0: 1e-7 x the diagonal of
     * the shape's box.
     */
    double tolerance;
    /**
     * Length, finite, >= 0. The asked-for distance - lower_bound. 0: 1e-10 x the diagonal of the shape's
     * box. Never an early stop: feet are always polished to the limit of the arithmetic.
     */
    double accuracy;
    /**
     * A value of fpt_method.
     */
    uint32_t method;
    /**
     * A value of fpt_scope.
     */
    uint32_t scope;
    /**
     * Start parameters, (u,v) per query on a surface, u on a curve; NULL: none. A NaN means no hint for
     * this query, an infinity is FPT_INVALID_ARGUMENT, a parameter outside is moved to the domain.
     * Borrowed during the call. A hint never changes the distance by more than the accuracy, nor
     * whether an answer is proven.
     */
    const double *hints;
    /**
     * Bytes from one query point to the next: 0 (packed: 24) or a multiple of 8, at least 24. For points in floats
     * (the functions that end in _f32): 0 (packed: 12) or a multiple of 4, at least 12.
     */
    size_t point_stride;
    /**
     * Bytes from one hint to the next: 0 (packed: 16 on a surface, 8 on a curve) or a multiple of 8, at
     * least that. Looked at only with hints.
     */
    size_t hint_stride;
    /**
     * Restricts the answers to u0,u1,v0,v1 inside the domain with u0 < u1 and v0 < v1. All 0: the whole
     * domain. On a curve only u0,u1 count.
     */
    double domain[4];
    /**
     * 0: all cores, 1: the calling thread only. Answers are the same bits for any number.
     */
    uint32_t threads;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Nodes and subdivisions per query; 0: the default, 150 to 2,500 by degree. A query that runs out has
     * FPT_FOOT_BUDGET.
     */
    uint64_t budget;
    /**
     * Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Told on the calling thread now and then, and once at the end with done = total. While the index
     * is built, done is 0. NULL: nobody.
     */
    void (*progress)(void *user, size_t done, size_t total);
    /**
     * Told each iteration on the calling thread; step 0 is the start of a refinement. Forces one thread.
     * NULL: nobody.
     */
    void (*trace)(void *user, size_t query, uint32_t step, double u, double v, double residual);
    /**
     * Handed to the three callbacks as it is.
     */
    void *user;
} fpt_query_options;

/**
 * The input of fpt_curve_new. Copied: nothing is borrowed after the call.
 */
typedef struct fpt_curve_data {
    /**
     * sizeof(fpt_curve_data).
     */
    size_t struct_size;
    /**
     * 1 to 31.
     */
    size_t degree;
    /**
     * At least degree + 1.
     */
    size_t pole_count;
    /**
     * pole_count + degree + 1 numbers, not decreasing, repeats written out, no interior knot more than
     * degree times. Periodic curves come unrolled: the domain is `knots[degree]` to
     * `knots[pole_count]`.
     */
    const double *knots;
    /**
     * x,y,z of pole i at 3*i; plane curves have z = 0. Not multiplied by the weights.
     */
    const double *poles;
    /**
     * One per pole, 1e-100 to 1e100; NULL: polynomial.
     */
    const double *weights;
} fpt_curve_data;

/**
 * The input of fpt_surface_new. Copied: nothing is borrowed after the call.
 */
typedef struct fpt_surface_data {
    /**
     * sizeof(fpt_surface_data).
     */
    size_t struct_size;
    /**
     * 1 to 31.
     */
    size_t degree_u;
    /**
     * 1 to 31.
     */
    size_t degree_v;
    /**
     * At least degree_u + 1.
     */
    size_t pole_count_u;
    /**
     * At least degree_v + 1.
     */
    size_t pole_count_v;
    /**
     * pole_count_u + degree_u + 1 numbers, not decreasing, repeats written out, no interior knot more
     * than degree_u times. Periodic surfaces come unrolled: the domain is `knots_u[degree_u]` to
     * `knots_u[pole_count_u]`.
     */
    const double *knots_u;
    /**
     * The same in v.
     */
    const double *knots_v;
    /**
     * x,y,z of pole (i,j) at 3*(i*pole_count_v + j). Not multiplied by the weights.
     */
    const double *poles;
    /**
     * Of pole (i,j) at i*pole_count_v + j, 1e-100 to 1e100; NULL: polynomial.
     */
    const double *weights;
} fpt_surface_data;

/**
 * A curve given by a function: the input of fpt_curve_from_callback. The numbers are copied, `user` is kept.
 *
 * The bounds are the caller's word. With one of them answers are proven (extrema: with second_bound only), with
 * neither every foot carries FPT_FOOT_NOT_PROVEN and lower_bound 0. A bound that is too small makes the proofs
 * wrong.
 */
typedef struct fpt_curve_callback {
    /**
     * sizeof(fpt_curve_callback).
     */
    size_t struct_size;
    /**
     * Writes C, C', C'' at u, x,y,z each, up to order `derivatives` (0 to 2) to `out`, which has room for
     * 3*(derivatives + 1) numbers, and returns the highest order that it has written: 0 for the point only;
     * orders that are missing are taken from finite differences. Negative: the function fails at u; so does one
     * that writes numbers that are not finite or beyond 1e100. Points must be accurate to 64 ulps of the
     * largest coordinate of the curve, derivatives to 64 ulps of themselves and of that coordinate over the
     * length of the domain. Called in the constructor and by every function that evaluates the handle, on any
     * thread and on several at a time; must give the same numbers for the same u, and must not throw,
     * longjmp, or free the handle.
     */
    int32_t (*evaluate)(void *user, double u, uint32_t derivatives, double *out);
    /**
     * Handed to both functions as it is.
     */
    void *user;
    /**
     * Called once with `user` when the handle is freed. NULL: nothing to release.
     */
    void (*release)(void *user);
    /**
     * Start and end of u.
     */
    double domain[2];
    /**
     * |C'| is at most this on the whole domain; 0: unknown.
     */
    double speed_bound;
    /**
     * |C''| is at most this on the whole domain; 0: unknown. Of a line, give any small positive number.
     */
    double second_bound;
} fpt_curve_callback;

/**
 * A surface given by a function: the input of fpt_surface_from_callback. The numbers are copied, `user` is kept.
 *
 * The bounds are the caller's word. With one kind of them answers are proven (extrema: with second_bounds only), with
 * neither every foot carries FPT_FOOT_NOT_PROVEN and lower_bound 0. A bound that is too small makes the proofs wrong. Bounds of the
 * second derivatives prove fast; with those of the first alone points on the surface are proven fast, but
 * distances off the surface only roughly.
 */
typedef struct fpt_surface_callback {
    /**
     * sizeof(fpt_surface_callback).
     */
    size_t struct_size;
    /**
     * Writes S; Su,Sv; Suu,Suv,Svv at (u,v), x,y,z each, up to the total order `derivatives` (0 to 2) to
     * `out`, which has room for 3, 9 or 18 numbers, and returns the highest order that it has written: 0 for the
     * point only. All else as for fpt_curve_callback.evaluate.
     */
    int32_t (*evaluate)(void *user, double u, double v, uint32_t derivatives, double *out);
    /**
     * Handed to both functions as it is.
     */
    void *user;
    /**
     * Called once with `user` when the handle is freed. NULL: nothing to release.
     */
    void (*release)(void *user);
    /**
     * Start and end of u, start and end of v.
     */
    double domain[4];
    /**
     * |Su| and |Sv| are at most these on the whole domain; both 0: unknown.
     */
    double speed_bounds[2];
    /**
     * |Suu|, |Suv| and |Svv| are at most these on the whole domain; all 0: unknown (of a plane, give any
     * small positive number). A 0 beside a positive number is a bound.
     */
    double second_bounds[3];
} fpt_surface_callback;

/**
 * The answer to one query: 64 bytes, frozen.
 *
 * A query that was not reached when should_stop ended the call has NaN in u, v, point and distance,
 * lower_bound 0 and FPT_FOOT_NOT_PROVEN. A bad query point (NaN, infinite or beyond 1e100) has
 * FPT_FOOT_BAD_QUERY.
 */
typedef struct fpt_foot_point {
    /**
     * First parameter, in the domain.
     */
    double u;
    /**
     * Second parameter, in the domain; 0 on a curve.
     */
    double v;
    /**
     * The shape at (u,v), bit for bit what _evaluate returns there.
     */
    double point[3];
    /**
     * |query - point|.
     */
    double distance;
    /**
     * Proven: nothing on the shape (in the restricted domain) is nearer to the query than this. At
     * most distance; 0 in local scope.
     */
    double lower_bound;
    /**
     * Sum of fpt_foot_flag values.
     */
    uint32_t flags;
    /**
     * Evaluations of the shape spent on this query.
     */
    uint32_t iterations;
} fpt_foot_point;

/**
 * Which stationary points to list. Fill it with fpt_extrema_options_init, then change what matters. All zero
 * after struct_size is the default of everything. Grows at the end only.
 */
typedef struct fpt_extrema_options {
    /**
     * sizeof(fpt_extrema_options), set by fpt_extrema_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0. Places whose distances differ by less along the way between them may come out as one
     * member. 0: 1e-10 x the diagonal of the shape's box.
     */
    double accuracy;
    /**
     * Length, finite, >= 0. Only points at most this far from the query. 0: all.
     */
    double radius;
    /**
     * At most this many, the nearest. 0: all.
     */
    size_t nearest;
    /**
     * 1: only minima (and members of nature flat); 0: all.
     */
    uint32_t minima_only;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Restricts the answers to u0,u1,v0,v1 inside the domain; the ends of the restriction count as borders.
     * All 0: the whole domain. On a curve only u0,u1 count.
     */
    double domain[4];
    /**
     * Most boxes; 0: the default, 20,000.
     */
    uint64_t budget;
    /**
     * Asked on the calling thread now and then, between pieces of the shape; non-zero ends the call with
     * FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Handed to should_stop as it is.
     */
    void *user;
} fpt_extrema_options;

/**
 * A member of a set: 104 bytes, frozen.
 */
typedef struct fpt_foot_member {
    /**
     * The representative. Its lower_bound is 0. FPT_FOOT_NOT_PROVEN: in a preimage, a place within the tolerance could
     * be neither found nor excluded here; in extrema, the intervals may hold more than one stationary point, or places
     * where the distance differs by more than the accuracy.
     */
    struct fpt_foot_point foot;
    /**
     * Least and greatest u that belong to the member; they enclose, rounding included.
     */
    double u[2];
    /**
     * Least and greatest v; 0, 0 on a curve.
     */
    double v[2];
    /**
     * A value of fpt_member_kind.
     */
    uint32_t kind;
    /**
     * A value of fpt_member_nature.
     */
    uint32_t nature;
} fpt_foot_member;

/**
 * A member of a scene: a curve or a surface, and where it stands. Several members may have the same handle and different
 * placements; its search index is built once.
 */
typedef struct fpt_scene_member {
    /**
     * sizeof(fpt_scene_member), the same for all members of an array.
     */
    size_t struct_size;
    /**
     * A curve, or NULL. One from a callback is FPT_UNSUPPORTED.
     */
    const struct fpt_curve *curve;
    /**
     * A surface, or NULL; exactly one of both is given. One from a callback is FPT_UNSUPPORTED.
     */
    const struct fpt_surface *surface;
    /**
     * 12 numbers, three rows of rotation and translation: a point x of the shape stands at y with
     * y[i] = placement[4*i]*x[0] + placement[4*i + 1]*x[1] + placement[4*i + 2]*x[2] + placement[4*i + 3].
     * No entry of R^T R may differ from the identity by more than 1e-9, and the determinant is positive; the nearest
     * rotation is taken (one that is orthogonal up to rounding keeps its bits). NULL: the shape stands where it is.
     */
    const double *placement;
} fpt_scene_member;

/**
 * The input of fpt_scene_new. Copied: nothing is borrowed after the call.
 */
typedef struct fpt_scene_data {
    /**
     * sizeof(fpt_scene_data).
     */
    size_t struct_size;
    /**
     * 1 to 2^31 - 1.
     */
    size_t member_count;
    /**
     * The members, struct_size bytes of the first apart.
     */
    const struct fpt_scene_member *members;
} fpt_scene_data;

/**
 * How to look for weights. Fill it with fpt_weights_options_init, then change what matters. All zero after struct_size is the
 * default of everything. Grows at the end only.
 */
typedef struct fpt_weights_options {
    /**
     * sizeof(fpt_weights_options), set by fpt_weights_options_init.
     */
    size_t struct_size;
    /**
     * Least weight, 1e-12 to 1e12; 0: 0.01.
     */
    double weight_min;
    /**
     * Greatest weight, 1e-12 to 1e12; 0: 100.
     */
    double weight_max;
    /**
     * Greatest weight over least weight, >= 1; 0: no limit but that of the two above.
     */
    double ratio_limit;
    /**
     * Length, finite, >= 0: how far a distance may be from its wish. 0: 1e-9 x the diagonal of the poles' box. Less than about 1e-11 of
     * it cannot be proven.
     */
    double tolerance;
    /**
     * 1: refinement keeps the weights of opposite poles equal (of a surface in both directions); 0: not.
     */
    uint32_t symmetric;
    /**
     * Most training steps of a network; 0: 1,000.
     */
    uint32_t steps;
    /**
     * Most searches of a refinement; 0: 2,000. One or a few are enough when the wishes exist; each takes 0.1 ms to 1 ms for a curve.
     */
    uint32_t starts;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Seed of the random numbers of networks and of starts. Equal inputs and seeds give equal bits.
     */
    uint64_t seed;
    /**
     * Asked on the calling thread before each search of a refinement; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Handed to should_stop as it is.
     */
    void *user;
} fpt_weights_options;

/**
 * What a shape must do besides. 48 bytes, frozen.
 */
typedef struct fpt_weights_constraint {
    /**
     * A value of fpt_weights_constraint_kind.
     */
    uint32_t kind;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * In the domain; not looked at by FPT_CONSTRAINT_POINT.
     */
    double u;
    /**
     * In the domain; not looked at by FPT_CONSTRAINT_POINT and for curves.
     */
    double v;
    /**
     * A point or direction; not looked at by FPT_CONSTRAINT_TANGENT_KEPT.
     */
    double vector[3];
} fpt_weights_constraint;

/**
 * One pole's part of a report: 72 bytes, frozen.
 */
typedef struct fpt_weights_pole {
    /**
     * The distance asked for; NaN: none.
     */
    double wish;
    /**
     * L of formula (3): the distance of the pole from its chord; of a surface, from where the middle of its support would be
     * without the pole.
     */
    double chord_distance;
    /**
     * The weight of formula (3), within the range; 1 without a wish.
     */
    double first_guess;
    /**
     * The weight found.
     */
    double weight;
    /**
     * Distance of the pole from the shape with the weights found.
     */
    double distance;
    /**
     * Proven: nothing on that shape is nearer to the pole than this.
     */
    double lower_bound;
    /**
     * First parameter of the nearest point.
     */
    double u;
    /**
     * Second parameter; 0 on a curve.
     */
    double v;
    /**
     * A value of fpt_weights_state.
     */
    uint32_t state;
    /**
     * Sum of fpt_weights_flag values.
     */
    uint32_t flags;
} fpt_weights_pole;

/**
 * What came of a constraint: 32 bytes, frozen.
 */
typedef struct fpt_weights_outcome {
    /**
     * Distance from the point, or sine of the angle between tangent and direction (2: the opposite direction).
     */
    double error;
    /**
     * Where on the shape.
     */
    double u;
    /**
     * Second parameter; 0 on a curve.
     */
    double v;
    /**
     * 1: within the tolerance, of a direction within 1e-9; 0: not.
     */
    uint32_t met;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_weights_outcome;

/**
 * A report in a few numbers: 48 bytes, frozen.
 */
typedef struct fpt_weights_summary {
    /**
     * The length within which a distance is the wished one.
     */
    double tolerance;
    /**
     * Training steps of a network, shapes that a refinement measured; 0 for a formula.
     */
    uint64_t iterations;
    /**
     * Searches that a refinement began.
     */
    uint32_t starts;
    /**
     * 1: every wish and every constraint is met.
     */
    uint32_t is_met;
    /**
     * Wishes met.
     */
    uint64_t met;
    /**
     * Wishes not met, those that are impossible not counted.
     */
    uint64_t not_met;
    /**
     * Wishes proven impossible.
     */
    uint64_t impossible;
} fpt_weights_summary;

/**
 * A conic over three poles: 24 bytes, frozen.
 */
typedef struct fpt_weights_conic_shape {
    /**
     * The middle weight when both end weights are 1.
     */
    double weight;
    /**
     * The share of the way from the middle of the chord to the middle pole that the curve goes: weight / (1 + weight).
     */
    double rho;
    /**
     * 0 circle, less than 1 ellipse, 1 parabola, more hyperbola; near 0 good to about 1e-8.
     */
    double eccentricity;
} fpt_weights_conic_shape;

/**
 * The greatest distance of two shapes at equal parameters, between two numbers: 32 bytes, frozen.
 */
typedef struct fpt_difference {
    /**
     * No points at equal parameters are farther apart. Proven. Bounds the Hausdorff distance too.
     */
    double bound;
    /**
     * The points at (u, v) are at least so far apart.
     */
    double reached;
    /**
     * Where, nearly the worst place.
     */
    double u;
    /**
     * Curves: 0.
     */
    double v;
} fpt_difference;

/**
 * A number and how far it may be from the true one: 16 bytes, frozen.
 */
typedef struct fpt_estimate {
    /**
     * The number.
     */
    double value;
    /**
     * The true one is not farther from it. Proven.
     */
    double error;
} fpt_estimate;

/**
 * The moving frame of a curve: 120 bytes, frozen. NaN marks what is not defined.
 */
typedef struct fpt_curve_frame_record {
    /**
     * The point.
     */
    double point[3];
    /**
     * Unit tangent; NaN where the first derivative is 0.
     */
    double tangent[3];
    /**
     * Unit vector to the centre of curvature; NaN where the curve is straight.
     */
    double normal[3];
    /**
     * Tangent x normal.
     */
    double binormal[3];
    /**
     * Length of the first derivative.
     */
    double speed;
    /**
     * 1 / length, >= 0.
     */
    double curvature;
    /**
     * 1 / length, positive for right-handed screws; NaN where the curve is straight.
     */
    double torsion;
} fpt_curve_frame_record;

/**
 * How the pieces of a curve meet at a knot: 48 bytes, frozen.
 */
typedef struct fpt_joint {
    /**
     * The knot; the seam of a closed curve is reported at the end of the domain.
     */
    double u;
    /**
     * How often it is a knot.
     */
    uint32_t multiplicity;
    /**
     * The highest order to which all derivatives agree; 0 is a mere join.
     */
    uint32_t order;
    /**
     * Length of the gap between the pieces.
     */
    double gap;
    /**
     * Length of the jump of the first derivative.
     */
    double first_jump;
    /**
     * Angle of the tangents in radians; NaN beside a cusp.
     */
    double tangent_angle;
    /**
     * Length of the jump of the curvature vector, 1 / length; NaN beside a cusp.
     */
    double curvature_jump;
} fpt_joint;

/**
 * How the pieces of a surface meet along a knot line: 32 bytes, frozen.
 */
typedef struct fpt_knot_line {
    /**
     * The knot; the seam of a closed surface is reported at the end of the domain.
     */
    double value;
    /**
     * How often it is a knot.
     */
    uint32_t multiplicity;
    /**
     * The highest order to which all derivatives across the line agree all along it; 0 is a mere join.
     */
    uint32_t order;
    /**
     * No gap between the pieces is wider, anywhere on the line: the hull of the jump. Of rational surfaces this and the next are of the
     * homogeneous form, with weights at most 1, around a pole.
     */
    double gap;
    /**
     * No jump of the first derivative across the line is longer.
     */
    double first_jump;
} fpt_knot_line;

/**
 * How to fit. Fill it with fpt_fit_options_init, then change what matters. All zero after struct_size is the default of everything
 * but the tolerance, which fits need. Grows at the end only.
 */
typedef struct fpt_fit_options {
    /**
     * sizeof(fpt_fit_options), set by fpt_fit_options_init.
     */
    size_t struct_size;
    /**
     * Length, more than 0 for fits: knots are added until no point is farther away. Not looked at by interpolation.
     */
    double tolerance;
    /**
     * Degree of curves, and of surfaces in u, 1 to 31; 0: 3.
     */
    uint32_t degree_u;
    /**
     * Degree of surfaces in v, 1 to 31; 0: 3.
     */
    uint32_t degree_v;
    /**
     * A value of fpt_spacing: parameters when none are given.
     */
    uint32_t spacing;
    /**
     * A value of fpt_fit_condition; for fpt_curve_interpolate.
     */
    uint32_t condition;
    /**
     * With FPT_FIT_TANGENTS: x,y,z of the derivative at the first point, then at the last; NaN in x: none there. Borrowed during the call.
     */
    const double *tangents;
    /**
     * Most poles, of a grid in either direction; 0: 10,000, of a grid 4,096.
     */
    size_t max_poles;
    /**
     * 1: parameters stay as they are; 0: each point is fitted at its foot. For fpt_curve_fit and fpt_surface_fit.
     */
    uint32_t keep_parameters;
    /**
     * 1: fpt_surface_fit_grid finds how far the points are from their feet and proves how far the worst is; 0: distances are those at the
     * parameters.
     */
    uint32_t certify;
    /**
     * 0: all cores, 1: the calling thread only. Results are the same bits for any number.
     */
    uint32_t threads;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Handed to should_stop as it is.
     */
    void *user;
} fpt_fit_options;

/**
 * How far the data points are from a fitted shape: 40 bytes, frozen.
 */
typedef struct fpt_fit_result {
    /**
     * No data point is farther from the shape than this.
     */
    double worst;
    /**
     * Proven: some data point is at least that far away. `worst` exceeds it by 1e-10 of the shape's box at most, unless points are
     * `unproven`. 0 when feet were not asked for.
     */
    double at_least;
    /**
     * Root of the mean of the squared distances from the places that were found.
     */
    double rms;
    /**
     * The data point with the distance `worst`.
     */
    uint64_t worst_index;
    /**
     * Data points that may be farther away than `at_least`: no nearer place was found, and none excluded.
     */
    uint64_t unproven;
} fpt_fit_result;

/**
 * How fpt_surface_swept moves a profile. All zero after struct_size is the default of everything but the tolerance. Grows at the end
 * only.
 */
typedef struct fpt_sweep_options {
    /**
     * sizeof(fpt_sweep_options), set by fpt_sweep_options_init.
     */
    size_t struct_size;
    /**
     * Length, more than 0: greatest distance from the exact swept surface at equal parameters.
     */
    double tolerance;
    /**
     * Turn about the tangent in all, in radians, spread evenly over the length.
     */
    double twist;
    /**
     * Degree along the spine, 1 to 31; 0: 3.
     */
    uint32_t degree;
    /**
     * 1: on a closed spine the last frame is brought onto the first; 0: not.
     */
    uint32_t close;
    /**
     * Most poles along the spine; 0: 2,000.
     */
    size_t max_poles;
} fpt_sweep_options;

/**
 * The input of fpt_relation_from_callback.
 */
typedef struct fpt_relation_callback {
    /**
     * sizeof(fpt_relation_callback).
     */
    size_t struct_size;
    /**
     * The value at x in the domain: finite, all rising or all falling. Called from any thread; the same numbers for the same x; must
     * not throw or longjmp.
     */
    double (*forward)(void *user, double x);
    /**
     * The place of a value.
     */
    double (*backward)(void *user, double y);
    /**
     * Handed to all three functions as it is.
     */
    void *user;
    /**
     * Called once with `user` when nothing uses the functions any more. NULL: nothing to release.
     */
    void (*release)(void *user);
    /**
     * First and last place.
     */
    double domain[2];
} fpt_relation_callback;

/**
 * The input of fpt_support_elementary. Copied: nothing is borrowed after the call.
 */
typedef struct fpt_elementary_data {
    /**
     * sizeof(fpt_elementary_data).
     */
    size_t struct_size;
    /**
     * A value of fpt_elementary_kind.
     */
    uint32_t kind;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Start and end of u, start and end of v. An angle spans at most a full turn.
     */
    double domain[4];
    /**
     * A point of the axis, the centre, or the place of u = v = 0 of a plane.
     */
    double origin[3];
    /**
     * Direction of the angle 0. x, y, z are orthonormal within 1e-12, right-handed or left-handed; x and y are not looked at by
     * revolutions and extrusions.
     */
    double x[3];
    /**
     * Direction of a quarter turn.
     */
    double y[3];
    /**
     * The axis.
     */
    double z[3];
    /**
     * What the kind calls first.
     */
    double first;
    /**
     * What the kind calls second.
     */
    double second;
    /**
     * A spline curve, for revolutions and extrusions; else NULL.
     */
    const struct fpt_curve *curve;
} fpt_elementary_data;

/**
 * A curve in space, or the point of a collapsed side. 40 bytes, frozen.
 */
typedef struct fpt_edge_data {
    /**
     * All of the curve; NULL: a point.
     */
    const struct fpt_curve *curve;
    /**
     * The point; looked at without a curve.
     */
    double point[3];
    /**
     * 1: the edge runs against its curve; 0: along it.
     */
    uint32_t reversed;
    /**
     * Must be 0.
     */
    uint32_t reserved;
} fpt_edge_data;

/**
 * A curve of a loop. 112 bytes, frozen.
 */
typedef struct fpt_coedge_data {
    /**
     * A value of fpt_pcurve_kind.
     */
    uint32_t kind;
    /**
     * Sum of fpt_coedge_flag values.
     */
    uint32_t flags;
    /**
     * Number of its edge; SIZE_MAX: none, the edge is only known as the image of the pcurve.
     */
    size_t edge;
    /**
     * Numbers of an isoline (4) or an arc (8).
     */
    double values[8];
    /**
     * u,v of the points of a polyline.
     */
    const double *points;
    /**
     * Increasing parameters of the points; NULL: 0, 1, 2, ...
     */
    const double *parameters;
    /**
     * Points of a polyline, at least 2.
     */
    size_t point_count;
    /**
     * The spline.
     */
    const struct fpt_curve *curve;
} fpt_coedge_data;

/**
 * A closed chain of curves, each beginning where the one before ends. 24 bytes, frozen.
 */
typedef struct fpt_loop_data {
    /**
     * 0: outer, counter-clockwise; 1: inner, clockwise.
     */
    uint32_t is_inner;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * The curves in their order.
     */
    const struct fpt_coedge_data *coedges;
    /**
     * At least 1.
     */
    size_t coedge_count;
} fpt_loop_data;

/**
 * The input of fpt_trim_new. Copied: nothing is borrowed after the call.
 */
typedef struct fpt_trim_data {
    /**
     * sizeof(fpt_trim_data).
     */
    size_t struct_size;
    /**
     * The surface.
     */
    const struct fpt_support *support;
    /**
     * The edges; coedges refer to them by number. Each is used once, or twice: a seam.
     */
    const struct fpt_edge_data *edges;
    /**
     * May be 0.
     */
    size_t edge_count;
    /**
     * The loops.
     */
    const struct fpt_loop_data *loops;
    /**
     * At least 1.
     */
    size_t loop_count;
    /**
     * 1: the normal of the face is opposite to Su x Sv; 0: it is that.
     */
    uint32_t flipped;
    /**
     * Must be 0.
     */
    uint32_t reserved;
} fpt_trim_data;

/**
 * How a face is changed. Fill it with fpt_change_options_init. All zero after struct_size is the default of everything. Grows at the
 * end only.
 */
typedef struct fpt_change_options {
    /**
     * sizeof(fpt_change_options), set by fpt_change_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0: largest distance of old and new images of a curve at the same parameter. 0: 1e-7 x the diagonal of the box
     * of the new surface.
     */
    double tolerance;
    /**
     * A value of fpt_replacement.
     */
    uint32_t replacement;
    /**
     * Must be 0.
     */
    uint32_t reserved;
} fpt_change_options;

/**
 * How well a face was changed. 24 bytes, frozen.
 */
typedef struct fpt_change_summary {
    /**
     * Largest distance of old and new images of a curve at the same parameter: 0 where all are exact.
     */
    double deviation;
    /**
     * Largest distance of the old and the new surface at places that belong together.
     */
    double surface_deviation;
    /**
     * 1: the deviation is proven; 0: it is the largest at samples.
     */
    uint32_t proven;
    /**
     * 1: that of the surfaces is proven; 0: it is the largest at 33 x 33 places.
     */
    uint32_t surface_proven;
} fpt_change_summary;

/**
 * A report in a few numbers. 56 bytes, frozen.
 */
typedef struct fpt_trim_summary {
    /**
     * The tolerance used, a length.
     */
    double tolerance;
    /**
     * Largest distance of a coedge's end and the next one's beginning, in space.
     */
    double largest_opening;
    /**
     * Largest distance of a pcurve's image and its edge found, at 33 places and all corners of each coedge.
     */
    double largest_gap;
    /**
     * Proven: no image of a pcurve and its edge are farther apart, at equal parameters where they share them, else as sets of points.
     * Infinite where a function takes part, a pcurve leaves the domain, or no bound could be had.
     */
    double gap_bound;
    /**
     * How far the segments that stand for curves may be off, a length; part of the tolerance unless a curve is very long.
     */
    double segment_error;
    /**
     * 1: coedges without a finding are proven to be disjoint away from common ends; 0: the surface is a function, its speed is known from samples only.
     */
    uint32_t proven;
    /**
     * 0.
     */
    uint32_t reserved;
    /**
     * Number of findings; 0: the face is valid.
     */
    size_t finding_count;
} fpt_trim_summary;

/**
 * Something that is wrong. 80 bytes, frozen. What a kind does not have is SIZE_MAX or 0.
 */
typedef struct fpt_trim_finding {
    /**
     * A value of fpt_finding_kind.
     */
    uint32_t kind;
    /**
     * 0.
     */
    uint32_t reserved;
    /**
     * Number of the loop.
     */
    size_t loop_index;
    /**
     * Number of the coedge in it.
     */
    size_t coedge;
    /**
     * Parameter of its pcurve.
     */
    double parameter;
    /**
     * The other loop of a contact.
     */
    size_t other_loop;
    /**
     * The other coedge.
     */
    size_t other_coedge;
    /**
     * The parameter there.
     */
    double other_parameter;
    /**
     * What the kind says.
     */
    double numbers[3];
} fpt_trim_finding;

/**
 * How to pull an edge back. Fill it with fpt_pull_options_init, then change what matters. All zero after struct_size is the
 * default of everything. Grows at the end only.
 */
typedef struct fpt_pull_options {
    /**
     * sizeof(fpt_pull_options), set by fpt_pull_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0: greatest distance between edge and image at equal parameters. 0: 1e-7 x the diagonal of the
     * surface's box.
     */
    double tolerance;
    /**
     * Degree of fitted pcurves, 1 to 9. 0: 3, or 5 for tolerances below 1e-8 x the diagonal.
     */
    size_t degree;
    /**
     * Most poles of a pcurve; 0: 2000.
     */
    size_t pole_limit;
    /**
     * 2 finite numbers u,v near the edge's start, where more than one place of the surface is as near: seams,
     * self-intersections. Along a seam the nearer end of the domain is taken. NULL: none. Borrowed during the call.
     */
    const double *hint;
    /**
     * Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Handed to should_stop as it is.
     */
    void *user;
} fpt_pull_options;

/**
 * How to lift a pcurve. Fill it with fpt_lift_options_init, then change what matters. All zero after struct_size is the
 * default of everything. Grows at the end only.
 */
typedef struct fpt_lift_options {
    /**
     * sizeof(fpt_lift_options), set by fpt_lift_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0: greatest deviation of a fitted image. 0: 1e-7 x the diagonal of the surface's box.
     */
    double tolerance;
    /**
     * Exact images may have at most this degree, 1 to 31: that of the pcurve times the sum of the surface's. Isocurves always
     * are exact. 0: 6.
     */
    size_t exact_degree;
} fpt_lift_options;

/**
 * How far a curve in space is from the image of a pcurve, at equal parameters: 32 bytes, frozen.
 */
typedef struct fpt_deviation {
    /**
     * Proven: nowhere more than this, rounding included.
     */
    double bound;
    /**
     * The greatest distance found, up to rounding; bound - reached is what the proof leaves open.
     */
    double reached;
    /**
     * The parameter where it was found.
     */
    double at;
    /**
     * Sum of fpt_deviation_flag values.
     */
    uint32_t flags;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_deviation;

/**
 * How a face is prepared. Fill it with fpt_face_options_init. All zero after struct_size is the default of everything. Grows at the end
 * only.
 */
typedef struct fpt_face_options {
    /**
     * sizeof(fpt_face_options), set by fpt_face_options_init.
     */
    size_t struct_size;
    /**
     * Most spans of the images of all pcurves, which bounds time and memory; 0: 10,000,000. What would take more is FPT_UNSUPPORTED.
     */
    uint64_t budget;
    /**
     * Asked on the calling thread between pcurves, and every 64 spans of long ones; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Told on the calling thread how many pcurves are done, of how many. NULL: not wanted.
     */
    void (*progress)(void *user, size_t done, size_t total);
    /**
     * Handed to both as it is.
     */
    void *user;
} fpt_face_options;

/**
 * The input of fpt_face_new. Copied: nothing is borrowed after the call.
 */
typedef struct fpt_face_data {
    /**
     * sizeof(fpt_face_data).
     */
    size_t struct_size;
    /**
     * A surface of any kind.
     */
    const struct fpt_surface *surface;
    /**
     * At least 1.
     */
    size_t loop_count;
    /**
     * For each loop the number of its pcurves, at least 1.
     */
    const size_t *coedge_counts;
    /**
     * The pcurves of all loops, one after the other: spline curves with z = 0 in the domain of the surface, each beginning
     * where the one before ends, up to a gap that a line closes. A region across a seam is bounded on both sides of it.
     */
    const struct fpt_curve *const *pcurves;
} fpt_face_data;

/**
 * A place of a face: 24 bytes, frozen.
 */
typedef struct fpt_face_place {
    /**
     * A value of fpt_face_standing.
     */
    uint32_t standing;
    /**
     * On an edge: the number of its loop; else UINT32_MAX.
     */
    uint32_t loop_index;
    /**
     * On an edge: the number of the pcurve in its loop; else UINT32_MAX.
     */
    uint32_t coedge_index;
    /**
     * 0 or FPT_STANDING_NOT_PROVEN.
     */
    uint32_t flags;
    /**
     * On an edge: the parameter of the pcurve; else NaN.
     */
    double parameter;
} fpt_face_place;

/**
 * What an intersection asks for. Fill it with fpt_intersect_surfaces_options_init, then change what matters. All zero after
 * struct_size is the default of everything. Grows at the end only.
 */
typedef struct fpt_intersect_surfaces_options {
    /**
     * sizeof(fpt_intersect_surfaces_options), set by fpt_intersect_surfaces_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0. How far a branch may be from the chord between two of its points. 0: 1e-3 x the size of
     * the smaller surface (the power of two above the diagonal of its box).
     */
    double chord;
    /**
     * Most pairs of parts; 0: the default, 2,000,000.
     */
    uint64_t budget;
    /**
     * Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED, and an intersection with what was found by
     * then. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Told on the calling thread now and then: pairs judged, and pairs judged or waiting; by fpt_surface_intersection_curves points of
     * the branch. NULL: nobody.
     */
    void (*progress)(void *user, size_t done, size_t total);
    /**
     * Handed to the callbacks as it is.
     */
    void *user;
    /**
     * Length, finite, >= 0: surfaces that are nearer than this touch where they are parallel, and are not told apart further; points of
     * branches are within it of both surfaces, rounding included, or the result is not proven. fpt_intersect_correct ends within
     * it. 0: what the arithmetic can tell.
     */
    double tolerance;
    /**
     * A value of fpt_intersect_method.
     */
    uint32_t method;
    /**
     * A value of fpt_corrector, for fpt_intersect_correct, fpt_intersect_march and fpt_intersect_bisect.
     */
    uint32_t corrector;
    /**
     * FPT_INTERSECT_SUBDIVISION: how often both surfaces are quartered, at most 20; 0: until their parts are as flat as the chord.
     * FPT_INTERSECT_MESH: cells along each direction, at most 1024; 0: 64.
     */
    uint32_t levels;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Told by fpt_intersect_correct on the calling thread: each iterate, its u, v of A and u, v of B, and the distance between the two
     * surface points; step 0 is the start. NULL: nobody.
     */
    void (*trace)(void *user, uint32_t step, const double *uvst, double gap);
} fpt_intersect_surfaces_options;

/**
 * Counts and verdicts of an intersection.
 */
typedef struct fpt_intersection_summary {
    /**
     * Curves.
     */
    size_t branch_count;
    /**
     * Points.
     */
    size_t contact_count;
    /**
     * Boxes in which the surfaces coincide.
     */
    size_t overlap_count;
    /**
     * Boxes about which nothing is known.
     */
    size_t undecided_count;
    /**
     * Pairs of parts judged.
     */
    uint64_t pairs;
    /**
     * 1: nothing is missing and every branch is transversal, with proof. 0 with contacts, overlaps, tangential branches or
     * undecided boxes: what touches cannot be told from a gap below the rounding.
     */
    uint32_t is_proven;
    /**
     * 1: the budget ran out.
     */
    uint32_t is_exhausted;
    /**
     * 1: should_stop said so. What was not looked at by then is undecided; chords may be longer than asked (the chord of each branch is
     * true), and borders of overlaps are left out.
     */
    uint32_t is_stopped;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_intersection_summary;

/**
 * A branch without its points.
 */
typedef struct fpt_intersection_branch {
    /**
     * Number of points.
     */
    size_t point_count;
    /**
     * Greatest distance between the two surface points of one of its points.
     */
    double gap;
    /**
     * Proven: between two points the branch stays within this of their chord. Infinite where nothing is proven.
     */
    double chord;
    /**
     * 1: the surfaces touch along it.
     */
    uint32_t is_tangential;
    /**
     * 1: it bounds an area in which the surfaces coincide; then it is tangential too.
     */
    uint32_t bounds_overlap;
    /**
     * 1: it is a loop; its first point comes again as the last.
     */
    uint32_t is_closed;
    /**
     * 0.
     */
    uint32_t reserved;
    /**
     * Values of fpt_branch_end, of its beginning and its end.
     */
    uint32_t end_kind[2];
    /**
     * What they refer to.
     */
    uint32_t end_index[2];
} fpt_intersection_branch;

/**
 * A point of an intersection: 56 bytes, frozen.
 */
typedef struct fpt_intersection_point {
    /**
     * Middle of the two surface points.
     */
    double point[3];
    /**
     * Parameters of A.
     */
    double uv[2];
    /**
     * Parameters of B.
     */
    double st[2];
} fpt_intersection_point;

/**
 * An isolated contact.
 */
typedef struct fpt_intersection_contact {
    /**
     * Where.
     */
    struct fpt_intersection_point place;
    /**
     * Distance between the surfaces there.
     */
    double gap;
    /**
     * Length: what the surfaces do within it was not told apart further.
     */
    double radius;
    /**
     * A value of fpt_contact_kind.
     */
    uint32_t kind;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_intersection_contact;

/**
 * How far an inspection goes. Fill it with fpt_inspect_options_init. Grows at the end only.
 */
typedef struct fpt_inspect_options {
    /**
     * sizeof(fpt_inspect_options), set by fpt_inspect_options_init.
     */
    size_t struct_size;
    /**
     * Ranges and umbilics: only the part u0,u1,v0,v1; all 0: the whole domain. On a curve only u0,u1 count.
     */
    double domain[4];
    /**
     * Ranges: allowed gap between the two bounds of an extreme, as a share of its size or of what a sphere as large as the shape
     * has; above 0, at most 1. Default 1e-3.
     */
    double relative;
    /**
     * Distances: allowed gap between the bounds, length; 0: 1e-3 of the diagonal of the first shape's box.
     */
    double accuracy;
    /**
     * Boxes at most; 0: the default, 200000 (ranges, umbilics), 50000 (distances).
     */
    uint64_t budget;
    /**
     * Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Handed to should_stop as it is.
     */
    void *user;
    /**
     * Ranges: a value of fpt_inspect_side, which extremes must have the gap; bounds of the other one are true, but loose.
     */
    uint32_t side;
    /**
     * Must be 0.
     */
    uint32_t reserved;
} fpt_inspect_options;

/**
 * How a picture is made. Fill it with fpt_inspect_picture_options_init. Grows at the end only.
 */
typedef struct fpt_inspect_picture_options {
    /**
     * sizeof(fpt_inspect_picture_options), set by fpt_inspect_picture_options_init.
     */
    size_t struct_size;
    /**
     * A value of fpt_inspect_pattern.
     */
    uint32_t pattern;
    /**
     * Bands over the range of what they show, 1 to 1000. Default 16.
     */
    uint32_t bands;
    /**
     * Pixels in a row, 1 to 8192. Default 640.
     */
    uint32_t width;
    /**
     * Rows, 1 to 8192. Default 480.
     */
    uint32_t height;
    /**
     * Direction from the surface towards the eye; not 0. The view is orthographic and holds the whole surface.
     */
    double eye[3];
    /**
     * What is up in the picture; not 0, not the direction of the eye.
     */
    double up[3];
    /**
     * Direction from the surface towards the light, and towards the plane of the lamps; not 0.
     */
    double light[3];
    /**
     * Values of the ends of the colours of curvature; both 0: the range of what is seen, but for a hundredth at either end.
     */
    double range[2];
} fpt_inspect_picture_options;

/**
 * What a shape is faired for, and what must stay. Fill it with fpt_fair_options_init, then set the deviation. Grows at the end only.
 */
typedef struct fpt_fair_options {
    /**
     * sizeof(fpt_fair_options), set by fpt_fair_options_init.
     */
    size_t struct_size;
    /**
     * Length, positive: how far a point may move from the point of the same parameters. Must be set.
     */
    double deviation;
    /**
     * Weight of the integral of the squared second derivative (curves), of the thin plate |Suu|^2 + 2 |Suv|^2 + |Svv|^2
     * (surfaces); finite, >= 0. Default 1.
     */
    double strain;
    /**
     * Weight of the integral of the squared third derivatives; finite, >= 0. Default 0.
     */
    double jerk;
    /**
     * Weight of the integral of the squared distance from the shape as it was; finite, >= 0. Default 0.
     */
    double distance;
    /**
     * A value of fpt_fair_method.
     */
    uint32_t method;
    /**
     * Curves: 1: derivatives and integrals by the arc length of the curve as it was, 0: by the parameter.
     */
    uint32_t by_length;
    /**
     * Curves: what is kept at the start and at the end. 0 nothing, 1 the point, 2 the first derivative too, 3 the second too. Default 2.
     */
    uint32_t ends[2];
    /**
     * Surfaces: what is kept along u0, u1, v0, v1. 0 nothing, 1 the border (G0), 2 first cross derivatives too (G1), 3 second
     * ones too (G2). Default 2. The direction must be clamped there, unless 0 or periodic.
     */
    uint32_t borders[4];
    /**
     * Curves: `fixed_count` numbers of poles that stay. NULL: none.
     */
    const size_t *fixed;
    /**
     * See fixed.
     */
    size_t fixed_count;
    /**
     * Curves: `through_count` parameters whose points stay. NULL: none.
     */
    const double *through;
    /**
     * See through.
     */
    size_t through_count;
    /**
     * Curves: `knot_count` knots that FPT_FAIR_KNOT_REMOVAL and FPT_FAIR_LOCAL may fair: of each the pole in the middle of its jump
     * moves. NULL: all inner ones, with FPT_FAIR_LOCAL all poles.
     */
    const double *knots;
    /**
     * See knots.
     */
    size_t knot_count;
    /**
     * Curves: least and greatest arc length, which the curve has already. Both 0: any.
     */
    double length[2];
    /**
     * Surfaces: only the part u0,u1,v0,v1 changes. All 0: the whole surface.
     */
    double region[4];
    /**
     * Solutions of the equations at most, five a step (local methods: steps, eight a pole at least); 0: the default, 300 (curves), 150
     * (surfaces).
     */
    uint32_t steps;
    /**
     * Planar curves, FPT_FAIR_ENERGY: 1: no more changes of the side to which the curve bends than the curve of least jerk by length
     * has that the constraints allow; as much of that energy is added as this takes. 0: only the energy asked for. Default 1.
     */
    uint32_t calm;
    /**
     * Asked on the calling thread between steps; non-zero ends the call with FPT_CANCELLED. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Handed to should_stop as it is.
     */
    void *user;
    /**
     * Curves, FPT_FAIR_ENERGY: weight of the integral of the squared change of the curvature vector along the arc length of the curve
     * as it becomes: (dk/ds)^2 of planar curves, (dk/ds)^2 + k^2 tau^2 in space; finite, >= 0. Default 0.
     */
    double slope;
} fpt_fair_options;

/**
 * A report in a few numbers: 40 bytes, frozen.
 */
typedef struct fpt_fair_summary {
    /**
     * The energy before the first step.
     */
    double energy_before;
    /**
     * The energy after the last step, never more.
     */
    double energy_after;
    /**
     * No point has moved farther from the point of the same parameters, proven; at most the deviation asked for.
     */
    double deviation;
    /**
     * Steps that lowered the energy.
     */
    uint64_t steps;
    /**
     * 1: the last steps changed the energy by less than a millionth.
     */
    uint32_t converged;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_fair_summary;

/**
 * The least and the greatest value of a quantity, each between two bounds: 96 bytes, frozen.
 */
typedef struct fpt_inspect_range {
    /**
     * Nothing is less than the first; something is not greater than the second.
     */
    double least[2];
    /**
     * Something is not less than the first; nothing is greater than the second.
     */
    double greatest[2];
    /**
     * Parameters where the inner bound of the least is attained; curves: u, 0.
     */
    double at_least[2];
    /**
     * Parameters where the inner bound of the greatest is attained; curves: u, 0.
     */
    double at_greatest[2];
    /**
     * Share of the domain that is left out: beside tips and cusps, where curvatures are not bounded. The bounds hold for the rest;
     * flags tells what is proven of the part that is left out, fpt_inspect_surface_range_places where it is.
     */
    double excluded;
    /**
     * Length. 0: the bounds are those of the shape. Otherwise those of a shape from which no point of this one is farther, which is
     * rounding: beside a pole the rounding of its coordinates alone makes curvatures infinite.
     */
    double moved;
    /**
     * Boxes looked at.
     */
    uint64_t boxes;
    /**
     * 1: both gaps are the allowed ones and nothing is excluded.
     */
    uint32_t proven;
    /**
     * Bits of fpt_inspect_range_flag: what is proven of tips and cusps, and of the rest.
     */
    uint32_t flags;
} fpt_inspect_range;

/**
 * A tooth of a curvature comb: 96 bytes, frozen.
 */
typedef struct fpt_inspect_tooth {
    /**
     * Parameter.
     */
    double u;
    /**
     * The point.
     */
    double point[3];
    /**
     * Unit tangent; 0 where the derivative vanishes.
     */
    double tangent[3];
    /**
     * Curvature times the unit normal: towards the centre of curvature.
     */
    double bend[3];
    /**
     * 1 / length, >= 0.
     */
    double curvature;
    /**
     * 1 / length; 0 where the curvature vanishes.
     */
    double torsion;
} fpt_inspect_tooth;

/**
 * The curvatures at one place of a surface: 136 bytes, frozen. All NaN but the last two where the parametrisation is singular.
 */
typedef struct fpt_inspect_curvature {
    /**
     * The point.
     */
    double point[3];
    /**
     * Unit normal, along S_u x S_v.
     */
    double normal[3];
    /**
     * Greater and less principal curvature; positive: towards the normal.
     */
    double principal[2];
    /**
     * Unit direction of the greater one, then of the less.
     */
    double directions[6];
    /**
     * Half their sum.
     */
    double mean;
    /**
     * Their product.
     */
    double gaussian;
    /**
     * 1: they are equal up to rounding, and the directions any.
     */
    uint32_t is_umbilic;
    /**
     * 1: the parametrisation is singular.
     */
    uint32_t is_singular;
} fpt_inspect_curvature;

/**
 * A place or a piece: 56 bytes, frozen.
 */
typedef struct fpt_inspect_place {
    /**
     * First and last u of the piece or box.
     */
    double u[2];
    /**
     * First and last v; curves: 0.
     */
    double v[2];
    /**
     * Monotone pieces: curvature at both ends. Inflections: the parameter, 0. Umbilics: difference of the principal curvatures at
     * the best place found, 0. FPT_PLACE_UNBOUNDED: the place u,v in the box near which every bound is passed.
     */
    double value[2];
    /**
     * A value of fpt_inspect_kind.
     */
    uint32_t kind;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_inspect_place;

/**
 * The greatest distance of a point of one shape from another: 48 bytes, frozen.
 */
typedef struct fpt_inspect_distance {
    /**
     * Some point is not nearer than this to the other shape.
     */
    double lower;
    /**
     * No point is farther than this from the other shape.
     */
    double upper;
    /**
     * Parameters of that point; curves: u, 0.
     */
    double at[2];
    /**
     * Boxes looked at.
     */
    uint64_t boxes;
    /**
     * 1: the gap is the allowed one.
     */
    uint32_t proven;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_inspect_distance;

/**
 * A greatest value and its bounds: 24 bytes, frozen.
 */
typedef struct fpt_inspect_measured {
    /**
     * Found somewhere.
     */
    double lower;
    /**
     * Nowhere more, proven.
     */
    double upper;
    /**
     * Parameter of the first border where the lower one is.
     */
    double at;
} fpt_inspect_measured;

/**
 * How two surfaces meet: 80 bytes, frozen.
 */
typedef struct fpt_inspect_continuity {
    /**
     * Greatest distance of a point of the first border from the second, length.
     */
    struct fpt_inspect_measured gap;
    /**
     * Greatest angle of the normals, radians, 0 to pi / 2; orientations do not count.
     */
    struct fpt_inspect_measured angle;
    /**
     * Greatest difference of the normal curvatures across the border, 1 / length.
     */
    struct fpt_inspect_measured curvature;
    /**
     * Intervals looked at.
     */
    uint64_t intervals;
} fpt_inspect_continuity;

/**
 * How intersections are computed. Fill it with fpt_hit_options_init, then change what matters. All zero after struct_size
 * is the default of everything. Grows at the end only.
 */
typedef struct fpt_hit_options {
    /**
     * sizeof(fpt_hit_options), set by fpt_hit_options_init.
     */
    size_t struct_size;
    /**
     * Length, finite, >= 0. Curves: places farther apart do not meet. Sections: what is smaller is not taken apart. 0: 1e-7 x
     * the diagonal of the (larger) box.
     */
    double tolerance;
    /**
     * Length, finite, >= 0: most distance of a branch from its polyline. 0: 1e-4 x the diagonal of the box.
     */
    double chord;
    /**
     * Most boxes; 0: the default, 1,000,000 for curves, 200,000 for a section.
     */
    uint64_t budget;
    /**
     * Threads of sections and rays; 0: all cores, 1: the calling thread only. The answers do not depend on it.
     */
    uint32_t threads;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED and what was found by then. NULL: never.
     */
    int (*should_stop)(void *user);
    /**
     * Told on the calling thread how many of all sections or rays are done. NULL: not wanted.
     */
    void (*progress)(void *user, size_t done, size_t total);
    /**
     * Handed to the callbacks as it is.
     */
    void *user;
} fpt_hit_options;

/**
 * A plane or a quadric in implicit form: 144 bytes, frozen. Fields that its kind does not name are not read.
 */
typedef struct fpt_quadric {
    /**
     * A value of fpt_quadric_kind.
     */
    uint32_t kind;
    /**
     * Must be 0.
     */
    uint32_t reserved;
    /**
     * A point: see the kind.
     */
    double origin[3];
    /**
     * A direction of any length but 0.
     */
    double axis[3];
    /**
     * A radius, or a cone's radius per unit of height.
     */
    double size;
    /**
     * A as xx, xy, xz, yy, yz, zz.
     */
    double matrix[6];
    /**
     * b.
     */
    double linear[3];
    /**
     * c.
     */
    double constant;
} fpt_quadric;

/**
 * Where a curve meets a curve, a surface or a quadric: 112 bytes, frozen.
 */
typedef struct fpt_curve_hit {
    /**
     * Parameter of the first curve, or first one of the surface; 0 for a quadric.
     */
    double u;
    /**
     * Second parameter of the surface, else 0.
     */
    double v;
    /**
     * Parameter of the (second) curve.
     */
    double w;
    /**
     * The first shape there; for a quadric the curve.
     */
    double point[3];
    /**
     * Distance between both there.
     */
    double distance;
    /**
     * Interval of u around the hit: outside of the intervals of all hits, and of the undecided boxes, the shapes are farther
     * apart than the tolerance.
     */
    double u_range[2];
    /**
     * The same for v.
     */
    double v_range[2];
    /**
     * The same for w; of an overlap, where they run together (outer).
     */
    double w_range[2];
    /**
     * A value of fpt_hit_nature.
     */
    uint32_t nature;
    /**
     * 1 at an angle; where they touch 2 when they stay on one side, 3 when they cross; 0 along an overlap.
     */
    uint32_t multiplicity;
} fpt_curve_hit;

/**
 * A branch of a section: 24 bytes, frozen.
 */
typedef struct fpt_branch {
    /**
     * Number of its points.
     */
    size_t point_count;
    /**
     * Values of fpt_section_end.
     */
    uint32_t ends[2];
    /**
     * 1: the surfaces touch all along it.
     */
    uint32_t tangential;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_branch;

/**
 * A single point of a section: 56 bytes, frozen.
 */
typedef struct fpt_section_point {
    /**
     * First parameter.
     */
    double u;
    /**
     * Second parameter.
     */
    double v;
    /**
     * The surface there.
     */
    double point[3];
    /**
     * About the distance from the quadric.
     */
    double distance;
    /**
     * Number of branches that meet here; 0: an isolated point of contact.
     */
    uint32_t arms;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_section_point;

/**
 * A part of the domain in a section: 40 bytes, frozen.
 */
typedef struct fpt_section_region {
    /**
     * u0, u1, v0, v1.
     */
    double domain[4];
    /**
     * 1: the surface lies in the quadric; 0: not decided, branches may be missing here.
     */
    uint32_t overlaps;
    /**
     * 0.
     */
    uint32_t reserved;
} fpt_section_region;

/**
 * A conic in space: 96 bytes, frozen.
 */
typedef struct fpt_conic {
    /**
     * A value of fpt_conic_kind.
     */
    uint32_t kind;
    /**
     * 0.
     */
    uint32_t reserved;
    /**
     * Centre, vertex, or a point.
     */
    double center[3];
    /**
     * Two unit vectors, one after the other; unused ones 0.
     */
    double axes[6];
    /**
     * Half lengths, or the focal length; unused ones 0.
     */
    double lengths[2];
} fpt_conic;

/**
 * A hit of a ray and a surface: 56 bytes, frozen. A ray without a hit has t infinite, NaN in u, v and point, and count 0; a ray
 * that was not reached when should_stop ended the call has t NaN and FPT_RAY_NOT_PROVEN.
 */
typedef struct fpt_ray_hit {
    /**
     * Length along the ray from its origin.
     */
    double t;
    /**
     * First parameter, in the domain.
     */
    double u;
    /**
     * Second parameter, in the domain.
     */
    double v;
    /**
     * The surface at (u,v), bit for bit what _evaluate returns there.
     */
    double point[3];
    /**
     * Sum of fpt_ray_flag values.
     */
    uint32_t flags;
    /**
     * fpt_caster_first: the number of all hits of the ray; in a list 1.
     */
    uint32_t count;
} fpt_ray_hit;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The text of the calling thread's last failure, "" when there was none. It names the parameter and
 * the index, for example "poles: pole 17 is not finite". Never NULL. A call that succeeds leaves it.
 * Valid until the same thread's next failure or its end; copy it to keep it.
 * @since 0.1
 */
const char *fpt_last_error(void);

/**
 * The name of a status, for example "FPT_INVALID_ARGUMENT"; "FPT_?" for a number that is none.
 * A constant of the library: never NULL, never freed.
 * @since 0.1
 */
const char *fpt_status_name(fpt_status status);

/**
 * The version of the library in use: major*1000000 + minor*1000 + patch, as FPT_VERSION of the header.
 * @since 0.1
 */
uint32_t fpt_version(void);

/**
 * The binary interface of the library in use: the number in its SONAME, written as one integer. The
 * SONAME is 0.MINOR while the major version is 0 and this returns MINOR; from 1.0 on the SONAME is
 * MAJOR and this returns major*1000. A program may use the library when this equals the
 * FPT_ABI_VERSION that it was compiled with.
 * @since 0.1
 */
uint32_t fpt_abi_version(void);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_query_options_init(struct fpt_query_options *options, size_t struct_size);

/**
 * Makes a curve from its inputs.
 *
 * @param data  the inputs, copied; a struct_size shorter than the struct is FPT_INVALID_ARGUMENT
 * @param out   the handle; release it with fpt_curve_free
 * @return FPT_INVALID_ARGUMENT names the array and the index of the first bad number
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_new(const struct fpt_curve_data *data, struct fpt_curve **out);

/**
 * Releases a curve. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_curve_free(struct fpt_curve *curve);

/**
 * The interval on which the curve is defined.
 *
 * @param out_u  2 numbers: start, end
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_domain(const struct fpt_curve *curve, double *out_u);

/**
 * The curve and its derivatives at one parameter. At a knot the piece on the right counts, at the
 * domain's end the one on the left.
 *
 * @param u            in the domain, else FPT_INVALID_ARGUMENT
 * @param derivatives  highest order d, at most 31; 0: the point only. More than 2 of a curve from a
 *                     callback: FPT_UNSUPPORTED
 * @param out          3*(d + 1) numbers: C, C', C'', ... with x,y,z each. Where a callback fails:
 *                     FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_evaluate(const struct fpt_curve *curve,
                              double u,
                              uint32_t derivatives,
                              double *out);

/**
 * The curve and its derivatives at many parameters, as fpt_curve_evaluate gives them one by one.
 *
 * @param parameters   `count` numbers, each in the domain; the error names the first that is not
 * @param count        may be 0
 * @param derivatives  highest order d, at most 31
 * @param out          count*3*(d + 1) numbers, the values of parameter i at i*3*(d + 1); must not
 *                     overlap `parameters`. Where a callback fails: FPT_INVALID_ARGUMENT, the values
 *                     before are written
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_evaluate_many(const struct fpt_curve *curve,
                                   const double *parameters,
                                   size_t count,
                                   uint32_t derivatives,
                                   double *out);

/**
 * The degree.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_degree(const struct fpt_curve *curve, size_t *out_degree);

/**
 * The number of poles.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_pole_count(const struct fpt_curve *curve, size_t *out_pole_count);

/**
 * The knots, bit for bit as they came in.
 *
 * @param capacity   how many numbers `out_knots` has room for; less than pole_count + degree + 1 is
 *                   FPT_INVALID_ARGUMENT
 * @param out_knots  pole_count + degree + 1 numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_knots(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out_knots);

/**
 * The poles, bit for bit as they came in.
 *
 * @param capacity   how many numbers `out_poles` has room for; less than 3*pole_count is
 *                   FPT_INVALID_ARGUMENT
 * @param out_poles  3*pole_count numbers: x,y,z of pole i at 3*i
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_poles(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out_poles);

/**
 * The weights as they came in; all 1 for a polynomial curve.
 *
 * @param capacity     how many numbers `out_weights` has room for; less than pole_count is
 *                     FPT_INVALID_ARGUMENT
 * @param out_weights  pole_count numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_weights(const struct fpt_curve *curve,
                             size_t capacity,
                             double *out_weights);

/**
 * The box of the poles that act on the domain, in which the curve lies. Its diagonal is what the default
 * tolerance and accuracy are relative to. Of a curve from a callback: the box of samples, which it may
 * leave between them.
 *
 * @param out_box  6 numbers: least x,y,z, then greatest x,y,z
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_box(const struct fpt_curve *curve,
                         double *out_box);

/**
 * Whether the curve has weights that differ: 1 or 0. 0 for a curve from a callback.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_is_rational(const struct fpt_curve *curve,
                                 int32_t *out_is_rational);

/**
 * Whether the curve ends where it starts, as geometry and not only by its knots: 1 or 0.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_is_closed(const struct fpt_curve *curve, int32_t *out_is_closed);

/**
 * Builds the search index now instead of on the first query. May be called again and from any thread.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_prepare(const struct fpt_curve *curve);

/**
 * Bytes that the library holds for the curve: the copies of its inputs, and the search index once it is built. What the
 * function of a callback keeps for itself is not counted.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_memory(const struct fpt_curve *curve,
                            size_t *out_memory);

/**
 * Makes a surface from its inputs.
 *
 * @param data  the inputs, copied; a struct_size shorter than the struct is FPT_INVALID_ARGUMENT
 * @param out   the handle; release it with fpt_surface_free
 * @return FPT_INVALID_ARGUMENT names the array and the index of the first bad number
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_new(const struct fpt_surface_data *data,
                           struct fpt_surface **out);

/**
 * Releases a surface. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_surface_free(struct fpt_surface *surface);

/**
 * The rectangle on which the surface is defined.
 *
 * @param out_uv  4 numbers: start and end of u, start and end of v
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_surface_domain(const struct fpt_surface *surface, double *out_uv);

/**
 * The surface and its partial derivatives at one pair of parameters. At a knot the piece on the right
 * counts, at the domain's end the one on the left.
 *
 * @param u            in the domain, else FPT_INVALID_ARGUMENT
 * @param v            in the domain, else FPT_INVALID_ARGUMENT
 * @param derivatives  highest total order d, at most 31; 0: the point only. More than 2 of a surface
 *                     from a callback: FPT_UNSUPPORTED
 * @param out          3*(d + 1)*(d + 2)/2 numbers, order by order: S; Su,Sv; Suu,Suv,Svv; ... with
 *                     x,y,z each. Where a callback fails: FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_evaluate(const struct fpt_surface *surface,
                                double u,
                                double v,
                                uint32_t derivatives,
                                double *out);

/**
 * The surface and its partial derivatives at many pairs of parameters, as fpt_surface_evaluate gives
 * them one by one.
 *
 * @param parameters   2*count numbers: u,v of pair i at 2*i, each in the domain; the error names the
 *                     first that is not
 * @param count        pairs; may be 0
 * @param derivatives  highest total order d, at most 31
 * @param out          count*n numbers with n = 3*(d + 1)*(d + 2)/2, the values of pair i at i*n; must
 *                     not overlap `parameters`. Where a callback fails: FPT_INVALID_ARGUMENT, the
 *                     values before are written
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_evaluate_many(const struct fpt_surface *surface,
                                     const double *parameters,
                                     size_t count,
                                     uint32_t derivatives,
                                     double *out);

/**
 * The degree in u.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_degree_u(const struct fpt_surface *surface,
                                size_t *out_degree_u);

/**
 * The degree in v.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_degree_v(const struct fpt_surface *surface,
                                size_t *out_degree_v);

/**
 * The number of poles in u.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_pole_count_u(const struct fpt_surface *surface,
                                    size_t *out_pole_count_u);

/**
 * The number of poles in v.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_pole_count_v(const struct fpt_surface *surface,
                                    size_t *out_pole_count_v);

/**
 * The knots in u, bit for bit as they came in.
 *
 * @param capacity     how many numbers `out_knots_u` has room for; less than
 *                     pole_count_u + degree_u + 1 is FPT_INVALID_ARGUMENT
 * @param out_knots_u  pole_count_u + degree_u + 1 numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_knots_u(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_knots_u);

/**
 * The knots in v, bit for bit as they came in.
 *
 * @param capacity     how many numbers `out_knots_v` has room for; less than
 *                     pole_count_v + degree_v + 1 is FPT_INVALID_ARGUMENT
 * @param out_knots_v  pole_count_v + degree_v + 1 numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_knots_v(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_knots_v);

/**
 * The poles, bit for bit as they came in.
 *
 * @param capacity   how many numbers `out_poles` has room for; less than
 *                   3*pole_count_u*pole_count_v is FPT_INVALID_ARGUMENT
 * @param out_poles  3*pole_count_u*pole_count_v numbers: x,y,z of pole (i,j) at
 *                   3*(i*pole_count_v + j)
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_poles(const struct fpt_surface *surface,
                             size_t capacity,
                             double *out_poles);

/**
 * The weights as they came in; all 1 for a polynomial surface.
 *
 * @param capacity     how many numbers `out_weights` has room for; less than
 *                     pole_count_u*pole_count_v is FPT_INVALID_ARGUMENT
 * @param out_weights  pole_count_u*pole_count_v numbers: of pole (i,j) at i*pole_count_v + j
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_weights(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_weights);

/**
 * The box of the poles that act on the domain, in which the surface lies. Its diagonal is what the default
 * tolerance and accuracy are relative to. Of a surface from a callback: the box of samples, which it may
 * leave between them.
 *
 * @param out_box  6 numbers: least x,y,z, then greatest x,y,z
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_box(const struct fpt_surface *surface,
                           double *out_box);

/**
 * Whether the surface has weights that differ: 1 or 0. 0 for a surface from a callback.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_is_rational(const struct fpt_surface *surface,
                                   int32_t *out_is_rational);

/**
 * Whether the edges at the start and the end of u are one curve, as geometry and not only by the
 * knots: 1 or 0.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_is_closed_u(const struct fpt_surface *surface,
                                   int32_t *out_is_closed_u);

/**
 * Whether the edges at the start and the end of v are one curve, as geometry and not only by the
 * knots: 1 or 0.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_is_closed_v(const struct fpt_surface *surface,
                                   int32_t *out_is_closed_v);

/**
 * Which edges of the domain are a single point in space.
 *
 * @param out_collapsed  4 numbers, 1 or 0: the edges at the start of u, the end of u, the start of v,
 *                       the end of v
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_collapsed_edges(const struct fpt_surface *surface,
                                       int32_t *out_collapsed);

/**
 * Builds the search index now instead of on the first query. May be called again and from any thread.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_prepare(const struct fpt_surface *surface);

/**
 * Bytes that the library holds for the surface: the copies of its inputs, and the search index once it is built (with more than
 * 131,072 patches: the parts of it that queries have visited). What the function of a callback keeps for itself is not
 * counted.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_memory(const struct fpt_surface *surface,
                              size_t *out_memory);

/**
 * Makes a curve from a function. It is used like any other curve; functions that need degree, knots, poles
 * or weights return FPT_UNSUPPORTED. A query looks at 20,000 boxes of parameters by default when a bound is
 * given (a preimage at 100,000), at 2,000 when there is none; finite differences use steps of 2^-17 of the domain for first
 * derivatives and for derivatives of given ones, 2^-13 for second differences of points, one-sided at the
 * ends. The function is called 129 times or more, for the box and to see whether the curve is closed.
 *
 * @param callback  the function and what is known about it. After a failure nothing of it is kept and
 *                  release is not called
 * @param out       the handle; release it with fpt_curve_free
 * @return FPT_INVALID_ARGUMENT for a domain that is empty, not finite or too narrow for its doubles, for a
 *         bound that is negative or not finite, or when the function fails at all samples
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_from_callback(const struct fpt_curve_callback *callback,
                                   struct fpt_curve **out);

/**
 * Makes a surface from a function. It is used like any other surface; functions that need degrees, knots,
 * poles or weights return FPT_UNSUPPORTED. Budget and finite differences are those of fpt_curve_from_callback. The
 * function is called 625 times or more, for the box, for closed directions and collapsed edges.
 *
 * @param callback  the function and what is known about it. After a failure nothing of it is kept and
 *                  release is not called
 * @param out       the handle; release it with fpt_surface_free
 * @return FPT_INVALID_ARGUMENT for a domain that is empty, not finite or too narrow for its doubles, for a
 *         bound that is negative or not finite, or when the function fails at all samples
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_from_callback(const struct fpt_surface_callback *callback,
                                     struct fpt_surface **out);

/**
 * The nearest point of the curve for each query point, with a proven lower bound of the distance.
 *
 * @param points   `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN,
 *                 infinite, beyond 1e100) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count    may be 0, then `points` and `out` may be NULL
 * @param options  NULL: the defaults
 * @param out      `count` records, packed; must not overlap `points` or the hints
 * @return FPT_CANCELLED when should_stop said so; then the records not reached have NaN in u, v, point
 *         and distance, lower_bound 0 and FPT_FOOT_NOT_PROVEN. After FPT_INTERNAL the records have no
 *         defined contents
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_closest(const struct fpt_curve *curve,
                             const double *points,
                             size_t count,
                             const struct fpt_query_options *options,
                             struct fpt_foot_point *out);

/**
 * The parameters of points that lie on the curve: as fpt_curve_closest, and points proven to be
 * farther than options->tolerance are marked with FPT_FOOT_NOT_ON_SHAPE.
 *
 * @param points   as for fpt_curve_closest
 * @param count    as for fpt_curve_closest
 * @param options  NULL: the defaults
 * @param out      as for fpt_curve_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_invert(const struct fpt_curve *curve,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out);

/**
 * The nearest point of the surface for each query point, with a proven lower bound of the distance.
 *
 * @param points   `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN,
 *                 infinite, beyond 1e100) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count    may be 0, then `points` and `out` may be NULL
 * @param options  NULL: the defaults
 * @param out      `count` records, packed; must not overlap `points` or the hints
 * @return FPT_CANCELLED when should_stop said so; then the records not reached have NaN in u, v, point
 *         and distance, lower_bound 0 and FPT_FOOT_NOT_PROVEN. After FPT_INTERNAL the records have no
 *         defined contents
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_closest(const struct fpt_surface *surface,
                               const double *points,
                               size_t count,
                               const struct fpt_query_options *options,
                               struct fpt_foot_point *out);

/**
 * The parameters of points that lie on the surface: as fpt_surface_closest, and points proven to be
 * farther than options->tolerance are marked with FPT_FOOT_NOT_ON_SHAPE.
 *
 * @param points   as for fpt_surface_closest
 * @param count    as for fpt_surface_closest
 * @param options  NULL: the defaults
 * @param out      as for fpt_surface_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_invert(const struct fpt_surface *surface,
                              const double *points,
                              size_t count,
                              const struct fpt_query_options *options,
                              struct fpt_foot_point *out);

/**
 * As fpt_curve_closest, for query points in single precision. The answers are those of the same numbers in double
 * precision, bit for bit.
 *
 * @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
 *                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count    may be 0, then `points` and `out` may be NULL
 * @param options  NULL: the defaults; hints are doubles
 * @param out      `count` records, packed; must not overlap `points` or the hints
 * @return as fpt_curve_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_closest_f32(const struct fpt_curve *curve,
                                 const float *points,
                                 size_t count,
                                 const struct fpt_query_options *options,
                                 struct fpt_foot_point *out);

/**
 * As fpt_curve_invert, for query points in single precision. A float is off by up to 6e-8 of its coordinates: the
 * tolerance has to allow for that.
 *
 * @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
 *                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count    may be 0, then `points` and `out` may be NULL
 * @param options  NULL: the defaults; hints are doubles
 * @param out      `count` records, packed; must not overlap `points` or the hints
 * @return as fpt_curve_invert
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_invert_f32(const struct fpt_curve *curve,
                                const float *points,
                                size_t count,
                                const struct fpt_query_options *options,
                                struct fpt_foot_point *out);

/**
 * As fpt_surface_closest, for query points in single precision. The answers are those of the same numbers in double
 * precision, bit for bit.
 *
 * @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
 *                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count    may be 0, then `points` and `out` may be NULL
 * @param options  NULL: the defaults; hints are doubles
 * @param out      `count` records, packed; must not overlap `points` or the hints
 * @return as fpt_surface_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_closest_f32(const struct fpt_surface *surface,
                                   const float *points,
                                   size_t count,
                                   const struct fpt_query_options *options,
                                   struct fpt_foot_point *out);

/**
 * As fpt_surface_invert, for query points in single precision. A float is off by up to 6e-8 of its coordinates: the
 * tolerance has to allow for that.
 *
 * @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
 *                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count    may be 0, then `points` and `out` may be NULL
 * @param options  NULL: the defaults; hints are doubles
 * @param out      `count` records, packed; must not overlap `points` or the hints
 * @return as fpt_surface_invert
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_invert_f32(const struct fpt_surface *surface,
                                  const float *points,
                                  size_t count,
                                  const struct fpt_query_options *options,
                                  struct fpt_foot_point *out);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_extrema_options_init(struct fpt_extrema_options *options, size_t struct_size);

/**
 * All parameters of a curve whose point lies within a tolerance of a point, with proof that none is missing.
 *
 * Isolated parameters are members of kind point (a closed curve's seam gives two, a self-intersection as many as
 * branches), spans without length are arcs. Members come in the order of u.
 *
 * @param point      3 finite numbers
 * @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the curve's box. Never less than the rounding
 *                   of curve and point
 * @param options    domain, budget (0: 20,000 boxes; a shape from a callback: 100,000), should_stop and user
 *                   count; NULL: the defaults
 * @param out        the set; release it with fpt_foot_set_free. Empty when nothing is within the tolerance
 * @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided intervals; of a curve from a
 *         callback without the bounds that it takes, always, with the whole domain undecided
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_preimage(const struct fpt_curve *curve,
                              const double *point,
                              double tolerance,
                              const struct fpt_query_options *options,
                              struct fpt_foot_set **out);

/**
 * All parameters of a surface whose point lies within a tolerance of a point, with proof that none is missing.
 *
 * A point on a seam has two members (at a corner of two seams four), a self-intersection as many as branches; collapsed
 * edges and strips without width are arcs. Members come in the order of u, then v, so that the canonical one of a
 * seam is first.
 *
 * @param point      3 finite numbers
 * @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box. Never less than the rounding
 *                   of surface and point
 * @param options    domain, budget (0: 20,000 boxes; a shape from a callback: 100,000), should_stop and user
 *                   count; NULL: the defaults
 * @param out        the set; release it with fpt_foot_set_free. Empty when nothing is within the tolerance
 * @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided boxes; of a surface from a
 *         callback without the bounds that it takes, always, with the whole domain undecided
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_preimage(const struct fpt_surface *surface,
                                const double *point,
                                double tolerance,
                                const struct fpt_query_options *options,
                                struct fpt_foot_set **out);

/**
 * All points of a curve where the distance from a point is stationary, with proof that none is missing: nearest first.
 *
 * Ends of the curve (not of a closed one) and of a restriction count: minimum or maximum among the points of the
 * domain. At a break of the tangent the distance must rise or fall to both sides.
 *
 * @param point    3 finite numbers
 * @param options  NULL: the defaults
 * @param out      the set; release it with fpt_foot_set_free
 * @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided intervals; of a curve from a
 *         callback without the bounds that it takes, always, with the whole domain undecided
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_extrema(const struct fpt_curve *curve,
                             const double *point,
                             const struct fpt_extrema_options *options,
                             struct fpt_foot_set **out);

/**
 * All points of a surface where the distance from a point is stationary, with proof that none is missing: nearest first.
 *
 * Inside: minima, maxima, saddles. On the border of the domain (not on seams) and of a restriction: points where
 * the distance is stationary along the border, and corners; they are minimum, maximum or saddle among the points of
 * the domain. On creases: points where it is stationary along the crease and rises or falls to both sides. A collapsed
 * edge counts when it is a minimum or maximum. Continua (the axis of a surface of revolution, the centre of a
 * sphere) are arcs or regions with FPT_FOOT_CONTINUUM.
 *
 * @param point    3 finite numbers
 * @param options  NULL: the defaults
 * @param out      the set; release it with fpt_foot_set_free
 * @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided boxes; of a surface from a
 *         callback without the bounds that it takes, always, with the whole domain undecided
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_extrema(const struct fpt_surface *surface,
                               const double *point,
                               const struct fpt_extrema_options *options,
                               struct fpt_foot_set **out);

/**
 * The number of members.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_foot_set_count(const struct fpt_foot_set *set, size_t *out_count);

/**
 * A member.
 *
 * @param index  below the count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_foot_set_get(const struct fpt_foot_set *set,
                            size_t index,
                            struct fpt_foot_member *out);

/**
 * The number of boxes that are undecided: 0 for a complete set.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_foot_set_undecided_count(const struct fpt_foot_set *set,
                                        size_t *out_count);

/**
 * A box that is undecided: more members may lie in it.
 *
 * @param index   below the count, else FPT_INVALID_ARGUMENT
 * @param out_uv  4 numbers: start and end of u, start and end of v (0, 0 on a curve)
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_foot_set_undecided_get(const struct fpt_foot_set *set,
                                      size_t index,
                                      double *out_uv);

/**
 * Releases a set. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_foot_set_free(struct fpt_foot_set *set);

/**
 * All parameters of a curve whose point lies within a tolerance of a line, or of a part of it (a ray), with proof that
 * none is missing, in the order along the line. The distance of a member is that from the line.
 *
 * @param origin     3 finite numbers: a point of the line
 * @param direction  3 finite numbers, not all 0; its length does not matter
 * @param reach      2 numbers: least and greatest length along the direction from the origin, infinities allowed (a ray: 0
 *                   and infinity); NULL: the whole line
 * @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the curve's box
 * @param options    as for fpt_curve_preimage
 * @param out        the set; release it with fpt_foot_set_free
 * @return as fpt_curve_preimage
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_on_line(const struct fpt_curve *curve,
                             const double *origin,
                             const double *direction,
                             const double *reach,
                             double tolerance,
                             const struct fpt_query_options *options,
                             struct fpt_foot_set **out);

/**
 * All parameters of a surface whose point lies within a tolerance of a line, or of a part of it (a ray), with proof
 * that none is missing, in the order along the line. The distance of a member is that from the line.
 *
 * Crossings and touching points are members of kind point; where the line runs in the surface along a parameter
 * line the member is an arc.
 *
 * @param origin     3 finite numbers: a point of the line
 * @param direction  3 finite numbers, not all 0; its length does not matter
 * @param reach      2 numbers: least and greatest length along the direction from the origin, infinities allowed (a ray: 0
 *                   and infinity); NULL: the whole line
 * @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box
 * @param options    as for fpt_surface_preimage
 * @param out        the set; release it with fpt_foot_set_free
 * @return as fpt_surface_preimage
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_on_line(const struct fpt_surface *surface,
                               const double *origin,
                               const double *direction,
                               const double *reach,
                               double tolerance,
                               const struct fpt_query_options *options,
                               struct fpt_foot_set **out);

/**
 * The point of a curve on the line through each query point along a direction, to either side, that is nearest to the
 * query point.
 *
 * A record has distance = |query - point|, and lower_bound: nothing of the curve within the tolerance of the line
 * is nearer. Where the line misses the curve the record has FPT_FOOT_NOT_ON_SHAPE, NaN in u, v and point, and an infinite
 * distance. FPT_FOOT_NOT_PROVEN with FPT_FOOT_BUDGET: parts of the curve were not decided.
 *
 * @param points     as for fpt_curve_closest
 * @param count      as for fpt_curve_closest
 * @param direction  3 finite numbers, not all 0; its length does not matter
 * @param options    tolerance: how far from the line counts as on it (0: 1e-7 x the diagonal of the curve's box);
 *                   hints, method, scope and trace are not used; NULL: the defaults
 * @param out        as for fpt_curve_closest
 * @return as fpt_curve_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_project(const struct fpt_curve *curve,
                             const double *points,
                             size_t count,
                             const double *direction,
                             const struct fpt_query_options *options,
                             struct fpt_foot_point *out);

/**
 * The point of a surface on the line through each query point along a direction, to either side, that is nearest to the
 * query point: as fpt_curve_project.
 *
 * @param points     as for fpt_surface_closest
 * @param count      as for fpt_surface_closest
 * @param direction  3 finite numbers, not all 0; its length does not matter
 * @param options    as for fpt_curve_project
 * @param out        as for fpt_surface_closest
 * @return as fpt_surface_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_project(const struct fpt_surface *surface,
                               const double *points,
                               size_t count,
                               const double *direction,
                               const struct fpt_query_options *options,
                               struct fpt_foot_point *out);

/**
 * The unit normal of the surface at each foot, in the direction of Su x Sv, and on which side of the surface the
 * query lies.
 *
 * At a crease, a corner of patches or the tip of a cone the normal is the mean of the patches' normals weighted by
 * the angles of the patches there; with it, other than with the normal of one patch, the sign is right
 * wherever the surface does not cross itself near the foot. At collapsed edges and where derivatives vanish or are
 * parallel it is a limit (FPT_NORMAL_LIMIT). For a closed surface the sign tells inside from outside.
 *
 * @param points      x,y,z of the query of each foot, packed; NULL: normals only, then `out_signed` must be NULL
 * @param feet        `count` records, as the query functions give them, of this surface. NaN parameters have no
 *                    normal; parameters outside the domain are FPT_INVALID_ARGUMENT
 * @param count       may be 0
 * @param out_normals 3*count numbers; NaN where there is no normal (FPT_NORMAL_UNDEFINED)
 * @param out_signed  `count` numbers or NULL: |query - foot| where the query is on the normal's side, else
 *                    -|query - foot|; without a normal positive, for a bad query NaN
 * @param out_flags   `count` numbers or NULL: sums of fpt_normal_flag values
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_normals(const struct fpt_surface *surface,
                               const double *points,
                               const struct fpt_foot_point *feet,
                               size_t count,
                               double *out_normals,
                               double *out_signed,
                               uint32_t *out_flags);

/**
 * The unit tangent of the curve at each foot, in the direction of growing u. Where the derivative vanishes it is that of
 * the first derivative that does not (FPT_NORMAL_LIMIT); where the tangent breaks (corners, cusps, the seam
 * of a closed curve) it is that of the piece above, at the end of the domain of the one below (FPT_NORMAL_CREASE).
 *
 * @param feet         `count` records of this curve. NaN parameters have no tangent; parameters outside the domain
 *                     are FPT_INVALID_ARGUMENT
 * @param count        may be 0
 * @param out_tangents 3*count numbers; NaN where there is none (FPT_NORMAL_UNDEFINED)
 * @param out_flags    `count` numbers or NULL: sums of fpt_normal_flag values
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_tangents(const struct fpt_curve *curve,
                              const struct fpt_foot_point *feet,
                              size_t count,
                              double *out_tangents,
                              uint32_t *out_flags);

/**
 * The curve and its derivatives on one side of a parameter: they differ at knots only.
 *
 * @param u            in the domain, else FPT_INVALID_ARGUMENT
 * @param side         -1: the piece below; +1: the piece above; 0: as fpt_curve_evaluate, which is the piece above.
 *                     At an end of the domain every side is the piece inside, on closed curves too
 * @param derivatives  highest order d, at most 31; 0: the point only
 * @param out          3*(d + 1) numbers: C, C', C'', ... with x,y,z each. Below a knot C may differ from that of
 *                     fpt_curve_evaluate by rounding
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_evaluate_sided(const struct fpt_curve *curve,
                                    double u,
                                    int32_t side,
                                    uint32_t derivatives,
                                    double *out);

/**
 * The surface and its partial derivatives on one side in each direction: they differ at knot lines only.
 *
 * @param u            in the domain, else FPT_INVALID_ARGUMENT
 * @param v            in the domain, else FPT_INVALID_ARGUMENT
 * @param side_u       -1: the piece below u; +1: the piece above; 0: as fpt_surface_evaluate, which is the piece
 *                     above. At an end of the domain every side is the piece inside, in closed directions too
 * @param side_v       the same in v
 * @param derivatives  highest total order d, at most 31; 0: the point only
 * @param out          3*(d + 1)*(d + 2)/2 numbers, as for fpt_surface_evaluate. Below a knot the point may differ from
 *                     that of fpt_surface_evaluate by rounding
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_evaluate_sided(const struct fpt_surface *surface,
                                      double u,
                                      double v,
                                      int32_t side_u,
                                      int32_t side_v,
                                      uint32_t derivatives,
                                      double *out);

/**
 * How well each foot fixes its parameter: how far u may move while the point moves by at most the accuracy.
 *
 * @param feet      `count` records of this curve; NaN parameters give NaN
 * @param count     may be 0
 * @param accuracy  length, finite, >= 0; 0: 1e-10 x the diagonal of the curve's box
 * @param out       `count` numbers: the greater step of both directions, right within a factor of two; at most what
 *                  the domain leaves, on a closed curve its length
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_uncertainty(const struct fpt_curve *curve,
                                 const struct fpt_foot_point *feet,
                                 size_t count,
                                 double accuracy,
                                 double *out);

/**
 * How well each foot fixes its parameters: how far u and v may move (together) while the point moves by at most the
 * accuracy. Near a regular point these are the half extents of an ellipse; at cusps they are larger, and at a collapsed
 * edge the parameter along it is free.
 *
 * @param feet      `count` records of this surface; NaN parameters give NaN
 * @param count     may be 0
 * @param accuracy  length, finite, >= 0; 0: 1e-10 x the diagonal of the surface's box
 * @param out       2*count numbers: for u and for v the greater step of both directions, right within a factor of
 *                  two; at most what the domain leaves, in a closed direction its length
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_uncertainty(const struct fpt_surface *surface,
                                   const struct fpt_foot_point *feet,
                                   size_t count,
                                   double accuracy,
                                   double *out);

/**
 * The parameter that continues a path on a closed curve: u plus the whole number of turns (lengths of the domain) that
 * brings it nearest to the previous one; of two as near the lesser. On an open curve u itself.
 *
 * @param previous  the unwrapped parameter before; finite, at most 1e9 turns away
 * @param u         in the domain, else FPT_INVALID_ARGUMENT
 * @param out_u     the unwrapped parameter
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_unwrap(const struct fpt_curve *curve,
                            double previous,
                            double u,
                            double *out_u);

/**
 * The parameters that continue a path on a surface: in a closed direction plus the whole number of turns that brings the
 * parameter nearest to the previous one (of two as near the lesser), in an open one as they are.
 *
 * @param previous  2 numbers: the unwrapped parameters before; finite, at most 1e9 turns away
 * @param uv        2 numbers in the domain, else FPT_INVALID_ARGUMENT
 * @param out_uv    2 numbers: the unwrapped parameters
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_unwrap(const struct fpt_surface *surface,
                              const double *previous,
                              const double *uv,
                              double *out_uv);

/**
 * The parameters of a polyline of points along the curve, as a path: each answer is that of fpt_curve_invert for the point
 * alone, with the same distance, but where another foot is as near within the accuracy the one that continues the
 * path is taken. A bad point is stepped over.
 *
 * @param points        as for fpt_curve_closest, in the order of the path
 * @param count         as for fpt_curve_closest
 * @param options       NULL: the defaults
 * @param out           as for fpt_curve_closest
 * @param out_unwrapped `count` numbers or NULL: u with whole turns of a closed curve, consecutive along the path; NaN
 *                      for a bad point
 * @param out_changes   `count` numbers or NULL: sums of fpt_path_change values, about the step to each point
 * @return after FPT_CANCELLED `out` is as fpt_curve_closest leaves it, perhaps not yet joined; the other arrays have
 *         no defined contents
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_path(const struct fpt_curve *curve,
                          const double *points,
                          size_t count,
                          const struct fpt_query_options *options,
                          struct fpt_foot_point *out,
                          double *out_unwrapped,
                          uint32_t *out_changes);

/**
 * The parameters of a polyline of points along the surface, as a path: as fpt_curve_path, and on a collapsed edge the
 * parameter along it stays what it was before.
 *
 * @param points        as for fpt_surface_closest, in the order of the path
 * @param count         as for fpt_surface_closest
 * @param options       NULL: the defaults
 * @param out           as for fpt_surface_closest
 * @param out_unwrapped 2*count numbers or NULL: u, v with whole turns in closed directions, consecutive along the path;
 *                      NaN for a bad point
 * @param out_changes   `count` numbers or NULL: sums of fpt_path_change values, about the step to each point
 * @return as fpt_curve_path
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_path(const struct fpt_surface *surface,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out,
                            double *out_unwrapped,
                            uint32_t *out_changes);

/**
 * Makes a scene of its members, which are numbered from 0 as they come.
 *
 * @param data  the members; a struct_size shorter than the struct is FPT_INVALID_ARGUMENT
 * @param out   the handle; release it with fpt_scene_free
 * @return FPT_INVALID_ARGUMENT names the first bad member ("members: member 17: placement[3] is not finite"),
 *         FPT_UNSUPPORTED a member that is given by a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_new(const struct fpt_scene_data *data,
                         struct fpt_scene **out);

/**
 * Releases a scene, not the handles that it was made from. NULL is fine. No other call may use the handle during or after
 * this one.
 * @since 0.1
 */
void fpt_scene_free(struct fpt_scene *scene);

/**
 * The number of members.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_scene_count(const struct fpt_scene *scene, size_t *out_count);

/**
 * A member's shape as a new handle that shares everything with it: one of both outputs is the handle, to be released by its
 * _free, the other is NULL.
 *
 * @param member       less than the count
 * @param out_curve    the curve, or NULL for a surface
 * @param out_surface  the surface, or NULL for a curve
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_shape(const struct fpt_scene *scene,
                           uint32_t member,
                           struct fpt_curve **out_curve,
                           struct fpt_surface **out_surface);

/**
 * Where a member stands, as it is used: the nearest rotation to the one that was given.
 *
 * @param member         less than the count
 * @param out_placement  12 numbers, as fpt_scene_member.placement
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_placement(const struct fpt_scene *scene,
                               uint32_t member,
                               double *out_placement);

/**
 * The box in which all members lie. Its diagonal is what the default tolerance and accuracy are relative to.
 *
 * @param out_box  6 numbers: least x,y,z, then greatest x,y,z
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_box(const struct fpt_scene *scene,
                         double *out_box);

/**
 * Bytes that the library holds for the scene: members, tree, and the shapes with what is built of their search indexes, each
 * shape once, whether or not other handles share it.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_memory(const struct fpt_scene *scene,
                            size_t *out_memory);

/**
 * Builds the search indexes of all members now, on all cores, instead of on the first query. May be called again and from
 * any thread.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_prepare(const struct fpt_scene *scene);

/**
 * A member's point and derivatives where it stands. The point has the bits that a foot's `point` has there: the shape's
 * point x by fpt_curve_evaluate or fpt_surface_evaluate, then per coordinate
 * ((r0*x[0] + r1*x[1]) + r2*x[2]) + t, each operation rounded, with the numbers of fpt_scene_placement; without a
 * placement the shape's point itself.
 *
 * @param member       less than the count
 * @param u            in the member's domain, else FPT_INVALID_ARGUMENT
 * @param v            in the member's domain, else FPT_INVALID_ARGUMENT; on a curve it is not looked at
 * @param derivatives  highest (total) order d, at most 31; 0: the point only
 * @param out          of a curve 3*(d + 1) numbers as fpt_curve_evaluate, of a surface 3*(d + 1)*(d + 2)/2 as
 *                     fpt_surface_evaluate
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_evaluate(const struct fpt_scene *scene,
                              uint32_t member,
                              double u,
                              double v,
                              uint32_t derivatives,
                              double *out);

/**
 * The nearest point of all members of the scene for each query point, with a proven lower bound of the distance: as
 * fpt_surface_closest, for all members at once.
 *
 * The records' `u` and `v` are parameters of the member that is named beside them; `point` is where it stands (see
 * fpt_scene_evaluate); `lower_bound` holds for every member. Of members at the same distance the lowest number is named. A
 * foot of another member within the accuracy sets FPT_FOOT_TIE when it is another point in space; where members
 * meet, or lie upon each other, their common point is one foot. The bound allows for the rounding of the placements.
 * options->budget is that of each member that a query comes to. FPT_SCOPE_LOCAL iterates on the hint's member only,
 * without a hint on one whose box is nearest.
 *
 * @param points       `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN, infinite, beyond
 *                     1e100) marks its own record with FPT_FOOT_BAD_QUERY
 * @param count        may be 0, then all arrays may be NULL
 * @param options      NULL: the defaults, relative to the diagonal of the scene's box. `domain` must be all 0 and `trace`
 *                     NULL: FPT_UNSUPPORTED. `hints` hold (u,v) of the hinted member, on a curve v is not looked at
 * @param hint_members the member to begin with, per query; UINT32_MAX: no hint for this query. With options->hints the
 *                     search begins there, where they are NULL or NaN with the member alone. Any other number
 *                     that is not a member's is FPT_INVALID_ARGUMENT. NULL: no hints, then options->hints must be NULL too
 * @param out          `count` records, packed; must not overlap `points` or the hints
 * @param out_members  `count` members' numbers, UINT32_MAX where there is no foot; NULL: not wanted
 * @return as fpt_surface_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_closest(const struct fpt_scene *scene,
                             const double *points,
                             size_t count,
                             const struct fpt_query_options *options,
                             const uint32_t *hint_members,
                             struct fpt_foot_point *out,
                             uint32_t *out_members);

/**
 * The members and parameters of points that lie in the scene: as fpt_scene_closest, and points proven to be farther from
 * every member than options->tolerance are marked with FPT_FOOT_NOT_ON_SHAPE.
 *
 * @param points       as for fpt_scene_closest
 * @param count        as for fpt_scene_closest
 * @param options      as for fpt_scene_closest
 * @param hint_members as for fpt_scene_closest
 * @param out          as for fpt_scene_closest
 * @param out_members  as for fpt_scene_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_invert(const struct fpt_scene *scene,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            const uint32_t *hint_members,
                            struct fpt_foot_point *out,
                            uint32_t *out_members);

/**
 * As fpt_scene_closest, for query points in single precision; see fpt_surface_closest_f32.
 *
 * @param points       `count` query points x,y,z, options->point_stride bytes apart, without alignment
 * @param count        as for fpt_scene_closest
 * @param options      as for fpt_scene_closest; hints are doubles
 * @param hint_members as for fpt_scene_closest
 * @param out          as for fpt_scene_closest
 * @param out_members  as for fpt_scene_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_closest_f32(const struct fpt_scene *scene,
                                 const float *points,
                                 size_t count,
                                 const struct fpt_query_options *options,
                                 const uint32_t *hint_members,
                                 struct fpt_foot_point *out,
                                 uint32_t *out_members);

/**
 * As fpt_scene_invert, for query points in single precision; see fpt_surface_invert_f32.
 *
 * @param points       `count` query points x,y,z, options->point_stride bytes apart, without alignment
 * @param count        as for fpt_scene_closest
 * @param options      as for fpt_scene_closest; hints are doubles
 * @param hint_members as for fpt_scene_closest
 * @param out          as for fpt_scene_closest
 * @param out_members  as for fpt_scene_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_invert_f32(const struct fpt_scene *scene,
                                const float *points,
                                size_t count,
                                const struct fpt_query_options *options,
                                const uint32_t *hint_members,
                                struct fpt_foot_point *out,
                                uint32_t *out_members);

/**
 * The unit normal of the member at each foot, turned with it, and on which side of it the query lies: as
 * fpt_surface_normals. Feet on curves and feet without a member have no normal (FPT_NORMAL_UNDEFINED).
 *
 * The side is that of the one member: where the members together bound a solid, feet on their common edges and corners
 * tell the side of one face only.
 *
 * @param points      x,y,z of the query of each foot, packed; NULL: normals only, then `out_signed` must be NULL
 * @param feet        `count` records, as fpt_scene_closest gives them. Parameters outside the member's domain are
 *                    FPT_INVALID_ARGUMENT; NaN parameters have no normal
 * @param members     `count` numbers beside them; UINT32_MAX: no member
 * @param count       may be 0
 * @param out_normals 3*count numbers; NaN where there is no normal
 * @param out_signed  `count` numbers or NULL, as for fpt_surface_normals
 * @param out_flags   `count` numbers or NULL: sums of fpt_normal_flag values
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_scene_normals(const struct fpt_scene *scene,
                             const double *points,
                             const struct fpt_foot_point *feet,
                             const uint32_t *members,
                             size_t count,
                             double *out_normals,
                             double *out_signed,
                             uint32_t *out_flags);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_weights_options_init(struct fpt_weights_options *options, size_t struct_size);

/**
 * The general formula: each pole's weight is 1/lambda - 1 for the relative distance lambda of the curve from it.
 *
 * lambda is distance over chord distance, the chord being the segment between the two points of the curve where the pole's basis
 * function begins and ends (of one span: from the first to the last point; of a closed curve of one span: that point). A pole on
 * its chord, like the ends of a clamped curve, has weight 1 and no wish. The wish in the report is lambda x the chord distance; a formula
 * does not meet it exactly.
 *
 * @param lambdas       one a pole, each between 0 and 1, both excluded; the error names the first that is not
 * @param lambda_count  the number of poles
 * @param options       range of the weights and tolerance count; NULL: the defaults
 * @param out           the report; release it with fpt_weights_report_free
 * @return FPT_INVALID_ARGUMENT also for a pole that coincides with its neighbour, FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_general(const struct fpt_curve *curve,
                               const double *lambdas,
                               size_t lambda_count,
                               const struct fpt_weights_options *options,
                               struct fpt_weights_report **out);

/**
 * Linear interpolation: distances run evenly, in the order of the poles, from first_distance to last_distance; weights as
 * fpt_weights_general. The run may rise, fall or stay. A distance that is not less than that of the chord, or whose weight is outside
 * the range, takes the nearest weight of the range (FPT_WEIGHT_LIMITED).
 *
 * @param first_distance  of the first pole, finite, >= 0
 * @param last_distance   of the last pole, finite, >= 0
 * @param options         range of the weights and tolerance count; NULL: the defaults
 * @param out             the report; release it with fpt_weights_report_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_interpolated(const struct fpt_curve *curve,
                                    double first_distance,
                                    double last_distance,
                                    const struct fpt_weights_options *options,
                                    struct fpt_weights_report **out);

/**
 * The embedded network: wished distances for some poles; the distances of all others, by the formula, stay within a range. It is
 * trained inside the call, in at most `steps` steps, and has the same bits for the same inputs and seed.
 *
 * Without wishes all weights are random within the range; with a wish for each pole, or with equal ends of the range, they are those of
 * the formula. A pole whose chord distance is not more than min_distance has no weight in the range: it gets the least weight
 * (FPT_WEIGHT_LIMITED).
 *
 * @param wish_poles      `wish_count` numbers of poles, none twice
 * @param wish_distances  `wish_count` distances within the range
 * @param wish_count      0: no wishes, both arrays may be NULL
 * @param min_distance    finite, >= 0
 * @param max_distance    finite, at least min_distance
 * @param options         range of the weights, tolerance, seed and steps count; NULL: the defaults
 * @param out             the report; release it with fpt_weights_report_free
 * @return FPT_INVALID_ARGUMENT names the wish; also for one at a pole that coincides with its neighbour
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_network(const struct fpt_curve *curve,
                               const size_t *wish_poles,
                               const double *wish_distances,
                               size_t wish_count,
                               double min_distance,
                               double max_distance,
                               const struct fpt_weights_options *options,
                               struct fpt_weights_report **out);

/**
 * Weights whose curve really has the wished distances from its poles and meets the constraints, measured and bounded by
 * fpt_curve_closest; the weights of poles without a wish are as near 1 as they can be (all, when each pole has one).
 *
 * A wish that is not met, or proven impossible for all weights of the range, is reported, with the best weights found. The given weights of
 * the curve only matter for FPT_CONSTRAINT_TANGENT_KEPT, and as one start. About a millisecond for 10 poles; wishes that
 * cannot be met take up to `starts` searches.
 *
 * @param wish_poles        `wish_count` numbers of poles, none twice
 * @param wish_distances    `wish_count` distances, finite, >= 0
 * @param wish_count        0: no wishes, both arrays may be NULL
 * @param constraints       `constraint_count` constraints
 * @param constraint_count  0: none, the array may be NULL
 * @param options           NULL: the defaults
 * @param out               the report; release it with fpt_weights_report_free
 * @return FPT_INVALID_ARGUMENT names the wish or constraint; also for a wish at a pole that coincides with its neighbour
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_refine_curve(const struct fpt_curve *curve,
                                    const size_t *wish_poles,
                                    const double *wish_distances,
                                    size_t wish_count,
                                    const struct fpt_weights_constraint *constraints,
                                    size_t constraint_count,
                                    const struct fpt_weights_options *options,
                                    struct fpt_weights_report **out);

/**
 * As fpt_weights_refine_curve, for the weights of a surface; pole (i,j) is number i*pole_count_v + j. Tangent constraints are
 * FPT_UNSUPPORTED.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_refine_surface(const struct fpt_surface *surface,
                                      const size_t *wish_poles,
                                      const double *wish_distances,
                                      size_t wish_count,
                                      const struct fpt_weights_constraint *constraints,
                                      size_t constraint_count,
                                      const struct fpt_weights_options *options,
                                      struct fpt_weights_report **out);

/**
 * The number of poles.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_pole_count(const struct fpt_weights_report *report,
                                         size_t *out_count);

/**
 * A pole's part.
 *
 * @param index  below the count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_pole(const struct fpt_weights_report *report,
                                   size_t index,
                                   struct fpt_weights_pole *out);

/**
 * All weights, in the order of the poles.
 *
 * @param capacity     numbers that out_weights has room for, at least the number of poles
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_weights(const struct fpt_weights_report *report,
                                      size_t capacity,
                                      double *out_weights);

/**
 * What came of a constraint.
 *
 * @param index  as in the call that made the report; beyond its constraints FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_constraint(const struct fpt_weights_report *report,
                                         size_t index,
                                         struct fpt_weights_outcome *out);

/**
 * The report in a few numbers.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_summary(const struct fpt_weights_report *report,
                                      struct fpt_weights_summary *out);

/**
 * The curve with the weights found, as a new handle; FPT_UNSUPPORTED for a report of a surface.
 *
 * @param out  the curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_curve(const struct fpt_weights_report *report,
                                    struct fpt_curve **out);

/**
 * The surface with the weights found, as a new handle; FPT_UNSUPPORTED for a report of a curve.
 *
 * @param out  the surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_report_surface(const struct fpt_weights_report *report,
                                      struct fpt_surface **out);

/**
 * Releases a report. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_weights_report_free(struct fpt_weights_report *report);

/**
 * The weight of a pole that moves one point of the curve towards it; the other weights stay.
 *
 * @param u           parameter of the point, in the domain; the pole's basis function must not be 0 or the only one there
 * @param pole        below the number of poles
 * @param distance    by how much, less than the distance from the pole; negative: away from it, less than to where the point is
 *                    without the pole
 * @param out_weight  the new weight of the pole
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_move_point(const struct fpt_curve *curve,
                                  double u,
                                  size_t pole,
                                  double distance,
                                  double *out_weight);

/**
 * The weight of a pole with which the curve passes through a point; the other weights stay. The line from the pole through the point
 * must cross the curve, and the point lie on it between the pole and the curve for weight 0; of several weights the one that
 * changes least is taken.
 *
 * @param pole        below the number of poles
 * @param point       3 finite numbers
 * @param tolerance   length, finite, >= 0: how far the curve may pass. 0: 1e-7 x the diagonal of the poles' box
 * @param out_weight  the new weight of the pole
 * @param out_foot    the nearest point of the curve with that weight to the point, with its bound; NULL: not wanted
 * @return FPT_INVALID_ARGUMENT when no weight of that pole takes the curve there
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_through_point(const struct fpt_curve *curve,
                                     size_t pole,
                                     const double *point,
                                     double tolerance,
                                     double *out_weight,
                                     struct fpt_foot_point *out_foot);

/**
 * The shape of the conic over three poles.
 *
 * @param poles    9 finite numbers, x,y,z each; not in one line
 * @param weights  3 positive numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_conic(const double *poles,
                             const double *weights,
                             struct fpt_weights_conic_shape *out);

/**
 * The middle weight of a conic with end weights 1 for a shape factor rho, between 0 and 1: rho / (1 - rho).
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_of_rho(double rho,
                              double *out_weight);

/**
 * The middle weights with which the conic over three poles, end weights 1, has an eccentricity.
 *
 * @param poles         9 finite numbers, x,y,z each; not in one line
 * @param eccentricity  finite, >= 0
 * @param out_weights   room for 2 numbers, in rising order; what is not found is NaN
 * @param out_count     0, 1 or 2: how many there are. A circle needs legs of equal length
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_of_eccentricity(const double *poles,
                                       double eccentricity,
                                       double *out_weights,
                                       size_t *out_count);

/**
 * Weights divided by one number: the same shape.
 *
 * @param weights      `count` numbers, 1e-100 to 1e100
 * @param count        at least 1
 * @param unit         a value of fpt_weights_unit
 * @param out_weights  room for `count` numbers; must not overlap `weights`
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_normalise(const double *weights,
                                 size_t count,
                                 uint32_t unit,
                                 double *out_weights);

/**
 * Weights whose greatest is at most `ratio` times the least: those outside a range in the middle of the given ones move to its ends.
 * The shape changes. fpt_weights_standard_form may lessen the spread without that.
 *
 * @param weights      `count` numbers, 1e-100 to 1e100
 * @param count        at least 1
 * @param ratio        at least 1
 * @param out_weights  room for `count` numbers; must not overlap `weights`
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_bound(const double *weights,
                             size_t count,
                             double ratio,
                             double *out_weights);

/**
 * The same curve with both end weights 1: a rational change of the parameter, same poles and domain, other weights and inner knots.
 *
 * @param out  the curve; release it with fpt_curve_free
 * @return FPT_UNSUPPORTED for a curve whose ends are not clamped
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_standard_form(const struct fpt_curve *curve,
                                     struct fpt_curve **out);

/**
 * A curve with positive weights from homogeneous data whose weights may be zero or negative: the same curve, with more poles where
 * that is needed. It exists when the denominator does not vanish in the domain.
 *
 * @param degree      1 to 31
 * @param pole_count  at least degree + 1
 * @param knots       pole_count + degree + 1 numbers, as fpt_curve_data.knots
 * @param poles       wx,wy,wz,w of pole i at 4*i: coordinates multiplied by the weight
 * @param out         the curve; release it with fpt_curve_free
 * @return FPT_UNSUPPORTED when the denominator vanishes (an end weight of 0 is such a case) or comes too near to 0 to tell; the text
 *         has the parameter
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_weights_positive_form(size_t degree,
                                     size_t pole_count,
                                     const double *knots,
                                     const double *poles,
                                     struct fpt_curve **out);

/**
 * The same curve with more knots. Exact.
 *
 * @param values  knots to add, in any order, each as often as it stands; in the domain. The ends may then be knots degree + 1 times,
 *                others degree times
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_refine(const struct fpt_curve *curve,
                            const double *values,
                            size_t value_count,
                            struct fpt_curve **out);

/**
 * The curve without some copies of a knot.
 *
 * @param u      a knot inside the domain
 * @param times  at most how often it is a knot
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_remove_knot(const struct fpt_curve *curve,
                                 double u,
                                 size_t times,
                                 double *out_error,
                                 struct fpt_curve **out);

/**
 * The curve without the knots that are not needed to stay within a tolerance; the one whose removal changes least goes first.
 *
 * @param tolerance  length, finite, >= 0; the error is at most that
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_simplify(const struct fpt_curve *curve,
                              double tolerance,
                              double *out_error,
                              struct fpt_curve **out);

/**
 * The part of the curve between two parameters, clamped, with its parameters. Exact.
 *
 * @param start  in the domain
 * @param end    in the domain, greater than start
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_part(const struct fpt_curve *curve,
                          double start,
                          double end,
                          struct fpt_curve **out);

/**
 * The same curve with clamped ends: the first and the last pole are its end points. Exact. Also the way back from fpt_curve_periodic.
 *
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_clamp(const struct fpt_curve *curve,
                           struct fpt_curve **out);

/**
 * The same curve with unclamped ends, knots outside the domain mirrored from those inside.
 *
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_unclamp(const struct fpt_curve *curve,
                             double *out_error,
                             struct fpt_curve **out);

/**
 * The periodic form of a closed curve, unrolled: knots repeat after a period, poles after as many as a period has knots. The
 * seam is the smoothest one that keeps the error within the tolerance.
 *
 * @param tolerance  length, finite, >= 0
 * @return FPT_INVALID_ARGUMENT when the curve is not closed within the tolerance
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_periodic(const struct fpt_curve *curve,
                              double tolerance,
                              double *out_error,
                              struct fpt_curve **out);

/**
 * The same curve with a higher degree; its smoothness at the knots stays. Exact.
 *
 * @param by  how many degrees more; the degree is at most 31
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_elevate(const struct fpt_curve *curve,
                             size_t by,
                             struct fpt_curve **out);

/**
 * The clamped curve of a degree lower by one that is nearest in its poles; exact where the curve is of that degree.
 *
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_reduce(const struct fpt_curve *curve,
                            double *out_error,
                            struct fpt_curve **out);

/**
 * The same curve run through backwards, over the same domain. Exact.
 *
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_reverse(const struct fpt_curve *curve, struct fpt_curve **out);

/**
 * The same curve over another domain, by an affine change of the parameter. Exact.
 *
 * @param start  finite
 * @param end    finite, greater than start
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_with_domain(const struct fpt_curve *curve,
                                 double start,
                                 double end,
                                 struct fpt_curve **out);

/**
 * The same curve, clamped, in a parameter that is a Moebius function of the old one, over the same domain. Exact; a polynomial curve becomes
 * rational. With x and y the shares of the domain before the old and the new parameter: y = speed x / (1 + (speed - 1) x).
 *
 * @param speed  derivative of the new parameter by the old one at the start; finite, > 0
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_reparametrise(const struct fpt_curve *curve,
                                   double speed,
                                   struct fpt_curve **out);

/**
 * The curve of the points A (x, y, z, 1). Exact.
 *
 * @param matrix  12 finite numbers, 3 rows of 4; may be singular
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_affine(const struct fpt_curve *curve,
                            const double *matrix,
                            struct fpt_curve **out);

/**
 * The curve of the points (x', y', z') / w' with (x', y', z', w') = A (x, y, z, 1). Exact.
 *
 * @param matrix  16 finite numbers, 4 rows of 4
 * @return FPT_UNSUPPORTED when poles lie on both sides of the plane that goes to infinity, or on it; refine the curve then
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_projective(const struct fpt_curve *curve,
                                const double *matrix,
                                struct fpt_curve **out);

/**
 * The derivative as a curve: of one degree less (at least 1), or of twice the degree if the curve is rational (degree up to 15). Exact.
 *
 * @return FPT_UNSUPPORTED when the derivative jumps at a knot, which is named
 *
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_derivative(const struct fpt_curve *curve,
                                struct fpt_curve **out);

/**
 * The same curve with knots of full multiplicity: piece i has the poles from i * degree to i * degree + degree. Exact.
 *
 * @param out  the new curve; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_bezier_form(const struct fpt_curve *curve,
                                 struct fpt_curve **out);

/**
 * The parts of the curve before and behind a parameter. Exact.
 *
 * @param u  inside the domain
 * @param out_before  the first part; release it with fpt_curve_free
 * @param out_behind  the second part; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_split(const struct fpt_curve *curve,
                           double u,
                           struct fpt_curve **out_before,
                           struct fpt_curve **out_behind);

/**
 * The curves as one, each beginning where the one before ends. Each keeps its speed: its domain is shifted. The knot where two meet is one degree
 * times; fpt_curve_simplify takes out what is not needed.
 *
 * @param curves     live handles
 * @param tolerance  length, finite, >= 0: a start may be so far from the end before it, and is moved there
 * @param out_error  how far points move by that, proven; NULL: not wanted
 * @param out        the new curve; release it with fpt_curve_free
 * @return FPT_INVALID_ARGUMENT names the first curve that begins elsewhere
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_join(const struct fpt_curve *const *curves,
                          size_t count,
                          double tolerance,
                          double *out_error,
                          struct fpt_curve **out);

/**
 * The same curves, clamped, with one degree, one knot vector and the domain of the first; if one is rational, all have weights. Exact.
 *
 * @param curves  live handles, at least one
 * @param out     room for count handles; release each with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_make_compatible(const struct fpt_curve *const *curves,
                                     size_t count,
                                     struct fpt_curve **out);

/**
 * How far two curves over the same domain are apart at equal parameters; degrees and knots may differ.
 *
 * @param curve  a spline
 * @param other  a spline over the same domain
 * @param out    bound and what is reached, within 0.1 % of each other but for rounding and rare shapes
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_difference(const struct fpt_curve *curve,
                                const struct fpt_curve *other,
                                struct fpt_difference *out);

/**
 * The same surface with more knots in a direction. Exact.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param values  as in fpt_curve_refine
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_refine(const struct fpt_surface *surface,
                              uint32_t direction,
                              const double *values,
                              size_t value_count,
                              struct fpt_surface **out);

/**
 * The surface without some copies of a knot.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param value  a knot inside the domain
 * @param times  at most how often it is a knot
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_remove_knot(const struct fpt_surface *surface,
                                   uint32_t direction,
                                   double value,
                                   size_t times,
                                   double *out_error,
                                   struct fpt_surface **out);

/**
 * The surface without the knots that are not needed to stay within a tolerance, first along u, then along v.
 *
 * @param tolerance  length, finite, >= 0; the error is at most that
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_simplify(const struct fpt_surface *surface,
                                double tolerance,
                                double *out_error,
                                struct fpt_surface **out);

/**
 * The part of the surface over a rectangle of the domain, clamped, with its parameters. Exact.
 *
 * @param domain  u0, u1, v0, v1 in the domain, u0 < u1, v0 < v1
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_part(const struct fpt_surface *surface,
                            const double *domain,
                            struct fpt_surface **out);

/**
 * The same surface with clamped ends: its borders are rows and columns of poles. Exact. Also the way back from fpt_surface_periodic.
 *
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_clamp(const struct fpt_surface *surface,
                             struct fpt_surface **out);

/**
 * The same surface with unclamped ends in a direction, as fpt_curve_unclamp.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_unclamp(const struct fpt_surface *surface,
                               uint32_t direction,
                               double *out_error,
                               struct fpt_surface **out);

/**
 * The periodic form of a surface that is closed in a direction, as fpt_curve_periodic.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param tolerance  length, finite, >= 0
 * @return FPT_INVALID_ARGUMENT when the surface is not closed within the tolerance
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_periodic(const struct fpt_surface *surface,
                                uint32_t direction,
                                double tolerance,
                                double *out_error,
                                struct fpt_surface **out);

/**
 * The same surface with a higher degree in a direction. Exact.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param by  how many degrees more; the degree is at most 31
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_elevate(const struct fpt_surface *surface,
                               uint32_t direction,
                               size_t by,
                               struct fpt_surface **out);

/**
 * The clamped surface of a degree lower by one in a direction that is nearest in its poles.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param out_error  the proven error, a length; NULL: not wanted
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_reduce(const struct fpt_surface *surface,
                              uint32_t direction,
                              double *out_error,
                              struct fpt_surface **out);

/**
 * The same surface with a direction run through backwards, over the same domain. Exact.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_reverse(const struct fpt_surface *surface,
                               uint32_t direction,
                               struct fpt_surface **out);

/**
 * The same surface with its directions exchanged: new (v, u) is old (u, v). Exact.
 *
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_swap(const struct fpt_surface *surface,
                            struct fpt_surface **out);

/**
 * The same surface over another domain, by affine changes of both parameters. Exact.
 *
 * @param domain  u0, u1, v0, v1, finite, u0 < u1, v0 < v1
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_with_domain(const struct fpt_surface *surface,
                                   const double *domain,
                                   struct fpt_surface **out);

/**
 * The same surface, clamped, in a parameter that is a Moebius function of the old one, as fpt_curve_reparametrise. Exact.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param speed  finite, > 0
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_reparametrise(const struct fpt_surface *surface,
                                     uint32_t direction,
                                     double speed,
                                     struct fpt_surface **out);

/**
 * The surface of the points A (x, y, z, 1). Exact.
 *
 * @param matrix  12 finite numbers, 3 rows of 4; may be singular
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_affine(const struct fpt_surface *surface,
                              const double *matrix,
                              struct fpt_surface **out);

/**
 * The surface of the points (x', y', z') / w', as fpt_curve_projective. Exact.
 *
 * @param matrix  16 finite numbers, 4 rows of 4
 * @return FPT_UNSUPPORTED when poles lie on both sides of the plane that goes to infinity, or on it
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_projective(const struct fpt_surface *surface,
                                  const double *matrix,
                                  struct fpt_surface **out);

/**
 * The derivative in a direction as a surface: of one degree less in it (at least 1), or of twice the degrees if the surface is rational
 * (degrees up to 15). Exact.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @return FPT_UNSUPPORTED when the derivative jumps at a knot, which is named
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_derivative(const struct fpt_surface *surface,
                                  uint32_t direction,
                                  struct fpt_surface **out);

/**
 * The same surface with knots of full multiplicity: patch (i, j) has the poles from (i * degree_u, j * degree_v) on. Exact.
 *
 * @param out  the new surface; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_bezier_form(const struct fpt_surface *surface,
                                   struct fpt_surface **out);

/**
 * The parts of the surface before and behind an isocurve. Exact.
 *
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param at  inside the domain
 * @param out_before  the first part; release it with fpt_surface_free
 * @param out_behind  the second part; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_split(const struct fpt_surface *surface,
                             uint32_t direction,
                             double at,
                             struct fpt_surface **out_before,
                             struct fpt_surface **out_behind);

/**
 * The curve on the surface with one parameter fixed. Exact.
 *
 * @param direction  of the parameter that is fixed: FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param at   in the domain
 * @param out  the curve, over the other parameter; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_isocurve(const struct fpt_surface *surface,
                                uint32_t direction,
                                double at,
                                struct fpt_curve **out);

/**
 * The surfaces as one along a direction, each beginning where the one before ends, as fpt_curve_join. In the other direction all get the domain of
 * the first.
 *
 * @param surfaces   live handles
 * @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
 * @param tolerance  length, finite, >= 0
 * @param out_error  how far points move, proven; NULL: not wanted
 * @param out        the new surface; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED when weights do not agree where two meet
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_join(const struct fpt_surface *const *surfaces,
                            size_t count,
                            uint32_t direction,
                            double tolerance,
                            double *out_error,
                            struct fpt_surface **out);

/**
 * The same surfaces, clamped, with the same degrees, knot vectors and domain, as fpt_curve_make_compatible. Exact.
 *
 * @param surfaces  live handles, at least one
 * @param out       room for count handles; release each with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_make_compatible(const struct fpt_surface *const *surfaces,
                                       size_t count,
                                       struct fpt_surface **out);

/**
 * How far two surfaces over the same domain are apart at equal parameters; degrees and knots may differ.
 *
 * @param surface  a spline
 * @param other    a spline over the same domain
 * @param out      as in fpt_curve_difference
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_difference(const struct fpt_surface *surface,
                                  const struct fpt_surface *other,
                                  struct fpt_difference *out);

/**
 * Measures the arc length of a curve.
 *
 * @param tolerance  length, finite, >= 0: the proven error of the whole, or what rounding allows; 0: 1e-12 of the length
 * @param out        the handle; release it with fpt_arc_length_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_arc_length_new(const struct fpt_curve *curve,
                              double tolerance,
                              struct fpt_arc_length **out);

/**
 * Releases an arc length. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_arc_length_free(struct fpt_arc_length *length);

/**
 * The length of the whole curve.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_arc_length_total(const struct fpt_arc_length *length,
                                struct fpt_estimate *out);

/**
 * The lengths from the start of the curve to parameters.
 *
 * @param parameters  in the domain; the error names the first that is not
 * @param out         count records
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_arc_length_at(const struct fpt_arc_length *length,
                             const double *parameters,
                             size_t count,
                             struct fpt_estimate *out);

/**
 * The parameters of lengths from the start of the curve.
 *
 * @param lengths  0 to the length of the curve; the error names the first that is not
 * @param out      count records: a parameter, and as its error a length, how far the length to there may be from the wanted one
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_arc_length_parameters(const struct fpt_arc_length *length,
                                     const double *lengths,
                                     size_t count,
                                     struct fpt_estimate *out);

/**
 * Tangent, normals, curvature and torsion of a curve.
 *
 * @param u     in the domain
 * @param side  -1: of the piece that ends there, where u is a knot; else of the one that begins there
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_frame(const struct fpt_curve *curve,
                           double u,
                           int32_t side,
                           struct fpt_curve_frame_record *out);

/**
 * How the pieces of a curve meet at its knots inside the domain and, if it is closed, at the seam.
 *
 * @param tolerance  0 to 1: a jump of a derivative counts beyond this share of what the derivative can be; 1e-9 is a good choice
 * @param capacity   room in out; one record a knot value is enough
 * @param out_count  the number of records, also when there is not room for all
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_continuity(const struct fpt_curve *curve,
                                double tolerance,
                                size_t capacity,
                                struct fpt_joint *out,
                                size_t *out_count);

/**
 * The powers of a local parameter t, 0 to 1 on each span of the domain: w x, w y, w z, w of t^k of span i at 4 * (i * (degree + 1) + k). The ends of
 * the spans are the knots of the domain, each once. Loses digits as the degree grows.
 *
 * @param capacity   room in out, in numbers
 * @param out_count  how many there are: 4 * spans * (degree + 1); FPT_INVALID_ARGUMENT when there is not room for all
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_power(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out,
                           size_t *out_count);

/**
 * The Bezier curve of powers of a local parameter, 0 at start and 1 at end.
 *
 * @param coefficients  4 * (degree + 1) numbers: w x, w y, w z, w of t^k; polynomial: w is 1 for k = 0, else 0
 * @param out           the curve; release it with fpt_curve_free
 * @return FPT_UNSUPPORTED when a Bezier weight is not positive
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_from_power(size_t degree,
                                double start,
                                double end,
                                const double *coefficients,
                                struct fpt_curve **out);

/**
 * How the pieces of a surface meet along its knot lines of a direction inside the domain and, if it is closed there, along the seam.
 *
 * @param direction  FPT_DIRECTION_U: lines of constant u; or FPT_DIRECTION_V
 * @param tolerance  as in fpt_curve_continuity
 * @param capacity   room in out; one record a knot value is enough
 * @param out_count  the number of records, also when there is not room for all
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_continuity(const struct fpt_surface *surface,
                                  uint32_t direction,
                                  double tolerance,
                                  size_t capacity,
                                  struct fpt_knot_line *out,
                                  size_t *out_count);

/**
 * The powers of local parameters s and t, each 0 to 1 on every patch: w x, w y, w z, w of s^k t^l of patch (i,j) at
 * 4 * (((i * patches_v + j) * (degree_u + 1) + k) * (degree_v + 1) + l). As fpt_curve_power.
 *
 * @param capacity   room in out, in numbers
 * @param out_count  how many there are: 4 * patches * (degree_u + 1) * (degree_v + 1); FPT_INVALID_ARGUMENT when there is not room for all
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_power(const struct fpt_surface *surface,
                             size_t capacity,
                             double *out,
                             size_t *out_count);

/**
 * The Bezier patch of powers of local parameters, 0 at the beginnings of the domain and 1 at its ends.
 *
 * @param degree_u      1 to 31
 * @param degree_v      1 to 31
 * @param domain        u0,u1,v0,v1
 * @param coefficients  4 * (degree_u + 1) * (degree_v + 1) numbers: w x, w y, w z, w of s^k t^l at 4 * (k * (degree_v + 1) + l); polynomial:
 *                      w is 1 for k = l = 0, else 0
 * @param out           the surface; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED when a Bezier weight is not positive
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_from_power(size_t degree_u,
                                  size_t degree_v,
                                  const double *domain,
                                  const double *coefficients,
                                  struct fpt_surface **out);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_fit_options_init(struct fpt_fit_options *options, size_t struct_size);

/**
 * Parameters from 0 to 1 for points in order.
 *
 * @param points   x,y,z of `count` points, at least 2, not all the same
 * @param spacing  a value of fpt_spacing
 * @param out      `count` numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fit_parameters(const double *points,
                              size_t count,
                              uint32_t spacing,
                              double *out);

/**
 * The curve through points in order.
 *
 * @param points      x,y,z of `count` points, at least degree + 1 (fewer with conditions at the ends)
 * @param parameters  one a point, strictly increasing; a periodic curve has one more, the end of the turn. NULL: options->spacing
 * @param options     degree_u, spacing, condition and tangents count; NULL: a cubic at chordal parameters
 * @param out         the handle; release it with fpt_curve_free. A periodic curve comes unrolled
 * @return FPT_INVALID_ARGUMENT names the first bad number, also for points that determine no such curve in doubles
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_interpolate(const double *points,
                                 size_t count,
                                 const double *parameters,
                                 const struct fpt_fit_options *options,
                                 struct fpt_curve **out);

/**
 * The curve on given knots that is nearest to points in the sense of least squares.
 *
 * @param points      x,y,z of `count` points
 * @param parameters  one a point, not decreasing, in the domain of the knots
 * @param degree      1 to 31
 * @param knots       repeats written out; every pole must see enough of the points
 * @param knot_count  number of poles + degree + 1
 * @param free_ends   0: the curve begins in the first point and ends in the last (clamped knots; their parameters are the ends of the
 *                    domain); 1: ends are like other points
 * @param out         the handle; release it with fpt_curve_free
 * @param result      distances at the parameters (at_least is 0, unproven is count); NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_least_squares(const double *points,
                                   size_t count,
                                   const double *parameters,
                                   size_t degree,
                                   const double *knots,
                                   size_t knot_count,
                                   uint32_t free_ends,
                                   struct fpt_curve **out,
                                   struct fpt_fit_result *result);

/**
 * A curve near points in order, from the first to the last: knots are added until no point is farther from the curve than the
 * tolerance. Parameters are corrected to the feet of the points. Where the tolerance is not reached, with max_poles or with points that
 * contradict each other, result->worst is above it and the best curve comes all the same: look.
 *
 * @param points      x,y,z of `count` points
 * @param parameters  where the search begins, not decreasing; NULL: options->spacing
 * @param options     must not be NULL: tolerance; degree_u, spacing, max_poles, keep_parameters, threads and should_stop count
 * @param out         the handle; release it with fpt_curve_free
 * @param result      distances of the points from the curve, with proof; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_fit(const double *points,
                         size_t count,
                         const double *parameters,
                         const struct fpt_fit_options *options,
                         struct fpt_curve **out,
                         struct fpt_fit_result *result);

/**
 * The surface through a grid of points.
 *
 * @param points   x,y,z of point (i,j) at 3*(i*count_v + j)
 * @param count_u  at least degree_u + 1
 * @param count_v  at least degree_v + 1
 * @param options  degrees and spacing count (parameters are means over all rows); NULL: bicubic, chordal
 * @param out      the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_interpolate(const double *points,
                                   size_t count_u,
                                   size_t count_v,
                                   const struct fpt_fit_options *options,
                                   struct fpt_surface **out);

/**
 * A surface near a grid of points: knots are added in both directions until no point is farther than the tolerance from the surface at
 * the point's parameters, an upper bound of its distance. Corners are met. Where the tolerance is not reached result->worst is above it.
 * Cost: about 15 ms for 100,000 points; certified, 35 ms.
 *
 * @param points   x,y,z of point (i,j) at 3*(i*count_v + j)
 * @param options  must not be NULL: tolerance; degrees, spacing, max_poles, certify, threads and should_stop count
 * @param out      the handle; release it with fpt_surface_free
 * @param result   distances; without `certify` at the parameters (at_least is 0, unproven is the number of points). NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_fit_grid(const double *points,
                                size_t count_u,
                                size_t count_v,
                                const struct fpt_fit_options *options,
                                struct fpt_surface **out,
                                struct fpt_fit_result *result);

/**
 * A surface near points in any order: knots are added until no point is farther from the surface than the tolerance. Parameters are
 * corrected to the feet of the points. Where there are no points the surface runs smoothly on. Where the tolerance is not reached
 * result->worst is above it and the best surface comes all the same: look.
 *
 * @param points      x,y,z of `count` points
 * @param parameters  u,v of each point, where the search begins, for example feet on a surface that is roughly there; their box is
 *                    the domain. NULL: in the plane nearest to the points
 * @param options     must not be NULL: tolerance; degrees, max_poles, keep_parameters, threads and should_stop count
 * @param out         the handle; release it with fpt_surface_free
 * @param result      distances of the points from the surface, with proof; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_fit(const double *points,
                           size_t count,
                           const double *parameters,
                           const struct fpt_fit_options *options,
                           struct fpt_surface **out,
                           struct fpt_fit_result *result);

/**
 * The segment between two points, by its length from 0 on.
 *
 * @param start  x,y,z
 * @param end    x,y,z, another point
 * @param out    the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_line(const double *start,
                          const double *end,
                          struct fpt_curve **out);

/**
 * The arc of the circle or ellipse origin + radius_x cos t X + radius_y sin t Y.
 *
 * @param axes    9 numbers: the origin, the axis Z, and a direction whose part across Z is X (any lengths); NULL: the coordinate axes
 * @param start   t of its begin, in radians
 * @param end     t of its end, more than start by at most a turn
 * @param form    a value of fpt_arc_form
 * @param out     the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_arc(const double *axes,
                         double radius_x,
                         double radius_y,
                         double start,
                         double end,
                         uint32_t form,
                         struct fpt_curve **out);

/**
 * The arc of a circle through three points, from the first over the second to the third, in quadratic pieces.
 *
 * @param points  x,y,z of three points that are not on a line
 * @param out     the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_arc_through(const double *points,
                                 struct fpt_curve **out);

/**
 * The conic over a triangle: from its first pole to its third, along the sides at both.
 *
 * @param poles  x,y,z of three poles
 * @param rho    shape factor between 0 and 1: ellipse below 1/2, parabola at 1/2, hyperbola above
 * @param out    the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_conic(const double *poles, double rho, struct fpt_curve **out);

/**
 * The arc of the parabola origin + t^2/(4 focal) X + t Y between two t, which are its parameters.
 *
 * @param axes   as fpt_curve_arc
 * @param focal  distance of the focus from the apex, more than 0
 * @param out    the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_parabola(const double *axes,
                              double focal,
                              double start,
                              double end,
                              struct fpt_curve **out);

/**
 * The arc of the hyperbola origin + radius_x cosh t X + radius_y sinh t Y between two t; its parameter runs from 0 to 1.
 *
 * @param axes  as fpt_curve_arc
 * @param out   the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_hyperbola(const double *axes,
                               double radius_x,
                               double radius_y,
                               double start,
                               double end,
                               struct fpt_curve **out);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_sweep_options_init(struct fpt_sweep_options *options, size_t struct_size);

/**
 * The part of a quadric between two angles about its axis (u, over [0, 1]) and two parameters of its profile (v).
 *
 * @param kind       a value of fpt_quadric_patch
 * @param axes       as fpt_curve_arc
 * @param semi_axes  3 numbers more than 0: across along X, across along Y, along the axis
 * @param angles     begin and end in radians, at most a turn
 * @param profile    begin and end of t
 * @param form       a value of fpt_arc_form, for u
 * @param out        the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_quadric(uint32_t kind,
                               const double *axes,
                               const double *semi_axes,
                               const double *angles,
                               const double *profile,
                               uint32_t form,
                               struct fpt_surface **out);

/**
 * The hyperbolic paraboloid origin + x X + y Y + (x^2/radius_x^2 - y^2/radius_y^2) Z over a rectangle of x and y, its parameters.
 *
 * @param axes    as fpt_curve_arc
 * @param domain  4 numbers: x0, x1, y0, y1
 * @param out     the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_saddle(const double *axes,
                              double radius_x,
                              double radius_y,
                              const double *domain,
                              struct fpt_surface **out);

/**
 * The rectangle origin + u X + v Y.
 *
 * @param axes    as fpt_curve_arc
 * @param domain  4 numbers: u0, u1, v0, v1
 * @param out     the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_plane(const double *axes,
                             const double *domain,
                             struct fpt_surface **out);

/**
 * A torus, or a part of it; u runs about the axis and v about the tube, both over [0, 1].
 *
 * @param axes      as fpt_curve_arc
 * @param major     radius of the circle of centres, more than 0
 * @param minor     radius of the tube, more than 0
 * @param angles_u  begin and end in radians, at most a turn
 * @param angles_v  the same about the tube; 0 is outside
 * @param form      FPT_ARC_QUARTERS, FPT_ARC_HALVES or FPT_ARC_THIRDS, for both
 * @param out       the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_torus(const double *axes,
                             double major,
                             double minor,
                             const double *angles_u,
                             const double *angles_v,
                             uint32_t form,
                             struct fpt_surface **out);

/**
 * The surface of the lines between points of two curves at equal parameters (affinely, over the domain of the first): u along the
 * curves, v from 0 on the first to 1 on the second.
 *
 * @param out  the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_ruled(const struct fpt_curve *first,
                             const struct fpt_curve *second,
                             struct fpt_surface **out);

/**
 * The surface C(u) + v * direction, v from 0 to 1.
 *
 * @param direction  x,y,z, not 0
 * @param out        the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_extruded(const struct fpt_curve *curve,
                                const double *direction,
                                struct fpt_surface **out);

/**
 * A curve turned about an axis: u the angle over [0, 1], v the parameter of the curve.
 *
 * @param origin  x,y,z of a point of the axis
 * @param axis    its direction, any length
 * @param angles  begin and end in radians, right-handed, at most a turn
 * @param form    FPT_ARC_QUARTERS, FPT_ARC_HALVES or FPT_ARC_THIRDS
 * @param out     the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_revolved(const struct fpt_curve *curve,
                                const double *origin,
                                const double *axis,
                                const double *angles,
                                uint32_t form,
                                struct fpt_surface **out);

/**
 * A curve carried along another without turning: C(u) + T(v) - T(v0). Exact.
 *
 * @param out  the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_translational(const struct fpt_curve *curve,
                                     const struct fpt_curve *spine,
                                     struct fpt_surface **out);

/**
 * The bilinearly blended Coons patch of four borders.
 *
 * @param borders  4 handles: along u = u0, u = u1 (in v), v = v0, v = v1 (in u); they meet at the corners within 1e-7 of their size.
 *                 Rational borders are kept as point sets, not in time
 * @param out      the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED also for rational borders whose blend has a weight that is not positive
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_coons(const struct fpt_curve *const *borders,
                             struct fpt_surface **out);

/**
 * The bicubically blended Coons patch: four borders, and the derivatives across them.
 *
 * @param borders  as fpt_surface_coons; polynomial; opposite ones over the same domain
 * @param slopes   4 handles in the same order: curves whose points are S_u along the first two, S_v along the last two, over the
 *                 same domains. At a corner they are the derivatives of the borders there, and their own derivatives agree
 * @param out      the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_coons_bicubic(const struct fpt_curve *const *borders,
                                     const struct fpt_curve *const *slopes,
                                     struct fpt_surface **out);

/**
 * The bicubic patch over [0, 1] x [0, 1] with given corners, slopes and twists (Ferguson, Hermite).
 *
 * @param points    x,y,z at (0,0), (0,1), (1,0), (1,1) as (u,v)
 * @param slopes_u  S_u in the same order
 * @param slopes_v  S_v in the same order
 * @param twists    S_uv in the same order; NULL: 0
 * @param out       the handle; release it with fpt_surface_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_ferguson(const double *points,
                                const double *slopes_u,
                                const double *slopes_v,
                                const double *twists,
                                struct fpt_surface **out);

/**
 * The Gordon surface through a network of polynomial curves that cross.
 *
 * @param curves_u      `count_u` handles of curves in u, at least 2
 * @param parameters_v  the v of each, strictly increasing, over the domain of the first of curves_v
 * @param curves_v      `count_v` handles of curves in v, at least 2
 * @param parameters_u  the u of each, strictly increasing, over the domain of the first of curves_u
 * @param out           the handle; release it with fpt_surface_free
 * @return FPT_INVALID_ARGUMENT names curves that are more than 1e-7 of their size apart where they should cross
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_gordon(const struct fpt_curve *const *curves_u,
                              const double *parameters_v,
                              size_t count_u,
                              const struct fpt_curve *const *curves_v,
                              const double *parameters_u,
                              size_t count_v,
                              struct fpt_surface **out);

/**
 * The surface through sections: u along them, v across.
 *
 * @param sections    `count` handles in order, at least 2; over the domain of the first, affinely
 * @param degree      across, 1 to count - 1
 * @param parameters  v of the sections, strictly increasing; NULL: from 0 to 1, by the distances of their poles
 * @param out         the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED also for rational sections between which a weight would not be positive
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_skinned(const struct fpt_curve *const *sections,
                               size_t count,
                               size_t degree,
                               const double *parameters,
                               struct fpt_surface **out);

/**
 * A profile carried along a spine in a rotation minimising frame: it keeps its place relative to the spine's begin. u along the profile,
 * v is the parameter of the spine.
 *
 * @param options   must not be NULL: tolerance
 * @param out       the handle; release it with fpt_surface_free
 * @param error     no point is farther from the exact swept surface at its parameters, proven; above the tolerance where max_poles or rounding
 *                  do not allow it, infinite where nothing is proven (rational spines of degrees above 13). NULL: not wanted
 * @param holonomy  radians by which the frame has turned about the tangent after one way round a closed spine; 0 for open ones. NULL: not
 *                  wanted
 * @return FPT_UNSUPPORTED for spines with a corner or that stand still, with the parameter
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_swept(const struct fpt_curve *profile,
                             const struct fpt_curve *spine,
                             const struct fpt_sweep_options *options,
                             struct fpt_surface **out,
                             double *error,
                             double *holonomy);

/**
 * The exact offset of a spline curve in a plane, as a curve from a function (with derivatives to order 2, without bounds).
 *
 * @param distance      to the right of the curve's direction, seen from the tip of the normal; negative: to the left
 * @param plane_normal  x,y,z, any length
 * @param out           the handle; release it with fpt_curve_free
 * @return FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_offset(const struct fpt_curve *curve,
                            double distance,
                            const double *plane_normal,
                            struct fpt_curve **out);

/**
 * The offset of fpt_curve_offset as a spline over the same domain.
 *
 * @param degree     of the spline, 1 to 31
 * @param tolerance  wished greatest distance from the exact offset at equal parameters, more than 0
 * @param out        the handle; release it with fpt_curve_free
 * @param measured   that distance, at dense samples; NULL: not wanted
 * @param proven     no point is farther from the exact offset; above the tolerance: not reached or not proven (infinity). NULL: not wanted
 * @return FPT_UNSUPPORTED where the tangent jumps or is missing
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_offset_fit(const struct fpt_curve *curve,
                                double distance,
                                const double *plane_normal,
                                size_t degree,
                                double tolerance,
                                struct fpt_curve **out,
                                double *measured,
                                double *proven);

/**
 * The exact offset of a spline surface along its normal, as a surface from a function (with derivatives to order 2, without bounds).
 *
 * @param distance  along S_u x S_v; negative: against it
 * @param out       the handle; release it with fpt_surface_free
 * @return FPT_UNSUPPORTED for a surface from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_offset(const struct fpt_surface *surface,
                              double distance,
                              struct fpt_surface **out);

/**
 * The offset of a surface as a spline over the same domain. At collapsed edges the normal is its limit.
 *
 * @param distance   along S_u x S_v; negative: against it
 * @param degree_u   of the spline, 1 to 31
 * @param degree_v   of the spline, 1 to 31
 * @param tolerance  wished greatest distance from the exact offset at equal parameters, more than 0
 * @param out        the handle; release it with fpt_surface_free
 * @param measured   that distance, at dense samples; NULL: not wanted
 * @param proven     no point is farther from the exact offset; above the tolerance: not reached or not proven (infinity: always so at
 *                   collapsed edges). NULL: not wanted
 * @return FPT_UNSUPPORTED where the normal jumps or is missing
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_offset_fit(const struct fpt_surface *surface,
                                  double distance,
                                  size_t degree_u,
                                  size_t degree_v,
                                  double tolerance,
                                  struct fpt_surface **out,
                                  double *measured,
                                  double *proven);

/**
 * The linear function that maps from[0] to to[0] and from[1] to to[1], bit for bit. It is continued outside.
 *
 * @param from  increasing
 * @param to    two different numbers; falling: the relation falls
 * @param out   the handle; release it with fpt_relation_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_linear(const double *from,
                               const double *to,
                               struct fpt_relation **out);

/**
 * From the parameter of a circular arc, written as a rational spline of degree 2 in a standard form, to its angle. Both ways agree to
 * 1e-15 of the interval.
 *
 * @param arcs   0: half turns of 4 poles with shared ends (4 poles for a sweep of pi, 7 for 2 pi). n: n equal arcs with
 *               double knots between them (of a half turn 2 arcs have 5 poles; of a full one 4 arcs have 9, 3 arcs have 7)
 * @param sweep  angle of the whole arc, radians, more than 0, at most a full turn
 * @param from   first and last parameter of the spline, increasing
 * @param to     first and last angle, increasing, in any unit
 * @param out    the handle; release it with fpt_relation_free
 * @return FPT_INVALID_ARGUMENT also for a form that cannot make the sweep
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_circle(uint32_t arcs,
                               double sweep,
                               const double *from,
                               const double *to,
                               struct fpt_relation **out);

/**
 * The piecewise linear relation through values at places.
 *
 * @param places  increasing
 * @param values  all rising or all falling
 * @param count   of each, at least 2
 * @param out     the handle; release it with fpt_relation_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_through(const double *places,
                                const double *values,
                                size_t count,
                                struct fpt_relation **out);

/**
 * Relations one after the other along the domain: each begins where the one before ends, in domain and image, bit for bit.
 *
 * @param pieces  count handles; they may be freed before or after the result
 * @param count   at least 1
 * @param out     the handle; release it with fpt_relation_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_piecewise(const struct fpt_relation *const *pieces,
                                  size_t count,
                                  struct fpt_relation **out);

/**
 * A relation by a function and its inverse. They are compared at 65 places here; that the function is monotone between them is the
 * caller's word. What uses such a relation is measured, not proven.
 *
 * @param callback  the functions. After a failure nothing of it is kept and release is not called
 * @param out       the handle; release it with fpt_relation_free
 * @return FPT_INVALID_ARGUMENT for values that are not finite or not monotone, or an inverse that is off by more than 1e-9 of the domain
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_from_callback(const struct fpt_relation_callback *callback,
                                      struct fpt_relation **out);

/**
 * The inverse of a relation.
 *
 * @param out  the handle; release it with fpt_relation_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_inverse(const struct fpt_relation *relation,
                                struct fpt_relation **out);

/**
 * A relation and then another one, whose domain is the image of the first.
 *
 * @param out  the handle; release it with fpt_relation_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_then(const struct fpt_relation *first,
                             const struct fpt_relation *next,
                             struct fpt_relation **out);

/**
 * Domain, and the values at its ends.
 *
 * @param out_from  first and last place
 * @param out_to    the values there; falling when the relation falls
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_domain(const struct fpt_relation *relation,
                               double *out_from,
                               double *out_to);

/**
 * The values at many places. Linear relations are continued outside of the domain, others give the value at its end.
 *
 * @param places  count numbers, finite
 * @param out     count numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_relation_apply(const struct fpt_relation *relation,
                              const double *places,
                              size_t count,
                              double *out);

/**
 * Releases a relation. Transforms made of it stay. NULL is fine.
 * @since 0.1
 */
void fpt_relation_free(struct fpt_relation *relation);

/**
 * The transform (u, v) -> (f(u), g(v)).
 *
 * @param u     f; may be freed before or after the result
 * @param v     g, as well
 * @param swap  1: (u, v) -> (g(v), f(u)); 0: not
 * @param out   the handle; release it with fpt_transform_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_transform_new(const struct fpt_relation *u,
                             const struct fpt_relation *v,
                             uint32_t swap,
                             struct fpt_transform **out);

/**
 * The inverse of a transform.
 *
 * @param out  the handle; release it with fpt_transform_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_transform_inverse(const struct fpt_transform *transform,
                                 struct fpt_transform **out);

/**
 * A transform and then another one, whose domain is the image of the first.
 *
 * @param out  the handle; release it with fpt_transform_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_transform_then(const struct fpt_transform *first,
                              const struct fpt_transform *next,
                              struct fpt_transform **out);

/**
 * Domain and image of a transform, and whether it keeps the direction of loops.
 *
 * @param out_domain           u0, u1, v0, v1
 * @param out_image            the same of the image
 * @param out_keeps_direction  1: loops keep their direction; 0: they are turned
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_transform_domain(const struct fpt_transform *transform,
                                double *out_domain,
                                double *out_image,
                                int32_t *out_keeps_direction);

/**
 * The images of many places.
 *
 * @param uv     2 * count numbers, finite
 * @param out    2 * count numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_transform_apply(const struct fpt_transform *transform,
                               const double *uv,
                               size_t count,
                               double *out);

/**
 * Releases a transform. NULL is fine.
 * @since 0.1
 */
void fpt_transform_free(struct fpt_transform *transform);

/**
 * The arc centre + cos t first + sin t second of a circle or an ellipse, as a polynomial spline of its angle t: off by some roundings of its
 * largest coordinate. For edges and meridians whose parameter is an angle; exact arcs (fpt_curve_arc) have another parameter.
 *
 * @param center  3 numbers
 * @param first   3 numbers: the half diameter of t = 0
 * @param second  3 numbers: the half diameter of a quarter turn
 * @param angles  first and last t, increasing, at most a full turn apart
 * @param out     the handle; release it with fpt_curve_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_arc_by_angle(const double *center,
                                  const double *first,
                                  const double *second,
                                  const double *angles,
                                  struct fpt_curve **out);

/**
 * A support of a surface, spline or function. The search index is shared with it.
 *
 * @param out  the handle; release it with fpt_support_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_new(const struct fpt_surface *surface,
                           struct fpt_support **out);

/**
 * An elementary surface by its geometric parameters, on a rectangle of them.
 *
 * @param data  the inputs, copied
 * @param out   the handle; release it with fpt_support_free
 * @return FPT_INVALID_ARGUMENT names what is not allowed: also a domain in which the radius is negative, or that leaves the curve's
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_elementary(const struct fpt_elementary_data *data,
                                  struct fpt_support **out);

/**
 * First and last parameters.
 *
 * @param out  u0, u1, v0, v1
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_support_domain(const struct fpt_support *support, double *out);

/**
 * The points at many places; a place outside of the domain is moved to its border first.
 *
 * @param uv     2 * count numbers, finite
 * @param out    3 * count numbers; NaN where a function fails
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_evaluate(const struct fpt_support *support,
                                const double *uv,
                                size_t count,
                                double *out);

/**
 * The support as a spline surface. That of an elementary surface is its exact NURBS form: angles become a parameter from 0 to 1, the
 * other direction keeps its parameter.
 *
 * @param arcs  circle forms of u and v as fpt_relation_circle has them, not looked at where there is no angle; NULL: arcs of at most a
 *              quarter turn
 * @param out   the handle; release it with fpt_surface_free
 * @return FPT_INVALID_ARGUMENT for a form that cannot make the sweep, FPT_UNSUPPORTED for a function
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_spline(const struct fpt_support *support,
                              const uint32_t *arcs,
                              struct fpt_surface **out);

/**
 * The transform from the parameters of an elementary surface to those of its NURBS form, exact at the ends.
 *
 * @param arcs  as for fpt_support_spline
 * @param out   the handle; release it with fpt_transform_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_spline_transform(const struct fpt_support *support,
                                        const uint32_t *arcs,
                                        struct fpt_transform **out);

/**
 * The transform between two parametrisations of one surface, found by proven inversions: (s, t) = (f(u), g(v)) with monotone f and
 * g is assumed and checked. Both have their seams at the same place. What it is used for is measured, not proven.
 *
 * @param tolerance  length, finite, >= 0: how far points of one may be from the other; 0: 1e-7 x the diagonal of the box
 * @param out        the handle; release it with fpt_transform_free
 * @return FPT_INVALID_ARGUMENT when the surfaces differ, their seams are elsewhere, or parameters do not follow each other
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_match(const struct fpt_support *from,
                             const struct fpt_support *to,
                             double tolerance,
                             struct fpt_transform **out);

/**
 * As fpt_support_match, for many places at once. A record has the parameters on the target, the point there and its distance from the
 * point of the place; lower_bound is 0. Places on a border of the domain give the border that belongs to it: no seam or pole point
 * is on the wrong side.
 *
 * Flags: FPT_FOOT_NOT_PROVEN when an inversion was not proven, FPT_FOOT_NOT_ON_SHAPE when the distance is beyond the tolerance,
 * FPT_FOOT_BAD_QUERY for a place outside of the domain.
 *
 * @param uv       2 * count numbers
 * @param threads  0: all cores, 1: the calling thread only
 * @param out      count records
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_support_match_many(const struct fpt_support *from,
                                  const struct fpt_support *to,
                                  double tolerance,
                                  const double *uv,
                                  size_t count,
                                  uint32_t threads,
                                  struct fpt_foot_point *out);

/**
 * Releases a support. NULL is fine.
 * @since 0.1
 */
void fpt_support_free(struct fpt_support *support);

/**
 * Makes a face from its inputs. References are checked here; whether the loops are closed, directed and disjoint is what fpt_trim_report
 * tells.
 *
 * @param data  the inputs, copied
 * @param out   the handle; release it with fpt_trim_free
 * @return FPT_INVALID_ARGUMENT names loop, coedge and edge
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_new(const struct fpt_trim_data *data,
                        struct fpt_trim **out);

/**
 * The whole surface as a face: one outer loop around its domain, with seam edges used twice and points at collapsed sides. The sides
 * of a function have no edges.
 *
 * @param out  the handle; release it with fpt_trim_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_whole(const struct fpt_support *support,
                          struct fpt_trim **out);

/**
 * Releases a face. NULL is fine.
 * @since 0.1
 */
void fpt_trim_free(struct fpt_trim *trim);

/**
 * The surface of a face.
 *
 * @param out  a handle of its own; release it with fpt_support_free
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_trim_support(const struct fpt_trim *trim, struct fpt_support **out);

/**
 * What a face consists of.
 *
 * @param out_edge_count  number of its edges
 * @param out_loop_count  number of its loops
 * @param out_flipped     1: its normal is opposite to Su x Sv; 0: it is that
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_counts(const struct fpt_trim *trim,
                           size_t *out_edge_count,
                           size_t *out_loop_count,
                           uint32_t *out_flipped);

/**
 * A loop of a face.
 *
 * @param index             less than the number of loops
 * @param out_is_inner      0: outer, 1: inner
 * @param out_coedge_count  number of its coedges
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_loop(const struct fpt_trim *trim,
                         size_t index,
                         uint32_t *out_is_inner,
                         size_t *out_coedge_count);

/**
 * A curve of a loop, as it was given but for its arrays: points, parameters and curve are NULL. Those of a polyline are got with
 * fpt_trim_coedge_points, a spline with fpt_trim_coedge_curve.
 *
 * @param loop_index  less than the number of loops
 * @param index       less than the loop's number of coedges
 * @param out         the data
 * @param out_domain  first and last parameter of the curve; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_coedge(const struct fpt_trim *trim,
                           size_t loop_index,
                           size_t index,
                           struct fpt_coedge_data *out,
                           double *out_domain);

/**
 * The points of a polyline.
 *
 * @param capacity        points that there is room for, at least point_count of fpt_trim_coedge
 * @param out_points      u,v of each point
 * @param out_parameters  parameter of each point; NULL: not wanted
 * @return FPT_INVALID_ARGUMENT also for a curve that is none
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_coedge_points(const struct fpt_trim *trim,
                                  size_t loop_index,
                                  size_t index,
                                  size_t capacity,
                                  double *out_points,
                                  double *out_parameters);

/**
 * The spline of a coedge, with z = 0.
 *
 * @param out  the handle; release it with fpt_curve_free
 * @return FPT_INVALID_ARGUMENT also for a curve that is none
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_coedge_curve(const struct fpt_trim *trim,
                                 size_t loop_index,
                                 size_t index,
                                 struct fpt_curve **out);

/**
 * Places of a coedge in the domain, and their points on the surface.
 *
 * @param shares      count numbers from 0 to 1: shares of the curve's domain, along the loop
 * @param out_uv      2 * count numbers; NULL: not wanted
 * @param out_points  3 * count numbers: the images; NULL: not wanted
 * @param out_edge    3 * count numbers: the points of the edge at these shares, NaN without an edge; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_coedge_evaluate(const struct fpt_trim *trim,
                                    size_t loop_index,
                                    size_t index,
                                    const double *shares,
                                    size_t count,
                                    double *out_uv,
                                    double *out_points,
                                    double *out_edge);

/**
 * An edge of a face.
 *
 * @param index         less than the number of edges
 * @param out_curve     a handle of its own, or NULL for a point; release it with fpt_curve_free
 * @param out_point     3 numbers: the point of a collapsed side; else where the edge begins
 * @param out_reversed  1: the edge runs against its curve; 0: along it
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_edge(const struct fpt_trim *trim,
                         size_t index,
                         struct fpt_curve **out_curve,
                         double *out_point,
                         uint32_t *out_reversed);

/**
 * Sets all options to their defaults.
 *
 * @param options      room for struct_size bytes
 * @param struct_size  sizeof(fpt_change_options)
 * @since 0.1
 */
void fpt_change_options_init(struct fpt_change_options *options, size_t struct_size);

/**
 * The face on another surface, which is its surface in the parameters of a transform. Isolines, polylines, and under linear transforms
 * everything, keep their kind; other curves are replaced within the tolerance. A transform that turns directions turns every curve and
 * loop, the sense of edges and that of the face: outer loops stay counter-clockwise, the normal in space stays. Edges stay.
 *
 * @param transform    from the domain of the face's surface to that of `support`
 * @param support      the other surface
 * @param options      NULL: the defaults
 * @param out          the handle; release it with fpt_trim_free
 * @param out_summary  how well; NULL: not wanted
 * @return FPT_INVALID_ARGUMENT for domains that do not fit, or surfaces that differ by more than the tolerance, with the place;
 *         FPT_UNSUPPORTED when a curve would take more than 1,048,576 vertices
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_change(const struct fpt_trim *trim,
                           const struct fpt_transform *transform,
                           const struct fpt_support *support,
                           const struct fpt_change_options *options,
                           struct fpt_trim **out,
                           struct fpt_change_summary *out_summary);

/**
 * The face with its surface in the parameters of a transform. Under a linear transform a spline stays one, exactly; else the new surface
 * is a function of the old one, and nothing is proven.
 *
 * @param options      NULL: the defaults
 * @param out          the handle; release it with fpt_trim_free
 * @param out_summary  how well; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_reparametrise(const struct fpt_trim *trim,
                                  const struct fpt_transform *transform,
                                  const struct fpt_change_options *options,
                                  struct fpt_trim **out,
                                  struct fpt_change_summary *out_summary);

/**
 * The face of an elementary surface on the exact NURBS form of it.
 *
 * @param arcs         circle forms of u and v, as for fpt_support_spline; NULL: arcs of at most a quarter turn
 * @param options      NULL: the defaults
 * @param out          the handle; release it with fpt_trim_free
 * @param out_summary  how well; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_to_nurbs(const struct fpt_trim *trim,
                             const uint32_t *arcs,
                             const struct fpt_change_options *options,
                             struct fpt_trim **out,
                             struct fpt_change_summary *out_summary);

/**
 * The face of a NURBS form on the elementary surface that it is the form of; knots may have been refined and degrees raised.
 *
 * @param support      an elementary surface
 * @param arcs         the circle forms that the surface of the face has, as for fpt_support_spline
 * @param options      NULL: the defaults
 * @param out          the handle; release it with fpt_trim_free
 * @param out_summary  how well; NULL: not wanted
 * @return FPT_INVALID_ARGUMENT also when the surface of the face is not that form, with a place where it differs
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_to_elementary(const struct fpt_trim *trim,
                                  const struct fpt_support *support,
                                  const uint32_t *arcs,
                                  const struct fpt_change_options *options,
                                  struct fpt_trim **out,
                                  struct fpt_change_summary *out_summary);

/**
 * The face on the same surface in any other parameters, found by proven inversions along its curves, which become polylines. On seams and
 * collapsed edges of the new surface the side is told by where the curve comes from: a loop stays one closed loop. The deviation is
 * measured, not proven.
 *
 * @param support      the same surface in other parameters
 * @param options      the tolerance counts; NULL: the defaults
 * @param out          the handle; release it with fpt_trim_free
 * @param out_summary  how well; NULL: not wanted
 * @return FPT_UNSUPPORTED for a loop that crosses a seam of the new surface: it would have to be cut there
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_follow(const struct fpt_trim *trim,
                           const struct fpt_support *support,
                           const struct fpt_change_options *options,
                           struct fpt_trim **out,
                           struct fpt_change_summary *out_summary);

/**
 * Two faces whose domains follow each other made one face. What their coedges have in common on the border is taken out; what is left
 * is joined to loops again. Edges that end up inside are dropped.
 *
 * @param first      the face whose domain ends where that of the other begins
 * @param second     the other face, with the same normal
 * @param direction  0: the domains follow each other in u; 1: in v
 * @param support    the surface of both: its domain is the union
 * @param options    the tolerance counts; NULL: the defaults
 * @param out        the handle; release it with fpt_trim_free
 * @return FPT_INVALID_ARGUMENT for domains that do not follow each other bit for bit, a surface that differs, or loops that do not close
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_merge(const struct fpt_trim *first,
                          const struct fpt_trim *second,
                          uint32_t direction,
                          const struct fpt_support *support,
                          const struct fpt_change_options *options,
                          struct fpt_trim **out);

/**
 * Checks a face: open loops, wrong directions, crossing and touching curves, gaps between curves and edges, curves outside of the domain,
 * containment of loops. Cost: milliseconds, some ten where edges have other parameters than their coedges.
 *
 * @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box
 * @param out        the report; release it with fpt_trim_report_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_report_new(const struct fpt_trim *trim,
                               double tolerance,
                               struct fpt_trim_report **out);

/**
 * The report in a few numbers.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_report_summary(const struct fpt_trim_report *report,
                                   struct fpt_trim_summary *out);

/**
 * One thing that is wrong.
 *
 * @param index  less than finding_count of the summary
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_report_get(const struct fpt_trim_report *report,
                               size_t index,
                               struct fpt_trim_finding *out);

/**
 * Releases a report. NULL is fine.
 * @since 0.1
 */
void fpt_trim_report_free(struct fpt_trim_report *report);

/**
 * The face as JSON text (UTF-8): every number comes back with the same bits. Ask with a capacity of 0 for the length.
 *
 * @param capacity    0, or bytes of room: at least the length and a closing NUL
 * @param out         the text; may be NULL when capacity is 0
 * @param out_length  bytes of the text, the closing NUL not counted
 * @return FPT_UNSUPPORTED for surfaces and curves given by functions
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_to_json(const struct fpt_trim *trim,
                            size_t capacity,
                            char *out,
                            size_t *out_length);

/**
 * The face of a JSON text. It goes through the checks of fpt_trim_new.
 *
 * @param text    length bytes of UTF-8; a closing NUL is not needed
 * @param out     the handle; release it with fpt_trim_free
 * @return FPT_INVALID_ARGUMENT names line and column of what is no JSON, or the path of an entry that is missing or not allowed
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_from_json(const char *text,
                              size_t length,
                              struct fpt_trim **out);

/**
 * A picture of faces as SVG text (UTF-8), one column each: the domain with its loops, and the face in space without perspective. Ask
 * with a capacity of 0 for the length.
 *
 * @param trims       count handles
 * @param titles      count texts (UTF-8) that end with a NUL; NULL: none
 * @param count       1 to 16
 * @param view        3 numbers: the direction in which one looks; NULL: the usual one
 * @param capacity    0, or bytes of room: at least the length and a closing NUL
 * @param out         the text; may be NULL when capacity is 0
 * @param out_length  bytes of the text, the closing NUL not counted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_trim_picture(const struct fpt_trim *const *trims,
                            const char *const *titles,
                            size_t count,
                            const double *view,
                            size_t capacity,
                            char *out,
                            size_t *out_length);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_pull_options_init(struct fpt_pull_options *options, size_t struct_size);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_lift_options_init(struct fpt_lift_options *options, size_t struct_size);

/**
 * The pcurves of an edge: curves u,v,0 in the domain of the surface whose images are the edge, up to a proven deviation, with
 * the edge's parameter.
 *
 * The edge is inverted along its way, with proof, and followed over seams; where it crosses a seam or meets a collapsed edge the
 * pcurve is cut, since the domain demands it: the pieces there end and begin on the border of the domain, bit for bit. A line
 * is taken where it is near enough, otherwise a spline by least squares, whose knots are added until the bound of the
 * deviation is below the tolerance. The bound holds at all parameters, not at samples: no piece leaves the edge for another
 * branch in between. An edge that is not on the surface gets the pcurve of its feet, and flags that say so.
 *
 * Cost: some hundred microseconds to some milliseconds.
 *
 * @param surface  a spline surface
 * @param edge     a spline curve in space
 * @param options  NULL: the defaults
 * @param out      the set; release it with fpt_pcurve_set_free
 * @return FPT_INVALID_ARGUMENT also for an edge that is a single point up to the tolerance, and for one whose feet jump from one
 *         branch of the surface to another
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_pcurve_pull(const struct fpt_surface *surface,
                           const struct fpt_curve *edge,
                           const struct fpt_pull_options *options,
                           struct fpt_pcurve_set **out);

/**
 * The number of pcurves: one, or more where seams and collapsed edges cut the edge.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_pcurve_set_count(const struct fpt_pcurve_set *set, size_t *out_count);

/**
 * A pcurve and its proof. Its domain is the part of the edge's domain that it belongs to.
 *
 * @param index         below the count, else FPT_INVALID_ARGUMENT
 * @param out_pcurve    a new handle with z = 0; release it with fpt_curve_free
 * @param out_deviation distance between its image and the edge, and where it runs; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_pcurve_set_get(const struct fpt_pcurve_set *set,
                              size_t index,
                              struct fpt_curve **out_pcurve,
                              struct fpt_deviation *out_deviation);

/**
 * Releases a set. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_pcurve_set_free(struct fpt_pcurve_set *set);

/**
 * The image of a pcurve in space, with the pcurve's parameter: the isocurve for an isoline, the composed curve where degrees allow,
 * else a spline with a proven deviation.
 *
 * @param surface       a spline surface
 * @param pcurve        a spline curve with z = 0 in the domain of the surface
 * @param options       NULL: the defaults
 * @param out_curve     a new handle; release it with fpt_curve_free
 * @param out_deviation how far it is from the image; FPT_DEVIATION_EXACT, or FPT_DEVIATION_NOT_PROVEN when the tolerance was not reached.
 *                      NULL: not wanted
 * @return FPT_INVALID_ARGUMENT also for a pcurve that leaves the domain
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_pcurve_lift(const struct fpt_surface *surface,
                           const struct fpt_curve *pcurve,
                           const struct fpt_lift_options *options,
                           struct fpt_curve **out_curve,
                           struct fpt_deviation *out_deviation);

/**
 * The greatest distance between a curve in space and the image of a pcurve at equal parameters, on the common part of their
 * domains, with proof: for checking what another program gives.
 *
 * @param surface  a spline surface
 * @param pcurve   a spline curve with z = 0 in the domain of the surface
 * @param curve    a spline curve in space
 * @param out      bound and value differ by some per cent, or by rounding; flags are 0
 * @return FPT_INVALID_ARGUMENT also for a pcurve that leaves the domain, or domains that have nothing in common
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_pcurve_deviation(const struct fpt_surface *surface,
                                const struct fpt_curve *pcurve,
                                const struct fpt_curve *curve,
                                struct fpt_deviation *out);

/**
 * Sets all options to their defaults.
 *
 * @param options      room for struct_size bytes
 * @param struct_size  sizeof(fpt_face_options)
 * @since 0.1
 */
void fpt_face_options_init(struct fpt_face_options *options, size_t struct_size);

/**
 * Prepares a face for queries. The face is where a ray in the domain crosses the loops an odd number of times: their direction
 * does not count, holes are what is inside of two. Cost: that of the surface's index, some microseconds a pcurve, some
 * milliseconds for one whose image must be fitted.
 *
 * On a surface given by a function what is proven depends on the bounds that it was made with: none of its speed, and no distance
 * is (FPT_FOOT_NOT_PROVEN, FPT_STANDING_NOT_PROVEN); none of its second derivatives, and not where the nearest point is neither the surface's
 * nor that of the edges.
 *
 * @param data     the inputs, copied
 * @param options  NULL: the defaults
 * @param out      the handle; release it with fpt_face_free
 * @return FPT_INVALID_ARGUMENT names loop and pcurve, also for one that leaves the domain by more than 1e-6 of it
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_face_new(const struct fpt_face_data *data,
                        const struct fpt_face_options *options,
                        struct fpt_face **out);

/**
 * Prepares a trimmed surface for queries: as fpt_face_new, with the surface and the loops of `trim`; its edges in space play no part, the
 * border of a face is the image of its pcurves.
 *
 * @param trim     a trimmed surface over any support
 * @param options  NULL: the defaults
 * @param out      the handle; release it with fpt_face_free. Parameters of answers are those of the support (angles of an elementary
 *                 surface are angles), those of places the parameters of the coedges' pcurves
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_face_of_trim(const struct fpt_trim *trim,
                            const struct fpt_face_options *options,
                            struct fpt_face **out);

/**
 * Releases a face. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_face_free(struct fpt_face *face);

/**
 * On which side of its edges places of the domain lie: inside, outside, or within options->tolerance of an edge, in space.
 *
 * Sides are exact: only places nearer to a pcurve than the rounding of its poles, some 1e-13 of them, cannot be told from places on it,
 * and these are on the edge for any tolerance that is not smaller. Places outside the domain are outside.
 *
 * @param uv       `count` pairs u,v, packed. A pair that is not finite is FPT_FACE_UNKNOWN
 * @param count    may be 0, then `uv` and `out` may be NULL
 * @param options  tolerance (0: 1e-7 x the diagonal of the surface's box), budget, threads, should_stop and progress count;
 *                 NULL: the defaults
 * @param out      `count` places
 * @return FPT_CANCELLED when should_stop said so; then the places not reached are FPT_FACE_UNKNOWN
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_face_classify(const struct fpt_face *face,
                             const double *uv,
                             size_t count,
                             const struct fpt_query_options *options,
                             struct fpt_face_place *out);

/**
 * The nearest point of the face for each query point, with a proven lower bound of the distance: as fpt_surface_closest, for the
 * part of the surface that the loops leave.
 *
 * Where the nearest point of the surface is inside, it is the answer. Otherwise the nearest point of the edges is, unless the surface
 * has a nearer stationary point inside the face: all of those are looked for, with proof that none is missing.
 *
 * @param points     `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN, infinite, beyond 1e100)
 *                   marks its own record with FPT_FOOT_BAD_QUERY
 * @param count      may be 0, then all arrays may be NULL
 * @param options    NULL: the defaults. `domain` must be all 0, `scope` global and `trace` NULL: FPT_UNSUPPORTED. The
 *                   tolerance tells from where on a foot is on an edge; the budget is that of each search
 * @param out        `count` records, packed; must not overlap `points` or the hints. FPT_FOOT_EDGE, _CORNER, _SEAM and _COLLAPSED are
 *                   about the domain of the surface
 * @param out_places `count` places: where on the face the foot lies; NULL: not wanted
 * @return as fpt_surface_closest
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_face_closest(const struct fpt_face *face,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out,
                            struct fpt_face_place *out_places);

/**
 * All parameters of the face whose point lies within a tolerance of a point, with proof that none is missing: the members of
 * fpt_surface_preimage that lie in the face or within the tolerance of its edges.
 *
 * @param point      3 finite numbers
 * @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box
 * @param options    budget, should_stop and user count; NULL: the defaults. `domain` must be all 0
 * @param out        the set; release it with fpt_foot_set_free. Intervals of arcs and regions are those on the surface
 * @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided boxes: also arcs of which only a sliver may belong
 *         to the face
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_face_preimage(const struct fpt_face *face,
                             const double *point,
                             double tolerance,
                             const struct fpt_query_options *options,
                             struct fpt_foot_set **out);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_intersect_surfaces_options_init(struct fpt_intersect_surfaces_options *options,
                                         size_t struct_size);

/**
 * All branches and points that two surfaces have in common, with proof that none is missing, or with what could not be decided.
 *
 * Pairs of Bezier pieces are halved until they provably hold nothing or one transversal arc; loops cannot hide. Where the surfaces touch
 * to the last digits, the contact is classified and measured, not proven.
 *
 * FPT_INTERSECT_SUBDIVISION and FPT_INTERSECT_MESH give polylines on triangles: the gap of a branch says how far its points are off, nothing
 * is proven, and one undecided box is all of both domains.
 *
 * @param a, b     surfaces of knots and poles; FPT_UNSUPPORTED for one given by a function (but by FPT_INTERSECT_MESH), or that is a
 *                 point
 * @param options  NULL: the defaults
 * @param out      the result; release it with fpt_surface_intersection_free
 * @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with a result that misses what lies in its undecided boxes
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_surfaces(const struct fpt_surface *a,
                                  const struct fpt_surface *b,
                                  const struct fpt_intersect_surfaces_options *options,
                                  struct fpt_surface_intersection **out);

/**
 * All that two faces have in common: as fpt_intersect_surfaces of their supports, cut off at their trims (FPT_BRANCH_END_TRIM). A whole
 * support is a face too: fpt_trim_whole.
 *
 * Parameters are those of the supports; elementary ones are intersected in their exact NURBS form. A support given by a function is meshed
 * and walked along: nothing is proven then, and one undecided box is all of both domains. A face holds its border; what runs along
 * a trim is kept, and listed as undecided.
 *
 * @param a, b     the faces
 * @param options  NULL: the defaults
 * @param out      the result; release it with fpt_surface_intersection_free
 * @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with a result that misses what lies in its undecided boxes
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_trims(const struct fpt_trim *a,
                               const struct fpt_trim *b,
                               const struct fpt_intersect_surfaces_options *options,
                               struct fpt_surface_intersection **out);

/**
 * Counts and verdicts.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_summary(const struct fpt_surface_intersection *intersection,
                                            struct fpt_intersection_summary *out);

/**
 * A branch without its points.
 *
 * @param index  below branch_count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_branch(const struct fpt_surface_intersection *intersection,
                                           size_t index,
                                           struct fpt_intersection_branch *out);

/**
 * The points of a branch, in order. At a seam of a closed surface the same point comes twice, with the parameters of either side.
 *
 * @param index     below branch_count, else FPT_INVALID_ARGUMENT
 * @param capacity  room in `out`, at least the branch's point_count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_points(const struct fpt_surface_intersection *intersection,
                                           size_t index,
                                           size_t capacity,
                                           struct fpt_intersection_point *out);

/**
 * A contact.
 *
 * @param index  below contact_count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_contact(const struct fpt_surface_intersection *intersection,
                                            size_t index,
                                            struct fpt_intersection_contact *out);

/**
 * A box in which the surfaces coincide to the last digits.
 *
 * @param index      below overlap_count, else FPT_INVALID_ARGUMENT
 * @param out_range  8 numbers: ends of u, v of A, of u, v of B
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_overlap(const struct fpt_surface_intersection *intersection,
                                            size_t index,
                                            double *out_range);

/**
 * A box about which nothing is known.
 *
 * @param index      below undecided_count, else FPT_INVALID_ARGUMENT
 * @param out_range  8 numbers: ends of u, v of A, of u, v of B
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_undecided(const struct fpt_surface_intersection *intersection,
                                              size_t index,
                                              double *out_range);

/**
 * A branch as cubic B-splines in space and in both domains (z = 0), with the same knots. A branch is cut at seams and corners. Where the fit
 * misses its tolerance, the error says so, and is not more than that of the chords between the points.
 *
 * @param a, b        the surfaces that the intersection was made of
 * @param index       below branch_count, else FPT_INVALID_ARGUMENT
 * @param tolerance   length, > 0: what the fit aims at
 * @param part        which part between two seams or corners; beyond the count of parts FPT_INVALID_ARGUMENT
 * @param options     should_stop, progress and user count; NULL: nobody is asked
 * @param out_count   the number of parts
 * @param out_curves  3 handles: in space, in A's domain, in B's domain; release each with fpt_curve_free
 * @param out_error   proven: at equal parameters the curve is nowhere farther from the surface points at its parameters, and so from
 *                    both surfaces
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_curves(const struct fpt_surface_intersection *intersection,
                                           const struct fpt_surface *a,
                                           const struct fpt_surface *b,
                                           size_t index,
                                           double tolerance,
                                           size_t part,
                                           const struct fpt_intersect_surfaces_options *options,
                                           size_t *out_count,
                                           struct fpt_curve **out_curves,
                                           double *out_error);

/**
 * The faces into which the branches cut one of the two faces that they came from. Cuts are polylines in its domain and in space, as near as the
 * chord tolerance made them. Branches that end inside the face, and tangential ones, cut nothing.
 *
 * @param trim       the first (which = 0) or the second (which = 1) face of the intersection
 * @param tolerance  length, > 0: within it ends of branches meet loops and one another
 * @param options    should_stop, progress and user count; NULL: nobody is asked
 * @param capacity   room in out_trims, at least the number of faces, else FPT_INVALID_ARGUMENT with *out_count set
 * @param out_trims  handles; release each with fpt_trim_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_surface_intersection_split(const struct fpt_surface_intersection *intersection,
                                          const struct fpt_trim *trim,
                                          uint32_t which,
                                          double tolerance,
                                          const struct fpt_intersect_surfaces_options *options,
                                          size_t capacity,
                                          struct fpt_trim **out_trims,
                                          size_t *out_count);

/**
 * Releases an intersection. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_surface_intersection_free(struct fpt_surface_intersection *intersection);

/**
 * Moves a place near two surfaces onto both by one corrector alone (fpt_corrector), without proof: Newton with three or four parameters,
 * or the moving affine frame.
 *
 * Parameters outside the domains are moved into them. The iteration ends when the distance between the two surface points is within
 * the tolerance and falls no more; each step is told to options.trace.
 *
 * @param a, b       surfaces, also given by functions
 * @param uvst       4 numbers: u, v of A, u, v of B
 * @param options    tolerance (0: 1e-12 x the size of the smaller surface), corrector, trace and user count; NULL: the defaults
 * @param out        the place on both surfaces
 * @param out_gap    distance between its two surface points
 * @param out_steps  number of steps
 * @return FPT_BUDGET_EXHAUSTED when it does not get there within 50 steps, or a step does not exist: an isoline that is held may miss the
 *         other surface. Nothing is written then
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_correct(const struct fpt_surface *a,
                                 const struct fpt_surface *b,
                                 const double *uvst,
                                 const struct fpt_intersect_surfaces_options *options,
                                 struct fpt_intersection_point *out,
                                 double *out_gap,
                                 uint32_t *out_steps);

/**
 * The branch through a place near two surfaces, walked both ways by marching alone, without proof: steps along n_A x n_B by the chord tolerance,
 * corrected; it ends where it began, at borders (with three parameters), and where the tangent planes are parallel.
 *
 * The result has one branch, of which nothing is proven, and one undecided box that is all of both domains. A walk ends at seams.
 *
 * @param a, b     surfaces, also given by functions
 * @param uvst     4 numbers: u, v of A, u, v of B
 * @param step     length, finite, >= 0: the first step; 0: a 256th of the size of the smaller surface
 * @param options  chord, corrector, should_stop, progress and user count; NULL: the defaults
 * @param out      the result; release it with fpt_surface_intersection_free
 * @return FPT_BUDGET_EXHAUSTED without a result when the place leads to no branch; FPT_CANCELLED with what was walked by then
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_march(const struct fpt_surface *a,
                               const struct fpt_surface *b,
                               const double *uvst,
                               double step,
                               const struct fpt_intersect_surfaces_options *options,
                               struct fpt_surface_intersection **out);

/**
 * The branch through given places in order, with as many between them as the chord tolerance asks for, by bisection alone, without proof:
 * midpoints of the parameters are corrected.
 *
 * The result has one branch, of which nothing is proven, and one undecided box that is all of both domains. It is closed when the last place
 * is the first one.
 *
 * @param a, b     surfaces, also given by functions
 * @param uvst     4 numbers each: u, v of A, u, v of B; they are kept as they are
 * @param count    number of places, at least 2
 * @param options  chord, corrector, should_stop, progress and user count; NULL: the defaults
 * @param out      the result; release it with fpt_surface_intersection_free
 * @return FPT_BUDGET_EXHAUSTED without a result when a midpoint cannot be corrected, or lands elsewhere than between its two places;
 *         FPT_CANCELLED with what was put between by then
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_bisect(const struct fpt_surface *a,
                                const struct fpt_surface *b,
                                const double *uvst,
                                size_t count,
                                const struct fpt_intersect_surfaces_options *options,
                                struct fpt_surface_intersection **out);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_inspect_options_init(struct fpt_inspect_options *options, size_t struct_size);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_inspect_picture_options_init(struct fpt_inspect_picture_options *options,
                                      size_t struct_size);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_fair_options_init(struct fpt_fair_options *options, size_t struct_size);

/**
 * A fairer curve on the same knots and weights.
 *
 * @param options  what is wanted; deviation must be set, so NULL is FPT_INVALID_ARGUMENT
 * @param out      the report; release it with fpt_fair_report_free
 * @return FPT_INVALID_ARGUMENT names the option; FPT_UNSUPPORTED for a curve from a callback
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fair_curve(const struct fpt_curve *curve,
                          const struct fpt_fair_options *options,
                          struct fpt_fair_report **out);

/**
 * A fairer surface on the same knots and weights.
 *
 * @param options  what is wanted; deviation must be set, so NULL is FPT_INVALID_ARGUMENT
 * @param out      the report; release it with fpt_fair_report_free
 * @return FPT_INVALID_ARGUMENT names the option; FPT_UNSUPPORTED for a surface from a callback, knot removal of a rational surface,
 *         and borders of a direction that is not clamped; FPT_OUT_OF_MEMORY for too many poles
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fair_surface(const struct fpt_surface *surface,
                            const struct fpt_fair_options *options,
                            struct fpt_fair_report **out);

/**
 * The numbers of a report.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fair_report_summary(const struct fpt_fair_report *report,
                                   struct fpt_fair_summary *out);

/**
 * The energy before the first step and after each, never rising.
 *
 * @param capacity      numbers that out_energies has room for, at least the steps of the summary + 1
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fair_report_energies(const struct fpt_fair_report *report,
                                    size_t capacity,
                                    double *out_energies);

/**
 * The faired curve, a new handle.
 *
 * @param out_curve  release it with fpt_curve_free
 * @return FPT_UNSUPPORTED when a surface was faired
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fair_report_curve(const struct fpt_fair_report *report,
                                 struct fpt_curve **out_curve);

/**
 * The faired surface, a new handle.
 *
 * @param out_surface  release it with fpt_surface_free
 * @return FPT_UNSUPPORTED when a curve was faired
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_fair_report_surface(const struct fpt_fair_report *report,
                                   struct fpt_surface **out_surface);

/**
 * Releases a report. NULL is fine.
 * @since 0.1
 */
void fpt_fair_report_free(struct fpt_fair_report *report);

/**
 * The range of the curvature of a curve or a part of it, proven: no sampling.
 *
 * @param options  domain, relative, budget; NULL: the defaults
 * @return FPT_UNSUPPORTED for a curve from a callback and for degrees above 23, rational ones above 15
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_curve_range(const struct fpt_curve *curve,
                                   const struct fpt_inspect_options *options,
                                   struct fpt_inspect_range *out);

/**
 * The range of a curvature over a surface or a part of it, proven: no sampling. 1 / greatest of FPT_QUANTITY_SHARPEST bounds the
 * least radius of curvature.
 *
 * Cost: about ten microseconds a box; from a hundred boxes (bicubic, calm) to thousands (constant curvature, many patches).
 *
 * @param quantity  a value of fpt_inspect_quantity
 * @param options   domain, relative, budget; NULL: the defaults
 * @return FPT_UNSUPPORTED for a surface from a callback and for degrees above 23, rational ones above 15
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_surface_range(const struct fpt_surface *surface,
                                     uint32_t quantity,
                                     const struct fpt_inspect_options *options,
                                     struct fpt_inspect_range *out);

/**
 * As fpt_inspect_surface_range, and the boxes of the domain that the range excludes, when there are any: beside tips and cusps.
 * Of those of kind FPT_PLACE_UNBOUNDED it is proven that the quantity has no bound there; of those of kind FPT_PLACE_EXCLUDED
 * nothing is.
 *
 * @param quantity  a value of fpt_inspect_quantity
 * @param options   domain, relative, budget; NULL: the defaults
 * @param places    the boxes; release the set with fpt_inspect_set_free
 * @return as fpt_inspect_surface_range
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_surface_range_places(const struct fpt_surface *surface,
                                            uint32_t quantity,
                                            const struct fpt_inspect_options *options,
                                            struct fpt_inspect_range *out,
                                            struct fpt_inspect_set **places);

/**
 * The teeth of a curvature comb.
 *
 * @param parameters  `count` parameters in the domain; at a knot the right-sided piece counts, at the domain's end the left one
 * @param out         room for `count` records
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_comb(const struct fpt_curve *curve,
                            const double *parameters,
                            size_t count,
                            struct fpt_inspect_tooth *out);

/**
 * Curvatures and principal directions at places of a surface.
 *
 * @param parameters  `count` pairs u,v in the domain
 * @param out         room for `count` records
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_curvatures(const struct fpt_surface *surface,
                                  const double *parameters,
                                  size_t count,
                                  struct fpt_inspect_curvature *out);

/**
 * The pieces of a curve on which the curvature is monotone, in order: kinds FPT_PLACE_RISING to FPT_PLACE_UNKNOWN. Complete: none
 * holds an extremum of the curvature inside, but those of unknown kind.
 *
 * @param out  the set; release it with fpt_inspect_set_free
 * @return FPT_UNSUPPORTED for a curve from a callback and for degrees above 17, rational ones above 9
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_monotone_pieces(const struct fpt_curve *curve,
                                       struct fpt_inspect_set **out);

/**
 * The places where a curve, seen along a direction, changes the side to which it bends or is straight, in order: kinds
 * FPT_PLACE_INFLECTION and FPT_PLACE_STRAIGHT.
 *
 * @param normal  3 numbers, not 0; NULL: across the plane that the poles lie in, at least about
 * @param out     the set; release it with fpt_inspect_set_free
 * @return FPT_UNSUPPORTED for a curve from a callback and for degrees above 17, rational ones above 9
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_inflections(const struct fpt_curve *curve,
                                   const double *normal,
                                   struct fpt_inspect_set **out);

/**
 * Boxes outside of which the principal curvatures of a surface are proven to differ: kinds FPT_PLACE_UMBILIC and
 * FPT_PLACE_UMBILIC_AREA. Planes and spheres are one large box.
 *
 * @param options  domain, budget; NULL: the defaults
 * @param out      the set; release it with fpt_inspect_set_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_umbilics(const struct fpt_surface *surface,
                                const struct fpt_inspect_options *options,
                                struct fpt_inspect_set **out);

/**
 * The number of places of a set.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_inspect_set_count(const struct fpt_inspect_set *set, size_t *out_count);

/**
 * A place of a set.
 *
 * @param index  below the count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_set_get(const struct fpt_inspect_set *set,
                               size_t index,
                               struct fpt_inspect_place *out);

/**
 * Releases a set. NULL is fine.
 * @since 0.1
 */
void fpt_inspect_set_free(struct fpt_inspect_set *set);

/**
 * The Hausdorff distance between two shapes, between proven bounds: it is the greater of both directions. Of each shape exactly one
 * handle is given.
 *
 * @param curve_a       the first shape, or NULL
 * @param surface_a     the first shape, or NULL
 * @param curve_b       the second shape, or NULL
 * @param surface_b     the second shape, or NULL
 * @param options       accuracy, budget (for each direction); NULL: the defaults
 * @param out_forward   from the first shape to the second
 * @param out_backward  from the second shape to the first
 * @return FPT_UNSUPPORTED for shapes from callbacks
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_hausdorff(const struct fpt_curve *curve_a,
                                 const struct fpt_surface *surface_a,
                                 const struct fpt_curve *curve_b,
                                 const struct fpt_surface *surface_b,
                                 const struct fpt_inspect_options *options,
                                 struct fpt_inspect_distance *out_forward,
                                 struct fpt_inspect_distance *out_backward);

/**
 * How a border of one surface meets a border of another: gap, angle of the normals, jump of the curvature across, each with bounds.
 *
 * @param side_a   border of surface_a: 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1
 * @param side_b   border of surface_b
 * @param options  should_stop only; NULL: the defaults
 * @return FPT_UNSUPPORTED for surfaces from callbacks and for degrees above 23, rational ones above 15
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_border(const struct fpt_surface *surface_a,
                              uint32_t side_a,
                              const struct fpt_surface *surface_b,
                              uint32_t side_b,
                              const struct fpt_inspect_options *options,
                              struct fpt_inspect_continuity *out);

/**
 * A picture of a surface: pixels, row by row from above, red, green and blue of each.
 *
 * @param options     what is drawn; NULL: the defaults
 * @param capacity    bytes that out_pixels has room for, at least 3 x width x height
 * @param out_pixels  the pixels
 * @param out_range   2 numbers: values of the ends of the colours of curvature, 0 for other patterns; NULL: not wanted
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_inspect_picture(const struct fpt_surface *surface,
                               const struct fpt_inspect_picture_options *options,
                               size_t capacity,
                               uint8_t *out_pixels,
                               double *out_range);

/**
 * Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
 * Does nothing when `options` is NULL or struct_size is smaller than a size_t.
 * @since 0.1
 */
void fpt_hit_options_init(struct fpt_hit_options *options, size_t struct_size);

/**
 * Where two curves meet: crossings, contacts and overlaps, with proof that none is missing: everything else of the two is
 * farther apart than the tolerance. Hits come in the order of w, the parameter of `other`; u is that of `curve`. Where both are
 * closed, a hit on a seam is told once.
 *
 * Cost: microseconds a crossing and pair of segments whose boxes meet; an overlap takes about length / sqrt(tolerance x
 * radius of curvature) boxes.
 *
 * @param options  tolerance, budget, should_stop and user count; NULL: the defaults
 * @param out      the hits; release them with fpt_curve_hits_free
 * @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with hits that miss what lies in the undecided boxes
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_curves(const struct fpt_curve *curve,
                                const struct fpt_curve *other,
                                const struct fpt_hit_options *options,
                                struct fpt_curve_hits **out);

/**
 * Where a curve meets a surface: as fpt_intersect_curves; u, v are the surface's parameters, w the curve's.
 *
 * @param options  as for fpt_intersect_curves
 * @param out      the hits; release them with fpt_curve_hits_free
 * @return as fpt_intersect_curves
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_surface_curve(const struct fpt_surface *surface,
                                       const struct fpt_curve *curve,
                                       const struct fpt_hit_options *options,
                                       struct fpt_curve_hits **out);

/**
 * Where a curve meets a plane or a quadric in implicit form: the zeros of a polynomial, none missing; w is the curve's parameter.
 *
 * @param quadric  one plane or quadric
 * @param options  as for fpt_intersect_curves; the tolerance decides what lies in the quadric (a 64th of it)
 * @param out      the hits; release them with fpt_curve_hits_free
 * @return as fpt_intersect_curves
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_curve_quadric(const struct fpt_curve *curve,
                                       const struct fpt_quadric *quadric,
                                       const struct fpt_hit_options *options,
                                       struct fpt_curve_hits **out);

/**
 * The number of hits.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_curve_hits_count(const struct fpt_curve_hits *hits, size_t *out_count);

/**
 * A hit.
 *
 * @param index  below the count, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_hits_get(const struct fpt_curve_hits *hits,
                              size_t index,
                              struct fpt_curve_hit *out);

/**
 * The number of boxes that are undecided: 0 when the hits are complete.
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_hits_undecided_count(const struct fpt_curve_hits *hits,
                                          size_t *out_count);

/**
 * A box that is undecided: more hits may lie in it.
 *
 * @param index    below the count, else FPT_INVALID_ARGUMENT
 * @param out_uvw  6 numbers: start and end of u, of v, of w
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_curve_hits_undecided_get(const struct fpt_curve_hits *hits,
                                        size_t index,
                                        double *out_uvw);

/**
 * Releases hits. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_curve_hits_free(struct fpt_curve_hits *hits);

/**
 * Sections of a surface by planes or quadrics: all branches of each, small loops too, with proof; isolated points of contact,
 * points where branches meet, parts that lie in the quadric, and boxes that could not be decided.
 *
 * Points of branches lie on the surface and, to rounding, on the quadric (branches with tangential 1: to the root of it along
 * the surface). A stack of parallel planes gives contour lines.
 *
 * @param quadrics  `count` planes or quadrics
 * @param count     at least 1
 * @param options   NULL: the defaults
 * @param out       the sections, in the order of the quadrics; release them with fpt_sections_free
 * @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with sections of which some miss what lies in their undecided
 *         regions: all of the domain for those not begun
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_surface_quadrics(const struct fpt_surface *surface,
                                          const struct fpt_quadric *quadrics,
                                          size_t count,
                                          const struct fpt_hit_options *options,
                                          struct fpt_sections **out);

/**
 * The numbers of branches, of single points and of regions of a section.
 *
 * @param out_counts  3 numbers
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_sections_counts(const struct fpt_sections *sections,
                               size_t section,
                               size_t *out_counts);

/**
 * A branch of a section.
 *
 * @param index  below the number of branches, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_sections_branch_get(const struct fpt_sections *sections,
                                   size_t section,
                                   size_t index,
                                   struct fpt_branch *out);

/**
 * The points of a branch in order; a loop ends with the point that it begins with. Where a branch crosses a seam two points with the same
 * place and different parameters follow each other.
 *
 * @param capacity  numbers that fit into `out`; at least 5 x point_count, else FPT_INVALID_ARGUMENT
 * @param out       x, y, z, u, v of each point
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_sections_branch_points(const struct fpt_sections *sections,
                                      size_t section,
                                      size_t index,
                                      size_t capacity,
                                      double *out);

/**
 * A single point of a section: the contacts first, then the points where branches meet.
 *
 * @param index  below the number of single points, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_sections_point_get(const struct fpt_sections *sections,
                                  size_t section,
                                  size_t index,
                                  struct fpt_section_point *out);

/**
 * A region of a section: those in which the surface lies in the quadric first, then the undecided ones.
 *
 * @param index  below the number of regions, else FPT_INVALID_ARGUMENT
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_sections_region_get(const struct fpt_sections *sections,
                                   size_t section,
                                   size_t index,
                                   struct fpt_section_region *out);

/**
 * Releases sections. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_sections_free(struct fpt_sections *sections);

/**
 * Where two planes or quadrics meet, when that is made of conics: circles, ellipses, lines and so on in closed form.
 *
 * @param first      a plane or quadric
 * @param second     another one
 * @param tolerance  length, finite, > 0: points of the conics lie within it of both
 * @param out        room for 4 conics, of which the first `out_count` are written
 * @param out_count  number of conics; 0: they do not meet
 * @return FPT_UNSUPPORTED when both are the same, or meet in a curve that is not made of conics: then take one as a surface and
 *         its section by the other
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_intersect_quadrics(const struct fpt_quadric *first,
                                  const struct fpt_quadric *second,
                                  double tolerance,
                                  struct fpt_conic *out,
                                  size_t *out_count);

/**
 * Prepares a surface for rays: its patches are cut into cells that a line crosses at most once. Cost: some microseconds a
 * cell, of which a patch has 4 to 64, as a rule.
 *
 * @param options  should_stop and user count; NULL: the defaults
 * @param out      the caster; release it with fpt_caster_free
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_caster_new(const struct fpt_surface *surface,
                          const struct fpt_hit_options *options,
                          struct fpt_caster **out);

/**
 * Releases a caster. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_caster_free(struct fpt_caster *caster);

/**
 * The first hit of each ray, with the number of all its hits: proven, unless its flags have FPT_RAY_NOT_PROVEN. A bad ray
 * marks its own record. The bits do not depend on the threads.
 *
 * @param origins     x,y,z of `count` origins
 * @param directions  x,y,z of `count` directions of any length but 0
 * @param count       may be 0
 * @param reach       2 numbers: least and greatest length along each ray that counts, infinities allowed (a line: both); NULL: from
 *                    the origin on
 * @param options     threads, should_stop, progress and user count; NULL: the defaults
 * @param out         `count` records
 * @return FPT_CANCELLED when should_stop said so; then records not reached have t NaN and FPT_RAY_NOT_PROVEN
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_caster_first(const struct fpt_caster *caster,
                            const double *origins,
                            const double *directions,
                            size_t count,
                            const double *reach,
                            const struct fpt_hit_options *options,
                            struct fpt_ray_hit *out);

/**
 * The first hit of each ray alone: what lies behind it is not looked at. Proven as fpt_caster_first; the records are the same but for
 * `count`, which is 1, or 0 for none. Cost: half of fpt_caster_first where rays pass through two walls.
 *
 * @param origins     as for fpt_caster_first
 * @param directions  as for fpt_caster_first
 * @param count       as for fpt_caster_first
 * @param reach       as for fpt_caster_first
 * @param options     as for fpt_caster_first
 * @param out         `count` records
 * @return as fpt_caster_first
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_caster_nearest(const struct fpt_caster *caster,
                              const double *origins,
                              const double *directions,
                              size_t count,
                              const double *reach,
                              const struct fpt_hit_options *options,
                              struct fpt_ray_hit *out);

/**
 * All hits of each ray, in the order along it.
 *
 * @param origins     as for fpt_caster_first
 * @param directions  as for fpt_caster_first
 * @param count       as for fpt_caster_first
 * @param reach       as for fpt_caster_first
 * @param options     as for fpt_caster_first
 * @param out         the hits; release them with fpt_ray_hits_free
 * @return FPT_CANCELLED when should_stop said so: rays not reached have no hit, some have only their first one, and all of these have
 *         FPT_RAY_NOT_PROVEN in their flags
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_caster_all(const struct fpt_caster *caster,
                          const double *origins,
                          const double *directions,
                          size_t count,
                          const double *reach,
                          const struct fpt_hit_options *options,
                          struct fpt_ray_hits **out);

/**
 * The number of all hits.
 * @since 0.1
 */
FPT_MUST_USE fpt_status fpt_ray_hits_count(const struct fpt_ray_hits *hits, size_t *out_count);

/**
 * All hits, ray by ray.
 *
 * @param capacity  records that fit into `out`; at least the number of hits, else FPT_INVALID_ARGUMENT
 * @param out       the hits
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_ray_hits_get(const struct fpt_ray_hits *hits,
                            size_t capacity,
                            struct fpt_ray_hit *out);

/**
 * Where the hits of each ray begin: those of ray k are numbers starts[k] to starts[k+1] - 1.
 *
 * @param capacity  numbers that fit into `out`; at least the number of rays + 1, else FPT_INVALID_ARGUMENT
 * @param out       the starts, as many as rays + 1
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_ray_hits_starts(const struct fpt_ray_hits *hits,
                               size_t capacity,
                               size_t *out);

/**
 * Flags of each ray: FPT_RAY_NOT_PROVEN where hits may be missing, FPT_RAY_BAD_RAY.
 *
 * @param capacity  numbers that fit into `out`; at least the number of rays, else FPT_INVALID_ARGUMENT
 * @param out       the flags, one number a ray
 * @since 0.1
 */
FPT_MUST_USE
fpt_status fpt_ray_hits_flags(const struct fpt_ray_hits *hits,
                              size_t capacity,
                              uint32_t *out);

/**
 * Releases hits. NULL is fine. No other call may use the handle during or after this one.
 * @since 0.1
 */
void fpt_ray_hits_free(struct fpt_ray_hits *hits);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FOOTPOINT_H */
