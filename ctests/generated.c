/* Shapes made up here, of the kinds that no file of cases lists: degrees up to 31, unclamped and periodic knots, knots
 * that repeat, weights over six orders of magnitude, tiny, huge and far from the origin.
 * There is no stored truth. Held against each answer: planted feet, dense samples of the shape, and the laws that
 * every record obeys.
 *     generated [SEED [REPEATS [EXPONENT]]]     other shapes; more of them; weights from 10^-EXPONENT to 10^EXPONENT */
#include "samples.h"

enum { DEGREE_MAX = 31, POLES_MAX = 40, QUERIES = 60 };

static uint64_t state = 4711;
static int repeats = 1;
static double exponent = 3;

static double between(double low, double high) { return low + (high - low) * next_random(&state); }
static size_t one_of(size_t count) { return (size_t)(next_random(&state) * (double)count); }

enum knot_kind { CLAMPED, REPEATED, UNCLAMPED, PERIODIC, KNOT_KINDS };

static const char *const knot_names[] = {"clamped", "repeated", "unclamped", "periodic"};

/* One direction: knots, and for periodic ones how many poles there are before they repeat. */
struct direction {
    size_t degree, pole_count, period;
    enum knot_kind kind;
    double knots[POLES_MAX + DEGREE_MAX + 1];
};

/* Steps between knots of one period, used again in the next one. */
static void fill_periodic(struct direction *d) {
    double steps[POLES_MAX], at = 0;
    for (size_t i = 0; i < d->period; i++) steps[i] = between(0.2, 1);
    for (size_t i = 0; i < d->pole_count + d->degree + 1; i++) {
        d->knots[i] = at;
        at += steps[i % d->period];
    }
}

/* The same knot degree + 1 times at both ends unless unclamped; inside, repeated ones come up to degree times. */
static void fill_open(struct direction *d) {
    size_t multiplicity = 1;
    d->knots[0] = between(-3, 3);
    for (size_t i = 1; i < d->pole_count + d->degree + 1; i++) {
        int at_end = d->kind != UNCLAMPED && (i <= d->degree || i > d->pole_count);
        int inside = i > d->degree + 1 && i < d->pole_count;
        int again = d->kind == REPEATED && inside && multiplicity < d->degree && one_of(2);
        multiplicity = again ? multiplicity + 1 : 1;
        d->knots[i] = d->knots[i - 1] + (at_end || again ? 0 : between(0.01, 1));
    }
}

static void make_direction(struct direction *d, size_t degree, size_t spans, enum knot_kind kind) {
    d->degree = degree;
    d->kind = kind;
    d->pole_count = degree + spans;
    d->period = spans < 3 ? 3 : spans;
    if (kind == PERIODIC) {
        d->pole_count = d->period + degree;
        fill_periodic(d);
    } else {
        fill_open(d);
    }
}

/* The pole whose place pole i takes: itself, or the one a period earlier. */
static size_t origin_of(const struct direction *d, size_t i) { return d->kind == PERIODIC ? i % d->period : i; }

struct shape {
    struct direction u, v;
    int is_surface;
    double *poles, *weights, diagonal, largest, domain[4];
    fpt_curve *curve;
    fpt_surface *surface;
    char name[160];
};

static double pick_scale(void) {
    static const double scales[] = {1, 1, 1, 1e-6, 1e6};
    return scales[one_of(COUNT_OF(scales))];
}

/* A wavy net with some noise, moved and scaled; weights, if any, far apart. */
static void fill_net(struct shape *s, double scale, double offset) {
    size_t rows = s->u.pole_count, columns = s->is_surface ? s->v.pole_count : 1;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int rational = one_of(2) == 0;
    s->poles = (double *)malloc(3 * rows * columns * sizeof(double));
    s->weights = rational ? (double *)malloc(rows * columns * sizeof(double)) : NULL;
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            size_t n = i * columns + j, from = origin_of(&s->u, i) * columns + (s->is_surface ? origin_of(&s->v, j) : 0);
            if (from < n) {
                memcpy(s->poles + 3 * n, s->poles + 3 * from, 3 * sizeof(double));
                if (rational) s->weights[n] = s->weights[from];
                continue;
            }
            double x = (double)i + between(-0.3, 0.3), y = s->is_surface ? (double)j + between(-0.3, 0.3) : sin((double)i) * 3;
            double place[3] = {x, y, between(-1, 1)};
            for (size_t k = 0; k < 3; k++) s->poles[3 * n + k] = offset + scale * place[k];
            if (rational) s->weights[n] = pow(10, between(-exponent, exponent));
        }
    }
    for (size_t n = 0; n < 3 * rows * columns; n++) {
        low[n % 3] = fmin(low[n % 3], s->poles[n]);
        high[n % 3] = fmax(high[n % 3], s->poles[n]);
        s->largest = fmax(s->largest, fabs(s->poles[n]));
    }
    s->diagonal = distance_between(low, high);
}

static void make_shape(struct shape *s, int is_surface, size_t degree_u, size_t degree_v, enum knot_kind kind) {
    double scale = pick_scale(), offset = one_of(4) ? 0 : 1e5 * scale;
    memset(s, 0, sizeof *s);
    s->is_surface = is_surface;
    make_direction(&s->u, degree_u, 1 + one_of(6), kind);
    if (is_surface) make_direction(&s->v, degree_v, 1 + one_of(3), (enum knot_kind)one_of(KNOT_KINDS));
    fill_net(s, scale, offset);
    snprintf(s->name, sizeof s->name, "%s of degree %zu x %zu, %s, %zu poles, %s, scale %g, offset %g",
             is_surface ? "surface" : "curve", degree_u, is_surface ? degree_v : 0, knot_names[kind], s->u.pole_count,
             s->weights ? "rational" : "polynomial", scale, offset);
    if (is_surface) {
        s->surface = make_surface(surface_data(degree_u, degree_v, s->u.pole_count, s->v.pole_count, s->u.knots, s->v.knots,
                                               s->poles, s->weights));
        CHECK_OK(fpt_surface_domain(s->surface, s->domain));
    } else {
        s->curve = make_curve(curve_data(degree_u, s->u.pole_count, s->u.knots, s->poles, s->weights));
        CHECK_OK(fpt_curve_domain(s->curve, s->domain));
    }
    CHECK(s->domain[0] == s->u.knots[degree_u] && s->domain[1] == s->u.knots[s->u.pole_count]);
}

static void free_shape(struct shape *s) {
    fpt_curve_free(s->curve);
    fpt_surface_free(s->surface);
    free(s->poles);
    free(s->weights);
}

static void evaluate(const struct shape *s, double u, double v, uint32_t order, double *out) {
    CHECK_OK(s->is_surface ? fpt_surface_evaluate(s->surface, u, v, order, out) : fpt_curve_evaluate(s->curve, u, order, out));
}

/* Points of the shape over a grid of parameters that has the ends of the domain. */
static double *sample(const struct shape *s, size_t *count) {
    size_t steps_u = s->is_surface ? 60 : 3000, steps_v = s->is_surface ? 60 : 0, n = 0;
    double *points = (double *)malloc(3 * (steps_u + 1) * (steps_v + 1) * sizeof *points);
    for (size_t i = 0; i <= steps_u; i++) {
        for (size_t j = 0; j <= steps_v; j++, n++) {
            double a = (double)i / (double)steps_u, b = steps_v ? (double)j / (double)steps_v : 0;
            double u = fmin(s->domain[0] + a * (s->domain[1] - s->domain[0]), s->domain[1]);
            double v = fmin(s->domain[2] + b * (s->domain[3] - s->domain[2]), s->domain[3]);
            evaluate(s, u, v, 0, points + 3 * n);
        }
    }
    *count = n;
    return points;
}

/* The first third lies on the shape, the second beside it, the last one anywhere around it. */
static void place_queries(const struct shape *s, double *queries) {
    for (size_t i = 0; i < QUERIES; i++) {
        double u = between(s->domain[0], s->domain[1]), v = between(s->domain[2], s->domain[3]);
        double spread = i < QUERIES / 3 ? 0 : i < 2 * QUERIES / 3 ? 1e-3 : 1;
        evaluate(s, u, v, 0, queries + 3 * i);
        for (size_t k = 0; k < 3; k++) queries[3 * i + k] += spread * s->diagonal * between(-1, 1);
    }
}

static void check_record(const struct shape *s, const double query[3], int on_shape, const fpt_foot_point *foot,
                         const double *samples, size_t sample_count) {
    double least = INFINITY, at[3], largest = s->largest;
    for (size_t k = 0; k < 3; k++) largest = fmax(largest, fabs(query[k]));
    for (size_t i = 0; i < sample_count; i++) least = fmin(least, distance_between(query, samples + 3 * i));
    if (on_shape) least = 0;
    double rounding = 4e-15 * (largest + least), limit = 1e-9 * s->diagonal + rounding;
    evaluate(s, foot->u, foot->v, 0, at);
    CHECK_MESSAGE(memcmp(at, foot->point, sizeof at) == 0, "%s: the point is not the shape at (u,v)", s->name);
    CHECK_MESSAGE(fabs(foot->distance - distance_between(query, at)) <= rounding + 4e-16 * foot->distance,
                  "%s: distance %.17g to a point at %.17g", s->name, foot->distance, distance_between(query, at));
    CHECK_MESSAGE(foot->distance <= least + limit, "%s: %.12g is farther than a sample at %.12g (flags %u)", s->name,
                  foot->distance, least, (unsigned)foot->flags);
    CHECK_MESSAGE(foot->lower_bound >= 0 && foot->lower_bound <= foot->distance, "%s: bound %.17g, distance %.17g", s->name,
                  foot->lower_bound, foot->distance);
    CHECK_MESSAGE(foot->lower_bound <= least + 1e-12 * s->diagonal + rounding, "%s: bound %.12g above a sample at %.12g",
                  s->name, foot->lower_bound, least);
    CHECK_MESSAGE((foot->flags & FPT_FOOT_NOT_PROVEN) || foot->distance - foot->lower_bound <= 1e-9 * s->diagonal + limit,
                  "%s: gap %g without its flag", s->name, foot->distance - foot->lower_bound);
}

static long asked, not_proven;

static void check_shape(struct shape *s) {
    double queries[3 * QUERIES];
    fpt_foot_point feet[QUERIES];
    size_t sample_count;
    double *samples = sample(s, &sample_count);
    fpt_query_options options = default_options();
    long open = 0;
    options.accuracy = 1e-9 * s->diagonal;
    place_queries(s, queries);
    CHECK_OK(s->is_surface ? fpt_surface_closest(s->surface, queries, QUERIES, &options, feet)
                           : fpt_curve_closest(s->curve, queries, QUERIES, &options, feet));
    for (size_t i = 0; i < QUERIES; i++) {
        check_record(s, queries + 3 * i, i < QUERIES / 3, &feet[i], samples, sample_count);
        open += (feet[i].flags & FPT_FOOT_NOT_PROVEN) != 0;
    }
    if (open) printf("  %s: %ld of %d not proven\n", s->name, open, QUERIES);
    asked += QUERIES;
    not_proven += open;
    free(samples);
}

static void check_many(int is_surface, size_t degree_u, size_t degree_v, int count) {
    for (int kind = 0; kind < KNOT_KINDS; kind++) {
        for (int i = 0; i < count * repeats; i++) {
            struct shape s;
            make_shape(&s, is_surface, degree_u, degree_v, (enum knot_kind)kind);
            check_shape(&s);
            free_shape(&s);
        }
    }
}

static void curves_of_every_degree(void) {
    for (size_t degree = 1; degree <= DEGREE_MAX; degree++) check_many(0, degree, 0, 3);
}

static void surfaces_of_low_degree(void) {
    for (size_t degree = 1; degree <= 5; degree++) check_many(1, degree, 1 + one_of(5), 2);
}

static void surfaces_of_high_degree(void) {
    static const size_t degrees[][2] = {{9, 2}, {15, 1}, {2, 20}, {12, 12}, {25, 3}, {31, 1}, {31, 4}};
    for (size_t i = 0; i < COUNT_OF(degrees); i++) check_many(1, degrees[i][0], degrees[i][1], 1);
}

static void nearly_all_answers_are_proven(void) {
    printf("  %ld answers, %ld not proven\n", asked, not_proven);
    CHECK(1000 * not_proven <= asked);
}

int main(int argc, char **argv) {
    if (argc > 1) state = strtoull(argv[1], NULL, 10);
    if (argc > 2) repeats = atoi(argv[2]);
    if (argc > 3) exponent = atof(argv[3]);
    RUN(curves_of_every_degree);
    RUN(surfaces_of_low_degree);
    RUN(surfaces_of_high_degree);
    RUN(nearly_all_answers_are_proven);
    return check_report("generated");
}
