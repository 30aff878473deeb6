/* Curves and surfaces through and near points; then everything that is refused. */
#include "samples.h"

static fpt_fit_options defaults(double tolerance) {
    fpt_fit_options options;
    fpt_fit_options_init(&options, sizeof options);
    options.tolerance = tolerance;
    return options;
}

enum { COUNT = 200, ROWS = 40, COLUMNS = 30 };

static double helix[3 * COUNT], sheet[3 * ROWS * COLUMNS];

static void make_points(void) {
    for (int i = 0; i < COUNT; i++) {
        double t = (double)i / (COUNT - 1);
        helix[3 * i] = 2 * cos(5 * t), helix[3 * i + 1] = 2 * sin(5 * t), helix[3 * i + 2] = t;
    }
    for (int i = 0; i < ROWS; i++) {
        for (int j = 0; j < COLUMNS; j++) {
            double u = (double)i / (ROWS - 1), v = (double)j / (COLUMNS - 1), *p = sheet + 3 * (i * COLUMNS + j);
            p[0] = 4 * u, p[1] = 3 * v, p[2] = sin(3 * u) * cos(2 * v);
        }
    }
}

static double gap(const double *a, const double *b) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void interpolants_pass_through_their_points(void) {
    static const double tangents[] = {1, 2, 3, NAN, 0, 0};
    double parameters[COUNT + 1], at[6];
    CHECK_OK(fpt_fit_parameters(helix, COUNT, FPT_SPACING_CHORDAL, parameters));
    CHECK(parameters[0] == 0 && parameters[COUNT - 1] == 1);
    for (uint32_t condition = FPT_FIT_FREE; condition <= FPT_FIT_NATURAL; condition++) {
        fpt_fit_options options = defaults(0);
        fpt_curve *curve = NULL;
        options.condition = condition;
        options.tangents = tangents;
        CHECK_OK(fpt_curve_interpolate(helix, COUNT, condition == 0 ? NULL : parameters, &options, &curve));
        for (int i = 0; i < COUNT; i++) {
            CHECK_OK(fpt_curve_evaluate(curve, parameters[i], 0, at));
            CHECK(gap(at, helix + 3 * i) < 1e-12);
        }
        CHECK_OK(fpt_curve_evaluate(curve, 0, 1, at));
        if (condition == FPT_FIT_TANGENTS) CHECK(gap(at + 3, tangents) < 1e-9);
        fpt_curve_free(curve);
    }
    {
        static const double corners[] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
        fpt_fit_options options = defaults(0);
        fpt_curve *curve = NULL;
        int32_t closed = 0;
        options.condition = FPT_FIT_PERIODIC;
        CHECK_OK(fpt_curve_interpolate(corners, 4, NULL, &options, &curve));
        CHECK_OK(fpt_curve_is_closed(curve, &closed));
        CHECK(closed == 1);
        CHECK_OK(fpt_curve_evaluate(curve, 0.25, 0, at));
        CHECK(gap(at, corners + 3) < 1e-14);
        fpt_curve_free(curve);
    }
    {
        fpt_surface *surface = NULL;
        CHECK_OK(fpt_surface_interpolate(sheet, ROWS, COLUMNS, NULL, &surface));
        CHECK_OK(fpt_surface_evaluate(surface, 1, 1, 0, at));
        CHECK(gap(at, sheet + 3 * (ROWS * COLUMNS - 1)) == 0);
        fpt_surface_free(surface);
    }
}

static void fits_keep_their_tolerance(void) {
    fpt_fit_options options = defaults(1e-5);
    fpt_fit_result result;
    fpt_curve *curve = NULL;
    fpt_surface *surface = NULL;
    double parameters[COUNT];
    size_t count = 0;
    CHECK_OK(fpt_curve_fit(helix, COUNT, NULL, &options, &curve, &result));
    CHECK(result.worst <= 1e-5 && result.at_least <= result.worst && result.unproven == 0 && result.rms <= result.worst);
    CHECK_OK(fpt_curve_pole_count(curve, &count));
    CHECK_MESSAGE(count < COUNT / 3, "%zu poles", count);
    fpt_curve_free(curve);
    {
        static const double knots[] = {0, 0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1};
        CHECK_OK(fpt_fit_parameters(helix, COUNT, FPT_SPACING_UNIFORM, parameters));
        CHECK_OK(fpt_curve_least_squares(helix, COUNT, parameters, 3, knots, COUNT_OF(knots), 0, &curve, &result));
        CHECK(result.worst < 0.02 && result.worst > 1e-4 && result.worst_index < COUNT);
        fpt_curve_free(curve);
        CHECK_OK(fpt_curve_least_squares(helix, COUNT, parameters, 3, knots, COUNT_OF(knots), 1, &curve, NULL));
        fpt_curve_free(curve);
    }
    for (uint32_t certify = 0; certify <= 1; certify++) {
        options = defaults(1e-4);
        options.certify = certify;
        CHECK_OK(fpt_surface_fit_grid(sheet, ROWS, COLUMNS, &options, &surface, &result));
        CHECK(result.worst <= 1e-4 && result.unproven == (certify ? 0 : ROWS * COLUMNS));
        CHECK((result.at_least > 0) == (certify == 1));
        fpt_surface_free(surface);
    }
    for (uint32_t keep = 0; keep <= 1; keep++) {
        options = defaults(1e-3);
        options.keep_parameters = keep;
        CHECK_OK(fpt_surface_fit(sheet, ROWS * COLUMNS, NULL, &options, &surface, &result));
        CHECK(result.worst <= 1e-3 && result.unproven == 0);
        fpt_surface_free(surface);
    }
}

static int stop(void *user) {
    ++*(int *)user;
    return 1;
}

static void refusals_name_the_argument_and_write_nothing(void) {
    fpt_fit_options options = defaults(0);
    fpt_curve *curve;
    fpt_surface *surface;
    fpt_fit_result result;
    int asked = 0;
    double bad[12] = {0, 0, 0, 1, 0, 0, 2, 0, NAN, 3, 0, 0};
    fill_pattern(&curve, sizeof curve), fill_pattern(&surface, sizeof surface), fill_pattern(&result, sizeof result);
    CHECK_ERROR(fpt_curve_fit(helix, COUNT, NULL, &options, &curve, &result), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_ERROR(fpt_curve_fit(helix, COUNT, NULL, NULL, &curve, &result), FPT_INVALID_ARGUMENT, "tolerance");
    CHECK_STATUS(fpt_curve_fit(NULL, COUNT, NULL, &options, &curve, &result), FPT_NULL_ARGUMENT);
    CHECK_ERROR(fpt_curve_interpolate(bad, 4, NULL, NULL, &curve), FPT_INVALID_ARGUMENT, "point 2");
    CHECK_ERROR(fpt_curve_interpolate(helix, 3, NULL, NULL, &curve), FPT_INVALID_ARGUMENT, "points: 3 given, at least 4");
    CHECK_ERROR(fpt_curve_interpolate(helix, (size_t)-1, NULL, NULL, &curve), FPT_INVALID_ARGUMENT, "points");
    options = defaults(1e-3);
    options.condition = 7;
    CHECK_ERROR(fpt_curve_interpolate(helix, COUNT, NULL, &options, &curve), FPT_INVALID_ARGUMENT, "condition: 7");
    options = defaults(1e-3);
    options.condition = FPT_FIT_TANGENTS;
    CHECK_STATUS(fpt_curve_interpolate(helix, COUNT, NULL, &options, &curve), FPT_NULL_ARGUMENT);
    options = defaults(1e-3);
    options.condition = FPT_FIT_NATURAL;
    options.degree_u = 2;
    CHECK_ERROR(fpt_curve_interpolate(helix, COUNT, NULL, &options, &curve), FPT_INVALID_ARGUMENT, "degree: 2");
    options = defaults(1e-3);
    options.spacing = 9;
    CHECK_ERROR(fpt_surface_fit_grid(sheet, ROWS, COLUMNS, &options, &surface, &result), FPT_INVALID_ARGUMENT, "spacing: 9");
    options = defaults(1e-3);
    options.degree_v = 99;
    CHECK_ERROR(fpt_surface_fit_grid(sheet, ROWS, COLUMNS, &options, &surface, NULL), FPT_INVALID_ARGUMENT, "degree_v: 99");
    CHECK_ERROR(fpt_surface_interpolate(sheet, 1, COLUMNS, NULL, &surface), FPT_INVALID_ARGUMENT, "count_u");
    CHECK_ERROR(fpt_surface_interpolate(sheet, (size_t)1 << 62, 8, NULL, &surface), FPT_INVALID_ARGUMENT, "points");
    options = defaults(1e-3);
    options.reserved = 1;
    CHECK_ERROR(fpt_surface_fit(sheet, 9, NULL, &options, &surface, &result), FPT_INVALID_ARGUMENT, "reserved");
    options = defaults(1e-3);
    options.struct_size = 5;
    CHECK_ERROR(fpt_surface_fit(sheet, 9, NULL, &options, &surface, &result), FPT_INVALID_ARGUMENT, "struct_size");
    options = defaults(1e-9);
    options.should_stop = stop;
    options.user = &asked;
    CHECK_STATUS(fpt_surface_fit(sheet, ROWS * COLUMNS, NULL, &options, &surface, &result), FPT_CANCELLED);
    CHECK(asked > 0);
    CHECK_ERROR(fpt_fit_parameters(helix, COUNT, 3, bad), FPT_INVALID_ARGUMENT, "spacing: 3");
    CHECK(is_pattern(&curve, sizeof curve) && is_pattern(&surface, sizeof surface) && is_pattern(&result, sizeof result));
    fpt_fit_options_init(NULL, 8);
}

int main(void) {
    make_points();
    RUN(interpolants_pass_through_their_points);
    RUN(fits_keep_their_tolerance);
    RUN(refusals_name_the_argument_and_write_nothing);
    return check_report("fit");
}
