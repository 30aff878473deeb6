/* Calls on good shapes with bad arguments: the status, the parameter's name in the text, and outputs left as they were. */
#include "samples.h"

static fpt_curve *curve;
static fpt_surface *surface;

typedef fpt_status curve_query(const fpt_curve *, const double *, size_t, const fpt_query_options *, fpt_foot_point *);
typedef fpt_status surface_query(const fpt_surface *, const double *, size_t, const fpt_query_options *, fpt_foot_point *);
static curve_query *const curve_queries[] = {fpt_curve_closest, fpt_curve_invert};
static surface_query *const surface_queries[] = {fpt_surface_closest, fpt_surface_invert};

static const double two_points[] = {1, 2, 3, 4, 5, 6};

/* The same bad options for all four queries. */
static void refuse_options(const fpt_query_options *options, fpt_status expected, const char *words) {
    fpt_foot_point out[2];
    fill_pattern(out, sizeof out);
    for (int k = 0; k < 2; k++) {
        CHECK_ERROR(curve_queries[k](curve, two_points, 2, options, out), expected, words);
        CHECK_ERROR(surface_queries[k](surface, two_points, 2, options, out), expected, words);
    }
    CHECK(is_pattern(out, sizeof out));
}

static void null_arguments_of_queries_are_named(void) {
    fpt_foot_point out[2];
    fill_pattern(out, sizeof out);
    for (int k = 0; k < 2; k++) {
        CHECK_ERROR(curve_queries[k](NULL, two_points, 2, NULL, out), FPT_NULL_ARGUMENT, "curve");
        CHECK_ERROR(curve_queries[k](curve, NULL, 2, NULL, out), FPT_NULL_ARGUMENT, "points");
        CHECK_ERROR(curve_queries[k](curve, two_points, 2, NULL, NULL), FPT_NULL_ARGUMENT, "out");
        CHECK_ERROR(surface_queries[k](NULL, two_points, 2, NULL, out), FPT_NULL_ARGUMENT, "surface");
        CHECK_ERROR(surface_queries[k](surface, NULL, 2, NULL, out), FPT_NULL_ARGUMENT, "points");
        CHECK_ERROR(surface_queries[k](surface, two_points, 2, NULL, NULL), FPT_NULL_ARGUMENT, "out");
    }
    CHECK(is_pattern(out, sizeof out));
    CHECK_ERROR(fpt_curve_prepare(NULL), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_surface_prepare(NULL), FPT_NULL_ARGUMENT, "surface");
    fpt_query_options_init(NULL, sizeof(fpt_query_options));
}

/* No query is a good batch; the arrays are not looked at. */
static void an_empty_batch_is_fine(void) {
    fpt_foot_point out[1];
    fill_pattern(out, sizeof out);
    for (int k = 0; k < 2; k++) {
        CHECK_OK(curve_queries[k](curve, two_points, 0, NULL, out));
        CHECK_OK(surface_queries[k](surface, two_points, 0, NULL, out));
        CHECK_OK(curve_queries[k](curve, NULL, 0, NULL, NULL));
        CHECK_OK(surface_queries[k](surface, NULL, 0, NULL, NULL));
    }
    CHECK(is_pattern(out, sizeof out));
}

static void counts_that_overflow_are_refused(void) {
    static const size_t counts[] = {SIZE_MAX, SIZE_MAX / 8, SIZE_MAX / 24, SIZE_MAX / 24 + 1, SIZE_MAX / 64 + 1, SIZE_MAX / 128 + 1};
    fpt_foot_point out[2];
    double numbers[8];
    fill_pattern(out, sizeof out);
    fill_pattern(numbers, sizeof numbers);
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        for (int k = 0; k < 2; k++) {
            CHECK_ERROR(curve_queries[k](curve, two_points, counts[i], NULL, out), FPT_INVALID_ARGUMENT, "overflow");
            CHECK_ERROR(surface_queries[k](surface, two_points, counts[i], NULL, out), FPT_INVALID_ARGUMENT, "overflow");
        }
        if (counts[i] < SIZE_MAX / 64) continue;
        CHECK_ERROR(fpt_curve_evaluate_many(curve, two_points, counts[i], 1, numbers), FPT_INVALID_ARGUMENT, "overflow");
        CHECK_ERROR(fpt_surface_evaluate_many(surface, two_points, counts[i], 1, numbers), FPT_INVALID_ARGUMENT, "overflow");
    }
    CHECK(is_pattern(out, sizeof out));
    CHECK(is_pattern(numbers, sizeof numbers));
}

/* A stride steps over whole doubles, never into the same point, never around memory. */
static void strides_that_overlap_or_overflow_are_refused(void) {
    static const size_t strides[] = {1, 7, 23, 25, 28, SIZE_MAX, SIZE_MAX / 2};
    fpt_query_options options = default_options();
    for (size_t i = 0; i < COUNT_OF(strides); i++) {
        options = default_options();
        options.point_stride = strides[i];
        refuse_options(&options, FPT_INVALID_ARGUMENT, "point_stride");
        options = default_options();
        options.hint_stride = strides[i];
        options.hints = two_points;
        refuse_options(&options, FPT_INVALID_ARGUMENT, "hint_stride");
    }
    options = default_options();
    options.point_stride = SIZE_MAX / 2 + 1;
    refuse_options(&options, FPT_INVALID_ARGUMENT, "overflow");
    options.point_stride = 0;
    options.hint_stride = SIZE_MAX / 2 + 1;
    options.hints = two_points;
    refuse_options(&options, FPT_INVALID_ARGUMENT, "overflow");
}

/* A NaN is no hint; an infinity is a mistake, and is told with its place. */
static void infinite_hints_are_refused(void) {
    double hints[4] = {0.5, 0.5, 0.5, 0.5};
    fpt_query_options options = default_options();
    fpt_foot_point out[2];
    fill_pattern(out, sizeof out);
    options.hints = hints;
    for (int i = 0; i < 4; i++) {
        hints[i] = i % 2 ? INFINITY : -INFINITY;
        if (i < 2) CHECK_ERROR(fpt_curve_closest(curve, two_points, 2, &options, out), FPT_INVALID_ARGUMENT, i ? "hint 1" : "hint 0");
        CHECK_ERROR(fpt_surface_invert(surface, two_points, 2, &options, out), FPT_INVALID_ARGUMENT, i < 2 ? "hint 0" : "hint 1");
        hints[i] = 0.5;
    }
    CHECK(is_pattern(out, sizeof out));
}

static void lengths_must_be_lengths(void) {
    static const double bad[] = {-1, -1e-300, NAN, -INFINITY, INFINITY};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        fpt_query_options options = default_options();
        options.tolerance = bad[i];
        refuse_options(&options, FPT_INVALID_ARGUMENT, "tolerance");
        options = default_options();
        options.accuracy = bad[i];
        refuse_options(&options, FPT_INVALID_ARGUMENT, "accuracy");
    }
}

static void unknown_choices_are_refused(void) {
    static const uint32_t bad_methods[] = {4, 5, 255, 0x80000000u, UINT32_MAX};
    static const uint32_t bad_scopes[] = {2, 3, 255, 0x80000000u, UINT32_MAX};
    for (size_t i = 0; i < COUNT_OF(bad_methods); i++) {
        fpt_query_options options = default_options();
        options.method = bad_methods[i];
        refuse_options(&options, FPT_INVALID_ARGUMENT, "method");
        options = default_options();
        options.scope = bad_scopes[i];
        refuse_options(&options, FPT_INVALID_ARGUMENT, "scope");
    }
}

/* A restriction has finite ends in order, inside the domain of the shape. */
static void restrictions_must_lie_in_the_domain(void) {
    static const double bad[][4] = {{0.5, 0.4, 0, 1},       {-0.1, 0.5, 0, 1},      {0, 1.0000001, 0, 1}, {NAN, 1, 0, 1},
                                    {0, NAN, 0, 1},         {0, INFINITY, 0, 1},    {2, 3, 0, 1}};
    static const double bad_v[][4] = {{0, 1, 0.5, 0.4}, {0, 1, -1, 1}, {0, 1, 0, 2}, {0, 1, NAN, 1}, {0, 1, 0, NAN}};
    fpt_foot_point out[2];
    fill_pattern(out, sizeof out);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        fpt_query_options options = default_options();
        memcpy(options.domain, bad[i], sizeof options.domain);
        refuse_options(&options, FPT_INVALID_ARGUMENT, "domain");
    }
    for (size_t i = 0; i < COUNT_OF(bad_v); i++) {
        fpt_query_options options = default_options();
        memcpy(options.domain, bad_v[i], sizeof options.domain);
        CHECK_ERROR(fpt_surface_closest(surface, two_points, 2, &options, out), FPT_INVALID_ARGUMENT, "domain");
    }
    CHECK(is_pattern(out, sizeof out));
}

static void struct_sizes_of_options_are_checked(void) {
    struct { fpt_query_options known; unsigned char later[16]; } longer;
    static const size_t too_short[] = {0, 1, sizeof(size_t) - 1};
    fpt_query_options options = default_options();
    for (size_t i = 0; i < COUNT_OF(too_short); i++) {
        options.struct_size = too_short[i];
        refuse_options(&options, FPT_INVALID_ARGUMENT, "struct_size");
    }
    memset(&longer, 0, sizeof longer);
    longer.known = default_options();
    longer.known.struct_size = sizeof longer;
    for (size_t i = 0; i < sizeof longer.later; i++) {
        longer.later[i] = 0x80;
        refuse_options(&longer.known, FPT_UNSUPPORTED, "struct_size");
        longer.later[i] = 0;
    }
}

static void evaluation_refuses_what_is_outside(void) {
    static const double bad[] = {-1e-9, 1.0000000001, NAN, INFINITY, -INFINITY, 1e300};
    double out[64];
    fill_pattern(out, sizeof out);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        const double curve_many[] = {0.5, bad[i], 0.5}, u_many[] = {0.5, 0.5, bad[i], 0.5}, v_many[] = {0.5, 0.5, 0.5, bad[i]};
        CHECK_ERROR(fpt_curve_evaluate(curve, bad[i], 0, out), FPT_INVALID_ARGUMENT, "u");
        CHECK_ERROR(fpt_surface_evaluate(surface, bad[i], 0.5, 0, out), FPT_INVALID_ARGUMENT, "u");
        CHECK_ERROR(fpt_surface_evaluate(surface, 0.5, bad[i], 0, out), FPT_INVALID_ARGUMENT, "v");
        CHECK_ERROR(fpt_curve_evaluate_many(curve, curve_many, 3, 0, out), FPT_INVALID_ARGUMENT, "1");
        CHECK_ERROR(fpt_surface_evaluate_many(surface, u_many, 2, 0, out), FPT_INVALID_ARGUMENT, "1");
        CHECK_ERROR(fpt_surface_evaluate_many(surface, v_many, 2, 0, out), FPT_INVALID_ARGUMENT, "1");
    }
    CHECK(is_pattern(out, sizeof out));
}

static void evaluation_refuses_too_many_derivatives(void) {
    static const uint32_t bad[] = {32, 33, 1000, UINT32_MAX};
    double out[8];
    fill_pattern(out, sizeof out);
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        CHECK_ERROR(fpt_curve_evaluate(curve, 0.5, bad[i], out), FPT_INVALID_ARGUMENT, "derivatives");
        CHECK_ERROR(fpt_surface_evaluate(surface, 0.5, 0.5, bad[i], out), FPT_INVALID_ARGUMENT, "derivatives");
        CHECK_ERROR(fpt_curve_evaluate_many(curve, two_points, 1, bad[i], out), FPT_INVALID_ARGUMENT, "derivatives");
        CHECK_ERROR(fpt_surface_evaluate_many(surface, two_points, 1, bad[i], out), FPT_INVALID_ARGUMENT, "derivatives");
    }
    CHECK(is_pattern(out, sizeof out));
}

/* Getters: the handle, the output, and for arrays a capacity that is one too small. */
static void getters_refuse_null_and_too_little_room(void) {
    size_t size;
    int32_t number[4];
    double out[84];
    fill_pattern(&size, sizeof size);
    fill_pattern(number, sizeof number);
    fill_pattern(out, sizeof out);
#define REFUSE(noun, getter, room)                                                                 \
    CHECK_ERROR(fpt_##noun##_##getter(NULL, room), FPT_NULL_ARGUMENT, #noun);                      \
    CHECK_ERROR(fpt_##noun##_##getter(noun, NULL), FPT_NULL_ARGUMENT, "out")
    REFUSE(curve, degree, &size);
    REFUSE(curve, pole_count, &size);
    REFUSE(curve, box, out);
    REFUSE(curve, is_rational, number);
    REFUSE(curve, is_closed, number);
    REFUSE(surface, degree_u, &size);
    REFUSE(surface, degree_v, &size);
    REFUSE(surface, pole_count_u, &size);
    REFUSE(surface, pole_count_v, &size);
    REFUSE(surface, box, out);
    REFUSE(surface, is_rational, number);
    REFUSE(surface, is_closed_u, number);
    REFUSE(surface, is_closed_v, number);
    REFUSE(surface, collapsed_edges, number);
#undef REFUSE
#define REFUSE(noun, getter, needed)                                                               \
    CHECK_ERROR(fpt_##noun##_##getter(NULL, needed, out), FPT_NULL_ARGUMENT, #noun);               \
    CHECK_ERROR(fpt_##noun##_##getter(noun, needed, NULL), FPT_NULL_ARGUMENT, "out");              \
    CHECK_ERROR(fpt_##noun##_##getter(noun, (needed) - 1, out), FPT_INVALID_ARGUMENT, "capacity"); \
    CHECK_ERROR(fpt_##noun##_##getter(noun, 0, out), FPT_INVALID_ARGUMENT, "capacity")
    REFUSE(curve, knots, 11);
    REFUSE(curve, poles, 21);
    REFUSE(curve, weights, 7);
    REFUSE(surface, knots_u, 11);
    REFUSE(surface, knots_v, 8);
    REFUSE(surface, poles, 84);
    REFUSE(surface, weights, 28);
#undef REFUSE
    CHECK(is_pattern(&size, sizeof size));
    CHECK(is_pattern(number, sizeof number));
    CHECK(is_pattern(out, sizeof out));
}

static void null_arguments_of_evaluation_are_named(void) {
    double out[4];
    const double middle[2] = {0.5, 0.5};
    fill_pattern(out, sizeof out);
    CHECK_ERROR(fpt_curve_domain(NULL, out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_domain(curve, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_domain(NULL, out), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_surface_domain(surface, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_curve_evaluate(NULL, 0.5, 0, out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_evaluate(curve, 0.5, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_evaluate(NULL, 0.5, 0.5, 0, out), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_surface_evaluate(surface, 0.5, 0.5, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_curve_evaluate_many(NULL, middle, 1, 0, out), FPT_NULL_ARGUMENT, "curve");
    CHECK_ERROR(fpt_curve_evaluate_many(curve, NULL, 1, 0, out), FPT_NULL_ARGUMENT, "parameters");
    CHECK_ERROR(fpt_curve_evaluate_many(curve, middle, 1, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK_ERROR(fpt_surface_evaluate_many(NULL, middle, 1, 0, out), FPT_NULL_ARGUMENT, "surface");
    CHECK_ERROR(fpt_surface_evaluate_many(surface, NULL, 1, 0, out), FPT_NULL_ARGUMENT, "parameters");
    CHECK_ERROR(fpt_surface_evaluate_many(surface, middle, 1, 0, NULL), FPT_NULL_ARGUMENT, "out");
    CHECK(is_pattern(out, sizeof out));
}

int main(void) {
    curve = make_curve(cubic_curve());
    surface = make_surface(paper_surface(0));
    RUN(null_arguments_of_queries_are_named);
    RUN(an_empty_batch_is_fine);
    RUN(counts_that_overflow_are_refused);
    RUN(strides_that_overlap_or_overflow_are_refused);
    RUN(infinite_hints_are_refused);
    RUN(lengths_must_be_lengths);
    RUN(unknown_choices_are_refused);
    RUN(restrictions_must_lie_in_the_domain);
    RUN(struct_sizes_of_options_are_checked);
    RUN(evaluation_refuses_what_is_outside);
    RUN(evaluation_refuses_too_many_derivatives);
    RUN(null_arguments_of_evaluation_are_named);
    RUN(getters_refuse_null_and_too_little_room);
    fpt_curve_free(curve);
    fpt_surface_free(surface);
    return check_report("misuse_queries");
}
