/*
 * SISL as a caller: its curves and surfaces handed to footpoint as they lie in memory, and asked by both. SISL's s1953 and s1954 search
 * everywhere; where they find a place, footpoint's is at least as near. SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <footpoint.h>

#include <sisl.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int failed, checked;

static void expect(int holds, const char *about, const char *what, double a, double b) {
    checked++;
    if (holds) return;
    failed++;
    if (failed < 30) fprintf(stderr, "%s: %s (%.17g, %.17g)\n", about, what, a, b);
}

static unsigned state = 1;
static double between(double a, double b) {
    state = state * 1664525u + 1013904223u;
    return a + (b - a) * ((state >> 8) / 16777216.0);
}

static double apart(const double *a, const double *b) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* SISL keeps the poles both divided (ecoef) and multiplied by the weights with the weights behind them (rcoef). */
static double *weights_of(const double *scaled, size_t count) {
    double *out = malloc(count * sizeof *out);
    if (out == NULL) exit(2);
    for (size_t i = 0; i < count; i++) out[i] = scaled[4 * i + 3];
    return out;
}

static fpt_curve *curve_of(const SISLCurve *c) {
    double *weights = c->ikind == 2 || c->ikind == 4 ? weights_of(c->rcoef, (size_t)c->in) : NULL;
    const fpt_curve_data data = {.struct_size = sizeof data, .degree = (size_t)c->ik - 1, .pole_count = (size_t)c->in,
                                 .knots = c->et, .poles = c->ecoef, .weights = weights};
    fpt_curve *out = NULL;
    if (fpt_curve_new(&data, &out) != FPT_OK) fprintf(stderr, "curve: %s\n", fpt_last_error());
    free(weights);
    return out;
}

/* In SISL the first direction runs fastest, in footpoint the second: the directions change places, u of SISL is v here. */
static fpt_surface *surface_of(const SISLSurf *s) {
    double *weights = s->ikind == 2 || s->ikind == 4 ? weights_of(s->rcoef, (size_t)s->in1 * (size_t)s->in2) : NULL;
    const fpt_surface_data data = {.struct_size = sizeof data,
                                   .degree_u = (size_t)s->ik2 - 1, .degree_v = (size_t)s->ik1 - 1,
                                   .pole_count_u = (size_t)s->in2, .pole_count_v = (size_t)s->in1,
                                   .knots_u = s->et2, .knots_v = s->et1, .poles = s->ecoef, .weights = weights};
    fpt_surface *out = NULL;
    if (fpt_surface_new(&data, &out) != FPT_OK) fprintf(stderr, "surface: %s\n", fpt_last_error());
    free(weights);
    return out;
}

/* Places of SISL: parameters, and curves of them whose first point stands for all. */
typedef struct Places {
    int count, curves, status;
    double *at;
    SISLIntcurve **along;
} Places;

static const double *place(const Places *p, int i, int width) {
    return i < p->count ? p->at + i * width : p->along[i - p->count]->epar1;
}
static void release(Places *p) {
    free(p->at);
    if (p->along != NULL) freeIntcrvlist(p->along, p->curves);
}

static void ask_curve(const char *name, SISLCurve *theirs, double size) {
    fpt_curve *ours = curve_of(theirs);
    expect(ours != NULL, name, "made", 0, 0);
    if (ours == NULL) return;
    for (int i = 0; i < 200; i++) {
        const double u = between(theirs->et[theirs->ik - 1], theirs->et[theirs->in]);
        double a[6], b[6], q[3];
        int left = 0, status = 0;
        s1227(theirs, 1, u, &left, a, &status);
        expect(status >= 0 && fpt_curve_evaluate(ours, u, 1, b) == FPT_OK, name, "evaluation", status, u);
        expect(apart(a, b) < 1e-13 * size && apart(a + 3, b + 3) < 1e-12 * size, name, "points and tangents", apart(a, b), apart(a + 3, b + 3));

        for (int k = 0; k < 3; k++) q[k] = a[k] + between(-0.3, 0.3) * size;
        fpt_foot_point foot;
        Places found = {0};
        s1953(theirs, q, 3, 0.0, 1e-9, &found.count, &found.at, &found.curves, &found.along, &found.status);
        expect(fpt_curve_closest(ours, q, 1, NULL, &foot) == FPT_OK && !(foot.flags & FPT_FOOT_NOT_PROVEN), name, "footpoint", foot.flags, 0);
        for (int k = 0; found.status >= 0 && k < found.count + found.curves; k++) {
            s1227(theirs, 0, place(&found, k, 1)[0], &left, a, &status);
            expect(foot.distance <= apart(a, q) + 1e-12 * size, name, "SISL is nearer", foot.distance, apart(a, q));
            expect(foot.lower_bound <= apart(a, q), name, "the bound is above SISL's point", foot.lower_bound, apart(a, q));
            expect(fabs(foot.distance - apart(a, q)) < 1e-6 * size, name, "SISL's distance", foot.distance, apart(a, q));
        }
        release(&found);
    }
    fpt_curve_free(ours);
}

static void ask_surface(const char *name, SISLSurf *theirs, double size) {
    fpt_surface *ours = surface_of(theirs);
    expect(ours != NULL, name, "made", 0, 0);
    if (ours == NULL) return;
    for (int i = 0; i < 60; i++) {
        double at[2] = {between(theirs->et1[theirs->ik1 - 1], theirs->et1[theirs->in1]),
                        between(theirs->et2[theirs->ik2 - 1], theirs->et2[theirs->in2])};
        double a[9], b[9], normal[3], q[3];
        int left[2] = {0, 0}, status = 0;
        s1421(theirs, 1, at, &left[0], &left[1], a, normal, &status);
        expect(status >= 0 && fpt_surface_evaluate(ours, at[1], at[0], 1, b) == FPT_OK, name, "evaluation", status, at[0]);
        expect(apart(a, b) < 1e-13 * size && apart(a + 3, b + 6) < 1e-12 * size && apart(a + 6, b + 3) < 1e-12 * size, name,
               "points and tangents", apart(a, b), apart(a + 3, b + 6));

        for (int k = 0; k < 3; k++) q[k] = a[k] + between(-0.3, 0.3) * size;
        fpt_foot_point foot;
        Places found = {0};
        s1954(theirs, q, 3, 0.0, 1e-9, &found.count, &found.at, &found.curves, &found.along, &found.status);
        expect(fpt_surface_closest(ours, q, 1, NULL, &foot) == FPT_OK && !(foot.flags & FPT_FOOT_NOT_PROVEN), name, "footpoint", foot.flags, 0);
        for (int k = 0; found.status >= 0 && k < found.count + found.curves; k++) {
            const double *p = place(&found, k, 2);
            at[0] = p[0], at[1] = p[1];
            s1421(theirs, 0, at, &left[0], &left[1], a, normal, &status);
            expect(foot.distance <= apart(a, q) + 1e-12 * size, name, "SISL is nearer", foot.distance, apart(a, q));
            expect(foot.lower_bound <= apart(a, q), name, "the bound is above SISL's point", foot.lower_bound, apart(a, q));
        }
        release(&found);
    }
    fpt_surface_free(ours);
}

int main(void) {
    double centre[3] = {1, 2, 3}, axis[3] = {0, 0, 3}, equator[3] = {2, 0, 0}, normal[3] = {0, 0, 1};
    double points[36], *parameters = NULL, end = 0;
    int kinds[12], count = 0, status = 0;
    SISLCurve *curve = NULL;
    SISLSurf *surface = NULL;

    /* A cubic through twelve points. */
    for (int i = 0; i < 12; i++) {
        points[3 * i] = i;
        points[3 * i + 1] = 3 * sin(0.9 * i);
        points[3 * i + 2] = 2 * cos(1.7 * i);
        kinds[i] = 1;
    }
    s1356(points, 12, 3, kinds, 0, 0, 1, 4, 0.0, &end, &curve, &parameters, &count, &status);
    expect(status >= 0 && curve != NULL, "cubic", "made by SISL", status, 0);
    if (curve != NULL) ask_curve("cubic", curve, 12);
    if (curve != NULL) freeCurve(curve);
    free(parameters);

    /* A circle, rational. */
    double start[3] = {5, 0, 0}, origin[3] = {0, 0, 0};
    curve = NULL;
    s1303(start, 1e-6, 5.0, origin, normal, 3, &curve, &status);
    expect(status >= 0 && curve != NULL, "arc", "made by SISL", status, 0);
    if (curve != NULL) ask_curve("arc", curve, 10);
    if (curve != NULL) freeCurve(curve);

    /* The octants of a sphere with collapsed edges, and a torus; both rational. */
    s1023(centre, axis, equator, 2, 4, &surface, &status);
    expect(status >= 0 && surface != NULL, "sphere", "made by SISL", status, 0);
    if (surface != NULL) ask_surface("sphere", surface, 6);
    if (surface != NULL) freeSurf(surface);
    surface = NULL;
    s1024(centre, normal, equator, 0.7, 1, 4, 4, &surface, &status);
    expect(status >= 0 && surface != NULL, "torus", "made by SISL", status, 0);
    if (surface != NULL) ask_surface("torus", surface, 6);
    if (surface != NULL) freeSurf(surface);

    /* A bicubic net of hills. */
    double knots[10] = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}, poles[3 * 36];
    for (int j = 0; j < 6; j++) {
        for (int i = 0; i < 6; i++) {
            poles[3 * (6 * j + i)] = 2 * i;
            poles[3 * (6 * j + i) + 1] = 2 * j;
            poles[3 * (6 * j + i) + 2] = between(-2, 2);
        }
    }
    surface = newSurf(6, 6, 4, 4, knots, knots, poles, 1, 3, 1);
    ask_surface("hills", surface, 12);
    freeSurf(surface);

    printf("%d checks, %d failed\n", checked, failed);
    return failed == 0 && checked > 0 ? 0 : 1;
}
