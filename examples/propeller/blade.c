/* A propeller blade as one bicubic B-spline surface, made from section curves.
 *
 * u runs around a section: trailing edge, suction side, leading edge, pressure side, trailing edge. v runs from the
 * root to the tip. A section is drawn in the plane of a cylinder unrolled, turned by the pitch angle and wrapped
 * back. The laws below give the rows of the control net directly, so the sections are poles, not points passed
 * through. The last row is a single point: the tip is a collapsed edge. The row before has the same radius, which
 * makes the outline round there. */
#include "part.h"

enum { DEGREE = 3, AROUND = 16, ALONG = 13, KNOTS_MAX = AROUND + DEGREE + 1 };

static const double PITCH = 190;         /* mm of advance in one turn */
static const double SKEW = 0.55;         /* radians the tip stays behind */
static const double TIP_RADIUS = 120;    /* mm */
static const double ROOT_RADIUS = 20;    /* mm, inside the barrel */
static const double CAMBER = 0.045;      /* of the chord */

/* The section in units of the chord and of the thickness: x from the leading edge at -0.5 to the trailing edge. */
static const double SECTION[AROUND][2] = {
    {0.50, 0.00},   {0.42, 0.20},  {0.27, 0.40},   {0.08, 0.52},   {-0.14, 0.56},  {-0.33, 0.49},
    {-0.46, 0.33},  {-0.50, 0.13}, {-0.50, -0.13}, {-0.46, -0.33}, {-0.33, -0.49}, {-0.14, -0.56},
    {0.08, -0.52},  {0.27, -0.40}, {0.42, -0.20},  {0.50, 0.00},
};

/* Rows of the net from root to tip. The first three flare out into the hub like a fillet. */
static const struct {
    double radius, chord, thickness;
} ROWS[ALONG] = {
    {20, 47, 15.0}, {23.5, 45, 13.5}, {25.5, 42, 8.6}, {30, 43, 7.0},   {40, 51, 6.2},   {53, 61, 5.4}, {67, 70, 4.6},
    {81, 74, 3.9},  {94, 71, 3.2},    {106, 61, 2.7},  {115, 44, 2.3},  {120, 23, 1.9},  {120, 0, 0},
};

/* Knots clamped at both ends, uniform between. */
static void uniform_knots(int pole_count, double *out) {
    for (int i = 0; i <= pole_count + DEGREE; i++) {
        double t = (double)(i - DEGREE) / (pole_count - DEGREE);
        out[i] = t < 0 ? 0 : t > 1 ? 1 : t;
    }
}

/* One pole: a place (x, y) of the section, wrapped on the cylinder of the row's radius. */
static vec3 wrap(int row, double x, double y, double blade_angle) {
    double radius = ROWS[row].radius;
    double height = (radius - ROOT_RADIUS) / (TIP_RADIUS - ROOT_RADIUS);
    double pitch_angle = atan(PITCH / (2 * acos(-1.0) * radius));
    double around = x * cos(pitch_angle) - y * sin(pitch_angle);
    double z = -x * sin(pitch_angle) - y * cos(pitch_angle);
    double angle = blade_angle + around / radius + SKEW * height * height;
    return vec3_new(radius * cos(angle), radius * sin(angle), z);
}

fpt_status blade_new(double angle, fpt_surface **out) {
    double knots_u[KNOTS_MAX], knots_v[KNOTS_MAX], poles[AROUND][ALONG][3];
    uniform_knots(AROUND, knots_u);
    uniform_knots(ALONG, knots_v);
    for (int i = 0; i < AROUND; i++) {
        for (int j = 0; j < ALONG; j++) {
            double x = SECTION[i][0], chord = ROWS[j].chord;
            double arch = CAMBER * chord * (1 - 4 * x * x);
            vec3 pole = wrap(j, x * chord, arch + SECTION[i][1] * ROWS[j].thickness, angle);
            poles[i][j][0] = pole.x, poles[i][j][1] = pole.y, poles[i][j][2] = pole.z;
        }
    }
    fpt_surface_data data = {.struct_size = sizeof data,
                             .degree_u = DEGREE, .degree_v = DEGREE,
                             .pole_count_u = AROUND, .pole_count_v = ALONG,
                             .knots_u = knots_u, .knots_v = knots_v,
                             .poles = &poles[0][0][0]};
    return fpt_surface_new(&data, out);
}
