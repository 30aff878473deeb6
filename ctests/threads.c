/* Many threads on one shape, and the law that an answer depends on shape and query alone. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <pthread.h>

enum { THREADS = 16, POINTS = 2000 };

struct job {
    const fpt_curve *curve;
    const fpt_surface *surface;
    const double *points;
    fpt_foot_point *out;
    pthread_barrier_t *start;
    fpt_status status;
    int error_is_own;
};

static fpt_status closest(const fpt_curve *curve, const fpt_surface *surface, const double *points, size_t count,
                          uint32_t threads, fpt_foot_point *out) {
    fpt_query_options options = default_options();
    options.threads = threads;
    if (curve) return fpt_curve_closest(curve, points, count, &options, out);
    return fpt_surface_closest(surface, points, count, &options, out);
}

/* One thread of many: asks, fails on purpose, and sees its own error text only. */
static void *ask(void *argument) {
    struct job *job = (struct job *)argument;
    double out[3], domain[4];
    pthread_barrier_wait(job->start);
    job->status = closest(job->curve, job->surface, job->points, POINTS, 1, job->out);
    if (job->curve) {
        fpt_status refused = fpt_curve_domain(job->curve, NULL);
        job->error_is_own = refused == FPT_NULL_ARGUMENT && strstr(fpt_last_error(), "out") != NULL &&
                            fpt_curve_domain(job->curve, domain) == FPT_OK;
    } else {
        fpt_status refused = fpt_surface_evaluate(job->surface, NAN, 0, 0, out);
        job->error_is_own = refused == FPT_INVALID_ARGUMENT && fpt_last_error()[0] == 'u' &&
                            fpt_surface_domain(job->surface, domain) == FPT_OK;
    }
    return NULL;
}

/* All threads meet at a shape whose index does not exist yet. */
static void sixteen_threads_share(const fpt_curve *curve, const fpt_surface *surface, const double *points,
                                  const fpt_foot_point *expected) {
    pthread_t threads[THREADS];
    struct job jobs[THREADS];
    pthread_barrier_t start;
    CHECK(pthread_barrier_init(&start, NULL, THREADS) == 0);
    for (int i = 0; i < THREADS; i++) {
        struct job job = {curve, surface, points, NULL, &start, FPT_INTERNAL, 0};
        job.out = (fpt_foot_point *)malloc(POINTS * sizeof *job.out);
        jobs[i] = job;
        CHECK(pthread_create(&threads[i], NULL, ask, &jobs[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        CHECK(jobs[i].status == FPT_OK);
        CHECK(jobs[i].error_is_own);
        CHECK_SAME_BITS(jobs[i].out, expected, POINTS * sizeof *expected);
        free(jobs[i].out);
    }
    pthread_barrier_destroy(&start);
}

/* The same points in one batch over several thread counts, in small batches, singly, and backwards. */
static void every_division_agrees(const fpt_curve *curve, const fpt_surface *surface, const double *points,
                                  const fpt_foot_point *expected) {
    static const uint32_t thread_counts[] = {1, 2, 3, 8, 0, 1000};
    static const size_t batch_sizes[] = {1, 7, 64, 1023};
    fpt_foot_point *out = (fpt_foot_point *)malloc(POINTS * sizeof *out);
    for (size_t t = 0; t < COUNT_OF(thread_counts); t++) {
        fill_pattern(out, POINTS * sizeof *out);
        CHECK_OK(closest(curve, surface, points, POINTS, thread_counts[t], out));
        CHECK_SAME_BITS(out, expected, POINTS * sizeof *out);
    }
    for (size_t b = 0; b < COUNT_OF(batch_sizes); b++) {
        fill_pattern(out, POINTS * sizeof *out);
        for (size_t at = 0; at < POINTS; at += batch_sizes[b]) {
            size_t count = POINTS - at < batch_sizes[b] ? POINTS - at : batch_sizes[b];
            CHECK_OK(closest(curve, surface, points + 3 * at, count, 2, out + at));
        }
        CHECK_SAME_BITS(out, expected, POINTS * sizeof *out);
    }
    double *backwards = (double *)malloc(3 * POINTS * sizeof *backwards);
    for (size_t i = 0; i < POINTS; i++) memcpy(backwards + 3 * i, points + 3 * (POINTS - 1 - i), 3 * sizeof(double));
    CHECK_OK(closest(curve, surface, backwards, POINTS, 3, out));
    for (size_t i = 0; i < POINTS; i++) CHECK_SAME_BITS(out + i, expected + (POINTS - 1 - i), sizeof *out);
    free(backwards);
    free(out);
}

static void check_shape(fpt_curve_data *curve_data, fpt_surface_data *surface_data, const double low[3],
                        const double high[3]) {
    double *points = scattered_points(POINTS, low, high, 0.5);
    fpt_foot_point *expected = (fpt_foot_point *)malloc(POINTS * sizeof *expected);
    for (int round = 0; round < 4; round++) {
        fpt_curve *curve = curve_data ? make_curve(*curve_data) : NULL;
        fpt_surface *surface = surface_data ? make_surface(*surface_data) : NULL;
        if (round == 0) {
            CHECK_OK(closest(curve, surface, points, POINTS, 1, expected));
            every_division_agrees(curve, surface, points, expected);
        } else {
            sixteen_threads_share(curve, surface, points, expected);
        }
        fpt_curve_free(curve);
        fpt_surface_free(surface);
    }
    free(expected);
    free(points);
}

static void a_curve_answers_alike(void) {
    const double low[3] = {0, -2, -1}, high[3] = {9, 3, 2};
    fpt_curve_data data = cubic_curve();
    check_shape(&data, NULL, low, high);
}

/* The centre of a circle has every point as foot: ties must not depend on the division either. */
static void a_circle_answers_alike(void) {
    const double low[3] = {1, -1e-9, 0}, high[3] = {1 + 1e-9, 0, 1};
    fpt_curve_data data = circle_curve();
    check_shape(&data, NULL, low, high);
}

static void a_surface_answers_alike(void) {
    const double low[3] = {90, 100, 0}, high[3] = {575, 440, 60};
    fpt_surface_data data = paper_surface(0);
    check_shape(NULL, &data, low, high);
}

static void a_rational_surface_answers_alike(void) {
    const double low[3] = {-1, -2, 0}, high[3] = {3, 2, 3};
    fpt_surface_data data = cone_surface();
    check_shape(NULL, &data, low, high);
}

int main(void) {
    RUN(a_curve_answers_alike);
    RUN(a_circle_answers_alike);
    RUN(a_surface_answers_alike);
    RUN(a_rational_surface_answers_alike);
    return check_report("threads");
}
