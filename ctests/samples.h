/* Shapes that the tests share. Each function returns a description whose arrays live as long as the program. */
#ifndef SAMPLES_H
#define SAMPLES_H

#include <footpoint.h>

#include "check.h"

#include <math.h>
#include <stdlib.h>

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* The error text of outputs that must stay untouched: fill before, compare after. */
static inline void fill_pattern(void *bytes, size_t size) { memset(bytes, 0xA5, size); }

static inline int is_pattern(const void *bytes, size_t size) {
    const unsigned char *at = (const unsigned char *)bytes;
    for (size_t i = 0; i < size; i++) {
        if (at[i] != 0xA5) return 0;
    }
    return 1;
}

static inline fpt_curve_data curve_data(size_t degree, size_t pole_count, const double *knots, const double *poles,
                                        const double *weights) {
    fpt_curve_data data;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.degree = degree;
    data.pole_count = pole_count;
    data.knots = knots;
    data.poles = poles;
    data.weights = weights;
    return data;
}

/* A plain cubic in space: 7 poles, 4 spans. */
static inline fpt_curve_data cubic_curve(void) {
    static const double knots[] = {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};
    static const double poles[] = {0, 0, 0, 1, 2, 0.5, 3, 2.5, 1, 4, -1, 0, 6, -2, -1, 7, 1, 0, 9, 0, 2};
    return curve_data(3, 7, knots, poles, NULL);
}

/* The circle of radius 2 about (1,0,0) in the plane z = 0: rational, closed, double knots at smooth joints. */
static inline fpt_curve_data circle_curve(void) {
    static const double h = 0.70710678118654752440;
    static const double knots[] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    static const double poles[] = {3,  0,  0, 3,  2,  0, 1, 2,  0, -1, 2,  0, -1, 0,
                                   0,  -1, -2, 0, 1,  -2, 0, 3, -2, 0,  3,  0,  0};
    static double weights[9];
    for (int i = 0; i < 9; i++) weights[i] = i % 2 ? h : 1;
    return curve_data(2, 9, knots, poles, weights);
}

/* A cubic over uniform knots without end multiplicity; its domain is [3, 6]. */
static inline fpt_curve_data unclamped_curve(void) {
    static const double knots[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    static const double poles[] = {0, 0, 0, 1, 2, 0, 3, 2, 1, 4, 0, 1, 6, -1, 0, 7, 1, 0};
    return curve_data(3, 6, knots, poles, NULL);
}

static inline fpt_surface_data surface_data(size_t degree_u, size_t degree_v, size_t pole_count_u, size_t pole_count_v,
                                            const double *knots_u, const double *knots_v, const double *poles,
                                            const double *weights) {
    fpt_surface_data data;
    memset(&data, 0, sizeof data);
    data.struct_size = sizeof data;
    data.degree_u = degree_u;
    data.degree_v = degree_v;
    data.pole_count_u = pole_count_u;
    data.pole_count_v = pole_count_v;
    data.knots_u = knots_u;
    data.knots_v = knots_v;
    data.poles = poles;
    data.weights = weights;
    return data;
}

/* Example 2 of Hu, Sun, Jin, Wang: bicubic, 7 x 4 poles, printed as 4 rows of 7 with the u index fastest. */
static inline fpt_surface_data paper_surface(int with_weights) {
    static const double printed[28][3] = {
        {100, 100, 0},  {130, 180, 30}, {120, 270, 30}, {90, 360, 0},   {180, 120, 30}, {160, 200, 60}, {190, 320, 60},
        {150, 440, 30}, {250, 140, 30}, {230, 200, 60}, {260, 330, 60}, {240, 400, 30}, {330, 100, 0},  {350, 220, 30},
        {340, 290, 30}, {330, 400, 0},  {410, 120, 30}, {380, 200, 60}, {400, 320, 60}, {390, 440, 30}, {460, 140, 30},
        {440, 200, 60}, {460, 330, 60}, {480, 400, 30}, {540, 100, 0},  {570, 220, 30}, {550, 290, 30}, {575, 400, 0}};
    static const double printed_weights[28] = {1, 1, 1, 1, 1.2, 1, 1,   0.8,  1, 1, 1, 1, 1, 0.81,
                                               1, 0.65, 1, 1, 1, 1, 1, 1.6, 0.89, 1, 1, 1, 1, 1};
    static const double knots_u[] = {0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1};
    static const double knots_v[] = {0, 0, 0, 0, 1, 1, 1, 1};
    static double poles[3 * 28], weights[28];
    for (size_t i = 0; i < 7; i++) {
        for (size_t j = 0; j < 4; j++) {
            for (size_t k = 0; k < 3; k++) poles[3 * (i * 4 + j) + k] = printed[7 * j + i][k];
            weights[i * 4 + j] = printed_weights[7 * j + i];
        }
    }
    return surface_data(3, 3, 7, 4, knots_u, knots_v, poles, with_weights ? weights : NULL);
}

/* The cone with apex (1,0,3) over the circle of circle_curve: rational, closed in u, collapsed at v = 1. */
static inline fpt_surface_data cone_surface(void) {
    static const double knots_v[] = {0, 0, 1, 1};
    static double poles[3 * 18], weights[18];
    fpt_curve_data circle = circle_curve();
    for (size_t i = 0; i < 9; i++) {
        double *base = poles + 6 * i, *apex = base + 3;
        for (size_t k = 0; k < 3; k++) base[k] = circle.poles[3 * i + k];
        apex[0] = 1;
        apex[1] = 0;
        apex[2] = 3;
        weights[2 * i] = weights[2 * i + 1] = circle.weights[i];
    }
    return surface_data(2, 1, 9, 2, circle.knots, knots_v, poles, weights);
}

static inline fpt_curve *make_curve(fpt_curve_data data) {
    fpt_curve *curve = NULL;
    CHECK_OK(fpt_curve_new(&data, &curve));
    CHECK(curve != NULL);
    return curve;
}

static inline fpt_surface *make_surface(fpt_surface_data data) {
    fpt_surface *surface = NULL;
    CHECK_OK(fpt_surface_new(&data, &surface));
    CHECK(surface != NULL);
    return surface;
}

static inline fpt_query_options default_options(void) {
    fpt_query_options options;
    fpt_query_options_init(&options, sizeof options);
    return options;
}

static inline double distance_between(const double a[3], const double b[3]) {
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* The next number in [0,1) of a fixed sequence (a 64-bit congruential generator, its high bits). */
static inline double next_random(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Points in the box that is `margin` times larger than [low, high] in each direction. */
static inline double *scattered_points(size_t count, const double low[3], const double high[3], double margin) {
    double *points = (double *)malloc(3 * count * sizeof *points);
    uint64_t state = 20240229;
    for (size_t i = 0; i < 3 * count; i++) {
        double size = high[i % 3] - low[i % 3];
        points[i] = low[i % 3] - margin * size + (1 + 2 * margin) * size * next_random(&state);
    }
    return points;
}

#endif
