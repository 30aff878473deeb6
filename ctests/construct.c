/* Conics, quadrics, swept, blended and skinned surfaces, offsets; then everything that is refused. */
#include "samples.h"

static const double pi = 3.14159265358979323846;

/* A tilted frame: origin, axis, direction of X. */
static const double axes[] = {1, -2, 0.5, 0.3, 0.4, 1.2, 1, 0.2, 0.1};

static fpt_curve *segment(double x0, double y0, double z0, double x1, double y1, double z1) {
    double start[3] = {x0, y0, z0}, end[3] = {x1, y1, z1};
    fpt_curve *curve = NULL;
    CHECK_OK(fpt_curve_line(start, end, &curve));
    return curve;
}

static double from_origin(const double *p) {
    return sqrt((p[0] - axes[0]) * (p[0] - axes[0]) + (p[1] - axes[1]) * (p[1] - axes[1]) + (p[2] - axes[2]) * (p[2] - axes[2]));
}

static void circles_have_every_form(void) {
    static const size_t poles[] = {9, 7, 7, 0, 6};
    for (uint32_t form = FPT_ARC_QUARTERS; form <= FPT_ARC_QUINTIC; form++) {
        fpt_curve *curve = NULL;
        double at[3];
        size_t count = 0;
        if (form == FPT_ARC_CUBIC) {
            CHECK_ERROR(fpt_curve_arc(axes, 2, 2, 0, 2 * pi, form, &curve), FPT_INVALID_ARGUMENT, "form");
            CHECK_OK(fpt_curve_arc(axes, 2, 2, 0, 3, form, &curve));
        } else {
            CHECK_OK(fpt_curve_arc(axes, 2, 2, 0, 2 * pi, form, &curve));
            CHECK_OK(fpt_curve_pole_count(curve, &count));
            CHECK(count == poles[form]);
        }
        for (int i = 0; i <= 100; i++) {
            CHECK_OK(fpt_curve_evaluate(curve, i / 100.0, 0, at));
            CHECK_NEAR(from_origin(at), 2, 1e-13);
        }
        fpt_curve_free(curve);
    }
}

static void conics_pass_where_they_must(void) {
    static const double points[] = {1, 0, 0, 0, 1, 0, -1, 0, 0}, corner[] = {0, 0, 0, 1, 2, 0, 2, 0, 0};
    fpt_curve *curve = NULL;
    double at[3], h = 0.5 * exp(1) + 0.5 * exp(-1);
    CHECK_OK(fpt_curve_arc_through(points, &curve));
    CHECK_OK(fpt_curve_evaluate(curve, 0.3, 0, at));
    CHECK_NEAR(hypot(at[0], at[1]), 1, 1e-14);
    fpt_curve_free(curve);
    CHECK_OK(fpt_curve_conic(corner, 0.5, &curve));
    CHECK_OK(fpt_curve_evaluate(curve, 0.5, 0, at));
    CHECK_NEAR(at[1], 1, 1e-15);
    fpt_curve_free(curve);
    CHECK_OK(fpt_curve_parabola(NULL, 0.25, -1, 2, &curve));
    CHECK_OK(fpt_curve_evaluate(curve, 1.5, 0, at));
    CHECK_NEAR(at[0], 2.25, 1e-14);
    CHECK_NEAR(at[1], 1.5, 1e-14);
    fpt_curve_free(curve);
    CHECK_OK(fpt_curve_hyperbola(NULL, 2, 3, 0, 1, &curve));
    CHECK_OK(fpt_curve_evaluate(curve, 1, 0, at));
    CHECK_NEAR(at[0], 2 * h, 1e-14);
    fpt_curve_free(curve);
}

static void quadrics_and_the_torus_satisfy_their_equations(void) {
    static const double unit[] = {1, 1, 1}, turn[] = {0, 2 * 3.14159265358979323846}, domain[] = {-1, 1, -2, 2};
    static const double from[] = {-1, -1, 0, 0, 0, -1};
    for (uint32_t kind = FPT_PATCH_ELLIPSOID; kind <= FPT_PATCH_CYLINDER; kind++) {
        fpt_surface *surface = NULL;
        double profile[] = {from[kind], 1};
        CHECK_OK(fpt_surface_quadric(kind, NULL, unit, turn, profile, FPT_ARC_QUARTERS, &surface));
        for (int i = 0; i <= 100; i++) {
            double at[3], box[4], r, law[6];
            CHECK_OK(fpt_surface_domain(surface, box));
            CHECK_OK(fpt_surface_evaluate(surface, i / 100.0, box[2] + (box[3] - box[2]) * ((7 * i) % 101) / 100.0, 0, at));
            r = at[0] * at[0] + at[1] * at[1];
            law[0] = r + at[2] * at[2] - 1, law[1] = r - at[2] * at[2] - 1, law[2] = r - at[2] * at[2] + 1;
            law[3] = r - at[2], law[4] = r - at[2] * at[2], law[5] = r - 1;
            CHECK_NEAR(law[kind], 0, 1e-13);
        }
        fpt_surface_free(surface);
    }
    {
        fpt_surface *surface = NULL;
        double at[3];
        CHECK_OK(fpt_surface_torus(NULL, 3, 1, turn, turn, FPT_ARC_THIRDS, &surface));
        CHECK_OK(fpt_surface_evaluate(surface, 0.37, 0.21, 0, at));
        CHECK_NEAR(hypot(hypot(at[0], at[1]) - 3, at[2]), 1, 1e-13);
        fpt_surface_free(surface);
        CHECK_OK(fpt_surface_saddle(NULL, 1, 2, domain, &surface));
        CHECK_OK(fpt_surface_evaluate(surface, 0.5, 1, 0, at));
        CHECK_NEAR(at[2], 0.25 - 0.25, 1e-14);
        fpt_surface_free(surface);
        CHECK_OK(fpt_surface_plane(NULL, domain, &surface));
        CHECK_OK(fpt_surface_evaluate(surface, 0.5, 1, 0, at));
        CHECK(at[0] == 0.5 && at[1] == 1 && at[2] == 0);
        fpt_surface_free(surface);
    }
}

static void curves_become_surfaces(void) {
    static const double up[] = {0, 0, 2}, origin[] = {0, 0, 0}, axis[] = {0, 0, 5}, half[] = {0, 3.14159265358979323846};
    fpt_curve *low = segment(1, 0, 0, 2, 0, 0), *high = segment(1, 0, 1, 2, 1, 1), *side = segment(0, 0, 0, 0, 0, 3);
    const fpt_curve *both[2];
    fpt_surface *surface = NULL;
    double at[3];
    both[0] = low, both[1] = high;
    CHECK_OK(fpt_surface_ruled(low, high, &surface));
    CHECK_OK(fpt_surface_evaluate(surface, 1, 0.5, 0, at));
    CHECK_NEAR(at[1], 0.5, 1e-14);
    fpt_surface_free(surface);
    CHECK_OK(fpt_surface_extruded(low, up, &surface));
    CHECK_OK(fpt_surface_evaluate(surface, 0.5, 0.5, 0, at));
    CHECK_NEAR(at[2], 1, 1e-14);
    fpt_surface_free(surface);
    CHECK_OK(fpt_surface_revolved(low, origin, axis, half, FPT_ARC_HALVES, &surface));
    CHECK_OK(fpt_surface_evaluate(surface, 0.5, 1, 0, at));
    CHECK_NEAR(at[1], 2, 1e-14);
    fpt_surface_free(surface);
    CHECK_OK(fpt_surface_translational(low, side, &surface));
    CHECK_OK(fpt_surface_evaluate(surface, 0.5, 2, 0, at));
    CHECK(fabs(at[0] - 1.5) < 1e-14 && fabs(at[2] - 2) < 1e-14);
    fpt_surface_free(surface);
    CHECK_OK(fpt_surface_skinned(both, 2, 1, NULL, &surface));
    CHECK_OK(fpt_surface_evaluate(surface, 1, 1, 0, at));
    CHECK_NEAR(at[1], 1, 1e-14);
    fpt_surface_free(surface);
    both[1] = NULL;
    CHECK_ERROR(fpt_surface_skinned(both, 2, 1, NULL, &surface), FPT_INVALID_ARGUMENT, "handle 1");
    fpt_curve_free(low), fpt_curve_free(high), fpt_curve_free(side);
}

static void networks_become_surfaces(void) {
    /* The square with a raised corner, z = x y. */
    fpt_curve *made[4];
    const fpt_curve *borders[4], *slopes[4];
    static const double ends[] = {0, 1};
    static const double points[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1}, along_x[] = {1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1},
                        along_y[] = {0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1}, twist[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const double knots[] = {0, 0, 1, 1};
    static const double slope_poles[4][6] = {{1, 0, 0, 1, 0, 1}, {1, 0, 0, 1, 0, 1}, {0, 1, 0, 0, 1, 1}, {0, 1, 0, 0, 1, 1}};
    static const double border_poles[4][6] = {{0, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 0, 0}, {0, 1, 0, 1, 1, 1}};
    fpt_surface *surface = NULL;
    double at[3];
    fpt_curve *across[4];
    for (int k = 0; k < 4; k++) {
        borders[k] = made[k] = make_curve(curve_data(1, 2, knots, border_poles[k], NULL));
        slopes[k] = across[k] = make_curve(curve_data(1, 2, knots, slope_poles[k], NULL));
    }
    for (int method = 0; method < 4; method++) {
        if (method == 0) CHECK_OK(fpt_surface_coons(borders, &surface));
        if (method == 1) CHECK_OK(fpt_surface_coons_bicubic(borders, slopes, &surface));
        if (method == 2) CHECK_OK(fpt_surface_ferguson(points, along_x, along_y, twist, &surface));
        if (method == 3) CHECK_OK(fpt_surface_gordon(borders + 2, ends, 2, borders, ends, 2, &surface));
        CHECK_OK(fpt_surface_evaluate(surface, 0.3, 0.6, 0, at));
        CHECK(fabs(at[0] - 0.3) < 1e-14 && fabs(at[1] - 0.6) < 1e-14);
        CHECK_NEAR(at[2], 0.18, 1e-14);
        fpt_surface_free(surface);
    }
    CHECK_OK(fpt_surface_ferguson(points, along_x, along_y, NULL, &surface));
    fpt_surface_free(surface);
    borders[1] = made[0];
    CHECK_ERROR(fpt_surface_coons(borders, &surface), FPT_INVALID_ARGUMENT, "corner");
    CHECK_STATUS(fpt_surface_ferguson(points, NULL, along_y, NULL, &surface), FPT_NULL_ARGUMENT);
    for (int k = 0; k < 4; k++) fpt_curve_free(made[k]), fpt_curve_free(across[k]);
}

static void a_profile_is_swept(void) {
    fpt_curve *spine = NULL, *profile = NULL;
    static const double place[] = {3, 0, 0, 0, -1, 0, 1, 0, 0};
    fpt_sweep_options options;
    fpt_surface *surface = NULL;
    double error = 0, holonomy = 1, at[3], box[4];
    CHECK_OK(fpt_curve_arc(NULL, 3, 3, 0, 2 * pi, FPT_ARC_QUARTERS, &spine));
    CHECK_OK(fpt_curve_arc(place, 1, 1, 0, 2 * pi, FPT_ARC_QUARTERS, &profile));
    fpt_sweep_options_init(&options, sizeof options);
    CHECK_ERROR(fpt_surface_swept(profile, spine, &options, &surface, NULL, NULL), FPT_INVALID_ARGUMENT, "tolerance");
    options.tolerance = 1e-6;
    CHECK_OK(fpt_surface_swept(profile, spine, &options, &surface, &error, &holonomy));
    CHECK(error <= 1e-6 && fabs(holonomy) < 1e-9);
    CHECK_OK(fpt_surface_domain(surface, box));
    CHECK_OK(fpt_surface_evaluate(surface, 0.3, box[2] + 0.7 * (box[3] - box[2]), 0, at));
    CHECK_NEAR(hypot(hypot(at[0], at[1]) - 3, at[2]), 1, 1.1e-6);
    fpt_surface_free(surface);
    options.close = 2;
    CHECK_ERROR(fpt_surface_swept(profile, spine, &options, &surface, NULL, NULL), FPT_INVALID_ARGUMENT, "close: 2");
    fpt_sweep_options_init(NULL, 8);
    fpt_curve_free(spine), fpt_curve_free(profile);
}

static void offsets_keep_their_distance(void) {
    static const double up[] = {0, 0, 1}, unit[] = {2, 2, 2}, part[] = {0, 1.5}, band[] = {-0.5, 0.7};
    fpt_curve *circle = NULL, *offset = NULL;
    fpt_surface *ball = NULL, *shell = NULL;
    double at[3], measured = 1, proven = 1;
    size_t count = 0;
    CHECK_OK(fpt_curve_arc(NULL, 2, 2, 0, pi, FPT_ARC_CUBIC, &circle));
    CHECK_OK(fpt_curve_offset(circle, 0.5, up, &offset));
    CHECK_OK(fpt_curve_evaluate(offset, 0.3, 0, at));
    CHECK_NEAR(hypot(at[0], at[1]), 2.5, 1e-14);
    CHECK_STATUS(fpt_curve_pole_count(offset, &count), FPT_UNSUPPORTED);
    fpt_curve_free(offset);
    CHECK_OK(fpt_curve_offset_fit(circle, -0.5, up, 3, 1e-6, &offset, &measured, &proven));
    CHECK(measured <= proven && proven <= 1e-6);
    CHECK_OK(fpt_curve_evaluate(offset, 0.3, 0, at));
    CHECK_NEAR(hypot(at[0], at[1]), 1.5, 1e-6);
    fpt_curve_free(offset);
    CHECK_OK(fpt_surface_quadric(FPT_PATCH_ELLIPSOID, NULL, unit, part, band, FPT_ARC_QUARTERS, &ball));
    CHECK_OK(fpt_surface_offset(ball, 1, &shell));
    CHECK_OK(fpt_surface_evaluate(shell, 0.5, 0.5, 0, at));
    CHECK_NEAR(hypot(hypot(at[0], at[1]), at[2]), 3, 1e-13);
    fpt_surface_free(shell);
    CHECK_OK(fpt_surface_offset_fit(ball, 1, 3, 3, 1e-5, &shell, &measured, &proven));
    CHECK(measured <= proven && proven <= 1e-5);
    fpt_surface_free(shell);
    CHECK_OK(fpt_surface_offset_fit(ball, 1, 3, 3, 1e-3, &shell, NULL, NULL));
    fpt_surface_free(shell);
    CHECK_ERROR(fpt_surface_offset_fit(ball, NAN, 3, 3, 1e-3, &shell, NULL, NULL), FPT_INVALID_ARGUMENT, "distance");
    CHECK_ERROR(fpt_curve_offset_fit(circle, 1, up, 0, 1e-3, &offset, NULL, NULL), FPT_INVALID_ARGUMENT, "degree");
    fpt_curve_free(circle), fpt_surface_free(ball);
}

static void refusals_name_the_argument_and_write_nothing(void) {
    static const double point[] = {0, 0, 0}, flat[] = {0, 0, 0, 0, 0, 0, 1, 0, 0}, two[] = {0, 1}, three[] = {1, 1, -1};
    fpt_curve *curve;
    fpt_surface *surface;
    fill_pattern(&curve, sizeof curve), fill_pattern(&surface, sizeof surface);
    CHECK_STATUS(fpt_curve_line(NULL, point, &curve), FPT_NULL_ARGUMENT);
    CHECK_ERROR(fpt_curve_line(point, point, &curve), FPT_INVALID_ARGUMENT, "end");
    CHECK_ERROR(fpt_curve_arc(flat, 1, 1, 0, 1, 0, &curve), FPT_INVALID_ARGUMENT, "axis");
    CHECK_ERROR(fpt_curve_arc(NULL, 1, -1, 0, 1, 0, &curve), FPT_INVALID_ARGUMENT, "radius_y");
    CHECK_ERROR(fpt_curve_arc(NULL, 1, 1, 0, 1, 9, &curve), FPT_INVALID_ARGUMENT, "form: 9");
    CHECK_ERROR(fpt_curve_arc(NULL, 1, 1, 0, INFINITY, 0, &curve), FPT_INVALID_ARGUMENT, "angles");
    CHECK_ERROR(fpt_curve_arc_through(flat, &curve), FPT_INVALID_ARGUMENT, "points");
    CHECK_ERROR(fpt_curve_conic(flat, 1, &curve), FPT_INVALID_ARGUMENT, "rho");
    CHECK_ERROR(fpt_curve_parabola(NULL, 0, 0, 1, &curve), FPT_INVALID_ARGUMENT, "focal");
    CHECK_ERROR(fpt_curve_hyperbola(NULL, 1, 1, 1, 0, &curve), FPT_INVALID_ARGUMENT, "range");
    CHECK_ERROR(fpt_curve_hyperbola(NULL, 1, 1, 0, 1e6, &curve), FPT_INVALID_ARGUMENT, "range");
    CHECK_ERROR(fpt_surface_quadric(9, NULL, three, two, two, 0, &surface), FPT_INVALID_ARGUMENT, "kind: 9");
    CHECK_ERROR(fpt_surface_quadric(0, NULL, three, two, two, 0, &surface), FPT_INVALID_ARGUMENT, "radius_z");
    CHECK_ERROR(fpt_surface_torus(NULL, 3, 1, two, two, FPT_ARC_CUBIC, &surface), FPT_INVALID_ARGUMENT, "form");
    CHECK_STATUS(fpt_surface_ruled(NULL, NULL, &surface), FPT_NULL_ARGUMENT);
    CHECK_STATUS(fpt_surface_offset(NULL, 1, &surface), FPT_NULL_ARGUMENT);
    CHECK(is_pattern(&curve, sizeof curve) && is_pattern(&surface, sizeof surface));
}

int main(void) {
    RUN(circles_have_every_form);
    RUN(conics_pass_where_they_must);
    RUN(quadrics_and_the_torus_satisfy_their_equations);
    RUN(curves_become_surfaces);
    RUN(networks_become_surfaces);
    RUN(a_profile_is_swept);
    RUN(offsets_keep_their_distance);
    RUN(refusals_name_the_argument_and_write_nothing);
    return check_report("construct");
}
