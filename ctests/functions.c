/* What each function gives back on shapes whose answers are known in closed form. */
#include "samples.h"

static void a_curve_gives_its_inputs_back(void) {
    fpt_curve_data data = circle_curve();
    fpt_curve *curve = make_curve(data);
    size_t degree = 0, pole_count = 0;
    double knots[13], poles[28], weights[10], box[6];
    int32_t rational = -1, closed = -1;
    fill_pattern(knots, sizeof knots);
    CHECK_OK(fpt_curve_degree(curve, &degree));
    CHECK_OK(fpt_curve_pole_count(curve, &pole_count));
    CHECK(degree == 2 && pole_count == 9);
    CHECK_OK(fpt_curve_knots(curve, 13, knots));
    CHECK_SAME_BITS(knots, data.knots, 12 * sizeof *knots);
    CHECK(is_pattern(knots + 12, sizeof *knots));
    CHECK_OK(fpt_curve_poles(curve, 27, poles));
    CHECK_SAME_BITS(poles, data.poles, 27 * sizeof *poles);
    CHECK_OK(fpt_curve_weights(curve, 9, weights));
    CHECK_SAME_BITS(weights, data.weights, 9 * sizeof *weights);
    CHECK_OK(fpt_curve_box(curve, box));
    CHECK(box[0] == -1 && box[1] == -2 && box[2] == 0 && box[3] == 3 && box[4] == 2 && box[5] == 0);
    CHECK_OK(fpt_curve_is_rational(curve, &rational));
    CHECK_OK(fpt_curve_is_closed(curve, &closed));
    CHECK(rational == 1 && closed == 1);
    fpt_curve_free(curve);
}

static void a_polynomial_curve_is_open_and_weighs_one(void) {
    fpt_curve *curve = make_curve(unclamped_curve());
    double weights[6], domain[2];
    int32_t rational = -1, closed = -1;
    CHECK_OK(fpt_curve_weights(curve, 6, weights));
    for (size_t i = 0; i < 6; i++) CHECK(weights[i] == 1);
    CHECK_OK(fpt_curve_is_rational(curve, &rational));
    CHECK_OK(fpt_curve_is_closed(curve, &closed));
    CHECK(rational == 0 && closed == 0);
    CHECK_OK(fpt_curve_domain(curve, domain));
    CHECK(domain[0] == 3 && domain[1] == 6);
    fpt_curve_free(curve);
}

static void a_surface_gives_its_inputs_back(void) {
    fpt_surface_data data = paper_surface(1);
    fpt_surface *surface = make_surface(data);
    size_t degree_u = 0, degree_v = 0, pole_count_u = 0, pole_count_v = 0;
    double knots_u[11], knots_v[9], poles[84], weights[28], box[6], domain[4];
    int32_t rational = -1, closed_u = -1, closed_v = -1, collapsed[4] = {-1, -1, -1, -1};
    fill_pattern(knots_v, sizeof knots_v);
    CHECK_OK(fpt_surface_degree_u(surface, &degree_u));
    CHECK_OK(fpt_surface_degree_v(surface, &degree_v));
    CHECK_OK(fpt_surface_pole_count_u(surface, &pole_count_u));
    CHECK_OK(fpt_surface_pole_count_v(surface, &pole_count_v));
    CHECK(degree_u == 3 && degree_v == 3 && pole_count_u == 7 && pole_count_v == 4);
    CHECK_OK(fpt_surface_knots_u(surface, 11, knots_u));
    CHECK_OK(fpt_surface_knots_v(surface, 9, knots_v));
    CHECK_OK(fpt_surface_poles(surface, 84, poles));
    CHECK_OK(fpt_surface_weights(surface, 28, weights));
    CHECK_SAME_BITS(knots_u, data.knots_u, 11 * sizeof *knots_u);
    CHECK_SAME_BITS(knots_v, data.knots_v, 8 * sizeof *knots_v);
    CHECK(is_pattern(knots_v + 8, sizeof *knots_v));
    CHECK_SAME_BITS(poles, data.poles, sizeof poles);
    CHECK_SAME_BITS(weights, data.weights, sizeof weights);
    CHECK_OK(fpt_surface_box(surface, box));
    CHECK(box[0] == 90 && box[1] == 100 && box[2] == 0 && box[3] == 575 && box[4] == 440 && box[5] == 60);
    CHECK_OK(fpt_surface_domain(surface, domain));
    CHECK(domain[0] == 0 && domain[1] == 1 && domain[2] == 0 && domain[3] == 1);
    CHECK_OK(fpt_surface_is_rational(surface, &rational));
    CHECK_OK(fpt_surface_is_closed_u(surface, &closed_u));
    CHECK_OK(fpt_surface_is_closed_v(surface, &closed_v));
    CHECK(rational == 1 && closed_u == 0 && closed_v == 0);
    CHECK_OK(fpt_surface_collapsed_edges(surface, collapsed));
    CHECK(!collapsed[0] && !collapsed[1] && !collapsed[2] && !collapsed[3]);
    fpt_surface_free(surface);
}

static void a_cone_is_closed_and_ends_in_a_point(void) {
    fpt_surface *surface = make_surface(cone_surface());
    int32_t closed_u = -1, closed_v = -1, collapsed[4] = {-1, -1, -1, -1};
    CHECK_OK(fpt_surface_is_closed_u(surface, &closed_u));
    CHECK_OK(fpt_surface_is_closed_v(surface, &closed_v));
    CHECK(closed_u == 1 && closed_v == 0);
    CHECK_OK(fpt_surface_collapsed_edges(surface, collapsed));
    CHECK(collapsed[0] == 0 && collapsed[1] == 0 && collapsed[2] == 0 && collapsed[3] == 1);
    fpt_surface_free(surface);
}

/* The circle keeps its radius, its tangent is at a right angle to it, and orders agree with differences. */
static void curve_derivatives_are_derivatives(void) {
    fpt_curve *curve = make_curve(circle_curve());
    for (int i = 1; i < 40; i++) {
        double u = i * 0.1 + 0.03, h = 1e-4, at[9], before[9], after[9], twelve[39];
        CHECK_OK(fpt_curve_evaluate(curve, u, 2, at));
        CHECK_OK(fpt_curve_evaluate(curve, u - h, 2, before));
        CHECK_OK(fpt_curve_evaluate(curve, u + h, 2, after));
        CHECK_OK(fpt_curve_evaluate(curve, u, 12, twelve));
        CHECK_NEAR(hypot(at[0] - 1, at[1]), 2, 1e-14);
        CHECK_NEAR((at[0] - 1) * at[3] + at[1] * at[4], 0, 1e-12);
        CHECK_SAME_BITS(at, twelve, 3 * sizeof *at);
        for (size_t k = 0; k < 9; k++) CHECK_NEAR(at[k], twelve[k], 1e-12);
        for (size_t k = 0; k < 6; k++) CHECK_NEAR((after[k] - before[k]) / (2 * h), at[k + 3], 2e-6);
    }
    fpt_curve_free(curve);
}

static void derivatives_above_the_degree_vanish(void) {
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_surface *surface = make_surface(paper_surface(0));
    static double out[3 * 32 * 33 / 2];
    fill_pattern(out, sizeof out);
    CHECK_OK(fpt_curve_evaluate(curve, 0.37, 31, out));
    for (size_t k = 12; k < 96; k++) CHECK(out[k] == 0);
    CHECK(is_pattern(out + 96, sizeof out - 96 * sizeof *out));
    CHECK_OK(fpt_surface_evaluate(surface, 0.37, 0.6, 31, out));
    for (size_t k = 3 * 7 * 8 / 2; k < COUNT_OF(out); k++) CHECK(out[k] == 0);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

/* Two straight pieces: at the corner the right one counts, at the end the left one. */
static void at_a_knot_the_right_piece_counts(void) {
    static const double knots[] = {0, 0, 0.5, 1, 1}, poles[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    fpt_curve *curve = make_curve(curve_data(1, 3, knots, poles, NULL));
    double out[6];
    CHECK_OK(fpt_curve_evaluate(curve, 0.5, 1, out));
    CHECK(out[0] == 1 && out[1] == 0 && out[3] == 0 && out[4] == 2);
    CHECK_OK(fpt_curve_evaluate(curve, 1, 1, out));
    CHECK(out[0] == 1 && out[1] == 1 && out[3] == 0 && out[4] == 2);
    CHECK_OK(fpt_curve_evaluate(curve, 0, 1, out));
    CHECK(out[0] == 0 && out[1] == 0 && out[3] == 2 && out[4] == 0);
    fpt_curve_free(curve);
}

/* S; Su, Sv; Suu, Suv, Svv: each against differences of the order below. */
static void surface_partials_are_partials(void) {
    for (int rational = 0; rational < 2; rational++) {
        fpt_surface *surface = make_surface(paper_surface(rational));
        for (int i = 0; i < 25; i++) {
            double u = 0.04 + 0.037 * i, v = 0.95 - 0.036 * i, h = 1e-5;
            double at[18], plus_u[9], minus_u[9], plus_v[9], minus_v[9];
            CHECK_OK(fpt_surface_evaluate(surface, u, v, 2, at));
            CHECK_OK(fpt_surface_evaluate(surface, u + h, v, 1, plus_u));
            CHECK_OK(fpt_surface_evaluate(surface, u - h, v, 1, minus_u));
            CHECK_OK(fpt_surface_evaluate(surface, u, v + h, 1, plus_v));
            CHECK_OK(fpt_surface_evaluate(surface, u, v - h, 1, minus_v));
            for (size_t k = 0; k < 3; k++) {
                CHECK_NEAR((plus_u[k] - minus_u[k]) / (2 * h), at[3 + k], 1e-4);
                CHECK_NEAR((plus_v[k] - minus_v[k]) / (2 * h), at[6 + k], 1e-4);
                CHECK_NEAR((plus_u[3 + k] - minus_u[3 + k]) / (2 * h), at[9 + k], 0.2);
                CHECK_NEAR((plus_u[6 + k] - minus_u[6 + k]) / (2 * h), at[12 + k], 0.2);
                CHECK_NEAR((plus_v[6 + k] - minus_v[6 + k]) / (2 * h), at[15 + k], 0.2);
            }
        }
        fpt_surface_free(surface);
    }
}

static void many_evaluations_are_the_single_ones(void) {
    enum { COUNT = 50 };
    fpt_curve *curve = make_curve(circle_curve());
    fpt_surface *surface = make_surface(paper_surface(1));
    double parameters[2 * COUNT], many[18 * COUNT], one[18];
    uint64_t state = 7;
    for (size_t i = 0; i < 2 * COUNT; i++) parameters[i] = next_random(&state);
    CHECK_OK(fpt_curve_evaluate_many(curve, parameters, COUNT, 3, many));
    for (size_t i = 0; i < COUNT; i++) {
        CHECK_OK(fpt_curve_evaluate(curve, parameters[i], 3, one));
        CHECK_SAME_BITS(one, many + 12 * i, 12 * sizeof *one);
    }
    CHECK_OK(fpt_surface_evaluate_many(surface, parameters, COUNT, 2, many));
    for (size_t i = 0; i < COUNT; i++) {
        CHECK_OK(fpt_surface_evaluate(surface, parameters[2 * i], parameters[2 * i + 1], 2, one));
        CHECK_SAME_BITS(one, many + 18 * i, sizeof one);
    }
    CHECK_OK(fpt_curve_evaluate_many(curve, NULL, 0, 0, NULL));
    CHECK_OK(fpt_surface_evaluate_many(surface, NULL, 0, 0, NULL));
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

/* A foot as every foot must be: its point is the shape there, its distance is to that point, its bound is below. */
static void check_foot(const fpt_foot_point *foot, const double query[3], const double at[3], double distance) {
    CHECK_SAME_BITS(foot->point, at, sizeof foot->point);
    CHECK_NEAR(foot->distance, distance, 1e-13 * (1 + distance));
    CHECK_NEAR(foot->distance, distance_between(query, at), 1e-14 * (1 + distance));
    CHECK(foot->lower_bound <= foot->distance && foot->distance - foot->lower_bound < 1e-8 * (1 + distance));
    CHECK(!(foot->flags & (FPT_FOOT_NOT_PROVEN | FPT_FOOT_BUDGET | FPT_FOOT_BAD_QUERY | FPT_FOOT_HINT_USED)));
    CHECK(foot->iterations > 0);
}

static void the_nearest_points_of_a_circle_are_known(void) {
    fpt_curve *curve = make_curve(circle_curve());
    uint64_t state = 3;
    for (int i = 0; i < 200; i++) {
        double query[3], at[3], radius, distance;
        fpt_foot_point foot, inverted;
        for (size_t k = 0; k < 3; k++) query[k] = 8 * next_random(&state) - 4;
        radius = hypot(query[0] - 1, query[1]);
        distance = hypot(radius - 2, query[2]);
        CHECK_OK(fpt_curve_closest(curve, query, 1, NULL, &foot));
        CHECK_OK(fpt_curve_evaluate(curve, foot.u, 0, at));
        check_foot(&foot, query, at, distance);
        CHECK(foot.v == 0 && !(foot.flags & FPT_FOOT_CREASE));
        CHECK_OK(fpt_curve_invert(curve, at, 1, NULL, &inverted));
        CHECK(!(inverted.flags & FPT_FOOT_NOT_ON_SHAPE));
        CHECK_NEAR(inverted.u, foot.u, 1e-7);
    }
    fpt_curve_free(curve);
}

/* A cone of radius 2 and height 3: distance in the half plane through the axis to the segment (2,0)-(0,3). */
static double distance_to_cone(const double query[3]) {
    double radius = hypot(query[0] - 1, query[1]), z = query[2];
    double t = ((radius - 2) * -2 + z * 3) / 13;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(radius - (2 - 2 * t), z - 3 * t);
}

static void the_nearest_points_of_a_cone_are_known(void) {
    fpt_surface *surface = make_surface(cone_surface());
    uint64_t state = 5;
    for (int i = 0; i < 200; i++) {
        double query[3], at[3];
        fpt_foot_point foot, inverted;
        for (size_t k = 0; k < 3; k++) query[k] = 10 * next_random(&state) - 4;
        CHECK_OK(fpt_surface_closest(surface, query, 1, NULL, &foot));
        CHECK_OK(fpt_surface_evaluate(surface, foot.u, foot.v, 0, at));
        check_foot(&foot, query, at, distance_to_cone(query));
        CHECK_OK(fpt_surface_invert(surface, at, 1, NULL, &inverted));
        CHECK(!(inverted.flags & FPT_FOOT_NOT_ON_SHAPE));
        CHECK(inverted.distance < 1e-13);
    }
    fpt_surface_free(surface);
}

static uint32_t surface_flags(const fpt_surface *surface, double x, double y, double z) {
    const double query[3] = {x, y, z};
    fpt_foot_point foot;
    memset(&foot, 0, sizeof foot);
    CHECK_OK(fpt_surface_closest(surface, query, 1, NULL, &foot));
    return foot.flags;
}

static uint32_t curve_flags(const fpt_curve *curve, double x, double y, double z) {
    const double query[3] = {x, y, z};
    fpt_foot_point foot;
    memset(&foot, 0, sizeof foot);
    CHECK_OK(fpt_curve_closest(curve, query, 1, NULL, &foot));
    return foot.flags;
}

static void flags_say_where_a_foot_lies(void) {
    static const double knots[] = {0, 0, 0.5, 1, 1}, poles[] = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    fpt_curve *bend = make_curve(curve_data(1, 3, knots, poles, NULL)), *circle = make_curve(circle_curve());
    fpt_surface *paper = make_surface(paper_surface(0)), *cone = make_surface(cone_surface());
    CHECK(curve_flags(bend, -1, 0, 0) == FPT_FOOT_EDGE);
    CHECK(curve_flags(bend, 0.5, -1, 0) == 0);
    CHECK(curve_flags(bend, 2, -1, 0) == FPT_FOOT_CREASE);
    CHECK(curve_flags(bend, 0.5, 0.5, 0) == FPT_FOOT_TIE);
    CHECK(curve_flags(circle, 5, 0, 0) & FPT_FOOT_SEAM);
    CHECK(curve_flags(circle, 1, 0, 0) & (FPT_FOOT_TIE | FPT_FOOT_CONTINUUM));
    CHECK(!(curve_flags(circle, 1, 5, 0) & (FPT_FOOT_CREASE | FPT_FOOT_SEAM | FPT_FOOT_EDGE)));
    CHECK(surface_flags(paper, -1e3, -1e3, 0) & FPT_FOOT_CORNER);
    CHECK((surface_flags(cone, 1, 4, -2) & (FPT_FOOT_EDGE | FPT_FOOT_CORNER)) == FPT_FOOT_EDGE);
    CHECK(!(surface_flags(paper, 300, 250, 100) & (FPT_FOOT_EDGE | FPT_FOOT_CORNER | FPT_FOOT_CREASE)));
    CHECK(surface_flags(cone, 1, 0, 5) & FPT_FOOT_COLLAPSED);
    CHECK(surface_flags(cone, 4, 0, 2) & FPT_FOOT_SEAM);
    CHECK(!(surface_flags(cone, 1, 4, 2) & (FPT_FOOT_SEAM | FPT_FOOT_COLLAPSED | FPT_FOOT_CREASE)));
    fpt_curve_free(bend);
    fpt_curve_free(circle);
    fpt_surface_free(paper);
    fpt_surface_free(cone);
}

int main(void) {
    RUN(a_curve_gives_its_inputs_back);
    RUN(a_polynomial_curve_is_open_and_weighs_one);
    RUN(a_surface_gives_its_inputs_back);
    RUN(a_cone_is_closed_and_ends_in_a_point);
    RUN(curve_derivatives_are_derivatives);
    RUN(derivatives_above_the_degree_vanish);
    RUN(at_a_knot_the_right_piece_counts);
    RUN(surface_partials_are_partials);
    RUN(many_evaluations_are_the_single_ones);
    RUN(the_nearest_points_of_a_circle_are_known);
    RUN(the_nearest_points_of_a_cone_are_known);
    RUN(flags_say_where_a_foot_lies);
    return check_report("functions");
}
