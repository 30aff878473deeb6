/* Descriptions that cannot be a shape: each is refused with a text that names the parameter and the index, and creates nothing. */
#include "samples.h"

enum { NUMBERS_MAX = 128 };

static const double not_finite[] = {NAN, INFINITY, -INFINITY};

/* What `out` holds before each call; a refusal leaves it there. */
static char sentinel;

static void refuse_curve(const fpt_curve_data *data, fpt_status expected, const char *words) {
    fpt_curve *out = (fpt_curve *)(void *)&sentinel;
    fpt_status status = fpt_curve_new(data, &out);
    CHECK_MESSAGE(status == expected, "curve with bad %s: %s (%s)", words, fpt_status_name(status), fpt_last_error());
    CHECK_MESSAGE(strstr(fpt_last_error(), words) != NULL, "the text is \"%s\", not \"%s\"", fpt_last_error(), words);
    CHECK((void *)out == (void *)&sentinel);
    if (status == FPT_OK) fpt_curve_free(out);
}

static void refuse_surface(const fpt_surface_data *data, fpt_status expected, const char *words) {
    fpt_surface *out = (fpt_surface *)(void *)&sentinel;
    fpt_status status = fpt_surface_new(data, &out);
    CHECK_MESSAGE(status == expected, "surface with bad %s: %s (%s)", words, fpt_status_name(status), fpt_last_error());
    CHECK_MESSAGE(strstr(fpt_last_error(), words) != NULL, "the text is \"%s\", not \"%s\"", fpt_last_error(), words);
    CHECK((void *)out == (void *)&sentinel);
    if (status == FPT_OK) fpt_surface_free(out);
}

/* A refusal of either kind: sizes beyond memory may be told as invalid or as out of memory. */
static void refuse_curve_size(const fpt_curve_data *data) {
    fpt_curve *out = (fpt_curve *)(void *)&sentinel;
    fpt_status status = fpt_curve_new(data, &out);
    CHECK_MESSAGE(status == FPT_INVALID_ARGUMENT || status == FPT_OUT_OF_MEMORY, "degree %zu, %zu poles: %s", data->degree,
                  data->pole_count, fpt_status_name(status));
    CHECK((void *)out == (void *)&sentinel);
}

static void refuse_surface_size(const fpt_surface_data *data) {
    fpt_surface *out = (fpt_surface *)(void *)&sentinel;
    fpt_status status = fpt_surface_new(data, &out);
    CHECK_MESSAGE(status == FPT_INVALID_ARGUMENT || status == FPT_OUT_OF_MEMORY, "degrees %zu %zu, poles %zu x %zu: %s",
                  data->degree_u, data->degree_v, data->pole_count_u, data->pole_count_v, fpt_status_name(status));
    CHECK((void *)out == (void *)&sentinel);
}

/* The text must contain the index: a number of its own, or in a net of width `columns` the pair "(i, j)". */
static void check_index_named(const char *name, size_t index, size_t columns) {
    char text[48];
    const char *at = fpt_last_error();
    int found = 0;
    if (columns) {
        snprintf(text, sizeof text, "(%u, %u)", (unsigned)(index / columns), (unsigned)(index % columns));
    } else {
        snprintf(text, sizeof text, "%u", (unsigned)index);
    }
    while ((at = strstr(at, text)) != NULL) {
        size_t length = strlen(text);
        int digit_before = at > fpt_last_error() && at[-1] >= '0' && at[-1] <= '9';
        int digit_after = at[length] >= '0' && at[length] <= '9';
        if (!digit_before && !digit_after) found = 1;
        at += length;
    }
    CHECK_MESSAGE(found, "%s: index %s is not in the text \"%s\"", name, text, fpt_last_error());
}

static void null_arguments_are_named(void) {
    fpt_curve_data curve = cubic_curve();
    fpt_surface_data surface = paper_surface(0);
    refuse_curve(NULL, FPT_NULL_ARGUMENT, "data");
    CHECK_ERROR(fpt_curve_new(&curve, NULL), FPT_NULL_ARGUMENT, "out");
    curve.knots = NULL;
    refuse_curve(&curve, FPT_NULL_ARGUMENT, "knots");
    curve = cubic_curve();
    curve.poles = NULL;
    refuse_curve(&curve, FPT_NULL_ARGUMENT, "poles");
    refuse_surface(NULL, FPT_NULL_ARGUMENT, "data");
    CHECK_ERROR(fpt_surface_new(&surface, NULL), FPT_NULL_ARGUMENT, "out");
    surface.knots_u = NULL;
    refuse_surface(&surface, FPT_NULL_ARGUMENT, "knots_u");
    surface = paper_surface(0);
    surface.knots_v = NULL;
    refuse_surface(&surface, FPT_NULL_ARGUMENT, "knots_v");
    surface = paper_surface(0);
    surface.poles = NULL;
    refuse_surface(&surface, FPT_NULL_ARGUMENT, "poles");
}

/* Puts each bad number at each place of one array; `width` numbers make one item, `columns` items one row of a net. */
static void spoil_each_place(const double **field, size_t count, size_t width, size_t columns, const char *name,
                             const fpt_curve_data *curve, const fpt_surface_data *surface) {
    double copy[NUMBERS_MAX];
    const double *original = *field;
    memcpy(copy, original, count * sizeof *copy);
    *field = copy;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < COUNT_OF(not_finite); k++) {
            copy[i] = not_finite[k];
            if (curve) refuse_curve(curve, FPT_INVALID_ARGUMENT, name);
            if (surface) refuse_surface(surface, FPT_INVALID_ARGUMENT, name);
            check_index_named(name, i / width, columns);
        }
        copy[i] = original[i];
    }
    *field = original;
}

static void numbers_that_are_not_finite_are_named(void) {
    fpt_curve_data curve = circle_curve();
    fpt_surface_data surface = paper_surface(1);
    spoil_each_place(&curve.knots, 12, 1, 0, "knots", &curve, NULL);
    spoil_each_place(&curve.poles, 27, 3, 0, "poles", &curve, NULL);
    spoil_each_place(&curve.weights, 9, 1, 0, "weights", &curve, NULL);
    spoil_each_place(&surface.knots_u, 11, 1, 0, "knots_u", NULL, &surface);
    spoil_each_place(&surface.knots_v, 8, 1, 0, "knots_v", NULL, &surface);
    spoil_each_place(&surface.poles, 84, 3, 4, "poles", NULL, &surface);
    spoil_each_place(&surface.weights, 28, 1, 4, "weights", NULL, &surface);
}

static void weights_must_be_positive(void) {
    static const double bad[] = {0, -0.0, -1, -1e-300, -1e300};
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        fpt_curve_data curve = circle_curve();
        fpt_surface_data surface = paper_surface(1);
        double weights[28];
        memcpy(weights, curve.weights, 9 * sizeof *weights);
        weights[5] = bad[k];
        curve.weights = weights;
        refuse_curve(&curve, FPT_INVALID_ARGUMENT, "weights");
        check_index_named("weights", 5, 0);
        memcpy(weights, surface.weights, sizeof weights);
        weights[27] = bad[k];
        surface.weights = weights;
        refuse_surface(&surface, FPT_INVALID_ARGUMENT, "weights");
        check_index_named("weights", 27, 4);
    }
}

static void knots_must_not_decrease(void) {
    static const double decreasing[] = {0, 0, 0, 0, 0.5, 0.25, 0.75, 1, 1, 1, 1};
    static const double backwards[] = {1, 1, 1, 1, 0.75, 0.5, 0.25, 0, 0, 0, 0};
    static const double last_falls[] = {0, 0, 0, 0, 1, 1, 1, 0.9};
    fpt_curve_data curve = cubic_curve();
    fpt_surface_data surface = paper_surface(0);
    curve.knots = decreasing;
    refuse_curve(&curve, FPT_INVALID_ARGUMENT, "knots");
    check_index_named("knots", 5, 0);
    curve.knots = backwards;
    refuse_curve(&curve, FPT_INVALID_ARGUMENT, "knots");
    surface.knots_u = decreasing;
    refuse_surface(&surface, FPT_INVALID_ARGUMENT, "knots_u");
    check_index_named("knots_u", 5, 0);
    surface = paper_surface(0);
    surface.knots_v = last_falls;
    refuse_surface(&surface, FPT_INVALID_ARGUMENT, "knots_v");
    check_index_named("knots_v", 7, 0);
}

/* A domain without length, and an inner knot so often that the shape would fall apart. */
static void knots_must_carry_a_shape(void) {
    static const double empty[] = {2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2};
    static const double torn[] = {0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.5, 1, 1, 1};
    fpt_curve_data curve = cubic_curve();
    fpt_surface_data surface = paper_surface(0);
    curve.knots = empty;
    refuse_curve(&curve, FPT_INVALID_ARGUMENT, "knots");
    curve.knots = torn;
    refuse_curve(&curve, FPT_INVALID_ARGUMENT, "knots");
    surface.knots_u = empty;
    refuse_surface(&surface, FPT_INVALID_ARGUMENT, "knots_u");
    surface.knots_u = torn;
    refuse_surface(&surface, FPT_INVALID_ARGUMENT, "knots_u");
    surface = paper_surface(0);
    surface.knots_v = empty;
    refuse_surface(&surface, FPT_INVALID_ARGUMENT, "knots_v");
}

static void too_few_poles_are_refused(void) {
    for (size_t count = 0; count <= 3; count++) {
        fpt_curve_data curve = cubic_curve();
        fpt_surface_data surface = paper_surface(0);
        curve.pole_count = count;
        refuse_curve(&curve, FPT_INVALID_ARGUMENT, "pole_count");
        surface.pole_count_u = count;
        refuse_surface(&surface, FPT_INVALID_ARGUMENT, "pole_count_u");
        surface = paper_surface(0);
        surface.pole_count_v = count;
        refuse_surface(&surface, FPT_INVALID_ARGUMENT, "pole_count_v");
    }
}

static void degrees_out_of_range_are_refused(void) {
    static const size_t bad[] = {0, 32, 1000, SIZE_MAX, SIZE_MAX - 1, SIZE_MAX / 2};
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        fpt_curve_data curve = cubic_curve();
        fpt_surface_data surface = paper_surface(0);
        curve.degree = bad[k];
        refuse_curve(&curve, FPT_INVALID_ARGUMENT, "degree");
        surface.degree_u = bad[k];
        refuse_surface(&surface, FPT_INVALID_ARGUMENT, "degree_u");
        surface = paper_surface(0);
        surface.degree_v = bad[k];
        refuse_surface(&surface, FPT_INVALID_ARGUMENT, "degree_v");
    }
}

/* Counts whose sums, products or bytes overflow; nothing behind the pointers may be read for them. */
static void counts_that_overflow_are_refused(void) {
    static const size_t counts[] = {SIZE_MAX,           SIZE_MAX - 1,          SIZE_MAX - 3,          SIZE_MAX - 4,
                                    SIZE_MAX / 2,       SIZE_MAX / 3 + 1,      SIZE_MAX / 8,          SIZE_MAX / 8 + 1,
                                    SIZE_MAX / 24 + 1,  SIZE_MAX / 24,         SIZE_MAX / 16 / 3 + 1, SIZE_MAX / 16 + 1,
                                    (size_t)1 << 62,    ((size_t)1 << 61) + 7};
    for (size_t k = 0; k < COUNT_OF(counts); k++) {
        fpt_curve_data curve = circle_curve();
        fpt_surface_data surface = paper_surface(1);
        curve.pole_count = counts[k];
        refuse_curve_size(&curve);
        surface.pole_count_u = counts[k];
        refuse_surface_size(&surface);
        surface = paper_surface(1);
        surface.pole_count_v = counts[k];
        refuse_surface_size(&surface);
        surface.pole_count_u = counts[k];
        refuse_surface_size(&surface);
    }
}

/* Each count is small enough, their product is 0 or 4 after wrapping around. */
static void a_product_that_wraps_to_something_small_is_refused(void) {
    fpt_surface_data surface = paper_surface(1);
    surface.pole_count_u = (size_t)1 << 32;
    surface.pole_count_v = (size_t)1 << 32;
    refuse_surface_size(&surface);
    surface.pole_count_u = ((size_t)1 << 62) + 1;
    surface.pole_count_v = 4;
    refuse_surface_size(&surface);
}

/* A description has no optional end in this version: a shorter size is memory that nobody filled. */
static void short_structs_are_refused(void) {
    fpt_curve_data curve = circle_curve();
    fpt_surface_data surface = paper_surface(1);
    for (size_t size = 0; size < sizeof curve; size++) {
        curve.struct_size = size;
        refuse_curve(&curve, FPT_INVALID_ARGUMENT, "struct_size");
    }
    for (size_t size = 0; size < sizeof surface; size++) {
        surface.struct_size = size;
        refuse_surface(&surface, FPT_INVALID_ARGUMENT, "struct_size");
    }
    curve.struct_size = surface.struct_size = SIZE_MAX;
    refuse_curve(&curve, FPT_INVALID_ARGUMENT, "struct_size");
    refuse_surface(&surface, FPT_INVALID_ARGUMENT, "struct_size");
}

static void long_structs_must_end_in_zeros(void) {
    struct { fpt_curve_data known; unsigned char later[24]; } curve;
    struct { fpt_surface_data known; unsigned char later[24]; } surface;
    fpt_curve *made_curve = NULL;
    fpt_surface *made_surface = NULL;
    memset(&curve, 0, sizeof curve);
    memset(&surface, 0, sizeof surface);
    curve.known = circle_curve();
    curve.known.struct_size = sizeof curve;
    CHECK_OK(fpt_curve_new(&curve.known, &made_curve));
    surface.known = paper_surface(1);
    surface.known.struct_size = sizeof surface;
    CHECK_OK(fpt_surface_new(&surface.known, &made_surface));
    for (size_t i = 0; i < sizeof curve.later; i++) {
        curve.later[i] = surface.later[i] = 1;
        refuse_curve(&curve.known, FPT_UNSUPPORTED, "struct_size");
        refuse_surface(&surface.known, FPT_UNSUPPORTED, "struct_size");
        curve.later[i] = surface.later[i] = 0;
    }
    fpt_curve_free(made_curve);
    fpt_surface_free(made_surface);
}

int main(void) {
    RUN(null_arguments_are_named);
    RUN(numbers_that_are_not_finite_are_named);
    RUN(weights_must_be_positive);
    RUN(knots_must_not_decrease);
    RUN(knots_must_carry_a_shape);
    RUN(too_few_poles_are_refused);
    RUN(degrees_out_of_range_are_refused);
    RUN(counts_that_overflow_are_refused);
    RUN(a_product_that_wraps_to_something_small_is_refused);
    RUN(short_structs_are_refused);
    RUN(long_structs_must_end_in_zeros);
    return check_report("misuse_shapes");
}
