/* Operations, fits and constructions with any arguments at all: NULL here and there, numbers that are none, knots that are none, wrong
 * counts, truncated options, shapes that cannot be taken. Each call returns a status of the list, tells why when it refuses, and then
 * hands out nothing; nothing crashes, nothing leaks (valgrind). The argument is a seed. */
#include <footpoint.h>

#include "check.h"
#include "samples.h"

#include <math.h>
#include <stdlib.h>

enum { ROOM = 4096, CURVES = 6, SURFACES = 5, CALLS = 4000 };

static uint64_t state = 11;
static size_t below(size_t limit) { return (size_t)(next_random(&state) * (double)limit); }

static double odd(void) {
    static const double all[] = {0, -0.0, 1, -1, 0.5, 0.25, 0.75, 2, 3, 1e-300, 1e300, -1e300, NAN, HUGE_VAL, -HUGE_VAL, 250, 1e100, 2e100, 1e-7};
    return all[below(sizeof all / sizeof *all)];
}
/* Half of the time a number that may be meant. */
static double some(void) { return below(2) == 0 ? odd() : next_random(&state); }
static size_t count_of(void) {
    static const size_t all[] = {0, 1, 2, 3, 31, 32, (size_t)1 << 62, (size_t)-1};
    return below(3) == 0 ? all[below(sizeof all / sizeof *all)] : below(4);
}
/* A length for an array that is there: huge counts are refused before anything is read. */
static size_t length_of(size_t most) {
    static const size_t huge[] = {(size_t)1 << 62, (size_t)-1, ((size_t)-1) / 24 + 2};
    return below(8) == 0 ? huge[below(3)] : below(most + 1);
}
static uint32_t code(void) { return below(6) == 0 ? (uint32_t)-1 : (uint32_t)below(5); }

/* The pointer, or NULL once in ten times. */
static void *perhaps(void *pointer) { return below(10) == 0 ? NULL : pointer; }

static double numbers[ROOM], more[ROOM], results[ROOM];
static fpt_curve *curves[CURVES];
static fpt_surface *surfaces[SURFACES];
static long refused, answered;

static void fill(double *out, size_t count) {
    const int kind = (int)below(3);
    double x = 0;
    for (size_t i = 0; i < count; i++) {
        x += below(3) == 0 ? 0 : next_random(&state);
        out[i] = kind == 0 ? odd() : kind == 1 ? x : next_random(&state);
    }
    if (count > 0 && below(4) == 0) out[below(count)] = odd();
}

static int is_ok(fpt_status status) {
    const int listed = status >= FPT_OK && status <= FPT_OUT_OF_MEMORY;
    CHECK_MESSAGE(listed, "status %d: %s", (int)status, fpt_last_error());
    if (status != FPT_OK) CHECK_MESSAGE(fpt_last_error()[0] != 0, "no text for %s", fpt_status_name(status));
    if (status == FPT_OK) answered++;
    else refused++;
    return status == FPT_OK;
}

/* A call that makes a curve, or a surface: what it made is looked at and released. */
static fpt_curve *curve;
static fpt_surface *surface;
static void made_curve(fpt_status status) {
    size_t poles = 0;
    double u[2];
    if (is_ok(status)) {
        CHECK_OK(fpt_curve_domain(curve, u));
        CHECK(u[0] < u[1]);
        /* A curve that is given by a function has none. */
        status = fpt_curve_pole_count(curve, &poles);
        CHECK(status == FPT_OK ? poles > 0 : status == FPT_UNSUPPORTED);
        fpt_curve_free(curve);
    } else {
        CHECK(curve == NULL);
    }
    curve = NULL;
}
static void made_surface(fpt_status status) {
    double d[4];
    if (is_ok(status)) {
        CHECK_OK(fpt_surface_domain(surface, d));
        CHECK(d[0] < d[1] && d[2] < d[3]);
        fpt_surface_free(surface);
    } else {
        CHECK(surface == NULL);
    }
    surface = NULL;
}

static const fpt_curve *any_curve(void) { return perhaps(curves[below(CURVES)]); }
static const fpt_surface *any_surface(void) { return perhaps(surfaces[below(SURFACES)]); }

static fpt_fit_options odd_options(void) {
    fpt_fit_options out;
    fpt_fit_options_init(&out, sizeof out);
    out.tolerance = below(3) == 0 ? odd() : 0.05;
    if (below(8) == 0) out.struct_size = below(sizeof out + 1);
    if (below(4) == 0) out.degree_u = code();
    if (below(4) == 0) out.degree_v = code();
    if (below(4) == 0) out.spacing = code();
    if (below(3) == 0) out.condition = code();
    if (below(2) == 0) out.tangents = more;
    if (below(4) == 0) out.max_poles = count_of();
    if (below(6) == 0) out.keep_parameters = code();
    if (below(6) == 0) out.certify = code();
    if (below(9) == 0) out.reserved = 1;
    out.threads = 1;
    return out;
}

static void operations_on_curves(void) {
    for (int i = 0; i < CALLS; i++) {
        const fpt_curve *c = any_curve(), *d = any_curve(), *list[3];
        fpt_curve **out = perhaps(&curve), *parts[3] = {NULL, NULL, NULL};
        double *error = below(3) == 0 ? NULL : more;
        size_t count = 0;
        fill(numbers, 128);
        for (int k = 0; k < 3; k++) list[k] = any_curve();
        switch (i % 24) {
        case 0: made_curve(fpt_curve_refine(c, perhaps(numbers), length_of(6), out)); break;
        case 1: made_curve(fpt_curve_remove_knot(c, some(), count_of(), error, out)); break;
        case 2: made_curve(fpt_curve_simplify(c, some(), error, out)); break;
        case 3: made_curve(fpt_curve_part(c, some(), some(), out)); break;
        case 4: made_curve(fpt_curve_clamp(c, out)); break;
        case 5: made_curve(fpt_curve_unclamp(c, error, out)); break;
        case 6: made_curve(fpt_curve_periodic(c, some(), error, out)); break;
        case 7: made_curve(fpt_curve_elevate(c, count_of(), out)); break;
        case 8: made_curve(fpt_curve_reduce(c, error, out)); break;
        case 9: made_curve(fpt_curve_reverse(c, out)); break;
        case 10: made_curve(fpt_curve_with_domain(c, some(), some(), out)); break;
        case 11: made_curve(fpt_curve_reparametrise(c, some(), out)); break;
        case 12: made_curve(fpt_curve_affine(c, perhaps(numbers), out)); break;
        case 13: made_curve(fpt_curve_projective(c, perhaps(numbers), out)); break;
        case 14: made_curve(fpt_curve_derivative(c, out)); break;
        case 15: made_curve(fpt_curve_bezier_form(c, out)); break;
        case 16:
            if (is_ok(fpt_curve_split(c, some(), perhaps(&parts[0]), perhaps(&parts[1])))) CHECK(parts[0] != NULL && parts[1] != NULL);
            else CHECK(parts[0] == NULL && parts[1] == NULL);
            break;
        case 17: made_curve(fpt_curve_join(perhaps(list), length_of(3), some(), error, out)); break;
        case 18: {
            const size_t given = length_of(3);
            const int made = is_ok(fpt_curve_make_compatible(perhaps(list), given, perhaps(parts)));
            for (size_t k = 0; k < 3; k++) CHECK((parts[k] != NULL) == (made && k < given));
            break;
        }
        case 19: is_ok(fpt_curve_difference(c, d, perhaps(results))); break;
        case 20: {
            fpt_arc_length *length = NULL;
            if (is_ok(fpt_arc_length_new(c, some(), perhaps(&length)))) {
                is_ok(fpt_arc_length_total(length, perhaps(results)));
                is_ok(fpt_arc_length_at(perhaps(length), perhaps(numbers), length_of(4), perhaps(results)));
                is_ok(fpt_arc_length_parameters(length, perhaps(numbers), length_of(4), perhaps(results)));
            }
            fpt_arc_length_free(length);
            break;
        }
        case 21: is_ok(fpt_curve_frame(c, some(), (int32_t)below(3) - 1, perhaps(results))); break;
        case 22: is_ok(fpt_curve_continuity(c, some(), below(4), perhaps(results), perhaps(&count))); break;
        default:
            is_ok(fpt_curve_power(c, below(2) == 0 ? below(40) : ROOM, perhaps(results), perhaps(&count)));
            made_curve(fpt_curve_from_power(count_of(), some(), some(), perhaps(numbers), out));
        }
        for (int k = 0; k < 3; k++) fpt_curve_free(parts[k]);
    }
}

static void operations_on_surfaces(void) {
    for (int i = 0; i < CALLS; i++) {
        const fpt_surface *s = any_surface(), *t = any_surface(), *list[3];
        fpt_surface **out = perhaps(&surface), *parts[3] = {NULL, NULL, NULL};
        double *error = below(3) == 0 ? NULL : more;
        const uint32_t along = code();
        size_t count = 0;
        fill(numbers, 512);
        for (int k = 0; k < 3; k++) list[k] = any_surface();
        switch (i % 24) {
        case 0: made_surface(fpt_surface_refine(s, along, perhaps(numbers), length_of(6), out)); break;
        case 1: made_surface(fpt_surface_remove_knot(s, along, some(), count_of(), error, out)); break;
        case 2: made_surface(fpt_surface_simplify(s, some(), error, out)); break;
        case 3: made_surface(fpt_surface_part(s, perhaps(numbers), out)); break;
        case 4: made_surface(fpt_surface_clamp(s, out)); break;
        case 5: made_surface(fpt_surface_unclamp(s, along, error, out)); break;
        case 6: made_surface(fpt_surface_periodic(s, along, some(), error, out)); break;
        case 7: made_surface(fpt_surface_elevate(s, along, below(3) == 0 ? count_of() : 1, out)); break;
        case 8: made_surface(fpt_surface_reduce(s, along, error, out)); break;
        case 9: made_surface(fpt_surface_reverse(s, along, out)); break;
        case 10: made_surface(fpt_surface_swap(s, out)); break;
        case 11: made_surface(fpt_surface_with_domain(s, perhaps(numbers), out)); break;
        case 12: made_surface(fpt_surface_reparametrise(s, along, some(), out)); break;
        case 13: made_surface(fpt_surface_affine(s, perhaps(numbers), out)); break;
        case 14: made_surface(fpt_surface_projective(s, perhaps(numbers), out)); break;
        case 15: made_surface(fpt_surface_derivative(s, along, out)); break;
        case 16: made_surface(fpt_surface_bezier_form(s, out)); break;
        case 17:
            if (is_ok(fpt_surface_split(s, along, some(), perhaps(&parts[0]), perhaps(&parts[1])))) CHECK(parts[0] != NULL && parts[1] != NULL);
            else CHECK(parts[0] == NULL && parts[1] == NULL);
            break;
        case 18: made_curve(fpt_surface_isocurve(s, along, some(), perhaps(&curve))); break;
        case 19: made_surface(fpt_surface_join(perhaps(list), length_of(3), along, some(), error, out)); break;
        case 20: {
            const size_t given = length_of(3);
            const int made = is_ok(fpt_surface_make_compatible(perhaps(list), given, perhaps(parts)));
            for (size_t k = 0; k < 3; k++) CHECK((parts[k] != NULL) == (made && k < given));
            break;
        }
        case 21: is_ok(fpt_surface_difference(s, t, perhaps(results))); break;
        case 22: is_ok(fpt_surface_continuity(s, along, some(), below(4), perhaps(results), perhaps(&count))); break;
        default:
            is_ok(fpt_surface_power(s, below(2) == 0 ? below(400) : ROOM, perhaps(results), perhaps(&count)));
            made_surface(fpt_surface_from_power(below(4), count_of() % 8, perhaps(numbers + 400), perhaps(numbers), out));
        }
        for (int k = 0; k < 3; k++) fpt_surface_free(parts[k]);
    }
}

static void constructions(void) {
    for (int i = 0; i < CALLS; i++) {
        const fpt_curve *c = any_curve(), *d = any_curve(), *list[8];
        fpt_curve **out = perhaps(&curve);
        fpt_surface **sheet = perhaps(&surface);
        fill(numbers, 64);
        fill(more, 64);
        for (int k = 0; k < 8; k++) list[k] = any_curve();
        const double *axes = below(2) == 0 ? NULL : numbers + 20;
        switch (i % 20) {
        case 0: made_curve(fpt_curve_line(perhaps(numbers), perhaps(numbers + 3), out)); break;
        case 1: made_curve(fpt_curve_arc(axes, some(), some(), some(), some(), code(), out)); break;
        case 2: made_curve(fpt_curve_arc_through(perhaps(numbers), out)); break;
        case 3: made_curve(fpt_curve_conic(perhaps(numbers), some(), out)); break;
        case 4: made_curve(fpt_curve_parabola(axes, some(), some(), some(), out)); break;
        case 5: made_curve(fpt_curve_hyperbola(axes, some(), some(), some(), some(), out)); break;
        case 6: made_surface(fpt_surface_quadric(code(), axes, perhaps(numbers), perhaps(more), perhaps(more + 2), code(), sheet)); break;
        case 7: made_surface(fpt_surface_saddle(axes, some(), some(), perhaps(numbers), sheet)); break;
        case 8: made_surface(fpt_surface_plane(axes, perhaps(numbers), sheet)); break;
        case 9: made_surface(fpt_surface_torus(axes, 2 * some(), some(), perhaps(numbers), perhaps(more), code(), sheet)); break;
        case 10: made_surface(fpt_surface_ruled(c, d, sheet)); break;
        case 11: made_surface(fpt_surface_extruded(c, perhaps(numbers), sheet)); break;
        case 12: made_surface(fpt_surface_revolved(c, perhaps(numbers), perhaps(numbers + 3), perhaps(more), code(), sheet)); break;
        case 13: made_surface(fpt_surface_translational(c, d, sheet)); break;
        case 14: made_surface(fpt_surface_coons(perhaps(list), sheet)); break;
        case 15: made_surface(fpt_surface_coons_bicubic(perhaps(list), perhaps(list + 4), sheet)); break;
        case 16: made_surface(fpt_surface_ferguson(perhaps(numbers), perhaps(numbers + 12), perhaps(more), perhaps(more + 12), sheet)); break;
        case 17: made_surface(fpt_surface_gordon(perhaps(list), perhaps(numbers), length_of(3), perhaps(list + 4), perhaps(more), length_of(3), sheet)); break;
        case 18: made_surface(fpt_surface_skinned(perhaps(list), length_of(6), count_of(), below(2) == 0 ? NULL : more, sheet)); break;
        default: {
            fpt_sweep_options options;
            fpt_sweep_options_init(&options, sizeof options);
            options.tolerance = below(3) == 0 ? odd() : 0.01;
            options.max_poles = below(60);
            if (below(6) == 0) options.struct_size = below(sizeof options + 1);
            if (below(4) == 0) options.twist = odd();
            if (below(4) == 0) options.degree = code();
            if (below(4) == 0) options.close = code();
            made_surface(fpt_surface_swept(c, d, perhaps(&options), sheet, below(2) == 0 ? NULL : results, below(2) == 0 ? NULL : results + 1));
        }
        }
    }
}

static void fits_and_offsets(void) {
    for (int i = 0; i < CALLS / 4; i++) {
        const fpt_fit_options some_options = odd_options();
        const fpt_fit_options *options = perhaps((void *)&some_options);
        fpt_curve **out = perhaps(&curve);
        fpt_surface **sheet = perhaps(&surface);
        fpt_fit_result found;
        fpt_fit_result *result = below(2) == 0 ? NULL : &found;
        double *measured = below(2) == 0 ? NULL : results, *proven = below(2) == 0 ? NULL : results + 1;
        fill(numbers, 300);
        fill(more, 64);
        // What no double can meet takes its time.
        const double tolerance = below(40) == 0 ? odd() : 0.05;
        const double *parameters = below(2) == 0 ? NULL : more;
        switch (i % 12) {
        case 0: is_ok(fpt_fit_parameters(perhaps(numbers), length_of(20), code(), perhaps(results))); break;
        case 1: made_curve(fpt_curve_interpolate(perhaps(numbers), length_of(20), parameters, options, out)); break;
        case 2: made_curve(fpt_curve_least_squares(perhaps(numbers), below(20), perhaps(more), count_of(), perhaps(more + 8), length_of(20), code(), out, result)); break;
        case 3: made_curve(fpt_curve_fit(perhaps(numbers), length_of(20), parameters, options, out, result)); break;
        case 4: made_surface(fpt_surface_interpolate(perhaps(numbers), length_of(8), length_of(8), options, sheet)); break;
        case 5: made_surface(fpt_surface_fit_grid(perhaps(numbers), length_of(8), length_of(8), options, sheet, result)); break;
        case 6: made_surface(fpt_surface_fit(perhaps(numbers), length_of(30), parameters, options, sheet, result)); break;
        case 7: made_curve(fpt_curve_offset(any_curve(), some(), perhaps(numbers), out)); break;
        case 8: made_curve(fpt_curve_offset_fit(any_curve(), some(), perhaps(numbers), count_of(), tolerance, out, measured, proven)); break;
        case 9: made_surface(fpt_surface_offset(any_surface(), some(), sheet)); break;
        default:
            // Few: what is refused at once, and what a coarse tolerance meets at once.
            if (i % 60 == 10) made_surface(fpt_surface_offset_fit(any_surface(), some() * 0.1, below(4), below(4), 0.2, sheet, measured, proven));
            else made_surface(fpt_surface_offset_fit(any_surface(), NAN, 3, 3, tolerance, sheet, measured, proven));
        }
    }
}

int main(int count, char **words) {
    const double up[3] = {0, 0, 1}, whole[2] = {0, 6}, square[4] = {0, 1, 0, 1};
    if (count > 1) state = (uint64_t)strtoull(words[1], NULL, 10);
    curves[0] = make_curve(circle_curve());
    curves[1] = make_curve(cubic_curve());
    CHECK_OK(fpt_curve_arc(NULL, 1, 2, 0, 2, FPT_ARC_CUBIC, &curves[2]));
    CHECK_OK(fpt_curve_line(up, square, &curves[3]));
    CHECK_OK(fpt_curve_unclamp(curves[1], NULL, &curves[4]));
    CHECK_OK(fpt_curve_offset(curves[2], 0.1, up, &curves[5]));
    surfaces[0] = make_surface(paper_surface(1));
    CHECK_OK(fpt_surface_torus(NULL, 2, 1, whole, whole, FPT_ARC_QUARTERS, &surfaces[1]));
    CHECK_OK(fpt_surface_plane(NULL, square, &surfaces[2]));
    CHECK_OK(fpt_surface_unclamp(surfaces[2], FPT_DIRECTION_U, NULL, &surfaces[3]));
    CHECK_OK(fpt_surface_offset(surfaces[1], 0.1, &surfaces[4]));
    RUN(operations_on_curves);
    RUN(operations_on_surfaces);
    RUN(constructions);
    RUN(fits_and_offsets);
    for (int k = 0; k < CURVES; k++) fpt_curve_free(curves[k]);
    for (int k = 0; k < SURFACES; k++) fpt_surface_free(surfaces[k]);
    printf("%ld answers, %ld refusals\n", answered, refused);
    CHECK(answered > 1000 && refused > 1000);
    return check_report("misuse_toolkit");
}
