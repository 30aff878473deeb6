/* From a Newton inversion of your own to footpoint: the same thousand points, before and after.
 *
 *   cc -std=c99 -O2 replace_newton.c -o replace_newton -lfootpoint -lm
 */
#include <footpoint.h>
#include <math.h>
#include <stdio.h>

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double clamped(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/* Before: the nearest of 10 x 10 samples, then Newton's method for
 * (S - P).Su = 0 and (S - P).Sv = 0, kept inside the domain. */
static double own_newton(const fpt_surface *surface, const double *point, double uv[2]) {
    double s[18], least = HUGE_VAL; /* S; Su,Sv; Suu,Suv,Svv */
    for (int k = 0; k < 100; k++) {
        const double u = (k / 10 + 0.5) / 10, v = (k % 10 + 0.5) / 10;
        if (fpt_surface_evaluate(surface, u, v, 0, s) != FPT_OK) return NAN;
        const double r[3] = {s[0] - point[0], s[1] - point[1], s[2] - point[2]};
        if (dot(r, r) < least) {
            least = dot(r, r);
            uv[0] = u;
            uv[1] = v;
        }
    }
    for (int step = 0; step < 20; step++) {
        if (fpt_surface_evaluate(surface, uv[0], uv[1], 2, s) != FPT_OK) return NAN;
        const double r[3] = {s[0] - point[0], s[1] - point[1], s[2] - point[2]};
        const double f = dot(r, s + 3), g = dot(r, s + 6);
        const double a = dot(s + 3, s + 3) + dot(r, s + 9), b = dot(s + 3, s + 6) + dot(r, s + 12), c = dot(s + 6, s + 6) + dot(r, s + 15);
        const double det = a * c - b * b;
        if (det == 0) break;
        double du = -(c * f - b * g) / det, dv = -(a * g - b * f) / det;
        if (clamped(uv[0] + du) == uv[0] && uv[0] * (1 - uv[0]) == 0) dv = -g / c; /* held by a border: along it */
        if (clamped(uv[1] + dv) == uv[1] && uv[1] * (1 - uv[1]) == 0) du = -f / a;
        uv[0] = clamped(uv[0] + du);
        uv[1] = clamped(uv[1] + dv);
    }
    if (fpt_surface_evaluate(surface, uv[0], uv[1], 0, s) != FPT_OK) return NAN;
    const double r[3] = {s[0] - point[0], s[1] - point[1], s[2] - point[2]};
    return sqrt(dot(r, r));
}

int main(void) {
    /* A bicubic sheet of 8 x 8 poles, hilly like a deep-drawn part. */
    double knots[12] = {0, 0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1}, poles[3 * 64], points[3 * 1000];
    for (int i = 0; i < 8; i++) {
        for (int j = 0; j < 8; j++) {
            double *pole = poles + 3 * (8 * i + j);
            pole[0] = 10 * i;
            pole[1] = 10 * j;
            pole[2] = 12 * sin(1.9 * i) * cos(1.3 * j + 0.4 * i);
        }
    }
    unsigned state = 1;
    for (int k = 0; k < 3000; k++) {
        state = state * 1664525u + 1013904223u;
        const double share = (state >> 8) / 16777216.0;
        points[k] = k % 3 == 2 ? 40 * share - 20 : 90 * share - 10;
    }
    const fpt_surface_data data = {.struct_size = sizeof data, .degree_u = 3, .degree_v = 3, .pole_count_u = 8, .pole_count_v = 8,
                                   .knots_u = knots, .knots_v = knots, .poles = poles};
    fpt_surface *surface = NULL;
    static fpt_foot_point feet[1000];
    fpt_status status = fpt_surface_new(&data, &surface);

    /* After: one call for all points. */
    if (status == FPT_OK) status = fpt_surface_closest(surface, points, 1000, NULL, feet);
    if (status != FPT_OK) {
        fprintf(stderr, "%s: %s\n", fpt_status_name(status), fpt_last_error());
        fpt_surface_free(surface);
        return 1;
    }
    int wrong_before = 0, wrong_after = 0, proven = 0, border = 0;
    for (int k = 0; k < 1000; k++) {
        double uv[2] = {0, 0};
        const double before = own_newton(surface, points + 3 * k, uv), after = feet[k].distance;
        wrong_before += !(before <= after + 1e-6);
        wrong_after += !(after <= before + 1e-6);
        proven += !(feet[k].flags & FPT_FOOT_NOT_PROVEN);
        border += (feet[k].flags & FPT_FOOT_EDGE) != 0;
    }
    printf("1000 points, %d of them nearest to a border\n", border);
    printf("before: %d answers that are not the nearest point\n", wrong_before);
    printf("after:  %d; %d answers proven\n", wrong_after, proven);
    fpt_surface_free(surface);
    return wrong_after == 0 && proven == 1000 ? 0 : 1;
}
