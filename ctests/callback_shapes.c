/* Curves and surfaces from callbacks: a circle, and the torus that is the offset of a torus. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <pthread.h>

static const double PI = 3.14159265358979323846;

/* What the callbacks are handed. */
struct user {
    double radius; /* of the circle, or of the tube; the axis of the torus has radius 3 */
    int32_t orders; /* how many are delivered; negative: fails */
    int released;
};

static int32_t circle(void *data, double u, uint32_t derivatives, double *out) {
    const struct user *user = (const struct user *)data;
    const double c = user->radius * cos(u), s = user->radius * sin(u);
    const double values[9] = {c, s, 0, -s, c, 0, -c, -s, 0};
    int32_t orders = (int32_t)derivatives < user->orders ? (int32_t)derivatives : user->orders;
    if (orders >= 0) memcpy(out, values, (size_t)(orders + 1) * 3 * sizeof *out);
    return orders;
}

static int32_t torus(void *data, double u, double v, uint32_t derivatives, double *out) {
    static const size_t counts[3] = {3, 9, 18};
    const struct user *user = (const struct user *)data;
    const double r = user->radius, su = sin(u), cu = cos(u), sv = sin(v), cv = cos(v), w = 3 + r * cv;
    const double values[18] = {w * cu,        w * su,        r * sv,       -w * su,  w * cu,  0,
                               -r * sv * cu,  -r * sv * su,  r * cv,       -w * cu,  -w * su, 0,
                               r * sv * su,   -r * sv * cu,  0,            -r * cv * cu, -r * cv * su, -r * sv};
    int32_t orders = (int32_t)derivatives < user->orders ? (int32_t)derivatives : user->orders;
    if (orders >= 0) memcpy(out, values, counts[orders] * sizeof *out);
    return orders;
}

static void release(void *data) { ((struct user *)data)->released++; }

static fpt_curve_callback circle_callback(struct user *user, int with_bounds) {
    fpt_curve_callback callback;
    memset(&callback, 0, sizeof callback);
    callback.struct_size = sizeof callback;
    callback.evaluate = circle;
    callback.user = user;
    callback.release = release;
    callback.domain[1] = 2 * PI;
    if (with_bounds) callback.speed_bound = callback.second_bound = user->radius;
    return callback;
}

static fpt_surface_callback torus_callback(struct user *user, int with_bounds) {
    fpt_surface_callback callback;
    memset(&callback, 0, sizeof callback);
    callback.struct_size = sizeof callback;
    callback.evaluate = torus;
    callback.user = user;
    callback.release = release;
    callback.domain[1] = callback.domain[3] = 2 * PI;
    if (with_bounds) {
        callback.speed_bounds[0] = callback.second_bounds[0] = 3 + user->radius;
        callback.speed_bounds[1] = callback.second_bounds[1] = callback.second_bounds[2] = user->radius;
    }
    return callback;
}

static double torus_distance(const double q[3], double radius) {
    double x = sqrt(q[0] * q[0] + q[1] * q[1]) - 3;
    return fabs(sqrt(x * x + q[2] * q[2]) - radius);
}

static void a_curve_answers_like_any_other(void) {
    for (int32_t orders = 0; orders <= 2; orders++) {
        for (int with_bounds = 0; with_bounds <= 1; with_bounds++) {
            struct user user = {2, 0, 0};
            user.orders = orders;
            fpt_curve_callback callback = circle_callback(&user, with_bounds);
            fpt_curve *curve = NULL;
            CHECK_OK(fpt_curve_from_callback(&callback, &curve));
            double domain[2], box[6], values[9], many[18];
            const double parameters[2] = {0, 0.5 * PI}, queries[6] = {1, 1, 1, 0, -2, 0};
            int32_t yes = -1;
            CHECK_OK(fpt_curve_domain(curve, domain));
            CHECK(domain[0] == 0 && domain[1] == 2 * PI);
            CHECK_OK(fpt_curve_box(curve, box));
            CHECK_NEAR(box[0], -2, 1e-3);
            CHECK_NEAR(box[4], 2, 1e-3);
            CHECK_OK(fpt_curve_is_closed(curve, &yes));
            CHECK(yes == 1);
            CHECK_OK(fpt_curve_is_rational(curve, &yes));
            CHECK(yes == 0);
            CHECK_OK(fpt_curve_prepare(curve));
            CHECK_OK(fpt_curve_evaluate(curve, 0, 2, values));
            CHECK(values[0] == 2 && values[1] == 0);
            CHECK_NEAR(values[4], 2, 1e-8);
            CHECK_NEAR(values[6], -2, 1e-4);
            CHECK_OK(fpt_curve_evaluate_many(curve, parameters, 2, 2, many));
            CHECK_SAME_BITS(many, values, sizeof values);
            CHECK_NEAR(many[10], 2, 1e-15);
            fpt_foot_point feet[2];
            CHECK_OK(fpt_curve_closest(curve, queries, 2, NULL, feet));
            CHECK_NEAR(feet[0].distance, sqrt(3 + 4 - 4 * sqrt(2)), 1e-12);
            CHECK_NEAR(feet[1].u, 1.5 * PI, 1e-9);
            CHECK(((feet[0].flags & FPT_FOOT_NOT_PROVEN) == 0) == with_bounds);
            CHECK_OK(fpt_curve_invert(curve, queries, 2, NULL, feet));
            CHECK(with_bounds == ((feet[0].flags & FPT_FOOT_NOT_ON_SHAPE) != 0));
            CHECK((feet[1].flags & FPT_FOOT_NOT_ON_SHAPE) == 0);
            CHECK(user.released == 0);
            fpt_curve_free(curve);
            CHECK(user.released == 1);
        }
    }
}

static void a_surface_answers_like_any_other(void) {
    for (int32_t orders = 0; orders <= 2; orders++) {
        for (int with_bounds = 0; with_bounds <= 1; with_bounds++) {
            struct user user = {1.25, 0, 0};
            user.orders = orders;
            fpt_surface_callback callback = torus_callback(&user, with_bounds);
            fpt_surface *surface = NULL;
            CHECK_OK(fpt_surface_from_callback(&callback, &surface));
            double domain[4], box[6], values[18], many[36];
            const double parameters[4] = {0, 0, 1, 2}, low[3] = {-4, -4, -2}, high[3] = {4, 4, 2};
            int32_t yes = -1, edges[4] = {-1, -1, -1, -1};
            CHECK_OK(fpt_surface_domain(surface, domain));
            CHECK(domain[0] == 0 && domain[3] == 2 * PI);
            CHECK_OK(fpt_surface_box(surface, box));
            CHECK_NEAR(box[5], 1.25, 1e-12);
            CHECK_OK(fpt_surface_is_closed_u(surface, &yes));
            CHECK(yes == 1);
            CHECK_OK(fpt_surface_is_closed_v(surface, &yes));
            CHECK(yes == 1);
            CHECK_OK(fpt_surface_is_rational(surface, &yes));
            CHECK(yes == 0);
            CHECK_OK(fpt_surface_collapsed_edges(surface, edges));
            CHECK(edges[0] == 0 && edges[1] == 0 && edges[2] == 0 && edges[3] == 0);
            CHECK_OK(fpt_surface_prepare(surface));
            CHECK_OK(fpt_surface_evaluate(surface, 0, 0, 2, values));
            CHECK(values[0] == 4.25);
            CHECK_NEAR(values[4], 4.25, 1e-8);
            CHECK_NEAR(values[15], -1.25, 1e-4);
            CHECK_OK(fpt_surface_evaluate_many(surface, parameters, 2, 2, many));
            CHECK_SAME_BITS(many, values, sizeof values);
            enum { COUNT = 50 };
            double *points = scattered_points(COUNT, low, high, 0.2);
            fpt_foot_point feet[COUNT];
            CHECK_OK(fpt_surface_closest(surface, points, COUNT, NULL, feet));
            for (int i = 0; i < COUNT; i++) {
                double truth = torus_distance(points + 3 * i, 1.25);
                CHECK_NEAR(feet[i].distance, truth, 1e-9);
                CHECK(feet[i].lower_bound <= truth + 1e-12);
                CHECK(((feet[i].flags & FPT_FOOT_NOT_PROVEN) == 0) == with_bounds);
            }
            CHECK_OK(fpt_surface_invert(surface, many + 18, 1, NULL, feet));
            CHECK_NEAR(feet[0].v, 2, 1e-9);
            free(points);
            fpt_surface_free(surface);
            CHECK(user.released == 1);
        }
    }
}

static void what_belongs_to_splines_is_unsupported(void) {
    struct user user = {1, 2, 0};
    fpt_curve_callback of_curve = circle_callback(&user, 1);
    fpt_surface_callback of_surface = torus_callback(&user, 1);
    fpt_curve *curve = NULL;
    fpt_surface *surface = NULL;
    size_t count;
    double out[64];
    CHECK_OK(fpt_curve_from_callback(&of_curve, &curve));
    CHECK_OK(fpt_surface_from_callback(&of_surface, &surface));
    CHECK_ERROR(fpt_curve_degree(curve, &count), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_curve_pole_count(curve, &count), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_curve_knots(curve, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_curve_poles(curve, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_curve_weights(curve, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_curve_evaluate(curve, 0, 3, out), FPT_UNSUPPORTED, "derivatives");
    CHECK_ERROR(fpt_curve_evaluate(curve, 7, 0, out), FPT_INVALID_ARGUMENT, "u:");
    CHECK_ERROR(fpt_curve_evaluate(curve, 0, 32, out), FPT_INVALID_ARGUMENT, "derivatives");
    CHECK_ERROR(fpt_surface_degree_u(surface, &count), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_degree_v(surface, &count), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_pole_count_u(surface, &count), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_pole_count_v(surface, &count), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_knots_u(surface, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_knots_v(surface, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_poles(surface, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_weights(surface, 64, out), FPT_UNSUPPORTED, "given by a function");
    CHECK_ERROR(fpt_surface_evaluate(surface, 0, 0, 3, out), FPT_UNSUPPORTED, "derivatives");
    CHECK_ERROR(fpt_surface_evaluate_many(surface, out, 0, 3, out), FPT_UNSUPPORTED, "derivatives");
    CHECK_ERROR(fpt_surface_evaluate(surface, 0, NAN, 0, out), FPT_INVALID_ARGUMENT, "v:");
    fpt_curve_free(curve);
    fpt_surface_free(surface);
    CHECK(user.released == 2);
}

static int never(void *user) { return *(int *)user; }

/* The members of a set, which is released; -1 when the status is not the expected one. */
static long members_of(fpt_status status, fpt_status expected, fpt_foot_set **made, fpt_foot_member *first) {
    fpt_foot_set *set = *made;
    size_t count = 0, open = 0;
    CHECK_STATUS(status, expected);
    *made = NULL;
    if (status != expected || !set) return -1;
    CHECK_OK(fpt_foot_set_count(set, &count));
    CHECK_OK(fpt_foot_set_undecided_count(set, &open));
    CHECK((open == 0) == (expected == FPT_OK));
    if (count > 0) CHECK_OK(fpt_foot_set_get(set, 0, first));
    if (open > 0) {
        double area[4];
        CHECK_OK(fpt_foot_set_undecided_get(set, 0, area));
        CHECK(area[0] < area[1]);
    }
    fpt_foot_set_free(set);
    return (long)count;
}

static void sets_work_too(void) {
    for (int with_bounds = 0; with_bounds <= 1; with_bounds++) {
        struct user user = {1.25, 1, 0};
        const fpt_curve_callback of_curve = circle_callback(&user, with_bounds);
        const fpt_surface_callback of_surface = torus_callback(&user, with_bounds);
        const fpt_status expected = with_bounds ? FPT_OK : FPT_BUDGET_EXHAUSTED;
        const double on_circle[3] = {0, 1.25, 0}, on_seam[3] = {4.25, 0, 0}, query[3] = {4, 1, 2}, up[3] = {0, 0, 1};
        fpt_curve *curve = NULL;
        fpt_surface *surface = NULL;
        fpt_foot_set *set = NULL;
        fpt_foot_member first;
        fpt_foot_point foot;
        CHECK_OK(fpt_curve_from_callback(&of_curve, &curve));
        CHECK_OK(fpt_surface_from_callback(&of_surface, &surface));
        CHECK(members_of(fpt_curve_preimage(curve, on_circle, 0, NULL, &set), expected, &set, &first) == 1);
        CHECK_NEAR(first.foot.u, 0.5 * PI, 1e-9);
        CHECK(first.u[0] <= first.foot.u && first.foot.u <= first.u[1]);
        CHECK(members_of(fpt_surface_preimage(surface, on_seam, 0, NULL, &set), expected, &set, &first) == 4);
        CHECK(first.foot.u == 0 && first.foot.v == 0);
        CHECK(members_of(fpt_curve_extrema(curve, query, NULL, &set), expected, &set, &first) == 2);
        CHECK(first.nature == FPT_NATURE_MINIMUM);
        CHECK(members_of(fpt_surface_extrema(surface, query, NULL, &set), expected, &set, &first) == 4);
        CHECK_NEAR(first.foot.distance, torus_distance(query, 1.25), 1e-9);
        CHECK(first.nature == FPT_NATURE_MINIMUM && first.kind == FPT_MEMBER_POINT);
        fpt_extrema_options options;
        fpt_extrema_options_init(&options, sizeof options);
        options.minima_only = 1;
        CHECK(members_of(fpt_surface_extrema(surface, query, &options, &set), expected, &set, &first) == 1);
        int stop = 1;
        options.should_stop = never;
        options.user = &stop;
        CHECK_STATUS(fpt_surface_extrema(surface, query, &options, &set), FPT_CANCELLED);
        CHECK_ERROR(fpt_surface_on_line(surface, query, up, NULL, 0, NULL, &set), FPT_UNSUPPORTED, "given by a function");
        CHECK_ERROR(fpt_curve_on_line(curve, query, up, NULL, 0, NULL, &set), FPT_UNSUPPORTED, "given by a function");
        CHECK_ERROR(fpt_curve_project(curve, query, 1, up, NULL, &foot), FPT_UNSUPPORTED, "given by a function");
        CHECK_ERROR(fpt_surface_project(surface, query, 1, up, NULL, &foot), FPT_UNSUPPORTED, "given by a function");
        fpt_curve_free(curve);
        fpt_surface_free(surface);
        CHECK(user.released == 2);
    }
}

static void a_bad_curve_is_refused(void) {
    struct user user = {1, 2, 0};
    const fpt_curve_callback good = circle_callback(&user, 1);
    fpt_curve_callback bad = good;
    fpt_curve *curve = NULL;
    CHECK_ERROR(fpt_curve_from_callback(NULL, &curve), FPT_NULL_ARGUMENT, "callback");
    CHECK_ERROR(fpt_curve_from_callback(&good, NULL), FPT_NULL_ARGUMENT, "out");
    bad.evaluate = NULL;
    CHECK_ERROR(fpt_curve_from_callback(&bad, &curve), FPT_NULL_ARGUMENT, "evaluate");
    bad = good;
    bad.struct_size = offsetof(fpt_curve_callback, second_bound);
    CHECK_ERROR(fpt_curve_from_callback(&bad, &curve), FPT_INVALID_ARGUMENT, "struct_size");
    const double domains[][2] = {{1, 1}, {2, 1}, {NAN, 1}, {0, INFINITY}, {1e9, 1e9 + 1e-6}};
    for (size_t i = 0; i < COUNT_OF(domains); i++) {
        bad = good;
        memcpy(bad.domain, domains[i], sizeof bad.domain);
        CHECK_ERROR(fpt_curve_from_callback(&bad, &curve), FPT_INVALID_ARGUMENT, "domain");
    }
    const double bounds[] = {-1, NAN, INFINITY};
    for (size_t i = 0; i < COUNT_OF(bounds); i++) {
        bad = good;
        bad.speed_bound = bounds[i];
        CHECK_ERROR(fpt_curve_from_callback(&bad, &curve), FPT_INVALID_ARGUMENT, "speed bound");
        bad = good;
        bad.second_bound = bounds[i];
        CHECK_ERROR(fpt_curve_from_callback(&bad, &curve), FPT_INVALID_ARGUMENT, "second bound");
    }
    user.orders = -1;
    CHECK_ERROR(fpt_curve_from_callback(&good, &curve), FPT_INVALID_ARGUMENT, "finite");
    CHECK(curve == NULL && user.released == 0);
}

static void a_bad_surface_is_refused(void) {
    struct user user = {1, 2, 0};
    const fpt_surface_callback good = torus_callback(&user, 1);
    fpt_surface_callback bad = good;
    fpt_surface *surface = NULL;
    CHECK_ERROR(fpt_surface_from_callback(NULL, &surface), FPT_NULL_ARGUMENT, "callback");
    CHECK_ERROR(fpt_surface_from_callback(&good, NULL), FPT_NULL_ARGUMENT, "out");
    bad.evaluate = NULL;
    CHECK_ERROR(fpt_surface_from_callback(&bad, &surface), FPT_NULL_ARGUMENT, "evaluate");
    bad = good;
    bad.struct_size = 8;
    CHECK_ERROR(fpt_surface_from_callback(&bad, &surface), FPT_INVALID_ARGUMENT, "struct_size");
    bad = good;
    bad.domain[3] = bad.domain[2];
    CHECK_ERROR(fpt_surface_from_callback(&bad, &surface), FPT_INVALID_ARGUMENT, "domain");
    bad = good;
    bad.speed_bounds[1] = NAN;
    CHECK_ERROR(fpt_surface_from_callback(&bad, &surface), FPT_INVALID_ARGUMENT, "speed bound");
    bad = good;
    bad.second_bounds[2] = -2;
    CHECK_ERROR(fpt_surface_from_callback(&bad, &surface), FPT_INVALID_ARGUMENT, "second bound");
    user.orders = -5;
    CHECK_ERROR(fpt_surface_from_callback(&good, &surface), FPT_INVALID_ARGUMENT, "finite");
    CHECK(surface == NULL && user.released == 0);
}

/* A function that begins to fail: evaluation says where, queries are marked, the handle stays good. */
static void a_function_may_fail(void) {
    struct user user = {1.25, 2, 0};
    const fpt_surface_callback callback = torus_callback(&user, 1);
    fpt_surface *surface = NULL;
    fpt_foot_point foot;
    double out[3] = {7, 7, 7};
    const double query[3] = {5, 0, 0}, parameters[2] = {1, 1};
    CHECK_OK(fpt_surface_from_callback(&callback, &surface));
    user.orders = -1;
    CHECK_ERROR(fpt_surface_evaluate(surface, 1, 2, 0, out), FPT_INVALID_ARGUMENT, "[1.0, 2.0]");
    CHECK(out[0] == 7);
    CHECK_STATUS(fpt_surface_evaluate_many(surface, parameters, 1, 0, out), FPT_INVALID_ARGUMENT);
    CHECK_OK(fpt_surface_closest(surface, query, 1, NULL, &foot));
    CHECK(isnan(foot.u) && isnan(foot.distance) && foot.lower_bound == 0);
    CHECK(foot.flags == FPT_FOOT_NOT_PROVEN);
    user.orders = 0;
    CHECK_OK(fpt_surface_closest(surface, query, 1, NULL, &foot));
    CHECK_NEAR(foot.distance, 0.75, 1e-9);
    fpt_surface_free(surface);
    CHECK(user.released == 1);
}

/* Options work as for splines: box, hints, local scope, cancelling. */
static void options_are_respected(void) {
    struct user user = {1.25, 1, 0};
    const fpt_surface_callback callback = torus_callback(&user, 1);
    fpt_surface *surface = NULL;
    CHECK_OK(fpt_surface_from_callback(&callback, &surface));
    fpt_query_options options = default_options();
    fpt_foot_point foot;
    const double query[3] = {5, 0.1, 0.2}, hint[2] = {3, 3}, domain[4] = {1, 2, 0.5, 7}, inside[4] = {1, 2, 0.5, 3};
    int stop = 1;
    memcpy(options.domain, domain, sizeof domain);
    CHECK_ERROR(fpt_surface_closest(surface, query, 1, &options, &foot), FPT_INVALID_ARGUMENT, "domain");
    memcpy(options.domain, inside, sizeof inside);
    CHECK_OK(fpt_surface_closest(surface, query, 1, &options, &foot));
    CHECK(foot.u == 1 && foot.v >= 0.5 && (foot.flags & FPT_FOOT_NOT_PROVEN) == 0);
    options = default_options();
    options.hints = hint;
    CHECK_OK(fpt_surface_closest(surface, query, 1, &options, &foot));
    CHECK_NEAR(foot.distance, torus_distance(query, 1.25), 1e-9);
    CHECK((foot.flags & FPT_FOOT_HINT_USED) != 0);
    options.scope = FPT_SCOPE_LOCAL;
    CHECK_OK(fpt_surface_closest(surface, query, 1, &options, &foot));
    CHECK((foot.flags & FPT_FOOT_NOT_PROVEN) != 0 && foot.lower_bound == 0);
    options = default_options();
    options.should_stop = never;
    options.user = &stop;
    CHECK_STATUS(fpt_surface_closest(surface, query, 1, &options, &foot), FPT_CANCELLED);
    CHECK(isnan(foot.u));
    fpt_surface_free(surface);
}

struct job {
    const fpt_surface *surface;
    const double *points;
    size_t count;
    fpt_foot_point *out;
    fpt_status status;
};

static void *ask(void *argument) {
    struct job *job = (struct job *)argument;
    job->status = fpt_surface_closest(job->surface, job->points, job->count, NULL, job->out);
    return NULL;
}

/* The function is called on many threads at a time, and the bits are the same. */
static void threads_share_a_function(void) {
    enum { COUNT = 600, THREADS = 4 };
    struct user user = {1.25, 1, 0};
    const fpt_surface_callback callback = torus_callback(&user, 1);
    const double low[3] = {-4, -4, -2}, high[3] = {4, 4, 2};
    fpt_surface *surface = NULL;
    CHECK_OK(fpt_surface_from_callback(&callback, &surface));
    double *points = scattered_points(COUNT, low, high, 0.2);
    fpt_foot_point *expected = (fpt_foot_point *)malloc(COUNT * sizeof *expected);
    fpt_query_options options = default_options();
    options.threads = 1;
    CHECK_OK(fpt_surface_closest(surface, points, COUNT, &options, expected));
    pthread_t threads[THREADS];
    struct job jobs[THREADS];
    for (int i = 0; i < THREADS; i++) {
        struct job job = {surface, points, COUNT, NULL, FPT_INTERNAL};
        job.out = (fpt_foot_point *)malloc(COUNT * sizeof *job.out);
        jobs[i] = job;
        CHECK(pthread_create(&threads[i], NULL, ask, &jobs[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK(jobs[i].status == FPT_OK);
        CHECK_SAME_BITS(jobs[i].out, expected, COUNT * sizeof *expected);
        free(jobs[i].out);
    }
    free(expected);
    free(points);
    fpt_surface_free(surface);
    CHECK(user.released == 1);
}

/* No release, no user data: both may be NULL. */
static int32_t parabola(void *data, double u, uint32_t derivatives, double *out) {
    (void)data;
    (void)derivatives;
    out[0] = u;
    out[1] = u * u;
    out[2] = 0;
    return 0;
}

static void user_and_release_may_be_null(void) {
    fpt_curve_callback callback;
    fpt_curve *curve = NULL;
    fpt_foot_point foot;
    const double query[3] = {0, 0.25, 0};
    memset(&callback, 0, sizeof callback);
    callback.struct_size = sizeof callback;
    callback.evaluate = parabola;
    callback.domain[0] = -1;
    callback.domain[1] = 1;
    callback.second_bound = 2;
    CHECK_OK(fpt_curve_from_callback(&callback, &curve));
    CHECK_OK(fpt_curve_closest(curve, query, 1, NULL, &foot));
    CHECK_NEAR(foot.distance, 0.25, 1e-12);
    CHECK((foot.flags & FPT_FOOT_NOT_PROVEN) == 0);
    fpt_curve_free(curve);
}

int main(void) {
    RUN(a_curve_answers_like_any_other);
    RUN(a_surface_answers_like_any_other);
    RUN(what_belongs_to_splines_is_unsupported);
    RUN(sets_work_too);
    RUN(a_bad_curve_is_refused);
    RUN(a_bad_surface_is_refused);
    RUN(a_function_may_fail);
    RUN(options_are_respected);
    RUN(threads_share_a_function);
    RUN(user_and_release_may_be_null);
    return check_report("callback_shapes");
}
