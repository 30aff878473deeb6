/* Normals and sides, tangents, one-sided derivatives, uncertainties: closed forms, and what is refused. */
#include "samples.h"

enum { POINTS = 2000 };

/* A cube of side 2 about the origin as one surface: u goes round, v from the bottom's middle to the top's. */
static fpt_surface_data cube_surface(void) {
    static const double knots[] = {0, 0, 1, 2, 3, 4, 4}, knots_v[] = {0, 0, 1, 2, 3, 3};
    static const double corners[5][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    static const double size[4] = {0, 1, 1, 0}, height[4] = {-1, -1, 1, 1};
    static double poles[3 * 20];
    for (size_t i = 0; i < 5; i++) {
        for (size_t j = 0; j < 4; j++) {
            double *pole = poles + 3 * (4 * i + j);
            pole[0] = size[j] * corners[i][0];
            pole[1] = size[j] * corners[i][1];
            pole[2] = height[j];
        }
    }
    return surface_data(1, 1, 5, 4, knots, knots_v, poles, NULL);
}

/* Signed distance to the cube. */
static double cube_distance(const double p[3]) {
    double most = -1e300, square = 0;
    for (int k = 0; k < 3; k++) {
        double beyond = fabs(p[k]) - 1;
        if (beyond > most) most = beyond;
        if (beyond > 0) square += beyond * beyond;
    }
    return most <= 0 ? most : sqrt(square);
}

static void a_cube_has_the_signed_distances_of_its_solid(void) {
    static const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    static fpt_foot_point feet[POINTS];
    static double normals[3 * POINTS], distances[POINTS];
    static uint32_t flags[POINTS];
    double *points = scattered_points(POINTS, low, high, 0.5);
    fpt_surface *cube = make_surface(cube_surface());
    size_t creases = 0;
    CHECK_OK(fpt_surface_closest(cube, points, POINTS, NULL, feet));
    CHECK_OK(fpt_surface_normals(cube, points, feet, POINTS, normals, distances, flags));
    for (size_t i = 0; i < POINTS; i++) {
        const double *n = normals + 3 * i;
        CHECK_NEAR(distances[i], cube_distance(points + 3 * i), 1e-9);
        CHECK_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-14);
        CHECK(!(flags[i] & (FPT_NORMAL_AMBIGUOUS_SIDE | FPT_NORMAL_UNDEFINED)));
        creases += (flags[i] & FPT_NORMAL_CREASE) != 0;
    }
    CHECK(creases > POINTS / 4 && creases < POINTS);
    /* Normals alone, without the other arrays. */
    double again[3 * 10];
    CHECK_OK(fpt_surface_normals(cube, NULL, feet, 10, again, NULL, NULL));
    CHECK_SAME_BITS(again, normals, sizeof again);
    CHECK_OK(fpt_surface_normals(cube, NULL, NULL, 0, NULL, NULL, NULL));
    fpt_surface_free(cube);
    free(points);
}

static void the_tip_of_a_cone_has_its_axis_and_a_border_no_side(void) {
    const double points[3 * 3] = {1, 0, 5, 1, 0, -4, 3, 0, 1};
    fpt_foot_point feet[3];
    double normals[9], distances[3];
    uint32_t flags[3];
    fpt_surface *cone = make_surface(cone_surface());
    CHECK_OK(fpt_surface_closest(cone, points, 3, NULL, feet));
    CHECK_OK(fpt_surface_normals(cone, points, feet, 3, normals, distances, flags));
    CHECK(flags[0] == (FPT_NORMAL_CREASE | FPT_NORMAL_LIMIT));
    CHECK_NEAR(normals[2], 1, 1e-12);
    CHECK_NEAR(distances[0], 2, 1e-15);
    /* Below the open end of the cone. */
    CHECK(flags[1] & FPT_NORMAL_AMBIGUOUS_SIDE);
    CHECK(!(flags[2] & FPT_NORMAL_AMBIGUOUS_SIDE) && distances[2] > 0);
    fpt_surface_free(cone);
}

static void feet_that_were_not_found_have_no_normal(void) {
    const double points[3 * 2] = {NAN, 0, 0, 1, 0, 5};
    fpt_foot_point feet[2];
    double normals[6], distances[2], both[4];
    uint32_t flags[2];
    fpt_surface *cone = make_surface(cone_surface());
    CHECK_OK(fpt_surface_closest(cone, points, 2, NULL, feet));
    CHECK_OK(fpt_surface_normals(cone, points, feet, 2, normals, distances, flags));
    CHECK(flags[0] == (FPT_NORMAL_UNDEFINED | FPT_NORMAL_AMBIGUOUS_SIDE));
    CHECK(isnan(normals[0]) && isnan(distances[0]) && !isnan(distances[1]));
    CHECK_OK(fpt_surface_uncertainty(cone, feet, 2, 0, both));
    CHECK(isnan(both[0]) && isnan(both[1]) && both[2] == 4 && both[3] < 1e-9);
    fpt_surface_free(cone);
}

static void tangents_lead_along_the_curve(void) {
    static const double knots[] = {0, 0, 1, 2, 2}, poles[] = {0, 0, 0, 1, 0, 0, 1, 2, 0};
    fpt_foot_point feet[3];
    double tangents[9];
    uint32_t flags[3];
    const double points[9] = {0.5, -1, 0, 2, -1, 0, 3, 1, 0};
    fpt_curve *corner = make_curve(curve_data(1, 3, knots, poles, NULL));
    CHECK_OK(fpt_curve_closest(corner, points, 3, NULL, feet));
    CHECK_OK(fpt_curve_tangents(corner, feet, 3, tangents, flags));
    CHECK(tangents[0] == 1 && tangents[4] == 1 && tangents[7] == 1);
    CHECK(flags[0] == 0 && flags[1] == FPT_NORMAL_CREASE && flags[2] == 0);
    CHECK_OK(fpt_curve_tangents(corner, feet, 3, tangents, NULL));
    fpt_curve_free(corner);
}

static void one_sided_derivatives_are_those_of_their_piece(void) {
    static const double knots[] = {0, 0, 1, 2, 2}, poles[] = {0, 0, 0, 1, 0, 0, 1, 2, 0};
    double below[6], above[6], usual[6], at_start[6];
    fpt_curve *corner = make_curve(curve_data(1, 3, knots, poles, NULL));
    CHECK_OK(fpt_curve_evaluate_sided(corner, 1, -1, 1, below));
    CHECK_OK(fpt_curve_evaluate_sided(corner, 1, 1, 1, above));
    CHECK_OK(fpt_curve_evaluate_sided(corner, 1, 0, 1, usual));
    CHECK(below[3] == 1 && below[4] == 0 && above[3] == 0 && above[4] == 2);
    CHECK_SAME_BITS(usual, above, sizeof usual);
    CHECK_OK(fpt_curve_evaluate(corner, 1, 1, usual));
    CHECK_SAME_BITS(usual, above, sizeof usual);
    CHECK_OK(fpt_curve_evaluate_sided(corner, 0, -1, 1, at_start));
    CHECK(at_start[3] == 1);
    fpt_curve_free(corner);

    double sides[4][9];
    fpt_surface *cube = make_surface(cube_surface());
    for (int k = 0; k < 4; k++) CHECK_OK(fpt_surface_evaluate_sided(cube, 1, 1, k & 1 ? 1 : -1, k & 2 ? 1 : -1, 1, sides[k]));
    /* Along u: the face x = 1 before, y = 1 after; along v: the bottom below, the side above. */
    CHECK(sides[0][4] == 2 && sides[1][3] == -2 && sides[0][8] == 0 && sides[2][8] == 2);
    CHECK_OK(fpt_surface_evaluate_sided(cube, 1, 1, 0, 0, 1, sides[0]));
    CHECK_SAME_BITS(sides[0], sides[3], sizeof sides[0]);
    fpt_surface_free(cube);
}

/* Off the knots the curve moves by speed times step. */
static void uncertainty_is_accuracy_over_speed(void) {
    const double points[6] = {3, 3, 0, 1, 7, 0};
    fpt_foot_point feet[2];
    double found[2], jet[6];
    fpt_curve *circle = make_curve(circle_curve());
    CHECK_OK(fpt_curve_closest(circle, points, 2, NULL, feet));
    CHECK_OK(fpt_curve_uncertainty(circle, feet, 2, 1e-6, found));
    for (int i = 0; i < 2; i++) {
        CHECK_OK(fpt_curve_evaluate(circle, feet[i].u, 1, jet));
        CHECK_NEAR(found[i] * sqrt(jet[3] * jet[3] + jet[4] * jet[4]), 1e-6, 1e-9);
    }
    CHECK_OK(fpt_curve_uncertainty(circle, feet, 2, 100, found));
    CHECK(found[0] == 4);
    fpt_curve_free(circle);
}

static void bad_arguments_are_named(void) {
    fpt_curve *curve = make_curve(circle_curve());
    fpt_surface *surface = make_surface(cone_surface());
    fpt_foot_point foot, outside;
    double out[9], distance;
    uint32_t flags;
    const double point[3] = {5, 1, 0};
    fill_pattern(out, sizeof out);
    CHECK_OK(fpt_surface_closest(surface, point, 1, NULL, &foot));
    outside = foot;
    outside.v = 1.5;
    CHECK_ERROR(fpt_surface_normals(NULL, point, &foot, 1, out, NULL, NULL), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_surface_normals(surface, point, NULL, 1, out, NULL, NULL), FPT_NULL_ARGUMENT, "feet");
    CHECK_ERROR(fpt_surface_normals(surface, point, &foot, 1, NULL, NULL, NULL), FPT_NULL_ARGUMENT, "out_normals");
    CHECK_ERROR(fpt_surface_normals(surface, NULL, &foot, 1, out, &distance, NULL), FPT_NULL_ARGUMENT, "points");
    CHECK_ERROR(fpt_surface_normals(surface, point, &outside, 1, out, NULL, &flags), FPT_INVALID_ARGUMENT, "feet: v of entry 0");
    CHECK_ERROR(fpt_surface_normals(surface, point, &foot, SIZE_MAX / 8, out, NULL, NULL), FPT_INVALID_ARGUMENT, "overflow");
    CHECK_ERROR(fpt_surface_uncertainty(surface, &outside, 1, 0, out), FPT_INVALID_ARGUMENT, "feet: v of entry 0");
    CHECK_ERROR(fpt_surface_uncertainty(surface, &foot, 1, -1, out), FPT_INVALID_ARGUMENT, "accuracy");
    CHECK_ERROR(fpt_surface_uncertainty(surface, &foot, 1, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_evaluate_sided(surface, 0, 0, 2, 0, 1, out), FPT_INVALID_ARGUMENT, "side_u: 2");
    CHECK_ERROR(fpt_surface_evaluate_sided(surface, 0, 0, 0, -2, 1, out), FPT_INVALID_ARGUMENT, "side_v: -2");
    CHECK_ERROR(fpt_surface_evaluate_sided(surface, 0, 2, 0, 0, 1, out), FPT_INVALID_ARGUMENT, "v");
    CHECK_ERROR(fpt_surface_evaluate_sided(surface, 0, 0, 0, 0, 32, out), FPT_INVALID_ARGUMENT, "derivatives");
    outside.u = 4.5;
    CHECK_ERROR(fpt_curve_tangents(curve, &outside, 1, out, NULL), FPT_INVALID_ARGUMENT, "feet: u of entry 0");
    CHECK_ERROR(fpt_curve_tangents(NULL, &foot, 1, out, NULL), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_tangents(curve, &foot, 1, NULL, NULL), FPT_NULL_ARGUMENT, "out_tangents");
    CHECK_ERROR(fpt_curve_uncertainty(curve, &foot, 1, NAN, out), FPT_INVALID_ARGUMENT, "accuracy");
    CHECK_ERROR(fpt_curve_uncertainty(curve, NULL, 1, 0, out), FPT_NULL_ARGUMENT, "feet");
    CHECK_ERROR(fpt_curve_evaluate_sided(curve, 0, 3, 1, out), FPT_INVALID_ARGUMENT, "side: 3");
    CHECK_ERROR(fpt_curve_evaluate_sided(curve, 5, 0, 1, out), FPT_INVALID_ARGUMENT, "u");
    CHECK_ERROR(fpt_curve_evaluate_sided(curve, 0, 0, 1, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK(is_pattern(out, sizeof out));
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

int main(void) {
    RUN(a_cube_has_the_signed_distances_of_its_solid);
    RUN(the_tip_of_a_cone_has_its_axis_and_a_border_no_side);
    RUN(feet_that_were_not_found_have_no_normal);
    RUN(tangents_lead_along_the_curve);
    RUN(one_sided_derivatives_are_those_of_their_piece);
    RUN(uncertainty_is_accuracy_over_speed);
    RUN(bad_arguments_are_named);
    return check_report("normals");
}
