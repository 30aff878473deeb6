/* Making, using and releasing shapes; versions, names of statuses, and the text of the last failure. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <pthread.h>

static void null_may_be_freed(void) {
    fpt_curve_free(NULL);
    fpt_surface_free(NULL);
}

static void layouts_are_the_published_ones(void) {
    CHECK(sizeof(fpt_foot_point) == 64);
    CHECK(offsetof(fpt_foot_point, v) == 8 && offsetof(fpt_foot_point, point) == 16);
    CHECK(offsetof(fpt_foot_point, distance) == 40 && offsetof(fpt_foot_point, lower_bound) == 48);
    CHECK(offsetof(fpt_foot_point, flags) == 56 && offsetof(fpt_foot_point, iterations) == 60);
    CHECK(offsetof(fpt_curve_data, struct_size) == 0 && offsetof(fpt_surface_data, struct_size) == 0);
    CHECK(offsetof(fpt_query_options, struct_size) == 0 && sizeof(fpt_status) == 4);
}

static void numbers_are_the_published_ones(void) {
    CHECK(FPT_OK == 0 && FPT_NULL_ARGUMENT == 1 && FPT_INVALID_ARGUMENT == 2 && FPT_BUDGET_EXHAUSTED == 3);
    CHECK(FPT_CANCELLED == 4 && FPT_UNSUPPORTED == 5 && FPT_OUT_OF_MEMORY == 6 && FPT_INTERNAL == 99);
    CHECK(FPT_FOOT_NOT_PROVEN == 1 && FPT_FOOT_EDGE == 2 && FPT_FOOT_CORNER == 4 && FPT_FOOT_SEAM == 8);
    CHECK(FPT_FOOT_COLLAPSED == 16 && FPT_FOOT_TIE == 32 && FPT_FOOT_CONTINUUM == 64 && FPT_FOOT_NOT_ON_SHAPE == 128);
    CHECK(FPT_FOOT_BAD_QUERY == 256 && FPT_FOOT_HINT_USED == 512 && FPT_FOOT_BUDGET == 1024 && FPT_FOOT_CREASE == 2048);
    CHECK(FPT_METHOD_AUTO == 0 && FPT_METHOD_MAF == 1 && FPT_METHOD_NEWTON == 2 && FPT_METHOD_OSCULATING == 3);
    CHECK(FPT_SCOPE_GLOBAL == 0 && FPT_SCOPE_LOCAL == 1);
}

static void header_and_library_are_of_one_version(void) {
    CHECK(fpt_version() == FPT_VERSION);
    CHECK(fpt_version() == FPT_VERSION_MAJOR * 1000000u + FPT_VERSION_MINOR * 1000u + FPT_VERSION_PATCH);
    CHECK(fpt_abi_version() == FPT_ABI_VERSION);
}

static void statuses_have_names(void) {
    CHECK(strcmp(fpt_status_name(FPT_OK), "FPT_OK") == 0);
    CHECK(strcmp(fpt_status_name(FPT_NULL_ARGUMENT), "FPT_NULL_ARGUMENT") == 0);
    CHECK(strcmp(fpt_status_name(FPT_INVALID_ARGUMENT), "FPT_INVALID_ARGUMENT") == 0);
    CHECK(strcmp(fpt_status_name(FPT_BUDGET_EXHAUSTED), "FPT_BUDGET_EXHAUSTED") == 0);
    CHECK(strcmp(fpt_status_name(FPT_CANCELLED), "FPT_CANCELLED") == 0);
    CHECK(strcmp(fpt_status_name(FPT_UNSUPPORTED), "FPT_UNSUPPORTED") == 0);
    CHECK(strcmp(fpt_status_name(FPT_OUT_OF_MEMORY), "FPT_OUT_OF_MEMORY") == 0);
    CHECK(strcmp(fpt_status_name(FPT_INTERNAL), "FPT_INTERNAL") == 0);
    for (fpt_status status = -3; status < 120; status++) {
        const char *name = fpt_status_name(status);
        CHECK(name != NULL && strncmp(name, "FPT_", 4) == 0);
    }
    CHECK(fpt_status_name(INT32_MIN) != NULL && fpt_status_name(INT32_MAX) != NULL);
}

static void *failures_of_a_fresh_thread(void *user) {
    double domain[4];
    int *good = (int *)user;
    good[0] = strcmp(fpt_last_error(), "") == 0;
    good[1] = fpt_surface_domain(NULL, domain) == FPT_NULL_ARGUMENT && strstr(fpt_last_error(), "surface") != NULL;
    return NULL;
}

/* The text is of this thread alone, and a success leaves it standing. */
static void the_last_error_belongs_to_its_thread(void) {
    double domain[2];
    int good[2] = {0, 0};
    char text[512];
    pthread_t thread;
    fpt_curve *curve = make_curve(cubic_curve());
    CHECK_STATUS(fpt_curve_evaluate(curve, 2, 0, domain), FPT_INVALID_ARGUMENT);
    snprintf(text, sizeof text, "%s", fpt_last_error());
    CHECK(text[0] == 'u');
    CHECK_OK(fpt_curve_domain(curve, domain));
    CHECK(strcmp(text, fpt_last_error()) == 0);
    CHECK(pthread_create(&thread, NULL, failures_of_a_fresh_thread, good) == 0);
    pthread_join(thread, NULL);
    CHECK(good[0] && good[1]);
    CHECK(strcmp(text, fpt_last_error()) == 0);
    fpt_curve_free(curve);
}

/* The arrays of the description may go away, or change, right after the call. */
static void inputs_are_copied(void) {
    fpt_curve_data described = circle_curve();
    double *knots = (double *)malloc(12 * sizeof *knots), *poles = (double *)malloc(27 * sizeof *poles);
    double *weights = (double *)malloc(9 * sizeof *weights);
    memcpy(knots, described.knots, 12 * sizeof *knots);
    memcpy(poles, described.poles, 27 * sizeof *poles);
    memcpy(weights, described.weights, 9 * sizeof *weights);
    fpt_curve *curve = make_curve(curve_data(2, 9, knots, poles, weights));
    fill_pattern(knots, 12 * sizeof *knots);
    fill_pattern(poles, 27 * sizeof *poles);
    fill_pattern(weights, 9 * sizeof *weights);
    free(knots);
    free(poles);
    free(weights);
    const double outside[3] = {6, 0, 0};
    fpt_foot_point foot;
    CHECK_OK(fpt_curve_closest(curve, outside, 1, NULL, &foot));
    CHECK_NEAR(foot.distance, 3, 1e-15);
    CHECK_NEAR(foot.point[0], 3, 1e-15);
    fpt_curve_free(curve);
}

/* Shapes of both kinds, some prepared, some asked, some neither, released in several orders. */
static void shapes_may_be_freed_in_any_order(void) {
    enum { COUNT = 5 };
    static const int orders[][COUNT] = {{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}, {2, 0, 4, 1, 3}, {3, 4, 0, 2, 1}};
    const double point[3] = {300, 250, 100};
    for (size_t k = 0; k < COUNT_OF(orders); k++) {
        fpt_curve *curves[COUNT];
        fpt_surface *surfaces[COUNT];
        fpt_foot_point foot, first;
        for (int i = 0; i < COUNT; i++) {
            curves[i] = make_curve(i % 2 ? circle_curve() : cubic_curve());
            surfaces[i] = make_surface(i % 2 ? cone_surface() : paper_surface(1));
            if (i % 3 == 0) CHECK_OK(fpt_surface_prepare(surfaces[i]));
            if (i % 3 == 1) CHECK_OK(fpt_curve_closest(curves[i], point, 1, NULL, &foot));
        }
        CHECK_OK(fpt_surface_closest(surfaces[orders[k][COUNT - 1]], point, 1, NULL, &first));
        for (int i = 0; i < COUNT; i++) {
            fpt_surface *last = surfaces[orders[k][COUNT - 1]];
            fpt_curve_free(curves[orders[k][i]]);
            CHECK_OK(fpt_surface_closest(last, point, 1, NULL, &foot));
            CHECK_SAME_BITS(&foot, &first, sizeof foot);
            fpt_surface_free(surfaces[orders[k][i]]);
        }
    }
}

/* Preparing early, twice or never is the same for every answer. */
static void preparing_changes_no_answer(void) {
    const double point[3] = {300, 250, 100};
    fpt_foot_point early, lazy;
    fpt_surface *prepared = make_surface(paper_surface(1)), *fresh = make_surface(paper_surface(1));
    CHECK_OK(fpt_surface_prepare(prepared));
    CHECK_OK(fpt_surface_prepare(prepared));
    CHECK_OK(fpt_surface_closest(prepared, point, 1, NULL, &early));
    CHECK_OK(fpt_surface_closest(fresh, point, 1, NULL, &lazy));
    CHECK_SAME_BITS(&early, &lazy, sizeof early);
    fpt_surface_free(prepared);
    fpt_surface_free(fresh);
    fpt_curve *curve = make_curve(unclamped_curve()), *other = make_curve(unclamped_curve());
    CHECK_OK(fpt_curve_prepare(curve));
    CHECK_OK(fpt_curve_prepare(curve));
    CHECK_OK(fpt_curve_closest(curve, point, 1, NULL, &early));
    CHECK_OK(fpt_curve_closest(other, point, 1, NULL, &lazy));
    CHECK_SAME_BITS(&early, &lazy, sizeof early);
    fpt_curve_free(curve);
    fpt_curve_free(other);
}

int main(void) {
    RUN(null_may_be_freed);
    RUN(layouts_are_the_published_ones);
    RUN(numbers_are_the_published_ones);
    RUN(header_and_library_are_of_one_version);
    RUN(statuses_have_names);
    RUN(the_last_error_belongs_to_its_thread);
    RUN(inputs_are_copied);
    RUN(shapes_may_be_freed_in_any_order);
    RUN(preparing_changes_no_answer);
    return check_report("lifecycle");
}
