/* The set functions with bad arguments: the status, the parameter's name in the text, outputs left as they were. */
#include "samples.h"

static fpt_curve *curve;
static fpt_surface *surface;
static fpt_foot_set *good;

static const double point[3] = {1, 2, 3}, up[3] = {0, 0, 1};

/* The calls that make a set from a point and query options, or extrema options; `shape` 0: a curve. */
static fpt_status preimage(int shape, const double *query, double tolerance, const fpt_query_options *options,
                           fpt_foot_set **out) {
    return shape ? fpt_surface_preimage(surface, query, tolerance, options, out)
                 : fpt_curve_preimage(curve, query, tolerance, options, out);
}

static fpt_status extrema(int shape, const double *query, const fpt_extrema_options *options, fpt_foot_set **out) {
    return shape ? fpt_surface_extrema(surface, query, options, out) : fpt_curve_extrema(curve, query, options, out);
}

static fpt_status on_line(int shape, const double *origin, const double *direction, const double *reach,
                          double tolerance, const fpt_query_options *options, fpt_foot_set **out) {
    return shape ? fpt_surface_on_line(surface, origin, direction, reach, tolerance, options, out)
                 : fpt_curve_on_line(curve, origin, direction, reach, tolerance, options, out);
}

static fpt_foot_set *pattern(void) {
    fpt_foot_set *set;
    fill_pattern(&set, sizeof set);
    return set;
}

static void null_arguments_are_named(void) {
    fpt_foot_set *set = pattern();
    CHECK_ERROR(fpt_curve_preimage(NULL, point, 0, NULL, &set), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_surface_preimage(NULL, point, 0, NULL, &set), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_curve_extrema(NULL, point, NULL, &set), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_surface_extrema(NULL, point, NULL, &set), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_curve_on_line(NULL, point, up, NULL, 0, NULL, &set), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_surface_on_line(NULL, point, up, NULL, 0, NULL, &set), FPT_NULL_ARGUMENT, "surface");
    for (int shape = 0; shape < 2; shape++) {
        CHECK_ERROR(preimage(shape, NULL, 0, NULL, &set), FPT_NULL_ARGUMENT, "point");
        CHECK_ERROR(preimage(shape, point, 0, NULL, NULL), FPT_NULL_ARGUMENT, "out");
        CHECK_ERROR(extrema(shape, NULL, NULL, &set), FPT_NULL_ARGUMENT, "point");
        CHECK_ERROR(extrema(shape, point, NULL, NULL), FPT_NULL_ARGUMENT, "out");
        CHECK_ERROR(on_line(shape, NULL, up, NULL, 0, NULL, &set), FPT_NULL_ARGUMENT, "origin");
        CHECK_ERROR(on_line(shape, point, NULL, NULL, 0, NULL, &set), FPT_NULL_ARGUMENT, "direction");
        CHECK_ERROR(on_line(shape, point, up, NULL, 0, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    }
    CHECK(is_pattern(&set, sizeof set));
}

static void reading_refuses_null_and_what_is_beyond(void) {
    size_t count = 0;
    fpt_foot_member m;
    double box[4];
    fill_pattern(&m, sizeof m);
    fill_pattern(box, sizeof box);
    CHECK_OK(fpt_foot_set_count(good, &count));
    CHECK(count > 0);
    CHECK_ERROR(fpt_foot_set_count(NULL, &count), FPT_NULL_ARGUMENT, "set");
    CHECK_ERROR(fpt_foot_set_count(good, NULL), FPT_NULL_ARGUMENT, "out_count");
    CHECK_ERROR(fpt_foot_set_get(NULL, 0, &m), FPT_NULL_ARGUMENT, "set");
    CHECK_ERROR(fpt_foot_set_get(good, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_foot_set_get(good, count, &m), FPT_INVALID_ARGUMENT, "index");
    CHECK_ERROR(fpt_foot_set_get(good, SIZE_MAX, &m), FPT_INVALID_ARGUMENT, "index");
    CHECK_ERROR(fpt_foot_set_undecided_count(NULL, &count), FPT_NULL_ARGUMENT, "set");
    CHECK_ERROR(fpt_foot_set_undecided_count(good, NULL), FPT_NULL_ARGUMENT, "out_count");
    CHECK_ERROR(fpt_foot_set_undecided_get(NULL, 0, box), FPT_NULL_ARGUMENT, "set");
    CHECK_ERROR(fpt_foot_set_undecided_get(good, 0, box), FPT_INVALID_ARGUMENT, "index");
    CHECK(is_pattern(&m, sizeof m) && is_pattern(box, sizeof box));
}

static void points_and_lines_must_be_finite(void) {
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1.1e100, -1e300};
    static const char *const entries[] = {"entry 0", "entry 1", "entry 2"};
    fpt_foot_set *set = pattern();
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        for (int k = 0; k < 3; k++) {
            double query[3] = {1, 2, 3};
            query[k] = bad[i];
            for (int shape = 0; shape < 2; shape++) {
                CHECK_ERROR(preimage(shape, query, 0, NULL, &set), FPT_INVALID_ARGUMENT, "point");
                CHECK_ERROR(preimage(shape, query, 0, NULL, &set), FPT_INVALID_ARGUMENT, entries[k]);
                CHECK_ERROR(extrema(shape, query, NULL, &set), FPT_INVALID_ARGUMENT, "point");
                CHECK_ERROR(on_line(shape, query, up, NULL, 0, NULL, &set), FPT_INVALID_ARGUMENT, "origin");
                CHECK_ERROR(on_line(shape, point, query, NULL, 0, NULL, &set), FPT_INVALID_ARGUMENT, "direction");
            }
        }
    }
    const double none[3] = {0, 0, 0}, backwards[2] = {1, 0}, unknown[2] = {NAN, 1}, unknown_too[2] = {0, NAN};
    for (int shape = 0; shape < 2; shape++) {
        CHECK_ERROR(on_line(shape, point, none, NULL, 0, NULL, &set), FPT_INVALID_ARGUMENT, "direction");
        CHECK_ERROR(on_line(shape, point, up, backwards, 0, NULL, &set), FPT_INVALID_ARGUMENT, "reach");
        CHECK_ERROR(on_line(shape, point, up, unknown, 0, NULL, &set), FPT_INVALID_ARGUMENT, "reach");
        CHECK_ERROR(on_line(shape, point, up, unknown_too, 0, NULL, &set), FPT_INVALID_ARGUMENT, "reach");
    }
    CHECK(is_pattern(&set, sizeof set));
}

static void lengths_must_be_lengths(void) {
    static const double bad[] = {-1, -1e-300, NAN, -INFINITY, INFINITY};
    fpt_foot_set *set = pattern();
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        fpt_extrema_options options;
        for (int shape = 0; shape < 2; shape++) {
            CHECK_ERROR(preimage(shape, point, bad[i], NULL, &set), FPT_INVALID_ARGUMENT, "tolerance");
            CHECK_ERROR(on_line(shape, point, up, NULL, bad[i], NULL, &set), FPT_INVALID_ARGUMENT, "tolerance");
            fpt_extrema_options_init(&options, sizeof options);
            options.accuracy = bad[i];
            CHECK_ERROR(extrema(shape, point, &options, &set), FPT_INVALID_ARGUMENT, "accuracy");
            fpt_extrema_options_init(&options, sizeof options);
            options.radius = bad[i];
            CHECK_ERROR(extrema(shape, point, &options, &set), FPT_INVALID_ARGUMENT, "radius");
        }
    }
    CHECK(is_pattern(&set, sizeof set));
}

static void choices_and_restrictions_are_checked(void) {
    fpt_foot_set *set = pattern();
    fpt_extrema_options options;
    fpt_query_options query;
    for (int shape = 0; shape < 2; shape++) {
        fpt_extrema_options_init(&options, sizeof options);
        options.minima_only = 2;
        CHECK_ERROR(extrema(shape, point, &options, &set), FPT_INVALID_ARGUMENT, "minima_only");
        options.minima_only = 0;
        options.reserved = 1;
        CHECK_ERROR(extrema(shape, point, &options, &set), FPT_INVALID_ARGUMENT, "reserved");
        for (int k = 0; k < (shape ? 4 : 2); k++) {
            fpt_extrema_options_init(&options, sizeof options);
            query = default_options();
            for (int i = 0; i < 4; i++) query.domain[i] = options.domain[i] = i % 2 ? 0.75 : 0.25;
            query.domain[k] = options.domain[k] = k % 2 ? 1.5 : -0.5;
            CHECK_ERROR(extrema(shape, point, &options, &set), FPT_INVALID_ARGUMENT, "domain");
            CHECK_ERROR(preimage(shape, point, 0, &query, &set), FPT_INVALID_ARGUMENT, "domain");
            CHECK_ERROR(on_line(shape, point, up, NULL, 0, &query, &set), FPT_INVALID_ARGUMENT, "domain");
            query.domain[k] = options.domain[k] = NAN;
            CHECK_ERROR(extrema(shape, point, &options, &set), FPT_INVALID_ARGUMENT, "domain");
            CHECK_ERROR(preimage(shape, point, 0, &query, &set), FPT_INVALID_ARGUMENT, "domain");
        }
        query = default_options();
        query.method = 9;
        CHECK_ERROR(preimage(shape, point, 0, &query, &set), FPT_INVALID_ARGUMENT, "method");
        query = default_options();
        query.struct_size = 3;
        CHECK_STATUS(preimage(shape, point, 0, &query, &set), FPT_INVALID_ARGUMENT);
    }
    CHECK(is_pattern(&set, sizeof set));
}

/* The struct grows at its end only: what is missing is the default, what is unknown must be zero. */
static void struct_sizes_of_extrema_options_are_checked(void) {
    struct {
        fpt_extrema_options known;
        double tail[2];
    } longer;
    fpt_foot_set *set = pattern();
    memset(&longer, 0xFF, sizeof longer);
    fpt_extrema_options_init((fpt_extrema_options *)&longer, sizeof longer);
    CHECK(longer.known.struct_size == sizeof longer && longer.tail[0] == 0 && longer.tail[1] == 0);
    CHECK_OK(fpt_surface_extrema(surface, point, &longer.known, &set));
    fpt_foot_set_free(set);
    set = pattern();
    longer.tail[1] = 1;
    CHECK_ERROR(fpt_surface_extrema(surface, point, &longer.known, &set), FPT_UNSUPPORTED, "options");
    static const size_t fields[] = {offsetof(fpt_extrema_options, accuracy), offsetof(fpt_extrema_options, radius),
                                    offsetof(fpt_extrema_options, nearest), offsetof(fpt_extrema_options, domain),
                                    offsetof(fpt_extrema_options, budget), offsetof(fpt_extrema_options, should_stop),
                                    offsetof(fpt_extrema_options, user), sizeof(fpt_extrema_options)};
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        fpt_extrema_options options, untouched;
        memset(&options, 0xFF, sizeof options);
        memset(&untouched, 0xFF, sizeof untouched);
        fpt_extrema_options_init(&options, fields[i]);
        CHECK(options.struct_size == fields[i]);
        CHECK_SAME_BITS((char *)&options + fields[i], (char *)&untouched + fields[i], sizeof options - fields[i]);
        CHECK_OK(fpt_surface_extrema(surface, point, &options, &set));
        fpt_foot_set_free(set);
        set = pattern();
        if (fields[i] == sizeof options) break;
        options.struct_size = fields[i] + 1;
        CHECK_STATUS(fpt_surface_extrema(surface, point, &options, &set), FPT_INVALID_ARGUMENT);
    }
    for (size_t size = 0; size < sizeof(size_t); size++) {
        fpt_extrema_options options;
        fill_pattern(&options, sizeof options);
        fpt_extrema_options_init(&options, size);
        CHECK(is_pattern(&options, sizeof options));
        options.struct_size = size;
        CHECK_STATUS(fpt_curve_extrema(curve, point, &options, &set), FPT_INVALID_ARGUMENT);
    }
    CHECK(is_pattern(&set, sizeof set));
}

int main(void) {
    curve = make_curve(cubic_curve());
    surface = make_surface(paper_surface(0));
    CHECK_OK(fpt_curve_extrema(curve, point, NULL, &good));
    RUN(null_arguments_are_named);
    RUN(reading_refuses_null_and_what_is_beyond);
    RUN(points_and_lines_must_be_finite);
    RUN(lengths_must_be_lengths);
    RUN(choices_and_restrictions_are_checked);
    RUN(struct_sizes_of_extrema_options_are_checked);
    fpt_foot_set_free(good);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
    return check_report("misuse_sets");
}
