/* should_stop, progress and trace: who calls them, when, and what remains after a stop. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <pthread.h>

enum { POINTS = 20000 };

struct witness {
    pthread_t caller;
    const fpt_surface *surface;
    long polls, stop_at, reports, foreign_calls, disorder, traced;
    size_t last_done, total;
    size_t last_query;
    uint32_t last_step;
    fpt_status inner_status;
};

static int stop_when_asked(void *user) {
    struct witness *w = (struct witness *)user;
    if (!pthread_equal(w->caller, pthread_self())) w->foreign_calls++;
    w->polls++;
    return w->stop_at > 0 && w->polls >= w->stop_at;
}

static void note_progress(void *user, size_t done, size_t total) {
    struct witness *w = (struct witness *)user;
    if (!pthread_equal(w->caller, pthread_self())) w->foreign_calls++;
    if (done < w->last_done || done > total) w->disorder++;
    w->last_done = done;
    w->total = total;
    w->reports++;
}

/* Steps of one query are numbered from 0 without gaps, and each refinement starts again at 0. */
static void note_step(void *user, size_t query, uint32_t step, double u, double v, double residual) {
    struct witness *w = (struct witness *)user;
    if (!pthread_equal(w->caller, pthread_self())) w->foreign_calls++;
    if (w->traced > 0 && query < w->last_query) w->disorder++;
    if (step != 0 && (query != w->last_query || step != w->last_step + 1)) w->disorder++;
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1 && residual >= 0)) w->disorder++;
    w->last_query = query;
    w->last_step = step;
    w->traced++;
}

static void ask_from_inside(void *user, size_t done, size_t total) {
    struct witness *w = (struct witness *)user;
    fpt_surface_data data = paper_surface(1);
    fpt_surface *other = NULL;
    double domain[4];
    const double point[3] = {300, 250, 100};
    fpt_foot_point foot;
    fpt_status status = fpt_surface_closest(w->surface, point, 1, NULL, &foot);
    if (status == FPT_OK) status = fpt_surface_domain(w->surface, domain);
    if (status == FPT_OK) status = fpt_surface_new(&data, &other);
    if (status == FPT_OK) status = fpt_surface_prepare(other);
    if (fpt_surface_domain(NULL, domain) != FPT_NULL_ARGUMENT) status = FPT_INTERNAL;
    fpt_surface_free(other);
    if (status != FPT_OK) w->inner_status = status;
    note_progress(user, done, total);
}

static fpt_query_options watched(struct witness *w, const fpt_surface *surface, uint32_t threads) {
    fpt_query_options options = default_options();
    memset(w, 0, sizeof *w);
    w->caller = pthread_self();
    w->surface = surface;
    options.threads = threads;
    options.should_stop = stop_when_asked;
    options.progress = note_progress;
    options.user = w;
    return options;
}

static double *paper_points(void) {
    static const double low[3] = {90, 100, 0}, high[3] = {575, 440, 60};
    return scattered_points(POINTS, low, high, 0.3);
}

static void callbacks_come_on_the_calling_thread(void) {
    static const uint32_t threads[] = {1, 2, 8, 0};
    double *points = paper_points();
    fpt_foot_point *plain = (fpt_foot_point *)malloc(POINTS * sizeof *plain);
    fpt_foot_point *out = (fpt_foot_point *)malloc(POINTS * sizeof *out);
    fpt_surface *surface = make_surface(paper_surface(0));
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, NULL, plain));
    for (size_t t = 0; t < COUNT_OF(threads); t++) {
        struct witness w;
        fpt_query_options options = watched(&w, surface, threads[t]);
        CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, out));
        CHECK(w.foreign_calls == 0 && w.disorder == 0);
        CHECK(w.polls > 0 && w.reports > 0);
        CHECK(w.last_done == POINTS && w.total == POINTS);
        CHECK_SAME_BITS(out, plain, POINTS * sizeof *out);
    }
    fpt_surface_free(surface);
    free(out);
    free(plain);
    free(points);
}

/* After a stop a record is either the full answer or says that it was not reached. */
static void a_stop_leaves_no_half_answer(void) {
    static const long stops[] = {1, 2, 3, 5};
    double *points = paper_points();
    fpt_foot_point *plain = (fpt_foot_point *)malloc(POINTS * sizeof *plain);
    fpt_foot_point *out = (fpt_foot_point *)malloc(POINTS * sizeof *out);
    fpt_surface *surface = make_surface(paper_surface(0));
    CHECK_OK(fpt_surface_closest(surface, points, POINTS, NULL, plain));
    for (uint32_t threads = 1; threads <= 3; threads++) {
        for (size_t s = 0; s < COUNT_OF(stops); s++) {
            struct witness w;
            fpt_query_options options = watched(&w, surface, threads);
            long reached = 0, missing = 0, other = 0;
            w.stop_at = stops[s];
            fill_pattern(out, POINTS * sizeof *out);
            CHECK_STATUS(fpt_surface_closest(surface, points, POINTS, &options, out), FPT_CANCELLED);
            for (size_t i = 0; i < POINTS; i++) {
                const fpt_foot_point *f = out + i;
                if (memcmp(f, plain + i, sizeof *f) == 0) {
                    reached++;
                } else if (isnan(f->u) && isnan(f->v) && isnan(f->point[0]) && isnan(f->point[1]) && isnan(f->point[2]) &&
                           isnan(f->distance) && f->lower_bound == 0 && (f->flags & FPT_FOOT_NOT_PROVEN)) {
                    missing++;
                } else {
                    other++;
                }
            }
            CHECK(w.foreign_calls == 0);
            CHECK(other == 0);
            CHECK_MESSAGE(missing > 0, "stopped at poll %ld, yet all of %ld answers are there", stops[s], reached);
        }
    }
    fpt_surface_free(surface);
    free(out);
    free(plain);
    free(points);
}

/* The index of a fresh shape is built inside the first query, which can be stopped there; the shape stays good. */
static void a_stop_while_the_index_is_built_does_no_harm(void) {
    double *points = paper_points();
    fpt_surface *surface = make_surface(paper_surface(1));
    fpt_surface *reference = make_surface(paper_surface(1));
    struct witness w;
    fpt_query_options options = watched(&w, surface, 1);
    fpt_foot_point first, second;
    w.stop_at = 1;
    CHECK_STATUS(fpt_surface_closest(surface, points, 1, &options, &first), FPT_CANCELLED);
    CHECK(isnan(first.distance) && first.lower_bound == 0);
    CHECK_OK(fpt_surface_closest(surface, points, 1, NULL, &first));
    CHECK_OK(fpt_surface_closest(reference, points, 1, NULL, &second));
    CHECK_SAME_BITS(&first, &second, sizeof first);
    fpt_surface_free(surface);
    fpt_surface_free(reference);
    free(points);
}

static void callbacks_may_ask_the_library(void) {
    double *points = paper_points();
    fpt_foot_point *out = (fpt_foot_point *)malloc(POINTS * sizeof *out);
    fpt_surface *surface = make_surface(paper_surface(0));
    for (uint32_t threads = 0; threads <= 2; threads++) {
        struct witness w;
        fpt_query_options options = watched(&w, surface, threads);
        options.progress = ask_from_inside;
        CHECK_OK(fpt_surface_closest(surface, points, POINTS, &options, out));
        CHECK_STATUS(w.inner_status, FPT_OK);
        CHECK(w.disorder == 0 && w.last_done == POINTS);
    }
    fpt_surface_free(surface);
    free(out);
    free(points);
}

/* A trace forces one thread, comes in the order of the queries, and changes nothing. */
static void a_trace_is_in_order_and_changes_nothing(void) {
    enum { FEW = 200 };
    double *points = paper_points();
    fpt_foot_point plain[FEW], out[FEW];
    fpt_surface *surface = make_surface(paper_surface(0));
    for (uint32_t method = FPT_METHOD_AUTO; method <= FPT_METHOD_OSCULATING; method++) {
        struct witness w;
        fpt_query_options options = watched(&w, surface, 8);
        options.method = method;
        CHECK_OK(fpt_surface_closest(surface, points, FEW, &options, plain));
        options.trace = note_step;
        w.last_done = 0;
        CHECK_OK(fpt_surface_closest(surface, points, FEW, &options, out));
        CHECK(w.foreign_calls == 0 && w.disorder == 0 && w.traced > 0);
        CHECK_SAME_BITS(out, plain, sizeof plain);
    }
    fpt_surface_free(surface);
    free(points);
}

int main(void) {
    RUN(callbacks_come_on_the_calling_thread);
    RUN(a_stop_leaves_no_half_answer);
    RUN(a_stop_while_the_index_is_built_does_no_harm);
    RUN(callbacks_may_ask_the_library);
    RUN(a_trace_is_in_order_and_changes_nothing);
    return check_report("callbacks");
}
