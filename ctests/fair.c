/* Fairing and inspection: what they give, then everything that is refused. */
#include "samples.h"

/* A wavy arc with one pole a unit: height x (1 - x), every other pole lifted. */
static fpt_curve *wavy(void) {
    enum { N = 24 };
    static double knots[N + 4], poles[3 * N];
    for (int i = 0; i < N + 4; i++) knots[i] = i < 4 ? 0 : i >= N ? 1 : (i - 3) / (double)(N - 3);
    for (int i = 0; i < N; i++) {
        double x = (knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3;
        poles[3 * i] = x;
        poles[3 * i + 1] = x * (1 - x) + (i % 2 ? 2e-3 : -2e-3);
        poles[3 * i + 2] = 0;
    }
    return make_curve(curve_data(3, N, knots, poles, NULL));
}

/* The cylinder of radius 2 about the z axis, a quarter, from z = 0 to 1 (u turns). */
static fpt_surface *quarter(double lift) {
    static const double knots_u[] = {0, 0, 0, 1, 1, 1}, knots_v[] = {0, 0, 1, 1};
    static const double half = 0.70710678118654752440;
    const double poles[] = {2, 0, lift, 2, 0, lift + 1, 2, 2, lift, 2, 2, lift + 1, 0, 2, lift, 0, 2, lift + 1};
    const double weights[] = {1, 1, half, half, 1, 1};
    fpt_surface_data data;
    fpt_surface *surface = NULL;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.degree_u = 2, data.degree_v = 1, data.pole_count_u = 3, data.pole_count_v = 2;
    data.knots_u = knots_u, data.knots_v = knots_v, data.poles = poles, data.weights = weights;
    CHECK_OK(fpt_surface_new(&data, &surface));
    return surface;
}

/* A bumpy height field over the unit square, 9 x 9 bicubic poles. */
static fpt_surface *bumpy(void) {
    enum { N = 9 };
    static double knots[N + 4], poles[3 * N * N];
    fpt_surface_data data;
    fpt_surface *surface = NULL;
    for (int i = 0; i < N + 4; i++) knots[i] = i < 4 ? 0 : i >= N ? 1 : (i - 3) / (double)(N - 3);
    for (int k = 0; k < N * N; k++) {
        int i = k / N, j = k % N;
        poles[3 * k] = (knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3;
        poles[3 * k + 1] = (knots[j + 1] + knots[j + 2] + knots[j + 3]) / 3;
        poles[3 * k + 2] = (i + j) % 2 && i > 1 && i < N - 2 && j > 1 && j < N - 2 ? 1e-3 : 0;
    }
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.degree_u = data.degree_v = 3, data.pole_count_u = data.pole_count_v = N;
    data.knots_u = data.knots_v = knots, data.poles = poles;
    CHECK_OK(fpt_surface_new(&data, &surface));
    return surface;
}

static fpt_fair_options fairing(double deviation) {
    fpt_fair_options options;
    fpt_fair_options_init(&options, sizeof options);
    options.deviation = deviation;
    return options;
}

static size_t inflection_count(const fpt_curve *curve) {
    static const double up[] = {0, 0, 1};
    fpt_inspect_set *set = NULL;
    size_t count = 0, found = 0;
    CHECK_OK(fpt_inspect_inflections(curve, up, &set));
    CHECK_OK(fpt_inspect_set_count(set, &count));
    for (size_t i = 0; i < count; i++) {
        fpt_inspect_place place;
        CHECK_OK(fpt_inspect_set_get(set, i, &place));
        CHECK(place.u[0] <= place.value[0] && place.value[0] <= place.u[1]);
        if (place.kind == FPT_PLACE_INFLECTION) found++;
    }
    fpt_inspect_set_free(set);
    return found;
}

static void a_wavy_curve_loses_its_inflections_within_the_deviation(void) {
    static const uint32_t methods[] = {FPT_FAIR_ENERGY, FPT_FAIR_LOCAL, FPT_FAIR_KNOT_REMOVAL};
    fpt_curve *curve = wavy();
    size_t before = inflection_count(curve);
    CHECK(before > 10);
    for (size_t k = 0; k < COUNT_OF(methods); k++) {
        fpt_fair_options options = fairing(6e-3);
        fpt_fair_report *report = NULL;
        fpt_fair_summary summary;
        fpt_curve *faired = NULL;
        fpt_surface *none = NULL;
        double *energies;
        options.method = methods[k], options.strain = 0, options.jerk = 1, options.ends[0] = options.ends[1] = 1;
        CHECK_OK(fpt_fair_curve(curve, &options, &report));
        CHECK_OK(fpt_fair_report_summary(report, &summary));
        CHECK(summary.deviation > 0 && summary.deviation <= 6e-3 && summary.energy_after < summary.energy_before / 5);
        energies = malloc((size_t)(summary.steps + 1) * sizeof *energies);
        CHECK_OK(fpt_fair_report_energies(report, (size_t)summary.steps + 1, energies));
        for (uint64_t i = 1; i <= summary.steps; i++) CHECK(energies[i] <= energies[i - 1]);
        CHECK(energies[0] == summary.energy_before && energies[summary.steps] == summary.energy_after);
        CHECK_ERROR(fpt_fair_report_energies(report, 1, energies), FPT_INVALID_ARGUMENT, "capacity");
        free(energies);
        CHECK_OK(fpt_fair_report_curve(report, &faired));
        CHECK_ERROR(fpt_fair_report_surface(report, &none), FPT_UNSUPPORTED, "report");
        CHECK(inflection_count(faired) <= before / 3);
        for (int i = 0; i <= 100; i++) {
            double p[3], q[3];
            CHECK_OK(fpt_curve_evaluate(curve, i / 100.0, 0, p));
            CHECK_OK(fpt_curve_evaluate(faired, i / 100.0, 0, q));
            CHECK(hypot(p[0] - q[0], p[1] - q[1]) <= summary.deviation);
        }
        fpt_curve_free(faired);
        fpt_fair_report_free(report);
    }
    fpt_curve_free(curve);
    fpt_fair_report_free(NULL);
    fpt_inspect_set_free(NULL);
}

static void a_bumpy_surface_gets_flat_and_keeps_its_borders(void) {
    fpt_surface *surface = bumpy(), *faired = NULL;
    fpt_fair_options options = fairing(2e-3);
    fpt_fair_report *report = NULL;
    fpt_fair_summary summary;
    fpt_curve *none = NULL;
    CHECK_OK(fpt_fair_surface(surface, &options, &report));
    CHECK_OK(fpt_fair_report_summary(report, &summary));
    CHECK(summary.energy_after < summary.energy_before / 100 && summary.deviation <= 2e-3);
    CHECK_OK(fpt_fair_report_surface(report, &faired));
    CHECK_ERROR(fpt_fair_report_curve(report, &none), FPT_UNSUPPORTED, "report");
    for (int i = 0; i <= 10; i++) {
        double p[9], q[9];
        CHECK_OK(fpt_surface_evaluate(surface, 0, i / 10.0, 1, p));
        CHECK_OK(fpt_surface_evaluate(faired, 0, i / 10.0, 1, q));
        for (int k = 0; k < 9; k++) CHECK_NEAR(p[k], q[k], 1e-13);
    }
    fpt_surface_free(faired);
    fpt_surface_free(surface);
    fpt_fair_report_free(report);
}

static void curvatures_have_their_closed_forms(void) {
    fpt_surface *surface = quarter(0);
    fpt_curve *circle = make_curve(circle_curve());
    fpt_inspect_options options;
    fpt_inspect_range range;
    fpt_inspect_tooth tooth;
    fpt_inspect_curvature at;
    fpt_inspect_set *set = NULL;
    fpt_inspect_place place;
    size_t count = 0;
    static const double here[] = {0.3, 0.5};
    fpt_inspect_options_init(&options, sizeof options);
    CHECK_OK(fpt_inspect_surface_range(surface, FPT_QUANTITY_SHARPEST, NULL, &range));
    CHECK(range.proven == 1 && range.least[0] <= 0.5 && range.greatest[1] >= 0.5 && range.excluded == 0);
    CHECK(range.greatest[1] - range.least[0] <= 1.1e-3);
    CHECK_OK(fpt_inspect_curve_range(circle, &options, &range));
    CHECK(range.proven == 1 && range.least[0] <= 0.5 && range.greatest[1] >= 0.5 && range.greatest[1] - range.least[0] <= 1.1e-3);
    CHECK_OK(fpt_inspect_comb(circle, here, 1, &tooth));
    CHECK_NEAR(tooth.curvature, 0.5, 1e-13);
    CHECK_NEAR(tooth.torsion, 0, 1e-13);
    CHECK_OK(fpt_inspect_curvatures(surface, here, 1, &at));
    CHECK_NEAR(at.principal[0] * at.principal[1], 0, 1e-14);
    CHECK_NEAR(fabs(at.mean), 0.25, 1e-13);
    CHECK(at.is_umbilic == 0 && at.is_singular == 0);
    CHECK_OK(fpt_inspect_monotone_pieces(circle, &set));
    CHECK_OK(fpt_inspect_set_count(set, &count));
    CHECK(count == 1);
    CHECK_OK(fpt_inspect_set_get(set, 0, &place));
    CHECK(place.kind == FPT_PLACE_CONSTANT);
    CHECK_ERROR(fpt_inspect_set_get(set, 1, &place), FPT_INVALID_ARGUMENT, "index");
    fpt_inspect_set_free(set);
    CHECK_OK(fpt_inspect_umbilics(surface, NULL, &set));
    CHECK_OK(fpt_inspect_set_count(set, &count));
    CHECK(count == 0);
    fpt_inspect_set_free(set);
    fpt_curve_free(circle);
    fpt_surface_free(surface);
    {
        /* A fan with a bent foot: curvature grows without bound towards its tip. */
        static const double u[] = {0, 0, 0, 1, 1, 1}, v[] = {0, 0, 1, 1};
        static const double poles[] = {0, 0, 0, 1, 0, -1, 0, 0, 0, 1, 1, -1.3, 0, 0, 0, 0, 1, -1};
        fpt_surface_data data;
        fpt_surface *tip = NULL;
        memset(&data, 0, sizeof data);
        data.struct_size = sizeof data;
        data.degree_u = 2, data.degree_v = 1, data.pole_count_u = 3, data.pole_count_v = 2;
        data.knots_u = u, data.knots_v = v, data.poles = poles;
        CHECK_OK(fpt_surface_new(&data, &tip));
        CHECK_OK(fpt_inspect_surface_range_places(tip, FPT_QUANTITY_SHARPEST, NULL, &range, &set));
        CHECK((range.flags & FPT_RANGE_GREATEST_UNBOUNDED) != 0 && (range.flags & FPT_RANGE_LEAST_UNBOUNDED) == 0);
        CHECK(range.proven == 0 && range.excluded > 0 && range.excluded < 0.01);
        CHECK_OK(fpt_inspect_set_count(set, &count));
        CHECK(count == 1);
        CHECK_OK(fpt_inspect_set_get(set, 0, &place));
        CHECK(place.kind == FPT_PLACE_UNBOUNDED && place.value[1] == 0 && place.v[0] == 0 && place.v[1] < 0.01);
        fpt_inspect_set_free(set);
        CHECK_ERROR(fpt_inspect_surface_range_places(tip, 4, NULL, &range, NULL), FPT_NULL_ARGUMENT, "places");
        CHECK_ERROR(fpt_inspect_surface_range_places(tip, 4, NULL, NULL, &set), FPT_NULL_ARGUMENT, "out");
        fpt_surface_free(tip);
    }
}

static void shapes_are_apart_and_meet_as_they_were_made(void) {
    fpt_surface *low = quarter(0), *high = quarter(1);
    fpt_curve *circle = make_curve(circle_curve());
    fpt_inspect_distance forward, backward;
    fpt_inspect_continuity meet;
    fpt_inspect_options options;
    fpt_inspect_options_init(&options, sizeof options);
    options.accuracy = 0.01;
    CHECK_OK(fpt_inspect_hausdorff(NULL, low, NULL, high, &options, &forward, &backward));
    CHECK(forward.lower <= 1 && 1 <= forward.upper && forward.upper - forward.lower <= 0.011 && forward.proven == 1);
    CHECK(backward.lower <= 1 && 1 <= backward.upper && backward.upper - backward.lower <= 0.011);
    CHECK_OK(fpt_inspect_hausdorff(circle, NULL, circle, NULL, &options, &forward, &backward));
    CHECK(forward.lower == 0 && forward.upper <= 0.011);
    /* The border v = 1 of the lower one is the border v = 0 of the upper one. */
    CHECK_OK(fpt_inspect_border(low, 3, high, 2, NULL, &meet));
    CHECK_NEAR(meet.gap.upper, 0, 1e-5);
    CHECK_NEAR(meet.angle.upper, 0, 3e-3);
    CHECK_NEAR(meet.curvature.upper, 0, 1e-2);
    CHECK(meet.gap.upper < 1e-5 && meet.angle.lower < 1e-7 && meet.angle.upper < 3e-3 && meet.curvature.upper < 1e-2);
    CHECK_ERROR(fpt_inspect_hausdorff(circle, low, circle, NULL, NULL, &forward, &backward), FPT_INVALID_ARGUMENT, "curve_a");
    CHECK_ERROR(fpt_inspect_hausdorff(NULL, low, NULL, NULL, NULL, &forward, &backward), FPT_INVALID_ARGUMENT, "curve_b");
    CHECK_ERROR(fpt_inspect_border(low, 9, high, 2, NULL, &meet), FPT_INVALID_ARGUMENT, "side_a");
    options.accuracy = -1;
    CHECK_ERROR(fpt_inspect_hausdorff(circle, NULL, NULL, low, &options, &forward, &backward), FPT_INVALID_ARGUMENT, "accuracy");
    fpt_curve_free(circle);
    fpt_surface_free(high);
    fpt_surface_free(low);
}

static void a_picture_has_the_pixels_asked_for(void) {
    fpt_surface *surface = quarter(0);
    fpt_inspect_picture_options options;
    static uint8_t pixels[3 * 64 * 48 + 1];
    double range[2];
    size_t seen = 0;
    fpt_inspect_picture_options_init(&options, sizeof options);
    options.width = 64, options.height = 48, options.pattern = FPT_PATTERN_MEAN;
    pixels[3 * 64 * 48] = 77;
    CHECK_OK(fpt_inspect_picture(surface, &options, 3 * 64 * 48, pixels, range));
    for (size_t i = 0; i < 3 * 64 * 48; i++) seen += pixels[i] != 255;
    CHECK(seen > 1000 && pixels[3 * 64 * 48] == 77);
    CHECK_NEAR(fabs(range[0]), 0.25, 1e-9);
    CHECK_ERROR(fpt_inspect_picture(surface, &options, 100, pixels, range), FPT_INVALID_ARGUMENT, "capacity");
    options.pattern = 99;
    CHECK_ERROR(fpt_inspect_picture(surface, &options, sizeof pixels, pixels, NULL), FPT_INVALID_ARGUMENT, "pattern");
    options.pattern = 0, options.width = 0;
    CHECK_ERROR(fpt_inspect_picture(surface, &options, sizeof pixels, pixels, NULL), FPT_INVALID_ARGUMENT, "size");
    options.width = 64, options.eye[0] = options.eye[1] = options.eye[2] = 0;
    CHECK_ERROR(fpt_inspect_picture(surface, &options, sizeof pixels, pixels, NULL), FPT_INVALID_ARGUMENT, "eye");
    fpt_surface_free(surface);
}

static int stop(void *user) {
    (void)user;
    return 1;
}

static void nonsense_is_refused_by_name(void) {
    fpt_curve *curve = wavy();
    fpt_surface *surface = quarter(0);
    fpt_fair_report *report = NULL;
    fpt_inspect_range range;
    fpt_inspect_options inspect;
    fpt_inspect_set *set = NULL;
    fpt_inspect_tooth tooth;
    fpt_inspect_curvature at;
    static const size_t far_pole[] = {1000};
    static const double outside[] = {0.5, 7}, nothing[] = {0, 0, 0};
    fpt_fair_options options = fairing(1e-3);
    fpt_inspect_options_init(&inspect, sizeof inspect);
    CHECK_ERROR(fpt_fair_curve(NULL, &options, &report), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_fair_curve(curve, NULL, &report), FPT_INVALID_ARGUMENT, "deviation");
    CHECK_ERROR(fpt_fair_curve(curve, &options, NULL), FPT_NULL_ARGUMENT, "out");
    options.deviation = NAN;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "deviation");
    options = fairing(1e-3), options.method = 7;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "method");
    options = fairing(1e-3), options.jerk = INFINITY;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "jerk");
    options = fairing(1e-3), options.fixed = far_pole, options.fixed_count = 1;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "fixed: entry 0");
    options = fairing(1e-3), options.fixed_count = 1;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_NULL_ARGUMENT, "fixed");
    options = fairing(1e-3), options.through = outside, options.through_count = 2;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "through: entry 1");
    options = fairing(1e-3), options.ends[1] = 4;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "ends: entry 1");
    options = fairing(1e-3), options.calm = 2;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "calm");
    options = fairing(1e-3), options.slope = -1;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "slope");
    options = fairing(1e-3), options.struct_size = 24;
    CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "struct_size");
    options = fairing(1e-3), options.should_stop = stop;
    CHECK_STATUS(fpt_fair_curve(curve, &options, &report), FPT_CANCELLED);
    options = fairing(1e-3), options.borders[2] = 9;
    CHECK_ERROR(fpt_fair_surface(surface, &options, &report), FPT_INVALID_ARGUMENT, "borders: entry 2");
    options = fairing(1e-3), options.method = FPT_FAIR_KNOT_REMOVAL;
    CHECK_ERROR(fpt_fair_surface(surface, &options, &report), FPT_UNSUPPORTED, "method");
    options = fairing(1e-3), options.region[1] = 9;
    CHECK_ERROR(fpt_fair_surface(surface, &options, &report), FPT_INVALID_ARGUMENT, "region: entry 1");
    CHECK(report == NULL);
    CHECK_ERROR(fpt_inspect_surface_range(surface, 5, NULL, &range), FPT_INVALID_ARGUMENT, "quantity");
    inspect.relative = 0;
    CHECK_ERROR(fpt_inspect_surface_range(surface, 4, &inspect, &range), FPT_INVALID_ARGUMENT, "relative");
    fpt_inspect_options_init(&inspect, sizeof inspect);
    inspect.domain[1] = 3, inspect.domain[3] = 1;
    CHECK_ERROR(fpt_inspect_surface_range(surface, 4, &inspect, &range), FPT_INVALID_ARGUMENT, "domain: entry 1");
    inspect.domain[1] = NAN;
    CHECK_ERROR(fpt_inspect_curve_range(curve, &inspect, &range), FPT_INVALID_ARGUMENT, "domain");
    CHECK_ERROR(fpt_inspect_comb(curve, outside, 2, &tooth), FPT_INVALID_ARGUMENT, "entry 1");
    CHECK_ERROR(fpt_inspect_curvatures(surface, outside, 1, &at), FPT_INVALID_ARGUMENT, "v of entry 0");
    CHECK_ERROR(fpt_inspect_inflections(curve, nothing, &set), FPT_INVALID_ARGUMENT, "normal");
    CHECK_ERROR(fpt_inspect_monotone_pieces(NULL, &set), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_inspect_umbilics(surface, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    fpt_surface_free(surface);
    fpt_curve_free(curve);
}

/* Numbers that programs hand over by mistake, and plain ones. */
static double odd(uint32_t *seed) {
    static const double values[] = {0, -0.0, 1, -1, 1e-3, 0.5, 2, 1e-320, 1e-200, 1e200, 1.7976931348623157e308, INFINITY, -INFINITY, NAN};
    *seed = *seed * 1664525u + 1013904223u;
    return values[(*seed >> 16) % COUNT_OF(values)];
}

/* Mostly the default of an option; now and then something odd, so that more than the first check is reached. */
static int now_and_then(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 16) % 6 == 0;
}

static void odd_options_never_break_anything(void) {
    fpt_curve *curve = wavy(), *faired_curve = NULL;
    fpt_surface *surface = bumpy(), *faired_surface = NULL;
    uint32_t seed = 12345;
    size_t done = 0, refused = 0;
    for (int round = 0; round < 400; round++) {
        fpt_fair_options options = fairing(2e-3);
        fpt_inspect_options inspect;
        fpt_inspect_range range;
        fpt_inspect_set *set = NULL;
        fpt_inspect_distance there, back;
        fpt_fair_report *report = NULL;
        size_t fixed[2];
        double through[2], knots[2];
        fpt_status status;
        options.steps = 4;
        if (now_and_then(&seed)) options.deviation = odd(&seed);
        if (now_and_then(&seed)) options.strain = odd(&seed);
        if (now_and_then(&seed)) options.jerk = odd(&seed);
        if (now_and_then(&seed)) options.slope = odd(&seed);
        if (now_and_then(&seed)) options.distance = odd(&seed);
        if (now_and_then(&seed)) options.method = seed >> 30;
        if (now_and_then(&seed)) options.by_length = seed >> 30;
        if (now_and_then(&seed)) options.calm = seed >> 30;
        if (now_and_then(&seed)) options.ends[seed >> 31] = seed >> 29;
        if (now_and_then(&seed)) options.borders[seed >> 30] = seed >> 29;
        if (now_and_then(&seed)) options.length[0] = odd(&seed), options.length[1] = odd(&seed);
        if (now_and_then(&seed)) options.region[seed >> 30] = odd(&seed);
        if (now_and_then(&seed)) {
            fixed[0] = seed >> 26, fixed[1] = seed % 7 == 0 ? (size_t)-1 : 3;
            options.fixed = fixed, options.fixed_count = 2;
        }
        if (now_and_then(&seed)) through[0] = odd(&seed), through[1] = odd(&seed), options.through = through, options.through_count = 2;
        if (now_and_then(&seed)) knots[0] = odd(&seed), knots[1] = odd(&seed), options.knots = knots, options.knot_count = seed >> 31;
        status = round % 2 ? fpt_fair_curve(curve, &options, &report) : fpt_fair_surface(surface, &options, &report);
        CHECK((status == FPT_OK) == (report != NULL));
        if (status == FPT_OK) {
            fpt_fair_summary summary;
            done++;
            CHECK_OK(fpt_fair_report_summary(report, &summary));
            CHECK(summary.deviation <= options.deviation && summary.energy_after <= summary.energy_before);
            if (round % 2) CHECK_OK(fpt_fair_report_curve(report, &faired_curve));
            else CHECK_OK(fpt_fair_report_surface(report, &faired_surface));
            fpt_curve_free(faired_curve), fpt_surface_free(faired_surface);
            faired_curve = NULL, faired_surface = NULL;
        } else {
            refused++;
            CHECK(strlen(fpt_last_error()) > 0);
        }
        fpt_fair_report_free(report);
        fpt_inspect_options_init(&inspect, sizeof inspect);
        inspect.budget = 50;
        if (now_and_then(&seed)) inspect.relative = odd(&seed);
        if (now_and_then(&seed)) inspect.accuracy = odd(&seed);
        if (now_and_then(&seed)) inspect.domain[seed >> 30] = odd(&seed);
        if (now_and_then(&seed)) inspect.side = seed >> 30;
        if (now_and_then(&seed)) inspect.reserved = seed >> 31;
        status = fpt_inspect_surface_range(surface, seed >> 29, &inspect, &range);
        if (status == FPT_OK) CHECK(!(range.greatest[0] > range.greatest[1]) && !(range.least[0] > range.least[1]));
        else CHECK(strlen(fpt_last_error()) > 0);
        status = fpt_inspect_curve_range(curve, &inspect, &range);
        CHECK(status == FPT_OK || status == FPT_INVALID_ARGUMENT);
        status = fpt_inspect_umbilics(surface, &inspect, &set);
        CHECK(status == FPT_OK || status == FPT_INVALID_ARGUMENT);
        fpt_inspect_set_free(set);
        status = fpt_inspect_hausdorff(curve, NULL, NULL, surface, &inspect, &there, &back);
        CHECK(status == FPT_OK || status == FPT_INVALID_ARGUMENT);
    }
    CHECK_MESSAGE(done > 20 && refused > 20, "%zu done, %zu refused", done, refused);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
}

static void short_structs_and_nulls_are_refused(void) {
    fpt_curve *curve = wavy();
    fpt_surface *surface = quarter(0);
    fpt_fair_options options = fairing(1e-3);
    fpt_inspect_options inspect;
    fpt_inspect_picture_options picture;
    fpt_fair_report *report = NULL;
    fpt_inspect_range range;
    fpt_inspect_continuity meet;
    fpt_inspect_distance there, back;
    uint8_t pixels[3];
    for (size_t size = 0; size < sizeof options; size += 4) {
        options = fairing(1e-3), options.struct_size = size;
        CHECK_ERROR(fpt_fair_curve(curve, &options, &report), FPT_INVALID_ARGUMENT, "struct_size");
        CHECK_ERROR(fpt_fair_surface(surface, &options, &report), FPT_INVALID_ARGUMENT, "struct_size");
    }
    for (size_t size = 0; size < sizeof inspect; size += 4) {
        fpt_inspect_options_init(&inspect, sizeof inspect);
        inspect.struct_size = size;
        CHECK_ERROR(fpt_inspect_surface_range(surface, 4, &inspect, &range), FPT_INVALID_ARGUMENT, "struct_size");
        CHECK_ERROR(fpt_inspect_border(surface, 0, surface, 1, &inspect, &meet), FPT_INVALID_ARGUMENT, "struct_size");
    }
    fpt_inspect_picture_options_init(&picture, sizeof picture);
    picture.struct_size = 12;
    CHECK_ERROR(fpt_inspect_picture(surface, &picture, sizeof pixels, pixels, NULL), FPT_INVALID_ARGUMENT, "struct_size");
    fpt_inspect_options_init(&inspect, sizeof inspect);
    inspect.side = 3;
    CHECK_ERROR(fpt_inspect_surface_range(surface, 4, &inspect, &range), FPT_INVALID_ARGUMENT, "side: 3");
    fpt_fair_options_init(NULL, sizeof options);
    fpt_inspect_options_init(NULL, sizeof inspect);
    CHECK_ERROR(fpt_fair_surface(NULL, &options, &report), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_fair_report_summary(NULL, NULL), FPT_NULL_ARGUMENT, "report");
    CHECK_ERROR(fpt_inspect_surface_range(NULL, 4, NULL, &range), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_inspect_surface_range(surface, 4, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_inspect_curve_range(curve, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_inspect_comb(curve, NULL, 3, NULL), FPT_NULL_ARGUMENT, "parameters");
    CHECK_ERROR(fpt_inspect_curvatures(surface, NULL, 3, NULL), FPT_NULL_ARGUMENT, "parameters");
    CHECK_ERROR(fpt_inspect_picture(surface, NULL, 3 * 640 * 480, NULL, NULL), FPT_NULL_ARGUMENT, "out_pixels");
    CHECK_ERROR(fpt_inspect_border(surface, 0, NULL, 0, NULL, &meet), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_inspect_hausdorff(curve, NULL, curve, NULL, NULL, NULL, &back), FPT_NULL_ARGUMENT, "out_forward");
    CHECK_ERROR(fpt_inspect_hausdorff(curve, NULL, curve, NULL, NULL, &there, NULL), FPT_NULL_ARGUMENT, "out_backward");
    fpt_surface_free(surface);
    fpt_curve_free(curve);
}

int main(void) {
    RUN(odd_options_never_break_anything);
    RUN(short_structs_and_nulls_are_refused);
    RUN(a_wavy_curve_loses_its_inflections_within_the_deviation);
    RUN(a_bumpy_surface_gets_flat_and_keeps_its_borders);
    RUN(curvatures_have_their_closed_forms);
    RUN(shapes_are_apart_and_meet_as_they_were_made);
    RUN(a_picture_has_the_pixels_asked_for);
    RUN(nonsense_is_refused_by_name);
    return check_report("fair");
}
