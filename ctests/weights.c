/* Weights from wishes: methods, reports, edits, forms; then everything that is refused. */
#include "samples.h"

static const double half = 0.70710678118654752440;

/* Poles 4, 6 and 5 above a chord of length 12. */
static fpt_curve *arch(void) {
    static const double knots[] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    static const double poles[] = {0, 0, 0, 3, 4, 0, 6, 6, 0, 9, 5, 0, 12, 0, 0};
    return make_curve(curve_data(4, 5, knots, poles, NULL));
}

static fpt_curve *corner(void) {
    static const double knots[] = {0, 0, 0, 1, 1, 1};
    static const double poles[] = {1, 0, 0, 1, 1, 0, 0, 1, 0};
    return make_curve(curve_data(2, 3, knots, poles, NULL));
}

static fpt_weights_options defaults(void) {
    fpt_weights_options options;
    fpt_weights_options_init(&options, sizeof options);
    return options;
}

static void null_may_be_freed(void) { fpt_weights_report_free(NULL); }

static void the_formulas_give_tables_made_by_hand(void) {
    static const double lambdas[] = {0.9, 0.25, 0.5, 0.8, 0.1}, expected[] = {1, 3, 1, 0.25, 1};
    static const double run[] = {1, 5.0 / 3, 2, 1, 1};
    fpt_curve *curve = arch();
    fpt_weights_report *report = NULL;
    double weights[5];
    size_t count = 0;
    CHECK_OK(fpt_weights_general(curve, lambdas, 5, NULL, &report));
    CHECK_OK(fpt_weights_report_pole_count(report, &count));
    CHECK(count == 5);
    CHECK_OK(fpt_weights_report_weights(report, 5, weights));
    for (size_t i = 0; i < 5; i++) CHECK_NEAR(weights[i], expected[i], 1e-14);
    fpt_weights_report_free(report);
    CHECK_OK(fpt_weights_interpolated(curve, 1, 3, NULL, &report));
    CHECK_OK(fpt_weights_report_weights(report, 5, weights));
    for (size_t i = 0; i < 5; i++) CHECK_NEAR(weights[i], run[i], 1e-14);
    fpt_weights_report_free(report);
    fpt_curve_free(curve);
}

static void a_network_is_the_same_twice_and_within_its_range(void) {
    static const size_t poles[] = {2};
    static const double distances[] = {1.5};
    fpt_curve *curve = arch();
    fpt_weights_options options = defaults();
    double weights[2][5];
    options.seed = 42;
    for (int i = 0; i < 2; i++) {
        fpt_weights_report *report = NULL;
        fpt_weights_summary summary;
        CHECK_OK(fpt_weights_network(curve, poles, distances, 1, 1, 2, &options, &report));
        CHECK_OK(fpt_weights_report_weights(report, 5, weights[i]));
        CHECK_OK(fpt_weights_report_summary(report, &summary));
        CHECK(summary.iterations > 0 && summary.iterations < 100 && summary.starts == 0);
        fpt_weights_report_free(report);
    }
    CHECK_SAME_BITS(weights[0], weights[1], sizeof weights[0]);
    CHECK_NEAR(weights[0][2], 3, 1e-12);
    CHECK(weights[0][1] >= 1 && weights[0][1] <= 3 && weights[0][3] >= 1.5 && weights[0][3] <= 4);
    fpt_curve_free(curve);
}

static void a_quarter_circle_is_found_from_the_distance_of_its_pole(void) {
    static const size_t poles[] = {1};
    const double distances[] = {sqrt(2.0) - 1};
    fpt_curve *curve = corner(), *circle = NULL;
    fpt_weights_report *report = NULL;
    fpt_weights_pole pole;
    fpt_weights_summary summary;
    fpt_surface *surface = NULL;
    double point[3];
    CHECK_OK(fpt_weights_refine_curve(curve, poles, distances, 1, NULL, 0, NULL, &report));
    fpt_curve_free(curve);
    CHECK_OK(fpt_weights_report_pole(report, 1, &pole));
    CHECK_NEAR(pole.weight, half, 1e-12);
    CHECK_NEAR(pole.distance, distances[0], 1e-14);
    CHECK(pole.state == FPT_WISH_MET && pole.lower_bound <= pole.distance && pole.flags == 0);
    CHECK_NEAR(pole.u, 0.5, 1e-7);
    CHECK_OK(fpt_weights_report_summary(report, &summary));
    CHECK(summary.is_met == 1 && summary.met == 1 && summary.not_met == 0 && summary.impossible == 0);
    CHECK(summary.tolerance > 0 && summary.starts == 1);
    CHECK_OK(fpt_weights_report_curve(report, &circle));
    CHECK_ERROR(fpt_weights_report_surface(report, &surface), FPT_UNSUPPORTED, "report");
    fpt_weights_report_free(report);
    CHECK_OK(fpt_curve_evaluate(circle, 0.2, 0, point));
    CHECK_NEAR(hypot(point[0], point[1]), 1, 1e-12);
    fpt_curve_free(circle);
}

static void constraints_are_met_and_impossible_wishes_told(void) {
    static const size_t poles[] = {1};
    static const double distances[] = {5.1};
    fpt_curve *curve = arch();
    fpt_weights_report *report = NULL;
    fpt_weights_outcome outcome;
    fpt_weights_summary summary;
    fpt_weights_constraint constraints[2];
    memset(constraints, 0, sizeof constraints);
    constraints[0].kind = FPT_CONSTRAINT_POINT_AT;
    constraints[0].u = 0.5;
    constraints[0].vector[0] = 6.1;
    constraints[0].vector[1] = 4.6;
    constraints[1].kind = FPT_CONSTRAINT_TANGENT_KEPT;
    constraints[1].u = 0.5;
    CHECK_OK(fpt_weights_refine_curve(curve, NULL, NULL, 0, constraints, 2, NULL, &report));
    CHECK_OK(fpt_weights_report_constraint(report, 0, &outcome));
    CHECK(outcome.met == 1 && outcome.error < 1e-8 && outcome.u == 0.5);
    CHECK_OK(fpt_weights_report_constraint(report, 1, &outcome));
    CHECK(outcome.met == 1 && outcome.error < 1e-9);
    CHECK_ERROR(fpt_weights_report_constraint(report, 2, &outcome), FPT_INVALID_ARGUMENT, "index: 2");
    fpt_weights_report_free(report);
    CHECK_OK(fpt_weights_refine_curve(curve, poles, distances, 1, NULL, 0, NULL, &report));
    CHECK_OK(fpt_weights_report_summary(report, &summary));
    CHECK(summary.is_met == 0 && summary.impossible == 1);
    fpt_weights_report_free(report);
    fpt_curve_free(curve);
}

static void a_surface_gets_its_wishes(void) {
    static const double knots[] = {0, 0, 0, 1, 1, 1};
    static const double poles[] = {0, 0, 0, 0, 1, 1, 0, 2, 0, 1, 0, 1, 1, 1, 3, 1, 2, 1, 2, 0, 0, 2, 1, 1, 2, 2, 0};
    static const size_t wished[] = {4};
    static const double distances[] = {1};
    fpt_surface *surface = make_surface(surface_data(2, 2, 3, 3, knots, knots, poles, NULL)), *found = NULL;
    fpt_weights_report *report = NULL;
    fpt_curve *curve = NULL;
    fpt_foot_point foot;
    CHECK_OK(fpt_weights_refine_surface(surface, wished, distances, 1, NULL, 0, NULL, &report));
    CHECK_OK(fpt_weights_report_surface(report, &found));
    CHECK_ERROR(fpt_weights_report_curve(report, &curve), FPT_UNSUPPORTED, "report");
    CHECK_OK(fpt_surface_closest(found, poles + 12, 1, NULL, &foot));
    CHECK_NEAR(foot.distance, 1, 1e-9);
    fpt_weights_report_free(report);
    fpt_surface_free(found);
    fpt_surface_free(surface);
}

static void single_weights_move_the_curve_as_asked(void) {
    fpt_curve *curve = arch();
    const double point[3] = {6, 5, 0}, off[3] = {6, 7, 0};
    double weight = 0;
    fpt_foot_point foot;
    CHECK_OK(fpt_weights_move_point(curve, 0.5, 2, 0.25, &weight));
    CHECK(weight > 1 && weight < 2);
    CHECK_OK(fpt_weights_through_point(curve, 2, point, 0, &weight, &foot));
    CHECK(weight > 1 && foot.distance < 1e-12);
    CHECK_OK(fpt_weights_through_point(curve, 2, point, 0, &weight, NULL));
    CHECK_ERROR(fpt_weights_through_point(curve, 2, off, 0, &weight, NULL), FPT_INVALID_ARGUMENT, "no weight of pole 2");
    CHECK_ERROR(fpt_weights_move_point(curve, 0.5, 7, 0.25, &weight), FPT_INVALID_ARGUMENT, "pole: 7");
    CHECK_ERROR(fpt_weights_move_point(curve, NAN, 2, 0.25, &weight), FPT_INVALID_ARGUMENT, "u: NaN");
    CHECK_ERROR(fpt_weights_move_point(curve, 0.5, 2, NAN, &weight), FPT_INVALID_ARGUMENT, "distance");
    fpt_curve_free(curve);
}

static void conics_and_their_weights(void) {
    static const double legs[] = {1, 0, 0, 1, 1, 0, 0, 1, 0}, line[] = {0, 0, 0, 1, 1, 0, 2, 2, 0};
    const double weights[] = {1, half, 1}, bad[] = {1, -1, 1};
    fpt_weights_conic_shape shape;
    double weight = 0, found[2];
    size_t count = 9;
    CHECK_OK(fpt_weights_conic(legs, weights, &shape));
    CHECK_NEAR(shape.eccentricity, 0, 1e-7);
    CHECK_NEAR(shape.rho, sqrt(2.0) - 1, 1e-15);
    CHECK_NEAR(shape.weight, half, 1e-15);
    CHECK_OK(fpt_weights_of_rho(0.25, &weight));
    CHECK_NEAR(weight, 1.0 / 3, 1e-15);
    CHECK_OK(fpt_weights_of_eccentricity(legs, 1, found, &count));
    CHECK(count == 1 && found[0] == 1 && found[1] != found[1]);
    CHECK_ERROR(fpt_weights_conic(line, weights, &shape), FPT_INVALID_ARGUMENT, "in one line");
    CHECK_ERROR(fpt_weights_conic(legs, bad, &shape), FPT_INVALID_ARGUMENT, "weight 1");
    CHECK_ERROR(fpt_weights_of_rho(1, &weight), FPT_INVALID_ARGUMENT, "rho");
    CHECK_ERROR(fpt_weights_of_eccentricity(legs, -1, found, &count), FPT_INVALID_ARGUMENT, "eccentricity");
}

static void weights_change_as_a_whole(void) {
    static const double weights[] = {2, 8, 32}, bad[] = {1, 0, 1};
    static const double knots[] = {0, 0, 0, 1, 1, 1}, poles[] = {0, 0, 0, 1, 2, 0, 3, 0, 0};
    const double raw[] = {1, 0, 0, 1, -half, -half, 0, -half, 0, 1, 0, 1}, infinite[] = {0, 0, 0, 1, 1, 0, 0, -2, 0, 1, 0, 1};
    fpt_curve *curve = make_curve(curve_data(2, 3, knots, poles, weights)), *form = NULL;
    fpt_curve *loose = make_curve(unclamped_curve());
    double out[3], point[3];
    CHECK_OK(fpt_weights_normalise(weights, 3, FPT_UNIT_GREATEST, out));
    CHECK(out[0] == 0.0625 && out[1] == 0.25 && out[2] == 1);
    CHECK_OK(fpt_weights_bound(weights, 3, 4, out));
    CHECK_NEAR(out[2] / out[0], 4, 1e-14);
    CHECK_OK(fpt_weights_standard_form(curve, &form));
    CHECK_OK(fpt_curve_weights(form, 3, out));
    CHECK(out[0] == 1 && out[2] == 1);
    CHECK_NEAR(out[1], 1, 1e-14);
    fpt_curve_free(form);
    CHECK_OK(fpt_weights_positive_form(2, 3, knots, raw, &form));
    CHECK_OK(fpt_curve_evaluate(form, 0.5, 0, point));
    CHECK_NEAR(hypot(point[0], point[1]), 1, 1e-14);
    CHECK(point[0] < 0 && point[1] < 0);
    fpt_curve_free(form);
    form = NULL;
    CHECK_ERROR(fpt_weights_positive_form(2, 3, knots, infinite, &form), FPT_UNSUPPORTED, "u = 0.5");
    CHECK_ERROR(fpt_weights_standard_form(loose, &form), FPT_UNSUPPORTED, "clamped");
    CHECK_ERROR(fpt_weights_normalise(weights, 3, 3, out), FPT_INVALID_ARGUMENT, "unit: 3");
    CHECK_ERROR(fpt_weights_normalise(bad, 3, 0, out), FPT_INVALID_ARGUMENT, "weight 1");
    CHECK_ERROR(fpt_weights_bound(weights, 3, 0.5, out), FPT_INVALID_ARGUMENT, "ratio");
    CHECK_ERROR(fpt_weights_normalise(NULL, 3, 0, out), FPT_NULL_ARGUMENT, "weights");
    CHECK_ERROR(fpt_weights_normalise(weights, (size_t)-1, 0, out), FPT_INVALID_ARGUMENT, "weights");
    CHECK_ERROR(fpt_weights_positive_form(2, (size_t)-1, knots, raw, &form), FPT_INVALID_ARGUMENT, "pole_count");
    CHECK_ERROR(fpt_weights_positive_form(0, 3, knots, raw, &form), FPT_INVALID_ARGUMENT, "degree");
    CHECK(form == NULL);
    fpt_curve_free(loose);
    fpt_curve_free(curve);
}

static int stop(void *user) {
    (*(int *)user)++;
    return 1;
}

static void bad_input_is_named_and_nothing_is_written(void) {
    static const size_t poles[] = {1, 2}, far[] = {1, 5}, twice[] = {1, 1};
    const double distances[] = {1, 1}, negative[] = {1, -1}, not_a_number[] = {NAN, 1};
    static const double lambdas[] = {0.5, 0.5, 1, 0.5, 0.5};
    fpt_curve *curve = arch();
    fpt_weights_report *report = NULL;
    fpt_weights_options options = defaults();
    fpt_weights_constraint constraint;
    fpt_weights_pole pole;
    int asked = 0;
    size_t count;
    double weights[5];
#define REFINE(p, d, o) fpt_weights_refine_curve(curve, p, d, 2, NULL, 0, o, &report)
    CHECK_ERROR(REFINE(far, distances, NULL), FPT_INVALID_ARGUMENT, "wish 1 names pole 5 of 5");
    CHECK_ERROR(REFINE(twice, distances, NULL), FPT_INVALID_ARGUMENT, "wish 1 names pole 1 again");
    CHECK_ERROR(REFINE(poles, negative, NULL), FPT_INVALID_ARGUMENT, "wish_distances: wish 1: -1");
    CHECK_ERROR(REFINE(poles, not_a_number, NULL), FPT_INVALID_ARGUMENT, "wish_distances: wish 0: NaN");
    CHECK_ERROR(REFINE(NULL, distances, NULL), FPT_NULL_ARGUMENT, "wish_poles");
    CHECK_ERROR(REFINE(poles, NULL, NULL), FPT_NULL_ARGUMENT, "wish_distances");
    CHECK_ERROR(fpt_weights_refine_curve(NULL, poles, distances, 2, NULL, 0, NULL, &report), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_weights_refine_curve(curve, poles, distances, 2, NULL, 0, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_weights_refine_curve(curve, poles, distances, (size_t)-1, NULL, 0, NULL, &report),
                FPT_INVALID_ARGUMENT, "wish_poles");
    CHECK_ERROR(fpt_weights_refine_curve(curve, poles, distances, 2, NULL, 1, NULL, &report), FPT_NULL_ARGUMENT,
                "constraints");
    CHECK_ERROR(fpt_weights_refine_surface(NULL, poles, distances, 2, NULL, 0, NULL, &report), FPT_NULL_ARGUMENT,
                "surface");
    memset(&constraint, 0, sizeof constraint);
    constraint.kind = 4;
    CHECK_ERROR(fpt_weights_refine_curve(curve, NULL, NULL, 0, &constraint, 1, NULL, &report), FPT_INVALID_ARGUMENT,
                "constraint 0: 4");
    constraint.kind = FPT_CONSTRAINT_TANGENT_AT;
    CHECK_ERROR(fpt_weights_refine_curve(curve, NULL, NULL, 0, &constraint, 1, NULL, &report), FPT_INVALID_ARGUMENT,
                "no direction");
    constraint.reserved = 1;
    CHECK_ERROR(fpt_weights_refine_curve(curve, NULL, NULL, 0, &constraint, 1, NULL, &report), FPT_INVALID_ARGUMENT,
                "reserved");
    options.reserved = 1;
    CHECK_ERROR(REFINE(poles, distances, &options), FPT_INVALID_ARGUMENT, "reserved");
    options = defaults();
    options.weight_min = NAN;
    CHECK_ERROR(REFINE(poles, distances, &options), FPT_INVALID_ARGUMENT, "weight_min");
    options = defaults();
    options.symmetric = 2;
    CHECK_ERROR(REFINE(poles, distances, &options), FPT_INVALID_ARGUMENT, "symmetric");
    options = defaults();
    options.tolerance = -1;
    CHECK_ERROR(REFINE(poles, distances, &options), FPT_INVALID_ARGUMENT, "tolerance");
    options = defaults();
    options.struct_size = 3;
    CHECK_ERROR(REFINE(poles, distances, &options), FPT_INVALID_ARGUMENT, "struct_size");
    options = defaults();
    options.should_stop = stop;
    options.user = &asked;
    CHECK_ERROR(REFINE(poles, distances, &options), FPT_CANCELLED, "cancelled");
    CHECK(asked == 1);
    CHECK_ERROR(fpt_weights_general(curve, lambdas, 5, NULL, &report), FPT_INVALID_ARGUMENT, "lambda 2 = 1");
    CHECK_ERROR(fpt_weights_general(curve, lambdas, 4, NULL, &report), FPT_INVALID_ARGUMENT, "4 given, 5 expected");
    CHECK_ERROR(fpt_weights_general(curve, NULL, 5, NULL, &report), FPT_NULL_ARGUMENT, "lambdas");
    CHECK_ERROR(fpt_weights_interpolated(curve, -1, 1, NULL, &report), FPT_INVALID_ARGUMENT, "first_distance");
    CHECK_ERROR(fpt_weights_network(curve, poles, distances, 2, 3, 2, NULL, &report), FPT_INVALID_ARGUMENT,
                "min_distance");
    CHECK_ERROR(fpt_weights_network(curve, poles, distances, 2, 2, 3, NULL, &report), FPT_INVALID_ARGUMENT,
                "not in the range");
    CHECK(report == NULL);
    CHECK_ERROR(fpt_weights_report_pole(NULL, 0, &pole), FPT_NULL_ARGUMENT, "report");
    CHECK_ERROR(fpt_weights_report_pole_count(NULL, &count), FPT_NULL_ARGUMENT, "report");
    CHECK_OK(fpt_weights_interpolated(curve, 1, 1, NULL, &report));
    CHECK_ERROR(fpt_weights_report_pole(report, 5, &pole), FPT_INVALID_ARGUMENT, "index: 5");
    CHECK_ERROR(fpt_weights_report_weights(report, 4, weights), FPT_INVALID_ARGUMENT, "capacity");
    fpt_weights_report_free(report);
    fpt_curve_free(curve);
}

static void short_options_have_defaults_in_the_rest(void) {
    static const size_t poles[] = {1};
    static const double distances[] = {1.5};
    fpt_curve *curve = arch();
    fpt_weights_report *report = NULL;
    fpt_weights_options options;
    fpt_weights_options_init(NULL, sizeof options);
    memset(&options, 0xA5, sizeof options);
    options.struct_size = offsetof(fpt_weights_options, ratio_limit);
    options.weight_min = 0.5;
    options.weight_max = 2;
    CHECK_OK(fpt_weights_refine_curve(curve, poles, distances, 1, NULL, 0, &options, &report));
    fpt_weights_report_free(report);
    fpt_curve_free(curve);
}

int main(void) {
    RUN(null_may_be_freed);
    RUN(the_formulas_give_tables_made_by_hand);
    RUN(a_network_is_the_same_twice_and_within_its_range);
    RUN(a_quarter_circle_is_found_from_the_distance_of_its_pole);
    RUN(constraints_are_met_and_impossible_wishes_told);
    RUN(a_surface_gets_its_wishes);
    RUN(single_weights_move_the_curve_as_asked);
    RUN(conics_and_their_weights);
    RUN(weights_change_as_a_whole);
    RUN(bad_input_is_named_and_nothing_is_written);
    RUN(short_options_have_defaults_in_the_rest);
    return check_report("weights");
}
