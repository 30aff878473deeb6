#ifndef FOOTPOINT_H
#define FOOTPOINT_H 
#include <stddef.h>
#include <stdint.h>
#define FPT_VERSION_MAJOR 0
#define FPT_VERSION_MINOR 1
#define FPT_VERSION_PATCH 0
#define FPT_VERSION (FPT_VERSION_MAJOR * 1000000 + FPT_VERSION_MINOR * 1000 + FPT_VERSION_PATCH)
#define FPT_ABI_VERSION 1
#if defined(__GNUC__) || defined(__clang__)
#define FPT_MUST_USE __attribute__((warn_unused_result))
#elif defined(_MSC_VER)
#define FPT_MUST_USE _Check_return_
#else
#define FPT_MUST_USE 
#endif
typedef enum fpt_status_code {
    FPT_OK = 0,
    FPT_NULL_ARGUMENT = 1,
    FPT_INVALID_ARGUMENT = 2,
    FPT_BUDGET_EXHAUSTED = 3,
    FPT_CANCELLED = 4,
    FPT_UNSUPPORTED = 5,
    FPT_OUT_OF_MEMORY = 6,
    FPT_INTERNAL = 99,
} fpt_status_code;
typedef enum fpt_foot_flag {
    FPT_FOOT_NOT_PROVEN = 1,
    FPT_FOOT_EDGE = 2,
    FPT_FOOT_CORNER = 4,
    FPT_FOOT_SEAM = 8,
    FPT_FOOT_COLLAPSED = 16,
    FPT_FOOT_TIE = 32,
    FPT_FOOT_CONTINUUM = 64,
    FPT_FOOT_NOT_ON_SHAPE = 128,
    FPT_FOOT_BAD_QUERY = 256,
    FPT_FOOT_HINT_USED = 512,
    FPT_FOOT_BUDGET = 1024,
    FPT_FOOT_CREASE = 2048,
} fpt_foot_flag;
typedef enum fpt_method {
    FPT_METHOD_AUTO = 0,
    FPT_METHOD_MAF = 1,
    FPT_METHOD_NEWTON = 2,
    FPT_METHOD_OSCULATING = 3,
} fpt_method;
typedef enum fpt_scope {
    FPT_SCOPE_GLOBAL = 0,
    FPT_SCOPE_LOCAL = 1,
} fpt_scope;
typedef enum fpt_member_kind {
    FPT_MEMBER_POINT = 0,
    FPT_MEMBER_ARC_U = 1,
    FPT_MEMBER_ARC_V = 2,
    FPT_MEMBER_REGION = 3,
} fpt_member_kind;
typedef enum fpt_member_nature {
    FPT_NATURE_MINIMUM = 0,
    FPT_NATURE_MAXIMUM = 1,
    FPT_NATURE_SADDLE = 2,
    FPT_NATURE_FLAT = 3,
} fpt_member_nature;
typedef enum fpt_normal_flag {
    FPT_NORMAL_AMBIGUOUS_SIDE = 1,
    FPT_NORMAL_CREASE = 2,
    FPT_NORMAL_LIMIT = 4,
    FPT_NORMAL_UNDEFINED = 8,
} fpt_normal_flag;
typedef enum fpt_path_change {
    FPT_PATH_JUMP = 1,
    FPT_PATH_SEAM_CROSSED = 2,
    FPT_PATH_THROUGH_COLLAPSED = 4,
    FPT_PATH_TIE = 8,
} fpt_path_change;
typedef enum fpt_weights_state {
    FPT_WISH_NONE = 0,
    FPT_WISH_MET = 1,
    FPT_WISH_NOT_MET = 2,
    FPT_WISH_IMPOSSIBLE = 3,
} fpt_weights_state;
typedef enum fpt_weights_flag {
    FPT_WEIGHT_ON_CHORD = 1,
    FPT_WEIGHT_LIMITED = 2,
    FPT_WEIGHT_AT_LIMIT = 4,
    FPT_WEIGHT_UNTRAINED = 8,
} fpt_weights_flag;
typedef enum fpt_weights_constraint_kind {
    FPT_CONSTRAINT_POINT_AT = 0,
    FPT_CONSTRAINT_POINT = 1,
    FPT_CONSTRAINT_TANGENT_AT = 2,
    FPT_CONSTRAINT_TANGENT_KEPT = 3,
} fpt_weights_constraint_kind;
typedef enum fpt_weights_unit {
    FPT_UNIT_FIRST = 0,
    FPT_UNIT_GREATEST = 1,
    FPT_UNIT_MIDDLE = 2,
} fpt_weights_unit;
typedef enum fpt_elementary_kind {
    FPT_ELEMENTARY_PLANE = 0,
    FPT_ELEMENTARY_CYLINDER = 1,
    FPT_ELEMENTARY_CONE = 2,
    FPT_ELEMENTARY_SPHERE = 3,
    FPT_ELEMENTARY_TORUS = 4,
    FPT_ELEMENTARY_REVOLUTION = 5,
    FPT_ELEMENTARY_EXTRUSION = 6,
} fpt_elementary_kind;
typedef enum fpt_pcurve_kind {
    FPT_PCURVE_ISOLINE = 0,
    FPT_PCURVE_POLYLINE = 1,
    FPT_PCURVE_SPLINE = 2,
    FPT_PCURVE_ARC = 3,
} fpt_pcurve_kind;
typedef enum fpt_coedge_flag {
    FPT_COEDGE_REVERSED = 1,
    FPT_COEDGE_SAME_PARAMETER = 2,
} fpt_coedge_flag;
typedef enum fpt_replacement {
    FPT_REPLACEMENT_POLYLINE = 0,
    FPT_REPLACEMENT_SPLINE = 1,
    FPT_REPLACEMENT_VERTICES = 2,
} fpt_replacement;
typedef enum fpt_finding_kind {
    FPT_FINDING_OPEN = 0,
    FPT_FINDING_DIRECTION = 1,
    FPT_FINDING_NO_DIRECTION = 2,
    FPT_FINDING_CROSSING = 3,
    FPT_FINDING_TOUCHING = 4,
    FPT_FINDING_EDGE_GAP = 5,
    FPT_FINDING_OUTSIDE = 6,
    FPT_FINDING_CONTAINMENT = 7,
    FPT_FINDING_SENSE = 8,
    FPT_FINDING_FAILING = 9,
    FPT_FINDING_UNDECIDED = 10,
} fpt_finding_kind;
typedef enum fpt_spacing {
    FPT_SPACING_CHORDAL = 0,
    FPT_SPACING_CENTRIPETAL = 1,
    FPT_SPACING_UNIFORM = 2,
} fpt_spacing;
typedef enum fpt_fit_condition {
    FPT_FIT_FREE = 0,
    FPT_FIT_TANGENTS = 1,
    FPT_FIT_NATURAL = 2,
    FPT_FIT_PERIODIC = 3,
} fpt_fit_condition;
typedef enum fpt_arc_form {
    FPT_ARC_QUARTERS = 0,
    FPT_ARC_HALVES = 1,
    FPT_ARC_THIRDS = 2,
    FPT_ARC_CUBIC = 3,
    FPT_ARC_QUINTIC = 4,
} fpt_arc_form;
typedef enum fpt_quadric_patch {
    FPT_PATCH_ELLIPSOID = 0,
    FPT_PATCH_ONE_SHEET = 1,
    FPT_PATCH_TWO_SHEETS = 2,
    FPT_PATCH_PARABOLOID = 3,
    FPT_PATCH_CONE = 4,
    FPT_PATCH_CYLINDER = 5,
} fpt_quadric_patch;
typedef enum fpt_deviation_flag {
    FPT_DEVIATION_NOT_PROVEN = 1,
    FPT_DEVIATION_NOT_ON_SURFACE = 2,
    FPT_DEVIATION_ALONG_SEAM_U = 4,
    FPT_DEVIATION_ALONG_SEAM_V = 8,
    FPT_DEVIATION_FROM_SEAM = 16,
    FPT_DEVIATION_TO_SEAM = 32,
    FPT_DEVIATION_FROM_COLLAPSED = 64,
    FPT_DEVIATION_TO_COLLAPSED = 128,
    FPT_DEVIATION_EXACT = 256,
} fpt_deviation_flag;
typedef enum fpt_face_standing {
    FPT_FACE_INSIDE = 0,
    FPT_FACE_OUTSIDE = 1,
    FPT_FACE_ON_EDGE = 2,
    FPT_FACE_UNKNOWN = 3,
} fpt_face_standing;
typedef enum fpt_standing_flag {
    FPT_STANDING_NOT_PROVEN = 1,
} fpt_standing_flag;
typedef enum fpt_branch_end {
    FPT_BRANCH_END_CLOSED = 0,
    FPT_BRANCH_END_BORDER = 1,
    FPT_BRANCH_END_CONTACT = 2,
    FPT_BRANCH_END_UNDECIDED = 3,
    FPT_BRANCH_END_TRIM = 4,
} fpt_branch_end;
typedef enum fpt_intersect_method {
    FPT_INTERSECT_AUTO = 0,
    FPT_INTERSECT_SUBDIVISION = 1,
    FPT_INTERSECT_MESH = 2,
} fpt_intersect_method;
typedef enum fpt_corrector {
    FPT_CORRECTOR_AUTO = 0,
    FPT_CORRECTOR_NEWTON_HOLDS_U = 1,
    FPT_CORRECTOR_NEWTON_HOLDS_V = 2,
    FPT_CORRECTOR_NEWTON_HOLDS_S = 3,
    FPT_CORRECTOR_NEWTON_HOLDS_T = 4,
    FPT_CORRECTOR_NEWTON_FOUR = 5,
    FPT_CORRECTOR_MAF = 6,
} fpt_corrector;
typedef enum fpt_section_end {
    FPT_SECTION_END_CLOSED = 0,
    FPT_SECTION_END_BORDER = 1,
    FPT_SECTION_END_SINGULAR = 2,
    FPT_SECTION_END_COLLAPSED = 3,
    FPT_SECTION_END_UNDECIDED = 4,
} fpt_section_end;
typedef enum fpt_contact_kind {
    FPT_CONTACT_TOUCHING = 0,
    FPT_CONTACT_CROSSING = 1,
    FPT_CONTACT_DEGENERATE = 2,
    FPT_CONTACT_BORDER = 3,
    FPT_CONTACT_TIP = 4,
} fpt_contact_kind;
typedef enum fpt_fair_method {
    FPT_FAIR_ENERGY = 0,
    FPT_FAIR_LOCAL = 1,
    FPT_FAIR_KNOT_REMOVAL = 2,
} fpt_fair_method;
typedef enum fpt_inspect_quantity {
    FPT_QUANTITY_GREATER = 0,
    FPT_QUANTITY_LESS = 1,
    FPT_QUANTITY_MEAN = 2,
    FPT_QUANTITY_GAUSSIAN = 3,
    FPT_QUANTITY_SHARPEST = 4,
} fpt_inspect_quantity;
typedef enum fpt_inspect_pattern {
    FPT_PATTERN_SHADED = 0,
    FPT_PATTERN_ZEBRA = 1,
    FPT_PATTERN_ISOPHOTES = 2,
    FPT_PATTERN_REFLECTION_LINES = 3,
    FPT_PATTERN_HIGHLIGHT_LINES = 4,
    FPT_PATTERN_GREATER = 5,
    FPT_PATTERN_LESS = 6,
    FPT_PATTERN_MEAN = 7,
    FPT_PATTERN_GAUSSIAN = 8,
} fpt_inspect_pattern;
typedef enum fpt_inspect_kind {
    FPT_PLACE_RISING = 0,
    FPT_PLACE_FALLING = 1,
    FPT_PLACE_CONSTANT = 2,
    FPT_PLACE_UNKNOWN = 3,
    FPT_PLACE_INFLECTION = 4,
    FPT_PLACE_STRAIGHT = 5,
    FPT_PLACE_UMBILIC = 6,
    FPT_PLACE_UMBILIC_AREA = 7,
    FPT_PLACE_UNBOUNDED = 8,
    FPT_PLACE_EXCLUDED = 9,
} fpt_inspect_kind;
typedef enum fpt_inspect_side {
    FPT_SIDE_BOTH = 0,
    FPT_SIDE_LEAST = 1,
    FPT_SIDE_GREATEST = 2,
} fpt_inspect_side;
typedef enum fpt_inspect_range_flag {
    FPT_RANGE_LEAST_UNBOUNDED = 1,
    FPT_RANGE_GREATEST_UNBOUNDED = 2,
    FPT_RANGE_REST_PROVEN = 4,
} fpt_inspect_range_flag;
typedef enum fpt_direction {
    FPT_DIRECTION_U = 0,
    FPT_DIRECTION_V = 1,
} fpt_direction;
typedef enum fpt_quadric_kind {
    FPT_QUADRIC_PLANE = 0,
    FPT_QUADRIC_SPHERE = 1,
    FPT_QUADRIC_CYLINDER = 2,
    FPT_QUADRIC_CONE = 3,
    FPT_QUADRIC_GENERAL = 4,
} fpt_quadric_kind;
typedef enum fpt_hit_nature {
    FPT_HIT_TRANSVERSAL = 0,
    FPT_HIT_TANGENTIAL = 1,
    FPT_HIT_OVERLAP = 2,
} fpt_hit_nature;
typedef enum fpt_ray_flag {
    FPT_RAY_TANGENTIAL = 1,
    FPT_RAY_EDGE = 2,
    FPT_RAY_OVERLAP = 4,
    FPT_RAY_NOT_PROVEN = 8,
    FPT_RAY_BAD_RAY = 16,
} fpt_ray_flag;
typedef enum fpt_conic_kind {
    FPT_CONIC_LINE = 0,
    FPT_CONIC_ELLIPSE = 1,
    FPT_CONIC_HYPERBOLA = 2,
    FPT_CONIC_PARABOLA = 3,
    FPT_CONIC_POINT = 4,
} fpt_conic_kind;
typedef struct Interval Interval;
typedef struct fpt_arc_length fpt_arc_length;
typedef struct fpt_caster fpt_caster;
typedef struct fpt_curve fpt_curve;
typedef struct fpt_curve_hits fpt_curve_hits;
typedef struct fpt_face fpt_face;
typedef struct fpt_fair_report fpt_fair_report;
typedef struct fpt_foot_set fpt_foot_set;
typedef struct fpt_inspect_set fpt_inspect_set;
typedef struct fpt_pcurve_set fpt_pcurve_set;
typedef struct fpt_ray_hits fpt_ray_hits;
typedef struct fpt_relation fpt_relation;
typedef struct fpt_scene fpt_scene;
typedef struct fpt_sections fpt_sections;
typedef struct fpt_support fpt_support;
typedef struct fpt_surface fpt_surface;
typedef struct fpt_surface_intersection fpt_surface_intersection;
typedef struct fpt_transform fpt_transform;
typedef struct fpt_trim fpt_trim;
typedef struct fpt_trim_report fpt_trim_report;
typedef struct fpt_weights_report fpt_weights_report;
typedef int32_t fpt_status;
typedef struct fpt_query_options {
    size_t struct_size;
    double tolerance;
    double accuracy;
    uint32_t method;
    uint32_t scope;
    const double *hints;
    size_t point_stride;
    size_t hint_stride;
    double domain[4];
    uint32_t threads;
    uint32_t reserved;
    uint64_t budget;
    int (*should_stop)(void *user);
    void (*progress)(void *user, size_t done, size_t total);
    void (*trace)(void *user, size_t query, uint32_t step, double u, double v, double residual);
    void *user;
} fpt_query_options;
typedef struct fpt_curve_data {
    size_t struct_size;
    size_t degree;
    size_t pole_count;
    const double *knots;
    const double *poles;
    const double *weights;
} fpt_curve_data;
typedef struct fpt_surface_data {
    size_t struct_size;
    size_t degree_u;
    size_t degree_v;
    size_t pole_count_u;
    size_t pole_count_v;
    const double *knots_u;
    const double *knots_v;
    const double *poles;
    const double *weights;
} fpt_surface_data;
typedef struct fpt_curve_callback {
    size_t struct_size;
    int32_t (*evaluate)(void *user, double u, uint32_t derivatives, double *out);
    void *user;
    void (*release)(void *user);
    double domain[2];
    double speed_bound;
    double second_bound;
} fpt_curve_callback;
typedef struct fpt_surface_callback {
    size_t struct_size;
    int32_t (*evaluate)(void *user, double u, double v, uint32_t derivatives, double *out);
    void *user;
    void (*release)(void *user);
    double domain[4];
    double speed_bounds[2];
    double second_bounds[3];
} fpt_surface_callback;
typedef struct fpt_foot_point {
    double u;
    double v;
    double point[3];
    double distance;
    double lower_bound;
    uint32_t flags;
    uint32_t iterations;
} fpt_foot_point;
typedef struct fpt_extrema_options {
    size_t struct_size;
    double accuracy;
    double radius;
    size_t nearest;
    uint32_t minima_only;
    uint32_t reserved;
    double domain[4];
    uint64_t budget;
    int (*should_stop)(void *user);
    void *user;
} fpt_extrema_options;
typedef struct fpt_foot_member {
    struct fpt_foot_point foot;
    double u[2];
    double v[2];
    uint32_t kind;
    uint32_t nature;
} fpt_foot_member;
typedef struct fpt_scene_member {
    size_t struct_size;
    const struct fpt_curve *curve;
    const struct fpt_surface *surface;
    const double *placement;
} fpt_scene_member;
typedef struct fpt_scene_data {
    size_t struct_size;
    size_t member_count;
    const struct fpt_scene_member *members;
} fpt_scene_data;
typedef struct fpt_weights_options {
    size_t struct_size;
    double weight_min;
    double weight_max;
    double ratio_limit;
    double tolerance;
    uint32_t symmetric;
    uint32_t steps;
    uint32_t starts;
    uint32_t reserved;
    uint64_t seed;
    int (*should_stop)(void *user);
    void *user;
} fpt_weights_options;
typedef struct fpt_weights_constraint {
    uint32_t kind;
    uint32_t reserved;
    double u;
    double v;
    double vector[3];
} fpt_weights_constraint;
typedef struct fpt_weights_pole {
    double wish;
    double chord_distance;
    double first_guess;
    double weight;
    double distance;
    double lower_bound;
    double u;
    double v;
    uint32_t state;
    uint32_t flags;
} fpt_weights_pole;
typedef struct fpt_weights_outcome {
    double error;
    double u;
    double v;
    uint32_t met;
    uint32_t reserved;
} fpt_weights_outcome;
typedef struct fpt_weights_summary {
    double tolerance;
    uint64_t iterations;
    uint32_t starts;
    uint32_t is_met;
    uint64_t met;
    uint64_t not_met;
    uint64_t impossible;
} fpt_weights_summary;
typedef struct fpt_weights_conic_shape {
    double weight;
    double rho;
    double eccentricity;
} fpt_weights_conic_shape;
typedef struct fpt_difference {
    double bound;
    double reached;
    double u;
    double v;
} fpt_difference;
typedef struct fpt_estimate {
    double value;
    double error;
} fpt_estimate;
typedef struct fpt_curve_frame_record {
    double point[3];
    double tangent[3];
    double normal[3];
    double binormal[3];
    double speed;
    double curvature;
    double torsion;
} fpt_curve_frame_record;
typedef struct fpt_joint {
    double u;
    uint32_t multiplicity;
    uint32_t order;
    double gap;
    double first_jump;
    double tangent_angle;
    double curvature_jump;
} fpt_joint;
typedef struct fpt_knot_line {
    double value;
    uint32_t multiplicity;
    uint32_t order;
    double gap;
    double first_jump;
} fpt_knot_line;
typedef struct fpt_fit_options {
    size_t struct_size;
    double tolerance;
    uint32_t degree_u;
    uint32_t degree_v;
    uint32_t spacing;
    uint32_t condition;
    const double *tangents;
    size_t max_poles;
    uint32_t keep_parameters;
    uint32_t certify;
    uint32_t threads;
    uint32_t reserved;
    int (*should_stop)(void *user);
    void *user;
} fpt_fit_options;
typedef struct fpt_fit_result {
    double worst;
    double at_least;
    double rms;
    uint64_t worst_index;
    uint64_t unproven;
} fpt_fit_result;
typedef struct fpt_sweep_options {
    size_t struct_size;
    double tolerance;
    double twist;
    uint32_t degree;
    uint32_t close;
    size_t max_poles;
} fpt_sweep_options;
typedef struct fpt_relation_callback {
    size_t struct_size;
    double (*forward)(void *user, double x);
    double (*backward)(void *user, double y);
    void *user;
    void (*release)(void *user);
    double domain[2];
} fpt_relation_callback;
typedef struct fpt_elementary_data {
    size_t struct_size;
    uint32_t kind;
    uint32_t reserved;
    double domain[4];
    double origin[3];
    double x[3];
    double y[3];
    double z[3];
    double first;
    double second;
    const struct fpt_curve *curve;
} fpt_elementary_data;
typedef struct fpt_edge_data {
    const struct fpt_curve *curve;
    double point[3];
    uint32_t reversed;
    uint32_t reserved;
} fpt_edge_data;
typedef struct fpt_coedge_data {
    uint32_t kind;
    uint32_t flags;
    size_t edge;
    double values[8];
    const double *points;
    const double *parameters;
    size_t point_count;
    const struct fpt_curve *curve;
} fpt_coedge_data;
typedef struct fpt_loop_data {
    uint32_t is_inner;
    uint32_t reserved;
    const struct fpt_coedge_data *coedges;
    size_t coedge_count;
} fpt_loop_data;
typedef struct fpt_trim_data {
    size_t struct_size;
    const struct fpt_support *support;
    const struct fpt_edge_data *edges;
    size_t edge_count;
    const struct fpt_loop_data *loops;
    size_t loop_count;
    uint32_t flipped;
    uint32_t reserved;
} fpt_trim_data;
typedef struct fpt_change_options {
    size_t struct_size;
    double tolerance;
    uint32_t replacement;
    uint32_t reserved;
} fpt_change_options;
typedef struct fpt_change_summary {
    double deviation;
    double surface_deviation;
    uint32_t proven;
    uint32_t surface_proven;
} fpt_change_summary;
typedef struct fpt_trim_summary {
    double tolerance;
    double largest_opening;
    double largest_gap;
    double gap_bound;
    double segment_error;
    uint32_t proven;
    uint32_t reserved;
    size_t finding_count;
} fpt_trim_summary;
typedef struct fpt_trim_finding {
    uint32_t kind;
    uint32_t reserved;
    size_t loop_index;
    size_t coedge;
    double parameter;
    size_t other_loop;
    size_t other_coedge;
    double other_parameter;
    double numbers[3];
} fpt_trim_finding;
typedef struct fpt_pull_options {
    size_t struct_size;
    double tolerance;
    size_t degree;
    size_t pole_limit;
    const double *hint;
    int (*should_stop)(void *user);
    void *user;
} fpt_pull_options;
typedef struct fpt_lift_options {
    size_t struct_size;
    double tolerance;
    size_t exact_degree;
} fpt_lift_options;
typedef struct fpt_deviation {
    double bound;
    double reached;
    double at;
    uint32_t flags;
    uint32_t reserved;
} fpt_deviation;
typedef struct fpt_face_options {
    size_t struct_size;
    uint64_t budget;
    int (*should_stop)(void *user);
    void (*progress)(void *user, size_t done, size_t total);
    void *user;
} fpt_face_options;
typedef struct fpt_face_data {
    size_t struct_size;
    const struct fpt_surface *surface;
    size_t loop_count;
    const size_t *coedge_counts;
    const struct fpt_curve *const *pcurves;
} fpt_face_data;
typedef struct fpt_face_place {
    uint32_t standing;
    uint32_t loop_index;
    uint32_t coedge_index;
    uint32_t flags;
    double parameter;
} fpt_face_place;
typedef struct fpt_intersect_surfaces_options {
    size_t struct_size;
    double chord;
    uint64_t budget;
    int (*should_stop)(void *user);
    void (*progress)(void *user, size_t done, size_t total);
    void *user;
    double tolerance;
    uint32_t method;
    uint32_t corrector;
    uint32_t levels;
    uint32_t reserved;
    void (*trace)(void *user, uint32_t step, const double *uvst, double gap);
} fpt_intersect_surfaces_options;
typedef struct fpt_intersection_summary {
    size_t branch_count;
    size_t contact_count;
    size_t overlap_count;
    size_t undecided_count;
    uint64_t pairs;
    uint32_t is_proven;
    uint32_t is_exhausted;
    uint32_t is_stopped;
    uint32_t reserved;
} fpt_intersection_summary;
typedef struct fpt_intersection_branch {
    size_t point_count;
    double gap;
    double chord;
    uint32_t is_tangential;
    uint32_t bounds_overlap;
    uint32_t is_closed;
    uint32_t reserved;
    uint32_t end_kind[2];
    uint32_t end_index[2];
} fpt_intersection_branch;
typedef struct fpt_intersection_point {
    double point[3];
    double uv[2];
    double st[2];
} fpt_intersection_point;
typedef struct fpt_intersection_contact {
    struct fpt_intersection_point place;
    double gap;
    double radius;
    uint32_t kind;
    uint32_t reserved;
} fpt_intersection_contact;
typedef struct fpt_inspect_options {
    size_t struct_size;
    double domain[4];
    double relative;
    double accuracy;
    uint64_t budget;
    int (*should_stop)(void *user);
    void *user;
    uint32_t side;
    uint32_t reserved;
} fpt_inspect_options;
typedef struct fpt_inspect_picture_options {
    size_t struct_size;
    uint32_t pattern;
    uint32_t bands;
    uint32_t width;
    uint32_t height;
    double eye[3];
    double up[3];
    double light[3];
    double range[2];
} fpt_inspect_picture_options;
typedef struct fpt_fair_options {
    size_t struct_size;
    double deviation;
    double strain;
    double jerk;
    double distance;
    uint32_t method;
    uint32_t by_length;
    uint32_t ends[2];
    uint32_t borders[4];
    const size_t *fixed;
    size_t fixed_count;
    const double *through;
    size_t through_count;
    const double *knots;
    size_t knot_count;
    double length[2];
    double region[4];
    uint32_t steps;
    uint32_t calm;
    int (*should_stop)(void *user);
    void *user;
    double slope;
} fpt_fair_options;
typedef struct fpt_fair_summary {
    double energy_before;
    double energy_after;
    double deviation;
    uint64_t steps;
    uint32_t converged;
    uint32_t reserved;
} fpt_fair_summary;
typedef struct fpt_inspect_range {
    double least[2];
    double greatest[2];
    double at_least[2];
    double at_greatest[2];
    double excluded;
    double moved;
    uint64_t boxes;
    uint32_t proven;
    uint32_t flags;
} fpt_inspect_range;
typedef struct fpt_inspect_tooth {
    double u;
    double point[3];
    double tangent[3];
    double bend[3];
    double curvature;
    double torsion;
} fpt_inspect_tooth;
typedef struct fpt_inspect_curvature {
    double point[3];
    double normal[3];
    double principal[2];
    double directions[6];
    double mean;
    double gaussian;
    uint32_t is_umbilic;
    uint32_t is_singular;
} fpt_inspect_curvature;
typedef struct fpt_inspect_place {
    double u[2];
    double v[2];
    double value[2];
    uint32_t kind;
    uint32_t reserved;
} fpt_inspect_place;
typedef struct fpt_inspect_distance {
    double lower;
    double upper;
    double at[2];
    uint64_t boxes;
    uint32_t proven;
    uint32_t reserved;
} fpt_inspect_distance;
typedef struct fpt_inspect_measured {
    double lower;
    double upper;
    double at;
} fpt_inspect_measured;
typedef struct fpt_inspect_continuity {
    struct fpt_inspect_measured gap;
    struct fpt_inspect_measured angle;
    struct fpt_inspect_measured curvature;
    uint64_t intervals;
} fpt_inspect_continuity;
typedef struct fpt_hit_options {
    size_t struct_size;
    double tolerance;
    double chord;
    uint64_t budget;
    uint32_t threads;
    uint32_t reserved;
    int (*should_stop)(void *user);
    void (*progress)(void *user, size_t done, size_t total);
    void *user;
} fpt_hit_options;
typedef struct fpt_quadric {
    uint32_t kind;
    uint32_t reserved;
    double origin[3];
    double axis[3];
    double size;
    double matrix[6];
    double linear[3];
    double constant;
} fpt_quadric;
typedef struct fpt_curve_hit {
    double u;
    double v;
    double w;
    double point[3];
    double distance;
    double u_range[2];
    double v_range[2];
    double w_range[2];
    uint32_t nature;
    uint32_t multiplicity;
} fpt_curve_hit;
typedef struct fpt_branch {
    size_t point_count;
    uint32_t ends[2];
    uint32_t tangential;
    uint32_t reserved;
} fpt_branch;
typedef struct fpt_section_point {
    double u;
    double v;
    double point[3];
    double distance;
    uint32_t arms;
    uint32_t reserved;
} fpt_section_point;
typedef struct fpt_section_region {
    double domain[4];
    uint32_t overlaps;
    uint32_t reserved;
} fpt_section_region;
typedef struct fpt_conic {
    uint32_t kind;
    uint32_t reserved;
    double center[3];
    double axes[6];
    double lengths[2];
} fpt_conic;
typedef struct fpt_ray_hit {
    double t;
    double u;
    double v;
    double point[3];
    uint32_t flags;
    uint32_t count;
} fpt_ray_hit;
#ifdef __cplusplus
extern "C" {
#endif
const char *fpt_last_error(void);
const char *fpt_status_name(fpt_status status);
uint32_t fpt_version(void);
uint32_t fpt_abi_version(void);
void fpt_query_options_init(struct fpt_query_options *options, size_t struct_size);
FPT_MUST_USE fpt_status fpt_curve_new(const struct fpt_curve_data *data, struct fpt_curve **out);
void fpt_curve_free(struct fpt_curve *curve);
FPT_MUST_USE fpt_status fpt_curve_domain(const struct fpt_curve *curve, double *out_u);
FPT_MUST_USE
fpt_status fpt_curve_evaluate(const struct fpt_curve *curve,
                              double u,
                              uint32_t derivatives,
                              double *out);
FPT_MUST_USE
fpt_status fpt_curve_evaluate_many(const struct fpt_curve *curve,
                                   const double *parameters,
                                   size_t count,
                                   uint32_t derivatives,
                                   double *out);
FPT_MUST_USE fpt_status fpt_curve_degree(const struct fpt_curve *curve, size_t *out_degree);
FPT_MUST_USE fpt_status fpt_curve_pole_count(const struct fpt_curve *curve, size_t *out_pole_count);
FPT_MUST_USE
fpt_status fpt_curve_knots(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out_knots);
FPT_MUST_USE
fpt_status fpt_curve_poles(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out_poles);
FPT_MUST_USE
fpt_status fpt_curve_weights(const struct fpt_curve *curve,
                             size_t capacity,
                             double *out_weights);
FPT_MUST_USE
fpt_status fpt_curve_box(const struct fpt_curve *curve,
                         double *out_box);
FPT_MUST_USE
fpt_status fpt_curve_is_rational(const struct fpt_curve *curve,
                                 int32_t *out_is_rational);
FPT_MUST_USE fpt_status fpt_curve_is_closed(const struct fpt_curve *curve, int32_t *out_is_closed);
FPT_MUST_USE
fpt_status fpt_curve_prepare(const struct fpt_curve *curve);
FPT_MUST_USE
fpt_status fpt_curve_memory(const struct fpt_curve *curve,
                            size_t *out_memory);
FPT_MUST_USE
fpt_status fpt_surface_new(const struct fpt_surface_data *data,
                           struct fpt_surface **out);
void fpt_surface_free(struct fpt_surface *surface);
FPT_MUST_USE fpt_status fpt_surface_domain(const struct fpt_surface *surface, double *out_uv);
FPT_MUST_USE
fpt_status fpt_surface_evaluate(const struct fpt_surface *surface,
                                double u,
                                double v,
                                uint32_t derivatives,
                                double *out);
FPT_MUST_USE
fpt_status fpt_surface_evaluate_many(const struct fpt_surface *surface,
                                     const double *parameters,
                                     size_t count,
                                     uint32_t derivatives,
                                     double *out);
FPT_MUST_USE
fpt_status fpt_surface_degree_u(const struct fpt_surface *surface,
                                size_t *out_degree_u);
FPT_MUST_USE
fpt_status fpt_surface_degree_v(const struct fpt_surface *surface,
                                size_t *out_degree_v);
FPT_MUST_USE
fpt_status fpt_surface_pole_count_u(const struct fpt_surface *surface,
                                    size_t *out_pole_count_u);
FPT_MUST_USE
fpt_status fpt_surface_pole_count_v(const struct fpt_surface *surface,
                                    size_t *out_pole_count_v);
FPT_MUST_USE
fpt_status fpt_surface_knots_u(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_knots_u);
FPT_MUST_USE
fpt_status fpt_surface_knots_v(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_knots_v);
FPT_MUST_USE
fpt_status fpt_surface_poles(const struct fpt_surface *surface,
                             size_t capacity,
                             double *out_poles);
FPT_MUST_USE
fpt_status fpt_surface_weights(const struct fpt_surface *surface,
                               size_t capacity,
                               double *out_weights);
FPT_MUST_USE
fpt_status fpt_surface_box(const struct fpt_surface *surface,
                           double *out_box);
FPT_MUST_USE
fpt_status fpt_surface_is_rational(const struct fpt_surface *surface,
                                   int32_t *out_is_rational);
FPT_MUST_USE
fpt_status fpt_surface_is_closed_u(const struct fpt_surface *surface,
                                   int32_t *out_is_closed_u);
FPT_MUST_USE
fpt_status fpt_surface_is_closed_v(const struct fpt_surface *surface,
                                   int32_t *out_is_closed_v);
FPT_MUST_USE
fpt_status fpt_surface_collapsed_edges(const struct fpt_surface *surface,
                                       int32_t *out_collapsed);
FPT_MUST_USE
fpt_status fpt_surface_prepare(const struct fpt_surface *surface);
FPT_MUST_USE
fpt_status fpt_surface_memory(const struct fpt_surface *surface,
                              size_t *out_memory);
FPT_MUST_USE
fpt_status fpt_curve_from_callback(const struct fpt_curve_callback *callback,
                                   struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_surface_from_callback(const struct fpt_surface_callback *callback,
                                     struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_curve_closest(const struct fpt_curve *curve,
                             const double *points,
                             size_t count,
                             const struct fpt_query_options *options,
                             struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_curve_invert(const struct fpt_curve *curve,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_closest(const struct fpt_surface *surface,
                               const double *points,
                               size_t count,
                               const struct fpt_query_options *options,
                               struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_invert(const struct fpt_surface *surface,
                              const double *points,
                              size_t count,
                              const struct fpt_query_options *options,
                              struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_curve_closest_f32(const struct fpt_curve *curve,
                                 const float *points,
                                 size_t count,
                                 const struct fpt_query_options *options,
                                 struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_curve_invert_f32(const struct fpt_curve *curve,
                                const float *points,
                                size_t count,
                                const struct fpt_query_options *options,
                                struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_closest_f32(const struct fpt_surface *surface,
                                   const float *points,
                                   size_t count,
                                   const struct fpt_query_options *options,
                                   struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_invert_f32(const struct fpt_surface *surface,
                                  const float *points,
                                  size_t count,
                                  const struct fpt_query_options *options,
                                  struct fpt_foot_point *out);
void fpt_extrema_options_init(struct fpt_extrema_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_curve_preimage(const struct fpt_curve *curve,
                              const double *point,
                              double tolerance,
                              const struct fpt_query_options *options,
                              struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_surface_preimage(const struct fpt_surface *surface,
                                const double *point,
                                double tolerance,
                                const struct fpt_query_options *options,
                                struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_curve_extrema(const struct fpt_curve *curve,
                             const double *point,
                             const struct fpt_extrema_options *options,
                             struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_surface_extrema(const struct fpt_surface *surface,
                               const double *point,
                               const struct fpt_extrema_options *options,
                               struct fpt_foot_set **out);
FPT_MUST_USE fpt_status fpt_foot_set_count(const struct fpt_foot_set *set, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_foot_set_get(const struct fpt_foot_set *set,
                            size_t index,
                            struct fpt_foot_member *out);
FPT_MUST_USE
fpt_status fpt_foot_set_undecided_count(const struct fpt_foot_set *set,
                                        size_t *out_count);
FPT_MUST_USE
fpt_status fpt_foot_set_undecided_get(const struct fpt_foot_set *set,
                                      size_t index,
                                      double *out_uv);
void fpt_foot_set_free(struct fpt_foot_set *set);
FPT_MUST_USE
fpt_status fpt_curve_on_line(const struct fpt_curve *curve,
                             const double *origin,
                             const double *direction,
                             const double *reach,
                             double tolerance,
                             const struct fpt_query_options *options,
                             struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_surface_on_line(const struct fpt_surface *surface,
                               const double *origin,
                               const double *direction,
                               const double *reach,
                               double tolerance,
                               const struct fpt_query_options *options,
                               struct fpt_foot_set **out);
FPT_MUST_USE
fpt_status fpt_curve_project(const struct fpt_curve *curve,
                             const double *points,
                             size_t count,
                             const double *direction,
                             const struct fpt_query_options *options,
                             struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_project(const struct fpt_surface *surface,
                               const double *points,
                               size_t count,
                               const double *direction,
                               const struct fpt_query_options *options,
                               struct fpt_foot_point *out);
FPT_MUST_USE
fpt_status fpt_surface_normals(const struct fpt_surface *surface,
                               const double *points,
                               const struct fpt_foot_point *feet,
                               size_t count,
                               double *out_normals,
                               double *out_signed,
                               uint32_t *out_flags);
FPT_MUST_USE
fpt_status fpt_curve_tangents(const struct fpt_curve *curve,
                              const struct fpt_foot_point *feet,
                              size_t count,
                              double *out_tangents,
                              uint32_t *out_flags);
FPT_MUST_USE
fpt_status fpt_curve_evaluate_sided(const struct fpt_curve *curve,
                                    double u,
                                    int32_t side,
                                    uint32_t derivatives,
                                    double *out);
FPT_MUST_USE
fpt_status fpt_surface_evaluate_sided(const struct fpt_surface *surface,
                                      double u,
                                      double v,
                                      int32_t side_u,
                                      int32_t side_v,
                                      uint32_t derivatives,
                                      double *out);
FPT_MUST_USE
fpt_status fpt_curve_uncertainty(const struct fpt_curve *curve,
                                 const struct fpt_foot_point *feet,
                                 size_t count,
                                 double accuracy,
                                 double *out);
FPT_MUST_USE
fpt_status fpt_surface_uncertainty(const struct fpt_surface *surface,
                                   const struct fpt_foot_point *feet,
                                   size_t count,
                                   double accuracy,
                                   double *out);
FPT_MUST_USE
fpt_status fpt_curve_unwrap(const struct fpt_curve *curve,
                            double previous,
                            double u,
                            double *out_u);
FPT_MUST_USE
fpt_status fpt_surface_unwrap(const struct fpt_surface *surface,
                              const double *previous,
                              const double *uv,
                              double *out_uv);
FPT_MUST_USE
fpt_status fpt_curve_path(const struct fpt_curve *curve,
                          const double *points,
                          size_t count,
                          const struct fpt_query_options *options,
                          struct fpt_foot_point *out,
                          double *out_unwrapped,
                          uint32_t *out_changes);
FPT_MUST_USE
fpt_status fpt_surface_path(const struct fpt_surface *surface,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out,
                            double *out_unwrapped,
                            uint32_t *out_changes);
FPT_MUST_USE
fpt_status fpt_scene_new(const struct fpt_scene_data *data,
                         struct fpt_scene **out);
void fpt_scene_free(struct fpt_scene *scene);
FPT_MUST_USE fpt_status fpt_scene_count(const struct fpt_scene *scene, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_scene_shape(const struct fpt_scene *scene,
                           uint32_t member,
                           struct fpt_curve **out_curve,
                           struct fpt_surface **out_surface);
FPT_MUST_USE
fpt_status fpt_scene_placement(const struct fpt_scene *scene,
                               uint32_t member,
                               double *out_placement);
FPT_MUST_USE
fpt_status fpt_scene_box(const struct fpt_scene *scene,
                         double *out_box);
FPT_MUST_USE
fpt_status fpt_scene_memory(const struct fpt_scene *scene,
                            size_t *out_memory);
FPT_MUST_USE
fpt_status fpt_scene_prepare(const struct fpt_scene *scene);
FPT_MUST_USE
fpt_status fpt_scene_evaluate(const struct fpt_scene *scene,
                              uint32_t member,
                              double u,
                              double v,
                              uint32_t derivatives,
                              double *out);
FPT_MUST_USE
fpt_status fpt_scene_closest(const struct fpt_scene *scene,
                             const double *points,
                             size_t count,
                             const struct fpt_query_options *options,
                             const uint32_t *hint_members,
                             struct fpt_foot_point *out,
                             uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_invert(const struct fpt_scene *scene,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            const uint32_t *hint_members,
                            struct fpt_foot_point *out,
                            uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_closest_f32(const struct fpt_scene *scene,
                                 const float *points,
                                 size_t count,
                                 const struct fpt_query_options *options,
                                 const uint32_t *hint_members,
                                 struct fpt_foot_point *out,
                                 uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_invert_f32(const struct fpt_scene *scene,
                                const float *points,
                                size_t count,
                                const struct fpt_query_options *options,
                                const uint32_t *hint_members,
                                struct fpt_foot_point *out,
                                uint32_t *out_members);
FPT_MUST_USE
fpt_status fpt_scene_normals(const struct fpt_scene *scene,
                             const double *points,
                             const struct fpt_foot_point *feet,
                             const uint32_t *members,
                             size_t count,
                             double *out_normals,
                             double *out_signed,
                             uint32_t *out_flags);
void fpt_weights_options_init(struct fpt_weights_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_weights_general(const struct fpt_curve *curve,
                               const double *lambdas,
                               size_t lambda_count,
                               const struct fpt_weights_options *options,
                               struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_interpolated(const struct fpt_curve *curve,
                                    double first_distance,
                                    double last_distance,
                                    const struct fpt_weights_options *options,
                                    struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_network(const struct fpt_curve *curve,
                               const size_t *wish_poles,
                               const double *wish_distances,
                               size_t wish_count,
                               double min_distance,
                               double max_distance,
                               const struct fpt_weights_options *options,
                               struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_refine_curve(const struct fpt_curve *curve,
                                    const size_t *wish_poles,
                                    const double *wish_distances,
                                    size_t wish_count,
                                    const struct fpt_weights_constraint *constraints,
                                    size_t constraint_count,
                                    const struct fpt_weights_options *options,
                                    struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_refine_surface(const struct fpt_surface *surface,
                                      const size_t *wish_poles,
                                      const double *wish_distances,
                                      size_t wish_count,
                                      const struct fpt_weights_constraint *constraints,
                                      size_t constraint_count,
                                      const struct fpt_weights_options *options,
                                      struct fpt_weights_report **out);
FPT_MUST_USE
fpt_status fpt_weights_report_pole_count(const struct fpt_weights_report *report,
                                         size_t *out_count);
FPT_MUST_USE
fpt_status fpt_weights_report_pole(const struct fpt_weights_report *report,
                                   size_t index,
                                   struct fpt_weights_pole *out);
FPT_MUST_USE
fpt_status fpt_weights_report_weights(const struct fpt_weights_report *report,
                                      size_t capacity,
                                      double *out_weights);
FPT_MUST_USE
fpt_status fpt_weights_report_constraint(const struct fpt_weights_report *report,
                                         size_t index,
                                         struct fpt_weights_outcome *out);
FPT_MUST_USE
fpt_status fpt_weights_report_summary(const struct fpt_weights_report *report,
                                      struct fpt_weights_summary *out);
FPT_MUST_USE
fpt_status fpt_weights_report_curve(const struct fpt_weights_report *report,
                                    struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_weights_report_surface(const struct fpt_weights_report *report,
                                      struct fpt_surface **out);
void fpt_weights_report_free(struct fpt_weights_report *report);
FPT_MUST_USE
fpt_status fpt_weights_move_point(const struct fpt_curve *curve,
                                  double u,
                                  size_t pole,
                                  double distance,
                                  double *out_weight);
FPT_MUST_USE
fpt_status fpt_weights_through_point(const struct fpt_curve *curve,
                                     size_t pole,
                                     const double *point,
                                     double tolerance,
                                     double *out_weight,
                                     struct fpt_foot_point *out_foot);
FPT_MUST_USE
fpt_status fpt_weights_conic(const double *poles,
                             const double *weights,
                             struct fpt_weights_conic_shape *out);
FPT_MUST_USE
fpt_status fpt_weights_of_rho(double rho,
                              double *out_weight);
FPT_MUST_USE
fpt_status fpt_weights_of_eccentricity(const double *poles,
                                       double eccentricity,
                                       double *out_weights,
                                       size_t *out_count);
FPT_MUST_USE
fpt_status fpt_weights_normalise(const double *weights,
                                 size_t count,
                                 uint32_t unit,
                                 double *out_weights);
FPT_MUST_USE
fpt_status fpt_weights_bound(const double *weights,
                             size_t count,
                             double ratio,
                             double *out_weights);
FPT_MUST_USE
fpt_status fpt_weights_standard_form(const struct fpt_curve *curve,
                                     struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_weights_positive_form(size_t degree,
                                     size_t pole_count,
                                     const double *knots,
                                     const double *poles,
                                     struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_refine(const struct fpt_curve *curve,
                            const double *values,
                            size_t value_count,
                            struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_remove_knot(const struct fpt_curve *curve,
                                 double u,
                                 size_t times,
                                 double *out_error,
                                 struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_simplify(const struct fpt_curve *curve,
                              double tolerance,
                              double *out_error,
                              struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_part(const struct fpt_curve *curve,
                          double start,
                          double end,
                          struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_clamp(const struct fpt_curve *curve,
                           struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_unclamp(const struct fpt_curve *curve,
                             double *out_error,
                             struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_periodic(const struct fpt_curve *curve,
                              double tolerance,
                              double *out_error,
                              struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_elevate(const struct fpt_curve *curve,
                             size_t by,
                             struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_reduce(const struct fpt_curve *curve,
                            double *out_error,
                            struct fpt_curve **out);
FPT_MUST_USE fpt_status fpt_curve_reverse(const struct fpt_curve *curve, struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_with_domain(const struct fpt_curve *curve,
                                 double start,
                                 double end,
                                 struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_reparametrise(const struct fpt_curve *curve,
                                   double speed,
                                   struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_affine(const struct fpt_curve *curve,
                            const double *matrix,
                            struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_projective(const struct fpt_curve *curve,
                                const double *matrix,
                                struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_derivative(const struct fpt_curve *curve,
                                struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_bezier_form(const struct fpt_curve *curve,
                                 struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_split(const struct fpt_curve *curve,
                           double u,
                           struct fpt_curve **out_before,
                           struct fpt_curve **out_behind);
FPT_MUST_USE
fpt_status fpt_curve_join(const struct fpt_curve *const *curves,
                          size_t count,
                          double tolerance,
                          double *out_error,
                          struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_make_compatible(const struct fpt_curve *const *curves,
                                     size_t count,
                                     struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_difference(const struct fpt_curve *curve,
                                const struct fpt_curve *other,
                                struct fpt_difference *out);
FPT_MUST_USE
fpt_status fpt_surface_refine(const struct fpt_surface *surface,
                              uint32_t direction,
                              const double *values,
                              size_t value_count,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_remove_knot(const struct fpt_surface *surface,
                                   uint32_t direction,
                                   double value,
                                   size_t times,
                                   double *out_error,
                                   struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_simplify(const struct fpt_surface *surface,
                                double tolerance,
                                double *out_error,
                                struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_part(const struct fpt_surface *surface,
                            const double *domain,
                            struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_clamp(const struct fpt_surface *surface,
                             struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_unclamp(const struct fpt_surface *surface,
                               uint32_t direction,
                               double *out_error,
                               struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_periodic(const struct fpt_surface *surface,
                                uint32_t direction,
                                double tolerance,
                                double *out_error,
                                struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_elevate(const struct fpt_surface *surface,
                               uint32_t direction,
                               size_t by,
                               struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_reduce(const struct fpt_surface *surface,
                              uint32_t direction,
                              double *out_error,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_reverse(const struct fpt_surface *surface,
                               uint32_t direction,
                               struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_swap(const struct fpt_surface *surface,
                            struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_with_domain(const struct fpt_surface *surface,
                                   const double *domain,
                                   struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_reparametrise(const struct fpt_surface *surface,
                                     uint32_t direction,
                                     double speed,
                                     struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_affine(const struct fpt_surface *surface,
                              const double *matrix,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_projective(const struct fpt_surface *surface,
                                  const double *matrix,
                                  struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_derivative(const struct fpt_surface *surface,
                                  uint32_t direction,
                                  struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_bezier_form(const struct fpt_surface *surface,
                                   struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_split(const struct fpt_surface *surface,
                             uint32_t direction,
                             double at,
                             struct fpt_surface **out_before,
                             struct fpt_surface **out_behind);
FPT_MUST_USE
fpt_status fpt_surface_isocurve(const struct fpt_surface *surface,
                                uint32_t direction,
                                double at,
                                struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_surface_join(const struct fpt_surface *const *surfaces,
                            size_t count,
                            uint32_t direction,
                            double tolerance,
                            double *out_error,
                            struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_make_compatible(const struct fpt_surface *const *surfaces,
                                       size_t count,
                                       struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_difference(const struct fpt_surface *surface,
                                  const struct fpt_surface *other,
                                  struct fpt_difference *out);
FPT_MUST_USE
fpt_status fpt_arc_length_new(const struct fpt_curve *curve,
                              double tolerance,
                              struct fpt_arc_length **out);
void fpt_arc_length_free(struct fpt_arc_length *length);
FPT_MUST_USE
fpt_status fpt_arc_length_total(const struct fpt_arc_length *length,
                                struct fpt_estimate *out);
FPT_MUST_USE
fpt_status fpt_arc_length_at(const struct fpt_arc_length *length,
                             const double *parameters,
                             size_t count,
                             struct fpt_estimate *out);
FPT_MUST_USE
fpt_status fpt_arc_length_parameters(const struct fpt_arc_length *length,
                                     const double *lengths,
                                     size_t count,
                                     struct fpt_estimate *out);
FPT_MUST_USE
fpt_status fpt_curve_frame(const struct fpt_curve *curve,
                           double u,
                           int32_t side,
                           struct fpt_curve_frame_record *out);
FPT_MUST_USE
fpt_status fpt_curve_continuity(const struct fpt_curve *curve,
                                double tolerance,
                                size_t capacity,
                                struct fpt_joint *out,
                                size_t *out_count);
FPT_MUST_USE
fpt_status fpt_curve_power(const struct fpt_curve *curve,
                           size_t capacity,
                           double *out,
                           size_t *out_count);
FPT_MUST_USE
fpt_status fpt_curve_from_power(size_t degree,
                                double start,
                                double end,
                                const double *coefficients,
                                struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_surface_continuity(const struct fpt_surface *surface,
                                  uint32_t direction,
                                  double tolerance,
                                  size_t capacity,
                                  struct fpt_knot_line *out,
                                  size_t *out_count);
FPT_MUST_USE
fpt_status fpt_surface_power(const struct fpt_surface *surface,
                             size_t capacity,
                             double *out,
                             size_t *out_count);
FPT_MUST_USE
fpt_status fpt_surface_from_power(size_t degree_u,
                                  size_t degree_v,
                                  const double *domain,
                                  const double *coefficients,
                                  struct fpt_surface **out);
void fpt_fit_options_init(struct fpt_fit_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_fit_parameters(const double *points,
                              size_t count,
                              uint32_t spacing,
                              double *out);
FPT_MUST_USE
fpt_status fpt_curve_interpolate(const double *points,
                                 size_t count,
                                 const double *parameters,
                                 const struct fpt_fit_options *options,
                                 struct fpt_curve **out);
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
FPT_MUST_USE
fpt_status fpt_curve_fit(const double *points,
                         size_t count,
                         const double *parameters,
                         const struct fpt_fit_options *options,
                         struct fpt_curve **out,
                         struct fpt_fit_result *result);
FPT_MUST_USE
fpt_status fpt_surface_interpolate(const double *points,
                                   size_t count_u,
                                   size_t count_v,
                                   const struct fpt_fit_options *options,
                                   struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_fit_grid(const double *points,
                                size_t count_u,
                                size_t count_v,
                                const struct fpt_fit_options *options,
                                struct fpt_surface **out,
                                struct fpt_fit_result *result);
FPT_MUST_USE
fpt_status fpt_surface_fit(const double *points,
                           size_t count,
                           const double *parameters,
                           const struct fpt_fit_options *options,
                           struct fpt_surface **out,
                           struct fpt_fit_result *result);
FPT_MUST_USE
fpt_status fpt_curve_line(const double *start,
                          const double *end,
                          struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_arc(const double *axes,
                         double radius_x,
                         double radius_y,
                         double start,
                         double end,
                         uint32_t form,
                         struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_arc_through(const double *points,
                                 struct fpt_curve **out);
FPT_MUST_USE fpt_status fpt_curve_conic(const double *poles, double rho, struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_parabola(const double *axes,
                              double focal,
                              double start,
                              double end,
                              struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_hyperbola(const double *axes,
                               double radius_x,
                               double radius_y,
                               double start,
                               double end,
                               struct fpt_curve **out);
void fpt_sweep_options_init(struct fpt_sweep_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_surface_quadric(uint32_t kind,
                               const double *axes,
                               const double *semi_axes,
                               const double *angles,
                               const double *profile,
                               uint32_t form,
                               struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_saddle(const double *axes,
                              double radius_x,
                              double radius_y,
                              const double *domain,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_plane(const double *axes,
                             const double *domain,
                             struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_torus(const double *axes,
                             double major,
                             double minor,
                             const double *angles_u,
                             const double *angles_v,
                             uint32_t form,
                             struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_ruled(const struct fpt_curve *first,
                             const struct fpt_curve *second,
                             struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_extruded(const struct fpt_curve *curve,
                                const double *direction,
                                struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_revolved(const struct fpt_curve *curve,
                                const double *origin,
                                const double *axis,
                                const double *angles,
                                uint32_t form,
                                struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_translational(const struct fpt_curve *curve,
                                     const struct fpt_curve *spine,
                                     struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_coons(const struct fpt_curve *const *borders,
                             struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_coons_bicubic(const struct fpt_curve *const *borders,
                                     const struct fpt_curve *const *slopes,
                                     struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_ferguson(const double *points,
                                const double *slopes_u,
                                const double *slopes_v,
                                const double *twists,
                                struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_gordon(const struct fpt_curve *const *curves_u,
                              const double *parameters_v,
                              size_t count_u,
                              const struct fpt_curve *const *curves_v,
                              const double *parameters_u,
                              size_t count_v,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_skinned(const struct fpt_curve *const *sections,
                               size_t count,
                               size_t degree,
                               const double *parameters,
                               struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_swept(const struct fpt_curve *profile,
                             const struct fpt_curve *spine,
                             const struct fpt_sweep_options *options,
                             struct fpt_surface **out,
                             double *error,
                             double *holonomy);
FPT_MUST_USE
fpt_status fpt_curve_offset(const struct fpt_curve *curve,
                            double distance,
                            const double *plane_normal,
                            struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_curve_offset_fit(const struct fpt_curve *curve,
                                double distance,
                                const double *plane_normal,
                                size_t degree,
                                double tolerance,
                                struct fpt_curve **out,
                                double *measured,
                                double *proven);
FPT_MUST_USE
fpt_status fpt_surface_offset(const struct fpt_surface *surface,
                              double distance,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_surface_offset_fit(const struct fpt_surface *surface,
                                  double distance,
                                  size_t degree_u,
                                  size_t degree_v,
                                  double tolerance,
                                  struct fpt_surface **out,
                                  double *measured,
                                  double *proven);
FPT_MUST_USE
fpt_status fpt_relation_linear(const double *from,
                               const double *to,
                               struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_circle(uint32_t arcs,
                               double sweep,
                               const double *from,
                               const double *to,
                               struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_through(const double *places,
                                const double *values,
                                size_t count,
                                struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_piecewise(const struct fpt_relation *const *pieces,
                                  size_t count,
                                  struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_from_callback(const struct fpt_relation_callback *callback,
                                      struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_inverse(const struct fpt_relation *relation,
                                struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_then(const struct fpt_relation *first,
                             const struct fpt_relation *next,
                             struct fpt_relation **out);
FPT_MUST_USE
fpt_status fpt_relation_domain(const struct fpt_relation *relation,
                               double *out_from,
                               double *out_to);
FPT_MUST_USE
fpt_status fpt_relation_apply(const struct fpt_relation *relation,
                              const double *places,
                              size_t count,
                              double *out);
void fpt_relation_free(struct fpt_relation *relation);
FPT_MUST_USE
fpt_status fpt_transform_new(const struct fpt_relation *u,
                             const struct fpt_relation *v,
                             uint32_t swap,
                             struct fpt_transform **out);
FPT_MUST_USE
fpt_status fpt_transform_inverse(const struct fpt_transform *transform,
                                 struct fpt_transform **out);
FPT_MUST_USE
fpt_status fpt_transform_then(const struct fpt_transform *first,
                              const struct fpt_transform *next,
                              struct fpt_transform **out);
FPT_MUST_USE
fpt_status fpt_transform_domain(const struct fpt_transform *transform,
                                double *out_domain,
                                double *out_image,
                                int32_t *out_keeps_direction);
FPT_MUST_USE
fpt_status fpt_transform_apply(const struct fpt_transform *transform,
                               const double *uv,
                               size_t count,
                               double *out);
void fpt_transform_free(struct fpt_transform *transform);
FPT_MUST_USE
fpt_status fpt_curve_arc_by_angle(const double *center,
                                  const double *first,
                                  const double *second,
                                  const double *angles,
                                  struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_support_new(const struct fpt_surface *surface,
                           struct fpt_support **out);
FPT_MUST_USE
fpt_status fpt_support_elementary(const struct fpt_elementary_data *data,
                                  struct fpt_support **out);
FPT_MUST_USE fpt_status fpt_support_domain(const struct fpt_support *support, double *out);
FPT_MUST_USE
fpt_status fpt_support_evaluate(const struct fpt_support *support,
                                const double *uv,
                                size_t count,
                                double *out);
FPT_MUST_USE
fpt_status fpt_support_spline(const struct fpt_support *support,
                              const uint32_t *arcs,
                              struct fpt_surface **out);
FPT_MUST_USE
fpt_status fpt_support_spline_transform(const struct fpt_support *support,
                                        const uint32_t *arcs,
                                        struct fpt_transform **out);
FPT_MUST_USE
fpt_status fpt_support_match(const struct fpt_support *from,
                             const struct fpt_support *to,
                             double tolerance,
                             struct fpt_transform **out);
FPT_MUST_USE
fpt_status fpt_support_match_many(const struct fpt_support *from,
                                  const struct fpt_support *to,
                                  double tolerance,
                                  const double *uv,
                                  size_t count,
                                  uint32_t threads,
                                  struct fpt_foot_point *out);
void fpt_support_free(struct fpt_support *support);
FPT_MUST_USE
fpt_status fpt_trim_new(const struct fpt_trim_data *data,
                        struct fpt_trim **out);
FPT_MUST_USE
fpt_status fpt_trim_whole(const struct fpt_support *support,
                          struct fpt_trim **out);
void fpt_trim_free(struct fpt_trim *trim);
FPT_MUST_USE fpt_status fpt_trim_support(const struct fpt_trim *trim, struct fpt_support **out);
FPT_MUST_USE
fpt_status fpt_trim_counts(const struct fpt_trim *trim,
                           size_t *out_edge_count,
                           size_t *out_loop_count,
                           uint32_t *out_flipped);
FPT_MUST_USE
fpt_status fpt_trim_loop(const struct fpt_trim *trim,
                         size_t index,
                         uint32_t *out_is_inner,
                         size_t *out_coedge_count);
FPT_MUST_USE
fpt_status fpt_trim_coedge(const struct fpt_trim *trim,
                           size_t loop_index,
                           size_t index,
                           struct fpt_coedge_data *out,
                           double *out_domain);
FPT_MUST_USE
fpt_status fpt_trim_coedge_points(const struct fpt_trim *trim,
                                  size_t loop_index,
                                  size_t index,
                                  size_t capacity,
                                  double *out_points,
                                  double *out_parameters);
FPT_MUST_USE
fpt_status fpt_trim_coedge_curve(const struct fpt_trim *trim,
                                 size_t loop_index,
                                 size_t index,
                                 struct fpt_curve **out);
FPT_MUST_USE
fpt_status fpt_trim_coedge_evaluate(const struct fpt_trim *trim,
                                    size_t loop_index,
                                    size_t index,
                                    const double *shares,
                                    size_t count,
                                    double *out_uv,
                                    double *out_points,
                                    double *out_edge);
FPT_MUST_USE
fpt_status fpt_trim_edge(const struct fpt_trim *trim,
                         size_t index,
                         struct fpt_curve **out_curve,
                         double *out_point,
                         uint32_t *out_reversed);
void fpt_change_options_init(struct fpt_change_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_trim_change(const struct fpt_trim *trim,
                           const struct fpt_transform *transform,
                           const struct fpt_support *support,
                           const struct fpt_change_options *options,
                           struct fpt_trim **out,
                           struct fpt_change_summary *out_summary);
FPT_MUST_USE
fpt_status fpt_trim_reparametrise(const struct fpt_trim *trim,
                                  const struct fpt_transform *transform,
                                  const struct fpt_change_options *options,
                                  struct fpt_trim **out,
                                  struct fpt_change_summary *out_summary);
FPT_MUST_USE
fpt_status fpt_trim_to_nurbs(const struct fpt_trim *trim,
                             const uint32_t *arcs,
                             const struct fpt_change_options *options,
                             struct fpt_trim **out,
                             struct fpt_change_summary *out_summary);
FPT_MUST_USE
fpt_status fpt_trim_to_elementary(const struct fpt_trim *trim,
                                  const struct fpt_support *support,
                                  const uint32_t *arcs,
                                  const struct fpt_change_options *options,
                                  struct fpt_trim **out,
                                  struct fpt_change_summary *out_summary);
FPT_MUST_USE
fpt_status fpt_trim_follow(const struct fpt_trim *trim,
                           const struct fpt_support *support,
                           const struct fpt_change_options *options,
                           struct fpt_trim **out,
                           struct fpt_change_summary *out_summary);
FPT_MUST_USE
fpt_status fpt_trim_merge(const struct fpt_trim *first,
                          const struct fpt_trim *second,
                          uint32_t direction,
                          const struct fpt_support *support,
                          const struct fpt_change_options *options,
                          struct fpt_trim **out);
FPT_MUST_USE
fpt_status fpt_trim_report_new(const struct fpt_trim *trim,
                               double tolerance,
                               struct fpt_trim_report **out);
FPT_MUST_USE
fpt_status fpt_trim_report_summary(const struct fpt_trim_report *report,
                                   struct fpt_trim_summary *out);
FPT_MUST_USE
fpt_status fpt_trim_report_get(const struct fpt_trim_report *report,
                               size_t index,
                               struct fpt_trim_finding *out);
void fpt_trim_report_free(struct fpt_trim_report *report);
FPT_MUST_USE
fpt_status fpt_trim_to_json(const struct fpt_trim *trim,
                            size_t capacity,
                            char *out,
                            size_t *out_length);
FPT_MUST_USE
fpt_status fpt_trim_from_json(const char *text,
                              size_t length,
                              struct fpt_trim **out);
FPT_MUST_USE
fpt_status fpt_trim_picture(const struct fpt_trim *const *trims,
                            const char *const *titles,
                            size_t count,
                            const double *view,
                            size_t capacity,
                            char *out,
                            size_t *out_length);
void fpt_pull_options_init(struct fpt_pull_options *options, size_t struct_size);
void fpt_lift_options_init(struct fpt_lift_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_pcurve_pull(const struct fpt_surface *surface,
                           const struct fpt_curve *edge,
                           const struct fpt_pull_options *options,
                           struct fpt_pcurve_set **out);
FPT_MUST_USE fpt_status fpt_pcurve_set_count(const struct fpt_pcurve_set *set, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_pcurve_set_get(const struct fpt_pcurve_set *set,
                              size_t index,
                              struct fpt_curve **out_pcurve,
                              struct fpt_deviation *out_deviation);
void fpt_pcurve_set_free(struct fpt_pcurve_set *set);
FPT_MUST_USE
fpt_status fpt_pcurve_lift(const struct fpt_surface *surface,
                           const struct fpt_curve *pcurve,
                           const struct fpt_lift_options *options,
                           struct fpt_curve **out_curve,
                           struct fpt_deviation *out_deviation);
FPT_MUST_USE
fpt_status fpt_pcurve_deviation(const struct fpt_surface *surface,
                                const struct fpt_curve *pcurve,
                                const struct fpt_curve *curve,
                                struct fpt_deviation *out);
void fpt_face_options_init(struct fpt_face_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_face_new(const struct fpt_face_data *data,
                        const struct fpt_face_options *options,
                        struct fpt_face **out);
FPT_MUST_USE
fpt_status fpt_face_of_trim(const struct fpt_trim *trim,
                            const struct fpt_face_options *options,
                            struct fpt_face **out);
void fpt_face_free(struct fpt_face *face);
FPT_MUST_USE
fpt_status fpt_face_classify(const struct fpt_face *face,
                             const double *uv,
                             size_t count,
                             const struct fpt_query_options *options,
                             struct fpt_face_place *out);
FPT_MUST_USE
fpt_status fpt_face_closest(const struct fpt_face *face,
                            const double *points,
                            size_t count,
                            const struct fpt_query_options *options,
                            struct fpt_foot_point *out,
                            struct fpt_face_place *out_places);
FPT_MUST_USE
fpt_status fpt_face_preimage(const struct fpt_face *face,
                             const double *point,
                             double tolerance,
                             const struct fpt_query_options *options,
                             struct fpt_foot_set **out);
void fpt_intersect_surfaces_options_init(struct fpt_intersect_surfaces_options *options,
                                         size_t struct_size);
FPT_MUST_USE
fpt_status fpt_intersect_surfaces(const struct fpt_surface *a,
                                  const struct fpt_surface *b,
                                  const struct fpt_intersect_surfaces_options *options,
                                  struct fpt_surface_intersection **out);
FPT_MUST_USE
fpt_status fpt_intersect_trims(const struct fpt_trim *a,
                               const struct fpt_trim *b,
                               const struct fpt_intersect_surfaces_options *options,
                               struct fpt_surface_intersection **out);
FPT_MUST_USE
fpt_status fpt_surface_intersection_summary(const struct fpt_surface_intersection *intersection,
                                            struct fpt_intersection_summary *out);
FPT_MUST_USE
fpt_status fpt_surface_intersection_branch(const struct fpt_surface_intersection *intersection,
                                           size_t index,
                                           struct fpt_intersection_branch *out);
FPT_MUST_USE
fpt_status fpt_surface_intersection_points(const struct fpt_surface_intersection *intersection,
                                           size_t index,
                                           size_t capacity,
                                           struct fpt_intersection_point *out);
FPT_MUST_USE
fpt_status fpt_surface_intersection_contact(const struct fpt_surface_intersection *intersection,
                                            size_t index,
                                            struct fpt_intersection_contact *out);
FPT_MUST_USE
fpt_status fpt_surface_intersection_overlap(const struct fpt_surface_intersection *intersection,
                                            size_t index,
                                            double *out_range);
FPT_MUST_USE
fpt_status fpt_surface_intersection_undecided(const struct fpt_surface_intersection *intersection,
                                              size_t index,
                                              double *out_range);
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
FPT_MUST_USE
fpt_status fpt_surface_intersection_split(const struct fpt_surface_intersection *intersection,
                                          const struct fpt_trim *trim,
                                          uint32_t which,
                                          double tolerance,
                                          const struct fpt_intersect_surfaces_options *options,
                                          size_t capacity,
                                          struct fpt_trim **out_trims,
                                          size_t *out_count);
void fpt_surface_intersection_free(struct fpt_surface_intersection *intersection);
FPT_MUST_USE
fpt_status fpt_intersect_correct(const struct fpt_surface *a,
                                 const struct fpt_surface *b,
                                 const double *uvst,
                                 const struct fpt_intersect_surfaces_options *options,
                                 struct fpt_intersection_point *out,
                                 double *out_gap,
                                 uint32_t *out_steps);
FPT_MUST_USE
fpt_status fpt_intersect_march(const struct fpt_surface *a,
                               const struct fpt_surface *b,
                               const double *uvst,
                               double step,
                               const struct fpt_intersect_surfaces_options *options,
                               struct fpt_surface_intersection **out);
FPT_MUST_USE
fpt_status fpt_intersect_bisect(const struct fpt_surface *a,
                                const struct fpt_surface *b,
                                const double *uvst,
                                size_t count,
                                const struct fpt_intersect_surfaces_options *options,
                                struct fpt_surface_intersection **out);
void fpt_inspect_options_init(struct fpt_inspect_options *options, size_t struct_size);
void fpt_inspect_picture_options_init(struct fpt_inspect_picture_options *options,
                                      size_t struct_size);
void fpt_fair_options_init(struct fpt_fair_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_fair_curve(const struct fpt_curve *curve,
                          const struct fpt_fair_options *options,
                          struct fpt_fair_report **out);
FPT_MUST_USE
fpt_status fpt_fair_surface(const struct fpt_surface *surface,
                            const struct fpt_fair_options *options,
                            struct fpt_fair_report **out);
FPT_MUST_USE
fpt_status fpt_fair_report_summary(const struct fpt_fair_report *report,
                                   struct fpt_fair_summary *out);
FPT_MUST_USE
fpt_status fpt_fair_report_energies(const struct fpt_fair_report *report,
                                    size_t capacity,
                                    double *out_energies);
FPT_MUST_USE
fpt_status fpt_fair_report_curve(const struct fpt_fair_report *report,
                                 struct fpt_curve **out_curve);
FPT_MUST_USE
fpt_status fpt_fair_report_surface(const struct fpt_fair_report *report,
                                   struct fpt_surface **out_surface);
void fpt_fair_report_free(struct fpt_fair_report *report);
FPT_MUST_USE
fpt_status fpt_inspect_curve_range(const struct fpt_curve *curve,
                                   const struct fpt_inspect_options *options,
                                   struct fpt_inspect_range *out);
FPT_MUST_USE
fpt_status fpt_inspect_surface_range(const struct fpt_surface *surface,
                                     uint32_t quantity,
                                     const struct fpt_inspect_options *options,
                                     struct fpt_inspect_range *out);
FPT_MUST_USE
fpt_status fpt_inspect_surface_range_places(const struct fpt_surface *surface,
                                            uint32_t quantity,
                                            const struct fpt_inspect_options *options,
                                            struct fpt_inspect_range *out,
                                            struct fpt_inspect_set **places);
FPT_MUST_USE
fpt_status fpt_inspect_comb(const struct fpt_curve *curve,
                            const double *parameters,
                            size_t count,
                            struct fpt_inspect_tooth *out);
FPT_MUST_USE
fpt_status fpt_inspect_curvatures(const struct fpt_surface *surface,
                                  const double *parameters,
                                  size_t count,
                                  struct fpt_inspect_curvature *out);
FPT_MUST_USE
fpt_status fpt_inspect_monotone_pieces(const struct fpt_curve *curve,
                                       struct fpt_inspect_set **out);
FPT_MUST_USE
fpt_status fpt_inspect_inflections(const struct fpt_curve *curve,
                                   const double *normal,
                                   struct fpt_inspect_set **out);
FPT_MUST_USE
fpt_status fpt_inspect_umbilics(const struct fpt_surface *surface,
                                const struct fpt_inspect_options *options,
                                struct fpt_inspect_set **out);
FPT_MUST_USE fpt_status fpt_inspect_set_count(const struct fpt_inspect_set *set, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_inspect_set_get(const struct fpt_inspect_set *set,
                               size_t index,
                               struct fpt_inspect_place *out);
void fpt_inspect_set_free(struct fpt_inspect_set *set);
FPT_MUST_USE
fpt_status fpt_inspect_hausdorff(const struct fpt_curve *curve_a,
                                 const struct fpt_surface *surface_a,
                                 const struct fpt_curve *curve_b,
                                 const struct fpt_surface *surface_b,
                                 const struct fpt_inspect_options *options,
                                 struct fpt_inspect_distance *out_forward,
                                 struct fpt_inspect_distance *out_backward);
FPT_MUST_USE
fpt_status fpt_inspect_border(const struct fpt_surface *surface_a,
                              uint32_t side_a,
                              const struct fpt_surface *surface_b,
                              uint32_t side_b,
                              const struct fpt_inspect_options *options,
                              struct fpt_inspect_continuity *out);
FPT_MUST_USE
fpt_status fpt_inspect_picture(const struct fpt_surface *surface,
                               const struct fpt_inspect_picture_options *options,
                               size_t capacity,
                               uint8_t *out_pixels,
                               double *out_range);
void fpt_hit_options_init(struct fpt_hit_options *options, size_t struct_size);
FPT_MUST_USE
fpt_status fpt_intersect_curves(const struct fpt_curve *curve,
                                const struct fpt_curve *other,
                                const struct fpt_hit_options *options,
                                struct fpt_curve_hits **out);
FPT_MUST_USE
fpt_status fpt_intersect_surface_curve(const struct fpt_surface *surface,
                                       const struct fpt_curve *curve,
                                       const struct fpt_hit_options *options,
                                       struct fpt_curve_hits **out);
FPT_MUST_USE
fpt_status fpt_intersect_curve_quadric(const struct fpt_curve *curve,
                                       const struct fpt_quadric *quadric,
                                       const struct fpt_hit_options *options,
                                       struct fpt_curve_hits **out);
FPT_MUST_USE fpt_status fpt_curve_hits_count(const struct fpt_curve_hits *hits, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_curve_hits_get(const struct fpt_curve_hits *hits,
                              size_t index,
                              struct fpt_curve_hit *out);
FPT_MUST_USE
fpt_status fpt_curve_hits_undecided_count(const struct fpt_curve_hits *hits,
                                          size_t *out_count);
FPT_MUST_USE
fpt_status fpt_curve_hits_undecided_get(const struct fpt_curve_hits *hits,
                                        size_t index,
                                        double *out_uvw);
void fpt_curve_hits_free(struct fpt_curve_hits *hits);
FPT_MUST_USE
fpt_status fpt_intersect_surface_quadrics(const struct fpt_surface *surface,
                                          const struct fpt_quadric *quadrics,
                                          size_t count,
                                          const struct fpt_hit_options *options,
                                          struct fpt_sections **out);
FPT_MUST_USE
fpt_status fpt_sections_counts(const struct fpt_sections *sections,
                               size_t section,
                               size_t *out_counts);
FPT_MUST_USE
fpt_status fpt_sections_branch_get(const struct fpt_sections *sections,
                                   size_t section,
                                   size_t index,
                                   struct fpt_branch *out);
FPT_MUST_USE
fpt_status fpt_sections_branch_points(const struct fpt_sections *sections,
                                      size_t section,
                                      size_t index,
                                      size_t capacity,
                                      double *out);
FPT_MUST_USE
fpt_status fpt_sections_point_get(const struct fpt_sections *sections,
                                  size_t section,
                                  size_t index,
                                  struct fpt_section_point *out);
FPT_MUST_USE
fpt_status fpt_sections_region_get(const struct fpt_sections *sections,
                                   size_t section,
                                   size_t index,
                                   struct fpt_section_region *out);
void fpt_sections_free(struct fpt_sections *sections);
FPT_MUST_USE
fpt_status fpt_intersect_quadrics(const struct fpt_quadric *first,
                                  const struct fpt_quadric *second,
                                  double tolerance,
                                  struct fpt_conic *out,
                                  size_t *out_count);
FPT_MUST_USE
fpt_status fpt_caster_new(const struct fpt_surface *surface,
                          const struct fpt_hit_options *options,
                          struct fpt_caster **out);
void fpt_caster_free(struct fpt_caster *caster);
FPT_MUST_USE
fpt_status fpt_caster_first(const struct fpt_caster *caster,
                            const double *origins,
                            const double *directions,
                            size_t count,
                            const double *reach,
                            const struct fpt_hit_options *options,
                            struct fpt_ray_hit *out);
FPT_MUST_USE
fpt_status fpt_caster_nearest(const struct fpt_caster *caster,
                              const double *origins,
                              const double *directions,
                              size_t count,
                              const double *reach,
                              const struct fpt_hit_options *options,
                              struct fpt_ray_hit *out);
FPT_MUST_USE
fpt_status fpt_caster_all(const struct fpt_caster *caster,
                          const double *origins,
                          const double *directions,
                          size_t count,
                          const double *reach,
                          const struct fpt_hit_options *options,
                          struct fpt_ray_hits **out);
FPT_MUST_USE fpt_status fpt_ray_hits_count(const struct fpt_ray_hits *hits, size_t *out_count);
FPT_MUST_USE
fpt_status fpt_ray_hits_get(const struct fpt_ray_hits *hits,
                            size_t capacity,
                            struct fpt_ray_hit *out);
FPT_MUST_USE
fpt_status fpt_ray_hits_starts(const struct fpt_ray_hits *hits,
                               size_t capacity,
                               size_t *out);
FPT_MUST_USE
fpt_status fpt_ray_hits_flags(const struct fpt_ray_hits *hits,
                              size_t capacity,
                              uint32_t *out);
void fpt_ray_hits_free(struct fpt_ray_hits *hits);
#ifdef __cplusplus
}
#endif
#endif
