/* Example 2 of the paper that footpoint started from: point inversion on a bicubic B-spline surface with the
 * moving-affine-frame method (Hu, Sun, Jin, Wang, Journal of Software). First the iteration as published, step by
 * step from a given start; then the question a user has: the parameters of the point, without a start, with a proof.
 *
 *   cc -std=c99 -O2 paper_example.c -o paper_example -lfootpoint -lm
 */
#include <footpoint.h>
#include <math.h>
#include <stdio.h>

enum { COUNT_U = 7, COUNT_V = 4 };

static const double KNOTS_U[] = {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};
static const double KNOTS_V[] = {0, 0, 0, 0, 1, 1, 1, 1};

/* The paper lists the net as four rows of seven poles: u runs fastest. */
static const double PRINTED[COUNT_V][COUNT_U][3] = {
    {{100, 100, 0}, {130, 180, 30}, {120, 270, 30}, {90, 360, 0}, {180, 120, 30}, {160, 200, 60}, {190, 320, 60}},
    {{150, 440, 30}, {250, 140, 30}, {230, 200, 60}, {260, 330, 60}, {240, 400, 30}, {330, 100, 0}, {350, 220, 30}},
    {{340, 290, 30}, {330, 400, 0}, {410, 120, 30}, {380, 200, 60}, {400, 320, 60}, {390, 440, 30}, {460, 140, 30}},
    {{440, 200, 60}, {460, 330, 60}, {480, 400, 30}, {540, 100, 0}, {570, 220, 30}, {550, 290, 30}, {575, 400, 0}},
};

static const double POINT[3] = {277.34742334732, 248.13730252438, 28.748699053051};
static const double START[2] = {0.125, 0.375};

static fpt_status new_surface(fpt_surface **out) {
    double poles[COUNT_U][COUNT_V][3]; /* footpoint wants v fastest */
    for (int i = 0; i < COUNT_U; i++)
        for (int j = 0; j < COUNT_V; j++)
            for (int axis = 0; axis < 3; axis++) poles[i][j][axis] = PRINTED[j][i][axis];

    fpt_surface_data data = {sizeof data, 3, 3, COUNT_U, COUNT_V, KNOTS_U, KNOTS_V, &poles[0][0][0], NULL};
    return fpt_surface_new(&data, out);
}

static void print_step(void *user, size_t query, uint32_t step, double u, double v, double residual) {
    (void)user, (void)query;
    printf("  %4u   %.15f   %.15f   %.3e\n", (unsigned)step, u, v, residual);
}

/* The published iteration: a local method that trusts its start. */
static fpt_status follow_the_paper(const fpt_surface *surface, fpt_foot_point *foot) {
    fpt_query_options options;
    fpt_query_options_init(&options, sizeof options);
    options.method = FPT_METHOD_MAF;
    options.scope = FPT_SCOPE_LOCAL;
    options.hints = START;
    options.trace = print_step;

    printf("Moving-affine-frame iteration from the paper's start\n\n");
    printf("  step   u                   v                   |X - S(u,v)|\n");
    return fpt_surface_invert(surface, POINT, 1, &options, foot);
}

static void print_answer(const fpt_foot_point *foot) {
    printf("\nGlobal inversion without a start\n\n");
    printf("  u, v            %.15f   %.15f\n", foot->u, foot->v);
    printf("  distance        %.3e, proven to be at least %.3e\n", foot->distance, foot->lower_bound);
    printf("  certificate     %s\n", foot->flags & FPT_FOOT_NOT_PROVEN ? "NOT PROVEN" : "proven, nothing is nearer");
    printf("  evaluations     %u\n", (unsigned)foot->iterations);
}

/* The paper prints the point with 14 digits; that fixes its parameters to about 1e-12. */
static int is_the_papers_answer(const fpt_foot_point *foot) {
    return fabs(foot->u - 0.123) < 1e-11 && fabs(foot->v - 0.456) < 1e-11;
}

int main(void) {
    fpt_surface *surface = NULL;
    fpt_foot_point local, global;
    fpt_status status = new_surface(&surface);
    if (status == FPT_OK) status = follow_the_paper(surface, &local);
    if (status == FPT_OK) status = fpt_surface_invert(surface, POINT, 1, NULL, &global);
    fpt_surface_free(surface);

    if (status != FPT_OK) {
        fprintf(stderr, "paper_example: %s: %s\n", fpt_status_name(status), fpt_last_error());
        return 1;
    }
    print_answer(&global);
    return is_the_papers_answer(&local) && is_the_papers_answer(&global) ? 0 : 1;
}
