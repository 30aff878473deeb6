/* Operations, constructions, fits and fairing whose memory cannot be had: each says so and creates nothing. The address space is limited, from too
 * little for a copy to enough. Each call runs in a process of its own, so that one that ends it is seen as what it is. */
#define _POSIX_C_SOURCE 200809L
#include "samples.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { POLES = 100000, SIDE = 320, NET = 48, CALLS = 36 };

static double *poles, *knots, *parameters, *grid;
static fpt_curve *curve, *other;
static fpt_surface *surface;
/* For fairing: some megabytes of equations. */
static fpt_curve *bow;
static fpt_surface *sheet;

static size_t process_size(void) {
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (fscanf(file, "%lu", &pages) != 1) pages = 0;
    fclose(file);
    return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void leave_room(size_t room) {
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0) _exit(90);
    limit.rlim_cur = (rlim_t)(process_size() + room);
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(91);
}

static const double middle[1] = {50000.5}, along[3] = {0, 0, 1}, matrix[12] = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1};
static double error;
static fpt_fit_options options;
static fpt_fair_options fairing;

static fpt_status fair(int n, void **made) {
    fpt_fair_options wanted = fairing;
    fpt_fair_report *report = NULL;
    double kept[40];
    fpt_status status;
    for (size_t k = 0; k < 40; k++) kept[k] = 60.0 + 40.0 * (double)k + 0.5;
    wanted.method = (uint32_t)(n % 4 == 3 ? FPT_FAIR_ENERGY : n % 4);
    if (n == 3) wanted.distance = 1;
    if (n == 7) {
        wanted.strain = 0, wanted.slope = 1;
        wanted.through = kept, wanted.through_count = 40;
    }
    status = n < 4 ? fpt_fair_surface(sheet, &wanted, &report) : fpt_fair_curve(bow, &wanted, &report);
    *made = report;
    return status;
}

static fpt_status call(int n, void **made) {
    fpt_curve **c = (fpt_curve **)made;
    fpt_surface **s = (fpt_surface **)made;
    fpt_curve *second = NULL;
    fpt_difference apart;
    fpt_fit_result result;
    fpt_arc_length *length = NULL;
    const fpt_curve *both[2];
    fpt_status status;
    both[0] = curve, both[1] = other;
    switch (n) {
    case 0: return fpt_curve_refine(curve, middle, 1, c);
    case 1: return fpt_curve_remove_knot(curve, 50000, 1, &error, c);
    case 2: return fpt_curve_elevate(curve, 2, c);
    case 3: return fpt_curve_part(curve, 10.5, 99000.5, c);
    case 4: return fpt_curve_clamp(curve, c);
    case 5: return fpt_curve_unclamp(curve, &error, c);
    case 6: return fpt_curve_reverse(curve, c);
    case 7: return fpt_curve_reparametrise(curve, 1.5, c);
    case 8: return fpt_curve_affine(curve, matrix, c);
    case 9: return fpt_curve_derivative(curve, c);
    case 10: return fpt_curve_bezier_form(curve, c);
    case 11: return fpt_curve_difference(curve, other, &apart);
    case 12: return fpt_curve_reduce(curve, &error, c);
    case 13:
        status = fpt_curve_split(curve, 500.5, c, &second);
        if ((second != NULL) != (status == FPT_OK)) _exit(92);
        return status;
    case 14: return fpt_curve_join(both, 2, 1e9, &error, c);
    case 15: return fpt_surface_ruled(curve, other, s);
    case 16: return fpt_surface_extruded(curve, along, s);
    case 17: return fpt_curve_interpolate(poles, POLES, NULL, NULL, c);
    case 18: return fpt_curve_least_squares(poles, POLES, parameters, 3, knots, POLES / 2 + 4, 0, c, &result);
    case 19: return fpt_curve_fit(poles, POLES, NULL, &options, c, &result);
    case 20: return fpt_surface_interpolate(grid, SIDE, SIDE, NULL, s);
    case 21: return fpt_surface_fit_grid(grid, SIDE, SIDE, &options, s, &result);
    case 22: return fpt_surface_elevate(surface, FPT_DIRECTION_U, 1, s);
    case 23: return fpt_surface_swap(surface, s);
    case 24: return fpt_surface_bezier_form(surface, s);
    case 25: return fpt_surface_simplify(surface, 1e-3, &error, s);
    case 26: return fpt_surface_reduce(surface, FPT_DIRECTION_V, &error, s);
    case 27:
        status = fpt_arc_length_new(curve, 0, &length);
        *made = length;
        return status;
    default: return fair(n - 28, made);
    }
}

/* 0: as it should be. */
static int one(int n, size_t room) {
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
        void *made = NULL;
        alarm(60);
        leave_room(room);
        const fpt_status found = call(n, &made);
        if (found != FPT_OK && found != FPT_OUT_OF_MEMORY && found != FPT_INVALID_ARGUMENT && found != FPT_UNSUPPORTED) _exit(93);
        if (n != 11 && (made != NULL) != (found == FPT_OK)) _exit(94);
        _exit(found == FPT_OUT_OF_MEMORY ? 1 : 0);
    }
    if (child < 0 || waitpid(child, &status, 0) != child) return 95;
    if (WIFSIGNALED(status)) return 100 + WTERMSIG(status);
    return WEXITSTATUS(status);
}

static void memory_that_cannot_be_had_is_a_status(void) {
    int refused = 0;
    for (int n = 0; n < CALLS; n++) {
        for (size_t room = (size_t)1 << 14; room <= (size_t)1 << 26; room *= 4) {
            const int found = one(n, room);
            CHECK_MESSAGE(found < 2, "call %d with %zu bytes: %d", n, room, found);
            refused += found == 1;
        }
    }
    CHECK(refused > CALLS);
}

int main(void) {
    static double net[3 * NET * NET];
    poles = (double *)malloc(3 * POLES * sizeof *poles);
    knots = (double *)malloc((POLES + 4) * sizeof *knots);
    parameters = (double *)malloc(POLES * sizeof *parameters);
    grid = (double *)malloc(3 * SIDE * SIDE * sizeof *grid);
    if (!poles || !knots || !parameters || !grid || process_size() == 0) {
        printf("memory_toolkit: this machine cannot be asked\n");
        return 1;
    }
    for (size_t i = 0; i < POLES; i++) {
        poles[3 * i] = (double)i;
        poles[3 * i + 1] = (double)(i % 7);
        poles[3 * i + 2] = 0;
        parameters[i] = (double)i * (POLES / 2.0) / POLES;
    }
    for (size_t i = 0; i < POLES + 4; i++) knots[i] = i < 4 ? 0 : i > POLES ? POLES - 3 : (double)(i - 3);
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        grid[3 * i] = (double)(i / SIDE);
        grid[3 * i + 1] = (double)(i % SIDE);
        grid[3 * i + 2] = (double)(i * i % 11);
    }
    curve = make_curve(curve_data(3, POLES, knots, poles, NULL));
    for (size_t i = 0; i < POLES; i++) poles[3 * i + 2] = 1;
    other = make_curve(curve_data(3, POLES, knots, poles, NULL));
    fpt_fit_options_init(&options, sizeof options);
    options.tolerance = 20;
    CHECK_OK(fpt_surface_interpolate(grid, SIDE, SIDE, &options, &surface));
    CHECK_OK(fpt_curve_part(curve, 10.5, 2010.5, &bow));
    for (size_t i = 0; i < NET * NET; i++) {
        net[3 * i] = (double)(i / NET);
        net[3 * i + 1] = (double)(i % NET);
        net[3 * i + 2] = 0.01 * (double)(i * i % 11);
    }
    CHECK_OK(fpt_surface_interpolate(net, NET, NET, NULL, &sheet));
    fpt_fair_options_init(&fairing, sizeof fairing);
    fairing.deviation = 0.05;
    fairing.steps = 20;
    RUN(memory_that_cannot_be_had_is_a_status);
    fpt_curve_free(curve);
    fpt_curve_free(other);
    fpt_surface_free(surface);
    fpt_curve_free(bow);
    fpt_surface_free(sheet);
    free(poles);
    free(knots);
    free(parameters);
    free(grid);
    return check_report("memory_toolkit");
}
