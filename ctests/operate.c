/* Operations on curves and surfaces: what is exact stays, what is not keeps its proven error; then everything that is refused. */
#include "samples.h"

static fpt_curve *circle(void) {
    static const double h = 0.70710678118654752440;
    static const double knots[] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    static const double poles[] = {1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0, -1, 0, 0, -1, -1, 0, 0, -1, 0, 1, -1, 0, 1, 0, 0};
    const double weights[] = {1, h, 1, h, 1, h, 1, h, 1};
    return make_curve(curve_data(2, 9, knots, poles, weights));
}

static fpt_surface *patch(void) {
    static const double knots_u[] = {0, 0, 0, 0.5, 1, 1, 1}, knots_v[] = {0, 0, 0, 0, 2, 2, 2, 2};
    double poles[48];
    fpt_surface_data data;
    fpt_surface *out = NULL;
    for (int k = 0; k < 16; k++) {
        poles[3 * k] = k / 4;
        poles[3 * k + 1] = k % 4;
        poles[3 * k + 2] = (k * 7 % 5) * 0.3;
    }
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.degree_u = 2;
    data.degree_v = 3;
    data.pole_count_u = data.pole_count_v = 4;
    data.knots_u = knots_u;
    data.knots_v = knots_v;
    data.poles = poles;
    CHECK_OK(fpt_surface_new(&data, &out));
    return out;
}

/* How far two curves over one domain are apart, released afterwards. */
static double apart(const fpt_curve *a, fpt_curve *b) {
    fpt_difference difference = {-1, -1, 0, 0};
    CHECK_OK(fpt_curve_difference(a, b, &difference));
    CHECK(difference.reached <= difference.bound);
    fpt_curve_free(b);
    return difference.bound;
}

static double surfaces_apart(const fpt_surface *a, fpt_surface *b) {
    fpt_difference difference = {-1, -1, 0, 0};
    CHECK_OK(fpt_surface_difference(a, b, &difference));
    fpt_surface_free(b);
    return difference.bound;
}

static void exact_operations_leave_a_curve(void) {
    static const double added[] = {0.5, 3.25, 0.5};
    fpt_curve *curve = circle(), *other = NULL, *back = NULL;
    double error = -1;
    size_t count = 0;
    CHECK_OK(fpt_curve_refine(curve, added, 3, &other));
    CHECK_OK(fpt_curve_pole_count(other, &count));
    CHECK(count == 12);
    CHECK_OK(fpt_curve_remove_knot(other, 0.5, 2, &error, &back));
    CHECK(error >= 0 && error < 1e-12);
    CHECK_NEAR(apart(curve, back), 0, 1e-12);
    CHECK_OK(fpt_curve_simplify(other, 1e-10, NULL, &back));
    CHECK_OK(fpt_curve_pole_count(back, &count));
    CHECK(count == 9);
    fpt_curve_free(back);
    CHECK_NEAR(apart(curve, other), 0, 1e-13);
    CHECK_OK(fpt_curve_elevate(curve, 2, &other));
    CHECK_OK(fpt_curve_reduce(other, &error, &back));
    CHECK(error < 1e-12);
    CHECK_NEAR(apart(other, back), 0, 1e-12);
    CHECK_NEAR(apart(curve, other), 0, 1e-12);
    CHECK_OK(fpt_curve_periodic(curve, 1e-9, &error, &other));
    CHECK_OK(fpt_curve_clamp(other, &back));
    CHECK_NEAR(apart(curve, back), 0, 1e-12);
    CHECK_NEAR(apart(curve, other), 0, 1e-12);
    CHECK_OK(fpt_curve_unclamp(curve, &error, &other));
    CHECK_NEAR(apart(curve, other), 0, error + 1e-12);
    CHECK_OK(fpt_curve_bezier_form(curve, &other));
    CHECK_NEAR(apart(curve, other), 0, 1e-13);
    CHECK_OK(fpt_curve_reverse(curve, &other));
    CHECK_OK(fpt_curve_reverse(other, &back));
    fpt_curve_free(other);
    CHECK_NEAR(apart(curve, back), 0, 1e-13);
    fpt_curve_free(curve);
}

static void parts_join_to_the_whole(void) {
    fpt_curve *curve = circle(), *parts[2], *joined = NULL;
    double error = -1;
    CHECK_OK(fpt_curve_split(curve, 1.5, &parts[0], &parts[1]));
    CHECK_OK(fpt_curve_join((const fpt_curve *const *)parts, 2, 1e-9, &error, &joined));
    CHECK(error < 1e-12);
    CHECK_NEAR(apart(curve, joined), 0, 1e-12);
    fpt_curve_free(parts[1]);
    CHECK_OK(fpt_curve_part(curve, 0, 1.5, &joined));
    CHECK_NEAR(apart(parts[0], joined), 0, 1e-13);
    fpt_curve_free(parts[0]);
    fpt_curve_free(curve);
}

static void maps_and_parameters(void) {
    static const double move[] = {2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 1, 3};
    static const double lens[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.25, 0, 0, 1};
    fpt_curve *curve = circle(), *other = NULL;
    double p[3], d[6], q[3];
    CHECK_OK(fpt_curve_affine(curve, move, &other));
    CHECK_OK(fpt_curve_evaluate(other, 1, 0, p));
    CHECK_NEAR(p[0], 1, 1e-15);
    CHECK_NEAR(p[1], 2, 1e-15);
    CHECK_NEAR(p[2], 3, 1e-15);
    fpt_curve_free(other);
    CHECK_OK(fpt_curve_projective(curve, lens, &other));
    CHECK_OK(fpt_curve_evaluate(other, 0, 0, p));
    CHECK_NEAR(p[0], 0.8, 1e-15);
    fpt_curve_free(other);
    CHECK_OK(fpt_curve_derivative(curve, &other));
    CHECK_OK(fpt_curve_evaluate(curve, 0.3, 1, d));
    CHECK_OK(fpt_curve_evaluate(other, 0.3, 0, p));
    for (int x = 0; x < 3; x++) CHECK_NEAR(p[x], d[3 + x], 1e-13);
    fpt_curve_free(other);
    CHECK_OK(fpt_curve_with_domain(curve, 10, 12, &other));
    CHECK_OK(fpt_curve_evaluate(other, 11, 0, p));
    CHECK_NEAR(p[0], -1, 1e-15);
    fpt_curve_free(other);
    /* Share 1/2 of the domain goes to 3 / (1 + 3) of it. */
    CHECK_OK(fpt_curve_reparametrise(curve, 3, &other));
    CHECK_OK(fpt_curve_evaluate(other, 3, 0, p));
    CHECK_OK(fpt_curve_evaluate(curve, 2, 0, q));
    for (int x = 0; x < 3; x++) CHECK_NEAR(p[x], q[x], 1e-14);
    fpt_curve_free(other);
    fpt_curve_free(curve);
}

static void a_length_and_back(void) {
    static const double tau = 6.28318530717958647692;
    fpt_curve *curve = circle();
    fpt_arc_length *length = NULL;
    fpt_estimate total, at[2], u[2];
    const double places[] = {1, 4}, lengths[] = {0.25 * 6.28318530717958647692, 0};
    CHECK_OK(fpt_arc_length_new(curve, 0, &length));
    fpt_curve_free(curve);
    CHECK_OK(fpt_arc_length_total(length, &total));
    CHECK_NEAR(total.value, tau, total.error);
    CHECK(total.error < 1e-11);
    CHECK_OK(fpt_arc_length_at(length, places, 2, at));
    CHECK_NEAR(at[0].value, tau / 4, at[0].error);
    CHECK_OK(fpt_arc_length_parameters(length, lengths, 2, u));
    CHECK_NEAR(u[0].value, 1, 1e-11);
    CHECK_NEAR(u[1].value, 0, 0);
    CHECK_ERROR(fpt_arc_length_parameters(length, lengths, 1, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_arc_length_at(length, &tau, 1, at), FPT_INVALID_ARGUMENT, "outside the domain");
    fpt_arc_length_free(length);
    fpt_arc_length_free(NULL);
}

static void measures_of_a_circle(void) {
    fpt_curve *curve = circle(), *piece = NULL;
    fpt_curve_frame_record frame;
    fpt_joint joints[4];
    double power[48];
    size_t count = 0;
    CHECK_OK(fpt_curve_frame(curve, 0.7, 1, &frame));
    CHECK_NEAR(frame.curvature, 1, 1e-13);
    CHECK_NEAR(frame.torsion, 0, 1e-13);
    CHECK_NEAR(frame.binormal[2], 1, 1e-13);
    CHECK_OK(fpt_curve_continuity(curve, 1e-9, 4, joints, &count));
    CHECK(count == 4 && joints[0].order == 1 && joints[0].multiplicity == 2);
    CHECK_NEAR(joints[3].tangent_angle, 0, 1e-13);
    CHECK_NEAR(joints[3].curvature_jump, 0, 1e-12);
    CHECK_OK(fpt_curve_power(curve, 48, power, &count));
    CHECK(count == 48);
    CHECK_OK(fpt_curve_from_power(2, 0, 1, power, &piece));
    fpt_curve *part = NULL;
    CHECK_OK(fpt_curve_part(curve, 0, 1, &part));
    CHECK_NEAR(apart(piece, part), 0, 1e-13);
    fpt_curve_free(piece);
    CHECK_ERROR(fpt_curve_power(curve, 47, power, &count), FPT_INVALID_ARGUMENT, "capacity");
    fpt_curve_free(curve);
}

static void curves_become_compatible(void) {
    fpt_curve *list[2] = {circle(), NULL}, *out[2] = {NULL, NULL};
    size_t degree = 0, count[2];
    CHECK_OK(fpt_curve_elevate(list[0], 1, &list[1]));
    CHECK_OK(fpt_curve_make_compatible((const fpt_curve *const *)list, 2, out));
    for (int i = 0; i < 2; i++) {
        CHECK_OK(fpt_curve_degree(out[i], &degree));
        CHECK_OK(fpt_curve_pole_count(out[i], &count[i]));
        CHECK(degree == 3 && count[i] == count[0]);
        CHECK_NEAR(apart(list[i], out[i]), 0, 1e-12);
        fpt_curve_free(list[i]);
    }
}

static void surfaces_stay_too(void) {
    static const double added[] = {0.25}, sub[] = {0, 0.5, 0, 1}, whole[] = {0, 1, 0, 2};
    static const double move[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    static const double lens[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    fpt_surface *surface = patch(), *other = NULL, *back = NULL, *parts[2];
    fpt_curve *curve = NULL;
    double error = -1, p[3], q[3];
    for (uint32_t direction = 0; direction < 2; direction++) {
        CHECK_OK(fpt_surface_refine(surface, direction, added, 1, &other));
        CHECK_OK(fpt_surface_remove_knot(other, direction, 0.25, 1, &error, &back));
        CHECK_NEAR(surfaces_apart(surface, back), 0, 1e-12);
        CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
        CHECK_OK(fpt_surface_elevate(surface, direction, 1, &other));
        CHECK_OK(fpt_surface_reduce(other, direction, &error, &back));
        CHECK_NEAR(surfaces_apart(surface, back), 0, 1e-12);
        CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
        CHECK_OK(fpt_surface_reverse(surface, direction, &other));
        CHECK_OK(fpt_surface_reverse(other, direction, &back));
        fpt_surface_free(other);
        CHECK_NEAR(surfaces_apart(surface, back), 0, 1e-12);
        CHECK_OK(fpt_surface_unclamp(surface, direction, &error, &other));
        CHECK_NEAR(surfaces_apart(surface, other), 0, error + 1e-12);
        CHECK_OK(fpt_surface_split(surface, direction, 0.3, &parts[0], &parts[1]));
        CHECK_OK(fpt_surface_join((const fpt_surface *const *)parts, 2, direction, 1e-9, &error, &other));
        CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
        CHECK_OK(fpt_surface_make_compatible((const fpt_surface *const *)parts, 1, &other));
        CHECK_NEAR(surfaces_apart(parts[0], other), 0, 1e-12);
        fpt_surface_free(parts[0]);
        fpt_surface_free(parts[1]);
        CHECK_OK(fpt_surface_isocurve(surface, direction, 0.3, &curve));
        CHECK_OK(fpt_curve_evaluate(curve, 0.6, 0, p));
        CHECK_OK(direction ? fpt_surface_evaluate(surface, 0.6, 0.3, 0, q) : fpt_surface_evaluate(surface, 0.3, 0.6, 0, q));
        for (int x = 0; x < 3; x++) CHECK_NEAR(p[x], q[x], 1e-14);
        fpt_curve_free(curve);
        CHECK_OK(fpt_surface_derivative(surface, direction, &other));
        fpt_surface_free(other);
        CHECK_OK(fpt_surface_reparametrise(surface, direction, 2, &other));
        fpt_surface_free(other);
        CHECK_ERROR(fpt_surface_periodic(surface, direction, 1e-9, NULL, &other), FPT_INVALID_ARGUMENT, "not closed");
    }
    CHECK_OK(fpt_surface_swap(surface, &other));
    CHECK_OK(fpt_surface_swap(other, &back));
    fpt_surface_free(other);
    CHECK_NEAR(surfaces_apart(surface, back), 0, 1e-12);
    CHECK_OK(fpt_surface_part(surface, sub, &other));
    fpt_surface_free(other);
    CHECK_OK(fpt_surface_with_domain(surface, whole, &other));
    CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
    CHECK_OK(fpt_surface_clamp(surface, &other));
    CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
    CHECK_OK(fpt_surface_bezier_form(surface, &other));
    CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
    CHECK_OK(fpt_surface_simplify(surface, 1e-9, &error, &other));
    CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-9);
    CHECK_OK(fpt_surface_affine(surface, move, &other));
    CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
    CHECK_OK(fpt_surface_projective(surface, lens, &other));
    CHECK_NEAR(surfaces_apart(surface, other), 0, 1e-12);
    fpt_surface_free(surface);
}

static void knot_lines_and_powers_of_surfaces(void) {
    fpt_surface *surface = patch(), *finer, *back;
    fpt_knot_line lines[8];
    double numbers[4 * 31 * 31];
    const size_t p = 2, q = 3;
    size_t count = 99;
    static const double twice[] = {0.5, 0.5}, unit[] = {0, 1, 0, 1}, first[] = {0, 0.5, 0, 2};
    CHECK_OK(fpt_surface_refine(surface, FPT_DIRECTION_V, twice, 2, &finer));
    CHECK_OK(fpt_surface_continuity(finer, FPT_DIRECTION_V, 1e-9, 8, lines, &count));
    CHECK(count >= 1);
    for (size_t i = 0; i < count; i++) {
        CHECK(lines[i].gap <= 1e-12 && lines[i].order >= 1);
        if (lines[i].value == 0.5) CHECK(lines[i].multiplicity >= 2 && lines[i].first_jump <= 1e-11);
    }
    CHECK_OK(fpt_surface_continuity(finer, FPT_DIRECTION_V, 1e-9, 0, NULL, &count));
    CHECK_ERROR(fpt_surface_continuity(finer, 7, 1e-9, 8, lines, &count), FPT_INVALID_ARGUMENT, "direction: 7");
    CHECK_ERROR(fpt_surface_continuity(finer, 0, NAN, 8, lines, &count), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_surface_continuity(finer, 0, 0, 8, NULL, &count), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_continuity(finer, 0, 0, 8, lines, NULL), FPT_NULL_ARGUMENT, "out_count");
    CHECK_ERROR(fpt_surface_continuity(NULL, 0, 0, 8, lines, &count), FPT_NULL_ARGUMENT, "surface");
    fpt_surface_free(finer);

    CHECK_OK(fpt_surface_power(surface, sizeof numbers / sizeof *numbers, numbers, &count));
    CHECK(count == 4 * 2 * (p + 1) * (q + 1));
    CHECK_OK(fpt_surface_part(surface, first, &finer));
    CHECK_OK(fpt_surface_from_power(p, q, first, numbers, &back));
    CHECK_NEAR(surfaces_apart(finer, back), 0, 1e-12);
    fpt_surface_free(finer);
    back = surface;
    CHECK_ERROR(fpt_surface_power(surface, count - 1, numbers, &count), FPT_INVALID_ARGUMENT, "capacity");
    CHECK_ERROR(fpt_surface_power(surface, count, NULL, &count), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_from_power(0, q, unit, numbers, &back), FPT_INVALID_ARGUMENT, "degree_u: 0");
    CHECK_ERROR(fpt_surface_from_power(p, SIZE_MAX, unit, numbers, &back), FPT_INVALID_ARGUMENT, "degree_v");
    CHECK_ERROR(fpt_surface_from_power(p, q, NULL, numbers, &back), FPT_NULL_ARGUMENT, "domain");
    CHECK_ERROR(fpt_surface_from_power(p, q, unit, NULL, &back), FPT_NULL_ARGUMENT, "coefficients");
    CHECK_ERROR(fpt_surface_from_power(p, q, unit, numbers, NULL), FPT_NULL_ARGUMENT, "out");
    numbers[0] = INFINITY;
    CHECK_ERROR(fpt_surface_from_power(p, q, unit, numbers, &back), FPT_INVALID_ARGUMENT, "coefficient 0");
    numbers[0] = 0;
    numbers[3] = -1;
    CHECK_ERROR(fpt_surface_from_power(p, q, unit, numbers, &back), FPT_UNSUPPORTED, "weight");
    CHECK(back == surface);
    fpt_surface_free(surface);
}

static void what_is_refused_is_named_and_writes_nothing(void) {
    static const double bad[] = {0.5, 9}, nan[] = {NAN, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    fpt_curve *curve = circle(), *out = curve, *list[2];
    fpt_surface *surface = patch(), *sheet = surface;
    double error = 7;
    CHECK_ERROR(fpt_curve_refine(NULL, bad, 2, &out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_refine(curve, NULL, 2, &out), FPT_NULL_ARGUMENT, "values");
    CHECK_ERROR(fpt_curve_refine(curve, bad, 2, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_curve_refine(curve, bad, 2, &out), FPT_INVALID_ARGUMENT, "values[1] = 9");
    CHECK_ERROR(fpt_curve_refine(curve, bad, SIZE_MAX, &out), FPT_INVALID_ARGUMENT, "values");
    CHECK_ERROR(fpt_curve_elevate(curve, SIZE_MAX, &out), FPT_INVALID_ARGUMENT, "degree");
    CHECK_ERROR(fpt_curve_remove_knot(curve, 0.5, 1, &error, &out), FPT_INVALID_ARGUMENT, "u: 0.5");
    CHECK_ERROR(fpt_curve_remove_knot(curve, 1, SIZE_MAX, &error, &out), FPT_INVALID_ARGUMENT, "times");
    CHECK_ERROR(fpt_curve_simplify(curve, NAN, &error, &out), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_curve_part(curve, 1, 1, &out), FPT_INVALID_ARGUMENT, "end");
    CHECK_ERROR(fpt_curve_with_domain(curve, 1, INFINITY, &out), FPT_INVALID_ARGUMENT, "domain");
    CHECK_ERROR(fpt_curve_reparametrise(curve, 0, &out), FPT_INVALID_ARGUMENT, "speed");
    CHECK_ERROR(fpt_curve_affine(curve, nan, &out), FPT_INVALID_ARGUMENT, "matrix: entry (0, 0)");
    CHECK_ERROR(fpt_curve_projective(curve, nan, &out), FPT_INVALID_ARGUMENT, "matrix");
    CHECK_ERROR(fpt_curve_join(NULL, 0, 0, NULL, &out), FPT_INVALID_ARGUMENT, "curves: none");
    list[0] = curve;
    list[1] = NULL;
    CHECK_ERROR(fpt_curve_join((const fpt_curve *const *)list, 2, 0, NULL, &out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_make_compatible(NULL, 0, &out), FPT_INVALID_ARGUMENT, "curves: none");
    CHECK_ERROR(fpt_curve_from_power(0, 0, 1, nan, &out), FPT_INVALID_ARGUMENT, "degree");
    CHECK_ERROR(fpt_curve_from_power(40, 0, 1, nan, &out), FPT_INVALID_ARGUMENT, "degree");
    CHECK_ERROR(fpt_curve_from_power(1, 0, 1, nan, &out), FPT_INVALID_ARGUMENT, "coefficients");
    CHECK_ERROR(fpt_surface_elevate(surface, 2, 1, &sheet), FPT_INVALID_ARGUMENT, "direction: 2");
    CHECK_ERROR(fpt_surface_isocurve(surface, 0, NAN, &out), FPT_INVALID_ARGUMENT, "at");
    CHECK_ERROR(fpt_surface_part(surface, nan, &sheet), FPT_INVALID_ARGUMENT, "start_u");
    CHECK_ERROR(fpt_surface_reduce(NULL, 0, &error, &sheet), FPT_NULL_ARGUMENT, "surface");
    CHECK(out == curve && sheet == surface && error == 7);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

int main(void) {
    RUN(exact_operations_leave_a_curve);
    RUN(parts_join_to_the_whole);
    RUN(maps_and_parameters);
    RUN(a_length_and_back);
    RUN(measures_of_a_circle);
    RUN(curves_become_compatible);
    RUN(surfaces_stay_too);
    RUN(knot_lines_and_powers_of_surfaces);
    RUN(what_is_refused_is_named_and_writes_nothing);
    return check_report("operate");
}
