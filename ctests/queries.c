/* What the query options promise: strides, hints, the box restriction, lengths, the budget, bad points, growing structs. */
#include "samples.h"

enum { POINTS = 300 };

static const double paper_low[3] = {90, 100, 0}, paper_high[3] = {575, 440, 60};
static const double cubic_low[3] = {0, -2, -1}, cubic_high[3] = {9, 3, 2};

/* Points inside larger records at an odd address, NaN between them; the last record ends with its point. */
static void strides_step_over_foreign_bytes(void) {
    enum { STRIDE = 40, HINT_STRIDE = 32 };
    double *points = scattered_points(POINTS, paper_low, paper_high, 0.3);
    double *hints = (double *)malloc(2 * POINTS * sizeof *hints);
    const size_t points_size = STRIDE * (POINTS - 1) + 3 * sizeof(double) + 1;
    const size_t hints_size = HINT_STRIDE * (POINTS - 1) + 2 * sizeof(double) + 1;
    unsigned char *block = (unsigned char *)malloc(points_size), *records = block + 1;
    unsigned char *hint_block = (unsigned char *)malloc(hints_size), *hint_records = hint_block + 1;
    fpt_foot_point packed[POINTS], strided[POINTS];
    fpt_surface *surface = make_surface(paper_surface(0));
    fpt_query_options options = default_options();
    memset(block, 0xFF, points_size);
    memset(hint_block, 0xFF, hints_size);
    for (size_t i = 0; i < POINTS; i++) {
        hints[2 * i] = (double)i / POINTS;
        hints[2 * i + 1] = 0.5;
        memcpy(records + STRIDE * i, points + 3 * i, 3 * sizeof(double));
        memcpy(hint_records + HINT_STRIDE * i, hints + 2 * i, 2 * sizeof(double));
    }
    options.hints = hints;
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, packed));
    options.point_stride = STRIDE;
    options.hints = (const double *)(void *)hint_records;
    options.hint_stride = HINT_STRIDE;
    CHECK_OK(fpt_surface_closest(surface, (const double *)(void *)records, POINTS, &options, strided));
    CHECK_SAME_BITS(packed, strided, sizeof packed);
    fpt_surface_free(surface);
    free(hint_block);
    free(block);
    free(hints);
    free(points);
}

/* A record of six doubles per point (place and direction), as scanners write it; curves take one hint number. */
static void curve_strides_agree(void) {
    double *points = scattered_points(POINTS, cubic_low, cubic_high, 0.3);
    double records[6 * POINTS], hint_records[3 * POINTS];
    fpt_foot_point packed[POINTS], strided[POINTS];
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_query_options options = default_options();
    for (size_t i = 0; i < POINTS; i++) {
        for (size_t k = 0; k < 6; k++) records[6 * i + k] = k < 3 ? points[3 * i + k] : NAN;
        for (size_t k = 0; k < 3; k++) hint_records[3 * i + k] = k ? NAN : (double)i / POINTS;
    }
    CHECK_OK(fpt_curve_closest(curve, points, POINTS, NULL, packed));
    options.point_stride = 6 * sizeof(double);
    CHECK_OK(fpt_curve_closest(curve, records, POINTS, &options, strided));
    CHECK_SAME_BITS(packed, strided, sizeof packed);
    options.hints = hint_records;
    options.hint_stride = 3 * sizeof(double);
    CHECK_OK(fpt_curve_closest(curve, records, POINTS, &options, strided));
    for (size_t i = 0; i < POINTS; i++) CHECK_NEAR(strided[i].distance, packed[i].distance, 1e-8);
    fpt_curve_free(curve);
    free(points);
}

/* NaN means none, outside is moved in, and the worst hint changes neither distance nor proof. */
static void hints_never_change_the_answer(void) {
    static const double bad[][2] = {{NAN, NAN}, {NAN, 0.5},       {0.5, NAN}, {-1e300, 1e300}, {2, 0.5},
                                    {7, -7},    {1, 1},           {0, 0},     {1e-300, 0.999}, {0.5, 0.5}};
    double *points = scattered_points(POINTS, paper_low, paper_high, 0.5);
    double hints[2 * POINTS];
    fpt_foot_point plain[POINTS], hinted[POINTS];
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_query_options options = default_options();
    options.accuracy = 1e-7;
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, plain));
    for (size_t i = 0; i < POINTS; i++) memcpy(hints + 2 * i, bad[i % COUNT_OF(bad)], 2 * sizeof(double));
    options.hints = hints;
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, hinted));
    for (size_t i = 0; i < POINTS; i++) {
        CHECK_NEAR(hinted[i].distance, plain[i].distance, 1e-7);
        CHECK(((hinted[i].flags ^ plain[i].flags) & FPT_FOOT_NOT_PROVEN) == 0);
        CHECK(hinted[i].u >= 0 && hinted[i].u <= 1 && hinted[i].v >= 0 && hinted[i].v <= 1);
        CHECK(!(plain[i].flags & FPT_FOOT_HINT_USED));
    }
    for (size_t i = 0; i < POINTS; i++) hints[2 * i] = hints[2 * i + 1] = NAN;
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, hinted));
    CHECK_SAME_BITS(hinted, plain, sizeof plain);
    fpt_surface_free(surface);
    free(points);
}

/* The true parameters as hint are used and said to be used; local scope stays where it was put. */
static void a_true_hint_is_used(void) {
    fpt_surface *surface = make_surface(paper_surface(0));
    fpt_query_options options = default_options();
    const double hint[2] = {0.3, 0.6};
    double point[3];
    fpt_foot_point foot;
    CHECK_OK(fpt_surface_evaluate(surface, 0.3, 0.6, 0, point));
    options.hints = hint;
    CHECK_OK(fpt_surface_closest(surface, point, 1, &options, &foot));
    CHECK(foot.flags & FPT_FOOT_HINT_USED);
    CHECK_NEAR(foot.u, 0.3, 1e-12);
    CHECK_NEAR(foot.v, 0.6, 1e-12);
    options.scope = FPT_SCOPE_LOCAL;
    CHECK_OK(fpt_surface_closest(surface, point, 1, &options, &foot));
    CHECK(foot.flags & FPT_FOOT_NOT_PROVEN);
    CHECK(foot.lower_bound == 0);
    CHECK_NEAR(foot.u, 0.3, 1e-12);
    fpt_surface_free(surface);
}

/* The least sampled distance over a rectangle of parameters, from its corners on. */
static double sampled_distance(const fpt_surface *surface, const double domain[4], const double query[3]) {
    double least = INFINITY, point[3];
    for (int i = 0; i <= 40; i++) {
        for (int j = 0; j <= 40; j++) {
            double u = i == 40 ? domain[1] : domain[0] + i * (domain[1] - domain[0]) / 40;
            double v = j == 40 ? domain[3] : domain[2] + j * (domain[3] - domain[2]) / 40;
            CHECK_OK(fpt_surface_evaluate(surface, u, v, 0, point));
            least = fmin(least, distance_between(point, query));
        }
    }
    return least;
}

static void a_restriction_answers_for_its_box_only(void) {
    static const double boxes[][4] = {{0.1, 0.3, 0.2, 0.9}, {0.25, 0.5, 0, 1}, {0.6, 0.61, 0.4, 0.41}, {0, 1, 0, 1}};
    enum { FEW = 40 };
    double *points = scattered_points(FEW, paper_low, paper_high, 0.5);
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_foot_point whole[FEW], part[FEW];
    CHECK_OK(fpt_surface_closest(surface, points, FEW, NULL, whole));
    for (size_t b = 0; b < COUNT_OF(boxes); b++) {
        const double *box = boxes[b];
        fpt_query_options options = default_options();
        memcpy(options.domain, box, sizeof options.domain);
        CHECK_OK(fpt_surface_closest(surface, points, FEW, &options, part));
        for (size_t i = 0; i < FEW; i++) {
            double sampled = sampled_distance(surface, box, points + 3 * i);
            CHECK(part[i].u >= box[0] && part[i].u <= box[1] && part[i].v >= box[2] && part[i].v <= box[3]);
            CHECK(part[i].distance <= sampled * (1 + 1e-12));
            CHECK(part[i].lower_bound <= part[i].distance);
            CHECK(part[i].distance - part[i].lower_bound < 1e-6 || (part[i].flags & FPT_FOOT_NOT_PROVEN));
            CHECK(part[i].distance >= whole[i].lower_bound - 1e-9);
            CHECK(!(part[i].flags & FPT_FOOT_NOT_PROVEN));
        }
    }
    fpt_surface_free(surface);
    free(points);
}

static void a_curve_restriction_answers_for_its_interval_only(void) {
    enum { FEW = 60 };
    double *points = scattered_points(FEW, cubic_low, cubic_high, 0.5);
    fpt_curve *curve = make_curve(cubic_curve());
    fpt_query_options options = default_options();
    fpt_foot_point part[FEW];
    options.domain[0] = 0.3;
    options.domain[1] = 0.8;
    CHECK_OK(fpt_curve_closest(curve, points, FEW, &options, part));
    for (size_t i = 0; i < FEW; i++) {
        double least = INFINITY, point[3];
        for (int k = 0; k <= 1000; k++) {
            double u = k == 1000 ? 0.8 : 0.3 + 0.0005 * k;
            CHECK_OK(fpt_curve_evaluate(curve, u, 0, point));
            least = fmin(least, distance_between(point, points + 3 * i));
        }
        CHECK(part[i].u >= 0.3 && part[i].u <= 0.8);
        CHECK(part[i].distance <= least * (1 + 1e-12));
        CHECK(part[i].lower_bound <= part[i].distance && part[i].distance - part[i].lower_bound < 1e-8);
    }
    fpt_curve_free(curve);
    free(points);
}

/* NaN, infinite and gigantic points mark their own record and nobody else's. */
static void a_bad_point_spoils_its_own_record_only(void) {
    static const double bad[][3] = {{NAN, 0, 0}, {0, NAN, 0}, {0, 0, NAN}, {INFINITY, 0, 0}, {0, -INFINITY, 0}, {0, 0, 1.1e100}, {-1e300, 0, 0}};
    double *points = scattered_points(POINTS, paper_low, paper_high, 0.3);
    fpt_foot_point good[POINTS], mixed[POINTS];
    fpt_surface *surface = make_surface(paper_surface(0));
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, NULL, good));
    for (size_t i = 0; i < COUNT_OF(bad); i++) memcpy(points + 3 * (7 * i + 3), bad[i], sizeof bad[i]);
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, NULL, mixed));
    for (size_t i = 0; i < POINTS; i++) {
        if (i % 7 == 3 && i / 7 < COUNT_OF(bad)) {
            CHECK(mixed[i].flags & FPT_FOOT_BAD_QUERY);
            CHECK(mixed[i].flags & FPT_FOOT_NOT_PROVEN);
            CHECK(isnan(mixed[i].u) && isnan(mixed[i].v) && isnan(mixed[i].distance) && isnan(mixed[i].point[1]));
            CHECK(mixed[i].lower_bound == 0);
        } else {
            CHECK_SAME_BITS(mixed + i, good + i, sizeof *good);
        }
    }
    fpt_surface_free(surface);
    free(points);
}

static void invert_says_what_is_not_on_the_shape(void) {
    fpt_curve *curve = make_curve(circle_curve());
    const double points[] = {3, 0, 0, 3.001, 0, 0, 1, 2.5, 0};
    fpt_query_options options = default_options();
    fpt_foot_point feet[3];
    CHECK_OK(fpt_curve_invert(curve, points, 3, NULL, feet));
    CHECK(!(feet[0].flags & FPT_FOOT_NOT_ON_SHAPE));
    CHECK(feet[1].flags & FPT_FOOT_NOT_ON_SHAPE);
    CHECK(feet[2].flags & FPT_FOOT_NOT_ON_SHAPE);
    options.tolerance = 0.01;
    CHECK_OK(fpt_curve_invert(curve, points, 3, &options, feet));
    CHECK(!(feet[1].flags & FPT_FOOT_NOT_ON_SHAPE));
    CHECK_NEAR(feet[1].distance, 0.001, 1e-12);
    CHECK(feet[2].flags & FPT_FOOT_NOT_ON_SHAPE);
    CHECK(feet[2].lower_bound > 0.01);
    CHECK_OK(fpt_curve_closest(curve, points, 3, &options, feet));
    CHECK(!((feet[0].flags | feet[1].flags | feet[2].flags) & FPT_FOOT_NOT_ON_SHAPE));
    CHECK_NEAR(feet[2].distance, 0.5, 1e-12);
    fpt_curve_free(curve);
}

/* Little budget may leave an answer open, never wrongly closed. */
static void an_exhausted_budget_is_said(void) {
    double *points = scattered_points(POINTS, paper_low, paper_high, 1.0);
    fpt_foot_point full[POINTS], poor[POINTS];
    fpt_surface *surface = make_surface(paper_surface(0));
    fpt_query_options options = default_options();
    long open = 0;
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, NULL, full));
    options.budget = 1;
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, poor));
    for (size_t i = 0; i < POINTS; i++) {
        int unproven = (poor[i].flags & FPT_FOOT_NOT_PROVEN) != 0;
        CHECK(poor[i].lower_bound <= full[i].distance * (1 + 1e-12));
        CHECK(poor[i].distance >= full[i].lower_bound * (1 - 1e-12));
        CHECK(!(poor[i].flags & FPT_FOOT_BUDGET) || unproven);
        if (unproven) CHECK(poor[i].flags & FPT_FOOT_BUDGET);
        open += unproven;
    }
    CHECK_MESSAGE(open > 0, "a budget of 1 was enough for every query");
    fpt_surface_free(surface);
    free(points);
}

/* A caller of an older library knows fewer fields, one of a newer library more. */
static void option_structs_grow_at_the_end(void) {
    struct { fpt_query_options known; uint64_t later[3]; } longer;
    fpt_curve *curve = make_curve(cubic_curve());
    const double point[3] = {3, 3, 3}, hint = 0.9;
    fpt_foot_point plain, foot;
    fpt_query_options options;
    CHECK_OK(fpt_curve_closest(curve, point, 1, NULL, &plain));
    memset(&longer, 0, sizeof longer);
    longer.known = default_options();
    longer.known.struct_size = sizeof longer;
    CHECK_OK(fpt_curve_closest(curve, point, 1, &longer.known, &foot));
    CHECK_SAME_BITS(&foot, &plain, sizeof foot);
    longer.later[2] = 1;
    fill_pattern(&foot, sizeof foot);
    CHECK_STATUS(fpt_curve_closest(curve, point, 1, &longer.known, &foot), FPT_UNSUPPORTED);
    CHECK(is_pattern(&foot, sizeof foot));
    /* Fields behind a short struct_size are not read, whatever is there. */
    fill_pattern(&options, sizeof options);
    fpt_query_options_init(&options, offsetof(fpt_query_options, hints));
    CHECK(options.struct_size == offsetof(fpt_query_options, hints));
    CHECK(is_pattern(&options.hints, sizeof options - offsetof(fpt_query_options, hints)));
    options.hints = &hint;
    CHECK_OK(fpt_curve_closest(curve, point, 1, &options, &foot));
    CHECK_SAME_BITS(&foot, &plain, sizeof foot);
    fpt_curve_free(curve);
}

static void init_gives_the_defaults(void) {
    fpt_query_options options;
    fill_pattern(&options, sizeof options);
    fpt_query_options_init(&options, sizeof options);
    CHECK(options.struct_size == sizeof options);
    CHECK(options.tolerance == 0 && options.accuracy == 0);
    CHECK(options.method == FPT_METHOD_AUTO && options.scope == FPT_SCOPE_GLOBAL);
    CHECK(options.hints == NULL && options.point_stride == 0 && options.hint_stride == 0);
    CHECK(options.domain[0] == 0 && options.domain[3] == 0);
    CHECK(options.threads == 0 && options.reserved == 0 && options.budget == 0);
    CHECK(!options.should_stop && !options.progress && !options.trace && !options.user);
}

/* Every method is certified: the same distances, and the proof with each. */
static void every_method_gives_the_same_distance(void) {
    double *points = scattered_points(POINTS, paper_low, paper_high, 0.5);
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_foot_point automatic[POINTS], named[POINTS];
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, NULL, automatic));
    for (uint32_t method = FPT_METHOD_MAF; method <= FPT_METHOD_OSCULATING; method++) {
        fpt_query_options options = default_options();
        options.method = method;
        CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, named));
        for (size_t i = 0; i < POINTS; i++) {
            CHECK_NEAR(named[i].distance, automatic[i].distance, 1e-7);
            CHECK(!(named[i].flags & FPT_FOOT_NOT_PROVEN));
        }
    }
    fpt_surface_free(surface);
    free(points);
}

int main(void) {
    RUN(strides_step_over_foreign_bytes);
    RUN(curve_strides_agree);
    RUN(hints_never_change_the_answer);
    RUN(a_true_hint_is_used);
    RUN(a_restriction_answers_for_its_box_only);
    RUN(a_curve_restriction_answers_for_its_interval_only);
    RUN(a_bad_point_spoils_its_own_record_only);
    RUN(invert_says_what_is_not_on_the_shape);
    RUN(an_exhausted_budget_is_said);
    RUN(option_structs_grow_at_the_end);
    RUN(init_gives_the_defaults);
    RUN(every_method_gives_the_same_distance);
    return check_report("queries");
}
