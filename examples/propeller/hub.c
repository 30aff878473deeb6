/* The hub's members: exact surfaces of revolution about z.
 *
 * u runs around the axis: a circle in four rational quadratic arcs, its seam at angle 0. v runs along the profile,
 * given in (radius, z). A circle's quadrant joints are knots of full multiplicity and yet smooth; the creases of the
 * barrel's profile are knots of full multiplicity that are sharp. */
#include "part.h"

enum { CIRCLE_POLES = 9, PROFILE_MAX = 7 };

static const double CIRCLE_KNOTS[] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
static const double CIRCLE[CIRCLE_POLES][2] = {{1, 0},   {1, 1},   {0, 1},  {-1, 1}, {-1, 0},
                                               {-1, -1}, {0, -1}, {1, -1}, {1, 0}};

typedef struct profile {
    int degree, pole_count;
    const double *knots;
    const double (*poles)[3]; /* radius, z, weight */
} profile;

static fpt_status revolve(const profile *along, fpt_surface **out) {
    double poles[CIRCLE_POLES * PROFILE_MAX][3], weights[CIRCLE_POLES * PROFILE_MAX];
    for (int i = 0, k = 0; i < CIRCLE_POLES; i++) {
        for (int j = 0; j < along->pole_count; j++, k++) {
            const double *q = along->poles[j];
            poles[k][0] = q[0] * CIRCLE[i][0], poles[k][1] = q[0] * CIRCLE[i][1], poles[k][2] = q[1];
            weights[k] = q[2] * (i % 2 == 0 ? 1 : sqrt(0.5));
        }
    }
    fpt_surface_data data = {.struct_size = sizeof data,
                             .degree_u = 2, .degree_v = (size_t)along->degree,
                             .pole_count_u = CIRCLE_POLES, .pole_count_v = (size_t)along->pole_count,
                             .knots_u = CIRCLE_KNOTS, .knots_v = along->knots,
                             .poles = &poles[0][0], .weights = weights};
    return fpt_surface_new(&data, out);
}

/* A bulged barrel, a chamfer and the flat back: three quadratic pieces with a crease at v = 1 and at v = 2. */
fpt_status barrel_new(fpt_surface **out) {
    static const double knots[] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 3};
    static const double poles[7][3] = {{22, 28, 1},     {27, 0, 1},    {25, -28, 1}, {23.75, -29.5, 1},
                                       {22.5, -31, 1}, {17, -31, 1}, {11, -31, 1}};
    profile along = {2, 7, knots, poles};
    return revolve(&along, out);
}

/* Radius of the barrel's first piece: a parabola in z. */
double barrel_radius(double z) {
    double t = (28 - z) / 56;
    return 22 * (1 - t) * (1 - t) + 2 * 27 * t * (1 - t) + 25 * t * t;
}

/* An arc of a conic that starts tangent to the barrel and closes square to the axis. */
fpt_status nose_cap_new(fpt_surface **out) {
    static const double knots[] = {0, 0, 0, 1, 1, 1};
    static const double poles[3][3] = {{0, 60, 1}, {22 - 5.0 * 32 / 28, 60, 0.75}, {22, 28, 1}};
    profile along = {2, 3, knots, poles};
    return revolve(&along, out);
}

/* A cylinder and its flat bottom; the bottom's centre is a collapsed edge. */
fpt_status bore_new(fpt_surface **out) {
    static const double knots[] = {0, 0, 1, 2, 2};
    static const double poles[3][3] = {{11, -31, 1}, {11, 20, 1}, {0, 20, 1}};
    profile along = {1, 3, knots, poles};
    return revolve(&along, out);
}
