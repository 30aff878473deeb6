/* Surface-surface intersection: branches, contacts, overlaps; what is refused; budget, stop, progress; curves of a branch. */
#include "samples.h"

static fpt_surface *plane_at(double z) {
    static const double knots[] = {0, 0, 1, 1};
    double poles[12] = {-9, -9, 0, -9, 9, 0, 9, -9, 0, 9, 9, 0};
    for (int i = 0; i < 4; i++) poles[3 * i + 2] = z;
    return make_surface(surface_data(1, 1, 2, 2, knots, knots, poles, NULL));
}

static fpt_intersection_summary summary_of(const fpt_surface_intersection *found) {
    fpt_intersection_summary out;
    memset(&out, 0, sizeof out);
    CHECK_OK(fpt_surface_intersection_summary(found, &out));
    return out;
}

static int stop_now(void *user) { return *(int *)user; }

/* Says stop at the question whose number user holds, counted down. */
static int stop_later(void *user) { return --*(long *)user < 0; }

/* The cone with apex (1,0,3) over the circle of radius 2: at height 1.5 a circle of radius 1, over the cone's seam. */
static void a_cone_is_cut_in_a_circle_and_its_apex_is_a_contact(void) {
    fpt_surface *cone = make_surface(cone_surface()), *plane = plane_at(1.5);
    fpt_surface_intersection *found = NULL;
    CHECK_OK(fpt_intersect_surfaces(cone, plane, NULL, &found));
    fpt_intersection_summary s = summary_of(found);
    CHECK(s.branch_count == 1 && s.contact_count == 0 && s.overlap_count == 0 && s.undecided_count == 0);
    CHECK(s.is_proven == 1 && s.is_exhausted == 0 && s.pairs > 0);
    fpt_intersection_branch branch;
    CHECK_OK(fpt_surface_intersection_branch(found, 0, &branch));
    CHECK(branch.is_closed == 1 && branch.is_tangential == 0 && branch.point_count > 8 && branch.gap < 1e-13);
    CHECK(branch.chord > 0 && branch.chord <= 8e-3 && branch.bounds_overlap == 0);
    CHECK(branch.end_kind[0] == FPT_BRANCH_END_CLOSED && branch.end_kind[1] == FPT_BRANCH_END_CLOSED);
    fpt_intersection_point *points = calloc(branch.point_count, sizeof *points);
    CHECK_OK(fpt_surface_intersection_points(found, 0, branch.point_count, points));
    for (size_t i = 0; i < branch.point_count; i++) {
        CHECK_NEAR(points[i].point[2], 1.5, 1e-14);
        CHECK_NEAR(hypot(points[i].point[0] - 1, points[i].point[1]), 1, 1e-13);
        double on[3];
        CHECK_OK(fpt_surface_evaluate(cone, points[i].uv[0], points[i].uv[1], 0, on));
        CHECK_NEAR(on[0], points[i].point[0], 1e-14);
        CHECK_OK(fpt_surface_evaluate(plane, points[i].st[0], points[i].st[1], 0, on));
        CHECK_NEAR(on[1], points[i].point[1], 1e-14);
    }
    CHECK(fpt_surface_intersection_points(found, 0, branch.point_count - 1, points) == FPT_INVALID_ARGUMENT);
    CHECK(strstr(fpt_last_error(), "capacity") != NULL);

    size_t count = 0;
    fpt_curve *curves[3] = {NULL, NULL, NULL};
    double error = -1, at[3];
    CHECK_OK(fpt_surface_intersection_curves(found, cone, plane, 0, 1e-6, 0, NULL, &count, curves, &error));
    CHECK(count >= 1 && error >= 0 && error < 1e-6);
    for (int k = 0; k < 3; k++) {
        double ends[2];
        CHECK_OK(fpt_curve_domain(curves[k], ends));
        CHECK_OK(fpt_curve_evaluate(curves[k], 0.5 * (ends[0] + ends[1]), 0, at));
        CHECK(k == 0 ? fabs(at[2] - 1.5) < 1e-6 : at[2] == 0);
        fpt_curve_free(curves[k]);
    }
    CHECK(fpt_surface_intersection_curves(found, cone, plane, 0, 0, 0, NULL, &count, curves, &error) == FPT_INVALID_ARGUMENT);
    CHECK(fpt_surface_intersection_curves(found, cone, plane, 0, 1e-6, 99, NULL, &count, curves, &error) == FPT_INVALID_ARGUMENT);
    long questions = 1;
    fpt_intersect_surfaces_options asking;
    fpt_intersect_surfaces_options_init(&asking, sizeof asking);
    asking.should_stop = stop_later;
    asking.user = &questions;
    curves[0] = NULL;
    CHECK(fpt_surface_intersection_curves(found, cone, plane, 0, 1e-9, 0, &asking, &count, curves, &error) == FPT_CANCELLED);
    CHECK(curves[0] == NULL && questions == -1);
    /* Every question of the intersection itself, also those after the last pair of parts: what was found by then, and the rest undecided. */
    fpt_surface_intersection *stopped = NULL;
    long asked = 0;
    for (fpt_status status = FPT_CANCELLED; status == FPT_CANCELLED; asked++) {
        fpt_surface_intersection_free(stopped);
        stopped = NULL;
        questions = asked;
        status = fpt_intersect_surfaces(cone, plane, &asking, &stopped);
        CHECK(stopped != NULL && (status == FPT_CANCELLED || status == FPT_OK));
        s = summary_of(stopped);
        CHECK(s.is_stopped == (status == FPT_CANCELLED) && s.is_exhausted == 0 && s.reserved == 0);
        CHECK(s.undecided_count > 0 || (s.branch_count == 1 && s.is_proven == 1));
        CHECK(status == FPT_OK || strstr(fpt_last_error(), "should_stop") != NULL);
    }
    CHECK(asked > (long)(summary_of(stopped).pairs / 256) + 2);
    fpt_surface_intersection_free(stopped);
    CHECK(fpt_surface_intersection_curves(found, cone, NULL, 0, 1e-6, 0, NULL, &count, curves, &error) == FPT_NULL_ARGUMENT);
    fpt_surface_intersection_free(found);
    fpt_surface_free(plane);

    plane = plane_at(3);
    CHECK_OK(fpt_intersect_surfaces(cone, plane, NULL, &found));
    s = summary_of(found);
    CHECK(s.branch_count == 0 && s.contact_count == 1 && s.is_proven == 0);
    fpt_intersection_contact contact;
    CHECK_OK(fpt_surface_intersection_contact(found, 0, &contact));
    CHECK(contact.kind == FPT_CONTACT_TIP && contact.gap < 1e-13 && contact.radius < 1e-5);
    CHECK_NEAR(contact.place.point[0], 1, 1e-12);
    CHECK(fpt_surface_intersection_contact(found, 1, &contact) == FPT_INVALID_ARGUMENT);
    CHECK(fpt_surface_intersection_branch(found, 0, &branch) == FPT_INVALID_ARGUMENT);
    fpt_surface_intersection_free(found);
    free(points);
    fpt_surface_free(plane);
    fpt_surface_free(cone);
}

static void coincident_planes_overlap(void) {
    fpt_surface *a = plane_at(1), *b = plane_at(1);
    fpt_surface_intersection *found = NULL;
    double range[8];
    CHECK_OK(fpt_intersect_surfaces(a, b, NULL, &found));
    CHECK(summary_of(found).overlap_count >= 1 && summary_of(found).branch_count == 1);
    fpt_intersection_branch border;
    CHECK_OK(fpt_surface_intersection_branch(found, 0, &border));
    CHECK(border.bounds_overlap == 1 && border.is_closed == 1 && border.is_tangential == 1 && isinf(border.chord));
    CHECK_OK(fpt_surface_intersection_overlap(found, 0, range));
    CHECK(range[0] == 0 && range[1] == 1 && range[6] == 0 && range[7] == 1);
    CHECK(fpt_surface_intersection_undecided(found, 0, range) == FPT_INVALID_ARGUMENT);
    fpt_surface_intersection_free(found);
    fpt_surface_free(a);
    fpt_surface_free(b);
}

/* A tube of radius 1 about z through the plane z = 0, of which a triangle around the corner (1,1) is left: an arc with two ends on trims. */
static void faces_are_cut_off_at_their_trims_and_split(void) {
    fpt_surface *plane = plane_at(0);
    fpt_support *flat = NULL, *round = NULL;
    fpt_trim *tube = NULL, *triangle = NULL, *parts[4] = {NULL, NULL, NULL, NULL};
    fpt_surface_intersection *found = NULL;
    fpt_elementary_data data;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.kind = FPT_ELEMENTARY_CYLINDER;
    data.domain[1] = 6.283185307179586;
    data.domain[2] = -1;
    data.domain[3] = 1;
    data.x[0] = data.y[1] = data.z[2] = data.first = 1;
    CHECK_OK(fpt_support_elementary(&data, &round));
    CHECK_OK(fpt_trim_whole(round, &tube));
    CHECK_OK(fpt_support_new(plane, &flat));
    /* u, v run over [-9, 9]: the triangle (0.1,0.1), (5,0.1), (0.1,5). */
    const double corners[] = {9.1 / 18, 9.1 / 18, 14.0 / 18, 9.1 / 18, 9.1 / 18, 14.0 / 18, 9.1 / 18, 9.1 / 18};
    fpt_coedge_data coedge;
    memset(&coedge, 0, sizeof coedge);
    coedge.kind = FPT_PCURVE_POLYLINE;
    coedge.edge = SIZE_MAX;
    coedge.points = corners;
    coedge.point_count = 4;
    fpt_loop_data loop = {0, 0, &coedge, 1};
    fpt_trim_data made;
    memset(&made, 0, sizeof made);
    made.struct_size = sizeof made;
    made.support = flat;
    made.loops = &loop;
    made.loop_count = 1;
    CHECK_OK(fpt_trim_new(&made, &triangle));
    CHECK_OK(fpt_intersect_trims(tube, triangle, NULL, &found));
    fpt_intersection_summary s = summary_of(found);
    CHECK(s.branch_count == 1 && s.is_proven == 1 && s.undecided_count == 0);
    fpt_intersection_branch branch;
    CHECK_OK(fpt_surface_intersection_branch(found, 0, &branch));
    CHECK(branch.end_kind[0] == FPT_BRANCH_END_TRIM && branch.end_kind[1] == FPT_BRANCH_END_TRIM);
    CHECK(branch.end_index[0] == 1 && branch.end_index[1] == 1);
    fpt_intersection_point *points = calloc(branch.point_count, sizeof *points);
    CHECK_OK(fpt_surface_intersection_points(found, 0, branch.point_count, points));
    for (size_t i = 0; i < branch.point_count; i++) {
        CHECK_NEAR(points[i].uv[0], atan2(points[i].point[1], points[i].point[0]), 1e-12);
        CHECK_NEAR(points[i].uv[1], 0, 1e-12);
        CHECK(points[i].point[0] >= 0.1 - 1e-11 && points[i].point[1] >= 0.1 - 1e-11);
    }
    double low = fmin(points[0].point[0], points[branch.point_count - 1].point[0]);
    CHECK_NEAR(low, 0.1, 1e-11);
    free(points);
    size_t count = 0;
    CHECK_OK(fpt_surface_intersection_split(found, triangle, 1, 1e-6, NULL, 4, parts, &count));
    CHECK(count == 2);
    for (size_t i = 0; i < count; i++) fpt_trim_free(parts[i]);
    /* The arc ends inside the tube: it cuts nothing there. */
    CHECK_OK(fpt_surface_intersection_split(found, tube, 0, 1e-6, NULL, 4, parts, &count));
    CHECK(count == 1);
    fpt_trim_free(parts[0]);
    int stop = 1;
    fpt_intersect_surfaces_options asking;
    fpt_intersect_surfaces_options_init(&asking, sizeof asking);
    asking.should_stop = stop_now;
    asking.user = &stop;
    CHECK(fpt_surface_intersection_split(found, triangle, 1, 1e-6, &asking, 4, parts, &count) == FPT_CANCELLED);
    stop = 0;
    CHECK_OK(fpt_surface_intersection_split(found, triangle, 1, 1e-6, &asking, 4, parts, &count));
    CHECK(count == 2);
    for (size_t i = 0; i < count; i++) fpt_trim_free(parts[i]);
    CHECK_ERROR(fpt_surface_intersection_split(found, triangle, 1, 1e-6, NULL, 1, parts, &count), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_ERROR(fpt_surface_intersection_split(found, triangle, 2, 1e-6, NULL, 4, parts, &count), FPT_INVALID_ARGUMENT, "which");
    CHECK_ERROR(fpt_surface_intersection_split(found, triangle, 1, 0, NULL, 4, parts, &count), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_surface_intersection_split(found, NULL, 1, 1e-6, NULL, 4, parts, &count), FPT_NULL_ARGUMENT, "trim");
    CHECK_ERROR(fpt_surface_intersection_split(NULL, tube, 0, 1e-6, NULL, 4, parts, &count), FPT_NULL_ARGUMENT, "intersection");
    fpt_surface_intersection_free(found);
    found = NULL;
    CHECK_ERROR(fpt_intersect_trims(NULL, triangle, NULL, &found), FPT_NULL_ARGUMENT, "a");
    CHECK_ERROR(fpt_intersect_trims(tube, NULL, NULL, &found), FPT_NULL_ARGUMENT, "b");
    CHECK(found == NULL);
    fpt_intersect_surfaces_options options;
    fpt_intersect_surfaces_options_init(&options, sizeof options);
    options.budget = 3;
    CHECK(fpt_intersect_trims(tube, triangle, &options, &found) == FPT_BUDGET_EXHAUSTED);
    CHECK(found != NULL && summary_of(found).is_proven == 0 && summary_of(found).undecided_count > 0);
    fpt_surface_intersection_free(found);
    asking.user = &stop;
    stop = 1;
    CHECK(fpt_intersect_trims(tube, triangle, &asking, &found) == FPT_CANCELLED);
    CHECK(found != NULL && summary_of(found).is_stopped == 1 && summary_of(found).undecided_count > 0);
    fpt_surface_intersection_free(found);
    found = NULL;
    options.budget = 0;
    options.method = FPT_INTERSECT_MESH;
    CHECK_ERROR(fpt_intersect_trims(tube, triangle, &options, &found), FPT_INVALID_ARGUMENT, "method");
    fpt_trim_free(tube);
    fpt_trim_free(triangle);
    fpt_support_free(flat);
    fpt_support_free(round);
    fpt_surface_free(plane);
}

static void count_calls(void *user, size_t done, size_t total) {
    CHECK(done <= total);
    ++*(size_t *)user;
}

typedef struct {
    uint32_t steps;
    double first[4], gap;
} traced;

static void trace_step(void *user, uint32_t step, const double *uvst, double gap) {
    traced *told = user;
    CHECK(step == told->steps);
    if (step == 0) memcpy(told->first, uvst, sizeof told->first);
    told->steps++;
    told->gap = gap;
}

/* A cone through a plane, a circle: each corrector, marching, bisection and both discrete methods beside the search. */
static void each_method_is_reached_by_its_name(void) {
    fpt_surface *cone = make_surface(cone_surface()), *plane = plane_at(1.5);
    fpt_surface_intersection *proven = NULL, *found = NULL;
    fpt_intersect_surfaces_options options;
    fpt_intersect_surfaces_options_init(&options, sizeof options);
    CHECK(options.method == FPT_INTERSECT_AUTO && options.corrector == FPT_CORRECTOR_AUTO && options.levels == 0);
    CHECK(options.tolerance == 0 && options.reserved == 0 && options.trace == NULL);
    CHECK_OK(fpt_intersect_surfaces(cone, plane, NULL, &proven));
    fpt_intersection_branch branch;
    CHECK_OK(fpt_surface_intersection_branch(proven, 0, &branch));
    fpt_intersection_point *points = calloc(branch.point_count, sizeof *points);
    CHECK_OK(fpt_surface_intersection_points(proven, 0, branch.point_count, points));
    const fpt_intersection_point *p = &points[branch.point_count / 3];
    const double start[4] = {p->uv[0] + 1e-3, p->uv[1] - 1e-3, p->st[0] + 1e-3, p->st[1]};
    options.trace = trace_step;
    for (uint32_t corrector = FPT_CORRECTOR_AUTO; corrector <= FPT_CORRECTOR_MAF; corrector++) {
        traced told = {0, {0}, 0};
        fpt_intersection_point place;
        double gap = -1;
        uint32_t steps = 0;
        options.corrector = corrector;
        options.tolerance = 1e-10;
        options.user = &told;
        /* Circles of the cone beside the plane do not meet it. */
        if (corrector == FPT_CORRECTOR_NEWTON_HOLDS_V) {
            CHECK_ERROR(fpt_intersect_correct(cone, plane, start, &options, &place, &gap, &steps), FPT_BUDGET_EXHAUSTED, "corrector");
            continue;
        }
        CHECK_OK(fpt_intersect_correct(cone, plane, start, &options, &place, &gap, &steps));
        CHECK(gap >= 0 && gap <= 1e-10 && told.steps == steps + 1 && told.gap == gap && memcmp(told.first, start, sizeof start) == 0);
        CHECK_NEAR(place.point[2], 1.5, 1e-10);
        CHECK_NEAR(hypot(place.point[0] - 1, place.point[1]), 1, 1e-9);
        if (corrector >= FPT_CORRECTOR_NEWTON_HOLDS_U && corrector <= FPT_CORRECTOR_NEWTON_HOLDS_T) {
            const double at[4] = {place.uv[0], place.uv[1], place.st[0], place.st[1]};
            const uint32_t held = corrector - FPT_CORRECTOR_NEWTON_HOLDS_U;
            CHECK(at[held] == start[held]);
        }
    }
    /* x = -9 of the plane misses the circle: said, and nothing written. */
    fpt_intersection_point place = {{7, 7, 7}, {7, 7}, {7, 7}};
    double gap = 7;
    uint32_t steps = 7;
    const double beside[4] = {start[0], start[1], 0, start[3]};
    options.trace = NULL;
    options.corrector = FPT_CORRECTOR_NEWTON_HOLDS_S;
    CHECK_ERROR(fpt_intersect_correct(cone, plane, beside, &options, &place, &gap, &steps), FPT_BUDGET_EXHAUSTED, "corrector");
    CHECK(place.point[0] == 7 && gap == 7 && steps == 7);

    fpt_intersect_surfaces_options_init(&options, sizeof options);
    options.corrector = FPT_CORRECTOR_MAF;
    options.chord = 1e-2;
    CHECK_OK(fpt_intersect_march(cone, plane, start, 0, &options, &found));
    fpt_intersection_summary s = summary_of(found);
    CHECK(s.branch_count == 1 && s.is_proven == 0 && s.undecided_count == 1);
    CHECK_OK(fpt_surface_intersection_branch(found, 0, &branch));
    CHECK(branch.point_count > 8 && branch.gap <= 1e-4 && isinf(branch.chord));
    points = realloc(points, branch.point_count * sizeof *points);
    double (*places)[4] = calloc(branch.point_count, sizeof *places);
    CHECK_OK(fpt_surface_intersection_points(found, 0, branch.point_count, points));
    for (size_t i = 0; i < branch.point_count; i++) {
        CHECK_NEAR(points[i].point[2], 1.5, 1e-4);
        CHECK_NEAR(hypot(points[i].point[0] - 1, points[i].point[1]), 1, 1e-4);
        memcpy(places[i], points[i].uv, 2 * sizeof(double));
        memcpy(places[i] + 2, points[i].st, 2 * sizeof(double));
    }
    fpt_surface_intersection_free(found);
    options.chord = 1e-5;
    const size_t coarse = branch.point_count;
    CHECK_OK(fpt_intersect_bisect(cone, plane, places[0], coarse, &options, &found));
    CHECK_OK(fpt_surface_intersection_branch(found, 0, &branch));
    CHECK(branch.point_count > 4 * coarse && summary_of(found).is_proven == 0);
    points = realloc(points, branch.point_count * sizeof *points);
    CHECK_OK(fpt_surface_intersection_points(found, 0, branch.point_count, points));
    for (size_t i = 1; i < branch.point_count; i++) {
        const double x = 0.5 * (points[i - 1].point[0] + points[i].point[0]) - 1, y = 0.5 * (points[i - 1].point[1] + points[i].point[1]);
        CHECK_NEAR(hypot(x, y), 1, 1.3e-4);
    }
    fpt_surface_intersection_free(found);

    const uint32_t methods[3][2] = {{FPT_INTERSECT_SUBDIVISION, 4}, {FPT_INTERSECT_SUBDIVISION, 0}, {FPT_INTERSECT_MESH, 60}};
    for (int i = 0; i < 3; i++) {
        options.method = methods[i][0];
        options.levels = methods[i][1];
        options.chord = 1e-2;
        CHECK_OK(fpt_intersect_surfaces(cone, plane, &options, &found));
        s = summary_of(found);
        CHECK(s.branch_count >= 1 && s.is_proven == 0 && s.undecided_count == 1 && s.pairs > 0);
        double length = 0;
        for (size_t k = 0; k < s.branch_count; k++) {
            CHECK_OK(fpt_surface_intersection_branch(found, k, &branch));
            CHECK(branch.gap > 0 && branch.gap < 0.2);
            points = realloc(points, branch.point_count * sizeof *points);
            CHECK_OK(fpt_surface_intersection_points(found, k, branch.point_count, points));
            for (size_t j = 1; j < branch.point_count; j++)
                length += hypot(points[j].point[0] - points[j - 1].point[0], points[j].point[1] - points[j - 1].point[1]);
        }
        CHECK_NEAR(length, 6.283185307179586, 0.1);
        fpt_surface_intersection_free(found);
        int stop = 1;
        options.should_stop = stop_now;
        options.user = &stop;
        found = NULL;
        CHECK(fpt_intersect_surfaces(cone, plane, &options, &found) == FPT_CANCELLED && found != NULL);
        CHECK(summary_of(found).is_stopped == 1 && summary_of(found).undecided_count == 1);
        fpt_surface_intersection_free(found);
        options.should_stop = NULL;
    }
    found = NULL;
    options.levels = 2000;
    CHECK_ERROR(fpt_intersect_surfaces(cone, plane, &options, &found), FPT_INVALID_ARGUMENT, "levels");
    options.method = 3;
    CHECK_ERROR(fpt_intersect_surfaces(cone, plane, &options, &found), FPT_INVALID_ARGUMENT, "method");
    fpt_intersect_surfaces_options_init(&options, sizeof options);
    options.corrector = 7;
    CHECK_ERROR(fpt_intersect_march(cone, plane, start, 0, &options, &found), FPT_INVALID_ARGUMENT, "corrector");
    options.corrector = 0;
    options.reserved = 1;
    CHECK_ERROR(fpt_intersect_surfaces(cone, plane, &options, &found), FPT_INVALID_ARGUMENT, "reserved");
    CHECK_ERROR(fpt_intersect_march(cone, plane, start, -1, NULL, &found), FPT_INVALID_ARGUMENT, "step");
    CHECK_ERROR(fpt_intersect_march(NULL, plane, start, 0, NULL, &found), FPT_NULL_ARGUMENT, "a");
    CHECK_ERROR(fpt_intersect_march(cone, plane, NULL, 0, NULL, &found), FPT_NULL_ARGUMENT, "uvst");
    CHECK_ERROR(fpt_intersect_bisect(cone, plane, start, 1, NULL, &found), FPT_INVALID_ARGUMENT, "places");
    CHECK_ERROR(fpt_intersect_correct(cone, NULL, start, NULL, &place, &gap, &steps), FPT_NULL_ARGUMENT, "b");
    CHECK_ERROR(fpt_intersect_correct(cone, plane, start, NULL, &place, &gap, NULL), FPT_NULL_ARGUMENT, "out_steps");
    const double nowhere[4] = {0, NAN, 0, 0};
    CHECK_ERROR(fpt_intersect_correct(cone, plane, nowhere, NULL, &place, &gap, &steps), FPT_INVALID_ARGUMENT, "uvst");
    CHECK(found == NULL);
    free(places);
    free(points);
    fpt_surface_intersection_free(proven);
    fpt_surface_free(plane);
    fpt_surface_free(cone);
}

/* The caller's point tolerance: kept, or not said to be kept; what is nearer touches. */
static void a_point_tolerance_holds(void) {
    fpt_surface *cone = make_surface(cone_surface()), *plane = plane_at(1.5), *above = plane_at(1.5 + 1e-9);
    fpt_surface_intersection *found = NULL;
    fpt_intersect_surfaces_options options;
    fpt_intersect_surfaces_options_init(&options, sizeof options);
    const double tolerances[] = {1e-9, 1e-20};
    for (int i = 0; i < 2; i++) {
        options.tolerance = tolerances[i];
        CHECK_OK(fpt_intersect_surfaces(cone, plane, &options, &found));
        fpt_intersection_summary s = summary_of(found);
        CHECK(s.branch_count == 1 && s.undecided_count == 0 && s.is_proven == (i == 0));
        fpt_surface_intersection_free(found);
    }
    options.tolerance = 0;
    CHECK_OK(fpt_intersect_surfaces(plane, above, &options, &found));
    CHECK(summary_of(found).is_proven == 1 && summary_of(found).overlap_count == 0);
    fpt_surface_intersection_free(found);
    options.tolerance = 1e-7;
    CHECK_OK(fpt_intersect_surfaces(plane, above, &options, &found));
    CHECK(summary_of(found).is_proven == 0 && summary_of(found).overlap_count > 0);
    fpt_surface_intersection_free(found);
    found = NULL;
    options.tolerance = -1;
    CHECK_ERROR(fpt_intersect_surfaces(cone, plane, &options, &found), FPT_INVALID_ARGUMENT, "tolerance");
    fpt_surface_free(above);
    fpt_surface_free(plane);
    fpt_surface_free(cone);
}

static void budget_stop_and_misuse(void) {
    fpt_surface *cone = make_surface(cone_surface()), *plane = plane_at(1.5);
    fpt_surface_intersection *found = NULL;
    fpt_intersect_surfaces_options options;
    fpt_intersect_surfaces_options_init(&options, sizeof options);
    CHECK(options.struct_size == sizeof options && options.chord == 0 && options.budget == 0);
    fpt_intersect_surfaces_options_init(NULL, sizeof options);

    options.budget = 5;
    CHECK(fpt_intersect_surfaces(cone, plane, &options, &found) == FPT_BUDGET_EXHAUSTED);
    CHECK(found != NULL && summary_of(found).is_exhausted == 1 && summary_of(found).undecided_count > 0);
    double range[8];
    CHECK_OK(fpt_surface_intersection_undecided(found, 0, range));
    fpt_surface_intersection_free(found);
    found = NULL;

    int stop = 1;
    options.budget = 0;
    options.should_stop = stop_now;
    options.user = &stop;
    CHECK(fpt_intersect_surfaces(cone, plane, &options, &found) == FPT_CANCELLED && found != NULL);
    CHECK(summary_of(found).is_stopped == 1 && summary_of(found).branch_count == 0 && summary_of(found).undecided_count > 0);
    fpt_surface_intersection_free(found);
    found = NULL;
    size_t calls = 0;
    options.should_stop = NULL;
    options.progress = count_calls;
    options.user = &calls;
    CHECK_OK(fpt_intersect_surfaces(cone, plane, &options, &found));
    CHECK(calls > 0);
    fpt_surface_intersection_free(found);
    found = NULL;

    options.progress = NULL;
    options.chord = -1;
    CHECK(fpt_intersect_surfaces(cone, plane, &options, &found) == FPT_INVALID_ARGUMENT);
    CHECK(strstr(fpt_last_error(), "chord") != NULL);
    options.chord = NAN;
    CHECK(fpt_intersect_surfaces(cone, plane, &options, &found) == FPT_INVALID_ARGUMENT);
    options.struct_size = 3;
    CHECK(fpt_intersect_surfaces(cone, plane, &options, &found) != FPT_OK);
    CHECK(fpt_intersect_surfaces(NULL, plane, NULL, &found) == FPT_NULL_ARGUMENT);
    CHECK(strstr(fpt_last_error(), "a:") != NULL);
    CHECK(fpt_intersect_surfaces(cone, NULL, NULL, &found) == FPT_NULL_ARGUMENT);
    CHECK(strstr(fpt_last_error(), "b:") != NULL);
    CHECK(fpt_intersect_surfaces(cone, plane, NULL, NULL) == FPT_NULL_ARGUMENT && found == NULL);
    fpt_intersection_summary s;
    CHECK(fpt_surface_intersection_summary(NULL, &s) == FPT_NULL_ARGUMENT);
    fpt_surface_intersection_free(NULL);
    fpt_surface_free(plane);
    fpt_surface_free(cone);
}

int main(void) {
    RUN(a_cone_is_cut_in_a_circle_and_its_apex_is_a_contact);
    RUN(coincident_planes_overlap);
    RUN(faces_are_cut_off_at_their_trims_and_split);
    RUN(each_method_is_reached_by_its_name);
    RUN(a_point_tolerance_holds);
    RUN(budget_stop_and_misuse);
    return check_report("intersect_surfaces");
}
