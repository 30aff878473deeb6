/* Example 2 of the moving-affine-frame paper (Hu, Sun, Jin, Wang), with its table of iterations. */
#include "samples.h"

static const double paper_point[3] = {277.34742334732, 248.13730252438, 28.748699053051};

enum { ROWS_MAX = 64 };

struct table {
    size_t count;
    uint32_t step[ROWS_MAX];
    double u[ROWS_MAX], v[ROWS_MAX], residual[ROWS_MAX];
};

static void record_row(void *user, size_t query, uint32_t step, double u, double v, double residual) {
    struct table *table = (struct table *)user;
    (void)query;
    if (table->count == ROWS_MAX) return;
    size_t row = table->count++;
    table->step[row] = step;
    table->u[row] = u;
    table->v[row] = v;
    table->residual[row] = residual;
}

static void print_table(const struct table *table) {
    printf("  k   u                   v                   |X - S|\n");
    for (size_t i = 0; i < table->count; i++) {
        printf("  %-3u %.15f   %.15f   %.3e\n", (unsigned)table->step[i], table->u[i], table->v[i], table->residual[i]);
    }
}

static fpt_query_options traced(uint32_t method, uint32_t scope, const double *hints, struct table *table) {
    fpt_query_options options = default_options();
    options.method = method;
    options.scope = scope;
    options.hints = hints;
    options.trace = record_row;
    options.user = table;
    table->count = 0;
    return options;
}

static void maf_reproduces_the_printed_table(void) {
    static const double u[] = {0.125, 0.121216582541351, 0.122985471864912, 0.122999999150634, 0.122999999999993};
    static const double v[] = {0.375, 0.457097140092452, 0.455999937866988, 0.455999999961166, 0.455999999999993};
    static const double residual[] = {3.123e+01, 8.063e-01, 5.804e-03, 3.407e-07, 5.4e-13};
    const double hint[2] = {0.125, 0.375};
    fpt_surface *surface = make_surface(paper_surface(0));
    struct table table;
    fpt_query_options options = traced(FPT_METHOD_MAF, FPT_SCOPE_LOCAL, hint, &table);
    fpt_foot_point foot;
    CHECK_OK(fpt_surface_invert(surface, paper_point, 1, &options, &foot));
    print_table(&table);
    CHECK(table.count >= COUNT_OF(u) && table.count <= 6);
    for (size_t i = 0; i < COUNT_OF(u) && i < table.count; i++) {
        CHECK(table.step[i] == i);
        CHECK_NEAR(table.u[i], u[i], 1e-12);
        CHECK_NEAR(table.v[i], v[i], 1e-12);
        CHECK_NEAR(table.residual[i], residual[i], 1e-12 + 5e-4 * residual[i]);
    }
    CHECK_NEAR(foot.u, 0.123, 1e-12);
    CHECK_NEAR(foot.v, 0.456, 1e-12);
    CHECK(foot.distance < 1e-11);
    CHECK(foot.flags & FPT_FOOT_NOT_PROVEN);
    CHECK(!(foot.flags & FPT_FOOT_NOT_ON_SHAPE));
    CHECK(foot.lower_bound == 0);
    fpt_surface_free(surface);
}

static void global_inversion_needs_no_start(void) {
    fpt_surface *surface = make_surface(paper_surface(0));
    for (uint32_t method = FPT_METHOD_AUTO; method <= FPT_METHOD_OSCULATING; method++) {
        fpt_query_options options = default_options();
        fpt_foot_point foot;
        options.method = method;
        CHECK_OK(fpt_surface_invert(surface, paper_point, 1, &options, &foot));
        CHECK_NEAR(foot.u, 0.123, 1e-12);
        CHECK_NEAR(foot.v, 0.456, 1e-12);
        CHECK(foot.distance < 1e-11);
        CHECK(!(foot.flags & (FPT_FOOT_NOT_PROVEN | FPT_FOOT_NOT_ON_SHAPE)));
    }
    fpt_surface_free(surface);
}

/* The start that the paper computes itself: Bezier pieces, hull test, three levels of halving. */
static void local_maf_finds_its_own_start(void) {
    for (int rational = 0; rational < 2; rational++) {
        fpt_surface *surface = make_surface(paper_surface(rational));
        struct table table;
        fpt_query_options options = traced(FPT_METHOD_MAF, FPT_SCOPE_LOCAL, NULL, &table);
        double point[3];
        fpt_foot_point foot;
        CHECK_OK(fpt_surface_evaluate(surface, 0.123, 0.456, 0, point));
        CHECK_OK(fpt_surface_invert(surface, point, 1, &options, &foot));
        CHECK(table.count >= 1 && table.step[0] == 0);
        CHECK_NEAR(foot.u, 0.123, 1e-12);
        CHECK_NEAR(foot.v, 0.456, 1e-12);
        fpt_surface_free(surface);
    }
}

/* With the printed weights the printed point is off the surface; the surface's own point is found as quickly. */
static void printed_weights_are_a_rational_case(void) {
    const double hint[2] = {0.125, 0.375};
    fpt_surface *surface = make_surface(paper_surface(1));
    for (uint32_t method = FPT_METHOD_MAF; method <= FPT_METHOD_OSCULATING; method++) {
        struct table table;
        fpt_query_options options = traced(method, FPT_SCOPE_LOCAL, hint, &table);
        double point[3];
        fpt_foot_point foot;
        CHECK_OK(fpt_surface_evaluate(surface, 0.123, 0.456, 0, point));
        CHECK_OK(fpt_surface_invert(surface, point, 1, &options, &foot));
        printf("  rational, method %u: %u rows\n", (unsigned)method, (unsigned)table.count);
        CHECK(table.count <= 8);
        CHECK_NEAR(table.u[0], 0.125, 0);
        CHECK_NEAR(table.v[0], 0.375, 0);
        CHECK_NEAR(foot.u, 0.123, 1e-12);
        CHECK_NEAR(foot.v, 0.456, 1e-12);
    }
    fpt_surface_free(surface);
}

/* The paper's example 1 has lost its data; any cubic shows the same: 0.125 to 0.1234567 in a few quadratic steps. */
static void maf_on_a_curve_converges_quadratically(void) {
    const double hint = 0.125;
    fpt_curve *curve = make_curve(cubic_curve());
    struct table table;
    fpt_query_options options = traced(FPT_METHOD_MAF, FPT_SCOPE_LOCAL, &hint, &table);
    double point[3];
    fpt_foot_point foot;
    CHECK_OK(fpt_curve_evaluate(curve, 0.1234567, 0, point));
    CHECK_OK(fpt_curve_invert(curve, point, 1, &options, &foot));
    print_table(&table);
    CHECK(table.count >= 3 && table.count <= 5);
    CHECK_NEAR(table.u[0], 0.125, 0);
    for (size_t i = 1; i < table.count && table.residual[i] > 1e-14; i++) {
        CHECK(table.residual[i] < table.residual[i - 1] * table.residual[i - 1] * 10);
    }
    CHECK_NEAR(foot.u, 0.1234567, 1e-14);
    CHECK(foot.v == 0);
    fpt_curve_free(curve);
}

int main(void) {
    RUN(maf_reproduces_the_printed_table);
    RUN(global_inversion_needs_no_start);
    RUN(local_maf_finds_its_own_start);
    RUN(printed_weights_are_a_rational_case);
    RUN(maf_on_a_curve_converges_quadratically);
    return check_report("paper");
}
