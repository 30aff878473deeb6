/* Unrolled parameters, and polylines of points inverted as paths. */
#include "samples.h"

enum { STEPS = 400 };
static const double turn = 6.283185307179586;

static void unwrapping_counts_turns(void) {
    const double previous[2] = {9.2, 0.1}, uv[2] = {1, 0.5};
    double u, both[2];
    fpt_curve *circle = make_curve(circle_curve()), *open = make_curve(cubic_curve());
    fpt_surface *cone = make_surface(cone_surface());
    CHECK_OK(fpt_curve_unwrap(circle, 9.2, 1, &u));
    CHECK(u == 9);
    CHECK_OK(fpt_curve_unwrap(circle, -7.5, 1, &u));
    CHECK(u == -7);
    CHECK_OK(fpt_curve_unwrap(circle, 3, 1, &u));
    CHECK(u == 1);
    CHECK_OK(fpt_curve_unwrap(open, 100, 0.25, &u));
    CHECK(u == 0.25);
    CHECK_OK(fpt_surface_unwrap(cone, previous, uv, both));
    CHECK(both[0] == 9 && both[1] == 0.5);
    fpt_curve_free(circle);
    fpt_curve_free(open);
    fpt_surface_free(cone);
}

/* Points beside the circle of circle_curve, `turns` times round. */
static void points_round(double *points, double turns, double radius, double height) {
    for (size_t i = 0; i < STEPS; i++) {
        double angle = 0.1 + turns * turn * (double)i / (STEPS - 1);
        points[3 * i] = 1 + radius * cos(angle);
        points[3 * i + 1] = radius * sin(angle);
        points[3 * i + 2] = height;
    }
}

static size_t count_of(const uint32_t *changes, uint32_t bit) {
    size_t count = 0;
    for (size_t i = 0; i < STEPS; i++) count += (changes[i] & bit) != 0;
    return count;
}

static void three_turns_round_a_circle_go_on_counting(void) {
    static double points[3 * STEPS], unwrapped[STEPS];
    static fpt_foot_point alone[STEPS], feet[STEPS];
    static uint32_t changes[STEPS];
    fpt_curve *circle = make_curve(circle_curve());
    points_round(points, 3, 2.5, 0.3);
    CHECK_OK(fpt_curve_invert(circle, points, STEPS, NULL, alone));
    CHECK_OK(fpt_curve_path(circle, points, STEPS, NULL, feet, unwrapped, changes));
    for (size_t i = 0; i < STEPS; i++) {
        CHECK(feet[i].distance == alone[i].distance && feet[i].lower_bound == alone[i].lower_bound);
        CHECK(feet[i].flags & FPT_FOOT_NOT_ON_SHAPE);
        CHECK(i == 0 || unwrapped[i] > unwrapped[i - 1]);
    }
    CHECK_NEAR(unwrapped[STEPS - 1] - unwrapped[0], 12, 1e-9);
    CHECK(count_of(changes, FPT_PATH_SEAM_CROSSED) == 3 && count_of(changes, FPT_PATH_JUMP) == 0);
    /* The feet alone. */
    CHECK_OK(fpt_curve_path(circle, points, STEPS, NULL, alone, NULL, NULL));
    CHECK_SAME_BITS(alone, feet, sizeof feet);
    CHECK_OK(fpt_curve_path(circle, NULL, 0, NULL, NULL, NULL, NULL));
    fpt_query_options options = default_options();
    options.threads = 1;
    CHECK_OK(fpt_curve_path(circle, points, STEPS, &options, alone, NULL, NULL));
    CHECK_SAME_BITS(alone, feet, sizeof feet);
    fpt_curve_free(circle);
}

static void round_a_cone_and_over_its_tip(void) {
    static double points[3 * STEPS], unwrapped[2 * STEPS];
    static fpt_foot_point feet[STEPS];
    static uint32_t changes[STEPS];
    fpt_surface *cone = make_surface(cone_surface());
    points_round(points, -2, 2, 0.5);
    CHECK_OK(fpt_surface_path(cone, points, STEPS, NULL, feet, unwrapped, changes));
    CHECK_NEAR(unwrapped[2 * (STEPS - 1)] - unwrapped[0], -8, 1e-9);
    CHECK(count_of(changes, FPT_PATH_SEAM_CROSSED) == 2 && count_of(changes, FPT_PATH_JUMP) == 0);
    for (size_t i = 0; i < STEPS; i++) {
        points[3 * i] = 1 + 4 * (2.0 * (double)i / (STEPS - 1) - 1);
        points[3 * i + 1] = 0;
        points[3 * i + 2] = 3.5;
    }
    CHECK_OK(fpt_surface_path(cone, points, STEPS, NULL, feet, unwrapped, changes));
    CHECK(count_of(changes, FPT_PATH_THROUGH_COLLAPSED) > 0 && count_of(changes, FPT_PATH_JUMP) == 0);
    for (size_t i = 1; i < STEPS; i++) {
        CHECK(!(feet[i].flags & FPT_FOOT_COLLAPSED) || feet[i].u == feet[i - 1].u);
    }
    fpt_surface_free(cone);
}

static void into_a_corner_the_foot_jumps(void) {
    static const double knots[] = {0, 0, 1, 2, 2}, poles[] = {-1, 1, 0, 0, 0, 0, 1, 1, 0};
    static double points[3 * STEPS];
    static fpt_foot_point feet[STEPS];
    static uint32_t changes[STEPS];
    fpt_curve *corner = make_curve(curve_data(1, 3, knots, poles, NULL));
    for (size_t i = 0; i < STEPS; i++) {
        points[3 * i] = (double)i / (STEPS - 1) - 0.5;
        points[3 * i + 1] = 0.8;
        points[3 * i + 2] = 0;
    }
    CHECK_OK(fpt_curve_path(corner, points, STEPS, NULL, feet, NULL, changes));
    CHECK(count_of(changes, FPT_PATH_JUMP) == 1 && changes[STEPS / 2] == FPT_PATH_JUMP);
    fpt_curve_free(corner);
}

static void a_bad_point_is_stepped_over(void) {
    static double points[3 * STEPS], unwrapped[STEPS];
    static fpt_foot_point feet[STEPS];
    fpt_curve *circle = make_curve(circle_curve());
    points_round(points, 2, 2.5, 0.3);
    points[3 * 9] = NAN;
    CHECK_OK(fpt_curve_path(circle, points, STEPS, NULL, feet, unwrapped, NULL));
    CHECK((feet[9].flags & FPT_FOOT_BAD_QUERY) && isnan(unwrapped[9]));
    CHECK_NEAR(unwrapped[STEPS - 1] - unwrapped[0], 8, 1e-9);
    fpt_curve_free(circle);
}

static int stop_at_once(void *user) {
    (void)user;
    return 1;
}

static void bad_arguments_are_named_and_a_stop_is_obeyed(void) {
    fpt_curve *curve = make_curve(circle_curve());
    fpt_surface *surface = make_surface(cone_surface());
    fpt_foot_point foot;
    fpt_query_options options = default_options();
    double out[2];
    const double point[3] = {5, 1, 0}, uv[2] = {1, 0.5}, outside[2] = {1, 2}, infinite[2] = {INFINITY, 0};
    fill_pattern(&foot, sizeof foot);
    fill_pattern(out, sizeof out);
    CHECK_ERROR(fpt_curve_unwrap(NULL, 0, 1, out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_unwrap(curve, 0, 1, NULL), FPT_NULL_ARGUMENT, "out_u");
    CHECK_ERROR(fpt_curve_unwrap(curve, 0, -0.5, out), FPT_INVALID_ARGUMENT, "u: -0.5");
    CHECK_ERROR(fpt_curve_unwrap(curve, NAN, 0.5, out), FPT_INVALID_ARGUMENT, "previous");
    CHECK_ERROR(fpt_curve_unwrap(curve, 1e20, 0.5, out), FPT_INVALID_ARGUMENT, "turns away");
    CHECK_ERROR(fpt_surface_unwrap(surface, uv, outside, out), FPT_INVALID_ARGUMENT, "uv: entry 1");
    CHECK_ERROR(fpt_surface_unwrap(surface, infinite, uv, out), FPT_INVALID_ARGUMENT, "previous: entry 0");
    CHECK_ERROR(fpt_surface_unwrap(surface, NULL, uv, out), FPT_NULL_ARGUMENT, "previous");
    CHECK_ERROR(fpt_surface_unwrap(surface, uv, NULL, out), FPT_NULL_ARGUMENT, "uv");
    CHECK_ERROR(fpt_surface_unwrap(surface, uv, uv, NULL), FPT_NULL_ARGUMENT, "out_uv");
    CHECK_ERROR(fpt_curve_path(curve, NULL, 1, NULL, &foot, out, NULL), FPT_NULL_ARGUMENT, "points");
    CHECK_ERROR(fpt_curve_path(curve, point, 1, NULL, NULL, out, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_path(NULL, point, 1, NULL, &foot, out, NULL), FPT_NULL_ARGUMENT, "surface");
    options.method = 77;
    CHECK_ERROR(fpt_surface_path(surface, point, 1, &options, &foot, out, NULL), FPT_INVALID_ARGUMENT, "method");
    CHECK(is_pattern(&foot, sizeof foot) && is_pattern(out, sizeof out));
    options.method = 0;
    options.should_stop = stop_at_once;
    CHECK_STATUS(fpt_surface_path(surface, point, 1, &options, &foot, out, NULL), FPT_CANCELLED);
    CHECK(isnan(foot.distance));
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

int main(void) {
    RUN(unwrapping_counts_turns);
    RUN(three_turns_round_a_circle_go_on_counting);
    RUN(round_a_cone_and_over_its_tip);
    RUN(into_a_corner_the_foot_jumps);
    RUN(a_bad_point_is_stepped_over);
    RUN(bad_arguments_are_named_and_a_stop_is_obeyed);
    return check_report("path");
}
